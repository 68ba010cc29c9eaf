// SPDX-License-Identifier: Apache-2.0
// The ground, and clouds above it, under a sky map or the air's sky: in every method as under a
// constant sky.
// in: bare grounds, white clouds over a white ground -> out: radiances against closed forms.
// docs/methods.md 3 "Sky map", docs/atmosphere.md, docs/raymarch.md "Skylight"
#include "src/clouds/render_clouds.h"
#include "src/io/images/image_file.h"
#include "tests/io/temp_folder.h"
#include "tests/support/render_harness.h"
#include "tests/support/sky_images.h"

using namespace pileus;
using namespace render_test;

namespace {

constexpr double kAlbedo = 0.5;

const char* const kBare = R"(
[camera]
position_m = [0, -3000, 900]
target_m = [0, 0, -2000]
fov_deg = 20
resolution = [8, 8]
[ground]
altitude_m = 0
albedo = 0.5
[[medium]]
density = "procedural:particle-cumulus"
particle_cumulus = { particles = 2000 }
bounds_m = [[-400, -400, 500], [400, 400, 1300]]
resolution = [8, 8, 8]
extinction_per_m = 1e-9
[collectors]
photons = 4000
generations = 1
[photon_grid]
photons = 4000
generations = 1
[path]
samples_per_pixel = 256
)";

const char* const kMethods[] = {"collectors",    "photon-grid", "raymarch",
                                "optical-depth", "particles",   "path"};

/// Without noise but for paths, whose errors these are.
double allowed(const std::string& method) { return method == "path" ? 0.02 : 1e-5; }

std::array<double, 3> mean_of(const Picture& p) {
    std::array<double, 3> mean{};
    const char* const names[3] = {"R", "G", "B"};
    const double pixels = double(p.image.width) * double(p.image.height);
    for (std::size_t c = 0; c < 3; ++c)
        for (int y = 0; y < p.image.height; ++y)
            for (int x = 0; x < p.image.width; ++x)
                mean[c] += double(p.at(names[c], x, y)) / pixels;
    return mean;
}

std::array<double, 3> bare(const std::string& method, std::vector<std::string> sky) {
    sky.push_back("method.name=" + method);
    return mean_of(render_one(scene_from(kBare, sky)));
}

std::string put_map(const test::TempFolder& folder, const Image& image) {
    const std::string file = folder.path("sky.pfm");
    REQUIRE(write_image(image, file, ToneSettings{}));
    return "sky={map=\"" + file + "\"}";
}

std::string air(double elevation_deg) {
    return "atmosphere={turbidity=2,sun_disc=false}\nsun={azimuth_deg=200,elevation_deg=" +
           std::to_string(elevation_deg) + "}\n";
}

}  // namespace

TEST_CASE("bare ground shows its albedo under a map of ones in every method") {
    const test::TempFolder folder;
    const std::string map =
        put_map(folder, sky_test::sky_image(16, 8, [](int, int, int) { return 1.0; }));
    for (const std::string method : kMethods) {
        CAPTURE(method);
        for (const double v : bare(method, {map}))
            CHECK(v == doctest::Approx(kAlbedo).epsilon(allowed(method)));
    }
}

TEST_CASE("bare ground shows what a bright patch of a map sends it in every method") {
    const test::TempFolder folder;
    const Image sky = sky_test::sky_image(64, 32, [](int row, int column, int c) {
        return row >= 4 && row < 7 && column >= 20 && column < 24 ? 30.0 : 0.25 * (c + 1);
    });
    // Each texel of the patch by its middle: bilinear light is spread a little beyond.
    double patch = 0;
    for (int row = 4; row < 7; ++row) {
        const double zenith = (row + 0.5) * sky_test::kPi64 / 32;
        patch += 4 * std::sin(zenith) * std::cos(zenith) * (sky_test::kPi64 / 32) *
                 (2 * sky_test::kPi64 / 64) * 30;
    }
    const std::string map = put_map(folder, sky);
    const std::array<double, 3> first = bare("collectors", {map});
    for (const std::string method : kMethods) {
        CAPTURE(method);
        const std::array<double, 3> own = bare(method, {map});
        for (std::size_t c = 0; c < 3; ++c) {
            CHECK(own[c] == doctest::Approx(first[c]).epsilon(2 * allowed(method)));
            const double even = 0.25 * double(c + 1) * (1 - patch / 30 / sky_test::kPi64);
            CHECK(own[c] ==
                  doctest::Approx(kAlbedo * (even + patch / sky_test::kPi64)).epsilon(0.05));
        }
    }
}

