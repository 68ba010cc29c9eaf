// SPDX-License-Identifier: Apache-2.0
// Planes of one picture into pixels of a caller's own memory, and depths to and from it.
// in: Planes, a buffer's layout -> out: colour written or blended over, depths in the caller's
// kind. docs/embedding.md, "Pixels" and "Depth".
#pragma once
#include "kernels_cpu/core/camera.h"
#include "kernels_cpu/isa/kernels.h"
#include "src/picture/layers.h"
#include "src/world/camera/matrices.h"
#include "src/world/solids/camera_depth.h"

namespace pileus {

enum class PixelFormat { kRgba8Srgb, kRgba16F, kRgba32F, kBgra8Srgb, kRgb10A2Srgb };
enum class PixelBlend { kReplace, kOver, kMedia };
enum class DepthKind { kDistance, kViewZ, kBuffer };

/// Rows in a caller's memory; `stride` bytes from one to the next.
struct Rows {
    unsigned char* first = nullptr;
    std::int64_t stride = 0;
    bool bottom_up = false;

    unsigned char* row(int y, int height) const {
        return first + stride * (bottom_up ? height - 1 - y : y);
    }
};

struct PixelTarget {
    Rows rows;
    PixelFormat format = PixelFormat::kRgba8Srgb;
    PixelBlend blend = PixelBlend::kReplace;
    float stops = 0;  ///< of 8-bit and 10-bit pixels
};

/// Bytes of a pixel.
std::size_t pixel_bytes(PixelFormat format);

/// Writes or blends a picture; what is below 0 or no number counts as 0 and is counted in `broken`.
/// Blending other than kReplace needs the media's own light: planes with a background, or `cloud`.
/// `kernels` where given are quicker, with the same bits. kLimit: out of memory.
Status write_pixels(const Planes& planes, int width, int height, const PixelTarget& target,
                    const KernelTable* kernels, int threads, std::uint64_t& broken);

/// As pixel_hash of the picture's image.
std::uint64_t hash_planes(const Planes& planes);

/// Depths of a caller as metres along each ray. kLimit: out of memory.
Status take_depths(const Rows& rows, DepthKind kind, const DepthScale& scale,
                   const CameraParams& camera, CameraDepth& depth);

/// Metres to half of the light, or to something opaque before it, in the caller's kind; as halves
/// or floats.
void write_depths(const Planes& planes, const CameraParams& camera, DepthKind kind, bool halves,
                  const DepthScale& scale, const Rows& rows);

/// Nearest half of a float, ties to even.
std::uint16_t half_of(float value);
float float_of_half(std::uint16_t half);

}  // namespace pileus
