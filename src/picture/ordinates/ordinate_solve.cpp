// SPDX-License-Identifier: Apache-2.0
// See ordinate_solve.h.
#include "src/picture/ordinates/ordinate_solve.h"

#include <algorithm>
#include <cmath>

#include "kernels_cpu/core/sh.h"
#include "platform/threads.h"
#include "src/picture/ordinates/ordinate_medium.h"

namespace pileus {
namespace {

constexpr int kMaxIterations = 64;
constexpr double kFarther = 2;  // than the least change so far: mixing begins anew

/// Places in the shared memory.
struct Work {
    float *radiance, *pass, *mean;
    float* last;                       ///< [kSlowMoments]: what the iteration began with
    float* before;                     ///< [kSlowMoments]: the iteration before's result
    float* steps[kMixedIterations];    ///< [kSlowMoments]: differences of results
    float* last_change;                ///< of the mean radiance
    float* changes[kMixedIterations];  ///< differences of changes
};

Work share_work(float* from, std::size_t nodes, std::size_t filled) {
    Work w{};
    const auto take = [&](std::size_t numbers) {
        float* own = from;
        from += numbers;
        return own;
    };
    w.radiance = take(kOrdinates * nodes);
    w.pass = take(kOrdinateClasses * nodes);
    w.mean = take(kOrdinateClasses * nodes);
    w.last = take(kSlowMoments * filled);
    w.before = take(kSlowMoments * filled);
    for (float*& step : w.steps) step = take(kSlowMoments * filled);
    w.last_change = take(filled);
    for (float*& change : w.changes) change = take(filled);
    return w;
}

std::size_t place_along_x(const NodeGrid& grid, std::size_t node) {
    return place_along_x(grid, node_place(grid, node));
}

/// A ring's nodes send on what enters there, and nothing else.
void set_ring(const OrdinateCells& nodes, const OrdinatesParams& k, const float* ring,
              const Work& w) {
    const std::size_t count = nodes.density.size(), of_ring = std::size_t(ring_count(nodes.grid));
    for (std::size_t j = 0; j < kOrdinates; ++j) {
        float* to = w.radiance + j * count;
        const bool along_x = k.sweep[j].axis == 0;
        each_of_ring(nodes.grid, [&](std::size_t r, std::size_t i) {
            to[along_x ? place_along_x(nodes.grid, i) : i] = ring[j * of_ring + r];
        });
    }
}

/// Of the way through a node: what passes, and the mean of what is on the way.
void set_ways(const Context& context, const Medium& medium, const OrdinateCells& nodes, int channel,
              const OrdinateWay (&way)[kOrdinateClasses], const std::int32_t* place_x,
              const Work& w) {
    const std::size_t count = nodes.density.size();
    for (std::size_t c = 0; c < kOrdinateClasses && way[c].length_m > 0; ++c) {
        const float per_density = medium.sigma * float(way[c].length_m);
        std::fill_n(w.pass + c * count, count, 1.0f);
        std::fill_n(w.mean + c * count, count, 0.0f);
        parallel_each(context.threads, nodes.filled.size(), [&](std::size_t n) {
            const auto i = std::size_t(nodes.filled[n]);
            const float rest = ordinate_rest(nodes, nodes.parts, channel, i);
            const float t = nodes.density[i] * (rest * per_density);
            const std::size_t at = c * count + (way[c].along_x ? std::size_t(place_x[n]) : i);
            w.pass[at] = exp_(-t);
            w.mean[at] = t > 1e-6f ? one_minus_exp(t) / t : 1.0f;
        });
        // Empty ones beside solids hold what comes through.
        for (const std::int32_t i : nodes.walls.nodes.span()) {
            const auto node = std::size_t(i);
            const std::size_t at =
                c * count + (way[c].along_x ? place_along_x(nodes.grid, node) : node);
            if (!(nodes.density[node] > 0)) w.mean[at] = 1;
        }
        if (nodes.ring)
            each_of_ring(nodes.grid, [&](std::size_t, std::size_t i) {
                const std::size_t at =
                    c * count + (way[c].along_x ? place_along_x(nodes.grid, i) : i);
                w.pass[at] = 0;
            });
    }
}

/// Places of nodes where slices are along x: y fastest, then z.
void set_places(const OrdinateCells& nodes, Buffer<std::int32_t>& place_x) {
    for (std::size_t i = 0; i < nodes.filled.size(); ++i)
        place_x[i] = std::int32_t(place_along_x(nodes.grid, std::size_t(nodes.filled[i])));
}

/// Parts of media of the extinction that counts.
Status set_parts(const Context& context, const OrdinateCells& nodes, int channel,
                 Buffer<float>& parts) {
    if (nodes.media == 1) return Status::ok();
    const std::size_t count = nodes.density.size(), filled = nodes.filled.size();
    PILEUS_TRY(allocate_once(arrays::ordinate_part_work(filled, nodes.media), parts));
    parallel_each(context.threads, filled, [&](std::size_t n) {
        const auto i = std::size_t(nodes.filled[n]);
        const float rest = std::max(ordinate_rest(nodes, nodes.parts, channel, i), 1e-6f);
        for (std::size_t m = 0; m < std::size_t(nodes.media); ++m)
            parts[m * filled + n] =
                nodes.parts[m * count + i] * nodes.optics[m][channel].rest / rest;
    });
    return Status::ok();
}

OrdinatesParams params_of(const OrdinateCells& nodes, bool periodic, const Lighting& lighting,
                          const OrdinateSet& set, OrdinateWay (&way)[kOrdinateClasses]) {
    OrdinatesParams k{};
    k.filled = std::int32_t(nodes.filled.size());
    for (int a = 0; a < 3; ++a) k.size[a] = nodes.grid.size[a];
    k.periodic = periodic ? 1 : 0;
    set_ordinate_sweeps(nodes.grid, periodic, way, k);
    float sun[kOrdinateMoments];
    sh_eval<4>(-lighting.to_sun[0], -lighting.to_sun[1], -lighting.to_sun[2], sun);
    set_ordinate_harmonics(k.harmonic);
    for (int j = 0; j < kOrdinates; ++j) {
        k.weight[j] = float(ordinate_weight(j));
        const float enters = set.enters[std::size_t(j)];
        k.enters[j] = goes_up(j) && set.faces == OrdinateFaces::kLower ? 0 : enters;
        k.below[j] = goes_up(j) && set.faces == OrdinateFaces::kSides ? 0 : enters;
    }
    k.media = nodes.media;
    for (int i = 0; i < k.media; ++i) {
        const OrdinateOptics& optics = nodes.optics[i][set.channel];
        for (int l = 0; l < 4; ++l) k.scatter[i][l] = ordinate_scatter(optics, l);
        scatter_moments(sun, k.scatter[i], k.harmonic, set.beam * optics.albedo, k.beam[i]);
    }
    return k;
}

/// One solution at work.
struct AtWork {
    OrdinatesParams k;
    OrdinatesBuffers b;
    Work work;
    OrdinateWay way[kOrdinateClasses];
    std::int64_t slice_floats;
    OrdinateWalls* walls;
    WallLight on_walls;
};

constexpr std::int64_t kPiece = 512;
std::int64_t pieces_of(const OrdinatesParams& k) { return (k.filled + kPiece - 1) / kPiece; }
std::uint32_t end_of(const OrdinatesParams& k, std::int64_t piece) {
    return std::uint32_t(std::min(std::int64_t(k.filled), (piece + 1) * kPiece));
}

/// Sources from moments, and those of so many directions through all nodes.
void sweep(const Context& context, const OrdinateCells& nodes, const AtWork& a) {
    parallel_for(context.threads, pieces_of(a.k), [&](std::int64_t p, int) {
        host_kernels(context.kernels)
            .ordinate_sources(a.k, a.b, std::uint32_t(p * kPiece), end_of(a.k, p));
    });
    if (a.walls != nullptr) keep_sources(context, nodes, a.on_walls, *a.walls);
    parallel_for(context.threads, kOrdinates, [&](std::int64_t j, int thread) {
        OrdinatesBuffers own = a.b;
        own.slices = a.b.slices + a.slice_floats * thread;
        host_kernels(context.kernels)
            .ordinate_directions(a.k, own, std::uint32_t(j), std::uint32_t(j) + 1);
    });
}

/// Returns what light of solids changes by.
double iterate(const Context& context, const OrdinateCells& nodes, const AtWork& a) {
    sweep(context, nodes, a);
    const double change =
        a.walls != nullptr ? light_walls(context, nodes, a.on_walls, false, 0, *a.walls) : 0;
    parallel_for(context.threads, pieces_of(a.k), [&](std::int64_t p, int) {
        host_kernels(context.kernels)
            .ordinate_moments(a.k, a.b, std::uint32_t(p * kPiece), end_of(a.k, p));
    });
    return change;
}

/// Solves the least squares of a few unknowns, by Cholesky's way; false: they are not independent.
bool least_squares(int n, double (&a)[kMixedIterations][kMixedIterations],
                   double (&x)[kMixedIterations]) {
    for (int i = 0; i < n; ++i) a[i][i] *= 1 + 1e-10;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j <= i; ++j) {
            double sum = a[i][j];
            for (int l = 0; l < j; ++l) sum -= a[i][l] * a[j][l];
            if (i == j) {
                if (!(sum > 0)) return false;
                a[i][i] = __builtin_sqrt(sum);
            } else {
                a[i][j] = sum / a[j][j];
            }
        }
    }
    for (int i = 0; i < n; ++i) {
        for (int l = 0; l < i; ++l) x[i] -= a[i][l] * x[l];
        x[i] /= a[i][i];
    }
    for (int i = n - 1; i >= 0; --i) {
        for (int l = i + 1; l < n; ++l) x[i] -= a[l][i] * x[l];
        x[i] /= a[i][i];
    }
    return true;
}

