// SPDX-License-Identifier: Apache-2.0
// Laws between the keys of many clouds, and of a scene that has them.
// in: keys that passed their own checks -> out: paths of the kinds' scenes; faults.
// docs/clouds.md
#include <algorithm>

#include "src/base/number_text.h"
#include "src/scene/above_ground.h"
#include "src/scene/checks/check_keys.h"
#include "src/scene/metar/metar.h"

namespace pileus {
namespace {

constexpr const char* kNow = "[clouds]";

/// The names that a kind may be called by, for messages.
std::string kind_names(const CloudsSettings& clouds) {
    std::string names;
    for (const CloudKindSettings& kind : clouds.kinds)
        names += (names.empty() ? "" : ", ") + quote_text(kind.name);
    return names;
}

bool is_kind(const CloudsSettings& clouds, const std::string& name) {
    return std::any_of(clouds.kinds.begin(), clouds.kinds.end(),
                       [&](const CloudKindSettings& kind) { return kind.name == name; });
}

const Support& of_skies(Feature feature) { return support(feature, MethodColumn::kCloudSkies); }

std::string words_of(Feature feature) {
    return std::string(of_skies(feature).text) + ", allowed: " + of_skies(feature).allowed;
}

struct CloudCheck {
    SceneCheck& check;
    CloudsSettings& clouds = check.scene.clouds;

    void fault(const Node& node, const std::string& key, const std::string& what,
               const std::string& allowed) const {
        check.faults.add(node.at, key, what + ", " + value_text(node) + ", allowed: " + allowed);
    }

    void kinds(const Node& list) const {
        for (std::size_t i = 0; i < clouds.kinds.size(); ++i) {
            const std::string path = "clouds.kind." + std::to_string(i) + ".";
            const Node& name = *list.children[i].find("name");
            const Node& file = *list.children[i].find("scene");
            bool once = !name.text.empty();
            for (std::size_t j = 0; j < i; ++j) once = once && clouds.kinds[j].name != name.text;
            if (!once)
                fault(name, path + "name", name.text.empty() ? "empty" : "given twice",
                      "a name of its own");
            // What is wrong with the file shows when it is read: its place is kept for that.
            const std::string key = path + "scene";
            check.found[key] = {&file, check_path(check, file, key.c_str(), clouds.kinds[i].scene)};
        }
    }

    void layers(const Node& list) const {
        for (std::size_t i = 0; i < clouds.layers.size(); ++i) {
            const std::string key = "clouds.layer." + std::to_string(i) + ".scene";
            const Node& file = *list.children[i].find("scene");
            check.found[key] = {&file,
                                check_path(check, file, key.c_str(), clouds.layers[i].scene)};
        }
    }

    void name_of_kind(const Node& node, const std::string& key) const {
        if (!is_kind(clouds, node.text)) fault(node, key, "no such kind", kind_names(clouds));
    }

    void places(const Node& list) const {
        for (std::size_t i = 0; i < list.children.size(); ++i)
            name_of_kind(*list.children[i].find("kind"),
                         "clouds.place." + std::to_string(i) + ".kind");
    }

    void rising(const Node& table, const std::string& path, const char* key,
                const std::array<double, 2>& range) const {
        if (range[0] <= range[1]) return;
        fault(*table.find(key), path + key, "falling", "the least first");
    }

    void scatters(const Node& list) const {
        for (std::size_t i = 0; i < list.children.size(); ++i) {
            const std::string path = "clouds.scatter." + std::to_string(i) + ".";
            const Node& table = list.children[i];
            const CloudScatter& s = clouds.scatters[i];
            if (const Node* names = table.find("kinds"))
                for (const Node& name : names->children) name_of_kind(name, path + "kinds");
            rising(table, path, "base_m", s.base_m);
            rising(table, path, "scale", s.scale);
            const Ground& ground = check.scene.ground;
            if (is_below_ground(ground, s.base_m[0], 0))
                check.faults.add(table.find("base_m")->at, path + "base_m",
                                 below_ground_text(ground, s.base_m[0], 0));
            if (s.near_m < s.far_m) continue;
            const Node* node = table.find("far_m");
            if (node == nullptr) node = table.find("near_m");
            if (node == nullptr) node = &table;
            check.faults.add(node->at, path + "far_m",
                             "not beyond near_m, " + number_text(s.far_m) +
                                 ", allowed: more than " + number_text(s.near_m));
        }
    }

    /// So many in all as a picture may have.
    void count(const Node& at, const char* key) const {
        std::size_t all = clouds.places.size();
        for (const CloudScatter& s : clouds.scatters) all += std::size_t(s.count);
        if (all > kMaxClouds)
            check.faults.add(at.at, key,
                             "too many clouds in all, " + std::to_string(all) +
                                 ", allowed: up to " + std::to_string(kMaxClouds));
    }

