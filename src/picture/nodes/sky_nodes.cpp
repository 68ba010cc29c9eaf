// SPDX-License-Identifier: Apache-2.0
// See sky_nodes.h.
// in: a medium and what shines on it from all around -> out: what of it reaches each node.
// docs/raymarch.md, "Skylight".
#include "src/picture/nodes/sky_nodes.h"

#include <algorithm>

#include "kernels_cpu/core/math.h"
#include "kernels_cpu/light/sky_map.h"
#include "platform/threads.h"
#include "src/base/angles.h"
#include "src/picture/march_view.h"
#include "src/picture/nodes/node_grid.h"
#include "src/world/phase/forward_share.h"

namespace pileus {
namespace {

constexpr double kNodeBudget = 1u << 15;
constexpr int kBands = 6, kAround = 4;  // equal parts of the sphere: in height, and around
constexpr int kParts = kBands * kAround;
static_assert(kParts == kSkyParts);
constexpr int kWithin = 16;  // radiances of a map are means of so many squared per part

struct Direction {
    float d[3];
};

/// Within part (band, turn), at shares u and v of its height and width.
Direction direction_in(int part, double u, double v) {
    const int band = part / kAround, turn = part % kAround;
    const double z = -1 + 2 * (band + u) / kBands;
    // Every other band turns by half a part.
    const double around = 360.0 / kAround * (turn + v + 0.5 * (band % 2));
    const SineCosine a = sincos_deg(around);
    const double r = __builtin_sqrt(1 - z * z);
    return {{float(a.cosine * r), float(a.sine * r), float(z)}};
}

/// Light of each set from a part of the sphere, as shares of its colour over all parts.
struct Radiances {
    double share[3][kParts] = {};
    double colour[3][3] = {};
};

void set_constant(const Lighting& light, Radiances& r) {
    for (int p = 0; p < kParts; ++p) {
        const bool down = light.ground && p / kAround < kBands / 2;
        r.share[down ? 1 : 0][p] = 1.0 / kParts;
    }
    for (std::size_t c = 0; c < 3; ++c) {
        r.colour[0][c] = light.sky[c];
        r.colour[1][c] = light.ground_diffuse[c] + light.ground_sun[c];
    }
}

void set_map(const Lighting& light, Radiances& r) {
    for (int p = 0; p < kParts; ++p) {
        const bool down = light.ground && p / kAround < kBands / 2;
        double sum[3] = {};
        for (int i = 0; i < kWithin * kWithin && !down; ++i) {
            const Direction a =
                direction_in(p, (i / kWithin + 0.5) / kWithin, (i % kWithin + 0.5) / kWithin);
            const Vec<float> seen = map_radiance(light.map, Vec<float>{a.d[0], a.d[1], a.d[2]});
            const float own[3] = {seen.x, seen.y, seen.z};
            for (int c = 0; c < 3; ++c) sum[c] += double(own[c]) / (kWithin * kWithin);
        }
        for (std::size_t c = 0; c < 3; ++c) {
            const double ground = light.ground_diffuse[c] + light.ground_sun[c];
            r.share[c][p] = (down ? ground : sum[c]) / kParts;
            r.colour[c][c] += r.share[c][p];
        }
    }
    for (int c = 0; c < 3; ++c)
        for (double& share : r.share[c]) share = r.colour[c][c] > 0 ? share / r.colour[c][c] : 0;
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

/// What each node sees of each part of the sphere, by a ray to its middle.
Status see_sky(const Context& context, const Medium& medium, const Majorants& majorants,
               double kept, const Octaves& octaves, SkyNodes& out) {
    const std::size_t nodes = std::size_t(node_count(out.grid));
    if (out.seen.size() == kParts * nodes) return Status::ok();
    PILEUS_TRY(allocate_once(arrays::sky_seen(nodes), out.seen));
    ShadowParams k{};
    k.medium = make_medium_view(medium, majorants);
    k.nodes = out.grid;
    const float left = float(1 - kept);
    const Absorption absorption = absorption_of(medium);
    const std::size_t slice = nodes / std::size_t(out.grid.size[2]);
    for (int p = 0; p < kParts; ++p) {
        float* own = out.seen.data() + std::size_t(p) * nodes;
        const std::array<float, 3> to = sky_direction(p);
        for (std::size_t i = 0; i < 3; ++i) k.to_sun[i] = to[i];
        PILEUS_TRY(run_rows(context, context.kernels->shadow_rows, k, ShadowBuffers{own},
                            std::uint32_t(out.grid.size[1] * out.grid.size[2])));
    }
    parallel_for(context.threads, out.grid.size[2], [&](std::int64_t z, int) {
        for (std::size_t n = std::size_t(z) * slice; n < std::size_t(z + 1) * slice; ++n)
            see_parts(octaves, left, absorption, nodes, out.seen.data() + n);
    });
    return Status::ok();
}

}  // namespace

std::array<float, 3> sky_direction(int part) {
    const Direction a = direction_in(part, 0.5, 0.5);
    return {a.d[0], a.d[1], a.d[2]};
}

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
    const Double3 sum = light.sky + light.ground_diffuse + light.ground_sun;
    return !(sum.x + sum.y + sum.z > 0) ? 0 : light.ground ? 2 : 1;
}

Status make_sky_nodes(const Context& context, const Medium& medium, const Majorants& majorants,
                      const Lighting& lighting, double kept, const Octaves& octaves,
                      SkyNodes& out) {
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
    PILEUS_TRY(see_sky(context, medium, majorants, kept, octaves, out));
    const std::size_t count = std::size_t(nodes), slice = count / std::size_t(out.grid.size[2]);
    parallel_for(context.threads, out.grid.size[2], [&](std::int64_t z, int) {
        const std::size_t begin = std::size_t(z) * slice;
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
