// SPDX-License-Identifier: Apache-2.0
// Reader of clouds that large-eddy simulations leave as text: liquid water and droplet size.
// in: sparse rows parted by commas, or dense rows parted by blanks -> out: extinction in 1/m.
// docs/formats.md
#pragma once
#include "src/base/span.h"
#include "src/io/volumes/volume.h"

namespace pileus {

/// Reads either text form, told apart by the first line that is no comment: commas or none. Values
/// are extinction in 1/m, 1.5 LWC / r_eff with LWC in g/m3 and r_eff in um (geometric optics,
/// Q_ext = 2). A stretched grid is laid on equal layers, keeping every column's optical depth. With
/// one level only, the place is not known. Contents at fault: kBadInput with file:line:column; more
/// voxels than a text of that length can mean, or than allowed: kLimit. `volume` is unspecified
/// after a fault.
Status read_les_volume(const std::string& path, Volume& volume);

/// The same from memory; `name` opens the lines of faults.
Status decode_les_volume(const std::string& name, Span<const char> text, Volume& volume);

/// Size, place and kind from the head lines; faults of the rows are not looked for.
Status read_les_head(const std::string& path, VolumeHead& head);

}  // namespace pileus
