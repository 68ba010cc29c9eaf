// SPDX-License-Identifier: Apache-2.0
// See ordinates.h. Nodes, and their solutions.
// docs/ordinates.md
#include "src/picture/ordinates/ordinates.h"

#include <algorithm>

#include "src/picture/background.h"
#include "src/picture/ordinates/ordinate_ground.h"
#include "src/picture/ordinates/ordinate_half.h"
#include "src/picture/ordinates/ordinate_medium.h"
#include "src/picture/ordinates/ordinate_own.h"
#include "src/picture/ordinates/ordinate_ring.h"
#include "src/picture/ordinates/ordinate_solve.h"

namespace pileus {
namespace {

constexpr double kAcross = 12;  // nodes along the longest axis, at least
constexpr double kFewest = 32;  // nodes along an axis that optical depth may ask for

/// What is known of a light by the solution that is there for one before it.
void keep_solution(const OrdinateSet& before, OrdinateSet& set) {
    if (before.channel != set.channel || !before.solved) return;
    set.solved = true;
    set.same = set.beam == 0 && before.beam == 0 && set.own == 0 && before.own == 0 &&
               before.enters == set.enters && before.faces == set.faces;
    set.iterations = before.iterations;
    set.residual = before.residual;
}

/// Whether part of the work is enough: the ground has light of all sets, and no set waits that the
/// sun has no part in.
bool may_follow(const OrdinateNodes& nodes, bool ground) {
    for (std::size_t s = 0; s < nodes.sets.size(); ++s) {
        const OrdinateSet& set = nodes.sets[s];
        if (ground && !nodes.ground.known[s]) return false;
        if (set.beam == 0 && set.own == 0 && !(set.same && set.residual < kSolvedChange))
            return false;
    }
    return true;
}

/// Colours of what the ground sends up, as they were.
void keep_ground(const std::array<OrdinateSet, kMaxOrdinateSets>& before,
                 std::vector<OrdinateSet>& sets) {
    for (std::size_t s = 0; s < sets.size(); ++s)
        if (sets[s].ground) sets[s].colour = before[s].colour;
}

}  // namespace

NodeGrid ordinate_grid(const Medium& medium, double rest) {
    const double extinction = max_extinction(medium) * rest;
    const auto& e = medium.extent_m;
    double fewest[3], most[3];
    double spacing = std::min(2 * double(smallest_cell(medium.grid)),
                              std::max(e[0], std::max(e[1], e[2])) / kAcross);
    for (int a = 0; a < 3; ++a) {
        const double depth = extinction * medium.extent_m[a];
        // Light of a periodic medium differs along x and y by what lies in its voxels alone.
        fewest[a] = medium.grid.periodic && a < 2 ? 1 : std::max(1.0, std::min(depth, kFewest));
        most[a] = std::max(std::max(double(medium.grid.size[a]), e[a] / spacing), fewest[a]);
    }
    const auto along = [&](int a) {
        return std::min(std::max(medium.extent_m[a] / spacing, fewest[a]), most[a]);
    };
    // The fewest are within the budget, so this ends.
    static_assert(kFewest * kFewest * kFewest <= kMaxOrdinateNodes,
                  "the fewest nodes are too many");
    while (along(0) * along(1) * along(2) > kMaxOrdinateNodes) spacing *= 1.0625;
    NodeGrid g{};
    for (int a = 0; a < 3; ++a) {
        g.size[a] = std::max(1, int(along(a)));
        g.per_metre[a] = float(g.size[a] / medium.extent_m[a]);
    }
    return g;
}

std::uint64_t max_ordinate_nodes(const Medium& medium) {
    const NodeGrid all = ordinate_grid(medium, 1), none = ordinate_grid(medium, 0);
    for (int a = 0; a < 3; ++a)
        if (all.size[a] != none.size[a]) return std::uint64_t(kMaxOrdinateNodes);
    return node_count(all);
}

std::uint64_t max_ordinate_samples(const Medium& medium) {
    const std::uint64_t all = node_count(ordinate_samples(ordinate_grid(medium, 1), medium));
    const std::uint64_t none = node_count(ordinate_samples(ordinate_grid(medium, 0), medium));
    return all > none ? all : none;
}

namespace {

Status place_all_walls(const Context& context, const OrdinateSolids& solids, OrdinateNodes& nodes) {
    PILEUS_TRY(place_walls(context, *solids.meshes, solids.ground_z, nodes));
    return place_walls(context, *solids.meshes, solids.ground_z, nodes.half.nodes);
}

}  // namespace

OrdinateSolids ordinate_solids(const Lighting& lighting) {
    OrdinateSolids out;
    if (has_meshes(lighting)) out.meshes = lighting.solids;
    if (lighting.ground.present) out.ground_z = lighting.ground.z;
    return out;
}

Status prepare_ordinates(const Context& context, const Medium& medium, const Majorants& majorants,
                         const OrdinateSolids& solids, bool points, OrdinateNodes& out) {
    const StageClock clock(context, "ordinates");
    double rest = 0;
    PILEUS_TRY(prepare_optics(context, medium, points, out));
    for (int i = 0; i < out.media; ++i)
        for (const OrdinateOptics& optics : out.optics[i])
            rest = std::max(rest, double(optics.rest));
    out.grid = ordinate_grid(medium, rest);
    out.periodic = medium.grid.periodic;
    PILEUS_TRY(sample_ordinates(context, medium, majorants, solids.meshes, out));
    out.depth = node_depth(medium, out);
    set_mean_rest(out, out.mean_rest);
    PILEUS_TRY(make_half(out));
    weigh_half(out);
    out.walls = OrdinateWalls{};
    out.half.nodes.walls = OrdinateWalls{};
    return solids.meshes != nullptr ? place_all_walls(context, solids, out) : Status::ok();
}

double node_depth(const Medium& medium, const OrdinateNodes& out) {
    float thickest = 0, edge = 1 / out.grid.per_metre[0];
    for (std::size_t i = 0; i < out.density.size(); ++i)
        for (int c = 0; c < medium.channels; ++c)
            thickest = std::max(thickest, out.density[i] * ordinate_rest(out, out.parts, c, i));
    for (float per_metre : out.grid.per_metre) edge = std::min(edge, 1 / per_metre);
    return double(medium.sigma) * double(thickest) * double(edge);
}

Status reserve_ordinates(OrdinateNodes& out) {
    out.sets.reserve(kMaxOrdinateSets);
    PILEUS_TRY(hold(arrays::ordinate_solution(out.filled.size(), kMaxOrdinateSets), out.solution));
    PILEUS_TRY(reserve_half(kMaxOrdinateSets, out));
    out.shown.reserve(kMaxOrdinateSets);
    PILEUS_TRY(hold(arrays::ordinate_light(node_count(out.grid), kMaxShown, out.media), out.light));
    PILEUS_TRY(reserve_ground(out));
    PILEUS_TRY(hold_walls(kMaxOrdinateSets, true, out.walls));
    PILEUS_TRY(hold_walls(1, false, out.half.nodes.walls));
    return hold(arrays::ordinate_near(node_count(out.grid), kMaxShown, true), out.near);
}

bool unsolved(const OrdinateNodes& nodes) {
    for (const OrdinateSet& set : nodes.sets)
        if (!set.solved || !(set.residual < kSolvedChange)) return true;
    return false;
}

namespace {

/// Set `s` on nodes and on larger ones. kLimit: out of memory.
Status solve_set(const Context& context, const Medium& medium, const Lighting& lighting,
                 const OrdinateAsk& ask, std::size_t s, OrdinateSources from,
                 OrdinateSolver& solver, OrdinateSolver& larger, OrdinateNodes& out) {
    OrdinateSet& set = out.sets[s];
    float* const moments = out.solution.data() + s * out.filled.size() * kOrdinateMoments;
    if (begins(ask.iterations, set)) {
        PILEUS_TRY(solve_half(context, medium, out, lighting, ask, from, s, larger));
        if (!from.started) start_from_half(context, out, s, moments);
        from.started = true;
    } else {
        take_correction(context, out, s, moments);
        PILEUS_TRY(solve_half(context, medium, out, lighting, ask, from, s, larger));
    }
    PILEUS_TRY(solve_ordinates(context, medium, out, lighting, from, ask.iterations, solver, set,
                               moments));
    add_correction(context, out, s, moments);
    return Status::ok();
}

/// Sunlight on what ends ways between nodes, and between larger ones.
void light_all_surfaces(const Context& context, const Medium& medium, const Majorants& majorants,
                        const Lighting& lighting, OrdinateNodes& nodes) {
    for (OrdinateWalls* walls : {&nodes.walls, &nodes.half.nodes.walls})
        if (walls->any())
            light_surfaces(context, medium, majorants, lighting, nodes.mean_rest, *walls);
}

/// Ways end at the ground: where a host has moved it they are found again, and so is all light.
Status follow_ground(const Context& context, const Lighting& lighting, OrdinateNodes& nodes) {
    const OrdinateSolids solids = ordinate_solids(lighting);
    if (solids.meshes == nullptr || nodes.ring || nodes.walls.ground_z == solids.ground_z)
        return Status::ok();
    PILEUS_TRY(place_all_walls(context, solids, nodes));
    nodes.ground.known.fill(false);
    for (OrdinateSet& set : nodes.sets) set.solved = false;
    return Status::ok();
}

}  // namespace

Status make_ordinates(const Context& context, const Medium& medium, const Majorants& majorants,
                      const Lighting& lighting, const OrdinateAsk& ask, OrdinateNodes& out) {
    const StageClock clock(context, "ordinates");
    PILEUS_TRY(follow_ground(context, lighting, out));
    std::array<OrdinateSet, kMaxOrdinateSets> before;
    const std::size_t held = out.sets.size();
    std::copy(out.sets.begin(), out.sets.end(), before.begin());
    set_ordinate_lights(medium, lighting, ask, out.walls.any(), out.sets);
    out.near_made = false;
    const std::uint64_t nodes = out.filled.size();
    if (out.solution.size() < nodes * kOrdinateMoments * out.sets.size()) {
        PILEUS_TRY(allocate(arrays::ordinate_solution(nodes, out.sets.size()), out.solution));
    } else if (held == out.sets.size()) {
        for (std::size_t s = 0; s < held; ++s) keep_solution(before[s], out.sets[s]);
    }
    PILEUS_TRY(reserve_half(out.sets.size(), out));
    PILEUS_TRY(hold_walls(out.sets.size(), true, out.walls));
    const bool ground = lights_ground(medium, lighting, ask, out);
    out.ground.map.size[0] = ground ? out.ground.map.size[0] : 0;
    if (ground) PILEUS_TRY(place_ground(context, medium, lighting, out));
    const bool part = held == out.sets.size() && may_follow(out, ground);
    const OrdinateFollow* const follow = part ? ask.follow : nullptr;
    Buffer<float> unkept, unkept_beam, own, ring;
    Buffer<float>& depths = ask.depths != nullptr ? *ask.depths : unkept;
    Buffer<float>& beams = ask.keeps_beam ? out.beam : unkept_beam;
    int shine = 0;
    for (const OrdinateSet& set : out.sets) shine += set.beam > 0 ? 1 : 0;
    if (shine > 0) {
        if (!ask.sampled && follow == nullptr)
            PILEUS_TRY(sample_sun(context, medium, majorants, lighting, ask.sun, out, depths));
        if (follow == nullptr) light_all_surfaces(context, medium, majorants, lighting, out);
        PILEUS_TRY(hold(arrays::ordinate_beams(nodes, ask.keeps_beam ? shine : 1), beams));
    }
    if (follow != nullptr) keep_ground(before, out.sets);
    const bool grounds = ground && (follow == nullptr || !follow->solve);
    OrdinateSolver solver, larger;
    float* beam = beams.data();
    for (std::size_t s = 0; s < out.sets.size(); ++s) {
        OrdinateSet& set = out.sets[s];
        if (ask.only >= 0 && std::size_t(ask.only) != s) continue;
        const bool solved =
            (set.same && set.residual < kSolvedChange) || (follow != nullptr && !follow->solve);
        if (set.same && solved && (!ground || out.ground.known[s])) continue;
        OrdinateSources from;
        from.walls = out.walls.any() ? &out.walls : nullptr;
        from.set = s;
        if (set.beam > 0) {
            from.beam = beam;
            if (follow != nullptr)
                follow_nodes(context, medium, out, lighting, set.channel, *ask.sun, *follow, beam);
            else
                light_nodes(context, medium, out, lighting, set.channel, ask.sun == nullptr, depths,
                            beam);
            beam += ask.keeps_beam ? nodes : 0;
        }
        PILEUS_TRY(own_light(context, medium, out, ask, set, own, from.fixed));
        if (out.ring)
            PILEUS_TRY(
                light_ring(context, ask.coarser, s, begins(ask.iterations, set), out, ring, from));
        if (!solved)
            PILEUS_TRY(solve_set(context, medium, lighting, ask, s, from, solver, larger, out));
        if (grounds) PILEUS_TRY(light_ground(context, medium, lighting, from, s, solver, out));
    }
    if (grounds) PILEUS_TRY(mix_ground(context, medium, majorants, lighting, out));
    mix_walls(out.sets, out.walls);
    return Status::ok();
}

}  // namespace pileus
