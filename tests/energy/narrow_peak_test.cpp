// SPDX-License-Identifier: Apache-2.0
// The law of light for phase functions of any width: no pixel is brighter than what its lights
// allow. in: phase functions, methods, lights -> out: furnaces, bounds on pixels.
// docs/phase.md, "Narrow peaks in pictures"; docs/methods.md 3, repair 6.
#include <algorithm>

#include "src/session/flux/flux.h"
#include "tests/support/render_harness.h"

namespace narrow_peak_test {

using namespace render_test;
using Keys = std::vector<std::string>;

/// A box 600 m wide, optical depth 6, before a camera that looks north.
const char* const kBox = R"(
seed = 3
[camera]
position_m = [0, -2000, 500]
target_m = [0, 0, 500]
fov_deg = 40
resolution = [15, 15]
[[medium]]
density = "uniform:box"
bounds_m = [[-300, -300, 200], [300, 300, 800]]
resolution = [6, 6, 6]
extinction_per_m = 0.01
albedo = 1.0
phase = { type = "isotropic" }
[collectors]
photons = 10_000
generations = 1
samples = 400
[photon_grid]
photons = 10_000
generations = 1
[path]
samples_per_pixel = 16
)";
const std::string kPerspective = "fov_deg = 40";
const std::string kParallel = "projection = \"orthographic\"\nheight_m = 800";
const Keys kSky = {"sky.radiance=[1,1,1]"};
const Keys kAside = {"sun.azimuth_deg=120", "sun.elevation_deg=35"};  // turns by 117 degrees
const Keys kAhead = {"sun.azimuth_deg=0", "sun.elevation_deg=0"};
/// As bright at the box as the sun.
const char* const kLamp = R"(
[[light]]
type = "directional"
azimuth_deg = 120
elevation_deg = 35
)";

std::string hg(double g) {
    return "{ type = \"henyey-greenstein\", g = " + std::to_string(g) + " }";
}
const std::string kNarrow[] = {
    hg(0.97),
    hg(0.99),
    hg(0.997),
    hg(0.999),
    hg(0.9999),
    "{ type = \"henyey-greenstein\", g = 0.9999999 }",
    hg(1),
    "{ type = \"cornette-shanks\", g = 0.9999 }",
    "{ type = \"cornette-shanks\", g = 1 }",
    "{ type = \"two-lobe\", g1 = 0.9999, g2 = 0.97, weight = 0.8 }",
    "{ type = \"two-lobe\", g1 = 1, g2 = 0.97, weight = 0.5 }",
};
const std::string kOthers[] = {
    hg(0),
    hg(0.85),
    hg(-0.99),
    hg(-1),
    "{ type = \"rayleigh\" }",
    "{ type = \"two-lobe\", g1 = 0.9999, g2 = -0.5, weight = 0.8 }",
    "{ type = \"two-lobe\", g1 = 1, g2 = -0.5, weight = 0.8 }",
    "{ type = \"hg-draine\", droplet_diameter_um = 50 }",
    "{ type = \"cloud\", effective_radius_um = 20 }",
};
const char* const kMethods[] = {"collectors", "photon-grid", "raymarch", "optical-depth", "path"};

Picture shown(const std::string& phase, const std::string& method, const Keys& light,
              const Keys& more = {}, const std::string& lamp = "",
              const std::string& view = kPerspective) {
    Keys keys = {"method.name=" + method};
    keys.insert(keys.end(), light.begin(), light.end());
    keys.insert(keys.end(), more.begin(), more.end());
    std::string text = kBox + lamp;
    const std::string plain = "{ type = \"isotropic\" }";
    text.replace(text.find(plain), plain.size(), phase);
    text.replace(text.find(kPerspective), kPerspective.size(), view);
    return render_one(scene_from(text, keys), {});
}

struct Light {
    double mean = 0, most = 0;
};
Light light_of(const Picture& p) {
    Light l;
    for (int y = 0; y < p.image.height; ++y)
        for (int x = 0; x < p.image.width; ++x) {
            const double v = double(p.at("R", x, y));
            l.mean += v / double(p.image.width * p.image.height);
            l.most = std::max(l.most, v);
        }
    return l;
}

template <class Use>
void for_all_phases(const Use& use) {
    for (const std::string& phase : kNarrow) use(phase);
    for (const std::string& phase : kOthers) use(phase);
}

TEST_CASE("narrow peaks: nothing in a white furnace is brighter than its sky") {
    for (const char* method : kMethods)
        for_all_phases([&](const std::string& phase) {
            CAPTURE(method);
            CAPTURE(phase);
            const Light l = light_of(shown(phase, method, kSky));
            // Discrete ordinates end where a change is below 2e-4 (docs/ordinates.md).
            const double off = std::string(method) == "raymarch" ? 3e-3 : 1e-5;
            CHECK(l.most <= 1 + off);
            // The method of a look alone leaves the sky's light out.
            if (std::string(method) != "optical-depth")
                CHECK(l.mean == doctest::Approx(1).epsilon(off));
        });
}

