// SPDX-License-Identifier: Apache-2.0
// A picture as a file under a name that is free.
// in: bytes R G B A -> out: PREFIX_0001.png, or the next number.
// docs/view.md
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "src/base/status.h"

namespace pileus::view {

/// `path`: the file's name; empty where no number up to 9999 is free. kIo: it cannot be written.
Status write_screenshot(const std::string& prefix, const std::vector<std::uint8_t>& bytes,
                        int width, int height, std::string& path);

}  // namespace pileus::view
