// SPDX-License-Identifier: Apache-2.0
// The kinds of files that hold a density grid: names, extensions, unit, who reads and writes them.
// in: the table in src/io/volumes/volume_formats.cpp -> out: rows for checks, readers, writers.
// docs/formats.md; docs/contributing.md, "Add a file format".
#pragma once
#include <string>

#include "src/base/span.h"
#include "src/base/status.h"
#include "src/scene/scene.h"

namespace pileus {

struct Volume;
struct VolumeHead;

struct VolumeFormat {
    const char* name;        ///< value of the key medium.N.format
    const char* title;       ///< as its makers call it
    const char* extensions;  ///< in lower case, with their points, parted by '|'
    bool in_extinction;      ///< values are extinction in 1/m, not relative densities
    bool has_grids;          ///< a file may hold several, so that the key medium.N.grid counts
    bool is_weather;         ///< made from variables, by keys and on cells that the scene may state
    bool is_particles;       ///< no cells: particles, on cells that the scene may state
    bool bare;               ///< numbers only: the scene states their type, size and place
    /// A whole file, in its own axes. Errors: those of readers.
    Status (*read)(const MediumSettings& medium, const std::string& path, Volume& volume);
    /// Size, place and kind without the values.
    Status (*read_head)(const MediumSettings& medium, const std::string& path, VolumeHead& head);
    /// Null where there is no writer.
    Status (*write)(const MediumSettings& medium, const std::string& path, const Volume& volume);
};

/// All, in the order of messages.
Span<const VolumeFormat> volume_formats();

/// Null where there is none. A path is told by its extension, in upper or lower case.
const VolumeFormat* volume_format_named(const std::string& name);
const VolumeFormat* volume_format_of(const std::string& path);

/// Whether a format of this name holds particles; no format has none.
inline bool is_particle_format(const std::string& name) {
    const VolumeFormat* format = volume_format_named(name);
    return format != nullptr && format->is_particles;
}
/// Likewise weather data.
inline bool is_weather_format(const std::string& name) {
    const VolumeFormat* format = volume_format_named(name);
    return format != nullptr && format->is_weather;
}

/// "\"pbrt\", \"raw\", ...", for messages; the same parted by '|' for the table of keys.
std::string volume_format_names();
std::string volume_format_choices();

/// ".pbrt, .raw, ..." of all, or of those that can be written.
std::string volume_format_extensions(bool written = false, const char* between = ", ");

/// "OpenVDB and NanoVDB": titles of the formats that hold several grids; their extensions.
std::string grid_format_titles();
std::string grid_format_extensions();

}  // namespace pileus
