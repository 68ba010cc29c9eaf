// SPDX-License-Identifier: Apache-2.0
// Numbers that hosts set as well as texts: the one place of their ranges, for the rows in
// src/scene/keys, for sessions and for the C interface. Flights have it, but not the rows' texts.
// in: structs of a scene -> out: names for faults, ranges, checks that take no memory.
// docs/scene.md
#pragma once
#include <string>
#include <tuple>
#include <type_traits>

#include "src/base/number_text.h"
#include "src/base/single.h"
#include "src/base/status.h"
#include "src/scene/scene.h"
#include "src/scene/toml/toml_tree.h"

namespace pileus {

/// Of every number in a value.
struct KeyRange {
    double low = 0, high = 0;
    bool high_open = false;
};

/// False for what is no number, too: no comparison holds for it.
constexpr bool holds(const KeyRange& range, double v) {
    // An end that is left out is left out as the float that the number becomes.
    return v >= range.low && (range.high_open ? float(v) < float(range.high) : v <= range.high);
}

template <class Of, class Value>
struct NumberKey {
    using Struct = Of;
    const char* name;  ///< as a host's faults have it
    Value Of::*member;
    KeyRange range;
    const char* unit = "";
};
template <class Of, class Value>
NumberKey(const char*, Value Of::*, KeyRange, const char* = "") -> NumberKey<Of, Value>;

constexpr KeyRange kAnywhere{-1e9, 1e9}, kAllRound{-360, 360}, kUpright{-90, 90};

inline constexpr std::tuple kNumbers{
    NumberKey{"camera.position_m", &Camera::position_m, kAnywhere},
    NumberKey{"camera.target_m", &Camera::target_m, kAnywhere},
    NumberKey{"camera.up", &Camera::up, kAnywhere},
    NumberKey{"camera.fov_deg", &Camera::fov_deg, {kMinFovDeg, 180, true}},
    NumberKey{"camera.height_m", &Camera::height_m, {kMinPositive, 1e9}},
    NumberKey{"camera.resolution", &Camera::resolution, {1, 32768}},
    NumberKey{"sun.azimuth_deg", &Sun::azimuth_deg, kAllRound},
    NumberKey{"sun.elevation_deg", &Sun::elevation_deg, kUpright},
    NumberKey{"sun.irradiance", &Sun::irradiance, {0, 1e12}},
    NumberKey{"sky.radiance", &Sky::radiance, {0, 1e12}},
    NumberKey{"sky.map_scale", &Sky::map_scale, {0, 1e12}},
    NumberKey{"sky.map_rotation_deg", &Sky::map_rotation_deg, kAllRound},
    NumberKey{"ground.altitude_m", &Ground::altitude_m, kAnywhere},
    NumberKey{"ground.albedo", &Ground::albedo, {0, 1}},
    NumberKey{"placement.offset_m", &Placement::offset_m, kAnywhere, " m"},
    NumberKey{"placement.yaw_deg", &Placement::yaw_deg, {-1e6, 1e6}},
    NumberKey{"light.position_m", &LightSettings::position_m, kAnywhere},
    NumberKey{"light.intensity", &LightSettings::intensity, {0, 1e18}},
    NumberKey{"light.radius_m", &LightSettings::radius_m, {0, 1e9}},
    NumberKey{"light.shadow_samples", &LightSettings::shadow_samples, {1, 64}},
    NumberKey{"light.direction", &LightSettings::direction, kAnywhere},
    NumberKey{"light.target_m", &LightSettings::target_m, kAnywhere},
    NumberKey{"light.cone_deg", &LightSettings::cone_deg, {kMinPositive, 360}},
    NumberKey{"light.penumbra_deg", &LightSettings::penumbra_deg, {0, 180}},
    NumberKey{"light.azimuth_deg", &LightSettings::azimuth_deg, kAllRound},
    NumberKey{"light.elevation_deg", &LightSettings::elevation_deg, kUpright},
    NumberKey{"light.irradiance", &LightSettings::irradiance, {0, 1e9}},
    NumberKey{"size", &MediumFile::raw_size, {1, 4096}},
    NumberKey{"resolution", &MediumBox::resolution, {1, 4096}},
    NumberKey{"light_refresh", &RaymarchLightSettings::refresh, {1, 64}},
    NumberKey{"offset_m", &CloudPlaceSettings::offset_m, {-1e7, 1e7}, " m"},
    NumberKey{"yaw_deg", &CloudPlaceSettings::yaw_deg, kAllRound},
    NumberKey{"scale", &CloudPlaceSettings::scale, {0.01, 100}},
    NumberKey{"error_px", &CloudDetail::error_px, {0.001, 16}},
    NumberKey{"near_px", &CloudDetail::near_px, {1, 1e6}},
    NumberKey{"blend_frames", &CloudDetail::blend_frames, {1, 1000}},
    NumberKey{"sharpness", &CloudDetail::sharpness, {0.25, 4}},
    NumberKey{"sun_deg", &CloudDetail::sun_deg, {0, 10}}};

/// Of a member: range_of(&Sun::elevation_deg).
template <class Of, class Value>
constexpr KeyRange range_of(Value Of::*member) {
    KeyRange range;
    const auto look = [&](const auto& key) {
        if constexpr (std::is_same_v<decltype(key.member), Value Of::*>)
            if (key.member == member) range = key.range;
    };
    std::apply([&](const auto&... keys) { (look(keys), ...); }, kNumbers);
    return range;
}

/// Calls `visit(key, number)` for every number of a struct, three times for a vector.
template <class Of, class Visit>
void for_each_number(Of& of, const Visit& visit) {
    const auto each = [&](const auto& key) {
        using Struct = typename std::decay_t<decltype(key)>::Struct;
        if constexpr (std::is_same_v<Struct, std::remove_const_t<Of>>) {
            auto& value = of.*key.member;
            if constexpr (std::is_arithmetic_v<std::decay_t<decltype(value)>>)
                visit(key, value);
            else
                for (auto* v = &value[0]; v != &value[0] + sizeof value / sizeof *v; ++v)
                    visit(key, *v);
        }
    };
    std::apply([&](const auto&... keys) { (each(keys), ...); }, kNumbers);
}

/// The name of the first number that is out of range, or null.
template <class Of>
const char* out_of_range(const Of& of) {
    const char* name = nullptr;
    for_each_number(of, [&](const auto& key, const auto& v) {
        if (name == nullptr && !holds(key.range, double(v))) name = key.name;
    });
    return name;
}

/// Numbers as they are used (src/base/single.h); least lengths are more than what floats lose.
template <class Of>
Of held(Of of) {
    for_each_number(of, [](const auto& key, auto& v) {
        if constexpr (std::is_floating_point_v<std::decay_t<decltype(v)>>)
            if (key.range.low <= 0) v = single_or_0(v);
    });
    return of;
}

/// An end of a range in a host's words: 1e9, not 1e+09.
inline std::string end_words(double end) {
    std::string text = number_text(end);
    const std::size_t plus = text.find('+');
    if (plus != std::string::npos) text.erase(plus, text[plus + 1] == '0' ? 2 : 1);
    return text;
}

/// A number that a host gives: "size: 5000, allowed: 1 to 4096".
template <class Number>
Status check_number(const char* where, const char* name, Number v, const KeyRange& range,
                    const char* unit = "") {
    if (holds(range, double(v))) return Status::ok();
    return Status::bad_input(std::string(where) + name + ": " + std::to_string(v) + ", allowed: " +
                             end_words(range.low) + " to " + end_words(range.high) + unit);
}
template <class Of>
Status check_numbers(const char* where, const Of& of) {
    Status status;
    for_each_number(of, [&](const auto& key, double v) {
        if (status) status = check_number(where, key.name, v, key.range, key.unit);
    });
    return status;
}

}  // namespace pileus