/// Photon methods make a table of the beam for each phase function: not all of them make all.
template <class Use>
void for_few_phases(const Use& use) {
    for (const std::size_t i : {2, 5, 6, 9}) use(kNarrow[i]);
}

TEST_CASE("narrow peaks: hardly any light turns by 120 degrees") {
    // Isotropic media show a mean of 0.012 here. HG sends (1 - g) times a few to there.
    const auto check = [](const char* method, const std::string& phase) {
        CAPTURE(method);
        CAPTURE(phase);
        CHECK(light_of(shown(phase, method, kAside)).mean < 0.002);
    };
    for (const std::string& phase : kNarrow)
        for (const char* method : {"collectors", "optical-depth", "path"}) check(method, phase);
    for_few_phases([&](const std::string& phase) { check("photon-grid", phase); });
}

TEST_CASE("narrow peaks: few bands without the table of a beam make no light, either") {
    // Four bands of a beam that goes straight on would send 0.15 of its light to each sphere there;
    // what spreads them leaves a tenth of that.
    const Keys switched_off = {"collectors.peak_deg=0", "photon_grid.peak_deg=0"};
    for (const char* method : {"collectors", "photon-grid"})
        for (const double g : {0.99, 0.999, 1.0}) {
            CAPTURE(method);
            CAPTURE(g);
            CHECK(light_of(shown(hg(g), method, kAside, switched_off)).mean < 0.0008);
            CHECK(light_of(shown(hg(g), method, {}, {}, kLamp)).mean < 0.0008);
        }
}

TEST_CASE("narrow peaks: a pixel before the sun holds no more than the sun's light") {
    // The middle pixel looks straight at the sun: all of its light within the pixel, no more. Its
    // neighbours see what is wider.
    const double pixel = std::pow(2 * std::tan(20 * 3.14159265358979323846 / 180) / 15, 2);
    const auto check = [&](const char* method, const std::string& phase) {
        CAPTURE(method);
        CAPTURE(phase);
        // Twice as much is what optical-depth's own rule shows.
        const double rule = std::string(method) == "optical-depth" ? 2 : 1;
        CHECK(light_of(shown(phase, method, kAhead)).most <= rule / pixel);
    };
    for_all_phases([&](const std::string& phase) {
        for (const char* method : {"raymarch", "optical-depth"}) check(method, phase);
    });
    for_few_phases([&](const std::string& phase) {
        for (const char* method : {"collectors", "photon-grid"}) check(method, phase);
    });
    check("collectors", kOthers[8]);
    const Keys billboards = {"collectors.display=billboards"};
    CHECK(light_of(shown(hg(0.9999), "collectors", kAhead, billboards)).most <= 1.05 / pixel);
}

TEST_CASE("narrow peaks: a parallel view at the sun shows nothing brighter than the sun") {
    for (const char* method : {"collectors", "photon-grid", "raymarch"})
        for (const double g : {0.9999, 1.0}) {
            CAPTURE(method);
            CAPTURE(g);
            CHECK(light_of(shown(hg(g), method, kAhead, {}, "", kParallel)).most <= 14713);
        }
}

TEST_CASE("narrow peaks: particles before the sun hold no more than its light") {
    for (const char* g : {"0.97", "0.9999", "0.9999999"}) {
        CAPTURE(g);
        Scene scene;
        // The tests run in the root of the sources. The camera looks up by 3.8141 degrees.
        REQUIRE(read_scene_file("assets/scenes/golden/particles.toml",
                                {std::string("medium.0.phase.g=") + g, "sun.azimuth_deg=0",
                                 "sun.elevation_deg=3.8141", "camera.resolution=[15,15]"},
                                scene));
        const double pixel = std::pow(2 * std::tan(18 * 3.14159265358979323846 / 180) / 15, 2);
        CHECK(light_of(render_one(scene)).most <= 1 / pixel);
    }
}

TEST_CASE("narrow peaks: closure camera refuses lobes without width") {
    for (const char* method : {"collectors", "photon-grid"}) {
        const std::string key = std::string(method) == "collectors" ? "collectors" : "photon_grid";
        std::string text = kBox;
        text.replace(text.find("\"isotropic\""), 11, "\"henyey-greenstein\", g = 1");
        const Scene scene = scene_from(
            text, {std::string("method.name=") + method, key + ".closure=camera", kAside[0]});
        const Status status = render(scene, {}, [](int, Image&, Report&) { return Status::ok(); });
        CHECK(status.code == Code::kBadInput);
        CHECK(status.message.find("closure: \"camera\" with medium.0.phase") != std::string::npos);
    }
}

}  // namespace narrow_peak_test
