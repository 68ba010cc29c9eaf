// SPDX-License-Identifier: Apache-2.0
// Lenticularis: the box holds it for any wind, plates lie upon one another, the lee side is longer.
// in: scenes with altocumulus-lenticularis -> out: pass or fail.
// docs/generators.md, "Lenses"
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "src/scene/read_scene.h"
#include "src/world/density/cloud.h"

using namespace pileus;

namespace {

constexpr int kLensCells = 72;

std::string read(const std::string& keys, const std::string& lines, MediumSettings& medium) {
    Scene scene;
    const Status status = read_scene_text(
        "[camera]\nposition_m = [0, -9000, 5000]\ntarget_m = [0, 0, 5000]\n[[medium]]\n"
        "density = \"procedural:cloud\"\ncloud = { type = \"altocumulus-lenticularis\"" +
            keys + " }\n" + lines,
        "s.toml", "", {}, scene);
    if (status) medium = scene.media[0];
    return status.message;
}

Volume made(const MediumSettings& medium) {
    Volume volume;
    REQUIRE(make_cloud(medium, {{kLensCells, kLensCells, kLensCells}, *kernel_table(nullptr), 0},
                       volume));
    return volume;
}

}  // namespace

TEST_CASE("lenses: the box holds them for any wind, bends and shear") {
    for (const int seed : {1, 2, 3})
        for (const char* keys : {"", ", wind_deg = 35", ", wind_deg = -120, shear = 2",
                                 ", outline = 1", ", plates = 1", ", plates = 12, wind_deg = 90",
                                 ", height_m = 300", ", radius_m = 9000"}) {
            CAPTURE(seed);
            CAPTURE(keys);
            MediumSettings medium;
            REQUIRE(read(keys + (", seed = " + std::to_string(seed)), "", medium) == "");
            const Volume volume = made(medium);
            int rim = 0, some = 0, lowest = kLensCells, highest = 0;
            for (int z = 0; z < kLensCells; ++z)
                for (int y = 0; y < kLensCells; ++y)
                    for (int x = 0; x < kLensCells; ++x) {
                        if (!(volume.density[std::size_t((z * kLensCells + y) * kLensCells + x)] >
                              0))
                            continue;
                        ++some;
                        rim += x < 2 || y < 2 || x > kLensCells - 3 || y > kLensCells - 3 ? 1 : 0;
                        lowest = std::min(lowest, z), highest = std::max(highest, z);
                    }
            CHECK(some > 1000);
            CHECK(rim == 0);
            CHECK(lowest > 0);
            CHECK(highest > kLensCells / 2);
            CHECK(highest < kLensCells - 1);
        }
}

TEST_CASE("lenses: the lee side is the longer one") {
    for (const double deg : {0.0, 90.0, -135.0}) {
        CAPTURE(deg);
        MediumSettings medium;
        REQUIRE(read(", plates = 1, outline = 0, wind_deg = " + std::to_string(deg), "", medium) ==
                "");
        const Volume volume = made(medium);
        const double turn = deg / 360 * 6.283185307179586;
        double longest = 0, shortest = 0;
        double cell[2];
        for (int a = 0; a < 2; ++a)
            cell[a] = (medium.box.bounds_m[1][a] - medium.box.bounds_m[0][a]) / kLensCells;
        for (int z = 0; z < kLensCells; ++z)
            for (int y = 0; y < kLensCells; ++y)
                for (int x = 0; x < kLensCells; ++x) {
                    if (!(volume.density[std::size_t((z * kLensCells + y) * kLensCells + x)] > 0))
                        continue;
                    const double along =
                        (medium.box.bounds_m[0].x + (x + 0.5) * cell[0]) * std::cos(turn) +
                        (medium.box.bounds_m[0].y + (y + 0.5) * cell[1]) * std::sin(turn);
                    longest = std::max(longest, along), shortest = std::min(shortest, along);
                }
        CHECK(longest > -1.1 * shortest);
    }
}

TEST_CASE("lenses: a box sets the size, and what does not fit is refused") {
    MediumSettings medium;
    const std::string box = "bounds_m = [[0, 0, 4000], [9000, 9000, 5000]]\n";
    REQUIRE(read("", box, medium) == "");
    CloudHeap heap;
    CloudInGrid place;
    REQUIRE(place_cloud(medium, heap, place));
    CHECK(place.cloud.height_m > 500);
    CHECK(place.cloud.height_m < 1000);
    CHECK(read(", height_m = 3000", box, medium).find("cloud.height_m: does not fit bounds_m") !=
          std::string::npos);
    CHECK(read(", radius_m = 30000", box, medium).find("cloud.radius_m: does not fit bounds_m") !=
          std::string::npos);
}
