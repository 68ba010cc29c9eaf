// SPDX-License-Identifier: Apache-2.0
// Fuzz target: weather reports of aerodromes, and the skies that they become.
// in: bytes as a report -> out: groups within their ranges and scenes that are read, or one line.
// docs/metar.md
#include "src/scene/metar/metar_sky.h"
#include "src/scene/read_scene.h"
#include "tests/fuzz/target.h"

namespace {

void check_text(const std::string& text) {
    for (const char c : text)
        fuzz::require(static_cast<unsigned char>(c) >= 0x20 && c != 0x7F, "a list is printable");
}

}  // namespace

int fuzz::metar(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    pileus::Metar report;
    const pileus::Status status = pileus::read_metar(text, report);
    if (!status) {
        fuzz::check_fault(status, "metar:", true);
        return 0;
    }
    fuzz::require(report.wind.from_deg >= 0 && report.wind.from_deg <= 360,
                  "a wind has a direction");
    fuzz::require(report.wind.speed_m_per_s >= 0 && report.wind.speed_m_per_s <= 150,
                  "a wind has a speed");
    fuzz::require(!report.visibility.given || report.visibility.m > 0, "a visibility is above 0");
    for (const std::string& word : report.not_understood) check_text(word);
    for (const std::string& word : report.without_effect) check_text(word);

    pileus::MetarSkySettings settings;
    settings.seed = std::int64_t(size) - 40;
    settings.field_elevation_m = size % 3 == 0 ? 1200 : 0;
    pileus::MetarSky sky;
    fuzz::require(bool(pileus::metar_sky(report, settings, sky)), "a report has a sky");
    fuzz::require(sky.turbidity >= 1 && sky.turbidity <= 10, "a sky has a turbidity");
    for (const std::string& note : sky.notes) check_text(note);
    for (const auto* scenes : {&sky.layers, &sky.kinds})
        for (const pileus::MetarScene& made : *scenes) {
            pileus::Scene scene;
            fuzz::require(bool(pileus::read_scene_text(made.text, "s.toml", "", {}, scene)),
                          "a sky's texts are scenes");
        }
    return 0;
}
