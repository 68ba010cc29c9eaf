// SPDX-License-Identifier: Apache-2.0
// See atmosphere.h.
#include "src/world/atmosphere/atmosphere.h"

#include "kernels_cpu/core/math.h"
#include "platform/threads.h"
#include "src/base/angles.h"
#include "src/base/number_text.h"
#include "src/scene/frame_fault.h"
#include "src/scene/read_scene.h"
#include "src/scene/toml/toml_tree.h"
#include "src/world/atmosphere/air_column.h"
#include "src/world/atmosphere/night_light.h"

namespace pileus {
namespace {

constexpr int kMapRows = 128, kMapColumns = 256;

double root(double v) { return v > 0 ? __builtin_sqrt(v) : 0; }

/// The sky from the media as one light makes it, each texel in its middle.
Status add_to_map(const FarLight& by, const Atmosphere& air, int threads, Image& map) {
    AirSky view;
    const double sine = sincos_deg(by.elevation_deg).sine;
    PILEUS_TRY(make_air_sky(air.tables, air.height_km, sine, threads, view));
    const Double3 to_sun = towards_deg(by.azimuth_deg, by.elevation_deg);
    for (int row = 0; row < kMapRows; ++row) {
        const SineCosine zenith = sincos_deg((row + 0.5) * 180.0 / kMapRows);
        for (int i = 0; i < kMapColumns; ++i) {
            const SineCosine turn = sincos_deg((i + 0.5) * 360.0 / kMapColumns - 180.0);
            const double along = zenith.sine * turn.sine * to_sun[0] +
                                 zenith.sine * turn.cosine * to_sun[1] + zenith.cosine * to_sun[2];
            float light[3];
            sky_radiance(view, zenith.cosine, along, light);
            for (std::size_t c = 0; c < 3; ++c)
                map.channels[c].pixels[std::size_t(row * kMapColumns + i)] +=
                    light[c] * float(by.above[int(c)]);
        }
    }
    return Status::ok();
}

/// The light behind the air, as it comes through it: of stars their mean.
void add_glow_to_map(const Atmosphere& air, Image& map) {
    if (air.glow == Double3{} && !air.stars.present()) return;
    const Double3 even = air.stars.present() ? air.stars.even * air.sun().above : Double3{};
    for (int row = 0; row < kMapRows; ++row) {
        const double up = sincos_deg((row + 0.5) * 180.0 / kMapRows).cosine;
        const std::array<double, 3> light = glow_at(air.tables, air.height_km, up),
                                    left = wide_left(air.tables, air.height_km, up);
        for (std::size_t c = 0; c < 3; ++c)
            for (int i = 0; i < kMapColumns; ++i)
                map.channels[c].pixels[std::size_t(row * kMapColumns + i)] +=
                    float(light[c] * air.glow[int(c)] + left[c] * even[int(c)]);
    }
}

Status paint_map(const Atmosphere& air, int threads, Image& map) {
    map.width = kMapColumns;
    map.height = kMapRows;
    map.channels.clear();
    for (const char* name : {"R", "G", "B"}) {
        map.channels.push_back({name, {}});
        PILEUS_TRY(map.channels.back().pixels.resize(kMapRows * kMapColumns, "atmosphere"));
        for (float& v : map.channels.back().pixels.span()) v = 0;
    }
    PILEUS_TRY(add_to_map(air, air, threads, map));
    if (air.two_skies) PILEUS_TRY(add_to_map(air.other, air, threads, map));
    add_glow_to_map(air, map);
    return Status::ok();
}

/// What the sun's light has met at each height; where it is hidden, as much as leaves nothing.
Status fill_sun_depth(double sine, Atmosphere& air) {
    constexpr float kDark = 85, kLeast = 1e-36f;
    PILEUS_TRY(air.sun_depth.resize(std::size_t{3} * kSunRows, "air"));
    for (int i = 0; i < kSunRows; ++i) {
        float share[3];
        sunlight_at(air.tables, kEarthRadiusKm + 1e-3 * kSunRowM * i, sine, share);
        for (int c = 0; c < 3; ++c)
            air.sun_depth[std::size_t(c * kSunRows + i)] =
                share[c] > kLeast ? -log_(share[c]) : kDark;
    }
    return Status::ok();
}

constexpr int kHeights = 65;
constexpr double kLongStepKm = 2;

double height_of(int i) {
    const double x = double(i) / (kHeights - 1);
    return (kAirTopKm - kEarthRadiusKm) * x * x;
}

/// Sunlight at every height, whatever the direction.
struct Heights {
    float sunlight[kHeights][3];
    float sun;
};

/// Light along one direction by height: what air and haze send of it towards the camera per
/// scattering, and the sun's for haze.
struct Sources {
    float by_air[kHeights][3], by_haze[kHeights][3], sun[kHeights][3];
};

void fill_heights(const Atmosphere& air, const FarLight& by, Heights& out) {
    out.sun = by.sky.sun;
    for (int i = 0; i < kHeights; ++i)
        sunlight_at(air.tables, kEarthRadiusKm + height_of(i), double(out.sun), out.sunlight[i]);
}

void fill_sources(const Atmosphere& air, const Heights& at, double cosine, double east,
                  Sources& out) {
    const double sun = double(at.sun);
    const double along = cosine * sun + root((1 - cosine * cosine) * (1 - sun * sun)) * east;
    const float phase = air_phase(float(along));
    float y[kAirTerms];
    air_harmonics(cosine, east, y);
    for (int i = 0; i < kHeights; ++i) {
        scattered_at(air.tables, float(height_of(i)), at.sun, y, out.by_air[i], out.by_haze[i]);
        for (int c = 0; c < 3; ++c) {
            out.by_air[i][c] += phase * at.sunlight[i][c];
            out.sun[i][c] = at.sunlight[i][c];
        }
    }
}

/// Of level air between two heights, `way` km long.
AirPiece level_piece(const Air& air, double from, double to, double way) {
    const LevelAir<float> mean = level_air(float(from), float(to));
    return piece_of(air,
                    {double(mean.air) * way, double(mean.haze) * way, double(mean.ozone) * way});
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

/// Light that pieces send the camera, added up.
struct Sent {
    float smooth[3] = {}, haze[3] = {}, left[3] = {1, 1, 1};
};
void add_piece(const Air& air, const Sources& sources, double from, double to, double way,
               Sent& sent) {
    const double top = kAirTopKm - kEarthRadiusKm, height = 0.5 * (from + to);
    const double share = height < 0 ? 0 : height < top ? height / top : 1;
    const double place = root(share) * (kHeights - 1);
    const int low = place < kHeights - 2 ? int(place) : kHeights - 2;
    const float f = float(place - low);
    const AirPiece piece = level_piece(air, from, to, way);
    for (int c = 0; c < 3; ++c) {
        const auto at = [&](const float(&v)[kHeights][3]) {
            return v[low][c] + (v[low + 1][c] - v[low][c]) * f;
        };
        sent.smooth[c] += sent.left[c] * (piece.by_air[c] * at(sources.by_air) +
                                          piece.by_haze[c] * at(sources.by_haze));
        sent.haze[c] += sent.left[c] * piece.by_haze[c] * at(sources.sun);
        sent.left[c] *= piece.left[c];
    }
}

/// One direction of the air near a camera, slice by slice, from its sources: light over the share
/// that the air takes of what lies behind, which hardly changes from slice to slice.
void look_along(const Sources& sources, double cosine, std::size_t row, std::size_t column,
                const Atmosphere& out, float* near) {
    const Air& air = out.tables.air;
    const double reach = reach_along(cosine, out);
    // No shorter way is looked at, and the light over the share has a limit.
    constexpr double kFirstKm = 1e-3;
    Sent sent;
    double before = 0;
    for (int slice = 0; slice < kAirSlices; ++slice) {
        const double q = double(slice) / (kAirSlices - 1), rest = 1 - q;
        const double even = reach * (q < 0.5 ? 2 * q * q : 1 - 2 * rest * rest);
        const double end = even > kFirstKm ? even : kFirstKm;
        // Long ways are parted where the air changes on them.
        const double rise = (end - before) * (cosine < 0 ? -cosine : cosine);
        const int parts = 1 + int(rise / kLongStepKm < 31 ? rise / kLongStepKm : 31);
        for (int part = 0; part < parts && end > before; ++part) {
            const double step = (end - before) / parts, from = before + part * step;
            add_piece(air, sources, out.camera_km + from * cosine,
                      out.camera_km + (from + step) * cosine, step, sent);
        }
        before = end;
        const AirPiece whole = level_piece(air, out.camera_km, out.camera_km + end * cosine, end);
        const std::size_t line = std::size_t(slice) * kAirRows + row;
        float* texel = near + 8 * (line * kAirColumns + column);
        for (int c = 0; c < 3; ++c) {
            const float taken = one_minus_exp(whole.depth[c]);
            texel[c] = taken > 0 ? sent.smooth[c] / taken : 0;
            texel[3 + c] = taken > 0 ? sent.haze[c] / taken : 0;
        }
    }
    // Where no air is for long, what lies between is lit as the first that is.
    for (int slice = kAirSlices - 2; slice >= 0; --slice) {
        const std::size_t line = std::size_t(slice) * kAirRows + row;
        float* texel = near + 8 * (line * kAirColumns + column);
        const float* next = texel + 8 * kAirRows * kAirColumns;
        for (int c = 0; c < 6; ++c)
            if (texel[c] == 0) texel[c] = next[c];
    }
}

/// The sky and the air as one light makes them, from the height that `air` looks from.
Status look_by(FarLight& by, const Atmosphere& air, int threads) {
    PILEUS_TRY(make_air_sky(air.tables, air.camera_km, sincos_deg(by.elevation_deg).sine, threads,
                            by.sky));
    PILEUS_TRY(by.near.resize(std::size_t{8} * kAirSlices * kAirRows * kAirColumns, "air"));
    Heights heights;
    fill_heights(air, by, heights);
    parallel_for(threads, kAirRows, [&](std::int64_t row, int) {
        const double x = 2.0 * double(row) / (kAirRows - 1) - 1;
        const double cosine = x < 0 ? -x * x : x * x;
        Sources sources;
        for (std::size_t column = 0; column < kAirColumns; ++column) {
            const double half = double(column) / (kAirColumns - 1);
            fill_sources(air, heights, cosine, 1 - 2 * half * half, sources);
            look_along(sources, cosine, std::size_t(row), column, air, by.near.data());
        }
    });
    return Status::ok();
}

}  // namespace

Status light_atmosphere(const AtmosphereSettings& s, const Sun& sun, const Ground& below,
                        double height_m, int threads, Atmosphere& air, Image& map,
                        const Night& night) {
    const double ground = below.present ? below.albedo : s.ground_albedo;
    const Air wanted = make_air(s.turbidity, ground);
    const Air& had = air.tables.air;
    if (!air.present() || wanted.ground != had.ground || wanted.haze_all[0] != had.haze_all[0]) {
        const Status made = make_air_tables(wanted, threads, air.tables);
        // Half of them would be taken for all the next time.
        if (!made) air.tables = AirTables{};
        PILEUS_TRY(made);
    }
    air.height_km = height_m > 0 ? 1e-3 * height_m : 0;
    PILEUS_TRY(turn_stars(night, air.stars));
    choose_light(s, sun, night, below.present, air);
    air.sunlight = sunlight(air.tables, air.height_km, sincos_deg(air.elevation_deg).sine);
    air.camera_km = -1;
    PILEUS_TRY(fill_sun_depth(sincos_deg(air.elevation_deg).sine, air));
    return paint_map(air, threads, map);
}

Status look_from(double height_m, int threads, Atmosphere& air) {
    const double height_km = height_m > 0 ? 1e-3 * height_m : 0;
    if (air.camera_km == height_km) return Status::ok();
    // Half of it would be taken for all the next time.
    air.camera_km = height_km;
    air.reach_m = kAirReachM > 20000 * height_km ? kAirReachM : 20000 * height_km;
    Status made = look_by(air, air, threads);
    if (made && air.two_skies) made = look_by(air.other, air, threads);
    if (!made) air.camera_km = -1;
    return made;
}

Status check_camera_in_air(const Scene& scene, const Camera& camera, const Ground& ground) {
    if (!is_above_air(scene.atmosphere, ground, camera)) return Status::ok();
    return at_key(scene, "camera.position_m",
                  Status::bad_input("above the air, over a ground that is level for ever, z " +
                                    number_text(camera.position_m[2]) +
                                    ", allowed: up to 100 km above it, or no [ground]: the round "
                                    "earth shows"));
}

}  // namespace pileus
