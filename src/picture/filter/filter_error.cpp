// SPDX-License-Identifier: Apache-2.0
// See filter_error.h.
#include "src/picture/filter/filter_error.h"

#include "platform/threads.h"

namespace pileus {
namespace {

constexpr int kErrorTile = 8;                   // pixels
constexpr int kEach = 4 * PixelGroups::kCount;  // of each group three colours' squares, and pixels

int tiles(int pixels) { return (pixels + kErrorTile - 1) / kErrorTile; }

}  // namespace

Array<double> arrays::error_tiles(int width, int height) {
    return {"sums of the filter",
            bytes_of(kEach, std::uint64_t(tiles(width)) * std::uint64_t(tiles(height))),
            Stage::kLayers, Stage::kLayers};
}

Status smooth_error(int threads, const PixelGroups& groups, Buffer<float>& error) {
    const int width = groups.width, height = groups.height;
    const int across = tiles(width), down = tiles(height);
    const std::size_t pixels = std::size_t(width) * std::size_t(height);
    Buffer<double> sums;
    PILEUS_TRY(allocate(arrays::error_tiles(width, height), sums));
    const auto tile_at = [&](int tx, int ty) {
        return sums.data() + kEach * (std::size_t(ty) * std::size_t(across) + std::size_t(tx));
    };
    parallel_for(threads, down, [&](std::int64_t ty, int) {
        const int end = int(ty + 1) * kErrorTile < height ? int(ty + 1) * kErrorTile : height;
        for (int y = int(ty) * kErrorTile; y < end; ++y)
            for (int x = 0; x < width; ++x) {
                const std::size_t i = std::size_t(y) * std::size_t(width) + std::size_t(x);
                if (error[i] < 0) continue;
                double* own = tile_at(x / kErrorTile, int(ty)) + 4 * groups.of(i);
                own[3] += 1;
                for (std::size_t c = 0; c < 3; ++c) own[c] += double(error[c * pixels + i]);
            }
    });
    parallel_for(threads, down, [&](std::int64_t ty, int) {
        for (int tx = 0; tx < across; ++tx) {
            double all[kEach] = {};
            for (int v = int(ty) - 1; v <= int(ty) + 1; ++v)
                for (int u = tx - 1; u <= tx + 1; ++u)
                    for (int n = 0; n < kEach && v >= 0 && v < down && u >= 0 && u < across; ++n)
                        all[n] += tile_at(u, v)[n];
            for (int y = int(ty) * kErrorTile; y < int(ty + 1) * kErrorTile && y < height; ++y)
                for (int x = tx * kErrorTile; x < (tx + 1) * kErrorTile && x < width; ++x) {
                    const std::size_t i = std::size_t(y) * std::size_t(width) + std::size_t(x);
                    const double* own = all + 4 * groups.of(i);
                    for (std::size_t c = 0; c < 3; ++c)
                        error[c * pixels + i] =
                            own[3] > 0 ? float(__builtin_sqrt(own[c] / own[3])) : 0.0f;
                }
        }
    });
    return Status::ok();
}

}  // namespace pileus
