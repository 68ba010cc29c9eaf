// SPDX-License-Identifier: Apache-2.0
// OpenVDB fog volumes: our own strict reader, and a writer.
// in: the bytes of a .vdb file, trusting none of them -> out: a Volume; and the way back.
// docs/formats.md
#pragma once
#include <string>

#include "src/base/buffer.h"
#include "src/base/span.h"
#include "src/base/status.h"
#include "src/io/volumes/volume.h"

namespace pileus {

constexpr std::uint64_t kMaxVdbFileBytes = std::uint64_t{1} << 36;

/// How much a file may ask for. Tiles and far corners fill large boxes from few bytes, so that the
/// cells of the box are bounded by free_cells + cells_per_byte * (bytes of the file) as well.
struct VdbLimits {
    std::uint64_t max_cells = std::uint64_t{1} << 31;
    std::uint64_t free_cells = std::uint64_t{1} << 24;
    std::uint64_t cells_per_byte = 512;
};

/// Decodes the grid called `grid`, or where that is empty the first of floats that is no level set.
/// `name` opens every line. The volume is the box of the active voxels, in the file's axes, with
/// inactive ones 0 and bounds_m from the grid's transform. Damaged or not of the accepted kind,
/// also a negative or not finite voxel: kBadInput; more than the limits or memory: kLimit. Time and
/// memory are bounded by the limits and the number of bytes.
Status decode_vdb(const std::string& name, Span<const char> bytes, const std::string& grid,
                  const VdbLimits& limits, Volume& volume);

/// Size, place and kind of what decode_vdb would give, from the grid's masks alone: no voxel's
/// value is decoded. Faults as decode_vdb's, except for those of values.
Status decode_vdb_head(const std::string& name, Span<const char> bytes, const std::string& grid,
                       const VdbLimits& limits, VolumeHead& head);

/// The same from a file; reading failed half way: kIo.
Status read_vdb_volume(const std::string& path, const std::string& grid, Volume& volume);
Status read_vdb_head(const std::string& path, const std::string& grid, VolumeHead& head);

/// The file's bytes: one FloatGrid "density", class "fog volume", format version 224. Voxels that
/// are 0 are inactive; a volume without a place gets cells of one metre from the origin. `zip`
/// needs zlib, otherwise it is left out. Equal volumes give equal bytes (with one zlib).
/// Out of memory: kLimit.
Status encode_vdb(const Volume& volume, bool zip, Buffer<char>& bytes);

/// encode_vdb into a file, compressed where zlib is there. Cannot write: kIo, and no file is left.
Status write_vdb_volume(const std::string& path, const Volume& volume);

// NanoVDB fog volumes: our own strict reader.

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
