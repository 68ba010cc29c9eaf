// SPDX-License-Identifier: Apache-2.0
// --verify: what it says of a picture, against pictures by many paths.
// in: small scenes by several methods -> out: biases within their errors; bits that stay.
// docs/report.md, "Verify"
#include <doctest/doctest.h>

#include <cmath>

#include "lab/compare/metrics.h"
#include "tests/support/render_harness.h"

namespace verify_test {

using namespace render_test;
using Keys = std::vector<std::string>;

Picture verified(const Keys& keys, std::int64_t pixels) {
    Keys all = {"camera.resolution=[144, 81]", "output.layers=[\"radiance\",\"alpha\"]"};
    all.insert(all.end(), keys.begin(), keys.end());
    RenderOptions options;
    options.verify = pixels;
    return render_one(scene_from(kSmallCumulus, all), options);
}

TEST_CASE("verify: paths agree with paths of another stream") {
    const Picture p = verified({"method.name=path", "path.samples_per_pixel=64"}, 200);
    const Report& r = p.report;
    CHECK(r.verify.pixels == 200);
    CHECK(r.verify.samples == 1024);
    CHECK(r.verify.standard_error > 0);
    // One test of one fixed seed at 4.5 standard errors: a false alarm once in 150 000.
    CHECK(std::fabs(r.verify.bias) < 4.5 * r.verify.standard_error);
    // Noise of 64 samples of a pixel, less that of the thousand: positive, far below 1.
    CHECK(r.verify.relmse > 0);
    CHECK(r.verify.relmse < 0.5);
}

TEST_CASE("verify: single scattering is found too dark, by what many paths say") {
    const Keys single = {"method.name=raymarch", "raymarch.scattering=single",
                         "raymarch.sky_light=none"};
    const Picture none = verified(single, 0), all = verified(single, 1000000);
    CHECK(none.report.verify.pixels == 0);
    CHECK(none.report.hash == all.report.hash);
    const Picture truth = verified(
        {"method.name=path", "path.samples_per_pixel=512", "path.pixel=centre", "seed=99"}, 0);
    Metrics m;
    REQUIRE(compare_images(all.image, truth.image, {}, m));
    CHECK(all.report.verify.pixels == m.cloud_pixels);
    CHECK(all.report.verify.bias < -0.1);
    // Both references are noisy: 512 paths of each pixel give their mean to 0.3 %, as the error of
    // single pixels is below 10 % and there are 500 of them.
    CHECK(all.report.verify.bias == doctest::Approx(m.bias / m.mean_reference).epsilon(0.02));
    CHECK(all.report.verify.relmse == doctest::Approx(m.relmse_raw).epsilon(0.1));
    // A part of the pixels tells the same within its own error.
    const Picture some = verified(single, 60);
    CHECK(some.report.verify.pixels == 60);
    CHECK(std::fabs(some.report.verify.bias - all.report.verify.bias) <
          4.5 * some.report.verify.standard_error);
}

TEST_CASE("verify: the same figures from any number of threads") {
    const Keys keys = {"method.name=raymarch", "raymarch.light=march",
                       "output.layers=[\"radiance\",\"alpha\"]"};
    RenderOptions one;
    one.verify = 37;
    one.threads = 1;
    RenderOptions three = one;
    three.threads = 3;
    const Scene scene = scene_from(kSmallCumulus, keys);
    const Report a = render_one(scene, one).report, b = render_one(scene, three).report;
    CHECK(a.verify.bias == b.verify.bias);
    CHECK(a.verify.relmse == b.verify.relmse);
    CHECK(a.verify.standard_error == b.verify.standard_error);
}

TEST_CASE("verify: a picture without media has nothing to verify") {
    CHECK(
        verified({"method.name=raymarch", "medium.0.extinction_per_m=0"}, 9).report.verify.pixels ==
        0);
}

}  // namespace verify_test
