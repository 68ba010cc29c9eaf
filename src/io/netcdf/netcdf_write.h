// SPDX-License-Identifier: Apache-2.0
// Classic NetCDF files as they are made: dimensions, attributes, variables and their values.
// in: plain structs -> out: the bytes of a CDF-2 file, equal on machines of either byte order.
// Unidata, "NetCDF Classic Format Specification"; docs/formats.md
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "src/base/buffer.h"
#include "src/io/netcdf/netcdf_file.h"

namespace pileus {

using NcTexts = std::vector<std::pair<std::string, std::string>>;

/// Floats that outlive the writing, or doubles of its own; as many as its dimensions say.
struct NcNewVariable {
    std::string name;
    std::vector<std::size_t> dimensions;  ///< places in NcNewFile::dimensions, slowest first
    NcTexts texts;                        ///< attributes
    Span<const float> floats;
    std::vector<double> doubles;  ///< where there are no floats
    bool holds_floats() const { return floats.size > 0; }
};

/// What is to be in a file. Names are not checked: letters, digits and '_'.
struct NcNewFile {
    std::vector<std::pair<std::string, std::uint64_t>> dimensions;  ///< sizes from 1
    NcTexts texts;                                                  ///< attributes of the file
    std::vector<NcNewVariable> variables;  ///< one of 4 GiB or more stands last
};

/// All of the file. Out of memory: kLimit.
Status encode_netcdf(const NcNewFile& file, Buffer<char>& bytes);

/// Where the places of a row of equal cells lie between two faces: their middles, and the faces of
/// each, the outer ones exact. A coordinate and its bounds (CF conventions 1.10, section 7.1).
NcNewVariable nc_middles(const std::string& name, std::size_t dimension, double low, double high,
                         std::uint64_t cells);
NcNewVariable nc_bounds(const std::string& name, std::size_t dimension, std::size_t pair,
                        double low, double high, std::uint64_t cells);

}  // namespace pileus
