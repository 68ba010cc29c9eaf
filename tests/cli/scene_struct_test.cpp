// SPDX-License-Identifier: Apache-2.0
// A scene that a program has filled in passes the checks of one that was read, with the same words.
// in: structs -> out: the lines of their faults.
// docs/scene.md, section Messages.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "src/methods/registry.h"
#include "src/scene/keys/all_keys.h"
#include "src/scene/read_scene.h"
#include "src/scene/rows/density_row.h"

namespace {

using namespace pileus;

/// One of everything, sound.
Scene whole_scene() {
    Scene scene;
    scene.media.emplace_back();
    scene.media[0].density = "uniform:box";
    scene.media[0].box.has_bounds = true;
    scene.media[0].box.bounds_m = {Double3{0, 0, 0}, Double3{1, 1, 1}};
    scene.media[0].optics.extinction_per_m = 1;
    scene.solids.emplace_back();
    scene.solids[0].file = "a.ply";
    return scene;
}

/// Of every method of this version.
std::string method_names() {
    std::string names;
    for (const ListedMethod& listed : listed_methods())
        names += (names.empty() ? "" : ", ") + std::string(listed.row.name);
    return names;
}

/// A number just outside the row's range, in the shape of its kind; nothing for other kinds.
Node beyond(const KeyRow& row, bool high) {
    const KeyRange& r = row.allowed.range;
    const bool whole = row.kind() == KeyKind::kInteger || row.kind() == KeyKind::kInteger2 ||
                       row.kind() == KeyKind::kInteger3 || row.kind() == KeyKind::kInteger4;
    const double wrong = high ? r.high + std::fmax(1.0, std::fabs(r.high) * 1e-6) : r.low - 2;
    if (whole && std::fabs(wrong) > 2147483647.0) return no_value();
    const Node one = whole ? node_of(std::int64_t(wrong)) : node_of(wrong);
    Node list;
    list.kind = NodeKind::kArray;
    switch (row.kind()) {
        case KeyKind::kInteger:
        case KeyKind::kNumber:
            return one;
        case KeyKind::kInteger2:
        case KeyKind::kNumber2:
            list.children = {one, one};
            return list;
        case KeyKind::kInteger4:
            list.children = {one, one, one, one};
            return list;
        case KeyKind::kInteger3:
        case KeyKind::kNumber3:
        case KeyKind::kColor:
            list.children = {one, one, one};
            return list;
        default:
            return no_value();
    }
}

TEST_CASE("structs: each number beyond its row's range is a fault that names the key") {
    int tried = 0;
    for (const KeyRow* row : all_scene_keys()) {
        for (const bool high : {false, true}) {
            const Node wrong = beyond(*row, high);
            if (!has_value(wrong) || row->field.set == nullptr) continue;
            Scene scene = whole_scene();
            scene.lights.emplace_back();
            set_value(*row, {scene, scene.media[0], scene.solids[0], scene.lights[0]}, wrong);
            std::string path = row->path;
            const std::size_t n = path.find(".N.");
            if (n != std::string::npos) path.replace(n + 1, 1, "0");
            CAPTURE(path);
            const Status status = check_scene(scene);
            CHECK(status.code == Code::kBadInput);
            CHECK_MESSAGE(
                status.message.find("scene: " + path + ": out of range, ") != std::string::npos,
                status.message);
            CHECK(status.message.find("allowed: " + allowed_text(*row)) != std::string::npos);
            ++tried;
        }
    }
    CHECK(tried > 150);
}

TEST_CASE("structs: laws between keys speak as they do of a file") {
    const auto fault = [](void (*spoil)(Scene&)) {
        Scene scene = whole_scene();
        spoil(scene);
        return check_scene(scene).message;
    };
    CHECK(fault([](Scene&) {}) == "");
    CHECK(bool(check_scene(Scene())));
    CHECK(fault([](Scene& s) { s.camera.target_m = s.camera.position_m; }) ==
          "scene: camera.target_m: same as position_m, [0, -3000, 600], allowed: any other point");
    CHECK(fault([](Scene& s) {
              s.file = "host";
              s.camera.orthographic = true;
              s.camera.fov_deg = 30;
          }) ==
          "host: camera.fov_deg: conflicts with projection \"orthographic\", 30, allowed: left "
          "out");
    CHECK(fault([](Scene& s) { s.media[0].box.has_bounds = false; }) ==
          "scene: medium.0.bounds_m: missing, nothing, allowed: [[x, y, z], [x, y, z]], the lowest "
          "and highest corner in metres");
    CHECK(
        fault([](Scene& s) { s.media[0].optics.phase.type = "hg-draine"; }) ==
        "scene: medium.0.phase.droplet_diameter_um: missing, nothing, allowed: a number, required "
        "by \"hg-draine\"");
    // A g of 0 may be meant.
    CHECK(fault([](Scene& s) { s.media[0].optics.phase.type = "henyey-greenstein"; }) == "");
    CHECK(fault([](Scene& s) {
              s.media[0].optics.phase.type = "two-lobe";
              s.media[0].optics.phase.numbers = {{"g", 0.5}, {"g1", 0.8}, {"weight", 2}};
          }) ==
          "scene: medium.0.phase.weight: out of range, 2, allowed: number in [0, 1]\n"
          "scene: medium.0.phase.g: conflicts with phase.type \"two-lobe\", 0.5, allowed: left "
          "out");
    const std::string unknown =
        fault([](Scene& s) { s.media[0].optics.phase.numbers["G1"] = 0.5; });
    CHECK(unknown.find("scene: medium.0.phase.numbers: unknown key, \"G1\", allowed: g, g1, ") ==
          0);
    CHECK(unknown.find("; did you mean g1?") != std::string::npos);
    CHECK(fault([](Scene& s) {
              s.media[0].optics.phase.type = "mie";
          }).find("scene: medium.0.phase.type: unknown value, \"mie\", allowed: isotropic, ") == 0);
    CHECK(fault([](Scene& s) { s.media[0].density.clear(); }) ==
          "scene: medium.0.density: empty, \"\", allowed: the path of a file");
    CHECK(fault([](Scene& s) { s.media[0].density = "uniform:cone"; }) ==
          "scene: medium.0.density: unknown value, \"uniform:cone\", allowed: " + density_names() +
              ", the path of a file, or a table");
    CHECK(fault([](Scene& s) { s.media[0].density = "cloud.vdb"; }) ==
          "scene: medium.0.density: unknown value, \"cloud.vdb\", allowed: " + density_names() +
              ", or nothing beside the path of a file");
    CHECK(fault([](Scene& s) {
              s.media[0].density.clear();
              s.media[0].source.file = "a.raw";
              s.media[0].source.format = "raw";
          }) ==
          "scene: medium.0.density.size: missing, nothing, allowed: density = { file = \"...\", "
          "type = \"float32\", size = [nx, ny, nz] }");
    CHECK(fault([](Scene& s) { s.method = "radiosity"; }) ==
          "scene: method.name: unknown value, \"radiosity\", allowed: " + method_names());
    CHECK(fault([](Scene& s) { s.sun.elevation_deg = std::nan(""); }) ==
          "scene: sun.elevation_deg: not finite, nan, allowed: number in [-90, 90]");
    CHECK(fault([](Scene& s) { s.output.files = {"a.jpg"}; }) ==
          "scene: output.files: unknown kind of picture, \"a.jpg\", allowed: .exr, .png, .pfm, "
          ".ppm, .nc");
}

TEST_CASE("structs: what reading leaves behind is sound") {
    const char* before = std::getenv("PILEUS_DATA_DIR");
    if (before == nullptr) setenv("PILEUS_DATA_DIR", "/data", 1);
    for (const char* name : {"cumulus", "smoke_day", "rico", "stratocumulus", "vdb_cloud"}) {
        CAPTURE(name);
        Scene scene;
        const Status read =
            read_scene_file("assets/scenes/" + std::string(name) + ".toml", {}, scene);
        REQUIRE_MESSAGE(bool(read), read.message);
        const Status status = check_scene(scene);
        CHECK_MESSAGE(bool(status), status.message);
        CHECK(scene.places.at("camera.position_m").find(scene.file + ":") == 0);
    }
    if (before == nullptr) unsetenv("PILEUS_DATA_DIR");
}

}  // namespace
