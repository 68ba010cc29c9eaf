// SPDX-License-Identifier: Apache-2.0
// Directions of discrete ordinates, their ways through nodes, and what enters along them.
// in: nodes, lights -> out: OrdinateSweep, OrdinateSet.
// docs/ordinates.md, "Directions"
#include "kernels_cpu/core/math.h"
#include "kernels_cpu/core/sh.h"
#include "kernels_cpu/light/sky_map.h"
#include "src/base/angles.h"
#include "src/picture/ordinates/ordinates.h"
#include "src/world/solids/solids.h"

namespace pileus {
namespace {

constexpr double kSphere = 4 * kPi64;
/// Gauss's two points on [0, 1], of equal weight.
constexpr double kHeight[2] = {0.21132486540518711775, 0.78867513459481288225};
constexpr int kAzimuths = 8;
constexpr int kWithin = 8;  // radiances of a map are means of so many squared

struct Height {
    bool up;
    int number;
};
Height height_of(int j) {
    const int h = j / kAzimuths;
    return {h >= 2, h % 2};
}

/// Where light of a direction comes from: the map's mean over its part of the sphere.
std::array<double, 3> seen_in_map(const SkyMapView& map, int j) {
    std::array<double, 3> sum{};
    for (int i = 0; i < kWithin; ++i)
        for (int a = 0; a < kWithin; ++a) {
            const std::array<double, 3> way =
                ordinate_part(j, (i + 0.5) / kWithin, (a + 0.5) / kWithin);
            // Against the way of light.
            const Vec<float> seen =
                map_radiance(map, Vec<float>{float(-way[0]), float(-way[1]), float(-way[2])});
            sum[0] += double(seen.x), sum[1] += double(seen.y), sum[2] += double(seen.z);
        }
    for (double& s : sum) s /= kWithin * kWithin;
    return sum;
}

bool any_light(const Double3& c) { return c.x > 0 || c.y > 0 || c.z > 0; }

}  // namespace

std::array<double, 3> ordinate_direction(int j) {
    const Height h = height_of(j);
    const double z = kHeight[h.number], r = __builtin_sqrt(1 - z * z);
    const SineCosine at = sincos_deg(360.0 / kAzimuths * (j % kAzimuths + 0.5));
    return {r * at.cosine, r * at.sine, h.up ? z : -z};
}

double ordinate_weight(int) { return kSphere / kOrdinates; }

bool goes_up(int j) { return height_of(j).up; }

std::array<double, 3> ordinate_part(int j, double height, double azimuth) {
    const Height h = height_of(j);
    const double z = 0.5 * (h.number + height), r = __builtin_sqrt(1 - z * z);
    const SineCosine at = sincos_deg(360.0 / kAzimuths * (j % kAzimuths + azimuth));
    return {r * at.cosine, r * at.sine, h.up ? z : -z};
}

void set_ordinate_harmonics(float (&out)[kOrdinates][kOrdinateMoments]) {
    for (int j = 0; j < kOrdinates; ++j) {
        const std::array<double, 3> d = ordinate_direction(j);
        sh_eval<4>(float(d[0]), float(d[1]), float(d[2]), out[j]);
    }
}

void scatter_moments(const float (&moments)[kOrdinateMoments], const float (&kept)[4],
                     const float (&harmonic)[kOrdinates][kOrdinateMoments], float whole,
                     float (&out)[kOrdinates]) {
    float sum = 0;
    for (int j = 0; j < kOrdinates; ++j) {
        float value = 0;
        for (int m = 0; m < kOrdinateMoments; ++m)
            value += kept[ordinate_degree(m)] * harmonic[j][m] * moments[m];
        out[j] = value > 0 ? value : 0;
        sum += out[j] * float(ordinate_weight(j));
    }
    for (float& value : out) value *= sum > 0 ? whole / sum : 0.0f;
}

void set_ordinate_sweeps(const NodeGrid& grid, bool periodic, OrdinateWay (&way)[kOrdinateClasses],
                         OrdinatesParams& k) {
    int classes = 0;
    for (int j = 0; j < kOrdinates; ++j) {
        const std::array<double, 3> d = ordinate_direction(j);
        OrdinateSweep& s = k.sweep[j];
        double step[3];  // nodes that the direction crosses in a metre, along each axis
        for (std::size_t a = 0; a < 3; ++a)
            step[a] = (d[a] < 0 ? -d[a] : d[a]) * double(grid.per_metre[a]);
        s.axis = 2;
        for (int a = 0; a < 2 && !periodic; ++a)
            if (step[a] > step[s.axis]) s.axis = a;
        s.along = s.axis == 0 ? 1 : 0;
        s.across = s.axis == 2 ? 1 : 2;
        s.up = d[std::size_t(s.axis)] > 0 ? 1 : 0;
        double share[2];
        for (int i = 0; i < 2; ++i) {
            const int a = i == 0 ? s.along : s.across;
            double back = step[a] / step[s.axis];
            if (d[std::size_t(a)] > 0) back = -back;
            // Copies of a periodic medium are alike.
            const int n = k.size[a];
            if (periodic) {
                back -= double(std::int64_t(back / n)) * n;
                if (back < 0) back += n;
            }
            int whole = int(back + 2) - 2;
            if (periodic && whole >= n) whole = n - 1;
            if (!periodic && whole > 0) whole = 0;
            s.base[i] = whole;
            share[i] = back - whole;
        }
        for (int y = 0; y < 2; ++y)
            for (int x = 0; x < 2; ++x)
                s.weight[y][x] =
                    float((x == 1 ? share[0] : 1 - share[0]) * (y == 1 ? share[1] : 1 - share[1]));
        const double length = 1 / step[s.axis];
        s.length = -1;
        for (int c = 0; c < classes; ++c) {
            const double off = way[c].length_m / length - 1;
            if (off < 1e-6 && off > -1e-6 && way[c].along_x == (s.axis == 0)) s.length = c;
        }
        if (s.length >= 0) continue;
        s.length = classes;
        way[classes++] = {length, s.axis == 0};
    }
    for (; classes < kOrdinateClasses; ++classes) way[classes] = {};
}

namespace {

/// Whether the ground has sets of its own: where light on it is wanted, its radiance is told by
/// theirs.
bool ground_apart(const Lighting& light, bool ground) {
    return ground && light.ground.present && light.ground.albedo > 0;
}

}  // namespace

int light_channels(const Medium& medium, const Lighting& light, bool walls) {
    const bool coloured = walls && light.solids != nullptr && light.solids->coloured();
    return coloured ? 3 : medium.channels;
}

int ordinate_sets(const Medium& medium, const Lighting& light, bool ground, int channels) {
    const bool apart = ground_apart(light, ground);
    if (light.map.columns > 0 || channels > 1) return 3 + (apart ? 2 * channels : 0);
    return int(light.sunlit) + int(any_light(light.sky)) +
           (apart ? 2 : int(light.ground.present && any_light(light.ground.radiance()))) +
           (!light.lamps.empty() || emits(medium) ? 3 : 0);
}

namespace {

/// Whether all lamps have one colour; theirs, so that its largest part is 1.
bool one_colour(const OrdinateAsk& ask, Double3& colour) {
    bool one = true, first = true;
    each_lamp(ask, [&](std::size_t l) {
        const LampParams& lamp = ask.lamps->lamps[l];
        if (!(lamp.strength > 0)) return;
        for (std::size_t c = 0; c < 3; ++c) {
            const double part = double(lamp.light[c]) / double(lamp.strength);
            one = one && (first || (part <= colour[c] + 1e-6 && part >= colour[c] - 1e-6));
            colour[c] = part;
        }
        first = false;
    });
    return one && !ask.emission;
}

/// Light that begins at lamps and in media.
void add_own_lights(const OrdinateAsk& ask, std::vector<OrdinateSet>& out) {
    if (ask.lamp_count == 0 && !ask.emission) return;
    Double3 colour{};
    OrdinateSet set;
    if (one_colour(ask, colour)) {
        for (std::size_t c = 0; c < 3; ++c) set.colour[c] = float(colour[c]);
        set.own = kLampStrength;
        out.push_back(set);
        return;
    }
    for (int c = 0; c < 3; ++c) {
        set.colour = {};
        set.colour[std::size_t(c)] = 1;
        set.own = 1 + c;
        out.push_back(set);
    }
}

}  // namespace

void set_ordinate_lights(const Medium& medium, const Lighting& light, const OrdinateAsk& ask,
                         bool walls, std::vector<OrdinateSet>& out) {
    out.clear();
    const Double3 ground = light.ground.radiance();
    const Double3 sun = light.sunlit ? light.sun_irradiance : Double3{};
    const int channels = light_channels(medium, light, walls);
    const bool map = light.map.columns > 0, apart = ground_apart(light, ask.ground);
    const auto add_ground = [&](int channel, OrdinateFaces faces) {
        OrdinateSet set;
        for (std::size_t c = 0; c < 3; ++c)
            if (channels == 1 || int(c) == channel) set.colour[c] = float(ground[c]);
        for (int j = 0; j < kOrdinates; ++j) set.enters[std::size_t(j)] = goes_up(j) ? 1 : 0;
        set.channel = channel;
        set.faces = faces;
        set.ground = true;
        out.push_back(set);
    };
    const auto add_grounds = [&](int channel) {
        add_ground(channel, OrdinateFaces::kLower);
        add_ground(channel, OrdinateFaces::kSides);
    };
    if (map || channels > 1) {
        std::array<std::array<double, 3>, kOrdinates> enters{};
        for (int j = 0; j < kOrdinates; ++j) {
            const bool down = light.ground.present && goes_up(j);
            if (map && !down) enters[std::size_t(j)] = seen_in_map(light.map, j);
            for (std::size_t c = 0; c < 3 && (down || !map); ++c)
                enters[std::size_t(j)][c] = !down ? light.sky[c] : apart ? 0 : ground[c];
        }
        for (std::size_t c = 0; c < 3; ++c) {
            OrdinateSet set;
            set.colour[c] = 1;
            set.channel = int(c);
            set.beam = float(sun[c]);
            if (ask.lamp_count > 0 || ask.emission) set.own = 1 + int(c);
            for (std::size_t j = 0; j < kOrdinates; ++j) set.enters[j] = float(enters[j][c]);
            out.push_back(set);
        }
        for (int c = 0; c < channels && apart; ++c) add_grounds(c);
        return;
    }
    const auto add = [&](const Double3& colour, float beam, float from_sky, float from_below) {
        OrdinateSet set;
        for (std::size_t c = 0; c < 3; ++c) set.colour[c] = float(colour[c]);
        set.beam = beam;
        for (int j = 0; j < kOrdinates; ++j)
            set.enters[std::size_t(j)] = goes_up(j) ? from_below : from_sky;
        out.push_back(set);
    };
    if (light.sunlit) add(light.sun_irradiance, 1, 0, 0);
    if (any_light(light.sky)) add(light.sky, 0, 1, light.ground.present ? 0 : 1);
    if (apart)
        add_grounds(0);
    else if (light.ground.present && any_light(ground))
        add_ground(0, OrdinateFaces::kAll);
    add_own_lights(ask, out);
}

}  // namespace pileus
