// SPDX-License-Identifier: Apache-2.0
// See ordinate_ground.h.
#include "src/picture/ordinates/ordinate_ground.h"

#include <algorithm>

#include "kernels_cpu/core/lanes.h"
#include "kernels_cpu/core/math.h"
#include "platform/threads.h"
#include "src/picture/background.h"
#include "src/picture/march_view.h"
#include "src/picture/ordinates/ordinate_medium.h"

namespace pileus {
namespace {

constexpr int kCells = 64;                // along x and y
constexpr double kReach = 2;              // heights of the medium's top over the ground
constexpr float kAboveGround = 0x1p-10f;  // of the box's height: within what stands there
constexpr int kRim = kCells / 8;
constexpr int kParts = 2;  // of a direction's part of the sphere, along height and azimuth each

/// A way from the ground up, and what its light counts: cosine times solid angle over pi.
struct Look {
    float to[3], weight;
    int direction;
};
constexpr int kLooks = kOrdinates / 2 * kParts * kParts;

void set_looks(Look (&out)[kLooks]) {
    int n = 0;
    for (int j = 0; j < kOrdinates; ++j) {
        if (goes_up(j)) continue;
        for (int i = 0; i < kParts * kParts; ++i) {
            const std::array<double, 3> way =
                ordinate_part(j, (i / kParts + 0.5) / kParts, (i % kParts + 0.5) / kParts);
            Look& look = out[n++];
            for (std::size_t a = 0; a < 3; ++a) look.to[a] = float(-way[a]);
            look.weight = float(4 * -way[2] / (kOrdinates * kParts * kParts));
            look.direction = j;
        }
    }
}

/// Numbers between the middles of nodes, of an array of a direction's own order.
struct NodeField {
    const float* values;
    const NodeGrid& grid;
    bool along_x, periodic;

