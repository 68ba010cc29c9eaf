// SPDX-License-Identifier: Apache-2.0
// See ordinate_half.h.
#include "src/picture/ordinates/ordinate_half.h"

#include <algorithm>

#include "platform/threads.h"
#include "src/picture/ordinates/ordinate_ring.h"

namespace pileus {
namespace {

/// The larger node that a node lies in.
std::size_t parent_node(const NodeGrid& grid, const NodeGrid& larger, std::size_t node) {
    NodePlace p = node_place(grid, node);
    for (int& at : p) at /= 2;
    return node_number(larger, p);
}

/// Means over the children of each larger node, by density.
void gather_children(const OrdinateNodes& nodes, const float* from, float* to) {
    const OrdinateHalf& half = nodes.half;
    std::fill_n(to, half.nodes.filled.size(), 0.0f);
    for (std::size_t n = 0; n < nodes.filled.size(); ++n)
        if (half.parent[n] >= 0) to[std::size_t(half.parent[n])] += half.share[n] * from[n];
}

/// The larger nodes around a node that hold medium, by their numbers; weights sum to 1 or 0.
struct Around {
    int count = 0;
    std::size_t number[8];
    float weight[8];
};
Around nodes_around(const OrdinateNodes& nodes, std::size_t node) {
    const OrdinateHalf& half = nodes.half;
    const NodeGrid& larger = half.nodes.grid;
    const NodePlace at = node_place(nodes.grid, node);
    int two[3][2];
    float share[3];
    for (std::size_t a = 0; a < 3; ++a) {
        // Middles of nodes lie a quarter of a larger node beside its own.
        const bool first = at[a] % 2 == 0, single = nodes.grid.size[a] == 1;
        const int size = larger.size[a], low = single ? 0 : at[a] / 2 - (first ? 1 : 0);
        share[a] = single ? 0.0f : first ? 0.75f : 0.25f;
        for (int i = 0; i < 2; ++i) {
            int p = low + i;
            if (nodes.periodic && a < 2) p = (p + size) % size;
            two[a][i] = std::max(0, std::min(p, size - 1));
        }
    }
    Around out;
    float sum = 0;
    for (int i = 0; i < 8; ++i) {
        const int x = i & 1, y = i >> 1 & 1, z = i >> 2;
        const float weight = (x == 1 ? share[0] : 1 - share[0]) *
                             (y == 1 ? share[1] : 1 - share[1]) *
                             (z == 1 ? share[2] : 1 - share[2]);
        const std::int32_t number =
            half.number[node_number(larger, {two[0][x], two[1][y], two[2][z]})];
        if (number < 0 || !(weight > 0)) continue;
        out.number[out.count] = std::size_t(number);
        out.weight[out.count++] = weight;
        sum += weight;
    }
    for (int i = 0; i < out.count; ++i) out.weight[i] /= sum;
    return out;
}

/// Adds so many times the correction.
void correct(const Context& context, const OrdinateNodes& nodes, std::size_t s, float times,
             float* moments) {
    const std::size_t filled = nodes.filled.size(), larger = nodes.half.nodes.filled.size();
    const float* correction = nodes.half.correction.data() + s * larger * kOrdinateMoments;
    parallel_each(context.threads, filled, [&](std::size_t n) {
        const Around around = nodes_around(nodes, std::size_t(nodes.filled[n]));
        for (std::size_t m = 0; m < kOrdinateMoments; ++m) {
            float sum = 0;
            for (int i = 0; i < around.count; ++i)
                sum += around.weight[i] * correction[m * larger + around.number[i]];
            moments[m * filled + n] += times * sum;
        }
    });
}

}  // namespace

Status make_half(OrdinateNodes& nodes) {
    OrdinateHalf& half = nodes.half;
    OrdinateCells& larger = half.nodes;
    larger.media = nodes.media;
    larger.periodic = nodes.periodic;
    larger.ring = nodes.ring;
    for (int i = 0; i < nodes.media; ++i) std::copy_n(nodes.optics[i], 3, larger.optics[i]);
    for (int a = 0; a < 3; ++a) {
        const int n = nodes.grid.size[a];
        larger.grid.size[a] = (n + 1) / 2;
        larger.grid.per_metre[a] = nodes.grid.per_metre[a] * (n > 1 ? 0.5f : 1.0f);
    }
    const std::size_t all = std::size_t(node_count(larger.grid)), filled = nodes.filled.size();
    PILEUS_TRY(allocate(arrays::ordinate_nodes(all, Stage::kWrite), larger.density));
    PILEUS_TRY(allocate(arrays::ordinate_places(all, Stage::kWrite), half.number));
    PILEUS_TRY(allocate(arrays::ordinate_places(filled, Stage::kWrite), half.parent));
    PILEUS_TRY(allocate(arrays::ordinate_nodes(filled, Stage::kWrite), half.share));
    for (std::size_t n = 0; n < filled; ++n)
        half.number[parent_node(nodes.grid, larger.grid, std::size_t(nodes.filled[n]))] = 1;
    if (nodes.ring)
        each_of_ring(larger.grid, [&](std::size_t, std::size_t i) { half.number[i] = 0; });
    std::int32_t count = 0;
    for (std::int32_t& number : half.number.span()) number = number > 0 ? count++ : -1;
    PILEUS_TRY(
        allocate(arrays::ordinate_places(std::uint64_t(count), Stage::kWrite), larger.filled));
    for (std::size_t i = 0; i < all; ++i)
        if (half.number[i] >= 0) larger.filled[std::size_t(half.number[i])] = std::int32_t(i);
    for (std::size_t n = 0; n < filled; ++n)
        half.parent[n] =
            half.number[parent_node(nodes.grid, larger.grid, std::size_t(nodes.filled[n]))];
    if (nodes.media > 1)
        PILEUS_TRY(allocate(arrays::ordinate_parts(all, nodes.media), larger.parts));
    return Status::ok();
}

void weigh_half(OrdinateNodes& nodes) {
    OrdinateHalf& half = nodes.half;
    OrdinateCells& larger = half.nodes;
    const std::size_t all = larger.density.size(), count = nodes.density.size();
    float children = 1;
    for (const int n : nodes.grid.size) children *= n > 1 ? 2.0f : 1.0f;
    // Calls use(number, node, larger node) for those in one that counts as filled.
    const auto each_child = [&](const auto& use) {
        for (std::size_t n = 0; n < nodes.filled.size(); ++n)
            if (half.parent[n] >= 0)
                use(n, std::size_t(nodes.filled[n]),
                    std::size_t(larger.filled[std::size_t(half.parent[n])]));
    };
    std::fill_n(larger.density.data(), all, 0.0f);
    std::fill_n(larger.parts.data(), larger.parts.size(), 0.0f);
    each_child(
        [&](std::size_t, std::size_t i, std::size_t p) { larger.density[p] += nodes.density[i]; });
    each_child([&](std::size_t n, std::size_t i, std::size_t p) {
        const float whole = larger.density[p];
        half.share[n] = whole > 0 ? nodes.density[i] / whole : 1 / children;
        for (std::size_t m = 0; m < std::size_t(nodes.media) && nodes.media > 1; ++m)
            larger.parts[m * all + p] += half.share[n] * nodes.parts[m * count + i];
    });
    for (float& density : larger.density.span()) density /= children;
}

Status reserve_half(std::uint64_t sets, OrdinateNodes& nodes) {
    const Array<float> solution = arrays::ordinate_solution(nodes.half.nodes.filled.size(), sets);
    PILEUS_TRY(hold(solution, nodes.half.nodes.solution));
    return hold(solution, nodes.half.correction);
}

Status solve_half(const Context& context, const Medium& medium, OrdinateNodes& nodes,
                  const Lighting& lighting, const OrdinateAsk& ask, const OrdinateSources& from,
                  std::size_t s, OrdinateSolver& solver) {
    OrdinateCells& larger = nodes.half.nodes;
    const std::size_t filled = larger.filled.size();
    Buffer<float> beam, fixed, ring;
    OrdinateSources own;
    if (from.beam != nullptr) {
        PILEUS_TRY(allocate(arrays::ordinate_nodes(filled, Stage::kShadow), beam));
        gather_children(nodes, from.beam, beam.data());
        own.beam = beam.data();
    }
    if (from.fixed != nullptr) {
        PILEUS_TRY(allocate(arrays::ordinate_own(filled, true), fixed));
        for (std::size_t j = 0; j < kOrdinates; ++j)
            gather_children(nodes, from.fixed + j * nodes.filled.size(), fixed.data() + j * filled);
        own.fixed = fixed.data();
    }
    if (larger.ring) {
        // Places among the larger nodes' larger ones.
        OrdinateCoarser coarser = ask.coarser;
        coarser.nodes = ask.coarser.larger;
        for (std::size_t a = 0; a < 2; ++a)
            coarser.first[a] = 0.5 * (ask.coarser.first[a] + 0.5 * ask.coarser.step[a] + 0.5) - 0.5;
        PILEUS_TRY(light_ring(context, coarser, s, true, larger, ring, own));
    }
    PILEUS_TRY(hold_walls(1, false, larger.walls));
    own.walls = larger.walls.any() ? &larger.walls : nullptr;
    OrdinateSet set = nodes.sets[s];
    set.solved = false;
    return solve_ordinates(context, medium, larger, lighting, own, 0, solver, set,
                           larger.solution.data() + s * filled * kOrdinateMoments);
}

void start_from_half(const Context& context, const OrdinateNodes& nodes, std::size_t s,
                     float* moments) {
    const OrdinateHalf& half = nodes.half;
    const std::size_t filled = nodes.filled.size(), larger = half.nodes.filled.size();
    const float* from = half.nodes.solution.data() + s * larger * kOrdinateMoments;
    parallel_each(context.threads, filled, [&](std::size_t n) {
        for (std::size_t m = 0; m < kOrdinateMoments; ++m)
            moments[m * filled + n] = from[m * larger + std::size_t(half.parent[n])];
    });
}

void add_correction(const Context& context, OrdinateNodes& nodes, std::size_t s, float* moments) {
    const std::size_t filled = nodes.filled.size(), larger = nodes.half.nodes.filled.size();
    const std::size_t first = s * larger * kOrdinateMoments;
    const float* from = nodes.half.nodes.solution.data() + first;
    float* to = nodes.half.correction.data() + first;
    parallel_for(context.threads, kOrdinateMoments, [&](std::int64_t m, int) {
        gather_children(nodes, moments + std::size_t(m) * filled, to + std::size_t(m) * larger);
    });
    parallel_each(context.threads, larger, [&](std::size_t p) {
        const float limit = kMaxCorrection * to[p];
        const float off = kOrderShare * (to[p] - from[p]), size = off < 0 ? -off : off;
        const float kept = kOrderShare * (size > limit ? limit / size : 1.0f);
        for (std::size_t i = p; i < kOrdinateMoments * larger; i += larger)
            to[i] = kept * (to[i] - from[i]);
    });
    correct(context, nodes, s, 1, moments);
}

void take_correction(const Context& context, const OrdinateNodes& nodes, std::size_t s,
                     float* moments) {
    correct(context, nodes, s, -1, moments);
}

}  // namespace pileus
