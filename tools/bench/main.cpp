// SPDX-License-Identifier: Apache-2.0
// The program pileus_bench: what scenes it reads and how it checks the work of its cases.
// in: Google Benchmark's own flags -> out: its table; exit 1 when a case fails.
// docs: README.md in this folder.
#include <cstdio>

#include "platform/fp_mode.h"
#include "platform/team/teams.h"
#include "platform/threads.h"
#include "src/base/digest.h"
#include "src/io/images/image_file.h"
#include "src/picture/finish_frame.h"
#include "src/scene/read_scene.h"
#include "src/session/render.h"
#include "src/world/camera/view.h"
#include "tools/bench/bench.h"

namespace bench {
namespace {

using namespace pileus;

/// Ten optical depths of cloud droplets over 100 m, wide enough to keep its light.
constexpr const char* kSlab = R"(
seed = 7
[camera]
position_m = [0, -3000, 600]
target_m = [0, 0, 50]
[sun]
elevation_deg = 60
[[medium]]
density = "uniform:box"
bounds_m = [[-5000, -5000, 0], [5000, 5000, 100]]
extinction_per_m = 0.1
phase = { type = "henyey-greenstein", g = 0.85 }
)";

}  // namespace

bool Bench::passed(benchmark::State& state, const Status& status) {
    if (status) return true;
    state.SkipWithError(status.message.c_str());
    failed_ = true;
    return false;
}

bool Bench::read(benchmark::State& state, const std::string& name, const Overrides& overrides,
                 Scene& scene) {
    if (name == "slab") return passed(state, read_scene_text(kSlab, "slab", ".", overrides, scene));
    return passed(state, read_scene_file(PILEUS_SCENES "/" + name + ".toml", overrides, scene));
}

ReadyScene* Bench::prepared(benchmark::State& state, const std::string& name,
                            const Overrides& overrides) {
    std::string key = name;
    for (const std::string& o : overrides) key += " " + o;
    std::unique_ptr<ReadyScene>& slot = prepared_[key];
    if (slot != nullptr) return slot.get();
    slot = fresh(state, name, overrides);
    return slot.get();
}

std::unique_ptr<ReadyScene> Bench::fresh(benchmark::State& state, const std::string& name,
                                         const Overrides& overrides) {
    auto made = std::make_unique<ReadyScene>();
    made->context.kernels = kernel_table(nullptr);
    made->context.threads = hardware_threads();
    made->context.report = &made->report;
    if (!read(state, name, overrides, made->scene)) return nullptr;
    const MethodInputs inputs{made->scene, {}, false};
    MadeMethod opened;
    auto method = std::make_unique<CollectorsMethod>(inputs);
    opened.report = collectors_report(*method);
    opened.method = std::move(method);
    made->scenery.show(made->scene, made->scene);
    const Status status = open_method(collectors_row(), opened, made->context, true, nullptr,
                                      nullptr, made->scenery, made->plan);
    made->method.reset(static_cast<CollectorsMethod*>(opened.method.release()));
    if (!passed(state, status)) return nullptr;
    return made;
}

void Bench::check(benchmark::State& state, const std::string& work, std::uint64_t digest) {
    const auto [at, first] = digests_.emplace(work, digest);
    const bool same = first || at->second == digest;
    (void)passed(state,
                 same ? Status::ok()
                      : Status{Code::kCheckFailed, "other work than the first run of " + work});
}

Status ReadyScene::show(const Context& with, Image& image) {
    Planes* planes = nullptr;
    PILEUS_TRY(method->render(with, view(), {}, planes));
    const CameraParams camera = make_camera(scene.camera, 0, world().medium.low_m);
    FinishedParts parts;
    parts.batches = true;
    return finish_frame(with, scene.output, world(), scenery.environment.depth, camera, parts,
                        *planes, image, *with.report);
}

void forget_photons(CollectorsState& state) {
    state.ring.next_generation = 0;
    for (PhotonSlot& slot : state.ring.photons.slots) {
        for (std::int64_t& v : slot.sums.span()) v = 0;
        slot.generations = 0;
    }
    for (TraceTally& t : state.ring.photons.tallies) t = TraceTally{};
}

double stage_cpu(const Report& report, const Stages& stages) {
    double sum = 0;
    for (const StageTime& s : report.clocks.stages)
        for (const char* stage : stages)
            if (s.name == stage) sum += s.cpu_s;
    return sum;
}

double stage_wall(const Report& report, const Stages& stages) {
    double sum = 0;
    for (const StageTime& s : report.clocks.stages)
        for (const char* stage : stages)
            if (s.name == stage) sum += s.wall_s;
    return sum;
}

void count_stages(benchmark::State& state, const Report& report) {
    for (const StageTime& s : report.clocks.stages) state.counters[s.name + "_ms"] = s.cpu_s * 1e3;
}

std::uint64_t photon_digest(const PhotonRing& ring) {
    Digest digest;
    for (const PhotonSlot& slot : ring.photons.slots) digest.integers(slot.sums.span());
    for (const TraceTally& t : ring.photons.tallies) {
        for (const Fates* f : {&t.light, &t.shadow})
            for (std::size_t c = 0; c < 3; ++c)
                for (std::int64_t quanta : {f->emitted[c], f->top[c], f->bottom[c], f->sides[c],
                                            f->absorbed[c], f->ground[c], f->sky[c]})
                    digest.u64(std::uint64_t(quanta));
        for (std::int64_t n : {t.photons, t.scatterings, t.tentative, t.crossings, t.path})
            digest.u64(std::uint64_t(n));
    }
    return digest.value();
}

std::uint64_t prepared_digest(const pileus::Prepared& p, const pileus::Majorants& majorants) {
    Digest digest;
    for (const Collector& c : p.collectors.span()) {
        digest.floats({c.centre, 3});
        for (float v : {c.radius, c.billboard_radius, c.extinction}) digest.f32(v);
    }
    digest.words(p.collector_of_voxel.span());
    digest.floats(majorants.tracking.span());
    digest.floats(majorants.skipping.span());
    return digest.value();
}

std::uint64_t image_digest(const Image& image) {
    Digest digest;
    digest.text(pixel_hash(image));
    return digest.value();
}

Context with(const Context& context, const KernelTable* kernels, int threads) {
    Context other = context;
    other.kernels = kernels;
    other.threads = threads;
    return other;
}

}  // namespace bench

int main(int argc, char** argv) {
    const pileus::TeamChoice team = pileus::start_team(argv);
    const pileus::FpModeGuard guard;
    pileus::ThreadPool threads(team.kind);
    const pileus::PoolGuard lent(threads);
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    benchmark::AddCustomContext("pileus", pileus::kVersion);
    bench::Bench bench;
    bench::register_trace_cases(bench);
    bench::register_accumulate_cases(bench);
    bench::register_path_cases(bench);
    bench::register_prepare_cases(bench);
    bench::register_math_cases(bench);
    bench::register_growth_cases(bench);
    bench::register_frame_cases(bench);
    bench::register_blend_cases(bench);
    bench::register_sweep_cases(bench);
    bench::register_digest_cases(bench);
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return bench.failed() ? 1 : 0;
}
