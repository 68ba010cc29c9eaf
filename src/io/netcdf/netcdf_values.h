// SPDX-License-Identifier: Apache-2.0
// Big-endian numbers of any NetCDF type as doubles.
// in: bytes -> out: doubles, equal on machines of either byte order.
// docs/formats.md
#pragma once
#include "src/io/netcdf/netcdf_file.h"

namespace pileus {

/// Reads to.size values of `type`, not kOther, from as many times nc_bytes(type) bytes.
void nc_values(NcType type, const unsigned char* from, Span<double> to);

/// A character as `NcFile::read` gives it, 0 to 255.
inline char nc_letter(double value) { return static_cast<char>(static_cast<unsigned char>(value)); }

/// Rows of a variable of letters with two dimensions, as they stand but for NULs. None of one with
/// more than 64 times `most` letters. Faults of NcFile::read.
Status read_letter_rows(const NcFile& file, const NcVariable& variable, std::uint64_t most,
                        std::vector<std::string>& rows);

}  // namespace pileus
