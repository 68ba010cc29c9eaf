// SPDX-License-Identifier: Apache-2.0
// A map of the ground's albedo: where it lies, what it holds, and what it changes.
// in: small maps -> out: albedos at places, radiances by every method. docs/ground.md, "Map"
#include "kernels_cpu/light/ground.h"
#include "src/world/light/ground_look.h"
#include "tests/io/temp_folder.h"
#include "tests/support/render_harness.h"

using namespace pileus;
using namespace render_test;

namespace {

/// Columns from the west, rows from the north.
Image image_of(int width, int height, const std::vector<float>& numbers, int channels = 1) {
    Image image;
    image.width = width, image.height = height;
    const char* const names[] = {"R", "G", "B"};
    for (int c = 0; c < channels; ++c) {
        Channel channel;
        channel.name = channels == 1 ? "Y" : names[c];
        REQUIRE(channel.pixels.resize(std::uint64_t(width) * std::uint64_t(height), "test"));
        for (std::size_t i = 0; i < channel.pixels.size(); ++i)
            channel.pixels[i] = numbers[i * std::size_t(channels) + std::size_t(c)];
        image.channels.push_back(std::move(channel));
    }
    return image;
}

GroundLook look_of(const Image& image, const GroundSurface& surface) {
    GroundLook look;
    GroundSurface named = surface;
    named.map = "map";
    REQUIRE(make_ground_map("map", image, named, look));
    return look;
}

/// Media over all of the first map below.
const GroundStand kStand{{100, 200, 0}, {20, 10, 5}, {}, 0};

float albedo_at(const GroundPaint& paint, float x, float y, int level = 0) {
    float share[3];
    ground_share(paint, Vec<float>{x, y, 0}, level, share);
    return share[0] / paint.per_albedo;
}

constexpr const char* kGround = R"(
seed = 3
[camera]
position_m = [0, 0, 1000]
target_m = [0, 0, 0]
up = [0, 1, 0]
projection = "orthographic"
height_m = 40
resolution = [4, 4]
[sun]
elevation_deg = 60
[sky]
radiance = 0.1
[ground]
altitude_m = 0
albedo = 0.2
[method]
name = "raymarch"
[path]
samples_per_pixel = 400
importance = false
[[medium]]
density = "uniform:box"
bounds_m = [[-10, -10, 200], [10, 10, 220]]
resolution = [2, 2, 2]
extinction_per_m = 1e-9
)";

/// A map of 4 x 4 texels of 10 m: rising to the east, and brighter in the north.
Scene scene_over(const pileus::test::TempFolder& folder, const std::vector<std::string>& more) {
    std::string text = "Pf\n4 4\n-1\n";
    for (int y = 0; y < 4; ++y)  // rows of a PFM begin in the south
        for (int x = 0; x < 4; ++x) {
            const float v = 0.1f + 0.05f * float(x) + 0.15f * float(y);
            text.append(reinterpret_cast<const char*>(&v), sizeof v);
        }
    folder.put("map.pfm", text);
    std::vector<std::string> set = {"ground.map=map.pfm", "ground.map_low_m=[-20, -20]",
                                    "ground.map_size_m=[40, 40]"};
    set.insert(set.end(), more.begin(), more.end());
    Scene scene = scene_from(kGround, set);
    scene.directory = folder.path("");
    return scene;
}

/// Radiance over albedo, of land under that sun and sky.
const double kLit = 0.1 + std::sin(60 * 3.14159265358979 / 180) / 3.14159265358979;

}  // namespace