double dot(const float* a, const float* b, std::size_t count) {
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += double(a[i]) * double(b[i]);
    return sum;
}

/// Takes the result of iteration `turn` in `moments`, and changes it to what the next begins with.
void mix(int turn, std::size_t nodes, const Work& w, float* moments) {
    // The change of this iteration, where `last` was its beginning.
    for (std::size_t i = 0; i < nodes; ++i) w.last[i] = moments[i] - w.last[i];
    float* const change = w.last;
    const int slot = (turn - 1) % kMixedIterations, held = std::min(turn, kMixedIterations);
    if (turn > 0) {
        for (std::size_t i = 0; i < nodes; ++i) w.changes[slot][i] = change[i] - w.last_change[i];
        for (std::size_t i = 0; i < kSlowMoments * nodes; ++i)
            w.steps[slot][i] = moments[i] - w.before[i];
    }
    std::copy_n(moments, kSlowMoments * nodes, w.before);
    std::copy_n(change, nodes, w.last_change);
    double a[kMixedIterations][kMixedIterations] = {}, x[kMixedIterations] = {};
    for (int i = 0; i < held; ++i) {
        for (int j = 0; j <= i; ++j) a[i][j] = dot(w.changes[i], w.changes[j], nodes);
        x[i] = dot(w.changes[i], change, nodes);
    }
    if (held == 0 || !least_squares(held, a, x)) return;
    for (int j = 0; j < held; ++j) {
        const float share = float(x[j]);
        for (std::size_t i = 0; i < kSlowMoments * nodes; ++i) moments[i] -= share * w.steps[j][i];
    }
}

