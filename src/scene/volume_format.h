// SPDX-License-Identifier: Apache-2.0
// The kinds of files that hold a density grid: their names in a scene, their extensions, their
// unit. in: a name or a path -> out: a row of the table, which the scene's checks and the readers
// share. docs/formats.md
#pragma once
#include <string>

namespace pileus {

struct VolumeFormat {
    const char* name;       ///< value of the key medium.N.format
    const char* extension;  ///< in lower case, with its point
    bool in_extinction;     ///< values are extinction in 1/m, not relative densities
};

/// Null where there is none. A path is told by its extension, in upper or lower case.
const VolumeFormat* volume_format_named(const std::string& name);
const VolumeFormat* volume_format_of(const std::string& path);

/// "\"pbrt\", \"raw\", ..." and ".pbrt, .raw, ...", for messages.
std::string volume_format_names();
std::string volume_format_extensions();

}  // namespace pileus
