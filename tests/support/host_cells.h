// SPDX-License-Identifier: Apache-2.0
// Cells of a test in place of what a scene's media say.
// in: a scene with resolutions, values -> out: HostMedia; a picture.
// docs/embedding.md, "Three handles"
#pragma once
#include "src/scene/media/host_media.h"
#include "tests/support/render_harness.h"

namespace render_test {

/// The same ones for every medium, each of its own resolution. `cells` outlive it.
inline HostMedia host_cells(const Scene& scene, const std::vector<float>& cells) {
    HostMedia out;
    for (const MediumSettings& medium : scene.media) {
        out.media.emplace_back();
        out.media.back().cells = cells.data();
        out.media.back().size = medium.box.resolution;
    }
    return out;
}

inline Picture render_cells(const Scene& scene, const std::vector<float>& cells) {
    const HostMedia media = host_cells(scene, cells);
    RenderOptions options;
    options.media = &media;
    return render_one(scene, options);
}

}  // namespace render_test