    float at(const float (&place)[3]) const {
        int low[3], high[3];
        float share[3];
        for (int a = 0; a < 3; ++a) {
            const int n = grid.size[a];
            float p = place[a] * grid.per_metre[a] - 0.5f;
            if (periodic && a < 2) {
                p -= float(floor_int(p / float(n))) * float(n);
                low[a] = std::min(int(p), n - 1), high[a] = (low[a] + 1) % n;
            } else {
                p = std::min(std::max(p, 0.0f), float(n - 1));
                low[a] = int(p), high[a] = std::min(low[a] + 1, n - 1);
            }
            share[a] = p - float(low[a]);
        }
        float sum = 0;
        for (int i = 0; i < 8; ++i) {
            float part = 1;
            NodePlace p{};
            for (std::size_t a = 0; a < 3; ++a) {
                const bool far = (i >> a & 1) != 0;
                part *= far ? share[a] : 1 - share[a];
                p[a] = far ? high[a] : low[a];
            }
            if (part > 0)
                sum += part * values[along_x ? place_along_x(grid, p) : node_number(grid, p)];
        }
        return sum;
    }
};

/// Where a way up from a place below the top meets the box.
struct Entry {
    float metres = 0;     ///< < 0: nowhere
    bool beside = false;  ///< at a side
};
Entry entry_of(const Medium& medium, const float (&at)[3], const Look& look) {
    Entry out;
    float leave = __builtin_inff();
    for (int a = medium.grid.periodic ? 2 : 0; a < 3; ++a) {
        const float low = -at[a] / look.to[a],
                    high = (float(medium.extent_m[a]) - at[a]) / look.to[a];
        const float enter = std::min(low, high);
        if (enter > out.metres) out = {enter, a < 2};
        leave = std::min(leave, std::max(low, high));
    }
    if (!(out.metres < leave)) out.metres = -1;
    return out;
}

/// Beyond the map nothing is known: light ends at its rim without an edge.
float rim_share(const OrdinateGround& ground, int x, int y) {
    const int in_x = std::min(x, int(ground.map.size[0]) - 1 - x),
              in_y = std::min(y, int(ground.map.size[1]) - 1 - y);
    return std::min((float(std::min(in_x, in_y)) + 0.5f) / float(kRim), 1.0f);
}

/// A cell's middle.
struct GroundCell {
    int x, y;
    float at[3];
};
GroundCell ground_cell(const OrdinateGround& ground, std::size_t cell) {
    GroundCell out{int(cell) % ground.map.size[0], int(cell) / ground.map.size[0], {}};
    const int number[2] = {out.x, out.y};
    for (int a = 0; a < 2; ++a)
        out.at[a] = ground.origin[a] + (float(number[a]) + 0.5f) / ground.map.per_metre[a];
    out.at[2] = float(ground.z);
    return out;
}

/// Means over the ground of what is in the cells, by what of it enters the box from below, and from
/// beside.
template <class Value>
void means_into_box(const OrdinateGround& ground, const Value& value, double (&out)[2]) {
    const std::size_t cells = std::size_t(node_count(ground.map));
    double sum[2] = {}, all[2] = {};
    for (std::size_t i = 0; i < cells; ++i) {
        const double own = double(value(i));
        for (std::size_t f = 0; f < 2; ++f) {
            const double into = double(ground.into[f * cells + i]);
            sum[f] += into * own;
            all[f] += into;
        }
    }
    for (std::size_t f = 0; f < 2; ++f) out[f] = all[f] > 0 ? sum[f] / all[f] : 0;
}

/// Means of the sunlight that comes through to the ground, by channel, on every second cell along x
/// and y.
Status mean_sunlight(const Context& context, const Medium& medium, const Majorants& majorants,
                     const Lighting& lighting, const OrdinateNodes& nodes, double (&out)[3][2]) {
    const OrdinateGround& ground = nodes.ground;
    ShadowParams k{};
    k.medium = make_medium_view(medium, majorants);
    // Coarse places see what detail keeps: the mean.
    k.medium.detail = nullptr;
    k.nodes = ground.map;
    for (int a = 0; a < 2; ++a) {
        k.nodes.size[a] = (ground.map.size[a] + 1) / 2;
        k.nodes.per_metre[a] *= float(k.nodes.size[a]) / float(ground.map.size[a]);
        k.origin[a] = ground.origin[a];
    }
    k.origin[2] = float(ground.z - 0.5);  // the row's middle
    for (std::size_t a = 0; a < 3; ++a) k.to_sun[a] = lighting.to_sun[a];
    Buffer<float> depth;
    PILEUS_TRY(allocate(arrays::ordinate_ground_sun(node_count(k.nodes)), depth));
    PILEUS_TRY(run_rows(context, context.kernels->shadow_rows, k, ShadowBuffers{depth.data()},
                        std::uint32_t(k.nodes.size[1])));
    if (lighting.solids != nullptr) shade_cells(context, *lighting.solids, k, depth);
    for (int c = 0; c < 3; ++c)
        means_into_box(
            ground,
            [&](std::size_t i) {
                const std::size_t wide = std::size_t(ground.map.size[0]);
                const std::size_t at = i / wide / 2 * std::size_t(k.nodes.size[0]) + i % wide / 2;
                return exp_(-(depth[at] * nodes.mean_rest[c]));
            },
            out[c]);
    return Status::ok();
}

}  // namespace

bool lights_ground(const Medium& medium, const Lighting& lighting, const OrdinateAsk& ask,
                   const OrdinateCells& nodes) {
    return ask.ground && lighting.ground.present && !nodes.ring &&
           lighting.ground.z < medium.extent_m[2];
}

std::uint64_t max_ground_cells(const Medium& medium) {
    const std::uint64_t cells = std::uint64_t(kCells) * kCells;
    return medium.grid.periodic ? max_ordinate_nodes(medium) : cells;
}

Status reserve_ground(OrdinateNodes& nodes) {
    const std::uint64_t cells =
        nodes.periodic ? std::uint64_t(nodes.grid.size[0]) * std::uint64_t(nodes.grid.size[1])
                       : std::uint64_t(kCells) * kCells;
    PILEUS_TRY(hold(arrays::ordinate_ground(cells, kMaxOrdinateSets), nodes.ground.light));
    PILEUS_TRY(hold(arrays::ordinate_ground(cells, 2), nodes.ground.into));
    return hold(arrays::ordinate_ground(cells, 3), nodes.ground.radiance);
}

Status place_ground(const Context& context, const Medium& medium, const Lighting& lighting,
                    OrdinateNodes& nodes) {
    OrdinateGround& ground = nodes.ground;
    NodeGrid map{};
    map.size[2] = 1;
    map.per_metre[2] = 1;
    const double reach = nodes.periodic ? 0 : kReach * (medium.extent_m[2] - lighting.ground.z);
    for (int a = 0; a < 2; ++a) {
        map.size[a] = nodes.periodic ? nodes.grid.size[a] : kCells;
        map.per_metre[a] = float(map.size[a] / (medium.extent_m[a] + 2 * reach));
        ground.origin[a] = float(-reach);
    }
    if (ground.map.size[0] == 0 || ground.z != lighting.ground.z) ground.known.fill(false);
    ground.map = map;
    ground.z = lighting.ground.z;
    const std::uint64_t cells = node_count(map), sets = nodes.sets.size();
    if (ground.light.size() < cells * sets) ground.known.fill(false);
    PILEUS_TRY(hold(arrays::ordinate_ground(cells, sets), ground.light));
    PILEUS_TRY(hold(arrays::ordinate_ground(cells, 3), ground.radiance));
    if (ground.known[0]) return Status::ok();
    PILEUS_TRY(hold(arrays::ordinate_ground(cells, 2), ground.into));
    Look looks[kLooks];
    set_looks(looks);
    parallel_each(context.threads, std::size_t(cells), [&](std::size_t cell) {
        const GroundCell from = ground_cell(ground, cell);
        const float above[3] = {from.at[0], from.at[1],
                                from.at[2] + kAboveGround * float(medium.extent_m[2])};
        float sum[2] = {};
        // What a closed solid stands on sends nothing into the box.
        const bool covered = has_meshes(lighting) && is_within_solid(*lighting.solids, above);
        for (const Look& look : looks) {
            const Entry entry = entry_of(medium, from.at, look);
            if (!covered && !(entry.metres < 0)) sum[entry.beside ? 1 : 0] += look.weight;
        }
        for (std::size_t f = 0; f < 2; ++f) ground.into[f * cells + cell] = sum[f];
    });
    return Status::ok();
}

Status light_ground(const Context& context, const Medium& medium, const Lighting& lighting,
                    const OrdinateSources& from, std::size_t s, OrdinateSolver& solver,
                    OrdinateNodes& nodes) {
    OrdinateGround& ground = nodes.ground;
    OrdinateSet& set = nodes.sets[s];
    OrdinateLeaving leaving{};
    PILEUS_TRY(leave_nodes(context, medium, nodes, lighting, from, solver, set,
                           nodes.solution.data() + s * nodes.filled.size() * kOrdinateMoments,
                           leaving));
    Look looks[kLooks];
    set_looks(looks);
    const std::size_t all = nodes.density.size(), cells = std::size_t(node_count(ground.map));
    float* const light = ground.light.data() + s * cells;
    parallel_each(context.threads, cells, [&](std::size_t cell) {
        const GroundCell from_cell = ground_cell(ground, cell);
        const float(&at)[3] = from_cell.at;
        float sum = 0;
        for (const Look& look : looks) {
            const float metres = entry_of(medium, at, look).metres;
            if (metres < 0) continue;
            const auto j = std::size_t(look.direction);
            // Nodes send on what they do from where the way through them ends.
            const float back = metres + 0.5f * leaving.length_m[j];
            const float place[3] = {at[0] + back * look.to[0], at[1] + back * look.to[1],
                                    at[2] + back * look.to[2]};
            const NodeField field{leaving.radiance + j * all, nodes.grid, leaving.along_x[j],
                                  nodes.periodic};
            sum += look.weight * (field.at(place) - set.enters[j]);
        }
        light[cell] = nodes.periodic ? sum : sum * rim_share(ground, from_cell.x, from_cell.y);
    });
    double means[2];
    means_into_box(
        ground, [&](std::size_t i) { return light[i]; }, means);
    for (int f = 0; f < 2; ++f) ground.mean[f][s] = means[f];
    ground.known[s] = true;
    return Status::ok();
}

Status mix_ground(const Context& context, const Medium& medium, const Majorants& majorants,
                  const Lighting& lighting, OrdinateNodes& nodes) {
    OrdinateGround& ground = nodes.ground;
    const double albedo = lighting.ground.albedo;
    const int channels = light_channels(medium, lighting, nodes.walls.any());
    const std::size_t cells = std::size_t(node_count(ground.map));
    double sunlight[3][2] = {};
    if (lighting.sunlit)
        PILEUS_TRY(mean_sunlight(context, medium, majorants, lighting, nodes, sunlight));
    const auto of_channel = [&](const OrdinateSet& set, std::size_t c) {
        return channels == 1 || set.channel == int(c);
    };
    for (std::size_t c = 0; c < 3; ++c) {
        // Radiances of the parts are what arrives there of other light, and of both.
        double arrives[2], back[2][2] = {};
        for (std::size_t f = 0; f < 2; ++f) {
            arrives[f] = lighting.ground.diffuse[c] + lighting.ground.lamps[c] +
                         lighting.ground.sun[c] * sunlight[c][f];
            for (std::size_t s = 0; s < nodes.sets.size(); ++s) {
                const OrdinateSet& set = nodes.sets[s];
                if (!set.ground)
                    arrives[f] += albedo * double(set.colour[c]) * ground.mean[f][s];
                else if (of_channel(set, c))
                    back[f][set.faces == OrdinateFaces::kLower ? 0 : 1] =
                        albedo * ground.mean[f][s];
            }
            arrives[f] = std::max(arrives[f], 0.0);
        }
        const double whole =
            std::max((1 - back[0][0]) * (1 - back[1][1]) - back[0][1] * back[1][0], 1e-6);
        const double sends[2] = {((1 - back[1][1]) * arrives[0] + back[0][1] * arrives[1]) / whole,
                                 ((1 - back[0][0]) * arrives[1] + back[1][0] * arrives[0]) / whole};
        double into[2] = {};
        for (std::size_t f = 0; f < 2; ++f)
            for (std::size_t i = 0; i < cells; ++i) into[f] += double(ground.into[f * cells + i]);
        ground.sends[c] =
            (into[0] * sends[0] + into[1] * sends[1]) / std::max(into[0] + into[1], 1e-30);
        for (OrdinateSet& set : nodes.sets)
            if (set.ground)
                set.colour[c] = of_channel(set, c)
                                    ? float(sends[set.faces == OrdinateFaces::kLower ? 0 : 1])
                                    : 0.0f;
    }
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < cells; ++i) {
            double sum = 0;
            for (std::size_t s = 0; s < nodes.sets.size(); ++s)
                sum += double(nodes.sets[s].colour[c]) * double(ground.light[s * cells + i]);
            ground.radiance[c * cells + i] = float(albedo * sum);
        }
    return Status::ok();
}

void read_ordinate_light(const OrdinateNodes& nodes, const Lighting& light, BackgroundParams& k,
                         BackgroundBuffers& b) {
    b.around = around_nodes(nodes);
    // Light turned within the peak of the phase function is none of the nodes'.
    for (int c = 0; c < 3; ++c) k.sun_rest[c] = nodes.mean_rest[c];
    const OrdinateGround& ground = nodes.ground;
    if (ground.map.size[0] == 0) return;
    k.map = ground.map;
    for (int a = 0; a < 2; ++a) k.map_origin[a] = ground.origin[a];
    k.map_per_albedo = light.has_bright_ground() ? float(1 / light.ground.albedo) : 0;
    b.map = ground.radiance.data();
}

}  // namespace pileus