TEST_CASE("a map lies north up from its south-west corner, between texels it is linear") {
    GroundSurface surface;
    surface.map_low_m = {100, 200};
    surface.map_size_m = {20, 10};
    const GroundLook look = look_of(image_of(2, 2, {0.1f, 0.2f, 0.5f, 0.6f}), surface);
    const GroundPaint paint = make_paint(look, 0.3, ground_albedo(look, 0.3, kStand, 1), kStand, 0);
    CHECK(albedo_at(paint, 5, 7.5f) == doctest::Approx(0.1));  // north-west
    CHECK(albedo_at(paint, 15, 7.5f) == doctest::Approx(0.2));
    CHECK(albedo_at(paint, 5, 2.5f) == doctest::Approx(0.5));
    CHECK(albedo_at(paint, 10, 5) == doctest::Approx(0.35));
    CHECK(albedo_at(paint, 0, 0) == doctest::Approx(0.5));       // to its edges
    CHECK(albedo_at(paint, -0.1f, 5) == doctest::Approx(0.3));   // beyond it the ground's own
    CHECK(albedo_at(paint, 10, 5, 1) == doctest::Approx(0.35));  // one texel of all
    CHECK(ground_albedo(look, 0.3, kStand, 1).even == doctest::Approx(0.35));
}

TEST_CASE("media are lit by what lies below and around them, not by a map elsewhere") {
    GroundSurface surface;
    surface.map_low_m = {30000, 30000};
    surface.map_size_m = {1, 1};
    const GroundLook far = look_of(image_of(1, 1, {1.0f}), surface);
    CHECK(ground_albedo(far, 0.05, kStand, 1).even == doctest::Approx(0.05));
    // Half of what is below is the map.
    surface.map_low_m = {100, 200};
    surface.map_size_m = {10, 10};
    const GroundLook half = look_of(image_of(1, 1, {1.0f}), surface);
    CHECK(ground_albedo(half, 0.2, kStand, 1).even == doctest::Approx(0.6));
}

TEST_CASE("ground beyond a black map is what it is") {
    GroundSurface surface;
    surface.map_low_m = {100, 200};
    surface.map_size_m = {20, 10};
    for (const float black : {0.0f, 1e-42f}) {
        const GroundLook look = look_of(image_of(1, 1, {black}), surface);
        const GroundPaint paint =
            make_paint(look, 0.2, ground_albedo(look, 0.2, kStand, 1), kStand, 0);
        CHECK(albedo_at(paint, -5, 5) == doctest::Approx(0.2));
        CHECK(albedo_at(paint, 5, 5) == doctest::Approx(0).epsilon(1e-6));
    }
}

TEST_CASE("a map that repeats has no seam") {
    GroundSurface surface;
    surface.map_low_m = {100, 200};
    surface.map_size_m = {20, 10};
    surface.map_repeats = true;
    const GroundLook look = look_of(image_of(2, 2, {0.1f, 0.2f, 0.5f, 0.6f}), surface);
    const GroundPaint paint = make_paint(look, 0.3, ground_albedo(look, 0.3, kStand, 1), kStand, 0);
    for (const float x : {-400.0f, -20.0f, 0.0f, 20.0f, 1e5f})
        for (const float y : {-70.0f, 0.0f, 10.0f}) {
            CHECK(albedo_at(paint, x + 5, y + 2.5f) == doctest::Approx(0.5));
            CHECK(albedo_at(paint, x, y + 2.5f) == doctest::Approx(0.55));  // between the copies
            CHECK(albedo_at(paint, x + 5, y) == doctest::Approx(0.3));
        }
}

TEST_CASE("levels of maps of any size are means") {
    for (const int width : {1, 3, 5, 16})
        for (const int height : {1, 2, 7}) {
            std::vector<float> numbers(std::size_t(width) * std::size_t(height), 0.25f);
            GroundSurface surface;
            surface.map_low_m = {100, 200};
            surface.map_size_m = {10, 10};
            const GroundLook look = look_of(image_of(width, height, numbers), surface);
            const GroundPaint paint =
                make_paint(look, 0.25, ground_albedo(look, 0.25, kStand, 1), kStand, 0);
            for (int level = 0; level < look.map.levels; ++level)
                for (const float x : {0.0f, 3.3f, 10.0f})
                    CHECK(albedo_at(paint, x, 9.9f, level) == doctest::Approx(0.25));
        }
}

