// SPDX-License-Identifier: Apache-2.0
// How the numbers of a variable are packed, and which of them are missing.
// in: a variable's attributes -> out: its scale, and a test for each number as it stands in the
// file. CF conventions 1.10, sections 2.5.1 (missing data), 8.1 (packed data).
#pragma once
#include <limits>
#include <vector>

#include "src/io/netcdf/netcdf_file.h"

namespace pileus {

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
