// SPDX-License-Identifier: Apache-2.0
// See late_rows.h.
#include "src/picture/late_rows.h"

#include "platform/threads.h"
#include "src/io/images/srgb.h"
#include "src/picture/background.h"
#include "src/run/on_device.h"
#include "src/world/medium/medium.h"

namespace pileus {

LateRows* late_rows_of(LateRows* late, const Lighting& light, const Medium& medium,
                       const UpsampleSettings& thin, const CameraParams& camera, int frame) {
    if (late == nullptr || light.air || thin.temporal > 0 || has_surfaces(light) ||
        !light.lamps.empty() || emits(medium))
        return nullptr;
    late->marched = upsample_lattice(thin, camera, frame, false);
    return late;
}

Status leave_background(const Context& context, const BackgroundParams& k,
                        const BackgroundBuffers& b, LateRows& late) {
    late.ready = true;
    late.params.back = k;
    late.buffers.back = b;
    late.buffers.back.colour = late.buffers.back.opaque_depth = nullptr;
    if (b.opaque_depth == nullptr) return Status::ok();
    BackgroundBuffers depths = b;
    depths.colour = nullptr;
    const PixelLattice& rows = late.marched;
    constexpr std::int64_t kPiece = 4;
    parallel_for(context.threads, (rows.height + kPiece - 1) / kPiece,
                 [&](std::int64_t piece, int) {
                     for (std::int64_t i = piece * kPiece;
                          i < (piece + 1) * kPiece && i < rows.height; ++i) {
                         const auto y = std::uint32_t(rows.first[1] + i * rows.every);
                         context.kernels->background_rows(k, depths, y, y + 1);
                     }
                 });
    return Status::ok();
}

void leave_upsampling(const UpsampleParams& k, const UpsampleBuffers& b, LateRows& late) {
    late.params.filled = 1;
    late.params.up = k;
    late.buffers.up = b;
}

bool is_late(const PixelTarget& target, const KernelTable& kernels) {
    return target.format == PixelFormat::kRgba8Srgb && target.blend == PixelBlend::kReplace &&
           kernels.finish_rows != nullptr && !on_device(kernels.device);
}

Status finish_picture(const Context& context, const Planes& planes, int width, int height,
                      const PixelTarget& target, LateRows& late, std::uint64_t& broken) {
    constexpr std::int64_t kPiece = 8;
    const SrgbCodes codes;
    Buffer<std::int64_t> counts;
    PILEUS_TRY(counts.resize(std::uint64_t(height), "counters"));
    late.params.pixel = {width, height, exposure_gain(target.stops)};
    PixelBuffers& b = late.buffers.pixel;
    b = PixelBuffers{};
    b.transmittance = planes.transmittance.data();
    b.colour = planes.colour.data();
    b.codes = codes.bins();
    b.first = target.rows.row(0, height);
    b.stride = target.rows.bottom_up ? -target.rows.stride : target.rows.stride;
    b.broken = counts.data();
    parallel_for(context.threads, (height + kPiece - 1) / kPiece, [&](std::int64_t piece, int) {
        const std::int64_t begin = piece * kPiece, end = begin + kPiece;
        context.kernels->finish_rows(late.params, late.buffers, std::uint32_t(begin),
                                     std::uint32_t(end < height ? end : height));
    });
    broken = 0;
    for (std::int64_t n : counts.span()) broken += std::uint64_t(n);
    return Status::ok();
}

}  // namespace pileus
