// SPDX-License-Identifier: Apache-2.0
// The column of the support table that a scene has, and what it refuses there.
// in: a scene -> out: entries of src/methods/support.h.
// docs/support.md
#pragma once
#include "src/methods/support.h"
#include "src/scene/scene.h"

namespace pileus {

/// By method and display. A name that is no method has the first one: it has its own fault.
MethodColumn method_column(const Scene& scene);

/// Whether it is that of method collectors, in either display.
inline bool is_of_collectors(MethodColumn column) {
    return column == MethodColumn::kCollectors || column == MethodColumn::kCollectorBillboards;
}

/// The entry of a feature that the scene's method refuses; null: it takes it.
const Support* refused(const Scene& scene, Feature feature);

/// Whether the scene's method lights its media towards one camera: `closure = "camera"`.
bool has_camera_closure(const Scene& scene);

}  // namespace pileus
