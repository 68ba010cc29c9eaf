// SPDX-License-Identifier: Apache-2.0
// See cloud.h. Lays a layer on its grid, first its map of rising air, whose quantile is the cover;
// kernels_cpu/procedural/cloud_layer.h fills both. in: a place -> out: floats in [0, 1].
// docs/generators.md, "Layers"
#include <algorithm>
#include <vector>

#include "platform/threads.h"
#include "src/scene/media/cloud_types.h"
#include "src/world/density/cloud.h"
#include "src/world/density/draws.h"

namespace pileus {
namespace {

CloudLayerForm layer_form(CloudForm form) {
    return form == CloudForm::kOpen      ? kLayerOpen
           : form == CloudForm::kClosed  ? kLayerClosed
           : form == CloudForm::kStreaks ? kLayerStreaks
                                         : kLayerSheet;
}

CloudLayerParams layer_params(const CloudInGrid& place, const std::array<int, 3>& size) {
    const CloudSettings& cloud = place.cloud;
    const CloudForm form = cloud_type(cloud.type).form;
    CloudLayerParams k{};
    k.form = layer_form(form);
    float voxel = 0;
    for (std::size_t a = 0; a < 3; ++a) {
        const double edge = place.bounds_m[1][int(a)] - place.bounds_m[0][int(a)];
        k.size[a] = size[a];
        k.cell[a] = float(edge / size[a]);
        voxel = std::max(voxel, k.cell[a]);
        if (a < 2) k.width[a] = float(edge);
    }
    k.lowest = float(place.bounds_m[0].z - place.foot_m.z) + 0.5f * k.cell[2];
    k.seed = make_key(std::uint64_t(cloud.seed), kCloudLumpStream, 1).k0;
    k.height = float(cloud.height_m), k.length = float(cloud.cell_m);
    k.grounded = form == CloudForm::kGround ? 1.0f : 0.0f;
    const bool sheet = k.form == kLayerSheet;
    k.lump = 0.29f * k.height;
    for (float s = k.lump; s > 1.8f * voxel && k.octaves < 16; s *= 0.5f) ++k.octaves;
    k.erosion = float(cloud.erosion), k.act = sheet ? 0.35f : 0.6f;
    k.edge = std::max((sheet ? 0.25f : 0.08f) * k.height, 1.4f * k.cell[2]);
    k.shear = float(cloud.shear), k.turn = float(cloud.turn_deg / 360);
    const bool adiabatic = cloud_type(cloud.type).extinction_per_m == 0;
    k.per_full = adiabatic ? float(1 / full_height_m(cloud.height_m)) : 0.0f;
    return k;
}

}  // namespace

Status make_layer(const CloudInGrid& place, const CloudMaking& with, Volume& volume) {
    // No cover is no cloud at all, whatever the noise.
    if (!(place.cloud.cover > 0)) return Status::ok();
    CloudLayerParams k = layer_params(place, with.size);
    Buffer<float> map;
    const std::uint64_t columns = std::uint64_t(k.size[0]) * std::uint64_t(k.size[1]);
    PILEUS_TRY(map.resize(columns, "rising air of a cloud"));
    const CloudLayerBuffers b{volume.density.data(), map.data()};
    const auto fill = [&] {
        parallel_for(with.threads, k.size[1], [&](std::int64_t row, int) {
            with.kernels.fill_cloud_layer(k, b, std::uint32_t(row), std::uint32_t(row) + 1);
        });
    };
    k.map = 1;
    fill();
    // Clouds reach down to the quantile that leaves as much of the plane free as is asked.
    Buffer<float> sorted;
    PILEUS_TRY(sorted.resize(columns, "rising air of a cloud"));
    std::copy(map.data(), map.data() + columns, sorted.data());
    const std::uint64_t at =
        std::min(std::uint64_t((1 - place.cloud.cover) * double(columns)), columns - 1);
    std::nth_element(sorted.data(), sorted.data() + at, sorted.data() + columns);
    k.gap = sorted[std::size_t(at)] - (place.cloud.cover < 1 ? 0.0f : 1.0f);
    k.map = 0;
    fill();
    return Status::ok();
}

}  // namespace pileus
