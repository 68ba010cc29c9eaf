// SPDX-License-Identifier: Apache-2.0
// See lights.h.
#include <algorithm>
#include <cstring>
#include <glm/geometric.hpp>
#include <string>

#include "kernels_cpu/core/math.h"
#include "kernels_cpu/core/profile.h"
#include "kernels_cpu/light/lamp.h"
#include "src/base/angles.h"
#include "src/base/single.h"
#include "src/world/light/lights.h"

namespace pileus {
namespace {

/// A light without a radius has this share of the shortest edge of a cell.
constexpr double kMinRadius = 1e-3;
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
    const double least = kMinRadius * shortest;
    const double radius = light.radius_m > least ? light.radius_m : least;
    lamp.least_square = float(radius * radius);
    constexpr auto kMinSquare = float(kMinPositive * kMinPositive);
    if (!(lamp.least_square > kMinSquare)) lamp.least_square = kMinSquare;
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

/// Optical depth straight down from a place to the ground, by samples of the voxels' densities.
double depth_to_ground(const Medium& medium, const float (&at)[3], double metres) {
    constexpr int kSamples = 64;
    const Grid& grid = medium.grid;
    if (medium.volume.density.empty()) return 0;
    int voxel[3];
    double sum = 0;
    for (int i = 0; i < kSamples; ++i) {
        const double z = double(at[2]) - metres * (i + 0.5) / kSamples;
        const double place[3] = {double(at[0]), double(at[1]), z};
        bool within = true;
        for (int a = 0; a < 3; ++a) {
            const double cells = place[a] / double(grid.cell_m[a]);
            within = within && cells >= 0 && cells < grid.size[a];
            voxel[a] = within ? int(cells) : 0;
        }
        if (within)
            sum += double(medium.volume.density[voxel_index(grid, voxel[0], voxel[1], voxel[2])]);
    }
    return double(medium.sigma) * sum * metres / kSamples;
}

/// Of a lamp of intensity 1 the flux that goes down, the middle of where it falls, from below it,
/// and the radius about that within which half of it does.
struct LitGround {
    double flux = 0, middle[2] = {}, radius = 0;
};
LitGround lit_ground(const LampParams& lamp, double height) {
    constexpr int kHeights = 16, kAround = 32, kRays = kHeights * kAround;
    constexpr double kFarthest = 20;  // heights
    const Double3 axis{double(lamp.axis[0]), double(lamp.axis[1]), double(lamp.axis[2])};
    const Double3 other = axis.z < 0.9 && axis.z > -0.9 ? Double3{0, 0, 1} : Double3{1, 0, 0};
    const Double3 u = glm::normalize(glm::cross(axis, other)), v = glm::cross(axis, u);
    const double span = 1 - std::max(double(lamp.edge), -1.0);
    struct Ray {
        double x, y, flux;
    } rays[kRays];
    int count = 0;
    LitGround out;
    for (int i = 0; i < kRays; ++i) {
        const double cosine = 1 - span * (i / kAround + 0.5) / kHeights;
        const double sine = __builtin_sqrt(std::max(1 - cosine * cosine, 0.0));
        const auto turn = sincos_deg(360 * (i % kAround + 0.5) / kAround);
        const Double3 way = axis * cosine + (u * turn.cosine + v * turn.sine) * sine;
        if (!(way.z < 0)) continue;
        const double flux = double(lamp_shape(lamp, float(cosine))) * 2 * kPi64 * span / kRays;
        const double metres = std::min(height / -way.z, kFarthest * height);
        out.flux += flux;
        out.middle[0] += flux * way.x * metres;
        out.middle[1] += flux * way.y * metres;
        rays[count++] = {way.x * metres, way.y * metres, flux};
    }
    if (!(out.flux > 0)) return LitGround{};
    for (double& m : out.middle) m /= out.flux;
    double low = 0, high = 2 * kFarthest * height;
    for (int turn = 0; turn < 32; ++turn) {
        const double radius = 0.5 * (low + high);
        double within = 0;
        for (int i = 0; i < count; ++i) {
            const double x = rays[i].x - out.middle[0], y = rays[i].y - out.middle[1];
            if (x * x + y * y <= radius * radius) within += rays[i].flux;
        }
        (within < 0.5 * out.flux ? low : high) = radius;
    }
    out.radius = high;
    return out;
}

}  // namespace

LampParams spot_on_ground(const LampParams& lamp, const Lighting& light, const Medium& medium) {
    constexpr double kMaxDepth = 1;
    // Of a lamp h over the ground that shines all around, half of the flux within 1.73 h: straight
    // above it what the ground sends up is that of a point 1.18 h to 1.31 h below, at any height.
    constexpr double kBelow = 0.69;
    LampParams spot = lamp;
    spot.strength = 0;
    for (float& part : spot.light) part = 0;
    const double height = double(lamp.at[2]) - light.ground.z;
    if (!light.ground.present || !(light.ground.albedo > 0) || lamp.parallel != 0 || height < 0)
        return spot;
    const LitGround lit = lit_ground(lamp, height);
    const double depth = depth_to_ground(medium, lamp.at, height);
    if (depth > kMaxDepth) return spot;
    // A flux F leaves the ground with the intensity F cos / pi.
    const double sent = light.ground.albedo / kPi64 * lit.flux * double(exp_(float(-depth)));
    for (int a = 0; a < 2; ++a) spot.at[a] = float(double(lamp.at[a]) + lit.middle[a]);
    spot.at[2] = float(light.ground.z - kBelow * lit.radius);
    for (int a = 0; a < 3; ++a) spot.axis[a] = a == 2 ? 1.0f : 0.0f;
    spot.edge = 0, spot.slope = 1;
    spot.radius = 0, spot.places = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        spot.light[c] = float(sent * double(lamp.light[c]));
        spot.strength = std::max(spot.strength, spot.light[c]);
    }
    return spot;
}

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
