// SPDX-License-Identifier: Apache-2.0
// See ordinate_walls.h. Where solids end ways between nodes.
// in: solids, nodes -> out: OrdinateWalls without light. docs/ordinates.md, "Solids"
#include <algorithm>

#include "kernels_cpu/solids/solids.h"
#include "platform/threads.h"
#include "src/picture/ordinates/ordinate_solve.h"
#include "src/picture/ordinates/walls/ordinate_walls.h"
#include "src/world/solids/solids.h"

namespace pileus {
namespace {

/// Ways within a direction's part of the sphere, along height and azimuth each.
constexpr int kParts = 2;
constexpr float kPerWay = 1.0f / (kParts * kParts);
constexpr float kFacing = 0.1f;  // of the square of a sum of normals
constexpr int kMaxCrossed = 64;  // triangles that a ray is followed through
constexpr int kMaxCandidates = 8;

/// Where the ways of a direction go; null: they are counted.
struct Found {
    OrdinateWall* ways = nullptr;
    OrdinateSurface* surfaces = nullptr;
    std::int32_t count = 0;
};

/// Solids as the ways of one direction meet them.
struct WayThrough {
    const SolidsView& solids;
    const OrdinateCells& nodes;
    const OrdinateSweep& sweep;
    double ground_z;
    float to[kParts * kParts][3];  ///< against the light's way
    int tap[4][3];                 ///< nodes that a way begins between, from its end
    float weight[4];
    float reach;  ///< to the farthest of them, metres
};

/// Nodes of the slice before that light of a direction comes from, as OrdinateSweep has them, but
/// where periods are with the one that it is.
void set_taps(const NodeGrid& grid, int j, WayThrough& way) {
    const OrdinateSweep& s = way.sweep;
    const std::array<double, 3> d = ordinate_direction(j);
    const auto step = [&](int a) { return d[std::size_t(a)] * double(grid.per_metre[a]); };
    const double through = step(s.axis) < 0 ? -step(s.axis) : step(s.axis);
    int low[2];
    for (int i = 0; i < 2; ++i) {
        const int a = i == 0 ? s.along : s.across;
        const float share =
            s.weight[1][1] + (i == 0 ? s.weight[0][1] : s.weight[1][0]);  // of the farther node
        const double periods = (-step(a) / through - s.base[i] - double(share)) / grid.size[a];
        low[i] =
            s.base[i] + (way.nodes.periodic ? floor_int(float(periods) + 0.5f) : 0) * grid.size[a];
    }
    way.reach = 0;
    for (int t = 0; t < 4; ++t) {
        const int x = t & 1, y = t >> 1;
        way.tap[t][s.axis] = s.up != 0 ? -1 : 1;
        way.tap[t][s.along] = low[0] + x, way.tap[t][s.across] = low[1] + y;
        way.weight[t] = s.weight[y][x];
        float square = 0;
        for (int a = 0; a < 3; ++a) {
            const float metres = float(way.tap[t][a]) / grid.per_metre[a];
            square += metres * metres;
        }
        way.reach = std::max(way.reach, __builtin_sqrtf(square));
    }
}

/// What ends a way so far.
struct Met {
    OrdinateSurface surface{};
    float first[3] = {};  ///< normal
    float ended = 0;
    bool within = false;  ///< some of it among the nodes
};

/// Looks from `at` along `to` for a solid before `limit`; it ends `weight` of the way. False: none.
bool meet(const SolidsView& solids, const float (&at)[3], const float (&to)[3], float limit,
          float weight, Met& m) {
    if (!(limit > 0)) return false;
    float metres = 0;
    const std::int32_t hit = nearest_solid(solids, at, to, limit, metres);
    if (hit < 0) return false;
    const SolidTriangle& t = solids.triangles[hit];
    const float toward = t.normal[0] * to[0] + t.normal[1] * to[1] + t.normal[2] * to[2];
    const float side = toward > 0 ? -1.0f : 1.0f;
    const float lift =
        (std::max(std::max(abs_(at[0]), abs_(at[1])), abs_(at[2])) + metres) * 0x1p-17f;
    for (int a = 0; a < 3; ++a) {
        if (!(m.ended > 0)) {
            m.surface.at[a] = at[a] + metres * to[a] + lift * side * t.normal[a];
            m.first[a] = side * t.normal[a];
        }
        m.surface.normal[a] += weight * side * t.normal[a];
        m.surface.albedo[a] += weight * solids.albedo[3 * t.colour + a];
    }
    m.ended += weight;
    return true;
}

/// Whether no part of the ways to a node can meet a solid.
bool is_far(const SolidsView& solids, const float (&at)[3], float metres) {
    const SolidNode& all = solids.nodes[0];
    for (int a = solids.period[0] > 0 ? 2 : 0; a < 3; ++a)
        if (at[a] + metres < all.low[a] || at[a] - metres > all.high[a]) return true;
    return false;
}

/// What ends light from outside of the box, `weight` in all. Returns the share.
float meet_beyond(const WayThrough& way, const float (&at)[3], float weight, Met& m) {
    float share = 0;
    for (const auto& to : way.to) {
        float limit = 3e38f;
        const double down = -double(to[2]), above = double(at[2]) - way.ground_z;
        if (down > 0 && above < 1e30) limit = float(std::min(3e38, above / down));
        if (meet(way.solids, at, to, limit, weight * kPerWay, m)) share += kPerWay;
    }
    return share;
}

/// Whether a node is one of the grid, at `place`; else through which faces light comes there: 1 the
/// lower one, 2 others.
std::int32_t beyond_grid(const OrdinateCells& nodes, const NodePlace& place) {
    std::int32_t out = 0;
    for (int a = nodes.periodic ? 2 : 0; a < 3; ++a) {
        const int p = place[std::size_t(a)];
        if (p >= 0 && p < nodes.grid.size[a]) continue;
        if (a == 2 && p < 0) return 1;
        out = 2;
    }
    return out;
}

void find_way(const WayThrough& way, const NodePlace& p, std::int32_t place, Found& out) {
    const NodeGrid& grid = way.nodes.grid;
    float at[3], outside = 0, weight[4];
    for (std::size_t a = 0; a < 3; ++a) at[a] = (float(p[a]) + 0.5f) / grid.per_metre[a];
    const bool far = is_far(way.solids, at, way.reach);
    Met m;
    std::int32_t face[4];
    for (int t = 0; t < 4; ++t) {
        weight[t] = way.weight[t];
        NodePlace from{};
        for (std::size_t a = 0; a < 3; ++a) from[a] = p[a] + way.tap[t][a];
        face[t] = beyond_grid(way.nodes, from);
        if (face[t] != 0) {
            outside += weight[t];
            m.surface.beyond = std::max(m.surface.beyond, face[t]);
        }
        if (face[t] != 0 || far || !(weight[t] > 0)) continue;
        float to[3], square = 0;
        for (int a = 0; a < 3; ++a) {
            to[a] = float(way.tap[t][a]) / grid.per_metre[a];
            square += to[a] * to[a];
        }
        const float metres = __builtin_sqrtf(square);
        for (float& d : to) d /= metres;
        if (!meet(way.solids, at, to, metres, weight[t], m)) continue;
        weight[t] = 0;
        m.within = true;
    }
    if (outside > 0) {
        const float passes = 1 - meet_beyond(way, at, outside, m);
        for (int t = 0; t < 4; ++t)
            if (face[t] != 0) weight[t] *= passes;
    }
    if (!(m.ended > 0)) return;
    const std::int32_t number = out.count++;
    if (out.ways == nullptr) return;
    OrdinateSurface s = m.surface;
    s.node = std::int32_t(node_number(grid, p));
    if (m.within) s.beyond = 0;
    float square = 0;
    for (const float n : s.normal) square += n * n;
    // Of walls that face one another the first.
    if (square < kFacing * m.ended * m.ended) {
        std::copy_n(m.first, 3, s.normal);
        square = 1;
    }
    const float unit = 1 / __builtin_sqrtf(square);
    for (float& n : s.normal) n *= unit;
    OrdinateWall& wall = out.ways[number];
    wall.place = place;
    for (int t = 0; t < 4; ++t) wall.weight[t >> 1][t & 1] = weight[t];
    out.surfaces[number] = s;
}

void find_ways(WayThrough& way, int j, const OrdinatesParams& k, Found& out) {
    const OrdinateSweep& s = way.sweep;
    for (int part = 0; part < kParts * kParts; ++part) {
        const std::array<double, 3> d =
            ordinate_part(j, (part / kParts + 0.5) / kParts, (part % kParts + 0.5) / kParts);
        for (std::size_t a = 0; a < 3; ++a) way.to[part][a] = float(-d[a]);
    }
    const NodeGrid& grid = way.nodes.grid;
    set_taps(grid, j, way);
    const std::size_t axis = std::size_t(s.axis), across = std::size_t(s.across),
                      along = std::size_t(s.along);
    NodePlace p{};
    for (int turn = 0; turn < k.size[axis]; ++turn) {
        p[axis] = s.up != 0 ? turn : k.size[axis] - 1 - turn;
        for (p[across] = 0; p[across] < k.size[across]; ++p[across])
            for (p[along] = 0; p[along] < k.size[along]; ++p[along]) {
                const std::size_t place =
                    s.axis == 0 ? place_along_x(grid, p) : node_number(grid, p);
                find_way(way, p, std::int32_t(place), out);
            }
    }
}

/// Ways node by node.
Status sort_ways(std::size_t all, OrdinateWalls& w) {
    const std::size_t ways = w.surfaces.size();
    PILEUS_TRY(allocate(arrays::ordinate_wall_numbers(all), w.number));
    for (std::size_t i = 0; i < ways; ++i) ++w.number[std::size_t(w.surfaces[i].node)];
    std::uint64_t count = 0;
    for (const std::int32_t n : w.number.span()) count += n > 0 ? 1 : 0;
    PILEUS_TRY(allocate(arrays::ordinate_wall_numbers(count), w.nodes));
    PILEUS_TRY(allocate(arrays::ordinate_wall_numbers(count + 1), w.begin));
    PILEUS_TRY(allocate(arrays::ordinate_wall_numbers(ways), w.of_node));
    std::size_t n = 0;
    for (std::size_t i = 0; i < all; ++i) {
        if (w.number[i] == 0) {
            w.number[i] = -1;
            continue;
        }
        w.begin[n + 1] = w.begin[n] + w.number[i];
        w.nodes[n] = std::int32_t(i);
        w.number[i] = std::int32_t(n++);
    }
    // While ways are placed, each node's first is its next.
    for (std::size_t i = 0; i < ways; ++i) {
        const auto own = std::size_t(w.number[std::size_t(w.surfaces[i].node)]);
        w.of_node[std::size_t(w.begin[own]++)] = std::int32_t(i);
    }
    for (std::size_t own = count; own > 0; --own) w.begin[own] = w.begin[own - 1];
    w.begin[0] = 0;
    return Status::ok();
}

/// Calls use(solid) for each triangle that a ray along an axis crosses.
template <class Use>
void each_crossed(const SolidsView& solids, const float (&at)[3], int axis, float sign,
                  const Use& use) {
    float from[3] = {at[0], at[1], at[2]}, to[3] = {};
    to[axis] = sign;
    for (int n = 0; n < kMaxCrossed; ++n) {
        float metres = 0;
        const std::int32_t hit = nearest_solid(solids, from, to, 3e38f, metres);
        if (hit < 0) return;
        use(solids.triangles[hit].solid);
        // Past it by more than rounding moves it.
        from[axis] += sign * (metres + (abs_(from[axis]) + metres) * 0x1p-17f);
    }
}

/// Solids of which a ray upwards crosses an odd number of triangles, the first few.
int odd_above(const SolidsView& solids, const float (&at)[3], std::int32_t (&out)[kMaxCandidates]) {
    int count = 0;
    each_crossed(solids, at, 2, 1, [&](std::int32_t solid) {
        std::int32_t* const end = out + count;
        std::int32_t* const own = std::find(out, end, solid);
        if (own != end)
            *own = out[--count];
        else if (count < kMaxCandidates)
            out[count++] = solid;
    });
    return count;
}

}  // namespace

bool is_within_solid(const Solids& solids, const float (&at)[3]) {
    const SolidsView view = solids.view();
    if (is_far(view, at, 0)) return false;
    std::int32_t candidates[kMaxCandidates];
    const int count = odd_above(view, at, candidates);
    for (int i = 0; i < count; ++i) {
        bool within = true;
        for (int way = 0; way < 5 && within; ++way) {
            int crossed = 0;
            each_crossed(view, at, way / 2, way % 2 == 0 ? -1.0f : 1.0f,
                         [&](std::int32_t solid) { crossed += solid == candidates[i] ? 1 : 0; });
            within = crossed % 2 == 1;
        }
        if (within) return true;
    }
    return false;
}

Status place_walls(const Context& context, const Solids& solids, double ground_z,
                   OrdinateCells& nodes) {
    OrdinateWalls& w = nodes.walls;
    OrdinatesParams k{};
    OrdinateWay ways[kOrdinateClasses];
    for (int a = 0; a < 3; ++a) k.size[a] = nodes.grid.size[a];
    set_ordinate_sweeps(nodes.grid, nodes.periodic, ways, k);
    const SolidsView view = solids.view();
    Found found[kOrdinates];
    const auto find = [&] {
        parallel_for(context.threads, kOrdinates, [&](std::int64_t j, int) {
            WayThrough way{view, nodes, k.sweep[j], ground_z, {}, {}, {}, 0};
            find_ways(way, int(j), k, found[j]);
        });
    };
    find();
    std::uint64_t count = 0;
    for (std::size_t j = 0; j < kOrdinates; ++j) {
        w.first[j] = std::int32_t(count);
        count += std::uint64_t(found[j].count);
    }
    w.first[kOrdinates] = std::int32_t(count);
    PILEUS_TRY(allocate(arrays::ordinate_ways(count), w.ways));
    PILEUS_TRY(allocate(arrays::ordinate_surfaces(count), w.surfaces));
    for (std::size_t j = 0; j < kOrdinates; ++j)
        found[j] = {w.ways.data() + w.first[j], w.surfaces.data() + w.first[j], 0};
    if (count > 0) find();
    w.ground_z = ground_z;
    return sort_ways(std::size_t(node_count(nodes.grid)), w);
}

Status hold_walls(std::uint64_t sets, bool around, OrdinateWalls& w) {
    if (!w.any()) return Status::ok();
    PILEUS_TRY(hold(arrays::ordinate_wall_light(bytes_of(sets, w.ways.size())), w.sends));
    PILEUS_TRY(hold(arrays::ordinate_wall_light(bytes_of(kOrdinates, w.nodes.size())), w.sources));
    if (!around) return Status::ok();
    PILEUS_TRY(
        hold(arrays::ordinate_wall_light(bytes_of(sets * kAroundTerms, w.nodes.size())), w.around));
    return hold(arrays::ordinate_wall_light(bytes_of(3 * kAroundTerms, w.nodes.size())), w.shown);
}

}  // namespace pileus
