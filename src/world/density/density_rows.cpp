// SPDX-License-Identifier: Apache-2.0
// The table of densities that the program makes.
// in: one row for each -> out: see src/scene/rows/density_row.h.
// docs/contributing.md, "Add a density".
#include "src/scene/rows/density_row.h"

// One row for a density: the constant at the end of its own file.
#define PILEUS_DENSITIES(ROW) \
    ROW(kCumulusDensity)      \
    ROW(kSkyDensity)          \
    ROW(kCloudDensity)        \
    ROW(kBoxDensity)          \
    ROW(kSphereDensity)       \
    ROW(kEllipsoidDensity)    \
    ROW(kPlumeDensity)        \
    ROW(kParticleCumulusDensity)

namespace pileus {

#define PILEUS_DECLARE(constant) extern const DensityRow constant;
PILEUS_DENSITIES(PILEUS_DECLARE)
#undef PILEUS_DECLARE

namespace {

#define PILEUS_ADDRESS(constant) &constant,
constexpr const DensityRow* kDensities[] = {PILEUS_DENSITIES(PILEUS_ADDRESS)};
#undef PILEUS_ADDRESS

}  // namespace

Span<const DensityRow* const> density_rows() {
    return {kDensities, sizeof kDensities / sizeof kDensities[0]};
}

const DensityRow* density_row(const std::string& name) {
    for (const DensityRow* row : kDensities)
        if (name == row->name) return row;
    return nullptr;
}

std::string density_names(bool (*use)(const DensityRow&)) {
    std::string list;
    for (const DensityRow* row : kDensities)
        if (use == nullptr || use(*row))
            list += (list.empty() ? "" : ", ") + std::string(row->name);
    return list;
}

bool is_like_density_name(const std::string& text) {
    for (const DensityRow* row : kDensities) {
        const std::string name = row->name;
        const std::size_t start = name.find(':') + 1;
        if (text.compare(0, start, name, 0, start) == 0) return true;
    }
    return false;
}

}  // namespace pileus
