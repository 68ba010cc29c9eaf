// SPDX-License-Identifier: Apache-2.0
// Blending of made-up billboards: CPU and wall ms per picture, sort and frame write included.
// in: 1k, 8k, 30k spheres at three sizes -> out: ms, times the floor, digests checked.
// docs: README.md in this folder.
#include <utility>

#include "kernels_cpu/display/blend_layer.h"
#include "platform/clock.h"
#include "src/base/digest.h"
#include "src/methods/collectors/billboards/billboard_spheres.h"
#include "src/methods/collectors/billboards/gl_billboards.h"
#include "tools/bench/bench.h"
#include "tools/bench/blend_floor.h"
#include "tools/bench/blend_scene.h"

namespace bench {
namespace {

using namespace pileus;

struct BlendCase {
    std::string name;
    std::size_t count;
    int width, height;
    double share;
    bool floor;  ///< measured beside it
};

std::uint64_t picture_digest(const BillboardImage& image) {
    Digest digest;
    digest.floats(image.transmittance.span());
    digest.floats(image.colour.span());
    return digest.value();
}

/// Pixels that take light, sphere by sphere: one after the other, without blocks or tiles.
std::uint64_t blended_pixels(const BlendSpheres& made) {
    BillboardLists lists;
    if (!project_billboards(made.scene(), made.camera, 1, lists)) return 0;
    const int width = made.camera.width;
    std::vector<float> left(std::size_t(width) * std::size_t(made.camera.height), 1.0f);
    std::uint64_t count = 0;
    for (const std::uint32_t i : lists.order.span()) {
        const BlendSphere& s = lists.spheres[i];
        for (std::int32_t y = s.y0; y < s.y1; ++y)
            for (std::int32_t x = s.x0; x < s.x1; ++x) {
                const float dy = float(y - s.row) - s.row_part,
                            dx = float(x - s.column) - (s.column_part + s.lean * dy);
                const float q = 1.0f - s.ey * dy * dy - s.ex * dx * dx;
                float& t = left[std::size_t(y) * std::size_t(width) + std::size_t(x)];
                if (!(q > 0.0f) || t < kBlendCut) continue;
                const float depth = 2 * s.extinction * s.half_scale * sqrt_(q);
                t = attenuate(t, depth).after;
                ++count;
            }
    }
    return count;
}

/// Fastest of some runs of the least that blending so many pixels can cost, ms.
double blend_floor_ms(const KernelTable* kernels, std::uint64_t pixels, int width, int height) {
    const BlendFloor floor = blend_floor(kernels->name);
    if (floor == nullptr) return 0;
    Buffer<float> tile, image;
    const std::uint64_t frame = std::uint64_t(width) * std::uint64_t(height) * 4;
    if (!tile.resize(kFloorTile * kFloorPlanes, "tile") || !image.resize(frame, "image")) return 0;
    const BlendFloorWork work{pixels, frame, tile.data(), image.data()};
    double best = 1e30;
    for (int i = 0; i < 5; ++i) {
        const double start = cpu_seconds();
        benchmark::DoNotOptimize(floor(work));
        const double took = (cpu_seconds() - start) * 1e3;
        best = took < best ? took : best;
    }
    return best;
}

void run_blend(benchmark::State& state, Bench& bench, const BlendCase& which,
               const KernelTable* kernels, int threads) {
    const BlendSpheres made =
        make_blend_spheres(which.count, which.width, which.height, which.share);
    BillboardImage out;
    double best = 1e30, best_wall = 1e30;
    for (auto _ : state) {
        const double wall = wall_seconds(), cpu = cpu_seconds();
        if (!bench.passed(state, composite_billboards(made.scene(), made.camera, threads,
                                                      kernels->blend_tile, out)))
            return;
        const double took = cpu_seconds() - cpu, passed = wall_seconds() - wall;
        best = took < best ? took : best;
        best_wall = passed < best_wall ? passed : best_wall;
        state.SetIterationTime(took);
        bench.check(state, which.name, picture_digest(out));
    }
    state.counters["best_ms"] = best * 1e3;
    state.counters["best_wall_ms"] = best_wall * 1e3;
    if (!which.floor || threads != 1) return;
    const std::uint64_t pixels = blended_pixels(made);
    const double floor = blend_floor_ms(kernels, pixels, which.width, which.height);
    state.counters["pixels"] = double(pixels);
    state.counters["ns/pixel"] = best * 1e9 / double(pixels);
    if (floor > 0) state.counters["times_floor"] = best * 1e3 / floor;
}

/// The same picture by OpenGL, whose threads and waits make wall time the only honest one; its
/// bits are the driver's, so that the sum of what is left must repeat and agree to 10^-4 instead.
void run_foreign(benchmark::State& state, Bench& bench, const BlendCase& which,
                 Compositor compositor) {
    const BlendSpheres made =
        make_blend_spheres(which.count, which.width, which.height, which.share);
    const int threads = hardware_threads();
    GlBlender blender;
    const Status opened = open_gl_blender(compositor, blender);
    if (!opened) return state.SkipWithError(opened.message.c_str());
    BillboardImage own, out;
    if (!bench.passed(state, composite_billboards(made.scene(), made.camera, threads,
                                                  kernel_table(nullptr)->blend_tile, own)))
        return;
    double best = 1e30, best_wall = 1e30;
    for (auto _ : state) {
        const double wall = wall_seconds(), cpu = cpu_seconds();
        if (!bench.passed(state, blend_by_gl(blender, made.scene(), made.camera, threads, out)))
            return;
        const double took = cpu_seconds() - cpu, passed = wall_seconds() - wall;
        best = took < best ? took : best;
        best_wall = passed < best_wall ? passed : best_wall;
        state.SetIterationTime(took);
    }
    double apart = 0;
    for (std::size_t i = 0; i < own.transmittance.size(); ++i) {
        const double d = double(own.transmittance[i]) - double(out.transmittance[i]);
        apart = d > apart ? d : -d > apart ? -d : apart;
    }
    state.counters["best_ms"] = best * 1e3;
    state.counters["best_wall_ms"] = best_wall * 1e3;
    state.counters["apart"] = apart;
    (void)bench.passed(state,
                       apart < 2e-4 ? Status::ok() : Status{Code::kCheckFailed, "another picture"});
}

}  // namespace

void register_blend_cases(Bench& bench) {
    std::vector<BlendCase> cases = {{"blend/8k/third", 8000, 1920, 1080, 1.0 / 3, true},
                                    {"blend/8k/full", 8000, 1920, 1080, 1.0, true}};
    for (const auto& [label, count] :
         {std::pair{"1k", 1000}, std::pair{"8k", 8000}, std::pair{"30k", 30'000}})
        for (const auto& [width, height] :
             {std::pair{640, 480}, std::pair{1280, 720}, std::pair{1920, 1080}})
            cases.push_back({std::string("blend/") + label + "/" + std::to_string(width) + "x" +
                                 std::to_string(height),
                             std::size_t(count), width, height, 1.0, false});
    for (const BlendCase& which : cases) {
        for (const auto& [name, compositor] :
             {std::pair{"/osmesa", Compositor::kOsmesa}, std::pair{"/egl", Compositor::kEgl}}) {
            if (!which.floor) continue;
            const Compositor by = compositor;
            benchmark::RegisterBenchmark(
                (which.name + name).c_str(),
                [&bench, which, by](benchmark::State& s) { run_foreign(s, bench, which, by); })
                ->UseManualTime()
                ->Unit(benchmark::kMillisecond);
        }
        for_each_machine([&](const std::string& suffix, const KernelTable* kernels, int threads) {
            // The pictures of many sizes: the widest lanes alone, one thread and all.
            if (!which.floor && kernels != kernel_table(nullptr)) return;
            benchmark::RegisterBenchmark((which.name + suffix).c_str(),
                                         [&bench, which, kernels, threads](benchmark::State& s) {
                                             run_blend(s, bench, which, kernels, threads);
                                         })
                ->UseManualTime()
                ->Unit(benchmark::kMillisecond);
        });
    }
}

}  // namespace bench
