// SPDX-License-Identifier: Apache-2.0
// Faults of the keys of many clouds, at their places.
// in: small scene texts with one fault each -> out: the expected line of the message.
// docs/scene.md, section Messages; docs/clouds.md.
#include "tests/cli/scene_faults.h"

namespace {

using namespace scene_faults;

/// Lines 1 to 3 a camera, 4 to 6 a kind "a", 7 on what is given.
std::string clouds(const std::string& more) {
    return kCamera + "[[clouds.kind]]\nname = \"a\"\nscene = \"a.toml\"\n" + more;
}
std::string scatter(const std::string& more) {
    return clouds("[[clouds.scatter]]\ncount = 9\nbase_m = [1, 2]\n" + more);
}
std::string place(const std::string& more) {
    return clouds("[[clouds.place]]\nkind = \"a\"\noffset_m = [0, 0, 0]\n" + more);
}

TEST_CASE("clouds: keys that are wrong") {
    const Row rows[] = {
        {kCamera + "[clouds.detail]\noff = true\n",
         "s.toml:4:1: clouds.kind: missing, nothing, allowed: kinds of clouds, each headed "
         "[[clouds.kind]], or layers, [[clouds.layer]]"},
        {kCamera + "[[clouds.layer]]\nset = []\n",
         "s.toml:4:1: clouds.layer.0.scene: missing, nothing, allowed: text"},
        {kCamera + "[[clouds.layer]]\nscene = \"a.toml\"\nkind = \"a\"\n",
         "s.toml:6:1: clouds.layer.0: unknown key, \"kind\", allowed: scene, set"},
        {kCamera + "[weather]\nmetar = \"EGLL 271020Z 24015KT CAVOK\"\n",
         "s.toml:5:9: atmosphere: missing, nothing, allowed with weather.metar: the table "
         "[atmosphere]"},
        {kCamera + "[atmosphere]\n[sun]\n[weather]\nmetar = \"EGLL 271020Z 99915KT CAVOK\"\n",
         "s.toml:7:9: weather.metar: ..."},
        {kCamera +
             "[atmosphere]\nturbidity = 3\n[sun]\n[weather]\nmetar = \"EGLL 271020Z CAVOK\"\n",
         "s.toml:5:1: atmosphere.turbidity: conflicts with weather.metar, which has the "
         "visibility, "
         "3, allowed: left out"},
        {kCamera + "[weather]\nseed = 3\n",
         "s.toml:5:8: weather.seed: without a report, 3, allowed: left out, or weather.metar"},
        {kCamera + "[[clouds.kind]]\nname = \"a\"\n",
         "s.toml:4:1: clouds.kind.0.scene: missing, nothing, allowed: text"},
        {clouds("sets = []\n"),
         "s.toml:7:1: clouds.kind.0: unknown key, \"sets\", allowed: name, scene, set"},
        {clouds("[[clouds.kind]]\nname = \"a\"\nscene = \"b.toml\"\n"),
         "s.toml:8:8: clouds.kind.1.name: given twice, \"a\", allowed: a name of its own"},
        {clouds("[[clouds.kind]]\nname = \"\"\nscene = \"b.toml\"\n"),
         "s.toml:8:8: clouds.kind.1.name: empty, \"\", allowed: a name of its own"},
        {clouds("[[clouds.kind]]\nname = \"b\"\nscene = \"${HOME}/b.toml\"\n"),
         "s.toml:9:9: clouds.kind.1.scene: unknown variable, ..."},
        {clouds("[[clouds.place]]\nkind = \"b\"\noffset_m = [0, 0, 0]\n"),
         "s.toml:8:8: clouds.place.0.kind: no such kind, \"b\", allowed: \"a\""},
        {clouds("[[clouds.place]]\nkind = \"a\"\noffset_m = [0, 0, nan]\n"),
         "s.toml:9:19: clouds.place.0.offset_m: not finite, nan, allowed: ..."},
        {place("yaw_deg = 361\n"),
         "s.toml:10:11: clouds.place.0.yaw_deg: out of range, 361, allowed: number in [-360, "
         "360]"},
        {place("scale = 0\n"),
         "s.toml:10:9: clouds.place.0.scale: out of range, 0, allowed: number in [0.01, 100]"},
        {scatter("kinds = [\"a\", \"b\"]\n"),
         "s.toml:10:15: clouds.scatter.0.kinds: no such kind, \"b\", allowed: \"a\""},
        {clouds("[[clouds.scatter]]\ncount = 1001\nbase_m = [1, 2]\n"),
         "s.toml:8:9: clouds.scatter.0.count: out of range, 1001, allowed: whole number in [1, "
         "1000]"},
        {scatter("[[clouds.scatter]]\ncount = 992\nbase_m = [1, 2]\n"),
         "s.toml:7:1: clouds.scatter: too many clouds in all, 1001, allowed: up to 1000"},
        {scatter("near_m = 9\nfar_m = 8.5\n"),
         "s.toml:11:9: clouds.scatter.0.far_m: not beyond near_m, 8.5, allowed: more than 9"},
        {scatter("near_m = nan\n"),
         "s.toml:10:10: clouds.scatter.0.near_m: not finite, nan, allowed: number in [1, 1000000]"},
        {clouds("[[clouds.scatter]]\ncount = 9\nbase_m = [2, 1]\n"),
         "s.toml:9:10: clouds.scatter.0.base_m: falling, [2, 1], allowed: the least first"},
        {clouds("[[clouds.scatter]]\ncount = 9\nbase_m = [-1, 2]\n[ground]\n"),
         "s.toml:9:10: clouds.scatter.0.base_m: below the ground, lowest z -1, allowed: at least "
         "ground.altitude_m 0"},
        {scatter("scale = [2, 1]\n"),
         "s.toml:10:9: clouds.scatter.0.scale: falling, [2, 1], allowed: the least first"},
        {scatter("yaw_steps = 0\n"),
         "s.toml:10:13: clouds.scatter.0.yaw_steps: out of range, 0, allowed: whole number in [1, "
         "360]"},
        {clouds("[clouds.detail]\nnear_scale = 3\n"),
         "s.toml:8:14: clouds.detail.near_scale: out of range, 3, allowed: 1, 2 or 4"},
        {clouds("[clouds.detail]\nerror_px = 17\n"),
         "s.toml:8:12: clouds.detail.error_px: out of range, 17, allowed: number in [0.001, 16]"},
        {clouds("[clouds.detail]\nnear = 3\n"),
         "s.toml:8:1: clouds.detail.near: unknown key, \"near\", allowed: off, error_px, ..."},
    };
    for (const Row& row : rows) check(row);
}

TEST_CASE("clouds: what a sky with clouds has not") {
    const Row rows[] = {
        {clouds(kMedium),
         "s.toml:7:1: medium.0: conflicts with [clouds], allowed: left out, in the scene of a "
         "kind"},
        {clouds("[[light]]\ntype = \"point\"\nposition_m = [0, 0, 9]\n"),
         "s.toml:7:1: light.0: conflicts with [clouds], allowed: left out"},
        {clouds("[method]\nname = \"path\"\n"),
         "s.toml:8:1: method.name: conflicts with [clouds], \"path\", allowed: left out"},
        {clouds("[sky]\nmap = \"a.exr\"\n"),
         "s.toml:8:1: sky.map: conflicts with [clouds], \"a.exr\", allowed: left out"},
        {kCamera + "depth = \"z.exr\"\n[[clouds.kind]]\nname = \"a\"\nscene = \"a.toml\"\n",
         "s.toml:4:1: camera.depth: conflicts with [clouds], \"z.exr\", allowed: left out"},
        {clouds("[output]\nlayers = [\"depth\", \"shadow\"]\n"),
         "s.toml:8:20: output.layers: not of a sky with [clouds], \"shadow\", allowed: radiance, "
         "alpha, depth, cloud"},
        {clouds("[animation]\nkeys = [{frame = 0, media_yaw_deg = 3}]\n"),
         "s.toml:8:21: animation.keys.0.media_yaw_deg: clouds stay where they are, 3, allowed: "
         "left out"},
    };
    for (const Row& row : rows) check(row);
}

TEST_CASE("clouds: overrides reach every key, and a struct is checked as a text is") {
    Scene scene;
    REQUIRE(pileus::read_scene_text(
        scatter("[[clouds.place]]\nkind = \"a\"\noffset_m = [1, 2, 3]\n"), "s.toml", "",
        {"clouds.scatter.0.count=50", "clouds.place.0.scale=2", "clouds.detail.off=true",
         "clouds.scatter.0.kinds=[a]", "clouds.kind.0.set=[\"seed=1\"]"},
        scene));
    CHECK(scene.clouds.scatters[0].count == 50);
    CHECK(scene.clouds.scatters[0].kinds == std::vector<std::string>{"a"});
    CHECK(scene.clouds.places[0].scale == 2);
    CHECK(scene.clouds.kinds[0].sets == std::vector<std::string>{"seed=1"});
    CHECK_FALSE(scene.clouds.detail.on);
    CHECK(pileus::check_scene(scene));
    scene.clouds.places[0].kind = "b";
    const Status status = pileus::check_scene(scene);
    CHECK(status.message == "s.toml: clouds.place.0.kind: no such kind, \"b\", allowed: \"a\"");
    CHECK(read(scatter(""), {"clouds.scatter.0.count=-1"}).message ==
          "--set clouds.scatter.0.count=-1: clouds.scatter.0.count: out of range, -1, allowed: "
          "whole number in [1, 1000]");
}

}  // namespace
