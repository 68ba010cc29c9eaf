// SPDX-License-Identifier: Apache-2.0
// See ordinate_plan.h.
#include "src/picture/ordinates/ordinate_plan.h"

#include <algorithm>

#include "src/picture/ordinates/ordinate_ground.h"
#include "src/world/solids/solids.h"

namespace pileus {

OrdinateSizes ordinate_sizes(const Medium& medium, const OrdinateNodes& made) {
    OrdinateSizes out;
    const bool known = !made.density.empty();
    out.nodes = known ? made.density.size() : max_ordinate_nodes(medium);
    out.filled = known ? made.filled.size() : out.nodes;
    out.rim = known ? made.rim.size() : out.nodes;
    out.samples = known ? made.samples.size() : max_ordinate_samples(medium);
    out.all_samples = known ? node_count(ordinate_samples(made.grid, medium)) : out.samples;
    out.larger = known ? made.half.nodes.density.size() : out.nodes / 2 + 1;
    out.larger_filled = known ? made.half.nodes.filled.size() : out.larger;
    out.beside = known ? made.walls.nodes.size() : out.nodes;
    out.ways = known ? made.walls.ways.size() : bytes_of(kOrdinates, out.nodes);
    out.larger_beside = known ? made.half.nodes.walls.nodes.size() : out.larger;
    out.larger_ways = known ? made.half.nodes.walls.ways.size() : bytes_of(kOrdinates, out.larger);
    out.media = medium.count;
    out.channels = medium.channels;
    return out;
}

OrdinateSizes lit_ordinate_sizes(const Medium& medium, const Lighting& lighting,
                                 const Solids& solids, const OrdinateNodes& made) {
    OrdinateSizes out = ordinate_sizes(medium, made);
    out.solids = solids.meshes;
    const bool known = !made.density.empty();
    const int channels = known           ? light_channels(medium, lighting, made.walls.any())
                         : solids.meshes ? 3
                                         : medium.channels;
    out.sets = std::uint64_t(ordinate_sets(medium, lighting, true, channels));
    out.together = true;
    out.own = !lighting.lamps.empty() || emits(medium);
    if (lighting.ground.present) out.ground = max_ground_cells(medium);
    return out;
}

OrdinateSizes sky_level_sizes(const Medium& medium, const SkyOrdinateSizes& sky) {
    OrdinateSizes out;
    out.levels = std::uint64_t(sky.levels);
    out.nodes = out.filled = sky.nodes();
    out.larger = 1;
    for (const int n : sky.size) out.larger *= std::uint64_t((n + 1) / 2);
    out.larger_filled = out.larger;
    out.samples = sky_ordinate_samples(sky);
    out.rays = false;
    NodeGrid grid{};
    std::copy_n(sky.size, 3, grid.size);
    if (sky.levels > 1) out.ring = ring_count(grid);
    out.channels = medium.channels;
    return out;
}

namespace {

void add_larger_rows(const OrdinateSizes& s, MemoryTable& t) {
    const Array<float> solution = arrays::ordinate_solution(s.larger_filled, s.sets);
    add(t, renamed(several(2 * s.levels, solution), "ordinates: moments on larger nodes",
                   solution.first, solution.last));
    const std::uint64_t numbers = 2 * s.larger + 2 * s.filled + s.larger_filled;
    add(t, renamed(several(s.levels, arrays::ordinate_nodes(numbers, Stage::kWrite)),
                   "ordinates: larger nodes", Stage::kShadow, Stage::kWrite));
    add(t, renamed(arrays::ordinate_parts(s.larger, s.media), "ordinates: parts in larger nodes",
                   Stage::kShadow, Stage::kWrite));
    add(t, renamed(arrays::ordinate_work(s.larger, s.larger_filled),
                   "ordinates: larger nodes at work", Stage::kShadow, Stage::kShadow));
    add(t, renamed(arrays::ordinate_nodes(3 * s.larger_filled, Stage::kShadow),
                   "ordinates: numbers of these", Stage::kShadow, Stage::kShadow));
    add(t, renamed(arrays::ordinate_own(s.larger_filled, s.own), "ordinates: lamps of these",
                   Stage::kShadow, Stage::kShadow));
}

/// Ways that solids end, of nodes and of larger ones.
void add_wall_rows(const OrdinateSizes& s, MemoryTable& t) {
    const std::uint64_t ways = sum_of_bytes(s.ways, s.larger_ways);
    const std::uint64_t beside = sum_of_bytes(s.beside, s.larger_beside);
    add(t, arrays::ordinate_ways(ways));
    add(t, arrays::ordinate_surfaces(ways));
    add(t, arrays::ordinate_wall_numbers(
               sum_of_bytes(sum_of_bytes(s.nodes, s.larger), sum_of_bytes(ways, 2 * beside + 2))));
    add(t, arrays::ordinate_wall_light(
               sum_of_bytes(sum_of_bytes(bytes_of(s.sets, s.ways), s.larger_ways),
                            sum_of_bytes(bytes_of((s.sets + 3) * kAroundTerms, s.beside),
                                         bytes_of(kOrdinates, beside)))));
}

}  // namespace

void add_ordinate_rows(const OrdinateSizes& s, MemoryTable& t) {
    add(t, several(s.levels, arrays::ordinate_solution(s.filled, s.sets)));
    const std::uint64_t shown = s.together ? std::min(s.sets, std::uint64_t(kMaxShown)) : s.sets;
    add(t, several(s.levels, arrays::ordinate_light(s.nodes, shown, s.media)));
    add(t, arrays::ordinate_near(s.nodes, shown, s.moments));
    add(t, arrays::ordinate_together(s.filled, s.together && s.sets > 1));
    add(t, arrays::ordinate_work(s.nodes, s.filled));
    add(t, arrays::ordinate_parts(s.nodes, s.media));
    add(t, renamed(arrays::ordinate_parts(s.nodes, s.media), "ordinates: parts of the sun",
                   Stage::kShadow, Stage::kWrite));
    add(t, arrays::ordinate_part_work(s.filled, s.media));
    add(t, several(s.levels, arrays::ordinate_densities(s.samples)));
    add(t, arrays::ordinate_all_densities(s.all_samples));
    add(t, arrays::ordinate_depths(!s.sunlit ? 0 : s.rays ? s.all_samples : s.samples));
    add(t, several(s.levels, arrays::ordinate_nodes(s.nodes, Stage::kWrite)));
    add(t, renamed(arrays::ordinate_nodes(s.nodes, Stage::kShadow), "ordinates: numbers at work",
                   Stage::kShadow, Stage::kShadow));
    add(t, arrays::ordinate_beams(s.filled, s.beams));
    add(t, several(s.levels, arrays::ordinate_places(s.filled, Stage::kWrite)));
    add(t, arrays::ordinate_rim(s.rim));
    add(t, renamed(arrays::ordinate_places(s.filled, Stage::kShadow), "ordinates: places at work",
                   Stage::kShadow, Stage::kShadow));
    add(t, arrays::ordinate_seen(s.solids ? s.nodes : 0));
    if (s.solids) add_wall_rows(s, t);
    add(t, arrays::ordinate_own(s.filled, s.own));
    add(t, several(2, arrays::ordinate_ring(s.ring)));
    add(t, arrays::ordinate_ground(s.ground, s.ground > 0 ? s.sets + 5 : 0));
    add(t, arrays::ordinate_ground_sun(s.ground));
    add_larger_rows(s, t);
    add(t, arrays::beam_tables(std::uint64_t(s.channels) * (s.points ? 2 : 1), Stage::kShadow));
}

bool is_deep(const OrdinateNodes& nodes, const CameraParams& camera) {
    constexpr double kThickNode = 1, kDeep = 5;
    if (!(nodes.depth > kThickNode)) return false;
    double edge = __builtin_inf(), metres = __builtin_inf();
    for (const float per_metre : nodes.grid.per_metre) edge = std::min(edge, 1 / double(per_metre));
    for (int a = nodes.periodic ? 2 : 0; a < 3; ++a) {
        const double at = double(camera.origin[a]);
        const double whole = nodes.grid.size[a] / double(nodes.grid.per_metre[a]);
        metres = std::min(metres, std::min(at, whole - at));
    }
    return metres * nodes.depth / edge > kDeep;
}

void tell_ordinates(const OrdinateNodes& nodes, Report& report) {
    OrdinateFigures& out = report.ordinates;
    out.nodes += nodes.density.size();
    out.node_depth = std::max(out.node_depth, nodes.depth);
    for (const OrdinateSet& set : nodes.sets) {
        out.iterations = set.iterations > out.iterations ? set.iterations : out.iterations;
        out.residual = set.residual > out.residual ? set.residual : out.residual;
    }
}

}  // namespace pileus
