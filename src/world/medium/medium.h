// SPDX-License-Identifier: Apache-2.0
// A medium ready to be prepared: its grid, where it lies, and its optical properties.
// in: the scene's words about one medium -> out: plain numbers in kernel units.
// docs/methods.md 1; mix_media.h lays several on one grid, which then is one of these too.
#pragma once
#include "kernels_cpu/isa/kernels.h"
#include "kernels_cpu/media/detail_params.h"
#include "kernels_cpu/media/optics.h"
#include "src/base/limits.h"
#include "src/io/volumes/volume.h"
#include "src/plan/array.h"
#include "src/scene/media/host_media.h"
#include "src/scene/scene.h"
#include "src/world/grid/grid.h"
#include "src/world/medium/emitters.h"
#include "src/world/phase/phase_table.h"

namespace pileus {

struct SkyField;

/// Detail that is made while marching.
struct MediumDetail {
    Buffer<float> tile;
    DetailView view{};  ///< into the tile; none: there is no such detail
    float step_m = 0;   ///< that a march may take through it

    bool present() const { return view.tile != nullptr; }
};

struct Medium {
    Volume volume;
    Grid grid;
    Double3 low_m{};      ///< low corner of the box in the world; the origin of box-local metres
    double extent_m[3];   ///< box edges
    double detail_m = 0;  ///< length that the preparation's shares are of; 0: the box's diagonal
    float sigma = 0;      ///< extinction at density 1, 1/m
    int channels = 1;     ///< 1: achromatic
    float density_max = 0;
    int count = 1;  ///< media on this grid, 1..kMaxMedia; `volume` holds their sum
    std::array<Optics, kMaxMedia> optics{};
    MediumDetail detail;
    Buffer<float> parts;             ///< [medium - 1][voxel]; medium 0 is what is left of the sum
    std::vector<PhaseStore> phases;  ///< tables that `optics` points into
    std::vector<Emitter> emitters;   ///< where photons of media that shine begin; see emitters.h
};

namespace arrays {

/// The sum of all media.
inline Array<float> density(const Grid& grid) {
    return {"density", voxel_count(grid), Stage::kDensity, Stage::kWrite};
}
/// Noise of detail that is made while marching; of so many cells along each edge.
inline Array<float> detail_tile(int cells) {
    const std::uint64_t edge = std::uint64_t(cells) + 1;
    return {"tile of detail", cells > 0 ? edge * edge * edge : 0, Stage::kDensity, Stage::kWrite};
}
/// Each medium but the first, apart.
inline Array<float> media_parts(const Grid& grid, std::uint64_t media) {
    return {"parts of the media", bytes_of(media - 1, voxel_count(grid)), Stage::kDensity,
            Stage::kWrite};
}

}  // namespace arrays

/// Refuses an extinction whose products would be infinite, kBadInput that begins with `where`; one
/// that no float would show through the whole box becomes none.
Status hold_extinction(const std::string& where, Medium& medium);

/// Bytes of all tables of phase functions.
std::uint64_t phase_bytes(const Medium& medium);

/// Where the medium is densest, 1/m; of an outlined one a bound.
inline double max_extinction(const Medium& medium) {
    return double(medium.sigma) * double(medium.density_max);
}

/// Whether no medium absorbs anything.
bool is_white(const Medium& medium);

/// Whether any medium shines by itself.
bool emits(const Medium& medium);

/// Largest phase function of all media over all angles, 1/sr.
float phase_peak(const Medium& medium);

/// Mean cosine of scattering, the mean over the media.
float mean_cosine(const Medium& medium);

/// "medium.N" of settings that belong to the scene, as its keys are named.
std::string medium_key(const Scene& scene, const MediumSettings& settings);

/// Memory beside the grid while a density is made, as the plan lists it.
struct DensityWork {
    const char* what;
    std::uint64_t bytes, thread_bytes;  ///< in all, and for each thread more
};

/// Densities are made one after the other: of those alike the largest counts.
void keep_larger(const DensityWork& work, std::vector<DensityWork>& list);

/// What is known of a density before its values are there.
struct MediumSource {
    std::uint64_t reading_bytes = 0;  ///< of the file, packed and not, in memory while it is read
    std::uint64_t turned_voxels = 0;  ///< of a file whose y axis points up: a grid more for a while
    std::uint64_t apart_voxels = 0;   ///< of media that are then laid on one grid
    std::uint64_t mixing_bytes = 0;   ///< scratch of that
    int tile_cells = 0;               ///< of a tile of detail that is kept; 0: none
    std::uint64_t unrefined_voxels = 0;  ///< of a host's density that is kept beside finer cells
    std::vector<DensityWork> making;     ///< of densities that the program makes
    std::uint64_t emitters = 0;          ///< media that photons begin in
    double mean_density = -1;            ///< over the box; below 0: known only from the values
};

/// kLimit: a side or the product over the limits; `where` opens the line.
Status check_voxels(const std::string& where, const std::array<int, 3>& size, const Limits& limits);

/// Step that neither cells nor detail call for a shorter one than, m.
float march_step(const Medium& medium);

/// Over the cells of the grid.
double mean_density(const Medium& medium);

/// Places the medium and learns its size, reading no values: `out` is as load_medium's, but for the
/// density, and density_max counts as 1. kLimit: a file or grid over the limits, before any memory
/// is taken; otherwise as load_medium. `given`: in place of what the scene says.
Status outline_medium(const Scene& scene, const MediumSettings& settings, const Limits& limits,
                      Medium& out, MediumSource& source, const MediumValues& given = {});

/// Reads or makes the density and places it. A file that holds extinction becomes densities up to 1
/// (value over largest value) with sigma = extinction_scale times the largest value. Errors: those
/// of the readers; kBadInput for a file that does not know its place while `bounds_m` is left out.
/// Where a transfer function shows the values they stay as they are: see mix_media.h.
/// `kernels`: those to put a sky on its grid; null or a device's: the widest of the host. `sky`, if
/// given, keeps it.
Status load_medium(const Scene& scene, const MediumSettings& settings, int threads, Medium& out,
                   const KernelTable* kernels = nullptr, SkyField* sky = nullptr,
                   const MediumValues& given = {});

}  // namespace pileus