/// Solids as the last solution of the set left them.
void set_walls(const OrdinateSources& from, const OrdinateSet& set, AtWork& a) {
    OrdinateWalls& walls = *(a.walls = from.walls);
    const std::size_t count = walls.ways.size();
    WallLight& light = a.on_walls;
    light.radiance = a.b.radiance;
    light.pass = a.work.pass, light.mean = a.work.mean, light.sweeps = a.k.sweep;
    light.enters = set.enters.data();
    light.set = &set;
    light.sends = walls.sends.data() + from.set * count;
    light.around = walls.around.empty()
                       ? nullptr
                       : walls.around.data() + from.set * kAroundTerms * walls.nodes.size();
    for (std::size_t i = 0; i < count; ++i) walls.ways[i].sends = light.sends[i];
    a.b.walls = walls.ways.data();
    a.b.first_wall = walls.first.data();
}

Status set_work(const Context& context, const Medium& medium, const OrdinateCells& nodes,
                const Lighting& lighting, const OrdinateSources& from, OrdinateSolver& solver,
                const OrdinateSet& set, float* moments, AtWork& a) {
    const std::size_t count = nodes.filled.size(), all = nodes.density.size();
    PILEUS_TRY(allocate_once(arrays::ordinate_work(all, count), solver.work));
    PILEUS_TRY(allocate_once(arrays::ordinate_places(count, Stage::kShadow), solver.place_x));
    const Work w = a.work = share_work(solver.work.data(), all, count);
    a.k = params_of(nodes, nodes.periodic, lighting, set, a.way);
    a.slice_floats = 0;
    for (const OrdinateSweep& s : a.k.sweep)
        a.slice_floats = std::max(a.slice_floats, ordinate_slice_floats(a.k, s));
    PILEUS_TRY(solver.slices.resize(std::uint64_t(a.slice_floats) * std::uint64_t(context.threads),
                                    "ordinates: slices"));
    if (solver.channel < 0) set_places(nodes, solver.place_x);
    // Empty nodes have no source.
    if (solver.channel < 0 || solver.left)
        parallel_for(context.threads, kOrdinates, [&](std::int64_t j, int) {
            std::fill_n(w.radiance + std::size_t(j) * all, all, 0.0f);
        });
    solver.left = false;
    if (solver.channel != set.channel) {
        set_ways(context, medium, nodes, set.channel, a.way, solver.place_x.data(), w);
        PILEUS_TRY(set_parts(context, nodes, set.channel, solver.parts));
    }
    solver.channel = set.channel;
    a.b = OrdinatesBuffers{};
    a.b.place = nodes.filled.data(), a.b.place_x = solver.place_x.data();
    a.b.pass = w.pass, a.b.mean = w.mean, a.b.beam = from.beam, a.b.fixed = from.fixed,
    a.b.part = solver.parts.data();
    a.b.radiance = w.radiance, a.b.moments = moments, a.b.slices = solver.slices.data();
    if (from.ring != nullptr) set_ring(nodes, a.k, from.ring, w);
    if (from.walls != nullptr) set_walls(from, set, a);
    return Status::ok();
}

}  // namespace

