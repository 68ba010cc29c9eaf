// SPDX-License-Identifier: Apache-2.0
// Laws between the keys of the air, the sun and the sky; dates and times.
// in: keys that passed their own checks -> out: faults.
// docs/scene.md; docs/atmosphere.md.
#include "src/scene/calendar.h"
#include "src/scene/checks/check_keys.h"

namespace pileus {
namespace {

/// A fault of the text under `key`, as calendar.h words it: what, value, allowed.
void add_text_fault(SceneCheck& check, const char* key, const Status& status) {
    const Node* node = check.valid_key(key);
    if (status || node == nullptr) return;
    const std::size_t comma = status.message.find(", allowed");
    check.faults.add(
        node->at, key,
        status.message.substr(0, comma) + ", " + value_text(*node) + status.message.substr(comma));
}

void check_date(SceneCheck& check) {
    const AtmosphereSettings& air = check.scene.atmosphere;
    int date[3];
    double hours = 0;
    add_text_fault(check, "atmosphere.date", read_date(air.date, date));
    add_text_fault(check, "atmosphere.time", read_time(air.time, hours));
    if (!check.written) return;
    const Node& given = *check.key("atmosphere.date");
    for (const char* key : {"atmosphere.latitude_deg", "atmosphere.longitude_deg"})
        if (check.key(key) == nullptr)
            check.faults.add(given.at, key, "missing, nothing, allowed: degrees, with a date");
    for (const char* key : {"sun.azimuth_deg", "sun.elevation_deg", "animation.sun_elevation_deg"})
        if (const Node* node = check.key(key))
            check.faults.add(node->key_at, key,
                             "conflicts with atmosphere.date, " + value_text(*node) +
                                 ", allowed: left out, or no date");
}

}  // namespace

void check_atmosphere(SceneCheck& check) {
    const Scene& scene = check.scene;
    const Node* table = check.key("atmosphere");
    if (!scene.atmosphere.present) return;
    const auto refuse = [&](const char* key, const char* why, const char* allowed) {
        if (const Node* node = check.key(key))
            check.faults.add(node->at, key, why + (", " + value_text(*node)) + allowed);
    };
    if (!scene.atmosphere.date.empty())
        check_date(check);
    else if (check.written) {
        for (const char* key :
             {"atmosphere.time", "atmosphere.utc_offset_h", "atmosphere.latitude_deg",
              "atmosphere.longitude_deg", "atmosphere.refraction"})
            refuse(key, "without a date", ", allowed: left out, or atmosphere.date");
        if (scene.atmosphere.moon)
            refuse("atmosphere.moon", "without a date", ", allowed: false, or atmosphere.date");
        if (scene.atmosphere.stars)
            refuse("atmosphere.stars", "without a date", ", allowed: false, or atmosphere.date");
        if (!scene.sun.present && table != nullptr)
            check.faults.add(table->at, "atmosphere.date",
                             "missing, nothing, allowed: a date, or the table [sun]");
    }
    if (check.written)
        for (const char* key : {"sky.radiance", "sky.map"})
            refuse(key, "conflicts with [atmosphere]", ", allowed: left out");
    if (scene.camera.orthographic && !scene.camera.flux)
        refuse("camera.projection", "looks from no single place in the air",
               ", allowed: perspective, flux");
    if (scene.output.layer_light || scene.output.layer_order)
        refuse("output.layers", "no light or order through the air",
               ", allowed: other layers, or no [atmosphere]");
}

}  // namespace pileus
