// SPDX-License-Identifier: Apache-2.0
// Takes noise out of a picture by Open Image Denoise, to compare our own filter with.
// in: noisy radiance -> out: what the library's network makes of it, other bits on other machines.
// docs/filter.md
#pragma once
#include "src/base/status.h"
#include "src/plan/array.h"

namespace pileus {

namespace arrays {

/// The picture as the library wants it. The library's own memory is its own.
inline Array<float> oidn_pixels(std::uint64_t pixels) {
    return {"picture for Open Image Denoise", bytes_of(3, pixels), Stage::kLayers, Stage::kLayers};
}

}  // namespace arrays

/// Loads the library. kBadInput, a line that begins with `key`: it is not there.
Status check_oidn(const std::string& key);

/// Replaces `colour`, [3][pixel], linear radiance. kBadInput, with `key`, where the library fails;
/// kLimit: out of memory.
Status denoise_by_oidn(const std::string& key, int width, int height, int threads, float* colour);

}  // namespace pileus
