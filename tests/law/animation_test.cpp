// SPDX-License-Identifier: Apache-2.0
// Keys of animations: what a track is between them, and that a frame is the picture of a scene that
// has its values written down.
// in: keys, a small cumulus -> out: numbers, hashes.
// docs/animation.md
#include "src/scene/animation.h"

#include <limits>

#include "src/scene/frames.h"
#include "src/session/session.h"
#include "tests/io/temp_folder.h"
#include "tests/support/render_harness.h"

using namespace render_test;

namespace {

AnimationKey hours_key(int frame, double hours, KeyWay way = KeyWay::kSmooth) {
    AnimationKey key;
    key.frame = frame, key.way = way;
    key.given[std::size_t(Track::kHours)] = true;
    key.numbers[std::size_t(kTracks[int(Track::kHours)].first)] = hours;
    return key;
}
double hours_of(const Animation& a, int frame) {
    double v = -1;
    REQUIRE(track_at(a, Track::kHours, frame, &v));
    return v;
}

/// Of all frames, or of one that the film begins with.
std::vector<std::string> hashes_of(Scene scene, int frame = -1) {
    scene.output.layer_error = false;
    std::vector<std::string> hashes;
    RenderOptions options;
    options.first_frame = std::max(frame, 0);
    options.last_frame = frame < 0 ? scene.animation.frames - 1 : frame;
    const Status status = render(scene, options, [&](int, Image& image, Report&) {
        hashes.push_back(image.pixel_hash);
        return Status::ok();
    });
    REQUIRE_MESSAGE(status, status.message);
    return hashes;
}

constexpr const char* kFilm = R"(
[animation]
frames = 5
keys = [
  { frame = 0, camera_position_m = [16, -4000, 256], camera_fov_deg = 40, way = "linear" },
  { frame = 4, camera_position_m = [1040, -3488, 512], camera_target_m = [0, 0, 1024], camera_fov_deg = 32 },
]
)";

}  // namespace

TEST_CASE("animation: a track goes through its keys, and between them as they say") {
    Animation a;
    a.present = true;
    double none = 7;
    CHECK_FALSE(track_at(a, Track::kHours, 3, &none));
    CHECK(none == 7);
    a.keys = {hours_key(2, 5), hours_key(4, 9, KeyWay::kLinear), hours_key(8, 1, KeyWay::kStep),
              hours_key(10, 3)};
    // A key without the track is none of it.
    AnimationKey other;
    other.frame = 6;
    a.keys.insert(a.keys.begin() + 2, other);
    const double wanted[] = {5, 5, 5, -1, 9, 7, 5, 3, 1, 1, 3, 3};
    for (int f = 0; f < 12; ++f)
        if (wanted[f] >= 0) CHECK(hours_of(a, f) == wanted[f]);
    // One key stands for all frames.
    a.keys = {hours_key(3, 2)};
    for (const int f : {0, 3, 1000000}) CHECK(hours_of(a, f) == 2);
}

TEST_CASE("animation: smooth ways have no kink, follow parabolas, and numbers stay between keys") {
    Animation a;
    a.present = true;
    // Of a parabola the inner ways of a place are exact.
    for (const int f : {0, 10, 40, 60, 100}) {
        AnimationKey key;
        key.frame = f;
        key.given[std::size_t(Track::kTarget)] = true;
        key.numbers[std::size_t(kTracks[int(Track::kTarget)].first + 1)] = 0.5 * f * f - 30 * f;
        a.keys.push_back(key);
    }
    for (int f = 10; f <= 60; ++f) {
        double place[3];
        REQUIRE(track_at(a, Track::kTarget, f, place));
        CHECK(place[1] == doctest::Approx(0.5 * f * f - 30 * f).epsilon(1e-12));
        CHECK(place[0] == 0);
    }
    // Steps of one frame hardly change at a key: the slope is the same on both sides.
    a.keys = {hours_key(0, 0), hours_key(1000, 2), hours_key(3000, -1), hours_key(4000, 5)};
    for (const int f : {1000, 3000}) {
        const double before = hours_of(a, f) - hours_of(a, f - 1);
        const double after = hours_of(a, f + 1) - hours_of(a, f);
        // The curvature is at most some 6 / 1000^2 a frame.
        CHECK(std::abs(after - before) < 4e-5);
    }
    // Between two keys it only rises or only falls.
    for (int f = 1; f <= 4000; ++f)
        REQUIRE((hours_of(a, f) >= hours_of(a, f - 1)) == (f <= 1000 || f > 3000));
}

