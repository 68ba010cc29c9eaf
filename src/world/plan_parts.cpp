// SPDX-License-Identifier: Apache-2.0
// See plan_parts.h. Rows without a declaration are bounds of what a reader or writer takes.
#include "src/world/plan_parts.h"

namespace pileus {
namespace {

constexpr std::uint64_t kFloat = sizeof(float);

}  // namespace

std::uint64_t most_tracking_blocks(const Grid& grid, bool local) {
    if (!local) return 1;
    return block_total(grid, voxel_count(grid) <= kMaxSingleVoxels ? 1 : 2);
}

SkyMapBytes sky_map_bytes(const SkyMap& map, const GroundLook& look) {
    // Four channels decoded, and the file, which is hardly larger than its values.
    return {map.bytes(), 32 * std::uint64_t(map.size[0]) * std::uint64_t(map.size[1]), look.bytes(),
            look.reading};
}

/// src/world/medium
void add_density_rows(const Grid& grid, const MediumSource& source, std::uint64_t media,
                      std::uint64_t phases, std::uint64_t threads, const SkyMapBytes& sky,
                      MemoryTable& t) {
    add(t, arrays::density(grid));
    t.add("density as it was given", Stage::kDensity, Stage::kWrite,
          bytes_of(source.unrefined_voxels, sizeof(float)));
    add(t, arrays::detail_tile(source.tile_cells));
    if (source.emitters > 0)
        add(t, arrays::emitted_below(bytes_of(source.emitters, voxel_count(grid))));
    t.add("phase functions", Stage::kDensity, Stage::kWrite, phases);
    t.add("sky map", Stage::kDensity, Stage::kWrite, sky.kept);
    t.add("sky map while it is read", Stage::kDensity, Stage::kDensity, sky.reading);
    t.add("map of the ground", Stage::kDensity, Stage::kWrite, sky.ground);
    t.add("map of the ground while it is read", Stage::kDensity, Stage::kDensity,
          sky.ground_reading);
    t.add("file while it is read", Stage::kDensity, Stage::kDensity, source.reading_bytes);
    t.add("density, turned", Stage::kDensity, Stage::kDensity,
          bytes_of(source.turned_voxels, kFloat));
    if (media > 1) {
        t.add("media apart", Stage::kDensity, Stage::kDensity,
              bytes_of(source.apart_voxels, kFloat));
        t.add("mixing of media", Stage::kDensity, Stage::kDensity, source.mixing_bytes);
        add(t, arrays::media_parts(grid, media));
    }
    for (const DensityWork& work : source.making)
        t.add(work.what, Stage::kDensity, Stage::kDensity,
              sum_of_bytes(work.bytes, bytes_of(work.thread_bytes, threads)));
}

/// src/world/majorant/majorant.cpp
void add_majorant_rows(const Grid& grid, std::uint64_t blocks, std::uint64_t threads, Stage last,
                       MemoryTable& t) {
    // The search holds the finest blocks and the next, and is over before the choice is made.
    const int finest = voxel_count(grid) <= kMaxSingleVoxels ? 1 : 2;
    add(t,
        renamed(arrays::block_maxima(grid, finest), "search for the block size", Stage::kMajorants,
                Stage::kMajorants),
        arrays::block_maxima(grid, 2 * finest));
    add(t, arrays::majorant_rows(grid, threads));
    add(t, arrays::majorants(blocks, last));
    add(t, arrays::blocks_to_skip(grid));
}

/// src/picture/layers.cpp and the encoders of io: a growing buffer is three times the file at most,
/// and no file is larger than its raw values but for its head; rows wait in packs of 16.
void add_image_rows(std::uint64_t width, std::uint64_t height, std::uint64_t layers,
                    MemoryTable& t) {
    const std::uint64_t image = bytes_of(kFloat * layers, width, height);
    t.add("image layers", Stage::kLayers, Stage::kWrite, image);
    t.add("file being encoded", Stage::kWrite, Stage::kWrite,
          bytes_of(3, image + (std::uint64_t{1} << 20)));
    t.add("rows being encoded", Stage::kWrite, Stage::kWrite,
          bytes_of(3 * 16, width, kFloat * layers));
}

WorkInput medium_work(const Medium& medium, double mean_density, double max_events,
                      double photons) {
    WorkInput in;
    in.extinction_per_m = double(medium.sigma);
    in.mean_density = mean_density;
    for (int a = 0; a < 3; ++a) in.extent_m[a] = medium.extent_m[a];
    // Of several media the one that keeps photons busy longest stands for all.
    in.albedo = 0;
    in.mean_cosine = 1;
    for (int i = 0; i < medium.count; ++i) {
        const Optics& optics = medium.optics[std::size_t(i)];
        const double cosine = double(phase_moment(optics.phase, 1));
        if (double(optics.albedo_max) > in.albedo) in.albedo = double(optics.albedo_max);
        if (cosine < in.mean_cosine) in.mean_cosine = cosine;
    }
    in.max_events = max_events;
    in.photons = photons;
    return in;
}

void note_depths(const Lighting& lighting, bool wanted, Plan& plan) {
    if (!lighting.opaque()) plan.leave_out("depth test", "nothing solid: no ground");
    if (!wanted) plan.leave_out("depth of the medium", "no depth layer");
}

void note_emission(const Medium& medium, bool photons, Plan& plan) {
    if (!emits(medium)) return plan.leave_out("emission of the media", "no medium has any");
    plan.need("emission of the media, unscattered: marched");
    if (photons) return plan.need("emission that media and ground scatter: photons");
    plan.leave_out("emission that the media or the ground scatter", "not by this method");
}

Status check_work(const WorkEstimate& work, const Limits& limits, const std::string& where) {
    if (!work.known || !(work.photons > 0)) return Status::ok();
    PILEUS_TRY(
        check_limit(limits, LimitId::kScatterings, whole(work.scatterings_per_photon), where));
    return check_limit(limits, LimitId::kWork, whole(work.scatterings), where);
}

void note_limits(const Scene& scene, const Grid& grid, const Limits& limits,
                 std::initializer_list<LimitId> ids, Plan& plan) {
    const auto& size = scene.camera.resolution;
    const WorkEstimate& work = plan.work;
    const auto needs = [&](LimitId id) -> std::uint64_t {
        switch (id) {
            case LimitId::kVoxels:
                return voxel_count(grid);
            case LimitId::kSamples:
                return std::uint64_t(scene.collectors.placement.samples);
            case LimitId::kPhotons:
                return whole(work.photons);
            case LimitId::kPixels:
                return std::uint64_t(size[0]) * std::uint64_t(size[1]);
            case LimitId::kFrames:
                return scene.animation.present ? std::uint64_t(scene.animation.frames) : 1;
            case LimitId::kMemory:
                return plan.memory.peak();
            case LimitId::kScatterings:
                return whole(work.scatterings_per_photon);
            case LimitId::kWork:
                return whole(work.scatterings);
            default:
                return 0;
        }
    };
    plan.limits.clear();
    for (const LimitId id : ids) {
        const bool work_to_come = id == LimitId::kScatterings || id == LimitId::kWork;
        plan.limits.push_back({id, needs(id), limits[id], work.known || !work_to_come});
    }
}

std::uint64_t whole(double number) {
    return number < 0x1p63 ? std::uint64_t(number) : std::uint64_t{1} << 63;
}

}  // namespace pileus
