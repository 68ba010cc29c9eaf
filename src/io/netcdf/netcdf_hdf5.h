// SPDX-License-Identifier: Apache-2.0
// NetCDF files on HDF5, by libnetcdf: an optional part.
// in: a path or bytes -> out: a handle, the head, values; without the part: one clear line.
// docs/formats.md
#pragma once
#include "src/io/netcdf/netcdf_file.h"

namespace pileus {

/// Gives a handle to close. Of bytes: they are copied by the library.
Status open_hdf5(const std::string& path, int& handle);
Status open_hdf5_bytes(const std::string& name, Span<const char> bytes, int& handle);
void close_hdf5(int handle);

Status read_hdf5_head(const std::string& name, int handle, NcHead& head);
Status read_hdf5(const std::string& name, int handle, const NcVariable& variable,
                 const NcBlock& block, Span<double> to);

}  // namespace pileus
