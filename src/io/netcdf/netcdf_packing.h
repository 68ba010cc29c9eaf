// SPDX-License-Identifier: Apache-2.0
// How the numbers of a variable are packed, and which of them are missing.
// in: attributes of a variable -> out: values as they are meant, or the line of one that says
// nothing. CF conventions 1.10, 2.5.1 (missing data), 8.1 (packed data); NetCDF Users Guide,
// "Attribute conventions".
#pragma once
#include <limits>
#include <vector>

#include "src/io/netcdf/netcdf_file.h"

namespace pileus {

class NcPacking {
public:
    /// An attribute that is there and of another type or size than it must be: kBadInput.
    static Status of(const std::string& file, const NcVariable& variable, NcPacking& packing);

    /// A number of the file as it is meant; false where it is missing. Not a number is missing
    /// where the file says so, else it is a value.
    bool take(double number, double& value) const;

private:
    friend class NcPackingReader;

    double with_sign(double number) const;

    std::vector<double> missing_;
    double least_ = -std::numeric_limits<double>::infinity();
    double most_ = std::numeric_limits<double>::infinity();
    double scale_ = 1, offset_ = 0;  ///< value = scale * number + offset
    /// Of _Unsigned: numbers outside [low, low + span) are a span away; span 0: none are.
    double low_ = 0, span_ = 0;
    bool nan_is_missing_ = false;
};

/// A block of a variable as it is meant, missing values as NaN. Faults of reading and of packing.
Status read_unpacked(const NcFile& file, const NcVariable& variable, const NcBlock& block,
                     Span<double> to);

/// The text of an attribute, "" where there is none. Of another type: kBadInput.
Status read_text(const std::string& file, const NcVariable& variable, const char* name,
                 std::string& text);

}  // namespace pileus
