// SPDX-License-Identifier: Apache-2.0
// See atmosphere.h.
#include "src/world/atmosphere/atmosphere.h"

#include "kernels_cpu/core/math.h"
#include "platform/threads.h"
#include "src/base/angles.h"
#include "src/scene/frame_fault.h"
#include "src/scene/read_scene.h"
#include "src/scene/toml/toml_tree.h"
#include "src/world/atmosphere/sun_position.h"

namespace pileus {
namespace {

constexpr int kMapRows = 128, kMapColumns = 256;

double root(double v) { return v > 0 ? __builtin_sqrt(v) : 0; }

/// The sky from the media, each texel in its middle.
Status paint_map(double azimuth_deg, const Atmosphere& air, int threads, Image& map) {
    AirSky view;
    const double sine = sincos_deg(air.sun_elevation_deg).sine;
    PILEUS_TRY(make_air_sky(air.tables, air.height_km, sine, threads, view));
    map.width = kMapColumns;
    map.height = kMapRows;
    map.channels.clear();
    for (const char* name : {"R", "G", "B"}) {
        map.channels.push_back({name, {}});
        PILEUS_TRY(map.channels.back().pixels.resize(kMapRows * kMapColumns, "atmosphere"));
    }
    const Double3 to_sun = towards_deg(azimuth_deg, air.sun_elevation_deg);
    for (int row = 0; row < kMapRows; ++row) {
        const SineCosine zenith = sincos_deg((row + 0.5) * 180.0 / kMapRows);
        for (int i = 0; i < kMapColumns; ++i) {
            const SineCosine turn = sincos_deg((i + 0.5) * 360.0 / kMapColumns - 180.0);
            const double along = zenith.sine * turn.sine * to_sun[0] +
                                 zenith.sine * turn.cosine * to_sun[1] + zenith.cosine * to_sun[2];
            float light[3];
            sky_radiance(view, zenith.cosine, along, light);
            for (std::size_t c = 0; c < 3; ++c)
                map.channels[c].pixels[std::size_t(row * kMapColumns + i)] =
                    light[c] * float(air.above[int(c)]);
        }
    }
    return Status::ok();
}

constexpr int kHeights = 65;
constexpr double kLongStepKm = 2;

double height_of(int i) {
    const double x = double(i) / (kHeights - 1);
    return (kAirTopKm - kEarthRadiusKm) * x * x;
}

/// What air does at every height under one sun, whatever the direction.
struct Heights {
    AirAt air[kHeights];
    float sunlight[kHeights][3];
    float sun;
};

/// Along one direction: lost, and sent towards the camera, by height.
struct Sources {
    float lost[kHeights][3], smooth[kHeights][3], haze[kHeights][3];
};

void fill_heights(const Atmosphere& air, Heights& out) {
    out.sun = air.sky.sun;
    for (int i = 0; i < kHeights; ++i) {
        out.air[i] = air_at(air.tables.air, float(height_of(i)));
        sunlight_at(air.tables, kEarthRadiusKm + height_of(i), double(out.sun), out.sunlight[i]);
    }
}

void fill_sources(const Atmosphere& air, const Heights& at, double cosine, double east,
                  Sources& out) {
    const double sun = double(at.sun);
    const double along = cosine * sun + root((1 - cosine * cosine) * (1 - sun * sun)) * east;
    const float phase = air_phase(float(along));
    float y[kAirTerms];
    air_harmonics(cosine, east, y);
    for (int i = 0; i < kHeights; ++i) {
        const AirAt& here = at.air[i];
        float by_air[3], by_haze[3];
        scattered_at(air.tables, float(height_of(i)), at.sun, y, by_air, by_haze);
        for (int c = 0; c < 3; ++c) {
            out.lost[i][c] = here.extinction[c];
            out.smooth[i][c] = here.rayleigh[c] * (phase * at.sunlight[i][c] + by_air[c]) +
                               here.haze[c] * by_haze[c];
            out.haze[i][c] = here.haze[c] * at.sunlight[i][c];
        }
    }
}

/// How far the slices of a direction reach, km; air_rows.h has the same.
double reach_along(double cosine, const Atmosphere& air) {
    const double room = kAirTopKm - kEarthRadiusKm - air.camera_km;
    const double steep = cosine < 0 ? -cosine : cosine;
    const double way = (cosine < 0 ? air.camera_km
                        : room > 0 ? room
                                   : 0) /
                       (steep > 1e-9 ? steep : 1e-9);
    const double held = way < 1e-3 * air.reach_m ? way : 1e-3 * air.reach_m;
    return held > 1e-3 ? held : 1e-3;
}

/// One direction of the air near a camera, slice by slice, from its sources.
void look_along(const Sources& sources, double cosine, std::size_t row, std::size_t column,
                Atmosphere& out) {
    float smooth[3] = {}, haze[3] = {}, left[3] = {1, 1, 1};
    const double reach = reach_along(cosine, out);
    double before = 0;
    for (int slice = 0; slice < kAirSlices; ++slice) {
        const double q = double(slice) / (kAirSlices - 1), rest = 1 - q;
        const double end = reach * (q < 0.5 ? 2 * q * q : 1 - 2 * rest * rest);
        // Long ways are parted where the air changes on them.
        const double rise = (end - before) * (cosine < 0 ? -cosine : cosine);
        const int parts = 1 + int(rise / kLongStepKm < 31 ? rise / kLongStepKm : 31);
        for (int part = 0; part < parts && slice > 0; ++part) {
            const double step = (end - before) / parts;
            const double height = out.camera_km + (before + (part + 0.5) * step) * cosine;
            const double top = kAirTopKm - kEarthRadiusKm;
            if (height >= top) continue;
            const double place = root(height / top) * (kHeights - 1);
            const int low = place < kHeights - 2 ? int(place) : kHeights - 2;
            const float f = float(place - low);
            for (int c = 0; c < 3; ++c) {
                const auto at = [&](const float(&v)[kHeights][3]) {
                    return v[low][c] + (v[low + 1][c] - v[low][c]) * f;
                };
                const float lost = at(sources.lost), depth = lost * float(step);
                const float seen =
                    lost > 1e-12f ? left[c] * one_minus_exp(depth) / lost : left[c] * float(step);
                smooth[c] += seen * at(sources.smooth);
                haze[c] += seen * at(sources.haze);
                left[c] *= exp_(-depth);
            }
        }
        before = end;
        const std::size_t line = std::size_t(slice) * kAirRows + row;
        float* texel = out.near.data() + 8 * (line * kAirColumns + column);
        for (int c = 0; c < 3; ++c) texel[c] = smooth[c], texel[3 + c] = haze[c];
        for (int c = 0; c < 3 && column == 0; ++c) out.left[4 * line + std::size_t(c)] = left[c];
    }
}

}  // namespace

Status light_atmosphere(const AtmosphereSettings& s, const Sun& sun, const Ground& below,
                        double height_m, int threads, Atmosphere& air, Image& map) {
    const double ground = below.present ? below.albedo : s.ground_albedo;
    const Air wanted = make_air(s.turbidity, ground);
    const Air& had = air.tables.air;
    if (!air.present() || wanted.ground != had.ground || wanted.haze_all[0] != had.haze_all[0]) {
        const Status made = make_air_tables(wanted, threads, air.tables);
        // Half of them would be taken for all the next time.
        if (!made) air.tables = AirTables{};
        PILEUS_TRY(made);
    }
    for (int c = 0; c < 3; ++c) air.above[c] = double(sun.irradiance[std::size_t(c)]);
    air.sun_elevation_deg = sun.elevation_deg;
    air.height_km = height_m > 0 ? 1e-3 * height_m : 0;
    air.sunlight = sunlight(air.tables, air.height_km, sincos_deg(air.sun_elevation_deg).sine);
    air.camera_km = -1;
    return paint_map(sun.azimuth_deg, air, threads, map);
}

Status look_from(double height_m, int threads, Atmosphere& air) {
    const double height_km = height_m > 0 ? 1e-3 * height_m : 0;
    if (air.camera_km == height_km) return Status::ok();
    PILEUS_TRY(make_air_sky(air.tables, height_km, sincos_deg(air.sun_elevation_deg).sine, threads,
                            air.sky));
    PILEUS_TRY(air.near.resize(std::size_t{8} * kAirSlices * kAirRows * kAirColumns, "air"));
    PILEUS_TRY(air.left.resize(std::size_t{4} * kAirSlices * kAirRows, "air"));
    air.camera_km = height_km;
    air.reach_m = kAirReachM > 20000 * height_km ? kAirReachM : 20000 * height_km;
    Heights heights;
    fill_heights(air, heights);
    parallel_for(threads, kAirRows, [&](std::int64_t row, int) {
        const double x = 2.0 * double(row) / (kAirRows - 1) - 1;
        const double cosine = x < 0 ? -x * x : x * x;
        Sources sources;
        for (std::size_t column = 0; column < kAirColumns; ++column) {
            const double half = double(column) / (kAirColumns - 1);
            fill_sources(air, heights, cosine, 1 - 2 * half * half, sources);
            look_along(sources, cosine, std::size_t(row), column, air);
        }
    });
    return Status::ok();
}

Status check_camera_in_air(const Scene& scene, const Camera& camera, const Ground& ground) {
    if (!is_above_air(scene.atmosphere, ground, camera)) return Status::ok();
    return at_key(scene, "camera.position_m",
                  Status::bad_input("above the air, over a ground that is level for ever, z " +
                                    number_text(camera.position_m[2]) +
                                    ", allowed: up to 100 km above it, or no [ground]: the round "
                                    "earth shows"));
}

void place_sun(const AtmosphereSettings& s, double hours_later, Sun& sun) {
    if (!s.present || s.date.empty()) return;
    int date[3];
    double hours = 0;
    if (!read_date(s.date, date) || !read_time(s.time, hours)) return;
    const SunPosition at = sun_position(moment_of(date, hours + hours_later, s.utc_offset_h),
                                        s.latitude_deg, s.longitude_deg);
    sun.present = true;
    sun.azimuth_deg = at.azimuth_deg;
    sun.elevation_deg = at.elevation_deg + (s.refraction ? refraction_deg(at.elevation_deg) : 0);
    const double nearer = 1 / (at.distance_au * at.distance_au);
    for (float& e : sun.irradiance) e = float(double(e) * nearer);
}

}  // namespace pileus
