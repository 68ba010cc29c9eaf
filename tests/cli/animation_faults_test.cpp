// SPDX-License-Identifier: Apache-2.0
// Faults of the keys of animations, at their places.
// in: small scene texts with one fault each -> out: the expected line of the message.
// docs/scene.md, section Messages; docs/animation.md.
#include "tests/cli/scene_faults.h"

namespace {

using namespace scene_faults;

std::string keys(const std::string& list) {
    return kCamera + "[animation]\nframes = 9\nkeys = [" + list + "]\n";
}

TEST_CASE("animation: keys that are wrong, or move what is not there") {
    const Row rows[] = {
        {keys(""), "s.toml:6:8: animation.keys: wrong length, 0 rows, allowed: ..."},
        {keys("{hours = 1}"), "s.toml:6:9: animation.keys.0.frame: missing, nothing, allowed: ..."},
        {keys("{frame = -1}"),
         "s.toml:6:18: animation.keys.0.frame: out of range, -1, allowed: whole number in [0, "
         "1000000]"},
        {keys("{frame = 4}, {frame = 4}"),
         "s.toml:6:31: animation.keys.1.frame: not rising, 4, allowed: more than 4, that of the "
         "row "
         "before"},
        {keys("{frame = 4, way = \"fast\"}"),
         "s.toml:6:27: animation.keys.0.way: unknown value, \"fast\", allowed: smooth, linear, "
         "step"},
        {keys("{frame = 4, camera_fov = 3}"),
         "s.toml:6:21: animation.keys.0: unknown key, \"camera_fov\", allowed: ..."},
        {keys("{frame = 4, camera_fov_deg = 180}"),
         "s.toml:6:38: animation.keys.0.camera_fov_deg: out of range, 180, allowed: number in "
         "[1e-06, "
         "180)"},
        {keys("{frame = 4, camera_position_m = [1, 2]}"),
         "s.toml:6:41: animation.keys.0.camera_position_m: wrong length, ..."},
        {keys("{frame = 1}, {frame = 4, sun_elevation_deg = 3}"),
         "s.toml:6:34: animation.keys.1.sun_elevation_deg: conflicts with a scene without a sun, "
         "3, "
         "allowed: left out"},
        {keys("{frame = 4, hours = 3}"),
         "s.toml:6:21: animation.keys.0.hours: conflicts with a scene without atmosphere.date, 3, "
         "allowed: left out"},
        {keys("{frame = 4, wind_s = 3}"),
         "s.toml:6:21: animation.keys.0.wind_s: conflicts with a scene without a procedural sky, "
         "a cloud with an age_s or a sea, 3, allowed: left out"},
        {keys("{frame = 4, sun_elevation_deg = 3}") + "sun_elevation_deg = [3, 4]\n[sun]\n",
         "s.toml:6:21: animation.keys.0.sun_elevation_deg: conflicts with "
         "animation.sun_elevation_deg, 3, allowed: left out"},
        {kCamera + "projection = \"orthographic\"\n[animation]\nkeys = [{frame = 0, camera_fov_deg "
                   "= 9}]\n",
         "s.toml:6:21: animation.keys.0.camera_fov_deg: conflicts with parallel rays, 9, allowed: "
         "left out"},
        {kCamera + "depth = \"z.exr\"\n[animation]\nkeys = [{frame = 0, camera_fov_deg = 9}]\n",
         "s.toml:6:1: animation.keys: conflicts with camera.depth, which one camera sees where its "
         "name has no #, ..., allowed: left out"},
        // From (0, -9, 5) over the target to the other side, and from above it.
        {keys("{frame = 0, way = \"linear\", camera_position_m = [0, -9, 5]}, {frame = 8, "
              "camera_position_m = [0, 9, 5]}"),
         "s.toml:6:8: animation.keys: frame 4, the camera is at its target, allowed: anywhere "
         "else"},
        {keys("{frame = 7, camera_position_m = [0, 0, 9]}"),
         "s.toml:6:8: animation.keys: frame 0, the view is along camera.up, allowed: any direction "
         "across it"},
        {keys("{frame = 0, way = \"linear\", camera_position_m = [0, -9, 5]}, {frame = 8, "
              "camera_position_m = [0, -9, -3]}") +
             "[ground]\naltitude_m = 0\n",
         "s.toml:6:8: animation.keys: frame 6, the camera is below the ground, z -1, allowed: at "
         "least ground.altitude_m 0"},
        {keys("{frame = 0, media_yaw_deg = 9}") + "[sun]\n[atmosphere]\n",
         "s.toml:6:21: animation.keys.0.media_yaw_deg: not below a sky that is not even, 9, "
         "allowed: "
         "left out"},
    };
    for (const Row& row : rows) check(row);
    // Lists of tables with heads of their own are the same.
    CHECK(read(kCamera + "[[animation.keys]]\nframe = 0\ncamera_fov_deg = 9\n[[animation.keys]]\n"
                         "frame = 90\ncamera_fov_deg = 20\n"));
    // Keys beyond the last frame wait for longer films.
    CHECK(read(keys("{frame = 4}, {frame = 1000000, camera_fov_deg = 9}")));
}

TEST_CASE("animation: many keys and many frames are checked in a moment") {
    std::string list;
    for (int i = 0; i < 1000; ++i)
        list += (i > 0 ? ", {frame = " : "{frame = ") + std::to_string(900 * i) +
                ", camera_position_m = [" + std::to_string(i) + ", -9, 5]}";
    CHECK(read(keys(list), {"animation.frames=1000000"}));
    CHECK_FALSE(read(keys(list + ", {frame = 999999}")));
}

}  // namespace
