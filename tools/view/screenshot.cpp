// SPDX-License-Identifier: Apache-2.0
// See screenshot.h.
#include "tools/view/screenshot.h"

#include <fmt/format.h>

#include <fstream>

#include "src/base/file.h"
#include "src/io/images/image_file.h"

namespace pileus::view {

Status write_screenshot(const std::string& prefix, const std::vector<std::uint8_t>& bytes,
                        int width, int height, std::string& path) {
    Buffer<std::uint8_t> rgb;
    PILEUS_TRY(rgb.resize(bytes.size() / 4 * 3, "screenshot"));
    for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] = bytes[i / 3 * 4 + i % 3];
    Buffer<char> file;
    PILEUS_TRY(encode_png(width, height, {rgb.data(), rgb.size()}, file));
    for (int n = 1; n < 10000; ++n) {
        path = fmt::format("{}_{:04}.png", prefix, n);
        if (!std::ifstream(path).good()) return write_file(path, {file.data(), file.size()});
    }
    path.clear();
    return Status::ok();
}

}  // namespace pileus::view