TEST_CASE("bare ground in clear air is the same in every method, at low suns, too") {
    for (const double elevation : {60.0, 5.0, 0.5, -2.0}) {
        CAPTURE(elevation);
        const std::string keys = air(elevation) + kBare;
        std::array<double, 3> first{};
        for (const std::string method : kMethods) {
            CAPTURE(method);
            const auto own = mean_of(render_one(scene_from(keys, {"method.name=" + method})));
            if (method == kMethods[0]) first = own;
            for (std::size_t c = 0; c < 3; ++c) {
                CHECK(own[c] > 1e-5);
                CHECK(own[c] == doctest::Approx(first[c]).epsilon(allowed(method)));
            }
        }
    }
}

TEST_CASE("a white cloud over a white ground is 1 under a map of ones as under a sky of 1") {
    const test::TempFolder folder;
    const std::string map =
        put_map(folder, sky_test::sky_image(16, 8, [](int, int, int) { return 1.0; }));
    const std::string text = kBare;
    for (const std::string method : {"raymarch", "particles"}) {
        CAPTURE(method);
        std::array<double, 3> seen[2];
        for (const bool mapped : {false, true}) {
            const auto p = render_one(scene_from(
                text,
                {"method.name=" + method, mapped ? map : std::string("sky={radiance=1}"),
                 "ground.albedo=1", "medium.0.extinction_per_m=1", "camera.target_m=[0,0,900]"}));
            seen[mapped ? 1 : 0] = mean_of(p);
        }
        for (std::size_t c = 0; c < 3; ++c) {
            // Particles by default keep less.
            if (method == "raymarch") CHECK(seen[1][c] == doctest::Approx(1).epsilon(0.005));
            // Discrete ordinates solve for sky and ground apart or, with a map, together, and end
            // where a change is below 2e-4 (docs/ordinates.md, "Iterations").
            const double allowed = method == "raymarch" ? 2e-3 : 1e-4;
            CHECK(seen[1][c] == doctest::Approx(seen[0][c]).epsilon(allowed));
        }
    }
}

TEST_CASE(
    "a cloud over a grey or black ground is under a map of ones what it is under a sky of 1") {
    const test::TempFolder folder;
    const std::string map =
        put_map(folder, sky_test::sky_image(16, 8, [](int, int, int) { return 1.0; }));
    // What looks up or down through thin media meets the forward peak and one half of the sphere.
    for (const std::string method : {"raymarch", "particles"})
        for (const std::string at : {"[0,-900,100]", "[0,-900,1700]"})
            for (const std::string albedo : {"0", "0.5"}) {
                CAPTURE(method);
                CAPTURE(at);
                CAPTURE(albedo);
                std::array<double, 3> seen[2];
                for (const bool mapped : {false, true})
                    seen[mapped ? 1 : 0] = mean_of(render_one(scene_from(
                        kBare,
                        {"method.name=" + method, mapped ? map : std::string("sky={radiance=1}"),
                         "ground.albedo=" + albedo, "medium.0.extinction_per_m=0.002",
                         "medium.0.phase={type=\"henyey-greenstein\",g=0.85}",
                         "camera.position_m=" + at, "camera.target_m=[0,0,900]"})));
                for (std::size_t c = 0; c < 3; ++c)
                    CHECK(seen[1][c] == doctest::Approx(seen[0][c]).epsilon(1e-4));
            }
}

TEST_CASE("the ground of a sky of clouds in clear air is that of a sky without") {
    const test::TempFolder folder;
    folder.put("kind.toml", kSmallCumulus);
    for (const double elevation : {60.0, 5.0, -2.0}) {
        CAPTURE(elevation);
        std::string text(kBare);
        const std::size_t medium = text.find("[[medium]]"), after = text.find("[collectors]");
        REQUIRE(medium != std::string::npos);
        text.erase(medium, after - medium);
        text.erase(text.find("[collectors]"));
        text = air(elevation) + text;
        const auto alone = mean_of(render_one(scene_from(text, {"method.name=raymarch"})));
        // Far behind the camera.
        const Scene scene = scene_from(
            text + "[[clouds.kind]]\nname = \"c\"\nscene = \"" + folder.path("kind.toml") +
            "\"\nset = [\"method.name=raymarch\", \"raymarch.steps=16\"]\n"
            "[[clouds.place]]\nkind = \"c\"\noffset_m = [0, -400000, 0]\n");
        Picture p;
        const Status drawn = render_clouds(scene, {}, [&](int, Image& image, Report&) {
            p.image = std::move(image);
            return Status::ok();
        });
        REQUIRE_MESSAGE(drawn, drawn.message);
        const auto own = mean_of(p);
        for (std::size_t c = 0; c < 3; ++c) {
            CHECK(own[c] > 1e-5);
            CHECK(own[c] == doctest::Approx(alone[c]).epsilon(1e-5));
        }
    }
}
