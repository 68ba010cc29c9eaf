// SPDX-License-Identifier: Apache-2.0
// The kinds of files that hold a density grid.
// in: a name or a path -> out: see volume_format.h.
// docs/formats.md
#include "src/scene/volume_format.h"

#include "src/base/file.h"

namespace pileus {
namespace {

// One row for an extension; rows of one name stand together and agree in their unit.
constexpr VolumeFormat kFormats[] = {
    {"pbrt", ".pbrt", false},    {"raw", ".raw", false}, {"vol", ".vol", false},
    {"les", ".txt", true},       {"les", ".les", true},  {"openvdb", ".vdb", false},
    {"nanovdb", ".nvdb", false},
};

}  // namespace

const VolumeFormat* volume_format_named(const std::string& name) {
    for (const VolumeFormat& format : kFormats)
        if (name == format.name) return &format;
    return nullptr;
}

const VolumeFormat* volume_format_of(const std::string& path) {
    const std::string extension = file_extension(path);
    for (const VolumeFormat& format : kFormats)
        if (extension == format.extension) return &format;
    return nullptr;
}

std::string volume_format_names() {
    std::string list, last;
    for (const VolumeFormat& format : kFormats) {
        if (last == format.name) continue;
        last = format.name;
        list += (list.empty() ? "\"" : ", \"") + last + '"';
    }
    return list;
}

std::string volume_format_extensions() {
    std::string list;
    for (const VolumeFormat& format : kFormats)
        list += std::string(list.empty() ? "" : ", ") + format.extension;
    return list;
}

}  // namespace pileus
