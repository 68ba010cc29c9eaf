// SPDX-License-Identifier: Apache-2.0
// What a report begins with; in no flight, which has no report.
// in: scene, options, context -> out: the report's head.
// docs/report.md
#include "src/scene/rows/layer_flags.h"
#include "src/session/run_context.h"

namespace pileus {

void note_head(const Scene& scene, const RenderOptions& options, const Context& context,
               Report& report) {
    report.version = kVersion;
    report.scene = scene.file;
    report.method = scene.method;
    report.seed = scene.seed;
    report.first_frame = options.first_frame;
    report.budget = budget_text(options.budget);
    report.show = options.show;
    report.overrides = scene.overrides;
    report.layers = {"radiance", "alpha"};
    for (const LayerFlag& layer : kLayerFlags)
        if (scene.output.*layer.wanted) report.layers.push_back(layer.name);
    report.isa = context.kernels->name;
    report.team = threads_name();
    report.threads = report.team == "serial" ? 1 : context.threads;
}

}  // namespace pileus
