// SPDX-License-Identifier: Apache-2.0
// Procedural clouds: the same bits at every lane width.
// in: every type -> out: pass or fail.
// docs/generators.md, "Bits"
#include <doctest/doctest.h>

#include <string>

#include "kernels_cpu/procedural/cloud_layer.h"
#include "kernels_cpu/procedural/cloud_rain.h"
#include "src/base/digest.h"
#include "src/scene/keys/key_row.h"
#include "src/scene/media/cloud_types.h"
#include "src/scene/read_scene.h"
#include "src/world/density/cloud.h"
#include "tests/support/widths.h"

using namespace pileus;

namespace {

/// Fills by kernels of W lanes, compiled here.
template <int W>
std::string digest_of(const MediumSettings& medium) {
    KernelTable table = *kernel_table(nullptr);
    table.fill_cloud = fill_cloud<W>;
    table.fill_cloud_layer = fill_cloud_layer<W>;
    table.fill_cloud_rain = fill_cloud_rain<W>;
    Volume volume;
    REQUIRE(make_cloud(medium, {{29, 27, 18}, table, 1}, volume));
    Digest digest;
    digest.floats(volume.density.span());
    return digest.hex();
}

}  // namespace

TEST_CASE("clouds: 1, 4, 8 and 16 lanes give the same bits for every type") {
    for (const std::string_view name : split_list(kCloudTypes)) {
        const std::string type(name);
        CAPTURE(type);
        std::string more = cloud_type(type).rains ? ", rain = 0.7" : "";
        if (cloud_type(type).anvil > 0) more += ", mamma = 1, shelf = 1, turn_deg = 50";
        if (cloud_type(type).form == CloudForm::kStreaks) more += ", turn_deg = -50";
        Scene scene;
        REQUIRE(
            read_scene_text("[camera]\nposition_m = [0, -9000, 5000]\ntarget_m = [0, 0, "
                            "5000]\n[[medium]]\ndensity = \"procedural:cloud\"\ncloud = { type "
                            "= \"" +
                                type + "\", seed = 11" + more + " }\n",
                            "s.toml", "", {}, scene));
        const MediumSettings& medium = scene.media[0];
        const std::string one = digest_of<1>(medium);
        CHECK(digest_of<4>(medium) == one);
        CHECK(digest_of<8>(medium) == one);
        CHECK(digest_of<16>(medium) == one);
    }
}
