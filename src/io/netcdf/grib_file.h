// SPDX-License-Identifier: Apache-2.0
// GRIB files as NetCDF: their fields become variables of a classic file in memory.
// in: a path that nobody vouches for -> out: bytes that NcFile reads.
// WMO, Manual on Codes, FM 92 GRIB, by ecCodes; docs/weather.md, "Files"
#pragma once
#include "src/base/buffer.h"
#include "src/io/netcdf/netcdf_file.h"

namespace pileus {

/// "GRIB yes": whether ecCodes was built in.
std::string grib_library_text();

/// Fields of hybrid levels, pressure levels and the ground on one regular grid of longitudes and
/// latitudes; all others are passed over. Not built in, no library, no such field, another grid,
/// levels or times that lack fields: kBadInput; more fields or memory than allowed: kLimit.
Status read_grib(const std::string& path, Buffer<char>& bytes);
/// The same from the bytes of a file.
Status decode_grib(const std::string& name, Span<const char> from, Buffer<char>& bytes);

}  // namespace pileus
