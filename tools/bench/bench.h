// SPDX-License-Identifier: Apache-2.0
// What all cases share: scenes prepared once, CPU time per stage, and a check of the work done.
// in: scene overrides -> out: runs ready to shoot or show; digests that must repeat.
// docs: README.md in this folder.
#pragma once
#include <benchmark/benchmark.h>

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "src/io/images/image.h"
#include "src/methods/collectors/collectors_method.h"
#include "src/methods/scenery.h"

namespace bench {

/// A scene with everything that its photons need.
struct ReadyScene {
    pileus::Scene scene;
    pileus::Scenery scenery;
    pileus::Plan plan;
    std::unique_ptr<pileus::CollectorsMethod> method;
    pileus::Report report;
    pileus::Context context;  ///< all threads, the widest instruction set

    const pileus::World& world() const { return *scenery.world; }
    pileus::CollectorsState& state() { return method->state(); }
    pileus::FrameView view() { return scenery.view(0); }
    /// Another generation.
    pileus::Status shoot(const pileus::Context& with) {
        std::uint64_t done = 0;
        return method->accumulate(with, view(), 1, done);
    }
    /// A picture, with its layers.
    pileus::Status show(const pileus::Context& with, pileus::Image& image);
};

using Overrides = std::vector<std::string>;

/// Owned by main, passed to every case.
class Bench {
public:
    /// The scene `name` (assets/scenes, or "slab" made here) prepared once per set of overrides;
    /// on failure null, and the case has failed with the reason.
    ReadyScene* prepared(benchmark::State& state, const std::string& name,
                         const Overrides& overrides);

    /// The same, made anew and owned by the caller.
    std::unique_ptr<ReadyScene> fresh(benchmark::State& state, const std::string& name,
                                      const Overrides& overrides);

    /// Reads a scene without preparing it; false as above.
    bool read(benchmark::State& state, const std::string& name, const Overrides& overrides,
              pileus::Scene& scene);

    /// The first digest of `work` is kept; another one later fails the case.
    void check(benchmark::State& state, const std::string& work, std::uint64_t digest);

    /// False, and the case has failed, unless `status` is good.
    bool passed(benchmark::State& state, const pileus::Status& status);

    bool failed() const { return failed_; }

private:
    bool failed_ = false;
    std::map<std::string, std::unique_ptr<ReadyScene>> prepared_;
    std::map<std::string, std::uint64_t> digests_;
};

/// Forgets all photons, so that the next generation is the first again.
void forget_photons(pileus::CollectorsState& state);

/// The cloud of the figures to reach, 128 voxels along each axis.
constexpr const char* kCumulus128 = "../studies/scenes/cumulus128";

using Stages = std::vector<const char*>;

/// CPU seconds of the stages of these names so far.
double stage_cpu(const pileus::Report& report, const Stages& stages);

/// Wall seconds of the same.
double stage_wall(const pileus::Report& report, const Stages& stages);

/// One counter NAME_ms per stage: CPU milliseconds.
void count_stages(benchmark::State& state, const pileus::Report& report);

/// Digest of the sums and of the ledger of all lights.
std::uint64_t photon_digest(const pileus::PhotonRing& ring);

/// Digest of every number the preparation made.
std::uint64_t prepared_digest(const pileus::Prepared& prepared, const pileus::Majorants& majorants);

/// Digest of the pixels.
std::uint64_t image_digest(const pileus::Image& image);

/// Context with that many threads and that table.
pileus::Context with(const pileus::Context& context, const pileus::KernelTable* kernels,
                     int threads);

/// Calls register(suffix, table, threads): all threads and one with the widest table, then one
/// thread with each of the others. The suffix is "", "/threads:N" or "/<isa>".
template <class Register>
void for_each_machine(Register add);

void register_trace_cases(Bench& bench);
void register_accumulate_cases(Bench& bench);
void register_path_cases(Bench& bench);
void register_prepare_cases(Bench& bench);
void register_math_cases(Bench& bench);
void register_growth_cases(Bench& bench);
void register_frame_cases(Bench& bench);
void register_blend_cases(Bench& bench);
void register_sweep_cases(Bench& bench);
void register_digest_cases(Bench& bench);

}  // namespace bench

#include "platform/threads.h"

namespace bench {

template <class Register>
void for_each_machine(Register add) {
    const pileus::KernelTable* widest = pileus::kernel_table(nullptr);
    add(std::string(), widest, 1);
    const int threads = pileus::hardware_threads();
    if (threads > 1) add("/threads:" + std::to_string(threads), widest, threads);
    for (int i = 0; const pileus::KernelTable* table = pileus::kernel_table_at(i); ++i)
        if (table != widest) add("/" + std::string(table->name), table, 1);
}

}  // namespace bench
