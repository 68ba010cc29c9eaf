// SPDX-License-Identifier: Apache-2.0
// The table of volume formats.
// in: one row for each -> out: see src/scene/rows/volume_format.h.
// docs/formats.md; docs/contributing.md, "Add a file format".
#include "src/base/file.h"
#include "src/io/volumes/particle_volume.h"
#include "src/io/volumes/vdb/vdb_file.h"
#include "src/io/volumes/volume_file.h"
#include "src/scene/rows/volume_format.h"

namespace pileus {
namespace {

/// Readers that need nothing but the path.
template <Status (*kRead)(const std::string&, Volume&)>
Status read_path(const MediumSettings&, const std::string& path, Volume& volume) {
    return kRead(path, volume);
}
template <Status (*kRead)(const std::string&, VolumeHead&)>
Status head_of_path(const MediumSettings&, const std::string& path, VolumeHead& head) {
    return kRead(path, head);
}

/// Readers that choose a grid by its name.
template <Status (*kRead)(const std::string&, const std::string&, Volume&)>
Status read_grid(const MediumSettings& medium, const std::string& path, Volume& volume) {
    return kRead(path, medium.source.grid, volume);
}
template <Status (*kRead)(const std::string&, const std::string&, VolumeHead&)>
Status head_of_grid(const MediumSettings& medium, const std::string& path, VolumeHead& head) {
    return kRead(path, medium.source.grid, head);
}

Status read_raw(const MediumSettings& medium, const std::string& path, Volume& volume) {
    return read_raw_volume(path, medium.source.raw_type, medium.source.raw_size,
                           medium.source.raw_big_endian, volume);
}
Status raw_head(const MediumSettings& medium, const std::string& path, VolumeHead& head) {
    return read_raw_head(path, medium.source.raw_type, medium.source.raw_size, head);
}
Status write_raw(const MediumSettings& medium, const std::string& path, const Volume& volume) {
    return write_raw_volume(path, medium.source.raw_type, medium.source.raw_big_endian, volume);
}
Status write_vdb(const MediumSettings&, const std::string& path, const Volume& volume) {
    return write_vdb_volume(path, volume);
}
Status write_netcdf(const MediumSettings&, const std::string& path, const Volume& volume) {
    return write_netcdf_volume(path, volume);
}

Status read_particles(const MediumSettings& medium, const std::string& path, Volume& volume) {
    return read_particle_volume(medium, path, 1, {}, volume);
}
Status particle_head(const MediumSettings& medium, const std::string& path, VolumeHead& head) {
    return read_particle_head(medium, path, {}, head);
}

// One row for a format: name, title, extensions; in extinction, several grids, weather, particles,
// bare numbers; reader, reader of the head, writer.
constexpr VolumeFormat kFormats[] = {
    {"pbrt", "pbrt text", ".pbrt", false, false, false, false, false, read_path<read_pbrt_volume>,
     head_of_path<read_pbrt_head>, nullptr},
    {"raw", "bare numbers", ".raw", false, false, false, false, true, read_raw, raw_head,
     write_raw},
    {"vol", "Mitsuba", ".vol", false, false, false, false, false, read_path<read_vol_volume>,
     head_of_path<read_vol_head>, nullptr},
    {"les", "LES text", ".txt|.les", true, false, false, false, false, read_path<read_les_volume>,
     head_of_path<read_les_head>, nullptr},
    {"openvdb", "OpenVDB", ".vdb", false, true, false, false, false, read_grid<read_vdb_volume>,
     head_of_grid<read_vdb_head>, write_vdb},
    {"nanovdb", "NanoVDB", ".nvdb", false, true, false, false, false, read_grid<read_nvdb_volume>,
     head_of_grid<read_nvdb_head>, nullptr},
    {"netcdf", "NetCDF", ".nc|.nc4|.cdf", true, false, true, false, false, read_weather_volume,
     read_weather_head, write_netcdf},
    {"grib", "GRIB", ".grib|.grib2|.grb|.grb2", true, false, true, false, false,
     read_weather_volume, read_weather_head, nullptr},
    {"ply", "PLY particles", ".ply", true, false, false, true, false, read_particles, particle_head,
     write_particle_volume},
    {"csv", "particles as text", ".csv", true, false, false, true, false, read_particles,
     particle_head, nullptr},
    {"prt", "Krakatoa PRT", ".prt", true, false, false, true, false, read_particles, particle_head,
     nullptr},
    {"bgeo", "Houdini's classic geometry", ".bgeo|.geo|.bhclassic|.hclassic", true, false, false,
     true, false, read_particles, particle_head, nullptr},
    {"pdb", "Maya PDB", ".pdb", true, false, false, true, false, read_particles, particle_head,
     nullptr},
    {"pda", "Maya PDA", ".pda", true, false, false, true, false, read_particles, particle_head,
     nullptr},
};

/// Calls `use` with each extension of a format.
template <class Use>
void for_extensions(const VolumeFormat& format, Use use) {
    std::string_view rest = format.extensions;
    for (std::size_t bar; (bar = rest.find('|')) != std::string_view::npos;
         rest.remove_prefix(bar + 1))
        use(rest.substr(0, bar));
    use(rest);
}

void append(std::string& list, const char* between, std::string_view text) {
    if (!list.empty()) list += between;
    list += text;
}

}  // namespace

Span<const VolumeFormat> volume_formats() {
    return {kFormats, sizeof kFormats / sizeof kFormats[0]};
}

const VolumeFormat* volume_format_named(const std::string& name) {
    for (const VolumeFormat& format : kFormats)
        if (name == format.name) return &format;
    return nullptr;
}

const VolumeFormat* volume_format_of(const std::string& path) {
    // Only readers of particles unpack: "smoke.bgeo.gz" is one of bgeo.
    const bool packed = file_extension(path) == ".gz";
    const std::string extension = packed_extension(path);
    const VolumeFormat* found = nullptr;
    for (const VolumeFormat& format : kFormats)
        for_extensions(format, [&](std::string_view known) {
            if (extension == known && (!packed || format.is_particles)) found = &format;
        });
    return found;
}

std::string volume_format_names() {
    std::string list;
    for (const VolumeFormat& format : kFormats)
        append(list, ", ", '"' + std::string(format.name) + '"');
    return list;
}

std::string volume_format_choices() {
    std::string list;
    for (const VolumeFormat& format : kFormats) append(list, "|", format.name);
    return list;
}

std::string volume_format_extensions(bool written, const char* between) {
    std::string list;
    for (const VolumeFormat& format : kFormats)
        if (!written || format.write != nullptr)
            for_extensions(format, [&](std::string_view known) { append(list, between, known); });
    return list;
}

std::string grid_format_titles() {
    std::string list;
    for (const VolumeFormat& format : kFormats)
        if (format.has_grids) append(list, " and ", format.title);
    return list;
}

std::string grid_format_extensions() {
    std::string list;
    for (const VolumeFormat& format : kFormats)
        if (format.has_grids)
            for_extensions(format, [&](std::string_view known) { append(list, " or ", known); });
    return list;
}

}  // namespace pileus
