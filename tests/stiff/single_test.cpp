// SPDX-License-Identifier: Apache-2.0
// Numbers at the ends of what floats hold: every method ends soon, and its light is finite.
// in: boxes, extinctions, particles at the least and most that are accepted -> out: pass or fail.
// src/base/single.h; docs/scene.md, "Small numbers"
#include <fstream>

#include "src/base/number_text.h"
#include "src/scene/toml/toml_tree.h"
#include "tests/io/temp_folder.h"
#include "tests/stiff/stiff_scene.h"

namespace single_test {

using namespace stiff_test;

constexpr const char* kGridMethods[] = {"raymarch", "optical-depth", "path", "collectors",
                                        "photon-grid"};

/// A small picture of a box from as far as it is long.
Scene box_scene(const std::string& method, const Double3& size, double extinction) {
    const double far = 3 * std::max({size.x, size.y, size.z});
    const auto three = [](const Double3& v) {
        return "[" + number_text(v.x) + ", " + number_text(v.y) + ", " + number_text(v.z) + "]";
    };
    const Double3 half = 0.5 * size;
    return scene_from(
        "[camera]\nposition_m = " + three({0.1 * far, -far, 0.2 * far}) +
        "\ntarget_m = [0, 0, 0]\nresolution = [8, 8]\n[sun]\nazimuth_deg = 120\n"
        "elevation_deg = 35\n[sky]\nradiance = 0.1\n[[medium]]\ndensity = \"uniform:box\"\n"
        "bounds_m = [" +
        three(-half) + ", " + three(half) +
        "]\nresolution = [6, 5, 4]\n"
        "albedo = 0.9\nextinction_per_m = " +
        number_text(extinction) + "\n[method]\nname = \"" + method +
        "\"\n[photon_grid]\nphotons = 2000\ngenerations = 2\n[collectors]\n"
        "photons = 2000\ngenerations = 2\nsamples = 200\n[path]\nsamples_per_pixel = 4\n");
}

/// What a picture may take: photons fly through a few cells, rays through a few steps.
void check_ended(const Picture& p) {
    const Report& r = p.report;
    CHECK(r.events.tentative <= 200 * (r.photons.traced + r.paths.traced));
    CHECK(r.events.crossings <= 400 * (r.photons.traced + r.paths.traced + r.paths.shadow_rays));
    for (const auto& counter : r.counters)
        if (counter.first == "terminated") CHECK(counter.second == 0);
    for (const auto& work : r.executed)
        if (work.first == "ray_samples") CHECK(work.second <= 64 * 65536);
}

TEST_CASE("an extinction that no float shows through the box is none, at once, by every method") {
    for (const char* method : kGridMethods)
        for (const double extinction : {0.0, 1e-45, 1e-41, 1.2e-38, 1e-36, 1e-31, 1e-25}) {
            CAPTURE(method);
            CAPTURE(extinction);
            const Picture p = render_sound(box_scene(method, {600, 600, 600}, extinction));
            check_ended(p);
            CHECK(largest_of(p, "A") < 1e-20);
            // Nothing else than the sky.
            CHECK(largest_of(p, "R") == doctest::Approx(0.1).epsilon(1e-6));
        }
}

TEST_CASE("boxes at both ends of what is accepted have the light of one in the middle") {
    for (const char* method : kGridMethods) {
        CAPTURE(method);
        // One optical depth along each edge: lengths alone differ.
        const Picture middle = render_sound(box_scene(method, {1, 1, 1}, 1));
        check_ended(middle);
        const double alpha = mean_of(middle, "A"), light = mean_of(middle, "R");
        CHECK(alpha > 0.05);
        for (const double edge : {1e-9, 3e8}) {
            CAPTURE(edge);
            const Picture p = render_sound(box_scene(method, {edge, edge, edge}, 1 / edge));
            check_ended(p);
            // Rounding alone parts them; a photon that it moves is one of 2000.
            CHECK(mean_of(p, "A") == doctest::Approx(alpha).epsilon(1e-3));
            CHECK(mean_of(p, "R") == doctest::Approx(light).epsilon(0.05));
        }
    }
}

TEST_CASE("boxes as flat and as long as can be end, and their light is finite") {
    for (const char* method : kGridMethods)
        for (const Double3& size :
             {Double3{3e8, 3e8, 1e-9}, Double3{1e-9, 3e8, 3e8}, Double3{1e-9, 3e8, 1e-9}}) {
            CAPTURE(method);
            CAPTURE(size.x);
            CAPTURE(size.z);
            for (const double extinction : {1e-9, 1.0, 1e-25}) {
                CAPTURE(extinction);
                RenderOptions options = one_thread();
                const Picture p = render_sound(box_scene(method, size, extinction), options);
                for (const auto& work : p.report.executed)
                    if (work.first == "ray_samples") CHECK(work.second <= 64 * 65536);
            }
        }
}

TEST_CASE("particles: as small as can be, and smaller is refused in one line") {
    pileus::test::TempFolder folder;
    const std::string path = folder.path("p.csv");
    const auto picture = [&](const char* rows, const char* method, Picture* out) {
        std::ofstream(path) << "x,y,z,radius,density\n" << rows;
        Scene scene = scene_from(
            "[camera]\nposition_m = [0, -3e-8, 0]\ntarget_m = [0, 0, 0]\nresolution = [8, 8]\n"
            "[sun]\nelevation_deg = 35\n[sky]\nradiance = 0.1\n[[medium]]\ndensity = \"" +
            path + "\"\n[method]\nname = \"" + method + "\"\n[path]\nsamples_per_pixel = 4\n");
        RenderOptions options = one_thread();
        const Status status = render(scene, options, [&](int, Image& image, Report& report) {
            if (out != nullptr) out->image = std::move(image), out->report = report;
            return Status::ok();
        });
        return status.message;
    };
    for (const char* method : {"particles", "path", "raymarch"}) {
        CAPTURE(method);
        Picture p;
        const std::string fault = picture("0,0,0,1e-9,1e9\n1e-9,0,0,2e-9,1e9\n", method, &p);
        CHECK_MESSAGE(fault.empty(), fault);
        check_sound(p);
        CHECK(largest_of(p, "A") > 0.1);
        for (const char* rows :
             {"0,0,500,1e-45,0.01\n", "0,0,0,1e-10,0.01\n", "0,0,0,1e-41,1\n5,0,0,1,1\n"}) {
            const std::string line = picture(rows, method, nullptr);
            CHECK_MESSAGE(line.find("allowed: ") != std::string::npos, line);
            CHECK(line.find('\n') == std::string::npos);
        }
        // Far out, what no float tells from a point.
        const std::string line = picture("1e6,0,0,1e-6,1\n", method, nullptr);
        CHECK_MESSAGE(line.find("m wide there") != std::string::npos, line);
    }
}

TEST_CASE("grids of files: a box and densities that floats do not hold") {
    pileus::test::TempFolder folder;
    const auto told = [&](const std::string& corner, const std::string& density,
                          const std::string& extinction, Picture* out) {
        std::string values;
        for (int i = 0; i < 8; ++i) values += density + " ";
        const std::string path =
            folder.put("grid.pbrt",
                       "Volume \"volumegrid\" \"integer nx\" 2 \"integer ny\" 2 \"integer nz\" 2\n"
                       "\"point p0\" [ 0 0 0 ] \"point p1\" [ " +
                           corner +
                           " 1 1 ]\n"
                           "\"float density\" [ " +
                           values + "]\n");
        const Scene scene = scene_from(
            "[camera]\nposition_m = [0, -3, 0]\ntarget_m = [0, 0, 0]\nresolution = [8, 8]\n"
            "[sky]\nradiance = 0.1\n[[medium]]\ndensity = \"" +
            path + "\"\nextinction_per_m = " + extinction +
            "\n[method]\nname = \"photon-grid\"\n"
            "[photon_grid]\nphotons = 1000\ngenerations = 2\n");
        return render(scene, one_thread(),
                      [&](int, Image& image, Report& report) {
                          if (out != nullptr) out->image = std::move(image), out->report = report;
                          return Status::ok();
                      })
            .message;
    };
    for (const char* corner : {"1e-45", "1e-41", "1e-10"}) {
        CAPTURE(corner);
        const std::string line = told(corner, "1", "1", nullptr);
        CHECK_MESSAGE(line.find("along x from 0 to ") != std::string::npos, line);
        CHECK_MESSAGE(line.find("allowed: at least 1e-09 m wide there") != std::string::npos, line);
    }
    // What is too dense for products to be numbers is refused; what is too thin is none.
    const std::string dense = told("1", "1e30", "1e12", nullptr);
    CHECK_MESSAGE(dense.find("allowed: at most 1e+24") != std::string::npos, dense);
    for (const char* density : {"1e-45", "1e-41", "1e-38"})
        for (const char* extinction : {"1e12", "1e-35"}) {
            CAPTURE(density);
            CAPTURE(extinction);
            Picture p;
            const std::string fault = told("1", density, extinction, &p);
            REQUIRE_MESSAGE(fault.empty(), fault);
            check_sound(p);
            check_ended(p);
            CHECK(largest_of(p, "A") < 1e-20);
        }
}

}  // namespace single_test
