// SPDX-License-Identifier: Apache-2.0
// See method_column.h.
#include "src/scene/method_column.h"

namespace pileus {
namespace {

bool never(const Scene&) { return false; }
bool has_billboards(const Scene& scene) { return scene.collectors.billboards; }
bool has_particle_billboards(const Scene& scene) { return scene.particles.billboards; }
bool has_collector_closure(const Scene& scene) { return scene.collectors.camera_closure; }
bool has_grid_closure(const Scene& scene) {
    return scene.photon_grid.closure == GridClosure::kCamera;
}

struct ColumnsOfMethod {
    MethodColumn column;  ///< whose name is the method's
    MethodColumn on_billboards;
    bool (*billboards)(const Scene&);
    bool (*camera_closure)(const Scene&);
};
constexpr ColumnsOfMethod kColumnsOfMethods[] = {
    {MethodColumn::kCollectors, MethodColumn::kCollectorBillboards, has_billboards,
     has_collector_closure},
    {MethodColumn::kPhotonGrid, MethodColumn::kPhotonGrid, never, has_grid_closure},
    {MethodColumn::kPath, MethodColumn::kPath, never, never},
    {MethodColumn::kRaymarch, MethodColumn::kRaymarch, never, never},
    {MethodColumn::kOpticalDepth, MethodColumn::kOpticalDepth, never, never},
    {MethodColumn::kParticles, MethodColumn::kParticleBillboards, has_particle_billboards, never},
};

constexpr bool has_all_columns() {
    for (int c = 0; c < int(MethodColumn::kCloudSkies); ++c) {
        bool found = false;
        for (const ColumnsOfMethod& m : kColumnsOfMethods)
            found = found || int(m.column) == c || int(m.on_billboards) == c;
        if (!found) return false;
    }
    return true;
}
static_assert(has_all_columns(), "a method for every column");

const ColumnsOfMethod& columns_of(const Scene& scene) {
    for (const ColumnsOfMethod& m : kColumnsOfMethods)
        if (scene.method == method_column_name(m.column)) return m;
    return kColumnsOfMethods[0];
}

}  // namespace

MethodColumn method_column(const Scene& scene) {
    const ColumnsOfMethod& m = columns_of(scene);
    return m.billboards(scene) ? m.on_billboards : m.column;
}

const Support* refused(const Scene& scene, Feature feature) {
    const Support& entry = support(feature, method_column(scene));
    return entry.refused() ? &entry : nullptr;
}

bool has_camera_closure(const Scene& scene) { return columns_of(scene).camera_closure(scene); }

}  // namespace pileus
