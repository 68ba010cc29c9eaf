// SPDX-License-Identifier: Apache-2.0
// See rank_render.h.
#include "tools/pileus/rank_render.h"

#include <algorithm>

#include "platform/threads.h"
#include "src/methods/registry.h"
#include "src/plan/crop.h"
#include "src/session/parts/parts.h"
#include "tools/pileus/part_files.h"
#include "tools/pileus/ranks.h"

namespace pileus {
namespace {

/// Light in whole numbers is added on its way; else rows are brought together.
Status bring_together(Part& own, std::vector<Part>& parts) {
    const bool first = ranks().is_first();
    if (own.division == Division::kPhotons) {
        PILEUS_TRY(sum_to_first(own.light.sums.span()));
        own.part = {0, 1, false};
        if (first) parts.push_back(std::move(own));
        return Status::ok();
    }
    Buffer<char> bytes;
    PILEUS_TRY(agree(encode_part(own, bytes)));
    own = Part();
    std::vector<Buffer<char>> all;
    PILEUS_TRY(gather_to_first(bytes.span(), all));
    for (std::size_t i = 0; first && i < all.size(); ++i) {
        parts.emplace_back();
        PILEUS_TRY(decode_part("rank " + std::to_string(i), all[i].span(), parts.back()));
        all[i] = Buffer<char>();
    }
    return first ? check_parts(false, parts) : Status::ok();
}

Status show(const Scene& scene, const RenderOptions& options, const std::vector<Part>& parts,
            const FrameSink& sink) {
    if (!ranks().is_first()) return Status::ok();
    return merge_parts(scene, options, parts, [&](int frame, Image& image, Report& report) {
        report.ranks = ranks().count;
        return sink(frame, image, report);
    });
}

}  // namespace

Status share_ranks(bool has_threads, int run, RenderOptions& options) {
    const Ranks& r = ranks();
    if (r.count == 1) return Status::ok();
    // Ranks of one machine that are bound to no processors share all.
    if (!has_threads) options.threads = std::max(hardware_threads() / r.beside, 1);
    if (run == 0) return Status::ok();
    const int frames = options.last_frame - options.first_frame + 1;
    if (frames < r.count)
        return Status::bad_input("mpirun: " + std::to_string(r.count) + " ranks for " +
                                 std::to_string(frames) + " frames, allowed: as many or fewer");
    return choose_part(std::to_string(r.rank + 1) + "/" + std::to_string(r.count), run, options);
}

/// Whether light is traced until something is reached that all ranks have to know.
bool looks_on_the_way(const Scene& scene, const RenderOptions& options) {
    return aims_at_error(scene, options.budget) || options.budget.seconds > 0 ||
           !options.budget.state.empty() || options.verify > 0;
}

/// Ranks go on side by side and look at what all have, as often as one process would.
Status render_together(const Scene& scene, const RenderOptions& options, const FrameSink& sink) {
    MethodRow row;
    PILEUS_TRY(agree(find_method(scene, row)));
    if (row.division == Division::kRows || !options.show.empty())
        return agree(Status::bad_input("mpirun: a time, an error, --verify or --show of method " +
                                       scene.method +
                                       " is no work to divide, allowed: steps, or one process"));
    RenderOptions own = options;
    own.sharing = rank_share();
    // A signal ends all; no rank ends within a pass by itself.
    own.interrupted = {};
    return agree(render(scene, own, [&](int frame, Image& image, Report& report) {
        report.ranks = ranks().count;
        return sink(frame, image, report);
    }));
}

Status render_by_ranks(const Scene& scene, const RenderOptions& options, const FrameSink& sink) {
    const Ranks& r = ranks();
    if (!scene.clouds.present() && looks_on_the_way(scene, options))
        return render_together(scene, options, sink);
    RenderOptions own = options;
    own.part = {std::uint32_t(r.rank), std::uint32_t(r.count), true};
    Part part;
    PILEUS_TRY(agree(render_part(scene, own, part)));
    RenderOptions shown = options;
    shown.world = part.world;
    std::vector<Part> parts;
    PILEUS_TRY(agree(bring_together(part, parts)));
    return agree(show(scene, shown, parts, sink));
}

}  // namespace pileus
