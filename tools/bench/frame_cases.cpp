// SPDX-License-Identifier: Apache-2.0
// Display: CPU time of the stages that make one frame, of the default cloud.
// in: lit scenes -> out: ms per frame and stage, digests checked.
// docs: README.md in this folder. The time column is the CPU time of the named stages only.
#include <algorithm>

#include "kernels_cpu/core/camera.h"
#include "kernels_cpu/media/medium.h"
#include "platform/clock.h"
#include "src/base/digest.h"
#include "src/io/images/image_file.h"
#include "src/picture/march_view.h"
#include "src/world/camera/view.h"
#include "tools/bench/bench.h"
#include "tools/bench/lane_floor.h"

namespace bench {
namespace {

using namespace pileus;

/// Of the default camera at 1920 x 1080, in the middle of the cloud.
constexpr float kPixelVoxels = 0.18f;

/// What one case of the display is.
struct FrameCase {
    std::string name;
    Overrides overrides;
    Stages stages;  ///< whose CPU time counts
    bool shadow;    ///< make the sun's optical depths anew
    bool lanes;     ///< made by a kernel: one case per instruction set
};

/// A lit run: one generation of photons is enough to see the time.
ReadyScene* lit(benchmark::State& state, Bench& bench, const FrameCase& which) {
    Overrides overrides = which.overrides;
    for (const char* o : {"collectors.photons=200000", "collectors.generations=1",
                          "output.layers=[\"radiance\", \"alpha\"]"})
        overrides.push_back(o);
    ReadyScene* p = bench.prepared(state, "cumulus", overrides);
    if (p == nullptr || p->state().ring.photons.slots[0].generations > 0) return p;
    return bench.passed(state, p->shoot(p->context)) ? p : nullptr;
}

/// Samples in blocks that hold anything, until a ray is opaque: of every sixteenth pixel, times 16.
std::uint64_t marched_samples(ReadyScene& p, const CameraParams& camera) {
    const MediumView m = make_medium_view(p.world().medium, p.state().majorants);
    std::uint64_t samples = 0;
    for (int y = 0; y < camera.height; y += 4)
        for (int x = 0; x < camera.width; x += 4) {
            const Ray<float> ray = camera_ray(camera, float(x), float(y));
            const Segment<float> box = clip_to_box(ray.origin, ray.direction, m.extent);
            float left = 1;
            for (float t = box.enter + 0.5f * m.step; t < box.leave && left >= 0x1p-10f;
                 t += m.step) {
                const float place[3] = {ray.origin.x + t * ray.direction.x,
                                        ray.origin.y + t * ray.direction.y,
                                        ray.origin.z + t * ray.direction.z};
                std::int64_t voxel = 0, block = 0;
                for (int a = 2; a >= 0; --a) {
                    const int v = std::min(std::max(int(place[a] / m.cell[a]), 0), m.size[a] - 1);
                    voxel = voxel * m.size[a] + v;
                    block = block * m.blocks[a] + int(float(v) / m.block);
                }
                if (!(m.majorant[block] > 0)) continue;
                samples += 16;
                left *= exp_(-m.density[voxel] * m.sigma * m.step);
            }
        }
    return samples;
}

/// Times over the floor of the same stage, fastest of five; 0 where there is none.
double floor_ms(const FrameCase& which, const KernelTable* kernels, ReadyScene& p) {
    const LaneFloors* floors = lane_floors(kernels->name);
    const CollectorsState& of = p.state();
    const Medium& medium = p.world().medium;
    if (floors == nullptr || (which.name[0] != 'm' && which.name[0] != 'r')) return 0;
    const CameraParams camera = make_camera(p.scene.camera, 0, medium.low_m);
    const auto grid = [](const int(&n)[3], const float* values) {
        return FloorGrid{{n[0], n[1], n[2]}, values};
    };
    const NodeGrid& nodes = of.shadow.nodes;
    const std::vector<float> source(3 * of.shadow.depth.size(), 0.25f);
    const MarchFloorWork march{which.name[0] == 'm' ? marched_samples(p, camera) : 0,
                               grid(medium.grid.size, medium.volume.density.data()),
                               grid(nodes.size, of.shadow.depth.data()),
                               grid(nodes.size, source.data()), kPixelVoxels};
    const Buffer<std::int64_t>& sums = of.ring.photons.slots[0].sums;
    const std::uint64_t numbers = std::uint64_t(of.lights.deposit.coefficients);
    const ReconstructFloorWork reconstruct{sums.data(), sums.size() / numbers, numbers};
    double best = 1e30;
    for (int i = 0; i < 5; ++i) {
        const double start = cpu_seconds();
        if (which.name[0] == 'm')
            benchmark::DoNotOptimize(floors->march(march));
        else
            benchmark::DoNotOptimize(floors->reconstruct(reconstruct));
        best = std::min(best, (cpu_seconds() - start) * 1e3);
    }
    return best;
}

void run_frame(benchmark::State& state, Bench& bench, const FrameCase& which,
               const KernelTable* kernels, int threads) {
    ReadyScene* p = lit(state, bench, which);
    if (p == nullptr) return;
    Report report;
    Context context = with(p->context, kernels, threads);
    context.report = &report;
    double fastest = 1e30, wall = 1e30;
    for (auto _ : state) {
        report = Report{};
        if (which.shadow) p->state().shadow.ready = false;
        Image image;
        if (!bench.passed(state, p->show(context, image))) return;
        const double took = stage_cpu(report, which.stages);
        state.SetIterationTime(took);
        fastest = std::min(fastest, took);
        wall = std::min(wall, stage_wall(report, which.stages));
        Digest digest;
        digest.text(pixel_hash(image));
        digest.floats(p->state().shadow.depth.span());
        bench.check(state, which.name, digest.value());
    }
    // The last frame's other stages, for the whole picture.
    count_stages(state, report);
    state.counters["wall_ms"] = wall * 1e3;
    const double floor = threads == 1 ? floor_ms(which, kernels, *p) : 0;
    if (floor > 0) state.counters["times_floor"] = fastest * 1e3 / floor;
}

}  // namespace

void register_frame_cases(Bench& bench) {
    const std::string full = "camera.resolution=[1920, 1080]", few = "camera.resolution=[64, 36]";
    const std::string march = "collectors.display=march", blend = "collectors.display=billboards";
    const FrameCase cases[] = {
        {"shadow", {few, march}, {"shadow"}, true, true},
        {"reconstruct", {few, march}, {"reconstruct"}, false, false},
        {"splat", {few, march}, {"splat"}, false, false},
        {"background/1920x1080", {full, march}, {"background"}, false, true},
        {"march/1920x1080", {full, march}, {"march"}, false, true},
        {"blend/1920x1080", {full, blend}, {"blend"}, false, true},
    };
    for (const FrameCase& which : cases)
        for_each_machine([&](const std::string& suffix, const KernelTable* kernels, int threads) {
            if (!which.lanes && kernels != kernel_table(nullptr)) return;
            benchmark::RegisterBenchmark((which.name + suffix).c_str(),
                                         [&bench, which, kernels, threads](benchmark::State& s) {
                                             run_frame(s, bench, which, kernels, threads);
                                         })
                ->UseManualTime()
                ->Unit(benchmark::kMillisecond);
        });
}

}  // namespace bench
