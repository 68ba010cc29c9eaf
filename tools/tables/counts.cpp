// SPDX-License-Identifier: Apache-2.0
// A small fixed set of work, each piece inside `counted`, for an instruction counter to see.
// in: nothing -> out: one line per piece, in the order of the calls; exit 1 when one fails.
// Read with tools/bench/README.md, "Counts": tools/bench/counts runs it under callgrind.
#include <cstdio>
#include <string>
#include <vector>

#include "platform/fp_mode.h"
#include "src/methods/collectors/collectors_method.h"
#include "src/methods/path/trace_paths.h"
#include "src/methods/scenery.h"
#include "src/picture/finish_frame.h"
#include "src/scene/read_scene.h"
#include "src/world/camera/view.h"

namespace {

using namespace pileus;

/// Read from the folder of the sources, where tools/bench/counts runs.
constexpr const char* kScene = "assets/studies/scenes/cumulus128.toml";

/// What a piece of work needs, and how it ended.
struct Piece {
    const Scene* scene;
    Context context;
    Scenery* scenery;
    CollectorsMethod* method;
    Film* film;
    PathScratch* scratch;
    Status status = Status::ok();
};

void prepare(Piece& p) {
    Prepared out;
    Majorants majorants;
    p.status = prepare_collectors(p.scenery->world->medium, p.scene->collectors, p.scene->seed,
                                  p.context, out);
    if (p.status) p.status = make_majorants(p.scenery->world->medium, true, p.context, majorants);
}
void trace(Piece& p) {
    std::uint64_t done = 0;
    p.status = p.method->accumulate(p.context, p.scenery->view(0), 1, done);
}
Status show_frame(Piece& p) {
    Image image;
    Planes* planes = nullptr;
    PILEUS_TRY(p.method->render(p.context, p.scenery->view(0), {}, planes));
    const World& world = *p.scenery->world;
    FinishedParts parts;
    parts.batches = true;
    return finish_frame(p.context, p.scene->output, world, p.scenery->environment.depth,
                        make_camera(p.scene->camera, 0, world.medium.low_m), parts, *planes, image,
                        *p.context.report);
}
void show(Piece& p) { p.status = show_frame(p); }
PathInput path_input(const Piece& p) {
    PathInput in;
    in.medium = &p.scenery->world->medium;
    in.lighting = &p.method->state().lights.lighting;
    in.majorants = p.method->state().majorants.tracking.span();
    in.block = p.method->state().majorants.block;
    in.camera = make_camera(p.scene->camera, 0, p.scenery->world->medium.low_m);
    in.seed = std::uint64_t(p.scene->seed);
    in.kernels = p.context.kernels;
    in.threads = 1;
    return in;
}
void path(Piece& p) { p.status = trace_paths(path_input(p), 2, *p.scratch, *p.film); }

}  // namespace

/// What the counter counts, dump by dump.
extern "C" __attribute__((noinline)) void counted(void (*work)(Piece&), Piece& piece) {
    work(piece);
    // Nothing may be moved past the end.
    __asm__ volatile("" ::: "memory");
}

namespace {

Status read(const char* display, Scene& scene) {
    const std::vector<std::string> overrides = {"medium.0.resolution=[40,40,40]",
                                                "collectors.samples=1500",
                                                "collectors.photons=1500",
                                                "collectors.generations=1",
                                                "camera.resolution=[48,40]",
                                                "output.layers=[\"radiance\", \"alpha\"]",
                                                std::string("collectors.display=") + display};
    return read_scene_file(kScene, overrides, scene);
}

Status count_piece(const char* name, const char* isa, void (*work)(Piece&), Piece& p) {
    counted(work, p);
    PILEUS_TRY(p.status);
    std::printf("%s %s\n", name, isa);
    return Status::ok();
}

/// All pieces that depend on the instruction set.
Status count_kernels(const KernelTable* kernels) {
    Report report;
    for (const char* display : {"march", "billboards"}) {
        const bool marched = display[0] == 'm';
        Scene scene;
        PILEUS_TRY(read(display, scene));
        auto method = std::make_unique<CollectorsMethod>(MethodInputs{scene, {}, false});
        Scenery scenery(scene);
        Plan plan;
        Film film;
        PathScratch scratch;
        Piece p{&scene, Context{}, &scenery, method.get(), &film, &scratch};
        p.context.kernels = kernels;
        p.context.report = &report;
        MadeMethod made;
        made.report = collectors_report(*method);
        made.method = std::move(method);
        PILEUS_TRY(
            open_method(collectors_row(), made, p.context, true, nullptr, nullptr, scenery, plan));
        if (marched && kernels == kernel_table_at(0))
            PILEUS_TRY(count_piece("prepare", "any", prepare, p));
        if (marched)
            PILEUS_TRY(count_piece("trace", kernels->name, trace, p));
        else
            trace(p);
        PILEUS_TRY(p.status);
        PILEUS_TRY(count_piece(marched ? "march" : "blend", kernels->name, show, p));
        if (!marched) continue;
        const PathInput in = path_input(p);
        PILEUS_TRY(prepare_path(in, scratch));
        PILEUS_TRY(make_film(in, film));
        PILEUS_TRY(count_piece("path", kernels->name, path, p));
    }
    return Status::ok();
}

}  // namespace

int main() {
    const FpModeGuard guard;
    for (const char* name : {"scalar", "sse2", "avx2"}) {
        const KernelTable* kernels = kernel_table(name);
        if (kernels == nullptr) continue;
        const Status status = count_kernels(kernels);
        if (status) continue;
        std::fprintf(stderr, "%s\n", status.message.c_str());
        return 1;
    }
    return 0;
}
