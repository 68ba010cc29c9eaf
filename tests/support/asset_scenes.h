// SPDX-License-Identifier: Apache-2.0
// Every scene of assets/scenes, rendered small through the library.
// in: whether those that need PILEUS_DATA_DIR are meant -> out: checks.
// docs/testing.md, labels cli and shared
#pragma once
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "src/scene/read_scene.h"
#include "src/session/render.h"

namespace asset_scenes {

/// Paths in order of their names; the tests run in the root of the sources.
inline std::vector<std::string> find(bool with_data) {
    std::vector<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator("assets/scenes")) {
        if (entry.path().extension() != ".toml") continue;
        std::ostringstream text;
        text << std::ifstream(entry.path()).rdbuf();
        // tests/weather/made_test.cpp has those of the forecast that tools/make_weather makes.
        if (text.str().find("out/weather_made.nc") != std::string::npos) continue;
        const bool needs = text.str().find("\"${PILEUS_DATA_DIR}") != std::string::npos;
        if (needs == with_data) found.push_back(entry.path().string());
    }
    std::sort(found.begin(), found.end());
    return found;
}

/// Prepares the scene in full, limits and all, and shoots few photons for a small picture.
inline void check_renders(const std::string& file) {
    INFO(file);
    pileus::Scene scene;
    const pileus::Status read =
        pileus::read_scene_file(file,
                                {"camera.resolution=[32, 18]", "collectors.photons=2000",
                                 "photon_grid.photons=2000", "raymarch.steps=64"},
                                scene);
    INFO(read.message);
    REQUIRE(read);
    bool clouds = false;
    const auto sink = [&](int, pileus::Image& image, pileus::Report& report) {
        for (float alpha : image.find("A")->pixels.span()) clouds |= alpha > 0.5f;
        // Other pictures scatter nothing: they add up.
        if (scene.method == "collectors" || scene.method == "photon-grid" || scene.method == "path")
            CHECK(report.events.scatterings > 0);
        for (const pileus::EnergyRow& row : report.photons.energy) CHECK(row.balance_quanta == 0);
        return pileus::Status::ok();
    };
    const pileus::Status status = pileus::render(scene, {}, sink);
    INFO(status.message);
    REQUIRE(status);
    // A sky in which others stand has none.
    CHECK(clouds == !scene.media.empty());
}

}  // namespace asset_scenes
