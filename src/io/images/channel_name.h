// SPDX-License-Identifier: Apache-2.0
// Names of channels as .exr files have them: "a.b.R" is channel R of layer a.b.
// in: a name -> out: its layer, and the word behind the last point.
// docs/formats.md, "Pictures in"
#pragma once
#include <string>

#include "src/base/printable.h"

namespace pileus {

/// Empty: of the picture itself.
inline std::string layer_of(const std::string& channel) {
    const std::size_t point = channel.rfind('.');
    return point == std::string::npos ? "" : channel.substr(0, point);
}

/// In small letters.
inline std::string last_of(const std::string& name) {
    return lower_case(name.substr(name.rfind('.') + 1));
}

}  // namespace pileus
