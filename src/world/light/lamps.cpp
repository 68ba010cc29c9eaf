// SPDX-License-Identifier: Apache-2.0
// See lights.h.
#include <cstring>
#include <glm/geometric.hpp>
#include <string>

#include "kernels_cpu/core/profile.h"
#include "src/base/angles.h"
#include "src/base/single.h"
#include "src/world/light/lights.h"

namespace pileus {
namespace {

/// A light without a radius has this share of the shortest edge of a cell.
constexpr double kLeastRadius = 1e-3;
/// Slope of a cone's hard edge: full light a float's step inside of it.
constexpr double kHardEdge = 1e7;

void set_cone(const LightSettings& light, LampParams& lamp) {
    // A cosine of -3 is outside of every cone: the falloff is done long before -1.
    lamp.edge = -3;
    lamp.slope = 1;
    lamp.axis[2] = -1;
    if (light.type != LampKind::kSpot) return;
    const Double3 way =
        light.direction != Double3{} ? light.direction : light.target_m - light.position_m;
    const Double3 axis = way / glm::length(way);
    for (std::size_t a = 0; a < 3; ++a) lamp.axis[a] = float(axis[int(a)]);
    if (light.cone_deg >= 360 && light.penumbra_deg == 0) return;
    const double half = light.cone_deg / 2;
    const double edge = sincos_deg(half).cosine;
    const double full = sincos_deg(half - light.penumbra_deg).cosine;
    lamp.edge = float(edge);
    lamp.slope = float(full - edge > 1 / kHardEdge ? 1 / (full - edge) : kHardEdge);
}

LampParams lamp_of(const LightSettings& light, const Medium& medium) {
    LampParams lamp{};
    const bool parallel = light.type == LampKind::kDirectional;
    const std::array<float, 3>& colour = parallel ? light.irradiance : light.intensity;
    for (std::size_t c = 0; c < 3; ++c) {
        lamp.light[c] = colour[c];
        lamp.strength = colour[c] > lamp.strength ? colour[c] : lamp.strength;
    }
    set_cone(light, lamp);
    lamp.parallel = parallel ? 1 : 0;
    double shortest = double(medium.grid.cell_m[0]);
    for (std::size_t a = 0; a < 3; ++a) {
        lamp.at[a] = float(light.position_m[int(a)] - medium.low_m[int(a)]);
        const double edge = double(medium.grid.cell_m[a]);
        shortest = edge < shortest ? edge : shortest;
    }
    const double least = kLeastRadius * shortest;
    const double radius = light.radius_m > least ? light.radius_m : least;
    lamp.least_square = float(radius * radius);
    constexpr auto kLeastSquare = float(kLeastPositive * kLeastPositive);
    if (!(lamp.least_square > kLeastSquare)) lamp.least_square = kLeastSquare;
    if (!parallel && light.radius_m > 0 && light.shadow_samples > 1) {
        lamp.radius = float(radius);
        lamp.places = light.shadow_samples;
    }
    if (!parallel) return lamp;
    const Double3 way = towards_deg(light.azimuth_deg, light.elevation_deg);
    for (int a = 0; a < 3; ++a) lamp.at[a] = float(way[a]);
    return lamp;
}

/// Why a light is left out; null: it is not.
const char* left_out(const LightSettings& light, const LampParams& lamp, const Ground& ground) {
    const bool below = light.type == LampKind::kDirectional
                           ? !(lamp.at[2] > 0)
                           : light.position_m[2] < ground.altitude_m;
    if (!(lamp.strength > 0)) return "dark";
    return ground.present && below ? "below the ground" : nullptr;
}

}  // namespace

std::vector<LampParams> make_lamps(const std::vector<LightSettings>& lights, const Ground& ground,
                                   const Medium& medium) {
    std::vector<LampParams> lamps;
    if (!kLights) return lamps;
    for (const LightSettings& light : lights) {
        const LampParams lamp = lamp_of(light, medium);
        if (left_out(light, lamp, ground) == nullptr) lamps.push_back(lamp);
    }
    return lamps;
}

void explain_lamps(const std::vector<LightSettings>& lights, const Ground& ground,
                   const Medium& medium, Plan& plan) {
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const std::string name = "light " + std::to_string(i);
        const LampParams lamp = lamp_of(lights[i], medium);
        if (lights[i].radius_m > 0 && !(lamp.radius > 0) && lamp.parallel == 0)
            plan.leave_out((name + "'s soft shadow").c_str(), "shadow_samples is 1");
        if (const char* why = left_out(lights[i], lamp, ground)) plan.leave_out(name.c_str(), why);
    }
}

bool same_lamps(const std::vector<LampParams>& a, const std::vector<LampParams>& b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0);
}

}  // namespace pileus
