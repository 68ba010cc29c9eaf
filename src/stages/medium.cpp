// SPDX-License-Identifier: Apache-2.0
// See medium.h.
#include "src/stages/medium.h"

#include "src/io/volume_file.h"
#include "src/scene/read_scene.h"
#include "src/volume/cumulus.h"
#include "src/volume/shapes.h"

namespace pileus {
namespace {

PhaseParams phase_params(const PhaseSettings& phase) {
    switch (phase.kind) {
        case PhaseKind::kRayleigh:
            return {kPhaseRayleigh, 0, 0, 1};
        case PhaseKind::kTwoLobe:
            return {kPhaseTwoLobe, float(phase.g1), float(phase.g2), float(phase.weight)};
        case PhaseKind::kHenyeyGreenstein:
            return {kPhaseHg, float(phase.g), 0, 1};
        case PhaseKind::kIsotropic:
            break;
    }
    return {kPhaseHg, 0, 0, 1};
}

Status load_density(const Scene& scene, const MediumSettings& settings, int threads,
                    Volume& volume) {
    if (settings.density == DensityKind::kFile) {
        const std::string path = scene_path(scene.directory, settings.file);
        PILEUS_TRY(read_volume(settings, path, volume));
        if (settings.y_up) PILEUS_TRY(permute_y_up(volume));
        return Status::ok();
    }
    if (settings.density != DensityKind::kCumulus)
        return make_shape(settings.density, settings.resolution, volume);
    CumulusSettings cumulus;
    if (settings.resolution[0] > 0) cumulus.resolution = settings.resolution;
    cumulus.seed = settings.shape_seed;
    for (std::size_t a = 0; a < 3; ++a)
        cumulus.extent_m[a] = settings.bounds_m[1][a] - settings.bounds_m[0][a];
    return make_cumulus(cumulus, threads, volume);
}

/// Divides extinctions by the largest, so that densities end at exactly 1 and sigma is the largest
/// extinction; dark volumes stay as they are.
void set_peak_to_one(double scale, Medium& medium) {
    medium.sigma = float(scale * double(medium.density_max));
    medium.volume.in_extinction = false;
    if (!(medium.density_max > 0)) return;
    for (float& value : medium.volume.density.span()) value /= medium.density_max;
    medium.density_max = 1;
}

}  // namespace

bool is_white(const Medium& medium) {
    for (int i = 0; i < medium.count; ++i)
        for (float albedo : medium.optics[std::size_t(i)].albedo)
            if (albedo != 1) return false;
    return true;
}

float phase_peak(const Medium& medium) {
    float largest = 0;
    for (int i = 0; i < medium.count; ++i) {
        const float peak = phase_peak(medium.optics[std::size_t(i)].phase);
        if (peak > largest) largest = peak;
    }
    return largest;
}

std::string medium_key(const Scene& scene, const MediumSettings& settings) {
    std::size_t index = 0;
    while (index < scene.media.size() && &scene.media[index] != &settings) ++index;
    return "medium." + std::to_string(index);
}

Status load_medium(const Scene& scene, const MediumSettings& settings, int threads, Medium& out) {
    PILEUS_TRY(load_density(scene, settings, threads, out.volume));
    if (!settings.has_bounds && !out.volume.knows_bounds)
        return Status::bad_input(scene.file + ": " + medium_key(scene, settings) +
                                 ".bounds_m: left out, and the file \"" + settings.file +
                                 "\" does not know its place");
    const auto& bounds = settings.has_bounds ? settings.bounds_m : out.volume.bounds_m;
    out.low_m = bounds[0];
    for (std::size_t a = 0; a < 3; ++a) {
        out.extent_m[a] = bounds[1][a] - bounds[0][a];
        out.grid.size[a] = out.volume.size[a];
        out.grid.cell_m[a] = float(out.extent_m[a] / out.volume.size[a]);
    }
    for (float density : out.volume.density.span())
        if (density > out.density_max) out.density_max = density;
    out.sigma = float(settings.extinction_per_m);
    if (out.volume.in_extinction) set_peak_to_one(settings.extinction_scale, out);
    Optics& optics = out.optics[0];
    optics.albedo_max = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        optics.albedo[c] = settings.albedo[c];
        if (optics.albedo[c] > optics.albedo_max) optics.albedo_max = optics.albedo[c];
    }
    const bool grey =
        settings.albedo[0] == settings.albedo[1] && settings.albedo[1] == settings.albedo[2];
    out.channels = grey ? 1 : 3;
    optics.phase = phase_params(settings.phase);
    return Status::ok();
}

}  // namespace pileus
