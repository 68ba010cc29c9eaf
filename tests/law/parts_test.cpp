// SPDX-License-Identifier: Apache-2.0
// Layers of the light's parts add up to the whole, and are what their names say.
// in: small scenes by every method and display -> out: sums, closed forms, parts rendered alone.
// docs/formats.md, "Pictures out"
#include <cmath>

#include "tests/support/render_harness.h"

using namespace render_test;

namespace {

using Texts = std::vector<std::string>;

const char* const kLayers =
    "output.layers=[\"light\",\"order\",\"cloud\",\"depth\","
    "\"optical_depth\",\"transmittance\"]";
const Texts kMethods[] = {
    {"method.name=path", "path.samples_per_pixel=8"},
    {"collectors.display=march"},
    {"collectors.display=billboards"},
    {"collectors.closure=camera"},
    {"method.name=raymarch"},
};

const Channel& channel(const Picture& picture, const std::string& name) {
    const Channel* found = picture.image.find(name.c_str());
    REQUIRE_MESSAGE(found != nullptr, name);
    return *found;
}

Picture pictured(const Texts& method, const Texts& more = {}) {
    Texts set = method;
    set.push_back(kLayers);
    set.insert(set.end(), more.begin(), more.end());
    return render_one(scene_from(kSmallCumulus, set));
}

/// Largest |a + b - whole| over all pixels and colours, and the largest whole.
struct Difference {
    double worst = 0, scale = 0;
};
Difference compare(const Picture& p, const char* a, const char* b, const char* whole) {
    Difference d;
    for (const char* c : {"R", "G", "B"}) {
        const Channel &x = channel(p, std::string(a) + c), &y = channel(p, std::string(b) + c),
                      &z = channel(p, std::string(whole) + c);
        for (std::size_t i = 0; i < z.pixels.size(); ++i) {
            const double sum = double(x.pixels[i]) + double(y.pixels[i]);
            d.worst = std::fmax(d.worst, std::fabs(sum - double(z.pixels[i])));
            d.scale = std::fmax(d.scale, std::fabs(double(z.pixels[i])));
        }
    }
    return d;
}

double worst(const Channel& a, const Channel& b) {
    double d = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        d = std::fmax(d, std::fabs(double(a.pixels[i]) - double(b.pixels[i])));
    return d;
}

double mean(const Channel& a) {
    double sum = 0;
    for (float v : a.pixels.span()) sum += double(v);
    return sum / double(a.pixels.size());
}

}  // namespace

TEST_CASE("parts: sun and sky make the picture, single and multiple the clouds") {
    for (const Texts& method : kMethods) {
        CAPTURE(method[0]);
        const Picture p = pictured(method);
        // A difference of floats and its sum: two roundings of half an ulp of the larger.
        const Difference light = compare(p, "sun.", "sky.", ""),
                         order = compare(p, "single.", "multiple.", "cloud.");
        CHECK(light.scale > 0.01);
        CHECK(light.worst <= 0x1p-23 * light.scale);
        CHECK(order.worst <= 0x1p-23 * order.scale);
        CHECK(mean(channel(p, "sun.G")) > 0.001);
        CHECK(mean(channel(p, "sky.G")) > 0.001);
        CHECK(mean(channel(p, "single.G")) > 1e-5);
        CHECK(mean(channel(p, "multiple.G")) > mean(channel(p, "single.G")));
        for (std::size_t i = 0; i < p.image.channels[3].pixels.size(); ++i)
            // Alpha is that of where colours end, below 1e-4.
            REQUIRE(std::fabs(1.0f - channel(p, "T").pixels[i] - p.image.channels[3].pixels[i]) <=
                    1e-4f);
    }
}

TEST_CASE("parts: layers change nothing in the picture that holds them") {
    for (const Texts& method : kMethods) {
        CAPTURE(method[0]);
        Texts plain = method;
        plain.push_back("output.layers=[\"radiance\"]");
        CHECK(pictured(method).report.hash ==
              render_one(scene_from(kSmallCumulus, plain)).report.hash);
    }
}

TEST_CASE("parts: without a sky all is the sun's, without a sun nothing is") {
    for (const Texts& method : kMethods) {
        CAPTURE(method[0]);
        const Picture sun = pictured(method, {"sky.radiance=0"});
        const Picture sky = pictured(method, {"sun.irradiance=0"});
        for (const char* c : {"R", "G", "B"}) {
            // The display adds its parts in one order for both: nothing is left but rounding.
            CHECK(worst(channel(sun, std::string("sun.") + c), channel(sun, c)) <= 1e-6);
            for (float v : channel(sky, std::string("sun.") + c).pixels.span()) REQUIRE(v == 0);
        }
    }
}

