// SPDX-License-Identifier: Apache-2.0
// See solids.h: one solid from its file, and the colours that a map gives its triangles.
// in: settings, files -> out: a mesh in the file's axes or, of heights, in metres; albedos.
// docs/solids.md, "Height maps", "Maps of albedo".
#include <algorithm>

#include "src/base/number_text.h"
#include "src/io/heights/height_map.h"
#include "src/io/images/image_file.h"
#include "src/scene/read_scene.h"
#include "src/scene/rows/height_format.h"
#include "src/world/solids/solids.h"

namespace pileus {
namespace {

/// What a mesh covers seen from above, as its file has it.
struct Extent {
    double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
};

/// Place of a corner on the map.
struct DrapedPlace {
    double at[2];
};
DrapedPlace draped_place(const SolidSettings& settings, const double* corner) {
    if (settings.y_up) return {{corner[0], -corner[2]}};
    return {{corner[0], corner[1]}};
}

Extent extent_of(const SolidSettings& settings, const Mesh& mesh) {
    Extent e;
    for (std::size_t i = 0; i < mesh.corners.size(); i += 3) {
        const DrapedPlace p = draped_place(settings, &mesh.corners[i]);
        for (int a = 0; a < 2; ++a) {
            e.low[a] = std::min(e.low[a], p.at[a]);
            e.high[a] = std::max(e.high[a], p.at[a]);
        }
    }
    return e;
}

/// Two pixels along a side and how far between their middles a place lies.
struct Between {
    std::size_t first, second;
    double share;
};
Between between(double share, int pixels) {
    const double at = std::min(std::max(share * pixels - 0.5, 0.0), double(pixels - 1));
    const auto first = std::size_t(at);
    return {first, std::min(first + 1, std::size_t(pixels - 1)), at - double(first)};
}

Status check_values(const SolidSettings& settings, const std::string& path, const Image& image,
                    const Channel* const (&rgb)[3]) {
    for (const Channel* channel : rgb)
        for (std::size_t i = 0; i < channel->pixels.size(); ++i) {
            const double v = double(channel->pixels[i]) * settings.albedo_map_scale;
            // Rounding of what was meant to be 1 is no fault.
            if (v >= 0 && v <= 1 + 1e-6) continue;
            return Status::bad_input(
                path + ": albedo: " + channel->name + " at row " +
                std::to_string(i / std::size_t(image.width)) + ", column " +
                std::to_string(i % std::size_t(image.width)) + ": out of range, " + number_text(v) +
                ", allowed: within [0, 1] once multiplied by albedo_map_scale");
        }
    return Status::ok();
}

}  // namespace

bool is_smooth(const SolidSettings& settings) {
    if (settings.smooth == SmoothUse::kAuto) return height_format_of(settings.file) != nullptr;
    return settings.smooth == SmoothUse::kYes;
}

SolidSettings placing_of(const SolidSettings& settings) {
    SolidSettings placing = settings;
    if (height_format_of(settings.file) == nullptr) return placing;
    placing.scale = 1;
    placing.y_up = false;
    return placing;
}

Status read_solid(const Scene& scene, const Context& context, std::size_t solid, Mesh& mesh) {
    const SolidSettings& settings = scene.solids[solid];
    const std::string key = "solid." + std::to_string(solid) + ".file";
    const std::string path = scene_path(scene.directory, settings.file);
    if (height_format_of(settings.file) != nullptr) {
        PILEUS_TRY(at_key(scene, key, read_height_map(path, settings, context.limits, mesh)));
        if (!is_smooth(settings)) mesh.normals = Buffer<float>();
        return Status::ok();
    }
    PILEUS_TRY(at_key(scene, key, read_mesh(path, context.limits, mesh)));
    if (!is_smooth(settings)) return Status::ok();
    return at_key(scene, key, smooth_mesh(mesh));
}

Status colour_triangles(const SolidSettings& settings, const std::string& path,
                        const Limits& limits, const Mesh& mesh, Span<float> rows) {
    Image image;
    const Channel* rgb[3];
    PILEUS_TRY(read_colours(path, limits, kMaxImagePixels, image, rgb));
    PILEUS_TRY(check_values(settings, path, image, rgb));
    const SolidSettings placing = placing_of(settings);
    const Extent e = extent_of(placing, mesh);
    const auto width = std::size_t(image.width);
    for (std::size_t t = 0; t < mesh.triangles(); ++t) {
        double share[2] = {0, 0};
        for (std::size_t i = 0; i < 3; ++i) {
            const DrapedPlace p = draped_place(placing, &mesh.corners[9 * t + 3 * i]);
            for (int a = 0; a < 2; ++a) {
                const double wide = e.high[a] - e.low[a];
                share[a] += wide > 0 ? (p.at[a] - e.low[a]) / wide / 3 : 0.5 / 3;
            }
        }
        const Between x = between(share[0], image.width), y = between(1 - share[1], image.height);
        for (std::size_t c = 0; c < 3; ++c) {
            const Buffer<float>& v = rgb[c]->pixels;
            const auto along = [&](std::size_t row) {
                return double(v[row * width + x.first]) * (1 - x.share) +
                       double(v[row * width + x.second]) * x.share;
            };
            const double value = along(y.first) * (1 - y.share) + along(y.second) * y.share;
            rows[3 * t + c] = float(std::min(value * settings.albedo_map_scale, 1.0));
        }
    }
    return Status::ok();
}

}  // namespace pileus
