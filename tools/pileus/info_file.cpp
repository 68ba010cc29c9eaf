// SPDX-License-Identifier: Apache-2.0
// What scenes, pictures and density grids hold, in a few lines each.
// in: a path -> out: see info.h.
// docs/program.md
#include <fmt/format.h>

#include "src/io/images/image_file.h"
#include "src/methods/registry.h"
#include "src/scene/read_scene.h"
#include "src/scene/rows/density_row.h"
#include "src/scene/rows/volume_format.h"
#include "src/scene/toml/toml_tree.h"
#include "src/world/phase/phase_table.h"
#include "tools/pileus/info.h"

namespace pileus {

namespace {

/// Over the finite values; the others are counted apart.
struct Range {
    double least = 0, most = 0, sum = 0;
    std::uint64_t finite = 0, zero = 0, other = 0;
};

Range range_of(Span<const float> values) {
    Range range;
    for (const float v : values) {
        if (!(v - v == 0.0f)) {
            ++range.other;
            continue;
        }
        if (range.finite == 0 || v < range.least) range.least = v;
        if (range.finite == 0 || v > range.most) range.most = v;
        range.sum += v;
        range.zero += v == 0.0f ? 1 : 0;
        ++range.finite;
    }
    return range;
}

std::string range_text(const Range& range) {
    if (range.finite == 0) return fmt::format("no finite value, {} not finite", range.other);
    std::string text = fmt::format("{:.6g} to {:.6g}, mean {:.6g}", range.least, range.most,
                                   range.sum / double(range.finite));
    if (range.other > 0) text += fmt::format(", {} not finite", range.other);
    return text;
}

std::string density_name(const MediumSettings& medium) {
    const DensityRow* row = density_row(medium.density);
    if (row == nullptr) return medium.source.file;
    return row->name + (row->detail == nullptr ? "" : row->detail(medium));
}

std::string extinction_text(const MediumSettings& medium) {
    const VolumeFormat* format = volume_format_named(medium.source.format);
    if (format != nullptr && format->in_extinction)
        return fmt::format("{:g} times the file's", medium.optics.extinction_scale);
    return fmt::format("{:g} per m", medium.optics.extinction_per_m);
}

std::string list_text(const std::vector<std::string>& texts) {
    std::string list;
    for (const std::string& text : texts) list += (list.empty() ? "" : ", ") + text;
    return list.empty() ? "none" : list;
}

/// Along z, through each column of cells.
std::string depth_text(const Volume& volume) {
    const std::size_t plane = std::size_t(volume.size[0]) * std::size_t(volume.size[1]);
    const double step = (volume.bounds_m[1][2] - volume.bounds_m[0][2]) / volume.size[2];
    double most = 0, sum = 0;
    for (std::size_t column = 0; column < plane; ++column) {
        double depth = 0;
        for (std::size_t i = column; i < volume.density.size(); i += plane)
            depth += step * double(volume.density[i]);
        if (depth > most) most = depth;
        sum += depth;
    }
    return fmt::format("along z: mean {:.6g}, largest {:.6g}", sum / double(plane), most);
}

/// Kinds, and how many clouds there are in all.
std::string cloud_lines(const CloudsSettings& clouds) {
    std::size_t count = clouds.places.size();
    for (const CloudScatter& scatter : clouds.scatters) count += std::size_t(scatter.count);
    std::string lines;
    for (const CloudKindSettings& kind : clouds.kinds)
        lines += info_line("kind of clouds", fmt::format("{}, {}", printable_line(kind.name),
                                                         printable_line(kind.scene)));
    for (const CloudLayerSettings& layer : clouds.layers)
        lines += info_line("layer", printable_line(layer.scene));
    if (clouds.weather.present())
        lines += info_line("weather", printable_line(clouds.weather.metar));
    return lines + info_line("clouds", fmt::to_string(count));
}

}  // namespace

Status scene_lines(const std::string& path, std::string& lines) {
    Scene scene;
    PILEUS_TRY(read_scene_file(path, {}, scene));
    const Camera& camera = scene.camera;
    lines += info_line("scene", path);
    if (!scene.clouds.present()) lines += info_line("method", scene.method);
    lines += info_line("seed", fmt::to_string(scene.seed));
    lines +=
        info_line("picture", fmt::format("{} x {}, {}", camera.resolution[0], camera.resolution[1],
                                         camera.flux           ? "flux"
                                         : camera.orthographic ? "orthographic"
                                                               : "perspective"));
    std::vector<std::string> lights;
    if (scene.sun.present) lights.push_back("sun");
    if (scene.sky.present) lights.push_back("sky");
    if (scene.atmosphere.present) lights.push_back("atmosphere");
    lines += info_line("lights", list_text(lights));
    if (scene.ground.present)
        lines += info_line("ground", fmt::format("albedo {:g}", scene.ground.albedo));
    for (const MediumSettings& medium : scene.media)
        lines += info_line(
            "medium", fmt::format("{}, extinction {}, albedo {:g} {:g} {:g}", density_name(medium),
                                  extinction_text(medium), medium.optics.albedo[0],
                                  medium.optics.albedo[1], medium.optics.albedo[2]));
    if (scene.clouds.present())
        lines += cloud_lines(scene.clouds);
    else if (const auto photons = method_tools(scene.method).photons)
        lines += info_line("photons", fmt::to_string(photons(scene)));
    lines +=
        info_line("frames", fmt::to_string(scene.animation.present ? scene.animation.frames : 1));
    lines += info_line("files", list_text(scene.output.files));
    return Status::ok();
}

Status phase_lines(const std::string& path, std::string& lines) {
    PhaseNodes nodes;
    PhaseStore store;
    PILEUS_TRY(read_phase_table(path, nodes));
    PILEUS_TRY(make_phase_table(path, nodes, store));
    double moment[2];
    phase_table_moments(store.table[0], 2, moment);
    lines += info_line("phase table", path);
    lines += info_line("lines", fmt::to_string(nodes.value.size()));
    lines += info_line("mean cosine", fmt::format("{:.6f}", moment[1]));
    std::size_t peak = 0, least = 0;
    for (std::size_t i = 1; i < nodes.value.size(); ++i) {
        if (nodes.value[i] > nodes.value[peak]) peak = i;
        if (nodes.value[i] < nodes.value[least]) least = i;
    }
    const auto place = [&](std::size_t i) {
        return fmt::format("{:.6g} per sr at {:g} degrees", store.table[0].density[i],
                           nodes.angle_deg[i]);
    };
    lines += info_line("peak", place(peak));
    lines += info_line("least", place(least));
    std::string shares;
    for (const double angle : {1.0, 5.0, 10.0, 90.0})
        shares += fmt::format("{}{:.4g} % within {:g}", shares.empty() ? "" : ", ",
                              100 * phase_table_share(store.table[0], angle), angle);
    lines += info_line("light", shares + " degrees");
    return Status::ok();
}

Status image_lines(const std::string& path, std::string& lines) {
    Image image;
    PILEUS_TRY(read_image(path, image));
    lines += info_line("picture", path);
    lines += info_line("size", fmt::format("{} x {}", image.width, image.height));
    const DisplayWindow& shown = image.display;
    if (shown.width > 0 && (shown.x != 0 || shown.y != 0 || shown.width != image.width ||
                            shown.height != image.height))
        lines += info_line("display", fmt::format("{} x {}, from pixel {} {} on", shown.width,
                                                  shown.height, shown.x, shown.y));
    if (!image.foreign.empty()) lines += info_line("differs in", printable_line(image.foreign));
    lines += info_line("hash", pixel_hash(image));
    for (const Channel& channel : image.channels)
        lines += info_line("channel", fmt::format("{:<8} {}", channel.name,
                                                  range_text(range_of(channel.pixels.span()))));
    for (const auto& [name, text] : image.origin)
        lines += info_line(printable_line(name).c_str(), printable_line(text));
    return Status::ok();
}

Status scene_text_of(const std::string& path, std::string& text) {
    Image image;
    PILEUS_TRY(read_image(path, image));
    if (image.scene_text.empty())
        return Status::bad_input(
            path + ": pileus.scene: missing, allowed: a picture that pileus has rendered");
    // Whoever made the file, a terminal is given a scene or plain lines.
    Node ignored;
    SyntaxFault fault;
    text = parse_toml(image.scene_text, ignored, fault) ? image.scene_text
                                                        : printable_lines(image.scene_text);
    if (text.back() != '\n') text += '\n';
    return Status::ok();
}

std::string size_lines(const std::array<int, 3>& n, bool knows_bounds,
                       const std::array<Double3, 2>& b) {
    std::string lines = info_line("size", fmt::format("{} x {} x {}", n[0], n[1], n[2]));
    if (!knows_bounds) return lines + info_line("box", "not in the file");
    lines += info_line("cell", fmt::format("{:.6g} x {:.6g} x {:.6g} m", (b[1][0] - b[0][0]) / n[0],
                                           (b[1][1] - b[0][1]) / n[1], (b[1][2] - b[0][2]) / n[2]));
    return lines + info_line("box", fmt::format("{:g} {:g} {:g} to {:g} {:g} {:g} m", b[0][0],
                                                b[0][1], b[0][2], b[1][0], b[1][1], b[1][2]));
}

Status volume_lines(const std::string& path, const MediumSettings& medium, std::string& lines) {
    VolumeHead head;
    Volume volume;
    PILEUS_TRY(read_volume_head(medium, path, head));
    PILEUS_TRY(read_volume(medium, path, volume));
    const Range range = range_of(volume.density.span());
    lines += info_line("grid", path);
    lines += info_line("kind", head.kind + (head.detail.empty() ? "" : "; " + head.detail));
    lines += size_lines(volume.size, volume.knows_bounds, volume.bounds_m);
    lines += info_line("values",
                       volume.in_extinction ? "extinction in 1/m" : "relative density, no unit");
    lines +=
        info_line(volume.in_extinction ? "extinction" : "density",
                  fmt::format("{}, {:.4g} % not zero", range_text(range),
                              100.0 * double(range.finite - range.zero) / double(range.finite)));
    lines += info_line("empty", fmt::format("{} of {} cells", range.zero, volume.density.size()));
    if (volume.clamped > 0)
        lines +=
            info_line("negative", fmt::format("{} a little below 0, counted as 0", volume.clamped));
    if (volume.in_extinction && volume.knows_bounds)
        lines += info_line("optical depth", depth_text(volume));
    return Status::ok();
}

}  // namespace pileus
