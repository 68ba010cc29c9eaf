// SPDX-License-Identifier: Apache-2.0
// See vdb_transform.h.
#include "src/io/volumes/vdb/vdb_transform.h"

#include <cmath>

#include "src/base/number_text.h"
#include "src/scene/toml/toml_tree.h"

namespace pileus {

namespace {

/// A quarter turn in single precision leaves 4.4e-8 of a step along another axis. So much as this
/// moves the end of the longest side, 4096 voxels, by less than a hundredth of one.
constexpr double kResidue = 1e-6;

}  // namespace

std::string VdbTransform::axes_text() const {
    std::string text = "axes";
    for (std::size_t a = 0; a < 3; ++a)
        text += std::string(scale[a] < 0 ? " -" : " ") + "xyz"[world[a]];
    return text;
}

Status set_vdb_axes(const ByteCursor& in, const std::array<std::array<double, 3>, 3>& matrix,
                    VdbTransform& transform) {
    bool taken[3] = {false, false, false}, sound = true;
    for (std::size_t a = 0; a < 3; ++a) {
        const std::array<double, 3>& step = matrix[a];
        std::size_t longest = 0;
        for (std::size_t w = 1; w < 3; ++w)
            if (std::fabs(step[w]) > std::fabs(step[longest])) longest = w;
        for (std::size_t w = 0; w < 3; ++w)
            if (w != longest && !(std::fabs(step[w]) <= kResidue * std::fabs(step[longest])))
                sound = false;
        // A step of no length has no axis: it is refused as a scale of 0.
        if (step[longest] == 0) longest = a;
        sound = sound && !taken[longest];
        taken[longest] = true;
        transform.world[a] = int(longest);
        transform.scale[a] = step[longest];
    }
    if (sound) return Status::ok();
    return in.fault(
        "transform: rotated or sheared, allowed: scale and translation along the axes, which may "
        "be exchanged and mirrored");
}

Status check_vdb_transform(const ByteCursor& in, const VdbTransform& transform) {
    for (std::size_t a = 0; a < 3; ++a) {
        const double size = std::fabs(transform.scale[a]), at = transform.translation[a];
        if (!(size >= 1e-9 && size <= 1e9))
            return in.fault("scale: out of range, " + number_text(transform.scale[a]) +
                            ", allowed: 1e-9 to 1e9, either way");
        if (!(at >= -1e12 && at <= 1e12))
            return in.fault("translation: out of range, " + number_text(at) +
                            ", allowed: -1e12 to 1e12");
    }
    return Status::ok();
}

}  // namespace pileus
