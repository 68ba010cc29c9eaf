// SPDX-License-Identifier: Apache-2.0
// See cumulus.h. Lays out a grid and grows spheres; kernels_cpu/procedural/cumulus.h fills it.
// in: settings -> out: nx*ny*nz floats in [0, 1].
#include "src/world/density/cumulus.h"

#include <string>

#include "kernels_cpu/core/rng.h"
#include "kernels_cpu/isa/kernels.h"
#include "platform/threads.h"
#include "src/base/number_text.h"
#include "src/base/random_streams.h"
#include "src/run/device_launch.h"
#include "src/run/on_device.h"
#include "src/scene/rows/density_row.h"

namespace pileus {
namespace {

constexpr std::uint64_t kFirstCloud = 4;  // seed 0 is the cloud a first picture should show
constexpr float kBasePlane = 0.055f;      // of the box's height: the flat base over its floor

struct Field {
    BubbleList list;
    CumulusParams k{};
};

Status check(const CumulusSettings& s) {
    for (const double e : {s.extent_m.x, s.extent_m.y, s.extent_m.z}) {
        const double share = e / s.extent_m[2];
        if (!(e > 0 && share >= 1e-3 && share <= 1e3))
            return Status::bad_input("bounds_m: the box's width over its height is " +
                                     number_text(share, 6) +
                                     ", allowed 0.001..1000 for procedural:cumulus");
    }
    return Status::ok();
}

/// Lays out the grid and grows the bubbles so that all displacements stay inside the box.
Status prepare(const CumulusSettings& settings, Field& f) {
    CumulusParams& k = f.k;
    for (std::size_t a = 0; a < 3; ++a) {
        k.size[a] = settings.resolution[a];
        const double cell = settings.extent_m[a] / settings.extent_m[2] / double(k.size[a]);
        k.cell[a] = float(cell);
        k.corner[a] = float(-0.5 * cell * double(k.size[a] - 1));
        k.voxel = max_(k.voxel, k.cell[a]);
    }
    // Stand the base plane on the lowest cells that may hold cloud.
    const float floor = kBasePlane + k.cell[2];
    k.corner[2] = 0.5f * k.cell[2] - floor;
    k.shell = max_(1.3f * k.voxel, 0.008f);
    const float skin = kCumulusWarp + kCumulusPushOut + 0.5f * k.shell + k.voxel;
    const float half_x = 0.5f * k.cell[0] * float(k.size[0]) - skin;
    const float half_y = 0.5f * k.cell[1] * float(k.size[1]) - skin;
    const float height = 1.0f - floor - skin;
    constexpr float kLeast = 0.05f;  // for grids too coarse to leave room
    const std::uint64_t seed = std::uint64_t(settings.seed) + kFirstCloud;
    k.seed = make_key(seed, kDetailStream, 0).k0;
    PILEUS_TRY(grow_bubbles(seed, max_(half_x, kLeast), max_(half_y, kLeast), max_(height, kLeast),
                            f.list));
    k.bubbles = f.list.bubbles.data();
    k.count = std::int32_t(f.list.count);
    k.top = f.list.top;
    k.rows_y = (k.size[1] - 3) / kCumulusBlock + 1;
    return Status::ok();
}

DensityOutline outline_row(const MediumSettings&) {
    constexpr double kMean = 0.08;  // in the default box, which other boxes come close to
    return {CumulusSettings().resolution, kMean, kMaxBubbles * sizeof(Bubble),
            3 * kMaxBubbles * sizeof(std::int32_t)};
}

Status make_row(const MediumSettings& medium, const DensityMaking& with, Volume& volume) {
    CumulusSettings settings;
    settings.resolution = with.size;
    settings.seed = medium.shape_seed;
    settings.extent_m = medium.box.bounds_m[1] - medium.box.bounds_m[0];
    return make_cumulus(settings, kernels_of(with.kernels), with.threads, volume);
}

constexpr DensityRow cumulus_row() {
    DensityRow row;
    row.name = "procedural:cumulus";
    row.takes_seed = true;
    row.least_cells = 3;  // the outermost layer of cells stays empty
    row.outline = outline_row;
    row.mean_within = 1.05;
    row.working = "bubbles of the cumulus";
    row.make = make_row;
    return row;
}

}  // namespace

Status make_cumulus(const CumulusSettings& asked, const KernelTable& kernels, int threads,
                    Volume& volume) {
    CumulusSettings settings = asked;
    if (settings.resolution == std::array<int, 3>{0, 0, 0})
        settings.resolution = CumulusSettings().resolution;
    PILEUS_TRY(check(settings));
    Field f;
    PILEUS_TRY(prepare(settings, f));
    const CumulusParams& k = f.k;
    const std::uint64_t cells =
        std::uint64_t(k.size[0]) * std::uint64_t(k.size[1]) * std::uint64_t(k.size[2]);
    PILEUS_TRY(volume.density.resize(cells, "cumulus"));
    const std::int64_t layers = (k.size[2] - 3) / kCumulusBlock + 1;
    volume.size = settings.resolution;
    volume.knows_bounds = false;
    if (on_device(kernels.device))
        return launch_on_device(*kernels.device, k, CumulusBuffers{volume.density.data(), nullptr},
                                std::uint32_t(k.rows_y * layers));
    const int workers = threads > 0 ? threads : hardware_threads();
    Buffer<std::int32_t> scratch;
    PILEUS_TRY(scratch.resize(std::uint64_t(workers) * kCumulusScratch, "cumulus scratch"));
    parallel_for(workers, k.rows_y * layers, [&](std::int64_t piece, int thread) {
        const CumulusBuffers b{volume.density.data(),
                               scratch.data() + std::size_t(thread) * kCumulusScratch};
        kernels.fill_cumulus(k, b, std::uint32_t(piece), std::uint32_t(piece) + 1);
    });
    return Status::ok();
}

extern const DensityRow kCumulusDensity;
constexpr DensityRow kCumulusDensity = cumulus_row();

}  // namespace pileus
