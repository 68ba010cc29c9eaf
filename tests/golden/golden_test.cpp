// SPDX-License-Identifier: Apache-2.0
// Stored digests of every stage of small scenes: the first difference names the guilty stage.
// in: assets/golden/golden.txt, assets/scenes/golden/*.toml -> out: equality, stage by stage.
// tools/golden accept SCENE --reason "..." is the only way to change a digest.
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "tests/support/render_harness.h"

using namespace render_test;

namespace {

const char* const kFolder = "assets/scenes/golden";

/// The stages of a method; a scene of a path tracing is told by its film.
std::vector<const char*> stages_of(const std::map<std::string, std::string>& stages) {
    if (stages.count("film") == 1) return {"density", "majorants", "film", "image"};
    // A grid of photons prepares no collectors, a raymarch shoots no photons either.
    if (stages.count("leaves") == 0 && stages.count("photons") == 1)
        return {"density", "photons", "colours", "image"};
    if (stages.count("particles") == 1) return {"density", "particles", "colours", "image"};
    if (stages.count("leaves") == 0) return {"density", "colours", "image"};
    return {"density", "leaves", "collectors", "photons", "colours", "image"};
}

using Stages = std::map<std::string, std::string>;  // stage -> digest

/// Lines "scene stage digest # reason"; empty lines and those that begin with # are skipped.
std::map<std::string, Stages> read_golden() {
    std::ifstream file("assets/golden/golden.txt");
    REQUIRE_MESSAGE(file, "assets/golden/golden.txt; run from the repository's root");
    std::map<std::string, Stages> golden;
    std::string line;
    while (std::getline(file, line)) {
        if (line.empty() || line[0] == '#') continue;
        std::istringstream words(line);
        std::string scene, stage, digest, hash, reason;
        words >> scene >> stage >> digest >> hash >> reason;
        REQUIRE_MESSAGE((hash == "#" && !reason.empty()), line, ": no reason");
        REQUIRE_MESSAGE(digest.size() == 16, line);
        REQUIRE_MESSAGE(golden[scene].emplace(stage, digest).second, line, ": twice");
    }
    return golden;
}

std::set<std::string> scene_names() {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(kFolder))
        if (entry.path().extension() == ".toml") names.insert(entry.path().stem().string());
    return names;
}

Stages render_stages(const std::string& name) {
    Scene scene;
    const std::string path = std::string(kFolder) + "/" + name + ".toml";
    const Status status = read_scene_file(path, {}, scene);
    REQUIRE_MESSAGE(status, status.message);
    const Picture p = render_one(scene);
    return {p.report.digests.begin(), p.report.digests.end()};
}

}  // namespace

TEST_CASE("golden: every scene has a digest for every stage, and no digest lacks its scene") {
    const auto golden = read_golden();
    const std::set<std::string> names = scene_names();
    CHECK(names.size() >= 8);
    for (const std::string& name : names) CHECK_MESSAGE(golden.count(name) == 1, name);
    for (const auto& scene : golden) {
        CHECK_MESSAGE(names.count(scene.first) == 1, scene.first);
        const auto stages = stages_of(scene.second);
        for (const char* stage : stages)
            CHECK_MESSAGE(scene.second.count(stage) == 1, (scene.first + " " + stage));
        CHECK(scene.second.size() == stages.size());
    }
}

TEST_CASE("golden: every stage gives its stored digest") {
    for (const auto& scene : read_golden()) {
        const Stages now = render_stages(scene.first);
        for (const char* stage : stages_of(scene.second)) {
            const auto stored = scene.second.find(stage);
            const auto found = now.find(stage);
            REQUIRE(found != now.end());
            if (stored != scene.second.end() && stored->second == found->second) continue;
            // Later stages follow from this one: name the first alone.
            FAIL_CHECK(scene.first, ": first difference at stage ", std::string(stage), ", now ",
                       found->second);
            break;
        }
    }
}
