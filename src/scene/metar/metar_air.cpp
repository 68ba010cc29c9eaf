// SPDX-License-Identifier: Apache-2.0
// What dims the view at the ground: precipitation, fog, haze, and the turbidity of the air.
// in: a draft with its clouds -> out: layers on the ground, turbidity, notes. docs/metar.md
#include <algorithm>

#include "src/base/number_text.h"
#include "src/scene/metar/metar_parts.h"

namespace pileus {
namespace {

std::string metres(double m) { return number_text(m, 5) + " m"; }

/// What falls most densely of all groups.
struct Fall {
    const MetarFall* kind = nullptr;
    double extinction_per_m = 0;
    bool showers = false;
    int intensity = 1;
};

Fall find_fall(MetarDraft& draft) {
    Fall found;
    for (const MetarWeather& weather : draft.report.weather) {
        if (weather.intensity == MetarIntensity::kVicinity || weather.descriptor == "BL" ||
            weather.descriptor == "DR")
            continue;
        const int intensity = weather.intensity == MetarIntensity::kLight   ? 0
                              : weather.intensity == MetarIntensity::kHeavy ? 2
                                                                            : 1;
        for (const std::string& what : weather.phenomena)
            for (const MetarFall& row : kMetarFalls) {
                if (what != row.code) continue;
                const MetarFall* kind = &row;
                const bool frozen =
                    draft.report.temperature_given && draft.report.temperature_c < 0;
                if (what == "UP") {
                    if (frozen) kind = &kMetarFalls[0];
                    draft.note(std::string("UP: precipitation of a kind not reported, ") +
                               kind->name + " assumed");
                }
                const double extinction = kind->per_km[intensity] / 1000;
                if (extinction <= found.extinction_per_m) continue;
                found = {kind, extinction, weather.descriptor == "SH" || weather.descriptor == "TS",
                         intensity};
            }
    }
    return found;
}

/// What stands in the air at the aerodrome; null: nothing that is reported. Patches and shallow fog
/// are layers besides, which leave the visibility as it is.
const MetarDimming* find_dimming(MetarDraft& draft, std::vector<std::string>& patches) {
    const MetarDimming* found = nullptr;
    for (const MetarWeather& weather : draft.report.weather)
        for (const std::string& what : weather.phenomena) {
            const bool blowing = weather.descriptor == "BL";
            const MetarDimming* row = nullptr;
            for (const MetarDimming& known : kMetarDimmings)
                if (what == known.code && (what != "SN" || blowing)) row = &known;
            const bool near = weather.intensity == MetarIntensity::kVicinity;
            if (near) {
                draft.note(what + " in the vicinity: left out");
            } else if (weather.descriptor == "DR") {
                draft.note("DR" + what + ": below 2 m, left out");
            } else if (what == "FG" && (weather.descriptor == "BC" || weather.descriptor == "PR" ||
                                        weather.descriptor == "MI")) {
                patches.push_back(weather.descriptor);
            } else if (row != nullptr && (found == nullptr || row == &kMetarDimmings[0])) {
                found = row;  // fog before all others: its droplets dim most
            } else if (what == "FC" || what == "SQ" || what == "PO" || what == "PY") {
                draft.note(what + ": left out");
            }
        }
    for (const MetarWeather& weather : draft.report.weather)
        if (weather.intensity == MetarIntensity::kVicinity && weather.phenomena.empty())
            draft.note("VC" + weather.descriptor + ": in the vicinity, left out");
    return found;
}

void add_patches(MetarDraft& draft, const std::string& descriptor) {
    const bool shallow = descriptor == "MI", partial = descriptor == "PR";
    MetarMedium fog;
    fog.name = "fog";
    fog.type = "fog";
    fog.base_m = draft.settings.field_elevation_m;
    fog.top_m = fog.base_m + (shallow ? 2 : 30);
    // Shallow fog is below 2 m (Annex 3); 30 m, and shares of the ground: chosen.
    fog.coverage = shallow ? 0.9 : partial ? 0.6 : 0.3;
    fog.extinction_per_m = kMetarKoschmieder / kMetarPatchFog_m;
    draft.add(fog);
    draft.note(descriptor + "FG: " + metres(fog.top_m - fog.base_m) +
               " thick, 600 m of visibility within, assumed");
}

/// Precipitation from the ground to the clouds that it falls from; `extinction_per_m` is the mean
/// where it falls.
void add_fall(MetarDraft& draft, const Fall& fall, double extinction_per_m, double top_m) {
    MetarMedium medium;
    medium.name = fall.kind->name;
    medium.type = "custom";
    medium.base_m = draft.settings.field_elevation_m;
    medium.top_m = medium.base_m + top_m;
    medium.phase = "{ type = \"henyey-greenstein\", g = " + number_text(fall.kind->g, 4) + " }";
    // Lumps are a quarter of a tile: 3 km. Noise of mean 1/2 between thresholds on both sides of it
    // has densities of mean 1/2, so that twice the extinction gives it.
    const std::string noise = "perlin_m = 12000, worley_m = 12000, blend = 1, octaves = 2, ";
    if (fall.showers) {
        medium.extinction_per_m = extinction_per_m;
        medium.coverage = kMetarShaftCoverage[fall.intensity];
        medium.shape = noise + "threshold_low = 0.45, threshold_high = 0.65";
    } else {
        medium.extinction_per_m = 2 * extinction_per_m;
        medium.shape = noise + "threshold_low = 0, threshold_high = 1";
    }
    draft.add(medium);
    draft.note(std::string(fall.kind->name) + ": up to " + metres(top_m) + ", " +
               number_text(extinction_per_m * 1000, 3) + " /km" +
               (fall.showers ? " in shafts" : "") + ", assumed");
}

/// A layer that dims by `extinction_per_m` at the ground. Where the sky is obscured it thickens
/// upwards until what lies above the vertical visibility is hidden.
void add_dimming(MetarDraft& draft, const MetarDimming& row, double extinction_per_m) {
    const Metar& report = draft.report;
    double thickness_m = row.thickness_m, most = extinction_per_m;
    // Fog and mist end where the ceiling begins.
    if (draft.lowest_ceiling_m > 0 && thickness_m > draft.lowest_ceiling_m)
        thickness_m = std::max(kMetarLeastBase_m, draft.lowest_ceiling_m);
    if (report.obscured) {
        const double seen_m = std::max(
            kMetarLeastBase_m, report.vertical_visibility_given ? report.vertical_visibility_m : 0);
        thickness_m = std::max(row.thickness_m, 2 * seen_m);
        // Extinction grows evenly from g at the ground to E at the height H of the top: a depth of
        // 3.912 up to V asks for g V + (E - g) V^2/2H = 3.912.
        const double missing = kMetarKoschmieder - extinction_per_m * seen_m;
        if (missing > 0) most += missing * 2 * thickness_m / (seen_m * seen_m);
        most = std::max(extinction_per_m, std::min(most, kMetarThickest_per_m));
    }
    MetarMedium medium;
    medium.name = row.name;
    medium.type = "fog";
    medium.base_m = draft.settings.field_elevation_m;
    medium.top_m = medium.base_m + thickness_m;
    // Mean density 1/2, as precipitation has it.
    medium.extinction_per_m = 2 * most;
    medium.albedo = row.albedo;
    medium.phase = row.phase;
    medium.shape =
        "base_rise = 0, top_fall = 0.5, threshold_low = -0.1, threshold_high = 1.1, "
        "base_density = " +
        number_text(most > 0 ? extinction_per_m / most : 1, 6);
    if (!(most > 0)) return;
    draft.add(medium);
    draft.note(std::string(row.name) + ": " + metres(thickness_m) + " thick, assumed");
}

/// Extinction at the ground of a turbidity's haze.
double haze_of(double turbidity) { return (turbidity - 1) * kMetarHaze_per_m; }

double bounded_turbidity(double haze_per_m) {
    return std::clamp(1 + haze_per_m / kMetarHaze_per_m, kMetarLeastTurbidity, kMetarMostTurbidity);
}

}  // namespace

void add_metar_air(MetarDraft& draft) {
    const Metar& report = draft.report;
    const MetarVisibility& seen = report.visibility;
    MetarSky& sky = draft.sky;
    std::vector<std::string> patches;
    const Fall fall = find_fall(draft);
    const MetarDimming* row = find_dimming(draft, patches);
    const double top_of_sight_m = report.vertical_visibility_given
                                      ? std::max(report.vertical_visibility_m, kMetarLeastBase_m)
                                      : kMetarUnknownSight_m;
    // An obscured sky without a word for it: what falls hides the sky, or fog is meant.
    const bool hidden_by_fall = report.obscured && row == nullptr && fall.kind != nullptr;
    const bool hidden = report.obscured && !hidden_by_fall;
    if (hidden && row == nullptr) row = &kMetarDimmings[0];
    const bool dense = hidden || row == &kMetarDimmings[0];

    double visibility_m = seen.given && seen.bound != MetarBound::kMore ? seen.m : 0;
    if (!(visibility_m > 0) && dense) {
        visibility_m = report.vertical_visibility_given ? top_of_sight_m : kMetarUnknownFog_m;
        draft.note(std::string("visibility in ") + row->name + ": not reported, " +
                   metres(visibility_m) + " assumed");
    } else if (!seen.given) {
        draft.note("visibility: not reported, clear air assumed");
    }

    sky.turbidity = kMetarClearTurbidity;
    double fall_per_m = fall.extinction_per_m;
    // What falls all around dims no more than is reported.
    if (seen.given && fall.kind != nullptr && !fall.showers) {
        const double all_per_m = kMetarKoschmieder / seen.m;
        const double max_per_m = all_per_m - haze_of(kMetarClearTurbidity);
        fall_per_m = std::min(fall_per_m, std::max(max_per_m, 0.1 * all_per_m));
    }
    if (visibility_m > 0) {
        const double all_per_m = kMetarKoschmieder / visibility_m;
        const double share = fall.showers ? kMetarShaftCoverage[fall.intensity] : 1;
        const double rest_per_m = std::max(0.0, all_per_m - share * fall_per_m);
        const bool beyond_air = 1 + rest_per_m / kMetarHaze_per_m > kMetarMostTurbidity;
        sky.turbidity = bounded_turbidity(rest_per_m);
        if (fall.kind != nullptr) sky.turbidity = std::max(sky.turbidity, kMetarClearTurbidity);
        if (beyond_air && row == nullptr && fall.kind != nullptr) {
            // No other cause is reported: it falls more densely than its intensity says.
            sky.turbidity = kMetarClearTurbidity;
            fall_per_m = std::max(fall_per_m, all_per_m - haze_of(sky.turbidity));
        } else if (beyond_air || dense) {
            if (row == nullptr) {
                row = &kMetarDimmings[1];
                draft.note("visibility of " + metres(visibility_m) +
                           " without a word for its cause: mist assumed");
            }
            sky.turbidity = std::min(sky.turbidity, row->turbidity);
            add_dimming(draft, *row, std::max(0.0, rest_per_m - haze_of(sky.turbidity)));
        }
    }
    for (std::size_t i = 0; i < patches.size(); ++i)
        if (std::find(patches.begin(), patches.begin() + std::ptrdiff_t(i), patches[i]) ==
            patches.begin() + std::ptrdiff_t(i))
            add_patches(draft, patches[i]);

    if (hidden_by_fall && draft.lowest_ceiling_m < 0) {
        MetarMedium cloud;
        cloud.name = kMetarNimbostratus.name;
        cloud.type = kMetarNimbostratus.type;
        cloud.base_m = draft.settings.field_elevation_m + top_of_sight_m;
        cloud.top_m = cloud.base_m + kMetarNimbostratus.thickness_m;
        cloud.coverage = metar_coverage(MetarCover::kOvercast);
        cloud.extinction_per_m = kMetarNimbostratus.extinction_per_m;
        draft.add(cloud);
        draft.lowest_ceiling_m = top_of_sight_m;
        draft.note("sky hidden by precipitation: nimbostratus at " + metres(top_of_sight_m) +
                   " assumed");
    }
    if (fall.kind != nullptr) {
        // Veils of ice send nothing down to the ground.
        const auto rains = [](double m) { return m > 0 && m <= kMetarHigh_m; };
        const double top_m = rains(draft.lowest_ceiling_m) ? draft.lowest_ceiling_m
                             : rains(draft.lowest_m)       ? draft.lowest_m
                                                           : kMetarFallTop_m;
        add_fall(draft, fall, fall_per_m, top_m);
    }
}

}  // namespace pileus
