// SPDX-License-Identifier: Apache-2.0
// What the functions that draw views share.
// in: a prepared view, a camera -> out: a canvas that fills up, counts for the report.
// docs/how-it-works.md
#pragma once
#include "lab/views/canvas.h"
#include "lab/views/views.h"

namespace pileus {

constexpr Float3 kVeil{0.16f, 0.19f, 0.24f};  ///< the cloud behind the marks
constexpr double kMarkRows = 540;             ///< marks keep their size relative to such a picture

struct Drawing {
    const Context& context;
    const FrameView& view;
    const ViewMethod& of;
    CameraParams camera;
    Canvas canvas;
    Buffer<float> value;  ///< [pixel], where a field is shown
    Counts counters;

    const World& world() const { return view.world; }
    const CollectorsState& state() const { return of.state(); }
    float pixels(double at_540_rows) const {
        return float(at_540_rows * camera.height / kMarkRows);
    }
};

/// The cloud as a faint X-ray, to see where the marks are. kLimit: no memory.
Status draw_veil(Drawing& d);

/// The ways of some photons through the cloud, one of them over all others.
Status draw_photons(Drawing& d);

}  // namespace pileus