Status leave_nodes(const Context& context, const Medium& medium, const OrdinateCells& nodes,
                   const Lighting& lighting, const OrdinateSources& from, OrdinateSolver& solver,
                   const OrdinateSet& set, float* moments, OrdinateLeaving& out) {
    AtWork a{};
    PILEUS_TRY(set_work(context, medium, nodes, lighting, from, solver, set, moments, a));
    // What leaves a node takes the place of the mean on the way through it.
    a.b.mean = a.b.pass;
    sweep(context, nodes, a);
    solver.left = true;
    out.radiance = a.b.radiance;
    for (std::size_t j = 0; j < kOrdinates; ++j) {
        const OrdinateSweep& s = a.k.sweep[j];
        out.length_m[j] = float(a.way[s.length].length_m);
        out.along_x[j] = s.axis == 0;
    }
    return Status::ok();
}

Status solve_ordinates(const Context& context, const Medium& medium, const OrdinateCells& nodes,
                       const Lighting& lighting, const OrdinateSources& from, int iterations,
                       OrdinateSolver& solver, OrdinateSet& set, float* moments) {
    AtWork a{};
    PILEUS_TRY(set_work(context, medium, nodes, lighting, from, solver, set, moments, a));
    const Work& w = a.work;
    const OrdinatesParams& k = a.k;
    const std::size_t count = nodes.filled.size();
    const bool begun = begins(iterations, set);
    float mean = 0;
    for (int j = 0; j < kOrdinates; ++j)
        mean += k.weight[j] * k.harmonic[j][0] * 0.5f * (k.enters[j] + k.below[j]);
    if (begun && a.walls != nullptr)
        light_walls(context, nodes, a.on_walls, true, mean * k.harmonic[0][0], *a.walls);
    if (begun && !from.started) {
        // Where nothing is absorbed, much of what is within is as bright as what enters.
        std::fill_n(moments, count, mean);
        std::fill_n(moments + count, count * (kOrdinateMoments - 1), 0.0f);
    }
    const int most = begun ? kMaxIterations : std::min(iterations, kMaxIterations);
    double least = 0;
    int first = 0;  // of the iterations that are mixed
    for (set.iterations = 0; set.iterations < most;) {
        std::copy_n(moments, kSlowMoments * count, w.last);
        const double of_walls = iterate(context, nodes, a);
        double change = 0, norm = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const double now = double(moments[i]), off = now - double(w.last[i]);
            change += off * off, norm += now * now;
        }
        set.residual = std::max(norm > 0 ? __builtin_sqrt(change / norm) : 0, of_walls);
        if (++set.iterations == most || set.residual < kSolvedChange) break;
        // A mixed start may lead away: what came before counts no more then.
        if (set.iterations - 1 > first && set.residual > kFarther * least)
            first = set.iterations - 1;
        if (set.iterations - 1 == first || set.residual < least) least = set.residual;
        mix(set.iterations - 1 - first, count, w, moments);
    }
    set.solved = true;
    return Status::ok();
}

}  // namespace pileus
