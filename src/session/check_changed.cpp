// SPDX-License-Identifier: Apache-2.0
// See value_fault.h: the checks that a file's values pass.
// in: a scene, a change -> out: check_scene's fault of the changed scene.
// docs/scene.md
#include "src/scene/read_scene.h"
#include "src/session/value_fault.h"

namespace pileus {

Status check_changed(const char*, const Scene& scene, void (*change)(const void*, Scene&),
                     const void* values) {
    Scene changed = scene;
    change(values, changed);
    changed.file = "session";
    // The checks know maps by their files.
    changed.view_files.sky_map = changed.sky.mapped ? "host.pfm" : "";
    return check_scene(changed);
}

}  // namespace pileus
