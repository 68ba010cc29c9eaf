// SPDX-License-Identifier: Apache-2.0
// See metar_sky.h: scenes are written here, what they hold is decided in metar_clouds.cpp and
// metar_air.cpp. docs/metar.md
#include "src/scene/metar/metar_sky.h"

#include <algorithm>

#include "src/base/angles.h"
#include "src/base/number_text.h"
#include "src/scene/metar/metar_parts.h"

namespace pileus {
namespace {

std::string number(double value) { return number_text(value, 9); }

/// Mixed so that neighbouring seeds share no clouds. Steele, Lea, Flood 2014 (SplitMix64).
std::uint64_t mixed(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15ull;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
    return x ^ (x >> 31);
}

/// A scene must have a camera.
std::string camera_text(double ground_m) {
    const std::string height = number(ground_m + 100);
    return "[camera]\nposition_m = [0, 0, " + height + "]\ntarget_m = [0, 1000, " + height +
           "]\n\n";
}

/// Where the box of a low sheet ends.
std::string ground_text(double ground_m) {
    return "[ground]\naltitude_m = " + number(ground_m) + "\n\n";
}

/// Sunlight on nodes, which sheets have where its steps are given: docs/skies.md.
std::string method_text(int steps) {
    return "\n[method]\nname = \"raymarch\"\n\n[raymarch]\nsteps = " + std::to_string(steps) +
           "\ntemporal = " + std::to_string(kMetarTemporal) +
           "\nlight_steps = 12\nlight_first_step_m = 30\nlight_growth = 1.4\nlight_refresh = 8\n";
}

std::string tower_method_text() {
    return "\n[method]\nname = \"raymarch\"\n\n[raymarch]\nsteps = " + std::to_string(kMetarSteps) +
           "\ntemporal = " + std::to_string(kMetarTemporal) + "\n";
}

}  // namespace

void metar_wind_at(const Metar& report, bool southern, double height_m, double (&m_per_s)[2]) {
    m_per_s[0] = m_per_s[1] = 0;
    const MetarWind& wind = report.wind;
    if (!wind.given || wind.variable) return;
    const double low = height_m < kMetarFriction_m ? height_m / kMetarFriction_m : 1;
    const double above_km = height_m > kMetarFriction_m ? (height_m - kMetarFriction_m) / 1000 : 0;
    const double speed =
        wind.speed_m_per_s * (1 + kMetarWindGain * low + kMetarWindGainPerKm * above_km);
    const SineCosine from =
        sincos_deg(wind.from_deg + (southern ? -kMetarVeer_deg : kMetarVeer_deg) * low);
    m_per_s[0] = -from.sine * speed;
    m_per_s[1] = -from.cosine * speed;
}

std::int64_t MetarDraft::next_seed() {
    return std::int64_t(mixed(mixed(std::uint64_t(settings.seed)) + seeds++) >> 32);
}

void MetarDraft::add(const MetarMedium& medium) {
    double wind[2];
    const double height_m = medium.base_m - settings.field_elevation_m;
    metar_wind_at(report, settings.southern, height_m, wind);
    std::string text = camera_text(settings.field_elevation_m);
    text += ground_text(settings.field_elevation_m);
    text += "[[medium]]\ndensity = \"procedural:sky\"\n";
    if (medium.extinction_per_m > 0)
        text += "extinction_per_m = " + number(medium.extinction_per_m) + "\n";
    if (!medium.albedo.empty()) text += "albedo = " + medium.albedo + "\n";
    if (!medium.phase.empty()) text += "phase = " + medium.phase + "\n";
    text += "sky = { type = \"" + medium.type + "\", base_m = " + number(medium.base_m) +
            ", top_m = " + number(medium.top_m);
    if (medium.coverage >= 0) text += ", coverage = " + number(medium.coverage);
    text += ", planet_radius_m = 6371000, wind_m_per_s = [" + number(wind[0]) + ", " +
            number(wind[1]) + "], seed = " + std::to_string(next_seed());
    if (!medium.shape.empty()) text += ", " + medium.shape;
    text += " }\n" + method_text(height_m > kMetarThin_m ? kMetarThinSteps : kMetarSteps);
    sky.layers.push_back({medium.name + "_" + std::to_string(sky.layers.size() + 1), text});
}

void MetarDraft::add_towers(const MetarTowers& towers, bool few, int count, double base_m) {
    bool there = false;
    for (const MetarScene& kind : sky.kinds) there = there || kind.name == towers.name;
    if (!there)
        sky.kinds.push_back({towers.name, camera_text(settings.field_elevation_m) +
                                              "[[medium]]\ndensity = \"procedural:cloud\"\n"
                                              "cloud = { type = \"" +
                                              towers.type +
                                              "\", seed = " + std::to_string(next_seed()) + " }\n" +
                                              tower_method_text()});
    MetarScatter row;
    row.kind = towers.name;
    row.count = count > 0 ? count : few ? towers.few : towers.scattered;
    int standing = 0;
    for (const MetarScatter& other : sky.scatter)
        if (other.kind == row.kind) standing += other.count;
    if (row.count > towers.most - standing) row.count = towers.most - standing;
    if (row.count < 1) {
        note(std::string(towers.name) + ": " + std::to_string(standing) + " stand, more left out");
        return;
    }
    row.base_m = settings.field_elevation_m + base_m;
    row.near_m = towers.near_m;
    row.far_m = settings.scale_radius_km * 1000;
    if (row.far_m > towers.max_far_m) row.far_m = towers.max_far_m;
    // A ring without room for them is made wide enough for one.
    if (row.far_m < row.near_m + towers.room_m) {
        row.far_m = row.near_m + towers.room_m;
        row.count = 1;
    }
    row.seed = next_seed();
    sky.scatter.push_back(row);
}

namespace {

void order_towers(MetarDraft& draft) {
    MetarSky& sky = draft.sky;
    // Places are taken in this order: the widest first, while there is room.
    const auto wide = [](const MetarScatter& row) { return row.kind == kMetarCumulonimbus.name; };
    std::stable_partition(sky.scatter.begin(), sky.scatter.end(), wide);
    if (std::any_of(sky.scatter.begin(), sky.scatter.end(), wide)) {
        int left = kMetarCongestusBeside;
        for (MetarScatter& row : sky.scatter)
            if (!wide(row)) {
                row.count = std::min(row.count, left);
                left -= row.count;
            }
        sky.scatter.erase(std::remove_if(sky.scatter.begin(), sky.scatter.end(),
                                         [](const MetarScatter& row) { return row.count == 0; }),
                          sky.scatter.end());
    }
    for (const MetarScatter& row : sky.scatter)
        draft.note(row.kind + ": " + std::to_string(row.count) +
                   (row.count == 1 ? " stands " : " stand ") + number(row.near_m / 1000) + " to " +
                   number(row.far_m / 1000) + " km away; number, places and height are assumed");
}

}  // namespace

Status metar_sky(const Metar& report, const MetarSkySettings& settings, MetarSky& out) {
    if (!(settings.field_elevation_m >= -500 && settings.field_elevation_m <= 9000))
        return Status::bad_input("metar: field elevation out of range, " +
                                 number_text(settings.field_elevation_m, 9) +
                                 ", allowed: -500 to 9000 m");
    if (!(settings.scale_radius_km >= 1 && settings.scale_radius_km <= 1000))
        return Status::bad_input("metar: radius out of range, " +
                                 number_text(settings.scale_radius_km, 9) +
                                 ", allowed: 1 to 1000 km");
    MetarSky sky;
    MetarDraft draft{report, settings, sky};
    if (!report.wind.given)
        draft.note("wind: not reported, clouds stand still");
    else if (report.wind.variable && report.wind.speed_m_per_s > 0)
        draft.note("wind: without a direction, clouds stand still");
    else if (report.wind.speed_m_per_s > 0)
        draft.note(
            "wind aloft: twice that of the ground at 1 km and turned by 25 degrees, assumed");
    add_metar_clouds(draft);
    add_metar_air(draft);
    order_towers(draft);
    sky.time_given = report.time_given;
    sky.day = report.day;
    sky.utc_hours = report.hour + report.minute / 60.0;
    if (!report.time_given) draft.note("time: not reported");
    out = std::move(sky);
    return Status::ok();
}

}  // namespace pileus