TEST_CASE("animation: a keyed frame is the picture of a scene with its values") {
    for (const char* method : {"raymarch", "collectors", "photon-grid", "path", "optical-depth"}) {
        CAPTURE(method);
        const std::vector<std::string> set = {std::string("method.name=") + method,
                                              "path.samples_per_pixel=2",
                                              "output.layers=[\"radiance\", \"alpha\"]"};
        const std::vector<std::string> film =
            hashes_of(scene_from(kSmallCumulus + std::string(kFilm), set));
        REQUIRE(film.size() == 5);
        for (const int f : {0, 1, 3, 4}) {
            std::vector<std::string> still = set;
            const double t = f / 4.0;
            still.push_back("animation.frames=5");
            still.push_back("camera.position_m=[" + std::to_string(16 + 1024 * t) + ", " +
                            std::to_string(-4000 + 512 * t) + ", " + std::to_string(256 + 256 * t) +
                            "]");
            still.push_back("camera.fov_deg=" + std::to_string(40 - 8 * t));
            CAPTURE(f);
            CHECK(hashes_of(scene_from(kSmallCumulus, still), f).at(0) == film[std::size_t(f)]);
            // Wherever the film begins.
            CHECK(hashes_of(scene_from(kSmallCumulus + std::string(kFilm), set), f).at(0) ==
                  film[std::size_t(f)]);
        }
    }
}

TEST_CASE("animation: a sun of keys is that of ranges, and rings begin anywhere") {
    const std::string by_range =
        kSmallCumulus + std::string("[animation]\nframes = 5\nsun_elevation_deg = [35, 15]\n");
    const std::string by_keys = kSmallCumulus + std::string(
                                                    "[animation]\nframes = 5\nkeys = [{frame = 0, "
                                                    "way = \"linear\", sun_elevation_deg = 35}, "
                                                    "{frame = 4, sun_elevation_deg = 15}]\n");
    const std::string turning =
        kSmallCumulus +
        std::string(
            "[[light]]\ntype = \"point\"\nposition_m = [0, -900, 900]\nintensity = 1e6\n"
            "[animation]\nframes = 5\nkeys = [{frame = 0, sun_azimuth_deg = 120, media_offset_m = "
            "[0, 0, 0], media_yaw_deg = 0}, {frame = 4, sun_azimuth_deg = 200, media_offset_m = "
            "[100, 50, 25], media_yaw_deg = 30}]\n");
    for (const char* method : {"raymarch", "collectors", "photon-grid", "path"}) {
        CAPTURE(method);
        const std::vector<std::string> set = {std::string("method.name=") + method,
                                              "path.samples_per_pixel=1",
                                              "raymarch.light_refresh=3", "photon_grid.ring=true"};
        CHECK(hashes_of(scene_from(by_range, set)) == hashes_of(scene_from(by_keys, set)));
        const std::vector<std::string> film = hashes_of(scene_from(turning, set));
        for (const int f : {1, 4}) {
            CHECK(hashes_of(scene_from(turning, set), f).at(0) == film[std::size_t(f)]);
        }
        CHECK(film[0] != film[4]);
    }
}

TEST_CASE("animation: media that move with the camera, the ground and the sun are as they were") {
    // By powers of two and a quarter of a turn, so that no number is rounded.
    const char* moved =
        "[animation]\nframes = 2\nkeys = [{frame = 0, way = \"step\", media_yaw_deg = 0}, {frame = "
        "1, "
        "media_offset_m = [512, 256, 128], media_yaw_deg = 90, camera_position_m = "
        "[4512, 272, 384], camera_target_m = [512, 256, 1152], sun_azimuth_deg = 30}]\n";
    const std::vector<std::string> set = {"method.name=raymarch"};
    Scene film = scene_from(kSmallCumulus + std::string(moved), set);
    film.ground.present = false;
    const std::vector<std::string> found = hashes_of(film, 1);
    Scene still = scene_from(kSmallCumulus + std::string("[animation]\nframes = 2\n"), set);
    still.ground.present = false;
    CHECK(found == hashes_of(still, 1));
    // And alone they are elsewhere.
    const char* alone =
        "[animation]\nframes = 2\nkeys = [{frame = 1, media_offset_m = [512, 0, 0]}]\n";
    Scene shifted = scene_from(kSmallCumulus + std::string(alone), set);
    Scene counter = scene_from(kSmallCumulus + std::string("[animation]\nframes = 2\n"), set);
    counter.camera.position_m[0] -= 512, counter.camera.target_m[0] -= 512;
    CHECK(hashes_of(shifted) == hashes_of(counter));
}

TEST_CASE("animation: particles that move past a lamp are lit from where it is now") {
    const std::string cloud = R"(
[camera]
position_m = [0, -4096, 512]
target_m = [0, 0, 512]
fov_deg = 30
resolution = [16, 12]
[[medium]]
density = "procedural:particle-cumulus"
particle_cumulus = { particles = 500 }
bounds_m = [[-400, -400, 0], [400, 400, 1000]]
extinction_per_m = 0.01
[[light]]
type = "point"
position_m = [-1024, 0, 512]
intensity = 1e6
[method]
name = "particles"
[animation]
frames = 2
)";
    const Scene film =
        scene_from(cloud +
                   "keys = [{frame = 0, way = \"step\", media_offset_m = [0, 0, 0]}, {frame = 1, "
                   "media_offset_m = [512, 0, 0]}]\n");
    const std::vector<std::string> frames = hashes_of(film);
    CHECK(frames.at(1) == hashes_of(film, 1).at(0));
    // The same to the bit: all else has moved the other way.
    Scene counter = scene_from(cloud);
    counter.camera.position_m[0] -= 512, counter.camera.target_m[0] -= 512;
    counter.lights[0].position_m[0] -= 512;
    CHECK(frames[1] == hashes_of(counter, 1).at(0));
    CHECK(frames[0] == hashes_of(scene_from(cloud), 0).at(0));
}

