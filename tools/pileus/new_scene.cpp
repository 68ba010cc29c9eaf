// SPDX-License-Identifier: Apache-2.0
// See new_scene.h.
// in: rows of types -> out: keys with values; what they mean is said by the rows of the keys.
// docs/program.md, "new"
#include "tools/pileus/new_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "platform/fs_path.h"
#include "src/base/file.h"
#include "src/base/printable.h"
#include "src/io/volumes/volume_file.h"
#include "src/scene/checks/key_words.h"
#include "src/scene/media/cloud_types.h"
#include "src/scene/rows/volume_format.h"

namespace pileus {
namespace {

/// A key and its value as TOML.
struct NewKey {
    std::string path, value;
};
using NewKeys = std::vector<NewKey>;

/// Where one stands and looks, and where the sun is.
struct NewView {
    const char *position, *target, *fov;
    int azimuth, elevation;
};

struct NewType {
    const char* name;
    const char* what;
    NewView view;
    const char* keys;  ///< "path = value" a line; with a density, in place of a cloud of the name
};

constexpr NewType kTypes[] = {
    {"cumulus-humilis",
     "a flat fair-weather cumulus, from 2.5 km",
     {"[0, -2500, 300]", "[0, 0, 1010]", "17", 275, 35},
     nullptr},
    {"cumulus-mediocris",
     "a cumulus as high as wide, from 4 km",
     {"[0, -4000, 400]", "[0, 0, 1200]", "22", 275, 35},
     nullptr},
    {"cumulus-congestus",
     "a towering cumulus, from 6 km",
     {"[0, -6200, 500]", "[0, 0, 1560]", "21", 275, 32},
     nullptr},
    {"cumulonimbus",
     "a thunderstorm with its anvil, from 30 km",
     {"[0, -30000, 400]", "[2500, 0, 5600]", "40", 275, 22},
     "method.name = \"path\"\n"
     "path.samples_per_pixel = 4\n"
     "filter.kind = \"regression\"\n"},
    {"cumulus-field",
     "many cumuli on one base, from the ground",
     {"[0, -4600, 120]", "[0, 0, 1250]", "50", 240, 48},
     nullptr},
    {"stratocumulus",
     "a sheet of closed cells to the horizon, from above",
     {"[0, -2000, 1700]", "[0, 2000, 1000]", "45", 300, 20},
     nullptr},
    {"stratocumulus-open",
     "cells with clear middles to the horizon, from above",
     {"[0, -4000, 2600]", "[0, 2000, 1000]", "50", 300, 25},
     nullptr},
    {"altocumulus",
     "a high layer of small cells, from the ground",
     {"[0, 0, 100]", "[0, 5000, 3300]", "60", 200, 35},
     nullptr},
    {"altocumulus-lenticularis",
     "smooth lenses in a standing wave, from the ground",
     {"[0, -14000, 1200]", "[600, 0, 4600]", "30", 290, 14},
     nullptr},
    {"stratus",
     "a low grey sheet, from above",
     {"[0, -1500, 1000]", "[0, 1500, 550]", "45", 300, 15},
     nullptr},
    {"nimbostratus",
     "a thick grey layer that hides the sun, from beneath",
     {"[0, 0, 100]", "[0, 4000, 900]", "60", 200, 35},
     nullptr},
    {"fog",
     "fog on the ground, from a hill",
     {"[0, -900, 220]", "[0, 600, 60]", "45", 300, 8},
     nullptr},
    {"cirrus",
     "streaks of ice, from the ground",
     {"[0, 0, 100]", "[0, 9000, 8000]", "60", 200, 35},
     nullptr},
    {"cirrus-uncinus",
     "hooks of ice with long tails, from the ground",
     {"[0, 0, 100]", "[0, 9000, 8000]", "60", 200, 35},
     nullptr},
    {"cirrostratus",
     "a veil of ice before the sun, from the ground",
     {"[0, 0, 100]", "[0, 9000, 6000]", "60", 90, 30},
     nullptr},
    {"sky",
     "broken cumuli without bounds, from between base and top",
     {"[0, 0, 1900]", "[300, 4000, 1250]", "55", 275, 24},
     "medium.N.density = \"procedural:sky\"\n"
     "medium.N.sky.type = \"cumulus\"\n"
     "medium.N.sky.coverage = 0.35\n"
     "medium.N.sky.seed = 5\n"
     "medium.N.sky.planet_radius_m = 6371000\n"},
    {"smoke",
     "a plume of particles over a stack",
     {"[0, -560, 60]", "[0, 0, 112]", "24", 110, 35},
     "medium.N.density = \"procedural:plume\"\n"
     "medium.N.bounds_m = [[-60, -60, 0], [60, 60, 220]]\n"
     "medium.N.extinction_per_m = 6\n"
     "medium.N.albedo = 0.98\n"
     "medium.N.phase.type = \"henyey-greenstein\"\n"
     "medium.N.phase.g = 0.6\n"
     "medium.N.plume.particles = 100000\n"
     "method.name = \"particles\"\n"
     "particles.scattering = \"octaves\"\n"},
    {"box",
     "a box of even density, the least that a scene needs",
     {"[0, -400, 120]", "[0, 0, 60]", "30", 120, 40},
     "medium.N.density = \"uniform:box\"\n"
     "medium.N.bounds_m = [[-50, -50, 10], [50, 50, 110]]\n"
     "medium.N.extinction_per_m = 0.1\n"
     "medium.N.albedo = 1\n"
     "medium.N.phase.type = \"henyey-greenstein\"\n"
     "medium.N.phase.g = 0.85\n"},
};

const KeyRow& row_of(const std::string& path) {
    const KeyRow* found = nullptr;
    for (const KeyRow* row : all_scene_keys())
        if (path == row->path) found = row;
    if (found == nullptr) std::abort();  // a path of this file
    return *found;
}

/// "where the sun stands; deg; default 0".
std::string comment_of(const KeyRow& row) {
    std::string text = meaning_of(row);
    if (row.kind() == KeyKind::kChoice || row.allowed.choices != nullptr)
        text += "; " + allowed_text(row);
    if (*row.unit != '\0') text += std::string("; ") + row.unit;
    const std::string fallback = default_text(row);
    if (row.required()) return text + "; must be given";
    return fallback.empty() ? text : text + "; default " + fallback;
}

/// "medium.N.cloud" and "type" of "medium.N.cloud.type".
std::pair<std::string, std::string> parted(const std::string& path) {
    const std::size_t dot = path.rfind('.');
    if (dot == std::string::npos) return {"", path};
    return {path.substr(0, dot), path.substr(dot + 1)};
}

std::string text_of(const std::string& head, const NewKeys& keys) {
    std::string text = head, last;
    for (const NewKey& key : keys) {
        const auto [table, name] = parted(key.path);
        if (table != last) {
            const bool medium = table == "medium.N";
            const std::string header =
                table.compare(0, 9, "medium.N.") == 0 ? "medium." + table.substr(9) : table;
            text += medium ? "\n[[medium]]\n" : "\n[" + header + "]\n";
            last = table;
        }
        text += "# " + comment_of(row_of(key.path)) + '\n' + name + " = " + key.value + '\n';
    }
    return text;
}

void add_lines(const std::string& all, NewKeys& keys) {
    for (std::size_t at = 0; at < all.size();) {
        const std::size_t middle = all.find(" = ", at), end = all.find('\n', at);
        keys.push_back({all.substr(at, middle - at), all.substr(middle + 3, end - middle - 3)});
        at = end + 1;
    }
}

void add_camera(const NewView& view, NewKeys& keys) {
    keys.push_back({"camera.position_m", view.position});
    keys.push_back({"camera.target_m", view.target});
    keys.push_back({"camera.fov_deg", view.fov});
    keys.push_back({"camera.resolution", "[960, 540]"});
}

void add_output(const std::string& picture, NewKeys& keys) {
    keys.push_back({"output.files", '[' + toml_text(node_of(picture + ".png")) + ", " +
                                        toml_text(node_of(picture + ".exr")) + ']'});
}

void add_method(const char* name, NewKeys& keys) {
    for (const NewKey& key : keys)
        if (key.path == "method.name") return;
    keys.push_back({"method.name", '"' + std::string(name) + '"'});
}

std::string head_of(const std::string& title) {
    return "# " + title + ".\n# Render it: pileus render THIS_FILE. All keys: docs/scene.md.\n\n";
}

std::string scene_of(const NewType& type, const std::string& picture) {
    NewKeys keys{{"seed", "7"}};
    add_camera(type.view, keys);
    const bool in_air =
        std::string_view(type.name) != "smoke" && std::string_view(type.name) != "box";
    if (in_air) keys.push_back({"atmosphere.turbidity", "2.2"});
    if (!in_air) keys.push_back({"sky.radiance", "[0.03, 0.06, 0.13]"});
    keys.push_back({"sun.azimuth_deg", std::to_string(type.view.azimuth)});
    keys.push_back({"sun.elevation_deg", std::to_string(type.view.elevation)});
    keys.push_back({"sun.irradiance", in_air ? "1.6" : "2"});
    keys.push_back({"ground.albedo", "0.15"});
    const std::string own = type.keys == nullptr ? "" : type.keys;
    if (own.find("medium.N.density") == std::string::npos) {
        keys.push_back({"medium.N.density", "\"procedural:cloud\""});
        const CloudForm form = cloud_type(type.name).form;
        if (form != CloudForm::kHeap && form != CloudForm::kField && form != CloudForm::kLens)
            keys.push_back({"medium.N.boundary", "\"periodic\""});
        keys.push_back({"medium.N.cloud.type", '"' + std::string(type.name) + '"'});
        keys.push_back({"medium.N.cloud.seed", "4"});
    }
    add_lines(own, keys);
    add_method("raymarch", keys);
    add_output(picture, keys);
    return text_of(head_of(std::string(type.name) + ": " + type.what), keys);
}

/// Around a grid that knows its box, or one a kilometre long: from the south, a little above, and
/// from higher up where it is flat.
Status scene_of_file(const std::string& file, const std::string& folder, const std::string& picture,
                     std::string& text) {
    const VolumeFormat* format = volume_format_of(file);
    Volume volume;
    PILEUS_TRY(read_volume(MediumSettings(), file, volume));
    std::array<Double3, 2> box = volume.bounds_m;
    const double longest = std::max({volume.size[0], volume.size[1], volume.size[2]});
    if (!volume.knows_bounds)
        for (std::size_t a = 0; a < 3; ++a) {
            box[0][a] = a < 2 ? -500.0 * volume.size[a] / longest : 0;
            box[1][a] = box[0][a] + 1000.0 * volume.size[a] / longest;
        }
    Double3 middle{}, edge{};
    for (std::size_t a = 0; a < 3; ++a) {
        middle[a] = (box[0][a] + box[1][a]) / 2;
        edge[a] = box[1][a] - box[0][a];
    }
    const double across = std::max({edge[0], edge[1], edge[2]});
    const bool flat = edge[2] < 0.4 * across;
    const auto place = [](double x, double y, double z) {
        return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", x, y, z);
    };
    NewKeys keys{{"seed", "7"}};
    const std::string from = place(middle[0], middle[1] - (flat ? 1.5 : 2.2) * across,
                                   middle[2] + (flat ? 1.0 : 0.2) * across);
    const std::string to = place(middle[0], middle[1], middle[2]);
    add_camera({from.c_str(), to.c_str(), "32", 0, 0}, keys);
    keys.push_back({"sun.azimuth_deg", "130"});
    keys.push_back({"sun.elevation_deg", "40"});
    keys.push_back({"sun.irradiance", "1.6"});
    keys.push_back({"sky.radiance", "[0.03, 0.06, 0.13]"});
    std::error_code ignored;
    const auto way =
        std::filesystem::proximate(std::filesystem::absolute(path_of(file), ignored),
                                   std::filesystem::absolute(path_of(folder), ignored), ignored);
    keys.push_back({"medium.N.density", toml_text(node_of(path_text(way)))});
    if (format != nullptr && !format->is_weather && !format->is_particles)
        keys.push_back({"medium.N.y_up", "false"});
    if (!volume.knows_bounds)
        keys.push_back({"medium.N.bounds_m", '[' + place(box[0][0], box[0][1], box[0][2]) + ", " +
                                                 place(box[1][0], box[1][1], box[1][2]) + ']'});
    // Thirty mean free paths along its shortest edge where the density is 1.
    if (format == nullptr || (!format->in_extinction && !format->is_particles))
        keys.push_back({"medium.N.extinction_per_m",
                        fmt::format("{:.3g}", 30 / std::min({edge[0], edge[1], edge[2]}))});
    keys.push_back({"medium.N.albedo", "1"});
    keys.push_back({"medium.N.phase.type", "\"henyey-greenstein\""});
    keys.push_back({"medium.N.phase.g", "0.85"});
    add_method("raymarch", keys);
    add_output(picture, keys);
    text = text_of(head_of("The density of " + printable_line(file)), keys);
    return Status::ok();
}

}  // namespace

std::string new_scene_lines() {
    std::string lines;
    for (const NewType& type : kTypes) lines += fmt::format("{:20} {}\n", type.name, type.what);
    return lines +
           fmt::format("{:20} a density of yours: {}\n", "FILE", volume_format_extensions());
}

bool is_new_scene_file(const std::string& type) { return volume_format_of(type) != nullptr; }

Status new_scene(const std::string& type, const std::string& folder, const std::string& picture,
                 std::string& text) {
    std::string names;
    for (const NewType& row : kTypes) {
        if (type == row.name) {
            text = scene_of(row, picture);
            return Status::ok();
        }
        names += row.name + std::string(", ");
    }
    if (is_new_scene_file(type)) return scene_of_file(type, folder, picture, text);
    return Status::bad_input("pileus new: no such type, " + quote_text(type) +
                             ", allowed: " + names + "or a file: " + volume_format_extensions());
}

}  // namespace pileus