TEST_CASE("media that are turned and moved leave the map where it is") {
    GroundSurface surface;
    surface.map_low_m = {0, 0};
    surface.map_size_m = {20, 20};
    const GroundLook look = look_of(image_of(2, 2, {0.1f, 0.2f, 0.5f, 0.6f}), surface);
    GroundStand stand;
    stand.placement.offset_m = {100, 50, 0};
    stand.placement.yaw_deg = 90;
    stand.low_m = {7, -3, 0};
    const GroundPaint paint = make_paint(look, 0.3, ground_albedo(look, 0.3, stand, 1), stand, 0);
    // World (15, 15), less the offset (-85, -35), turned back by 90 degrees (-35, 85), less the
    // corner.
    CHECK(albedo_at(paint, -35 - 7, 85 + 3) == doctest::Approx(0.2));
}

TEST_CASE("numbers of a map beyond 0 to 1 are refused with their pixel") {
    GroundSurface surface;
    surface.map_size_m = {10, 10};
    GroundLook look;
    const Status status = make_ground_map("a.exr", image_of(2, 1, {0.1f, 1.5f}), surface, look);
    CHECK(status.message == "a.exr: pixel (1, 0) is 1.5, allowed: 0 to 1");
    CHECK(!make_ground_map("a.exr", image_of(1, 1, {__builtin_nanf("")}), surface, look));
}

TEST_CASE("methods show the map") {
    const pileus::test::TempFolder folder;
    for (const char* method : {"raymarch", "path", "collectors", "photon-grid", "optical-depth"}) {
        CAPTURE(method);
        const Scene scene = scene_over(folder, {std::string("method.name=") + method});
        const Picture p = render_one(scene);
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 4; ++x) {
                const double albedo = 0.1 + 0.05 * x + 0.15 * (3 - y);
                // Of paths 400 samples whose albedos are those of a whole texel.
                CHECK(double(p.at("G", x, y)) ==
                      doctest::Approx(albedo * kLit)
                          .epsilon(method[0] == 'p' && method[1] == 'a' ? 0.04 : 1e-3));
            }
    }
}

TEST_CASE("colours of the ground without a map") {
    const Picture p = render_one(scene_from(kGround, {"ground.colour=[0.5, 1, 2]"}));
    CHECK(double(p.at("R", 1, 1)) == doctest::Approx(0.1 * kLit).epsilon(1e-3));
    CHECK(double(p.at("B", 1, 1)) == doctest::Approx(0.4 * kLit).epsilon(1e-3));
    const Picture q =
        render_one(scene_from(kGround, {"ground.colour=[0.5, 1, 2]", "method.name=path"}));
    CHECK(double(q.at("R", 1, 1)) == doctest::Approx(0.1 * kLit).epsilon(0.02));
    CHECK(double(q.at("B", 1, 1)) == doctest::Approx(0.4 * kLit).epsilon(0.02));
}

TEST_CASE("faults of a map are told in one line") {
    const auto fault = [](const std::vector<std::string>& set) {
        Scene scene;
        return read_scene_text(kGround, "test.toml", "", set, scene).message;
    };
    CHECK(fault({"ground.map=a.exr"}).find("ground.map_size_m") != std::string::npos);
    CHECK(fault({"ground.map_low_m=[0, 0]"}).find("a ground without a map") != std::string::npos);
    CHECK(fault({"ground.map=a.gif", "ground.map_size_m=[1, 1]"}).find("unknown kind of picture") !=
          std::string::npos);
    CHECK(fault({"ground.map=a.exr", "ground.map_size_m=[0, 1]"}).find("map_size_m") !=
          std::string::npos);
    CHECK(fault({"ground.map=a.exr", "ground.map_size_m=[1, 1]", "ground.surface=sea"})
              .find("ground.map") != std::string::npos);
}
