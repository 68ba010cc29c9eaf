// SPDX-License-Identifier: Apache-2.0
// See ordinate_solve.h.
#include "src/picture/ordinates/ordinate_solve.h"

#include <algorithm>
#include <cmath>

#include "kernels_cpu/core/sh.h"
#include "platform/threads.h"

namespace pileus {
namespace {

constexpr int kMaxIterations = 64;
constexpr double kEnough = 2e-4;  // change of the mean radiance over its norm

/// Places in the shared memory.
struct Work {
    float *radiance, *pass, *mean;
    float* last;                       ///< [kSlowMoments]: what the iteration began with
    float* before;                     ///< [kSlowMoments]: the iteration before's result
    float* steps[kMixedIterations];    ///< [kSlowMoments]: differences of results
    float* last_change;                ///< of the mean radiance
    float* changes[kMixedIterations];  ///< differences of changes
};

Work share_work(float* from, std::size_t nodes) {
    Work w{};
    const auto take = [&](std::size_t arrays) {
        float* own = from;
        from += arrays * nodes;
        return own;
    };
    w.radiance = take(kOrdinates);
    w.pass = take(kOrdinateClasses);
    w.mean = take(kOrdinateClasses);
    w.last = take(kSlowMoments);
    w.before = take(kSlowMoments);
    for (float*& step : w.steps) step = take(kSlowMoments);
    w.last_change = take(1);
    for (float*& change : w.changes) change = take(1);
    return w;
}

/// Of the way through a node: what passes, and the mean of what is on the way.
void set_ways(const Context& context, const Medium& medium, const OrdinateNodes& nodes, float rest,
              const double (&length_m)[kOrdinateClasses], const Work& w) {
    const std::size_t count = nodes.density.size();
    for (std::size_t c = 0; c < kOrdinateClasses && length_m[c] > 0; ++c) {
        const float per_density = rest * medium.sigma * float(length_m[c]);
        parallel_each(context.threads, count, [&](std::size_t i) {
            const float t = nodes.density[i] * per_density;
            w.pass[c * count + i] = exp_(-t);
            w.mean[c * count + i] = t > 1e-6f ? one_minus_exp(t) / t : 1.0f;
        });
    }
}

OrdinatesParams params_of(const OrdinateNodes& nodes, bool periodic, const OrdinateOptics& optics,
                          const Lighting& lighting, const OrdinateSet& set,
                          double (&length_m)[kOrdinateClasses]) {
    OrdinatesParams k{};
    for (int a = 0; a < 3; ++a) k.size[a] = nodes.grid.size[a];
    k.periodic = periodic ? 1 : 0;
    set_ordinate_sweeps(nodes.grid, periodic, length_m, k);
    for (int m = 0; m < kOrdinateMoments; ++m) k.scatter[m] = ordinate_scatter(optics, m);
    float sun[kOrdinateMoments];
    float sum = 0;
    sh_eval<4>(-lighting.to_sun[0], -lighting.to_sun[1], -lighting.to_sun[2], sun);
    for (int j = 0; j < kOrdinates; ++j) {
        const std::array<double, 3> d = ordinate_direction(j);
        sh_eval<4>(float(d[0]), float(d[1]), float(d[2]), k.harmonic[j]);
        k.weight[j] = float(ordinate_weight(j));
        k.enters[j] = set.enters[std::size_t(j)];
        float share = 0;
        for (int m = 0; m < kOrdinateMoments; ++m)
            share += k.scatter[m] * k.harmonic[j][m] * sun[m];
        k.beam[j] = std::max(share, 0.0f);
        sum += k.beam[j] * k.weight[j];
    }
    // What is scattered is all of it, where parts of the phase function were negative, too.
    for (float& share : k.beam) share *= sum > 0 ? set.beam * optics.albedo / sum : 0.0f;
    return k;
}

void iterate(const Context& context, const OrdinatesParams& k, const OrdinatesBuffers& b,
             std::int64_t slice_floats) {
    parallel_for(context.threads, kOrdinates, [&](std::int64_t j, int thread) {
        OrdinatesBuffers own = b;
        own.slices = b.slices + slice_floats * thread;
        context.kernels->ordinate_directions(k, own, std::uint32_t(j), std::uint32_t(j) + 1);
    });
    parallel_for(context.threads, k.size[2], [&](std::int64_t z, int) {
        context.kernels->ordinate_moments(k, b, std::uint32_t(z), std::uint32_t(z) + 1);
    });
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

}  // namespace

Status solve_ordinates(const Context& context, const Medium& medium, const OrdinateNodes& nodes,
                       const OrdinateOptics& optics, const Lighting& lighting, const float* beam,
                       OrdinateSolver& solver, OrdinateSet& set, float* moments) {
    const std::size_t count = std::size_t(node_count(nodes.grid));
    PILEUS_TRY(allocate_once(arrays::ordinate_work(count), solver.work));
    const Work w = share_work(solver.work.data(), count);
    double length_m[kOrdinateClasses] = {};
    const OrdinatesParams k =
        params_of(nodes, medium.grid.periodic, optics, lighting, set, length_m);
    std::int64_t slice_floats = 0;
    for (const OrdinateSweep& s : k.sweep)
        slice_floats = std::max(slice_floats, ordinate_slice_floats(k, s));
    PILEUS_TRY(solver.slices.resize(std::uint64_t(slice_floats) * std::uint64_t(context.threads),
                                    "ordinates: slices"));
    if (solver.channel != set.channel) set_ways(context, medium, nodes, optics.rest, length_m, w);
    solver.channel = set.channel;
    const OrdinatesBuffers b{w.pass, w.mean, beam, w.radiance, moments, solver.slices.data()};
    std::fill_n(moments, count * kOrdinateMoments, 0.0f);
    for (set.iterations = 0; set.iterations < kMaxIterations;) {
        std::copy_n(moments, kSlowMoments * count, w.last);
        iterate(context, k, b, slice_floats);
        double change = 0, norm = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const double now = double(moments[i]), off = now - double(w.last[i]);
            change += off * off, norm += now * now;
        }
        set.residual = norm > 0 ? __builtin_sqrt(change / norm) : 0;
        if (++set.iterations == kMaxIterations || set.residual < kEnough) break;
        mix(set.iterations - 1, count, w, moments);
    }
    return Status::ok();
}

}  // namespace pileus
