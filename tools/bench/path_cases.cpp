// SPDX-License-Identifier: Apache-2.0
// Path tracing: a small picture per iteration, depth unlimited, by scene, instruction set, threads.
// in: prepared scenes -> out: CPU time per path and scattering, rates, and the noise they buy.
// docs: README.md in this folder; rates are per CPU second, which is per core.
#include <cstring>

#include "src/base/digest.h"
#include "src/methods/path/trace_paths.h"
#include "src/world/camera/view.h"
#include "tools/bench/bench.h"

namespace bench {
namespace {

using namespace pileus;

struct PathCase {
    std::string name, scene;
    Overrides overrides;
    std::uint64_t samples;
    bool every_ray = false;  ///< no roulette: every scattering sends its shadow ray
};

constexpr auto kRate = benchmark::Counter::kIsRate;
const auto kTimeEach = benchmark::Counter::kIsRate | benchmark::Counter::kInvert;

std::uint64_t film_digest(const Film& film) {
    Digest digest;
    digest.doubles(film.sum.span());
    const PathTally& t = film.tally;
    for (std::int64_t n : {t.paths, t.scatterings, t.bounces, t.tentative, t.crossings,
                           t.shadow_rays, t.shadow_tentative})
        digest.u64(std::uint64_t(n));
    return digest.value();
}

/// Mean over the pixels with noise of (standard error over their mean)^2.
double relative_variance(const Film& film) {
    double sum = 0, mean = 0, noisy = 0;
    for (std::size_t p = 0; p < film.pixels(); ++p) {
        const double error = film_error(film, 1, p);
        if (!(error > 0)) continue;
        sum += error * error;
        mean += film_mean(film, 0, 1, p);
        noisy += 1;
    }
    return mean > 0 ? sum * noisy / (mean * mean) : 0;
}

void count(benchmark::State& state, const Film& film) {
    const PathTally& t = film.tally;
    const double n = double(state.iterations()), scatterings = double(t.scatterings);
    state.counters["paths/s"] = benchmark::Counter(n * double(t.paths), kRate);
    state.counters["scatterings/s"] = benchmark::Counter(n * scatterings, kRate);
    state.counters["s/scattering"] = benchmark::Counter(n * scatterings, kTimeEach);
    state.counters["tentative/scattering"] = double(t.tentative) / scatterings;
    state.counters["crossings/scattering"] = double(t.crossings) / scatterings;
    state.counters["rays/s"] = benchmark::Counter(n * double(t.shadow_rays), kRate);
    state.counters["shadow_tentative/ray"] =
        double(t.shadow_tentative) / double(t.shadow_rays > 0 ? t.shadow_rays : 1);
    state.counters["rays/scattering"] = double(t.shadow_rays) / scatterings;
    state.counters["relvar*s"] = benchmark::Counter(n / relative_variance(film), kTimeEach);
}

void run_path(benchmark::State& state, Bench& bench, const PathCase& which,
              const KernelTable* kernels, int threads) {
    ReadyScene* p = bench.prepared(state, which.scene, which.overrides);
    if (p == nullptr) return;
    PathInput in;
    in.medium = &p->scenery.world->medium;
    in.lighting = &p->state().lights.lighting;
    Majorants blocks;
    if (!bench.passed(state, make_majorants(p->scenery.world->medium, true,
                                            with(p->context, kernels, 1), blocks, kPathCosts)))
        return;
    in.majorants = blocks.tracking.span();
    in.block = blocks.block;
    if (which.every_ray) in.rules.light_roulette = 0;
    in.camera = make_camera(p->scene.camera, 0, p->scenery.world->medium.low_m);
    in.seed = std::uint64_t(p->scene.seed);
    in.kernels = kernels;
    in.threads = threads;
    PathScratch scratch;
    Film film;
    if (!bench.passed(state, prepare_path(in, scratch))) return;
    for (auto _ : state) {
        state.PauseTiming();
        const Status made = make_film(in, film);
        state.ResumeTiming();
        if (!bench.passed(state, made) ||
            !bench.passed(state, trace_paths(in, which.samples, scratch, film)))
            return;
        state.PauseTiming();
        bench.check(state, which.name, film_digest(film));
        state.ResumeTiming();
    }
    count(state, film);
}

}  // namespace

void register_path_cases(Bench& bench) {
    const std::string small = "camera.resolution=[160,120]";
    const PathCase cases[] = {
        {"path/slab", "slab", {"camera.position_m=[0,0,900]", "camera.up=[0,1,0]", small}, 4},
        {"path/cumulus", "cumulus", {small}, 16},
        {"path/cumulus128", "../studies/scenes/cumulus128", {}, 4},
        {"path/cumulus128/every_ray", "../studies/scenes/cumulus128", {}, 4, true},
        {"path/cumulus/chromatic", "cumulus", {small, "medium.0.albedo=[1.0,0.999,0.99]"}, 16},
    };
    for (const PathCase& which : cases)
        for_each_machine([&](const std::string& suffix, const KernelTable* kernels, int threads) {
            benchmark::RegisterBenchmark((which.name + suffix).c_str(),
                                         [&bench, which, kernels, threads](benchmark::State& s) {
                                             run_path(s, bench, which, kernels, threads);
                                         })
                ->MeasureProcessCPUTime()
                ->Unit(benchmark::kMillisecond);
        });
}

}  // namespace bench
