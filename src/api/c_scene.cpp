// SPDX-License-Identifier: Apache-2.0
// pileus.h: scenes that a program changes, and the keys that they may hold.
// docs/embedding.md, "Scenes by program"
#include <cmath>

#include "src/api/c_types.h"
#include "src/base/number_text.h"
#include "src/base/printable.h"
#include "src/scene/checks/key_words.h"
#include "src/scene/read_scene.h"
#include "src/scene/toml/toml_tree.h"

namespace pileus::api {
namespace {

constexpr std::uint32_t kMaxNumbers = 64;

/// Whether one of two keys is the other, or a table around it.
bool overlap(std::string_view a, std::string_view b) {
    if (a.size() > b.size()) std::swap(a, b);
    return b.substr(0, a.size()) == a && (b.size() == a.size() || b[a.size()] == '.');
}

/// What sliders have set before: the last setting of a key goes, unless one after it is of a table
/// around it, or of a key within it.
void drop_earlier(const std::string& key, std::vector<std::string>& set) {
    for (std::size_t i = set.size(); i > 0; --i) {
        const std::string_view other = override_key(set[i - 1]);
        if (!overlap(key, other)) continue;
        if (other == key) set.erase(set.begin() + std::ptrdiff_t(i) - 1);
        return;
    }
}

/// As TOML: a whole number where it is one, so that keys of both kinds take it.
std::string toml_number(double value) {
    if (value == std::floor(value) && std::fabs(value) < 0x1p63)
        return std::to_string(std::int64_t(value));
    const std::string text = number_text(value);
    return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

Status set_key(Scene& scene, const std::string& key, const std::string& value) {
    if (key.empty() || key.find_first_of("= \t\n") != std::string::npos)
        return Status::bad_input("key: " + printable(key.substr(0, 60)) +
                                 ", allowed: the name of a key, such as medium.0.albedo");
    std::vector<std::string> set = scene.overrides;
    drop_earlier(key, set);
    set.push_back(key + "=" + value);
    Scene next;
    PILEUS_TRY(
        read_scene_text(text_without_overrides(scene), scene.file, scene.directory, set, next));
    scene = std::move(next);
    return Status::ok();
}

}  // namespace
}  // namespace pileus::api

using namespace pileus;
using namespace pileus::api;

extern "C" {

pileus_code pileus_scene_set(pileus_scene* scene, const char* key, const char* value,
                             pileus_error* error) {
    return call(nullptr, error, [&]() -> Status {
        if (scene == nullptr) return no_handle("scene");
        if (key == nullptr || value == nullptr)
            return Status::bad_input("key, value: null, allowed: a text each");
        return set_key(scene->scene, key, value);
    });
}

pileus_code pileus_scene_set_numbers(pileus_scene* scene, const char* key, const double* values,
                                     uint32_t count, pileus_error* error) {
    return call(nullptr, error, [&]() -> Status {
        if (scene == nullptr) return no_handle("scene");
        if (key == nullptr || values == nullptr)
            return Status::bad_input("key, values: null, allowed: a text, and numbers");
        if (count < 1 || count > kMaxNumbers)
            return Status::bad_input("count: " + std::to_string(count) + ", allowed: 1 to " +
                                     std::to_string(kMaxNumbers));
        std::string text;
        for (std::uint32_t i = 0; i < count; ++i) {
            if (!std::isfinite(values[i]))
                return Status::bad_input("values[" + std::to_string(i) +
                                         "]: " + number_text(values[i]) + ", allowed: finite");
            text += (i > 0 ? "," : "") + toml_number(values[i]);
        }
        return set_key(scene->scene, key, count > 1 ? "[" + text + "]" : text);
    });
}

pileus_code pileus_scene_dump(const pileus_scene* scene, char* text, size_t size, size_t* needed,
                              pileus_error* error) {
    return call(nullptr, error, [&]() -> Status {
        if (scene == nullptr) return no_handle("scene");
        std::string document;
        PILEUS_TRY(scene_document(scene->scene, document));
        return give_text(document, "scene", text, size, needed);
    });
}

uint32_t pileus_key_count(void) { return std::uint32_t(all_scene_keys().size()); }

pileus_code pileus_key_at(uint32_t index, pileus_key* key, pileus_error* error) {
    return call(nullptr, error, [&]() -> Status {
        const std::vector<const KeyRow*> keys = all_scene_keys();
        if (index >= keys.size())
            return Status::bad_input("index: " + std::to_string(index) + ", allowed: below " +
                                     std::to_string(keys.size()));
        const KeyRow& row = *keys[index];
        pileus_key out{};
        out.name = row.path;
        out.unit = row.unit;
        out.help = row.help;
        out.numbers = std::uint32_t(numbers_of(row.kind()));
        if (out.numbers > 0) out.low = row.allowed.range.low, out.high = row.allowed.range.high;
        copy_cut(allowed_text(row), out.allowed, sizeof out.allowed);
        if (!row.required()) copy_cut(default_text(row), out.value, sizeof out.value);
        return give(out, key, "key");
    });
}

}  // extern "C"
