// SPDX-License-Identifier: Apache-2.0
// See finish_frame.h.
#include "src/picture/finish_frame.h"

#include "platform/threads.h"
#include "src/base/digest.h"
#include "src/world/camera/view.h"
#include "src/world/plan_parts.h"

namespace pileus {

Status finish_layers(const OutputSettings& output, const CameraParams& camera, const Double3& low_m,
                     const Planes& planes, Image& image, Report& report) {
    report.counters.clear();
    std::uint64_t clamped = planes.clamped;
    PILEUS_TRY(make_layers(planes, camera.width, camera.height, output, image, report, clamped));
    report.counters.emplace_back("clamped_negative", clamped);
    set_image_camera(camera, low_m, image);
    return Status::ok();
}

Status finish_frame(const Context& context, const OutputSettings& output, const World& world,
                    const CameraDepth& depth, const CameraParams& camera,
                    const FinishedParts& parts, Planes& planes, Image& image, Report& report) {
    const StageClock clock(context, "layers");
    Digest colours;
    Status layers;
    const bool digests = parts.colours && context.digests;
    // Neither is short, and neither can be shared by threads.
    parallel_for(context.threads, 2, [&](std::int64_t piece, int) {
        if (piece == 0 && digests)
            colours.floats(planes.colour.span());
        else if (piece == 1)
            layers = finish_layers(output, camera, world.medium.low_m, planes, image, report);
    });
    PILEUS_TRY(layers);
    if (digests) report.digests.emplace_back("colours", colours.hex());
    report.executed = {{"depth_tests", planes.opaque_depth.size()},
                       {"depths_stored", planes.half_depth.size()}};
    if (parts.batches) report.executed.emplace_back("batches", std::uint64_t(planes.batches));
    if (parts.media) report.executed.emplace_back("parts_stored", world.medium.parts.size());
    if (parts.film > 0) report.executed.emplace_back("film_parts", std::uint64_t(parts.film));
    report_solids(world.solids, depth, report);
    planes = Planes{};  // to give memory back takes time, too
    return Status::ok();
}

}  // namespace pileus
