// SPDX-License-Identifier: Apache-2.0
// Big-endian numbers of any NetCDF type as doubles.
// in: bytes -> out: doubles, equal on machines of either byte order.
// docs/formats.md
#pragma once
#include <limits>
#include <vector>

#include "src/io/netcdf/netcdf_file.h"

namespace pileus {

/// Reads to.size values of `type`, not kOther, from as many times nc_bytes(type) bytes.
void nc_values(NcType type, const unsigned char* from, Span<double> to);

/// A character as `NcFile::read` gives it, 0 to 255.
inline char nc_letter(double value) { return static_cast<char>(static_cast<unsigned char>(value)); }

// How the numbers of a variable are packed, and which of them are missing. CF conventions 1.10,
// sections 2.5.1 (missing data), 8.1 (packed data).

struct NcPacking {
    std::vector<double> missing;
    double least = -std::numeric_limits<double>::infinity();
    double most = std::numeric_limits<double>::infinity();
    double scale = 1, offset = 0;  ///< value = scale * number + offset
    bool nan_is_missing = false, single = false;

    explicit NcPacking(const NcVariable& v);
    /// NaN is missing where the file says so; else it is a value.
    bool is_missing(double number) const;

private:
    void add(double number);
    void add_default(NcType type);
};

}  // namespace pileus
