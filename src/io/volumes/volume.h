// SPDX-License-Identifier: Apache-2.0
// A regular grid of relative densities as the readers and the procedural makers hand it over.
// in: a file or parameters -> out: nx*ny*nz floats, x fastest, z up, cell-centred.
// docs/methods.md 1, docs/formats.md.
#pragma once
#include <array>
#include <cstdint>
#include <string>

#include "src/base/buffer.h"
#include "src/base/vectors.h"

namespace pileus {

struct Volume {
    std::array<int, 3> size{0, 0, 0};  ///< cells along x, y, z; each 1..kMaxVolumeSide
    /// Index (z*ny + y)*nx + x; finite, >= 0. Of a variable that a transfer function shows: of any
    /// sign, and NaN where there is nothing.
    Buffer<float> density;
    bool knows_bounds = false;          ///< the file says where its box lies
    std::array<Double3, 2> bounds_m{};  ///< outer faces of the box, metres
    bool in_extinction = false;         ///< values are extinction in 1/m, not relative densities
    std::uint64_t missing = 0;          ///< values of the file that are none, taken for no cloud
    std::uint64_t clamped = 0;          ///< values below 0 by a little, taken for 0
    std::uint64_t blank = 0;  ///< columns of the file without any value, taken for no cloud
    std::uint64_t capped =
        0;                    ///< cells of the file with more water than their cloud fraction tells
    std::uint64_t plain = 0;  ///< particles whose own colour or emission a grid has no place for
};

/// What a file says about itself before its values are read.
struct VolumeHead {
    std::array<int, 3> size{0, 0, 0};  ///< within the limits of check_volume_size
    bool knows_bounds = false;
    std::array<Double3, 2> bounds_m{};
    bool in_extinction = false;
    std::uint64_t unpacked_bytes = 0;  ///< held beside the file while it is read
    bool in_pieces = false;            ///< the file is never held whole
    std::string kind;                  ///< "pbrt text volume", "OpenVDB fog volume"
    std::string detail;  ///< one line a reader may add: grid names, compression; may be empty
};

}  // namespace pileus
