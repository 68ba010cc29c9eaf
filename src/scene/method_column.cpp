// SPDX-License-Identifier: Apache-2.0
// See method_column.h.
#include "src/scene/method_column.h"

namespace pileus {
namespace {

/// Of the method, whatever its display.
MethodColumn column_of_name(const std::string& method) {
    for (const ColumnRow& row : kColumnRows)
        if (row.method && method == row.name) return row.column;
    return kColumnRows[0].column;
}

}  // namespace

MethodColumn method_column(const Scene& scene) {
    const MethodColumn column = column_of_name(scene.method);
    if (column == MethodColumn::kCollectors && scene.collectors.display.billboards)
        return MethodColumn::kCollectorBillboards;
    if (column == MethodColumn::kParticles && scene.particles.billboards)
        return MethodColumn::kParticleBillboards;
    return column;
}

const Support* refused(const Scene& scene, Feature feature) {
    const Support& entry = support(feature, method_column(scene));
    return entry.refused() ? &entry : nullptr;
}

bool has_camera_closure(const Scene& scene) {
    const MethodColumn column = column_of_name(scene.method);
    if (column == MethodColumn::kCollectors) return scene.collectors.closure.camera;
    return column == MethodColumn::kPhotonGrid && scene.photon_grid.closure == GridClosure::kCamera;
}

}  // namespace pileus
