// SPDX-License-Identifier: Apache-2.0
// See cloud.h. The density of a cloud by its type.
// in: settings -> out: nx*ny*nz floats in [0, 1].
#include "src/world/density/cloud.h"

#include "src/base/number_text.h"
#include "src/scene/media/cloud_types.h"
#include "src/scene/rows/density_row.h"

namespace pileus {
namespace {

/// Mean density in the box by default; sizes and boxes move it by a factor.
double mean_of(CloudForm form) {
    switch (form) {
        case CloudForm::kField:
            return 0.012;
        case CloudForm::kClosed:
            return 0.15;
        case CloudForm::kOpen:
            return 0.08;
        case CloudForm::kSheet:
            return 0.3;
        case CloudForm::kGround:
            return 0.4;
        case CloudForm::kStreaks:
            return 0.01;
        case CloudForm::kLens:
            return 0.03;
        case CloudForm::kHeap:
            break;
    }
    return 0.04;
}

DensityOutline outline_row(const MediumSettings& medium) {
    const std::array<int, 3> size = default_cloud_size(medium);
    const std::array<int, 3>& cells = medium.box.resolution[0] > 0 ? medium.box.resolution : size;
    const CloudForm form = cloud_type(medium.cloud.type).form;
    // Of a layer its map of rising air, twice; of a field its clouds.
    const bool heaped =
        form == CloudForm::kHeap || form == CloudForm::kField || form == CloudForm::kLens;
    const std::uint64_t map =
        heaped ? 262144 : std::uint64_t(cells[0]) * std::uint64_t(cells[1]) * 2 * sizeof(float);
    return {size, mean_of(form), 2 * kMaxCloudBalls * sizeof(CloudBall) + map,
            kCloudScratch * sizeof(std::int32_t)};
}

Status make_row(const MediumSettings& medium, const DensityMaking& with, Volume& volume) {
    const CloudMaking making{with.size, host_kernels(with.kernels), with.threads};
    if (!medium.cloud.lives()) return make_cloud(medium, making, volume);
    MediumSettings later = medium;
    later.cloud.age_s += with.wind_s;
    return make_cloud(later, making, volume);
}

constexpr DensityRow cloud_row() {
    DensityRow row;
    row.name = "procedural:cloud";
    row.needs_bounds = false;  // a box around the cloud
    row.least_cells = 3;       // the outermost layer of cells stays empty
    row.table = "cloud";
    row.check = check_cloud;
    row.outline = outline_row;
    row.mean_within = 4;
    row.working = "balls of the cloud";
    row.make = make_row;
    row.detail = [](const MediumSettings& medium) { return ", type " + medium.cloud.type; };
    return row;
}

}  // namespace

Status make_cloud(const MediumSettings& medium, const CloudMaking& with, Volume& volume) {
    CloudHeap heap;
    CloudInGrid place;
    PILEUS_TRY(place_cloud(medium, heap, place));
    if (!fits(place))
        return Status::bad_input("cloud.height_m: " + number_text(place.cloud.height_m, 6) +
                                 " does not fit bounds_m, allowed: at most " +
                                 number_text(place.allowed_m, 6));
    // The box may have changed the height.
    place.cloud.entrainment_per_km = cloud_entrainment_per_km(medium.cloud, place.cloud.height_m);
    std::uint64_t cells = 1;
    for (const int side : with.size) cells *= std::uint64_t(side);
    PILEUS_TRY(volume.density.resize(cells, "density of a cloud"));
    volume.size = with.size;
    volume.knows_bounds = false;
    const CloudForm form = cloud_type(place.cloud.type).form;
    PILEUS_TRY(form == CloudForm::kHeap    ? make_heap(place, heap, with, volume)
               : form == CloudForm::kLens  ? make_lens(place, with, volume)
               : form == CloudForm::kField ? make_field(place, with, volume)
                                           : make_layer(place, with, volume));
    return place.cloud.rains() ? make_rain(place, heap, with, volume) : Status::ok();
}

extern const DensityRow kCloudDensity;
constexpr DensityRow kCloudDensity = cloud_row();

}  // namespace pileus