TEST_CASE("animation: winds and hours of keys are those of the scene at their values") {
    const std::string sky = R"(
[camera]
position_m = [0, 0, 10]
target_m = [0, 1000, 400]
resolution = [16, 9]
[sun]
elevation_deg = 40
[[medium]]
density = "procedural:sky"
bounds_m = [[-4000, -4000, 500], [4000, 4000, 1500]]
extinction_per_m = 0.01
[medium.sky]
wind_m_per_s = [20, 5]
[method]
name = "raymarch"
)";
    const std::vector<std::string> film = hashes_of(scene_from(
        sky +
        "[animation]\nframes = 3\nkeys = [{frame = 0, wind_s = 0, way = \"linear\"}, {frame = 2, "
        "wind_s = 60}]\n"));
    const std::vector<std::string> still =
        hashes_of(scene_from(sky + "[animation]\nframes = 3\n", {"medium.0.sky.time_s=30"}), 1);
    CHECK(film.at(1) == still.at(0));
    CHECK(film[0] != film[1]);

    std::string day = kSmallCumulus;
    for (const char* gone : {"[sun]\nazimuth_deg = 120\nelevation_deg = 35\n",
                             "[sky]\nradiance = [0.0625, 0.125, 0.25]\n"})
        day.erase(day.find(gone), std::string(gone).size());
    day +=
        "[atmosphere]\ndate = 2026-06-21\nlatitude_deg = 47\nlongitude_deg = 11\n"
        "[animation]\nframes = 3\n";
    const std::vector<std::string> set = {"method.name=raymarch"};
    CHECK(hashes_of(scene_from(day + "hours = [-4, 4]\n", set)) ==
          hashes_of(scene_from(day + "keys = [{frame = 0, hours = -4, way = \"linear\"}, "
                                     "{frame = 2, hours = 4}]\n",
                               set)));
}

TEST_CASE("animation: in air a sun whose elevation alone has keys keeps its azimuth") {
    std::string air = kSmallCumulus;
    const std::string sky = "[sky]\nradiance = [0.0625, 0.125, 0.25]\n";
    air.replace(air.find(sky), sky.size(), "[atmosphere]\n");
    const std::vector<std::string> set = {"method.name=raymarch"};
    const std::string still = hashes_of(scene_from(air, set)).at(0);
    const std::string film =
        "[animation]\nframes = 2\nkeys = [{frame = 0, sun_elevation_deg = 35}, ";
    CHECK(hashes_of(scene_from(air + film + "{frame = 1, sun_elevation_deg = 60}]\n", set), 0)
              .at(0) == still);
}

TEST_CASE("animation: each frame has a depth image of its own") {
    const test::TempFolder folder;
    const auto put = [&](const char* name, float metres) {
        std::string text = "Pf\n24 14\n-1.0\n";
        for (int i = 0; i < 24 * 14; ++i) text.append(reinterpret_cast<const char*>(&metres), 4);
        folder.put(name, text);
    };
    put("depth_00.pfm", std::numeric_limits<float>::infinity());
    put("depth_01.pfm", 3700.0f);
    put("depth_02.pfm", 1.0f);
    const std::string text =
        kSmallCumulus + std::string("[animation]\nframes = 3\ncamera_orbit_deg = [0, 20]\n");
    for (const char* method : {"raymarch", "collectors", "path"}) {
        const std::vector<std::string> set = {
            std::string("method.name=") + method, "path.samples_per_pixel=1",
            "camera.depth=\"" + folder.path("depth_##.pfm") + "\""};
        const std::vector<std::string> film = hashes_of(scene_from(text, set));
        REQUIRE(film.size() == 3);
        std::vector<std::string> free = set;
        free.back() = "method.name=" + std::string(method);
        CHECK(film[0] == hashes_of(scene_from(text, free))[0]);
        CHECK(film[1] != hashes_of(scene_from(text, free))[1]);
        CHECK(film[1] == hashes_of(scene_from(text, set), 1).at(0));
    }
}

TEST_CASE("animation: light towards one camera does not go with keys that move it, or the media") {
    for (const char* track : {"camera_fov_deg = 9", "camera_position_m = [16, -4000, 300]",
                              "media_offset_m = [0, 9, 0]", "media_yaw_deg = 9"})
        for (const char* method : {"collectors", "photon-grid"}) {
            CAPTURE(track);
            Scene scene = scene_from(
                kSmallCumulus + std::string("[animation]\nframes = 2\nkeys = [{frame = 0, ") +
                    track + "}]\n",
                {std::string("method.name=") + method, "collectors.closure=\"camera\"",
                 "photon_grid.closure=\"camera\""});
            const Status status =
                render(scene, {}, [](int, Image&, Report&) { return Status::ok(); });
            CHECK(status.code == Code::kBadInput);
            CHECK_MESSAGE(status.message.find("but animation.keys moves it") != std::string::npos,
                          status.message);
        }
}
