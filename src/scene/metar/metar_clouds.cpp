// SPDX-License-Identifier: Apache-2.0
// Clouds of a METAR: which kind of sheet each group becomes, how thick, and towers.
// in: a draft -> out: layers, kinds, scatter rows, notes. docs/metar.md
#include <algorithm>

#include "src/base/number_text.h"
#include "src/scene/metar/metar_parts.h"

namespace pileus {
namespace {

const char* word_of(MetarCover cover) {
    switch (cover) {
        case MetarCover::kFew:
            return "FEW";
        case MetarCover::kScattered:
            return "SCT";
        case MetarCover::kBroken:
            return "BKN";
        case MetarCover::kOvercast:
            return "OVC";
        default:
            return "///";
    }
}

bool is_ceiling(const MetarCloud& cloud) {
    return cloud.cover == MetarCover::kBroken || cloud.cover == MetarCover::kOvercast;
}

const MetarSheet& sheet_of(const MetarCloud& cloud, double height_m, bool rains_on) {
    const bool overcast = cloud.cover == MetarCover::kOvercast;
    const bool few = cloud.cover == MetarCover::kFew;
    if (cloud.tower == MetarTower::kCumulonimbus) return kMetarThunder;
    if (cloud.tower == MetarTower::kCongestus) return kMetarTowering;
    if (overcast && rains_on && height_m < kMetarNimbostratus_m) return kMetarNimbostratus;
    if (height_m > kMetarHigh_m) return is_ceiling(cloud) ? kMetarCirrostratus : kMetarCirrus;
    if (height_m >= kMetarMiddle_m) {
        if (overcast) return kMetarAltostratus;
        return is_ceiling(cloud) ? kMetarAltocumulusBroken : kMetarAltocumulus;
    }
    if (is_ceiling(cloud)) return height_m < kMetarStratus_m ? kMetarStratus : kMetarStratocumulus;
    if (height_m < kMetarStratus_m) return kMetarRags;
    return few ? kMetarHumilis : kMetarMediocris;
}

std::string metres(double m) { return number_text(m, 5) + " m"; }

/// Words for a clear sky, and what they leave open.
void note_clear(MetarDraft& draft) {
    switch (draft.report.clear) {
        case MetarClear::kCavok:
            draft.note(
                "CAVOK: no cloud below 1500 m and no CB; clouds above are not reported, none "
                "assumed");
            break;
        case MetarClear::kNsc:
            draft.note(
                "NSC: no cloud below 1500 m and no CB; clouds above are not reported, none "
                "assumed");
            break;
        case MetarClear::kClr:
            draft.note(
                "CLR: an automatic station sees up to 3700 m; clouds above are not reported, "
                "none assumed");
            break;
        case MetarClear::kNcd:
            draft.note("NCD: an automatic station found no clouds, none assumed");
            break;
        default:
            break;
    }
}

struct Placed {
    MetarCloud cloud;
    double height_m = 0;
};

void add_sheet(MetarDraft& draft, const Placed& placed, double next_m, bool rains_on) {
    const MetarSheet& sheet = sheet_of(placed.cloud, placed.height_m, rains_on);
    double thickness_m = sheet.thickness_m;
    // Sheets that lie in one another cannot be shown in order. Towers go through all.
    const bool cut = placed.cloud.tower == MetarTower::kNone && next_m > placed.height_m &&
                     placed.height_m + thickness_m > next_m - kMetarGap_m;
    if (cut) thickness_m = std::max(kMetarLeastThickness_m, next_m - kMetarGap_m - placed.height_m);
    MetarMedium medium;
    medium.name = sheet.name;
    medium.type = sheet.type;
    medium.base_m = draft.settings.field_elevation_m + placed.height_m;
    medium.top_m = medium.base_m + thickness_m;
    medium.coverage = metar_coverage(placed.cloud.cover);
    medium.extinction_per_m = sheet.extinction_per_m;
    medium.phase = sheet.phase;
    medium.shape = sheet.shape;
    draft.add(medium);
    draft.note(std::string(word_of(placed.cloud.cover)) + " at " + metres(placed.height_m) + ": " +
               sheet.name + " " + metres(thickness_m) + " thick, both assumed" +
               (cut ? "; cut below the next clouds" : ""));
}

}  // namespace

bool metar_rains_on(const Metar& report) {
    bool on = false;
    for (const MetarWeather& weather : report.weather) {
        if (weather.descriptor == "SH" || weather.descriptor == "TS") return false;
        if (weather.intensity == MetarIntensity::kVicinity) continue;
        if (weather.descriptor == "BL" || weather.descriptor == "DR") continue;
        for (const std::string& what : weather.phenomena)
            on = on || what == "RA" || what == "SN" || what == "PL" || what == "UP";
    }
    return on;
}

void add_metar_clouds(MetarDraft& draft) {
    const Metar& report = draft.report;
    note_clear(draft);
    const bool rains_on = metar_rains_on(report);
    std::vector<Placed> all;
    bool thunder = false, has_cumulonimbus = false;
    for (const MetarWeather& weather : report.weather)
        thunder = thunder ||
                  (weather.descriptor == "TS" && weather.intensity != MetarIntensity::kVicinity);
    for (const MetarCloud& cloud : report.clouds) {
        Placed placed{cloud, std::max(cloud.height_m, kMetarLeastBase_m)};
        has_cumulonimbus = has_cumulonimbus || cloud.tower == MetarTower::kCumulonimbus;
        if (cloud.cover == MetarCover::kUnknown && !cloud.height_given &&
            cloud.tower == MetarTower::kNone) {
            draft.note("clouds: not reported, none assumed");
            continue;
        }
        if (!cloud.height_given) {
            placed.height_m = kMetarUnknownBase_m;
            draft.note("base of " + std::string(word_of(cloud.cover)) + ": not reported, " +
                       metres(kMetarUnknownBase_m) + " assumed");
        }
        if (cloud.cover == MetarCover::kUnknown)
            draft.note("amount of clouds at " + metres(placed.height_m) + ": not reported, " +
                       (cloud.tower == MetarTower::kNone ? "3.5" : "1.5") + " eighths assumed");
        all.push_back(placed);
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const Placed& a, const Placed& b) { return a.height_m < b.height_m; });
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Placed& placed = all[i];
        const bool tower = placed.cloud.tower != MetarTower::kNone;
        if (draft.lowest_m < 0) draft.lowest_m = placed.height_m;
        const bool ceiling = is_ceiling(placed.cloud) || tower;
        if (ceiling && draft.lowest_ceiling_m < 0) draft.lowest_ceiling_m = placed.height_m;
        if (tower && !is_ceiling(placed.cloud)) {
            draft.add_towers(placed.cloud.tower == MetarTower::kCumulonimbus ? kMetarCumulonimbus
                                                                             : kMetarCongestus,
                             placed.cloud.cover != MetarCover::kScattered, 0, placed.height_m);
            continue;
        }
        double next_m = -1;
        for (std::size_t k = i + 1; k < all.size() && next_m < 0; ++k)
            if (all[k].height_m > placed.height_m &&
                (all[k].cloud.tower == MetarTower::kNone || is_ceiling(all[k].cloud)))
                next_m = all[k].height_m;
        add_sheet(draft, placed, next_m, rains_on);
    }
    if (thunder && !has_cumulonimbus) {
        const double base_m = draft.lowest_m < 0 ? kMetarUnknownBase_m : draft.lowest_m;
        draft.note("thunder without a CB in the report: one is assumed");
        draft.add_towers(kMetarCumulonimbus, true, 1, base_m);
    }
    const bool silent = report.clouds.empty() && report.clear == MetarClear::kUnknown;
    if (silent && !report.obscured) draft.note("clouds: not reported, none assumed");
}

}  // namespace pileus
