// SPDX-License-Identifier: Apache-2.0
// Pictures as NetCDF: each channel a variable on rows and columns, in metres where a map is known.
// in: an Image -> out: the bytes of a classic file with CF attributes.
// docs/formats.md, "NetCDF"; CF conventions 1.10
#include "src/base/number_text.h"
#include "src/io/images/image_file.h"
#include "src/io/netcdf/netcdf_write.h"

namespace pileus {
namespace {

const std::string* origin_of(const Image& image, const char* name) {
    for (const auto& [key, text] : image.origin)
        if (key == name) return &text;
    return nullptr;
}

/// "west south east north" in metres of the map; false where the picture is no map.
bool extent_of(const Image& image, double (&extent)[4]) {
    const std::string* text = origin_of(image, "extent_m");
    if (text == nullptr) return false;
    const char* at = text->data();
    const char* end = at + text->size();
    for (double& value : extent) {
        while (at < end && *at == ' ') ++at;
        const auto read = number_from(at, end, value);
        if (read.ec != std::errc()) return false;
        at = read.ptr;
    }
    return extent[0] < extent[2] && extent[1] < extent[3];
}

/// "cloud.R" -> "cloud_R": points are not for names of CF variables.
std::string variable_name(std::string channel) {
    for (char& c : channel)
        if (!((c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'))) c = '_';
    return channel[0] >= '0' && channel[0] <= '9' ? "_" + channel : channel;
}

/// What a channel holds, and its unit.
NcTexts texts_of(const std::string& channel) {
    const std::size_t point = channel.rfind('.');
    const std::string layer = point == std::string::npos ? "" : channel.substr(0, point);
    const std::string last = point == std::string::npos ? channel : channel.substr(point + 1);
    const bool colour = last == "R" || last == "G" || last == "B" || last == "Y";
    if (layer == "reflectance")
        return {{"units", "1"}, {"long_name", "reflectance, pi L over mu0 E, channel " + last}};
    if (layer.empty() && colour)
        return {{"units", "sr-1"},
                {"long_name", "radiance in the unit of the sun's irradiance, channel " + last}};
    if (layer.empty() && channel == "A") return {{"units", "1"}, {"long_name", "opacity"}};
    if (layer.empty() && channel == "Z")
        return {{"units", "m"}, {"long_name", "distance from the camera"}};
    return {{"long_name", "layer " + channel}};
}

}  // namespace

Status encode_netcdf_picture(const Image& image, Buffer<char>& bytes) {
    NcNewFile file;
    file.texts = {{"Conventions", "CF-1.10"}, {"source", "pileus"}};
    if (!image.pixel_hash.empty()) file.texts.emplace_back("pileus_pixel_hash", image.pixel_hash);
    if (!image.scene_text.empty()) file.texts.emplace_back("pileus_scene", image.scene_text);
    for (const auto& [name, text] : image.origin)
        file.texts.emplace_back("pileus_" + variable_name(name), text);
    file.dimensions = {{"y", std::uint64_t(image.height)}, {"x", std::uint64_t(image.width)}};
    double extent[4];
    const bool is_map = extent_of(image, extent);
    const std::string* projection = origin_of(image, "projection");
    if (is_map) {
        // Rows come from the north.
        file.variables.push_back(
            nc_middles("y", 0, extent[3], extent[1], std::uint64_t(image.height)));
        file.variables.back().texts = {
            {"units", "m"}, {"axis", "Y"}, {"standard_name", "projection_y_coordinate"}};
        file.variables.push_back(
            nc_middles("x", 1, extent[0], extent[2], std::uint64_t(image.width)));
        file.variables.back().texts = {
            {"units", "m"}, {"axis", "X"}, {"standard_name", "projection_x_coordinate"}};
    }
    if (is_map && projection != nullptr) {
        NcNewVariable map;
        map.name = "crs";
        map.doubles = {0};
        map.texts = {{"proj4", *projection}};
        file.variables.push_back(map);
    }
    for (const Channel& channel : image.channels) {
        NcNewVariable v;
        v.name = variable_name(channel.name);
        v.dimensions = {0, 1};
        v.texts = texts_of(channel.name);
        if (is_map && projection != nullptr) v.texts.emplace_back("grid_mapping", "crs");
        v.floats = channel.pixels.span();
        file.variables.push_back(v);
    }
    return encode_netcdf(file, bytes);
}

}  // namespace pileus