TEST_CASE("parts: the sun's light of a path tracing is that of the sun alone, path by path") {
    const Texts& method = kMethods[0];
    const Picture both = pictured(method);
    const Picture alone = pictured(method, {"sky.radiance=0"});
    // The same paths: only the order of float additions along a path may differ.
    for (const char* c : {"R", "G", "B"})
        CHECK(worst(channel(both, std::string("sun.") + c), channel(alone, c)) <= 1e-6);
    const Picture once = pictured(method, {"path.max_depth=1", "ground.albedo=0"});
    for (const char* c : {"R", "G", "B"})
        for (float v : channel(once, std::string("multiple.") + c).pixels.span()) REQUIRE(v == 0);
}

TEST_CASE("parts: tau and T of an even box are Beer's law") {
    const char* const text = R"(
[camera]
position_m = [0, -300, 50]
target_m = [0, 0, 50]
projection = "orthographic"
height_m = 50
resolution = [8, 4]
[sun]
[[medium]]
density = "uniform:box"
bounds_m = [[-100, -50, 0], [100, 50, 100]]
extinction_per_m = 0.125
resolution = [16, 8, 8]
)";
    for (const Texts& method : kMethods) {
        CAPTURE(method[0]);
        Texts set = method;
        set.push_back(kLayers);
        set.push_back("collectors.photons=2000");
        const Picture p = render_one(scene_from(text, set));
        // 100 m of 0.125/m, in 8 steps of a few roundings each. Billboards keep their own T.
        for (float v : channel(p, "tau").pixels.span())
            CHECK(std::fabs(v - 12.5f) <= 1e-5f * 12.5f);
        if (method[0] != "collectors.display=billboards")
            for (float v : channel(p, "T").pixels.span())
                CHECK(double(v) == doctest::Approx(std::exp(-12.5)).epsilon(1e-4));
    }
}

TEST_CASE("parts: single scattering that is not kept apart is one line") {
    const Scene scene = scene_from(kSmallCumulus, {kLayers, "collectors.variant=paper"});
    const Status status = render(scene, {}, [](int, Image&, Report&) { return Status::ok(); });
    CHECK(status.code == Code::kBadInput);
    CHECK(status.message.find("output.layers: \"order\"") != std::string::npos);
    CHECK(status.message.find('\n') == std::string::npos);
}

/// `off_allowed`: of the brightest pixel.
void check_parts(const char* scattering, const char* ambient, double off_allowed) {
    CAPTURE(scattering);
    const Texts lit{
        "method.name=raymarch",
        "light=[{type=\"point\",position_m=[0,-600,900],intensity=[4e4,2e4,1e4]},"
        "{type=\"directional\",azimuth_deg=200,elevation_deg=60,irradiance=[0.2,0.3,0.4]}]",
        "medium.0.emission=[1e-4,2e-4,3e-4]", ambient, scattering};
    const Picture p = pictured(lit);
    double worst = 0, scale = 0;
    for (const char* c : {"R", "G", "B"})
        for (std::size_t i = 0; i < channel(p, c).pixels.size(); ++i) {
            double sum = 0;
            for (const char* part : {"sun.", "lamp0.", "lamp1.", "emission.", "sky."})
                sum += double(channel(p, std::string(part) + c).pixels[i]);
            const double whole = double(channel(p, c).pixels[i]);
            worst = std::fmax(worst, std::fabs(sum - whole));
            scale = std::fmax(scale, whole);
        }
    // sky.* is what four subtractions leave: half an ulp each.
    CHECK(worst <= 4 * 0x1p-23 * scale);
    // Each part is what the same scene shows without the others, but for the order of sums.
    const auto alone = [&](const Texts& dark, const char* part) {
        Texts all = lit;
        all.insert(all.end(), dark.begin(), dark.end());
        const Picture own = pictured(all);
        CHECK(mean(channel(own, "G")) > 1e-4);
        double off = 0;
        for (std::size_t i = 0; i < channel(own, "G").pixels.size(); ++i)
            off = std::fmax(off, std::fabs(double(channel(own, "G").pixels[i]) -
                                           double(channel(p, std::string(part) + "G").pixels[i])));
        CHECK(off <= off_allowed * scale);
    };
    const Texts no_sky{"sky.radiance=[0,0,0]"}, no_sun{"sun.irradiance=[0,0,0]"},
        no_lamps{"light=[]"}, no_glow{"medium.0.emission=[0,0,0]", "raymarch.ambient=0"};
    const auto without = [](std::initializer_list<Texts> lists) {
        Texts all;
        for (const Texts& one : lists) all.insert(all.end(), one.begin(), one.end());
        return all;
    };
    alone(without({no_sky, no_lamps, no_glow}), "sun.");
    alone(without({no_sky, no_sun, no_lamps}), "emission.");
    alone(without({no_sun, no_lamps, no_glow}), "sky.");
}

