// SPDX-License-Identifier: Apache-2.0
// NanoVDB fog volumes: our own strict reader.
// in: the bytes of a .nvdb file, trusting none of them -> out: a Volume.
// docs/formats.md
#pragma once
#include "src/io/volumes/vdb/vdb_file.h"

namespace pileus {

/// Decodes the grid called `grid`, or where that is empty the first of numbers that is no level
/// set. `name` opens every line. The volume is the box of the active voxels, in the file's axes,
/// with inactive ones 0 and bounds_m from the grid's map. Damaged or not of the accepted kind, also
/// a negative or not finite voxel: kBadInput; more than the limits or memory: kLimit. Time and
/// memory are bounded by the limits and the number of bytes.
Status decode_nvdb(const std::string& name, Span<const char> bytes, const std::string& grid,
                   const VdbLimits& limits, Volume& volume);

/// Size, place and kind of what decode_nvdb would give; no voxel's value is decoded. Faults as
/// decode_nvdb's, except for those of voxels.
Status decode_nvdb_head(const std::string& name, Span<const char> bytes, const std::string& grid,
                        const VdbLimits& limits, VolumeHead& head);

/// The same from a file; reading failed half way: kIo.
Status read_nvdb_volume(const std::string& path, const std::string& grid, Volume& volume);
Status read_nvdb_head(const std::string& path, const std::string& grid, VolumeHead& head);

}  // namespace pileus
