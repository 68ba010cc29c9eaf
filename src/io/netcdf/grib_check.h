// SPDX-License-Identifier: Apache-2.0
// Whether a GRIB field has a time that there is and all its values, before a library looks at them.
// in: sections of sound lengths and the size of the grid -> out: a fault, or nothing.
// WMO, Manual on Codes, FM 92 GRIB: sections 1 and 3 to 7; edition 1: 1 to 4
#pragma once
#include <string>

#include "src/io/netcdf/grib_message.h"

namespace pileus {

/// What is wrong with the grid section, the bitmap or the packed values of a field on a grid of
/// `nx` times `ny` points on rows of equal length: "bits per value: 64, allowed: 0 to 32". Empty:
/// nothing. Packings that are read: simple, complex with and without differences, IEEE floats, JPEG
/// 2000, PNG, CCSDS; of edition 1 simple alone.
std::string grib_values_fault(const GribSections& sections, std::uint64_t nx, std::uint64_t ny);

/// What is wrong with its product, its date or its forecast time: "month: 13, allowed: 1 to 12".
std::string grib_time_fault(const GribSections& sections);

}  // namespace pileus
