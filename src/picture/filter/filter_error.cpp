// SPDX-License-Identifier: Apache-2.0
// See filter_error.h.
#include "src/picture/filter/filter_error.h"

#include "platform/threads.h"

namespace pileus {
namespace {

constexpr int kErrorTile = 8;  // pixels

int tiles(int pixels) { return (pixels + kErrorTile - 1) / kErrorTile; }

}  // namespace

Array<double> arrays::error_tiles(int width, int height) {
    return {"sums of the filter",
            bytes_of(4, std::uint64_t(tiles(width)) * std::uint64_t(tiles(height))), Stage::kLayers,
            Stage::kLayers};
}

Status smooth_error(int threads, int width, int height, Buffer<float>& error) {
    const int across = tiles(width), down = tiles(height);
    const std::size_t pixels = std::size_t(width) * std::size_t(height);
    Buffer<double> sums;
    PILEUS_TRY(allocate(arrays::error_tiles(width, height), sums));
    parallel_for(threads, down, [&](std::int64_t ty, int) {
        const int end = int(ty + 1) * kErrorTile < height ? int(ty + 1) * kErrorTile : height;
        for (int y = int(ty) * kErrorTile; y < end; ++y)
            for (int x = 0; x < width; ++x) {
                double* tile = sums.data() + 4 * (std::size_t(ty) * std::size_t(across) +
                                                  std::size_t(x / kErrorTile));
                const std::size_t i = std::size_t(y) * std::size_t(width) + std::size_t(x);
                tile[3] += 1;
                for (std::size_t c = 0; c < 3; ++c) tile[c] += double(error[c * pixels + i]);
            }
    });
    parallel_for(threads, down, [&](std::int64_t ty, int) {
        for (int tx = 0; tx < across; ++tx) {
            double all[4] = {};
            for (int v = int(ty) - 1; v <= int(ty) + 1; ++v)
                for (int u = tx - 1; u <= tx + 1; ++u)
                    for (int n = 0; n < 4 && v >= 0 && v < down && u >= 0 && u < across; ++n)
                        all[n] += sums[4 * (std::size_t(v) * std::size_t(across) + std::size_t(u)) +
                                       std::size_t(n)];
            for (int y = int(ty) * kErrorTile; y < int(ty + 1) * kErrorTile && y < height; ++y)
                for (int x = tx * kErrorTile; x < (tx + 1) * kErrorTile && x < width; ++x)
                    for (std::size_t c = 0; c < 3; ++c)
                        error[c * pixels + std::size_t(y) * std::size_t(width) + std::size_t(x)] =
                            float(__builtin_sqrt(all[c] / all[3]));
        }
    });
    return Status::ok();
}

}  // namespace pileus
