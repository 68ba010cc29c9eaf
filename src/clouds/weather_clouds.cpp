// SPDX-License-Identifier: Apache-2.0
// See weather_clouds.h.
#include "src/clouds/weather_clouds.h"

#include "src/scene/metar/metar_sky.h"
#include "src/scene/read_scene.h"

namespace pileus {
namespace {

/// "hh:mm:ss" of hours of a day.
std::string clock_text(double hours) {
    const int seconds = int(hours * 3600 + 0.5) % 86400;
    const auto two = [](int n) { return (n < 10 ? "0" : "") + std::to_string(n); };
    return two(seconds / 3600) + ":" + two(seconds / 60 % 60) + ":" + two(seconds % 60);
}

/// Before names of kinds, which are not those of the scene's own.
constexpr const char* kOwn = "weather.";

Status fill(const MetarSky& sky, Scene& scene) {
    CloudsSettings& clouds = scene.clouds;
    if (clouds.layers.size() + sky.layers.size() > kMaxCloudLayers)
        return Status::bad_input("more layers than " + std::to_string(kMaxCloudLayers) +
                                 " with those of the report, allowed: fewer [[clouds.layer]]");
    if (clouds.kinds.size() + sky.kinds.size() > kMaxCloudKinds)
        return Status::bad_input("more kinds than " + std::to_string(kMaxCloudKinds) +
                                 " with those of the report, allowed: fewer [[clouds.kind]]");
    for (const MetarScene& made : sky.layers) {
        CloudLayerSettings layer;
        layer.scene = made.name;
        layer.text = made.text;
        clouds.layers.push_back(std::move(layer));
    }
    for (const MetarScene& made : sky.kinds) {
        CloudKindSettings kind;
        kind.name = kind.scene = std::string(kOwn) + made.name;
        kind.text = made.text;
        clouds.kinds.push_back(std::move(kind));
    }
    for (const MetarScatter& row : sky.scatter) {
        CloudScatter scatter;
        scatter.kinds = {std::string(kOwn) + row.kind};
        scatter.count = row.count;
        scatter.base_m = {row.base_m, row.base_m};
        scatter.near_m = row.near_m;
        scatter.far_m = row.far_m;
        scatter.seed = row.seed;
        scatter.fewer = true;
        clouds.scatters.push_back(std::move(scatter));
    }
    scene.atmosphere.turbidity = sky.turbidity;
    if (!clouds.weather.report_time || !sky.time_given) return Status::ok();
    scene.atmosphere.time = clock_text(sky.utc_hours);
    scene.atmosphere.utc_offset_h = 0;
    return Status::ok();
}

}  // namespace

Status apply_weather(Scene& scene, std::vector<std::string>* notes,
                     std::vector<std::string>* unknown) {
    const ReportSettings& weather = scene.clouds.weather;
    if (!weather.present()) return Status::ok();
    Metar report;
    // Its lines begin with "metar: ".
    PILEUS_TRY(read_metar(weather.metar, report));
    MetarSkySettings settings;
    settings.seed = weather.seed;
    settings.field_elevation_m = weather.elevation_m;
    settings.southern = !scene.atmosphere.date.empty() && scene.atmosphere.latitude_deg < 0;
    MetarSky sky;
    PILEUS_TRY(at_key(scene, "weather.metar", metar_sky(report, settings, sky)));
    PILEUS_TRY(at_key(scene, "weather.metar", fill(sky, scene)));
    if (notes != nullptr) *notes = std::move(sky.notes);
    for (std::size_t i = 0; unknown != nullptr && i < report.not_understood.size(); ++i)
        unknown->push_back("weather.metar: the group \"" + report.not_understood[i] +
                           "\" is not understood and left out");
    return Status::ok();
}

}  // namespace pileus
