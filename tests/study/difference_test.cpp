// SPDX-License-Identifier: Apache-2.0
// Pictures of a comparison: values, masks and colours.
// in: pictures made by hand -> out: pass or fail.
// docs/compare.md, "Pictures"
#include "lab/compare/difference.h"

#include <limits>

#include "kernels_cpu/display/tone.h"
#include "tests/study/pictures.h"

using namespace pileus;
using test::make_picture;

namespace {

/// Code of a channel of display-linear colours.
int code(const Image& image, int channel, std::size_t pixel) {
    return int(srgb_code(image.channels[std::size_t(channel)].pixels[pixel]));
}

/// Four pixels: d = 0.5, -1, 0.25 (alpha 0: left out), NaN.
Image picture(bool changed) {
    return make_picture(4, 1, {"R", "G", "B", "A", "error.R", "error.G", "error.B"},
                        [&](int c, int x, int) {
                            const double d[4] = {0.5, -1, 0.25, std::nan("")};
                            if (c == 3) return x == 2 ? 0.0 : 1.0;
                            if (c > 3) return x == 1 ? 0.0 : changed ? 0.3 : 0.4;
                            return 2 + (changed ? d[x] : 0);
                        });
}

}  // namespace

TEST_CASE("difference: values, mask and colours") {
    Image values, colours;
    REQUIRE(difference_picture(picture(true), picture(false), 0.02, values));
    const Buffer<float>& g = values.find("G")->pixels;
    const Buffer<float>& mask = values.find("A")->pixels;
    CHECK(g[0] == 0.5f);
    CHECK(g[1] == -1.0f);
    CHECK(g[2] == 0.0f);
    CHECK(std::isnan(g[3]));
    CHECK(mask[0] == 1);
    CHECK(mask[2] == 0);
    CHECK(mask[3] == 1);
    REQUIRE(signed_colours(values, 0.5, colours));
    CHECK(colours.display_colours);
    // The ends of the map: darkest red at +scale, darkest blue at -scale and beyond.
    CHECK(code(colours, 0, 0) == 115);
    CHECK(code(colours, 1, 0) == 0);
    CHECK(code(colours, 2, 1) == 107);
    for (int c = 0; c < 3; ++c) CHECK(code(colours, c, 2) == 140);
    CHECK(code(colours, 0, 3) == 255);
    CHECK(code(colours, 2, 3) == 0);
    REQUIRE(signed_colours(values, 1e9, colours));
    for (int c = 0; c < 3; ++c) CHECK(code(colours, c, 0) == 247);
}

TEST_CASE("z map: standard errors add in squares; none is no value") {
    Image values;
    REQUIRE(z_picture(picture(true), picture(false), 0.02, values));
    const Buffer<float>& r = values.find("R")->pixels;
    const Buffer<float>& mask = values.find("A")->pixels;
    CHECK(r[0] == doctest::Approx(1).epsilon(1e-6));  // 0.5 / sqrt(0.3^2 + 0.4^2)
    CHECK(r[1] == 0);
    CHECK(mask[0] == 1);
    CHECK(mask[1] == 0);
    const Image plain = test::flat_picture(2, 2, 1, 1, 1);
    CHECK(z_picture(plain, plain, 0.02, values).code == Code::kBadInput);
}

TEST_CASE("flip map: values and the ends of the colours") {
    FlipResult result;
    result.width = 3;
    result.height = 1;
    REQUIRE(result.value.resize(3, "test"));
    result.value[1] = 0.5f;
    result.value[2] = 1.0f;
    Image image;
    REQUIRE(flip_picture(result, image));
    CHECK(image.find("Y")->pixels[1] == 0.5f);
    REQUIRE(flip_colours(result, image));
    CHECK(code(image, 0, 0) == 0);
    CHECK(code(image, 2, 0) == 4);    // 0.013866
    CHECK(code(image, 0, 1) == 183);  // 0.716387, magma's entry 128
    CHECK(code(image, 0, 2) == 252);
    CHECK(code(image, 1, 2) == 253);
}
