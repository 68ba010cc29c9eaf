// SPDX-License-Identifier: Apache-2.0
// See path_importance.h.
#include "src/methods/path/path_importance.h"

#include <algorithm>
#include <cstring>

#include "kernels_cpu/media/phase.h"
#include "platform/threads.h"
#include "src/base/exponential.h"
#include "src/base/legendre.h"

namespace pileus {
namespace {

/// Mean cosines of lobes about the sun. Sharper ones follow the light more closely and make more
/// noise where they are wrong (measured: docs/importance.md).
constexpr float kLobes[kImportanceLobes] = {0.93f, 0.85f, 0.6f};
/// Of directions, drawn about the sun.
constexpr float kSunShare = 0.25f;
/// Copies of a particle that is worth its pixel's light.
constexpr float kWindows = 1;
/// Pixels are reckoned to have this share of the medium's mean light at least.
constexpr double kMinLevel = 1e-3;

double mean_of(const Double3& c) { return (c.x + c.y + c.z) / 3; }

/// The same light with an irradiance, a radiance of the sky and one of the ground of 1 each.
void set_units(const Lighting& from, bool sky, bool ground, Lighting& out) {
    out = from;
    out.sun_irradiance = Double3{1, 1, 1};
    out.sky = sky ? Double3{1, 1, 1} : Double3{};
    out.ground.diffuse = out.ground.sun = out.ground.lamps = Double3{};
    if (ground) out.ground.diffuse = Double3{1, 1, 1};
}

/// The upper half of a float, rounded to the nearest.
std::uint32_t half_of(float value) {
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    return (bits + 0x8000u) >> 16;
}

/// Optical depths towards the sun as paths read them: two neighbours to a word.
Status pack_depths(const Context& context, const Medium& medium, const Buffer<float>& depths,
                   PathImportance& out) {
    const NodeGrid grid = ordinate_samples(out.nodes.grid, medium);
    PILEUS_TRY(allocate_once(arrays::importance_depths(node_count(grid)), out.sun_depth));
    const std::size_t row = std::size_t(grid.size[0]);
    const bool wraps = medium.grid.periodic;
    parallel_each(context.threads, depths.size(), [&](std::size_t i) {
        const bool last = i % row + 1 == row;
        const std::size_t next = !last ? i + 1 : wraps ? i + 1 - row : i;
        out.sun_depth[i] = std::int32_t((half_of(depths[i]) << 16) | half_of(depths[next]));
    });
    out.params.depth_nodes = grid;
    out.params.sun_depth = out.sun_depth.data();
    return Status::ok();
}

/// Light that comes from a direction goes against it: odd degrees change their sign.
float turned_sign(int moment) { return ordinate_degree(moment) % 2 == 1 ? -1.0f : 1.0f; }

/// Moments of all sets as paths read them, of the ground by what shines on it. Returns what the
/// medium sends in all directions, on the average over what there is of it.
double gather_moments(const Context& context, const Lighting& light, PathImportance& out) {
    const ImportanceParams& k = out.params;
    const std::size_t nodes = std::size_t(node_count(out.nodes.grid));
    const float below = light.ground.present ? float(light.ground.albedo) : 0.0f;
    const float lit_by_sun =
        light.sunlit ? below * std::max(light.to_sun[2], 0.0f) * (4 * kInvFourPi) : 0.0f;
    const float* const from = out.nodes.near.data();
    const auto moment = [&](std::size_t set, int m, std::size_t node) {
        return from[(set * kImportanceMoments + std::size_t(m)) * nodes + node];
    };
    /// What a set counts for the sun and for the sky.
    const auto shares = [&](const OrdinateSet& set, float& sun, float& sky) {
        const bool ground = !(set.beam > 0) && !(set.enters[0] > 0);
        sun = set.beam > 0 ? 1.0f : ground ? lit_by_sun : 0.0f;
        sky = set.beam > 0 ? 0.0f : ground ? below : 1.0f;
    };
    parallel_each(context.threads, nodes, [&](std::size_t i) {
        for (int m = 0; m < kImportanceMoments; ++m) {
            float sun = 0, sky = 0;
            for (std::size_t s = 0; s < out.nodes.sets.size(); ++s) {
                float of_sun, of_sky;
                shares(out.nodes.sets[s], of_sun, of_sky);
                sun += of_sun * moment(s, m, i), sky += of_sky * moment(s, m, i);
            }
            const float sign = turned_sign(m);
            out.moments[i * kImportanceMoments + std::size_t(m)] =
                std::int32_t((half_of(sign * sun) << 16) | half_of(sign * sky));
        }
    });
    double sum = 0, mass = 0;
    for (std::size_t i = 0; i < nodes; ++i) {
        double sent = 0;
        for (std::size_t s = 0; s < out.nodes.sets.size(); ++s) {
            float of_sun, of_sky;
            shares(out.nodes.sets[s], of_sun, of_sky);
            sent += (double(k.sun_worth) * double(of_sun) + double(k.sky_worth) * double(of_sky)) *
                    double(moment(s, 0, i));
        }
        sum += double(out.nodes.density[i]) * sent * 0.28209479177387814;
        mass += double(out.nodes.density[i]);
    }
    return mass > 0 ? double(k.albedo) * sum / mass : 0;
}

void set_phase(const PhaseParams& phase, ImportanceParams& k) {
    for (int l = 0; l < 4; ++l) k.moment[l] = phase_moment(phase, l);
    for (int n = 0; n < kImportanceLobes; ++n) {
        k.lobe_g[n] = kLobes[n];
        k.turned_g[n] = kLobes[n] * phase.g1;
    }
    k.sun_g = std::max(phase.g1, 0.0f);
}

}  // namespace

void fit_lobes(const PhaseParams& phase, double albedo, float peak_turn,
               const float (&g)[kImportanceLobes], float* out) {
    constexpr int kAngles = 512;
    constexpr double kFourPi = 12.566370614359172954;
    const std::vector<double> moments = peak_moments(phase, peak_turn);
    const std::size_t degrees = moments.size();
    std::vector<double> values(std::size_t(kAngles + 1) * degrees), area(kAngles + 1);
    std::vector<double> lobe(std::size_t(kAngles + 1) * kImportanceLobes);
    const auto turn_at = [](int i) { return turn_at_share(double(i) / kAngles); };
    for (int i = 0; i <= kAngles; ++i) {
        const double x = turn_at(i);
        area[std::size_t(i)] =
            0.5 * (turn_at(std::min(i + 1, kAngles)) - turn_at(std::max(i - 1, 0)));
        legendre(1 - x, int(degrees), [&](std::size_t l, double value) {
            values[std::size_t(i) * degrees + l] = (2 * double(l) + 1) / kFourPi * value;
        });
        for (int n = 0; n < kImportanceLobes; ++n)
            lobe[std::size_t(i * kImportanceLobes + n)] = double(hg_density(g[n], float(x)));
    }
    for (int d = 0; d < kImportanceDepths; ++d) {
        const double part = (d + 0.5) / double(kImportanceDepths);
        const double tau = double(kBeamDepth) * part / (1 - part);
        std::vector<double> weight(degrees);
        for (std::size_t l = 0; l < degrees; ++l)
            weight[l] = exponential(-tau * (1 - albedo * moments[l])) - exponential(-tau);
        // Least squares, by normal equations.
        double a[kImportanceLobes][kImportanceLobes + 1] = {};
        for (int i = 0; i <= kAngles; ++i) {
            double light = 0;
            for (std::size_t l = 0; l < degrees; ++l)
                light += weight[l] * values[std::size_t(i) * degrees + l];
            const double counts = area[std::size_t(i)] / (0.05 + std::max(light, 0.0));
            const double* own = lobe.data() + i * kImportanceLobes;
            for (int r = 0; r < kImportanceLobes; ++r) {
                for (int c = 0; c < kImportanceLobes; ++c) a[r][c] += counts * own[r] * own[c];
                a[r][kImportanceLobes] += counts * own[r] * light;
            }
        }
        for (int p = 0; p < kImportanceLobes; ++p)
            for (int r = 0; r < kImportanceLobes; ++r) {
                if (r == p) continue;
                const double by = a[r][p] / a[p][p];
                for (int c = p; c <= kImportanceLobes; ++c) a[r][c] -= by * a[p][c];
            }
        for (int n = 0; n < kImportanceLobes; ++n)
            out[d * kImportanceLobes + n] = float(a[n][kImportanceLobes] / a[n][n]);
    }
}

Status make_importance(const Context& asked, const FrameView& view, const Majorants& majorants,
                       PathImportance& out) {
    const Medium& medium = view.world.medium;
    const Lighting& light = view.lighting;
    ImportanceParams& k = out.params;
    const double sun = light.sunlit ? mean_of(light.sun_irradiance) : 0, sky = mean_of(light.sky);
    const std::array<double, 3> shine{sun, sky, light.ground.present ? light.ground.albedo : -1};
    if (out.made && out.to_sun == light.to_sun && out.shine == shine) return Status::ok();
    out.made = false;
    // All of it runs on the host, also where a device traces.
    Context context = asked;
    context.kernels = &host_kernels(asked.kernels);
    if (out.nodes.density.empty())
        PILEUS_TRY(prepare_ordinates(context, medium, majorants, {}, false, out.nodes));
    k.albedo = medium.optics[0].albedo[0];
    k.sky_whole = !(sky > 0) || (is_white(medium) && !light.ground.present) ? 1 : 0;
    k.sets = k.sky_whole != 0 ? 1 : 2;
    k.sun_worth = float(sun), k.sky_worth = float(sky);
    set_phase(medium.optics[0].phase, k);

    Lighting units;
    set_units(light, k.sets > 1, light.ground.present && light.ground.albedo > 0, units);
    Buffer<float> depths;
    OrdinateAsk ask;
    ask.depths = &depths;
    PILEUS_TRY(make_ordinates(context, medium, majorants, units, ask, out.nodes));
    // All moments on all nodes, as a camera within the medium has them.
    CameraParams within{};
    for (int a = 0; a < 3; ++a) within.origin[a] = float(0.5 * medium.extent_m[a]);
    PILEUS_TRY(turn_ordinates(context, medium, within, false, out.nodes));
    PILEUS_TRY(allocate_once(arrays::importance_moments(node_count(out.nodes.grid)), out.moments));
    const double mean_light = gather_moments(context, light, out);
    k.nodes = out.nodes.grid;
    k.moments = out.moments.data();
    k.rest = out.nodes.optics[0][0].rest;
    k.peak_turn = ordinate_peak();
    k.beam = out.nodes.peak.tables.data();
    k.sun_depth = nullptr;
    k.sun_share = 0;
    if (light.sunlit && sun > 0) {
        PILEUS_TRY(pack_depths(context, medium, depths, out));
        PILEUS_TRY(allocate_once(arrays::importance_lobes(), out.lobes));
        fit_lobes(medium.optics[0].phase, double(k.albedo), k.peak_turn, k.lobe_g,
                  out.lobes.data());
        k.sun_share = kSunShare;
    }
    k.lobes = out.lobes.data();
    k.level = float(std::max(kMinLevel * (mean_light + sky), 1e-30));
    k.windows = kWindows;
    out.to_sun = light.to_sun;
    out.shine = shine;
    out.made = true;
    return Status::ok();
}

}  // namespace pileus
