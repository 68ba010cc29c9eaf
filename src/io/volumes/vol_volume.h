// SPDX-License-Identifier: Apache-2.0
// Reader of the binary grids that Mitsuba calls "gridvolume".
// in: a header of 48 bytes and float32 values -> out: a Volume in file order.
// docs/formats.md
#pragma once
#include "src/base/span.h"
#include "src/io/volumes/volume.h"

namespace pileus {

/// Reads version 3, float32, one channel: a relative density. The box of the header is taken as
/// metres. The length must be exact. Anything else: kBadInput; more voxels or memory than allowed:
/// kLimit. `volume` is unspecified after a fault.
Status read_vol_volume(const std::string& path, Volume& volume);

/// The same from memory; `name` opens the lines of faults.
Status decode_vol_volume(const std::string& name, Span<const char> bytes, Volume& volume);

/// Size and box from the header; the values are not looked at.
Status read_vol_head(const std::string& path, VolumeHead& head);

}  // namespace pileus
