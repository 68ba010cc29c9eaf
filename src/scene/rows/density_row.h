// SPDX-License-Identifier: Apache-2.0
// The densities that the program makes: names, what a scene says of each, who makes them.
// in: the table in src/world/density/density_rows.cpp -> out: rows for keys, checks, plans,
// loaders. docs/scene.md, "Media"; docs/contributing.md, "Add a density".
#pragma once
#include <array>
#include <cstdint>
#include <string>

#include "src/base/span.h"
#include "src/base/status.h"
#include "src/scene/scene.h"

namespace pileus {

struct KernelTable;
struct ParticleSet;
struct SceneCheck;
struct SkyField;
struct Volume;

/// What is known of a density before it is made.
struct DensityOutline {
    std::array<int, 3> size{1, 1, 1};  ///< cells, where the scene leaves `resolution` out
    double mean = 1;                   ///< over the box
    std::uint64_t bytes = 0;           ///< beside the grid, while it is made
    std::uint64_t thread_bytes = 0;    ///< the same, for each thread more
};

/// What making takes beside the medium's settings.
struct DensityMaking {
    std::array<int, 3> size{1, 1, 1};      ///< cells of the grid
    int threads = 1;                       ///< 0: all; the bits do not depend on it
    const KernelTable* kernels = nullptr;  ///< null or a device's: the widest of the host
    SkyField* field = nullptr;             ///< of a row with a field: if given, keeps it
    double wind_s = 0;                     ///< for which the frame's wind has blown besides
};

/// Members that a density does not set say what holds for most.
struct DensityRow {
    const char* name = nullptr;  ///< value of the key medium.N.density; a word, ':', a word

    bool needs_bounds = true;     ///< the key bounds_m must be given
    bool takes_seed = false;      ///< the key shape_seed counts
    int least_cells = 1;          ///< along each axis of the key resolution
    const char* table = nullptr;  ///< of keys that this density alone has: "sky"
    /// Laws between its own keys, and what leaving them out means; null: none.
    void (*check)(SceneCheck& check, std::size_t medium) = nullptr;

    DensityOutline (*outline)(const MediumSettings& medium) = nullptr;
    /// The mean of what is made is the outline's within this factor; the test of all rows has a box
    /// of 3200 x 3200 x 2200 m at an altitude of 1000 m.
    double mean_within = 1;
    const char* working = nullptr;  ///< what the plan calls the outline's bytes

    /// All of `volume`: size, values in [0, 1], no bounds. kLimit: out of memory.
    Status (*make)(const MediumSettings& medium, const DensityMaking& with,
                   Volume& volume) = nullptr;
    /// The particles that `make` lays on its grid, in metres: box, places, radii, densities,
    /// numbers; null: none. Values of its grid may be above 1.
    Status (*make_particles)(const MediumSettings& medium, int threads,
                             ParticleSet& particles) = nullptr;
    bool has_field = false;  ///< makes a SkyField, which rays can ask in place of the grid
    /// Factor on extinction_per_m; null: 1.
    double (*factor)(const MediumSettings& medium) = nullptr;
    /// What `pileus info` says after the name, ", type stratus"; null: nothing.
    std::string (*detail)(const MediumSettings& medium) = nullptr;
};

/// All, in the order of messages.
Span<const DensityRow* const> density_rows();

/// Null for the density of a file, which is what is left where no row has the name.
const DensityRow* density_row(const std::string& name);

/// "procedural:cumulus, ...": the names of all, or of those that `use` takes.
std::string density_names(bool (*use)(const DensityRow&) = nullptr);

/// Whether a text begins as a name does, "uniform:", so that it is a wrong name and no path.
bool is_like_density_name(const std::string& text);

}  // namespace pileus
