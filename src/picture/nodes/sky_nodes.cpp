// SPDX-License-Identifier: Apache-2.0
// See sky_nodes.h.
// in: a medium and what shines on it from all around -> out: what of it reaches each node.
// docs/raymarch.md, "Skylight".
#include "src/picture/nodes/sky_nodes.h"

#include <algorithm>

#include "kernels_cpu/core/math.h"
#include "kernels_cpu/light/sky_map.h"
#include "platform/threads.h"
#include "src/picture/march_view.h"
#include "src/picture/nodes/node_grid.h"
#include "src/run/device_launch.h"
#include "src/run/on_device.h"
#include "src/world/phase/forward_share.h"

namespace pileus {
namespace {

constexpr double kNodeBudget = 1u << 15;
constexpr int kParts = kSkyParts;
constexpr int kWithin = 16;  // radiances of a map are means of so many squared per part

/// The lower half of the sphere, where there is ground.
bool looks_down(int part) { return part < kParts / 2; }

/// Light of each set from a part of the sphere: shares of a whole sphere of its colour, none larger
/// than the part itself, so that no node has more of it than 1.
struct Radiances {
    double share[3][kParts] = {};
    double colour[3][3] = {};
};

void set_constant(const Lighting& light, Radiances& r) {
    for (int p = 0; p < kParts; ++p) {
        const bool down = light.ground.present && looks_down(p);
        r.share[down ? 1 : 0][p] = 1.0 / kParts;
    }
    const Double3 ground = light.ground.radiance();
    for (std::size_t c = 0; c < 3; ++c) {
        r.colour[0][c] = light.sky[c];
        r.colour[1][c] = ground[c];
    }
}

void set_map(const Lighting& light, Radiances& r) {
    const Double3 ground = light.ground.radiance();
    for (int p = 0; p < kParts; ++p) {
        const bool down = light.ground.present && looks_down(p);
        double sum[3] = {};
        for (int i = 0; i < kWithin * kWithin && !down; ++i) {
            const std::array<float, 3> d =
                sky_direction(p, (i / kWithin + 0.5) / kWithin, (i % kWithin + 0.5) / kWithin);
            const Vec<float> seen = map_radiance(light.map, Vec<float>{d[0], d[1], d[2]});
            const float own[3] = {seen.x, seen.y, seen.z};
            for (int c = 0; c < 3; ++c) sum[c] += double(own[c]) / (kWithin * kWithin);
        }
        for (std::size_t c = 0; c < 3; ++c) {
            r.share[c][p] = down ? ground[c] : sum[c];
            r.colour[c][c] = std::max(r.colour[c][c], r.share[c][p]);
        }
    }
    for (int c = 0; c < 3; ++c)
        for (double& share : r.share[c])
            share = r.colour[c][c] > 0 ? share / (r.colour[c][c] * kParts) : 0;
}

/// Means over all media and channels.
struct Absorption {
    float albedo = 1, least = 0;  ///< least: share of the extinction by which light fades
};

Absorption absorption_of(const Medium& medium) {
    Absorption mean{0, 0};
    const float share = 1.0f / (3.0f * float(medium.count > 0 ? medium.count : 1));
    for (int i = 0; i < medium.count; ++i) {
        const Optics& optics = medium.optics[std::size_t(i)];
        for (float albedo : optics.albedo) {
            mean.albedo += share * albedo;
            mean.least += share * diffusion_exponent(optics.phase, albedo);
        }
    }
    // Thirds need not add up to one: where nothing is absorbed all light is kept.
    if (!(mean.least > 0)) mean.albedo = 1;
    return mean;
}

/// Depths of the ways from one node, [part] `apart` numbers apart, become what it sees of each
/// part. What comes straight through is e^-tau. With octaves, the rest of the sphere shows the
/// medium, and that the light of all parts, as much of each as the copies after the first let
/// through: where nothing is absorbed all light came from somewhere, so that what is seen adds up
/// to one.
void see_parts(const Octaves& o, float left, const Absorption& by, std::size_t apart,
               float* parts) {
    float straight = 0, all = 0, turned[kParts];
    for (int p = 0; p < kParts; ++p) {
        const float tau = parts[std::size_t(p) * apart] * left;
        float share = 1, kept = 1, thinner = 1, white = 0;
        turned[p] = 0;
        for (int n = 1; n < o.count; ++n) {
            share *= o.share, kept *= o.share * by.albedo, thinner *= o.extinction;
            const float through = exp_(-(tau * thinner));
            white += share * through;
            turned[p] += kept * (thinner < by.least ? exp_(-(tau * by.least)) : through);
        }
        const float seen = exp_(-tau);
        parts[std::size_t(p) * apart] = seen;
        straight += seen;
        all += white;
    }
    // So thick that no copy comes through: every part alike.
    const float rest = 1 - straight * (1.0f / kParts);
    for (int p = 0; p < kParts && o.count > 1 && rest > 0; ++p) {
        const float share = all > 1e-30f ? turned[p] * kParts / all : (by.albedo < 1 ? 0.0f : 1.0f);
        parts[std::size_t(p) * apart] += rest * share;
    }
}

/// Three mean cosines of an octave's phase function over all media, at most 1, so that none of its
/// first two bands is negative.
struct Turns {
    float most[kMaxOctaves] = {};
    float albedo = 1;  ///< what an octave keeps of the one before
};

Turns turns_of(const Medium& medium, const Octaves& o, const SkyView& view, const Absorption& by) {
    float g = mean_cosine(medium);
    Turns t;
    // An octave that is turned so much more than the one before was scattered so much more often.
    t.albedo = by.albedo;
    if (g > view.anisotropy && view.anisotropy > 0 && g < 1 && by.albedo > 0)
        t.albedo = exp_(log_(by.albedo) * (log_(view.anisotropy) / log_(g)));
    for (int n = 1; n < o.count; ++n) {
        g *= view.anisotropy;
        t.most[n] = 3 * g > 1 ? 1 : 3 * g < -1 ? -1 : 3 * g;
    }
    return t;
}

/// As see_parts for one who looks from a camera, which weighs the parts when it is known where:
/// sky_seen_numbers instead of what is seen.
void see_octaves(const Octaves& o, const Turns& turns, float left, const Absorption& by,
                 const SkyDirections& middles, std::size_t apart, float* numbers) {
    float all[4] = {};
    for (int p = 0; p < kParts; ++p) {
        const std::array<float, 3>& d = middles[std::size_t(p)];
        const float tau = numbers[std::size_t(p) * apart] * left;
        float share = 1, kept = 1, thinner = 1, alike = 0, turned = 0;
        for (int n = 1; n < o.count; ++n) {
            share *= o.share, kept *= o.share * turns.albedo, thinner *= o.extinction;
            const float through = exp_(-(tau * thinner)), white = share * through;
            const float comes = kept * (thinner < by.least ? exp_(-(tau * by.least)) : through);
            alike += comes;
            turned += turns.most[n] * comes;
            all[0] += white;
            for (std::size_t a = 0; a < 3; ++a) all[1 + a] += turns.most[n] * white * d[a];
        }
        numbers[std::size_t(p) * apart] = exp_(-tau);
        numbers[std::size_t(kParts + p) * apart] = alike;
        numbers[std::size_t(2 * kParts + p) * apart] = turned;
    }
    const bool thick = !(all[0] > 1e-30f);
    for (std::size_t p = 0; p < 2 * kParts && thick; ++p)
        numbers[(kParts + p) * apart] = p < kParts && !(by.albedo < 1) ? 1 : 0;
    for (std::size_t a = 0; a < 4; ++a)
        numbers[(3 * kParts + a) * apart] = !thick ? all[a] : a == 0 ? float(kParts) : 0.0f;
}

/// What each node sees of each part of the sphere, by a ray to its middle.
Status see_sky(const Context& context, const Medium& medium, const Majorants& majorants,
               double kept, const Octaves& octaves, const SkyView& view, SkyNodes& out) {
    const std::size_t nodes = std::size_t(node_count(out.grid));
    const int numbers = sky_seen_numbers(view.turned, octaves.count);
    if (out.seen.size() == std::size_t(numbers) * nodes) return Status::ok();
    PILEUS_TRY(allocate_once(arrays::sky_seen(nodes, numbers), out.seen));
    if (view.turned) out.phase = sky_phase(medium);
    ShadowParams k{};
    k.medium = make_medium_view(medium, majorants);
    // Coarse nodes see what detail keeps: the mean.
    k.medium.detail = nullptr;
    k.medium.step = smallest_cell(medium.grid);
    k.nodes = out.grid;
    const float left = float(1 - kept);
    const Absorption absorption = absorption_of(medium);
    const Turns turns = turns_of(medium, octaves, view, absorption);
    const SkyDirections middles = sky_directions();
    const std::size_t slice = nodes / std::size_t(out.grid.size[2]);
    for (int p = 0; p < kParts; ++p) {
        float* own = out.seen.data() + std::size_t(p) * nodes;
        const std::array<float, 3>& to = middles[std::size_t(p)];
        for (std::size_t i = 0; i < 3; ++i) k.to_sun[i] = to[i];
        PILEUS_TRY(run_rows(context, context.kernels->shadow_rows, k, ShadowBuffers{own},
                            std::uint32_t(out.grid.size[1] * out.grid.size[2])));
    }
    parallel_for(context.threads, out.grid.size[2], [&](std::int64_t z, int) {
        for (std::size_t n = std::size_t(z) * slice; n < std::size_t(z + 1) * slice; ++n) {
            if (numbers > kParts)
                see_octaves(octaves, turns, left, absorption, middles, nodes, out.seen.data() + n);
            else
                see_parts(octaves, left, absorption, nodes, out.seen.data() + n);
        }
    });
    return Status::ok();
}

}  // namespace

NodeGrid sky_node_grid(const Medium& medium) {
    const auto& e = medium.extent_m;
    float coarse = 0;
    for (float cell : medium.grid.cell_m) coarse = cell > coarse ? cell : coarse;
    double spacing = 2 * double(coarse);
    while (e[0] * e[1] * e[2] > spacing * spacing * spacing * kNodeBudget) spacing *= 1.25;
    return make_node_grid(medium.grid, medium.extent_m, spacing);
}

int sky_node_sets(const Lighting& light) {
    if (light.map.columns > 0) return 3;
    const Double3 sum = light.sky + light.ground.radiance();
    return !(sum.x + sum.y + sum.z > 0) ? 0 : light.ground.present ? 2 : 1;
}

Status make_sky_nodes(const Context& context, const Medium& medium, const Majorants& majorants,
                      const Lighting& lighting, double kept, const Octaves& octaves,
                      const SkyView& view, SkyNodes& out) {
    const StageClock clock(context, "skylight");
    out.sets = sky_node_sets(lighting);
    if (out.sets == 0) return Status::ok();
    Radiances r;
    if (lighting.map.columns > 0)
        set_map(lighting, r);
    else
        set_constant(lighting, r);
    out.grid = sky_node_grid(medium);
    const std::uint64_t nodes = node_count(out.grid);
    for (int s = 0; s < 3; ++s)
        for (int c = 0; c < 3; ++c) out.colour[s][c] = float(r.colour[s][c]);
    PILEUS_TRY(allocate_once(arrays::sky_light(nodes, out.sets, Stage::kWrite), out.light));
    PILEUS_TRY(see_sky(context, medium, majorants, kept, octaves, view, out));
    const std::size_t count = std::size_t(nodes), slice = count / std::size_t(out.grid.size[2]);
    const SkyDirections middles = sky_directions();
    const SkyViewInput turned{out.grid, &view,         &out.phase, &middles,
                              out.sets, octaves.count, r.share,    out.seen.span()};
    if (view.turned && on_device(context.kernels->device))
        return launch_on_device(*context.kernels->device, sky_turn_params(turned),
                                SkyTurnBuffers{out.phase.data(), out.seen.data(), out.light.data()},
                                std::uint32_t(nodes));
    parallel_for(context.threads, out.grid.size[2], [&](std::int64_t z, int) {
        const std::size_t begin = std::size_t(z) * slice;
        if (view.turned) {
            turn_sky_nodes(turned, *context.kernels, std::uint32_t(begin),
                           std::uint32_t(begin + slice), out.light.data());
            return;
        }
        for (int s = 0; s < out.sets; ++s) {
            float* light = out.light.data() + std::size_t(s) * count;
            std::fill_n(light + begin, slice, 0.0f);
            for (int p = 0; p < kParts; ++p) {
                const float share = float(r.share[s][p]);
                const float* seen = out.seen.data() + std::size_t(p) * count;
                for (std::size_t n = begin; n < begin + slice; ++n) light[n] += share * seen[n];
            }
        }
    });
    return Status::ok();
}

}  // namespace pileus
