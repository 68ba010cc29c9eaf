// SPDX-License-Identifier: Apache-2.0
// See night_light.h.
#include "src/world/atmosphere/night_light.h"

#include "src/scene/calendar.h"
#include "src/world/atmosphere/earth_turn.h"
#include "src/world/atmosphere/moon_position.h"
#include "src/world/atmosphere/sun_position.h"

namespace pileus {
namespace {

/// Airglow and zodiacal light straight up, over the sun's irradiance above the air: 205 stars of
/// magnitude 10 per square degree (Leinert et al. 1998), 1.8e-4 cd/m2 under a sun of 1.3e5 lux; the
/// lines of oxygen make it a little green.
constexpr double kAirglow[3] = {0.95 * 205 * kStarOfTen, 1.03 * 205 * kStarOfTen,
                                0.85 * 205 * kStarOfTen};
constexpr double kGlowKm = 90;
/// The least share of another sky that is added.
constexpr double kOtherShare = 1e-3;

double luminance(double r, double g, double b) { return 0.2126 * r + 0.7152 * g + 0.0722 * b; }

/// Of a light's beams where the media are.
double beam_of(const FarLight& by, bool ground, const Atmosphere& air) {
    const double sine = sincos_deg(by.elevation_deg).sine;
    if (ground && sine <= 0) return 0;
    const std::array<double, 3> share = sunlight(air.tables, air.height_km, sine);
    return luminance(by.above[0] * share[0], by.above[1] * share[1], by.above[2] * share[2]);
}

/// Of a light's sky on level ground.
double level_sky_of(const FarLight& by, const Atmosphere& air) {
    float share[3];
    ground_light(air.tables, float(sincos_deg(by.elevation_deg).sine), share);
    return luminance(by.above[0] * double(share[0]), by.above[1] * double(share[1]),
                     by.above[2] * double(share[2]));
}

void aim_light(const Double3& above, double azimuth_deg, double elevation_deg, FarLight& by) {
    by.above = above;
    by.azimuth_deg = azimuth_deg;
    by.elevation_deg = elevation_deg;
}

/// The moment that a scene with a date shows; false without one.
bool moment_shown(const AtmosphereSettings& s, double hours_later, Moment& moment) {
    int date[3];
    double hours = 0;
    if (!s.present || s.date.empty()) return false;
    if (!read_date(s.date, date) || !read_time(s.time, hours)) return false;
    moment = moment_of(date, hours + hours_later, s.utc_offset_h);
    return true;
}

}  // namespace

std::array<double, 3> wide_left(const AirTables& tables, double height_km, double cosine) {
    std::array<double, 3> out{};
    const double high = height_km > 0 ? height_km : 0;
    const double low = kEarthRadiusKm / (kEarthRadiusKm + high);
    const double horizon = -__builtin_sqrt(1 - low * low);
    if (cosine < horizon) return out;
    // A hair above the horizon, where no disc would be cut.
    const double clear = cosine > horizon + 0.01 ? cosine : horizon + 0.01;
    const std::array<double, 3> left = sunlight(tables, high, clear);
    for (std::size_t c = 0; c < 3; ++c) out[c] = left[c] + 0.5 * (1 - left[c]);
    return out;
}

std::array<double, 3> glow_at(const AirTables& tables, double height_km, double cosine) {
    const double r = kEarthRadiusKm + (height_km > 0 ? height_km : 0);
    const double layer = kEarthRadiusKm + kGlowKm;
    if (r >= layer) return {};
    // van Rhijn: a thin shell.
    const double across = r / layer, square = 1 - across * across * (1 - cosine * cosine);
    const double longer = 1 / __builtin_sqrt(square);
    std::array<double, 3> out = wide_left(tables, height_km, cosine);
    for (double& v : out) v *= longer;
    return out;
}

void choose_light(const AtmosphereSettings& s, const Sun& sun, const Night& night, bool ground,
                  Atmosphere& air) {
    Double3 above;
    for (int c = 0; c < 3; ++c) above[c] = double(sun.irradiance[std::size_t(c)]);
    air.moonlit = air.two_skies = false;
    air.glow = {};
    for (int c = 0; c < 3 && s.airglow; ++c) air.glow[c] = kAirglow[c] * above[c];
    aim_light(above, sun.azimuth_deg, sun.elevation_deg, air);
    air.has_moon = night.moon;
    air.moon_radius_deg = night.moon_radius_deg;
    if (!night.moon) return;
    Double3 moon;
    // As a sun of this irradiance has it.
    for (int c = 0; c < 3; ++c) moon[c] = double(float(above[c] * night.moon_light[c]));
    aim_light(moon, night.moon_azimuth_deg, night.moon_elevation_deg, air.other);
    air.moonlit = beam_of(air.other, ground, air) > beam_of(air, ground, air);
    if (air.moonlit) {
        aim_light(air.other.above, air.other.azimuth_deg, air.other.elevation_deg, air);
        aim_light(above, sun.azimuth_deg, sun.elevation_deg, air.other);
    }
    Double3 even = air.glow;
    if (air.stars.present()) even += air.stars.even * above;
    const double glow = kPi64 * luminance(even[0], even[1], even[2]);
    air.two_skies = level_sky_of(air.other, air) > kOtherShare * (level_sky_of(air, air) + glow);
}

void place_sun(const AtmosphereSettings& s, double hours_later, Sun& sun) {
    Moment moment;
    if (!moment_shown(s, hours_later, moment)) return;
    const SunPosition at = sun_position(moment, s.latitude_deg, s.longitude_deg);
    sun.present = true;
    sun.azimuth_deg = at.azimuth_deg;
    sun.elevation_deg = at.elevation_deg + (s.refraction ? refraction_deg(at.elevation_deg) : 0);
    const double nearer = 1 / (at.distance_au * at.distance_au);
    for (float& e : sun.irradiance) e = float(double(e) * nearer);
}

void place_night(const AtmosphereSettings& s, double hours_later, Night& night) {
    night = Night{};
    Moment moment;
    if (!moment_shown(s, hours_later, moment)) return;
    if (s.moon) {
        const MoonPosition at = moon_position(moment, s.latitude_deg, s.longitude_deg);
        night.moon = true;
        night.moon_azimuth_deg = at.azimuth_deg;
        night.moon_elevation_deg =
            at.elevation_deg + (s.refraction ? refraction_deg(at.elevation_deg) : 0);
        night.moon_radius_deg = kMoonRadiusDeg * kMoonMeanKm / at.distance_km;
        const std::array<double, 3> light = moon_light(at);
        night.moon_light = {light[0], light[1], light[2]};
        night.moon_to_sun = at.to_sun;
    }
    if (!s.stars) return;
    const EarthTurn earth = earth_turn(moment.julian_day);
    night.stars = true;
    night.centuries = earth.centuries;
    night.sidereal_deg = within_turn(earth.sidereal_deg + s.longitude_deg);
    night.latitude_deg = s.latitude_deg;
    night.refraction = s.refraction;
}

}  // namespace pileus
