// SPDX-License-Identifier: Apache-2.0
// Pictures that are doubtful say so: accidents that were counted, media that no ray meets.
// in: reports and small scenes -> out: lines of warning.
// docs/report.md, "Accidents"
#include "src/session/warnings.h"

#include <set>

#include "tests/stiff/stiff_scene.h"

using namespace stiff_test;

namespace {

Scene by_method(const char* method, Keys keys) {
    keys.push_back(std::string("method.name=") + method);
    keys.push_back("path.samples_per_pixel=2");
    return bent_scene(keys);
}

bool unseen(const Picture& p) {
    for (const std::string& warning : p.report.warnings)
        if (warning.find("no ray meets the medium") != std::string::npos) return true;
    return false;
}

}  // namespace

TEST_CASE("each accident has a line with its number, other counters have none") {
    Image image;
    for (const Accident& accident : accidents()) {
        Report report;
        report.counters = {{accident.counter, 3}, {"clamped_negative", 5}};
        find_warnings(Scene{}, image, report);
        REQUIRE(report.warnings.size() == 1);
        CHECK(report.warnings[0] ==
              "counters." + std::string(accident.counter) + ": 3 " + accident.meaning);
        report.counters = {{accident.counter, 0}, {"degenerate_triangles", 2}};
        find_warnings(Scene{}, image, report);
        CHECK(report.warnings.empty());
    }
}

TEST_CASE("every method reports the accidents that can happen to it") {
    std::set<std::string> met;
    for (const char* method : {"path", "collectors", "photon-grid", "raymarch"}) {
        const Picture p = render_sound(by_method(method, {}));
        for (const auto& counter : p.report.counters)
            for (const Accident& accident : accidents())
                if (counter.first == accident.counter) {
                    met.emplace(counter.first);
                    CHECK(counter.second == 0);
                }
        CHECK(p.report.warnings.empty());
    }
    met.emplace("fractions_capped");      // of weather data: weather/columns_test
    met.emplace("particles_uncoloured");  // of particles: law/particle_colours_test
    met.emplace("camera_deep");           // below
    for (const Accident& accident : accidents()) {
        CAPTURE(std::string(accident.counter));
        CHECK(met.count(accident.counter) == 1);
    }
}

TEST_CASE("a camera deep among thick nodes is a warning") {
    const auto warns = [](const char* extinction, const char* at) {
        const Picture p =
            render_one(scene_from(R"(
[camera]
position_m = [0, -2000, 0]
target_m = [0, 1000, 0]
resolution = [4, 4]
[sun]
elevation_deg = 40
[[medium]]
density = "uniform:ellipsoid"
bounds_m = [[-500, -500, -500], [500, 500, 500]]
resolution = [24, 24, 24]
phase = { type = "isotropic" }
[method]
name = "raymarch"
)",
                                  {std::string("medium.0.extinction_per_m=") + extinction,
                                   std::string("camera.position_m=") + at}));
        for (const std::string& line : p.report.warnings)
            if (line.find("camera_deep") != std::string::npos) return true;
        return false;
    };
    CHECK(warns("0.05", "[0, 0, 0]"));
    CHECK(!warns("0.05", "[0, -2000, 0]"));
    CHECK(!warns("0.05", "[0, -480, 0]"));
    CHECK(!warns("0.005", "[0, 0, 0]"));
}

TEST_CASE("a medium that no ray meets is a warning in every method") {
    const Keys away = {"camera.target_m=[0,-6000,1100]"};
    // Bounds in kilometres where metres are meant.
    const Keys tiny = {"medium.0.bounds_m=[[-0.8,-0.8,0.6],[0.8,0.8,1.7]]"};
    for (const char* method : {"path", "collectors", "photon-grid", "raymarch"}) {
        CAPTURE(method);
        CHECK(unseen(render_sound(by_method(method, away))));
        CHECK(unseen(render_sound(by_method(method, tiny))));
        CHECK_FALSE(unseen(render_sound(by_method(method, {}))));
    }
}

TEST_CASE("cells of scattered light that are too thick are told, with their depth") {
    Medium medium;
    medium.sigma = 0.5f;
    medium.density_max = 2;
    Report report;
    warn_of_cells(medium, 8, report);
    CHECK(report.warnings.empty());
    warn_of_cells(medium, 0, report);
    CHECK(report.warnings.empty());
    warn_of_cells(medium, 27, report);
    REQUIRE(report.warnings.size() == 1);
    CHECK(report.warnings[0].find("cells of up to 27 optical depths") != std::string::npos);
    // Where media absorb, light changes within less.
    medium.optics[0].albedo[0] = 0.6f;
    report.warnings.clear();
    warn_of_cells(medium, 5, report);
    CHECK(report.warnings.size() == 1);
    report.warnings.clear();
    warn_of_cells(medium, 2, report);
    CHECK(report.warnings.empty());
}

TEST_CASE("phase functions narrower than what is kept of light are told") {
    const auto warned = [](const char* method, const char* g, const char* extinction,
                           const char* closure) {
        const Picture out = render_sound(by_method(
            method, {std::string("medium.0.phase={type=\"henyey-greenstein\", g=") + g + "}",
                     std::string("medium.0.extinction_per_m=") + extinction, closure}));
        for (const std::string& line : out.report.warnings)
            if (line.find("mean cosine 0.97") != std::string::npos) return true;
        return false;
    };
    for (const auto& [method, closure] :
         {std::pair<const char*, const char*>{"collectors", "collectors.closure=lobe"},
          {"photon-grid", "photon_grid.closure=mean"},
          {"collectors", "collectors.display=billboards"}}) {
        CAPTURE(closure);
        CHECK(warned(method, "0.97", "0.1", closure));
        CHECK_FALSE(warned(method, "0.9", "0.1", closure));
        CHECK(warned(method, "0.97", "0.002", closure));
        CHECK_FALSE(warned(method, "0.97", "0.0001", closure));
    }
    // Where bands are kept, what turns within the peak goes on as it came.
    CHECK_FALSE(warned("collectors", "0.97", "0.1", "collectors.closure=sh"));
    CHECK_FALSE(warned("photon-grid", "0.97", "0.1", "photon_grid.closure=sh"));
    CHECK_FALSE(warned("path", "0.97", "0.1", "path.guide=true"));
    CHECK_FALSE(warned("raymarch", "0.97", "0.1", "raymarch.temporal=0"));
}