TEST_CASE("parts: a raymarch tells lamps and emission apart, and all add up") {
    check_parts("raymarch.scattering=octaves", "raymarch.ambient=0.02", 1e-6);
    // Light is solved for together or apart, each of up to seven solutions ends where a change is
    // below 2e-4, and no sum of bands is shown below zero.
    check_parts("raymarch.scattering=ordinates", "raymarch.ambient=0", 2e-3);
}

TEST_CASE("parts: the first order of a raymarch is its picture by single scattering") {
    const Texts sun{"method.name=raymarch", "sky.radiance=[0,0,0]", "raymarch.sky_light=none"};
    Texts single = sun;
    single.push_back("raymarch.scattering=single");
    const Picture once = pictured(single);
    for (const char* scattering : {"octaves", "forward"}) {
        Texts more = sun;
        more.push_back(std::string("raymarch.scattering=") + scattering);
        const Picture p = pictured(more);
        CHECK(worst(channel(p, "single.G"), channel(once, "cloud.G")) == 0);
        CHECK(mean(channel(p, "multiple.G")) > 0.1 * mean(channel(p, "single.G")));
    }
    CHECK(worst(channel(once, "single.G"), channel(once, "cloud.G")) == 0);
}

TEST_CASE("parts: optical-depth has light of the sun and no orders, thinned raymarches neither") {
    const auto told = [](const Texts& set) {
        const Status status = render(scene_from(kSmallCumulus, set), {},
                                     [](int, Image&, Report&) { return Status::ok(); });
        return status.message;
    };
    CHECK(told({"method.name=optical-depth", "output.layers=[\"order\"]"})
              .find("has no orders of scattering") != std::string::npos);
    const Picture p = render_one(scene_from(
        kSmallCumulus, {"method.name=optical-depth", "output.layers=[\"light\",\"cloud\"]"}));
    CHECK(compare(p, "sun.", "sky.", "").worst <= 0x1p-23 * compare(p, "sun.", "sky.", "").scale);
    CHECK(mean(channel(p, "sun.G")) > 0.001);
    for (const char* thin : {"raymarch.scale=2", "raymarch.temporal=4"})
        for (const char* layer : {"light", "order"})
            CHECK(told({"method.name=raymarch", thin,
                        std::string("output.layers=[\"") + layer + "\"]"})
                      .find(std::string("the layer \"") + layer + "\" has every pixel marched") !=
                  std::string::npos);
}

TEST_CASE("parts: a filtered picture is its layer cloud and what comes straight through") {
    // An even sky and no ground: the sky's straight light is known.
    const Texts set = {"method.name=path",       "path.samples_per_pixel=4",
                       "filter.kind=regression", "sky.radiance=0.25",
                       "camera.fov_deg=30",      "output.layers=[\"cloud\",\"transmittance\"]"};
    const Picture filtered = render_one(scene_from(kSmallCumulus, set));
    Texts plain_set = set;
    plain_set[2] = "filter.kind=none";
    const Picture plain = render_one(scene_from(kSmallCumulus, plain_set));
    const Channel& t = channel(filtered, "T");
    for (const char* c : {"R", "G", "B"}) {
        const Channel &all = channel(filtered, c),
                      &cloud = channel(filtered, std::string("cloud.") + c),
                      &noisy = channel(plain, std::string("cloud.") + c);
        double apart = 0, sum = 0, noisy_sum = 0;
        std::size_t changed = 0;
        for (std::size_t i = 0; i < t.pixels.size(); ++i) {
            if (t.pixels[i] == 1.0f) continue;
            const double straight = double(t.pixels[i]) * 0.25;
            apart = std::fmax(
                apart, std::fabs(double(all.pixels[i]) - double(cloud.pixels[i]) - straight));
            sum += double(cloud.pixels[i]), noisy_sum += double(noisy.pixels[i]);
            changed += cloud.pixels[i] != noisy.pixels[i] ? 1 : 0;
        }
        CHECK(apart <= 1e-6);  // roundings of floats below 1
        CHECK(changed > 20);   // of the pixels that show the cloud, 35
        // A filter keeps light: within what four paths a pixel say of the mean.
        CHECK(std::fabs(sum / noisy_sum - 1) < 0.1);
    }
}
