// SPDX-License-Identifier: Apache-2.0
// Statistics of simulated clouds and of an artist's, which the ranges of generators come from.
// in: PILEUS_DATA_DIR/data/les and data/vdb -> out: pass or fail, or one line why it was skipped.
// docs/generators.md, "Measured"
#include "lab/statistics/cloud_statistics.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <string>

#include "src/scene/read_scene.h"
#include "src/world/medium/medium.h"

using namespace pileus;

namespace {

CloudStatistics of_medium(const std::string& lines) {
    Scene scene;
    Medium medium;
    REQUIRE(
        read_scene_text("[camera]\nposition_m = [0, -90000, 5000]\ntarget_m = [0, 0, "
                        "5000]\n[[medium]]\n" +
                            lines,
                        "s.toml", "", {}, scene));
    const Status status = load_medium(scene, scene.media[0], 0, medium);
    REQUIRE_MESSAGE(bool(status), status.message);
    ExtinctionGrid grid{};
    for (std::size_t a = 0; a < 3; ++a) {
        grid.size[a] = medium.volume.size[a];
        grid.cell_m[a] = medium.extent_m[a] / medium.volume.size[a];
    }
    grid.value = medium.volume.density.data(), grid.per_m = double(medium.sigma);
    return cloud_statistics(grid);
}

}  // namespace

TEST_CASE("statistics of a LES of trade cumuli, and of a cloud modelled by artists") {
    const char* root = std::getenv("PILEUS_DATA_DIR");
    if (root == nullptr || *root == '\0') {
        MESSAGE("skipped: PILEUS_DATA_DIR is not set");
        return;
    }
    const std::string data = std::string(root) + "/data/";
    const CloudStatistics rico = of_medium("density = \"" + data + "les/rico122x106x39.txt\"\n");
    CHECK(rico.dimension[0] == doctest::Approx(1.24).epsilon(0.01));
    CHECK(rico.dimension[1] == doctest::Approx(1.34).epsilon(0.01));
    CHECK(rico.spectrum == doctest::Approx(-2.64).epsilon(0.02));
    CHECK(rico.patches == 13);
    const CloudStatistics vdb =
        of_medium("density = { file = \"" + data +
                  "vdb/cloud.vdb\", grid = \"density\" }\ny_up = true\nbounds_m = [[-450, -522, "
                  "600], [450, 522, 1206]]\nextinction_per_m = 0.15\n");
    CHECK(vdb.dimension[1] == doctest::Approx(1.085).epsilon(0.01));
}
