// SPDX-License-Identifier: Apache-2.0
// See warnings.h.
#include "src/session/warnings.h"

#include <algorithm>

#include "src/base/number_text.h"

namespace pileus {
namespace {

constexpr Accident kAccidents[] = {
    {"majorant_violations", "extinctions above their bound, so that light is too bright or dark"},
    {"saturated", "sums held at their largest value, so that light is missing"},
    {"terminated", "photons, paths or flights given up by a limit, so that light is missing"},
    {"nan", "numbers of the picture that were none, written as 0"},
    {"nan_samples", "samples that were no finite number and count as 0"},
    {"samples_given_up", "sample points of collectors that found no place in the medium"},
    {"bound_breaches", "pixels brighter than their light allows, scaled down to it"},
    {"fractions_capped",
     "cells of weather data with more water than their cloud fraction tells, at most 10 times as "
     "dense in cloud"},
    {"particles_uncoloured",
     "particles with colours or emission of their own, for which a grid has the medium's alone"},
    {"camera_deep",
     "picture from deep among nodes of more than an optical depth, where little light comes: it "
     "may "
     "be several times too bright (method path has no nodes)"},
    {"rays_cut", "rays given up before their end, so that the medium's far side is missing"},
};

/// Whether light of a medium leaves it after hundreds of scatterings.
bool keeps_own_light(const Scene& scene) {
    for (const MediumSettings& medium : scene.media) {
        const MediumOptics& optics = medium.optics;
        for (std::size_t ch = 0; ch < 3; ++ch)
            if (optics.emission[ch] > 0 && optics.albedo[ch] > 0.9f) return true;
    }
    return false;
}

/// Weather data of nodes 14 optical depths thick are 10 % too dark, slabs of nodes of 1.5 6 %;
/// light of a medium itself that it keeps is 2 % too dark on nodes of 1.3, 18 % on 2.5, 74 %
/// on 3.1.
void warn_of_nodes(const Scene& scene, Report& report) {
    const bool own = keeps_own_light(scene);
    const double most = own ? 1.3 : 4;
    const OrdinateFigures& o = report.ordinates;
    if (o.nodes == 0 || !(o.node_depth > most)) return;
    report.warnings.push_back("light.ordinates: scattered light is solved for on nodes of up to " +
                              number_text(o.node_depth, 3) +
                              " optical depths: it may be darker by a " + (own ? "half" : "tenth") +
                              " and more "
                              "(docs/ordinates.md, \"Bounds\"; method "
                              "path has no nodes)");
}

}  // namespace

bool shows_nothing(const Image& image) {
    const Channel* alpha = image.find("A");
    if (alpha == nullptr) return false;
    for (const float a : alpha->pixels.span())
        if (a != 0.0f) return false;
    return true;
}

Span<const Accident> accidents() { return {kAccidents, sizeof kAccidents / sizeof kAccidents[0]}; }

std::string accident_line(const Accident& accident, std::uint64_t times) {
    return std::string("counters.") + accident.counter + ": " + std::to_string(times) + " " +
           accident.meaning;
}

void find_warnings(const Scene& scene, const Image& image, Report& report, bool seen) {
    report.warnings.clear();
    for (const auto& counter : report.counters)
        for (const Accident& accident : accidents())
            if (counter.second > 0 && counter.first == accident.counter)
                report.warnings.push_back(accident_line(accident, counter.second));
    if (scene.output.layer_error && !report.errors.of.empty() && image.find("error.R") == nullptr)
        report.warnings.push_back(scene.file +
                                  ": output.layers: the picture has no layer "
                                  "\"error\", " +
                                  report.errors.of +
                                  " (more than one of path.samples_per_pixel or of generations)");
    warn_of_nodes(scene, report);
    if (!scene.media.empty() && !seen && shows_nothing(image))
        report.warnings.push_back(
            scene.file +
            ": no ray meets the medium, or it is too thin to be seen: does the camera look at its "
            "bounds_m, and are all lengths in metres?");
}

/// Numbers of a cell tell of no narrower angles than some degrees: docs/accuracy.md, "What the long
/// form finds". Ellipsoids of 10 optical depths and g = 0.97 are within 3 %, of 20 up to 10 % too
/// bright, those that absorb and are seen where little light gets to twice.
void warn_of_narrow(const Medium& medium, Report& report) {
    constexpr double kNarrow = 0.93, kDeep = 10, kNarrowest = 0.95, kThin = 0.3;
    double edge = medium.extent_m[2];
    for (int a = 0; a < 2 && !medium.grid.periodic; ++a) edge = std::min(edge, medium.extent_m[a]);
    const double depth = max_extinction(medium) * edge;
    float narrowest = 0;
    for (int i = 0; i < medium.count; ++i)
        narrowest = std::max(narrowest, phase_moment(medium.optics[std::size_t(i)].phase, 1));
    if (!(double(narrowest) > kNarrow && depth > kDeep) &&
        !(double(narrowest) > kNarrowest && depth > kThin))
        return;
    report.warnings.push_back(
        "media: a phase function of mean cosine " + number_text(double(narrowest), 3) +
        " in up to " + number_text(depth, 3) +
        " optical depths: light that is scattered often is kept in wider angles than it goes by: a "
        "tenth too bright and, where media absorb or little light gets to, several times; along "
        "thin decks a third too dark (method path or raymarch)");
}

/// Most that diffuse light decays by in an optical depth, in diffusion: sqrt(3 (1 - a) (1 - a g)).
double max_decay(const Medium& medium) {
    double most = 0;
    for (int i = 0; i < medium.count; ++i) {
        const Optics& optics = medium.optics[std::size_t(i)];
        const double g = double(phase_moment(optics.phase, 1));
        for (const float albedo : optics.albedo)
            if (albedo > 0)
                most = std::max(most, 3 * (1 - double(albedo)) * (1 - double(albedo) * g));
    }
    return __builtin_sqrt(most);
}

void warn_of_cells(const Medium& medium, double cell_m, Report& report) {
    // A deck of one layer of 27 seen from above is 49 % too dark, of layers of 3.4 4 %. The default
    // cumulus, within 2.5 %, has leaves of up to 4.5, smaller ones at its rims.
    constexpr double kMaxDepth = 8;
    // Where media absorb, light changes within the depth that it diffuses to.
    constexpr double kMaxDiffusion = 2.5;
    const double depth = max_extinction(medium) * cell_m;
    if (!(depth > kMaxDepth || depth * max_decay(medium) > kMaxDiffusion)) return;
    report.warnings.push_back(
        "media: scattered light has one value in cells of up to " + number_text(depth, 3) +
        " optical depths: thick rims may be darker by a third and more (finer cells by "
        "medium.N.resolution or more photons; method path has none)");
}

void warn_of_light(const World& world, const FinishedParts& parts, Report& report) {
    if (parts.wide || world.shows_particles) warn_of_narrow(world.medium, report);
    warn_of_cells(world.medium, parts.cell_m, report);
}

}  // namespace pileus