    /// What a sky with clouds has not.
    void surroundings(const Node& list) const {
        Scene& scene = check.scene;
        if (!scene.media.empty()) {
            const Node* medium = check.key("medium.0");
            check.faults.add(medium != nullptr ? medium->at : list.at, "medium.0",
                             "conflicts with [clouds], allowed: left out, in the scene of a kind");
        }
        if (const Node* light = check.key("light.0"))
            check.faults.add(light->at, "light.0", words_of(Feature::kLampPoint));
        // Kinds have methods of their own.
        conflict(check, "method.name", kNow);
        if (scene.camera.flux) conflict(check, "camera.projection", kNow);
        for (const char* key : {"sky.map", "camera.depth"}) conflict(check, key, kNow);
        if (scene.lens.aperture_radius_m > 0) conflict(check, "camera.aperture_radius_m", kNow);
        if (scene.lens.shutter_s > 0) conflict(check, "camera.shutter_s", kNow);
        const Node* layers = check.valid_key("output.layers");
        if (layers == nullptr) return;
        for (const Node& layer : layers->children)
            if (place_in("radiance|alpha|depth|cloud", layer.text) < 0)
                fault(layer, "output.layers", of_skies(Feature::kLayerTau).text,
                      of_skies(Feature::kLayerTau).allowed);
    }
};

/// A report is read where the scene is opened; here is what goes with it.
void check_weather(SceneCheck& check) {
    ReportSettings& weather = check.scene.clouds.weather;
    const Node* metar = check.valid_key("weather.metar");
    if (metar == nullptr) {
        for (const char* key : {"weather.seed", "weather.elevation_m"})
            if (const Node* node = check.key(key))
                check.faults.add(node->at, key,
                                 "without a report, " + value_text(*node) +
                                     ", allowed: left out, or weather.metar");
        return;
    }
    Metar report;
    const Status read = read_metar(weather.metar, report);
    if (!read) {
        // The key says what it is of.
        const std::string head = "metar: ";
        const bool named = read.message.compare(0, head.size(), head) == 0;
        check.faults.add(metar->at, "weather.metar",
                         named ? read.message.substr(head.size()) : read.message);
    }
    const AtmosphereSettings& air = check.scene.atmosphere;
    if (!air.present)
        check.faults.add(metar->at, "atmosphere",
                         "missing, nothing, allowed with weather.metar: the table [atmosphere]");
    if (!check.written) return;
    conflict(check, "atmosphere.turbidity", "weather.metar, which has the visibility");
    weather.report_time = !air.date.empty() && check.key("atmosphere.time") == nullptr;
}

}  // namespace

void check_clouds(SceneCheck& check) {
    const CloudCheck own{check};
    const Node* kinds = check.valid_key("clouds.kind");
    const Node* layers = check.valid_key("clouds.layer");
    const Node* metar = check.valid_key("weather.metar");
    check_weather(check);
    if (kinds == nullptr) {
        for (const char* list : {"clouds.place", "clouds.scatter"})
            if (const Node* node = check.valid_key(list))
                check.faults.add(node->at, "clouds.kind",
                                 std::string("missing, nothing, allowed with ") + list +
                                     ": kinds of clouds, each headed [[clouds.kind]]");
        const Node* table = check.key("clouds");
        if (table != nullptr && table->is_table() && table->find("kind") == nullptr &&
            check.key("clouds.layer") == nullptr && check.key("weather.metar") == nullptr)
            check.faults.add(table->at, "clouds.kind",
                             "missing, nothing, allowed: kinds of clouds, each headed "
                             "[[clouds.kind]], or layers, [[clouds.layer]]");
    }
    const Node* first = kinds != nullptr ? kinds : layers != nullptr ? layers : metar;
    if (first == nullptr) return;
    if (kinds != nullptr) own.kinds(*kinds);
    if (layers != nullptr) own.layers(*layers);
    own.surroundings(*first);
    if (kinds == nullptr) return;
    const Node* places = check.valid_key("clouds.place");
    if (places != nullptr) own.places(*places);
    const Node* scatters = check.valid_key("clouds.scatter");
    if (scatters != nullptr) own.scatters(*scatters);
    if (scatters != nullptr) own.count(*scatters, "clouds.scatter");
    if (check.scene.clouds.detail.near_scale == 3)
        if (const Node* node = check.valid_key("clouds.detail.near_scale"))
            own.fault(*node, "clouds.detail.near_scale", "out of range", "1, 2 or 4");
}

}  // namespace pileus
