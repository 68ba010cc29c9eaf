// SPDX-License-Identifier: Apache-2.0
// See sun_slices.h.
#include "src/picture/nodes/sun_slices.h"

#include "platform/threads.h"
#include "src/base/angles.h"
#include "src/picture/march_view.h"
#include "src/run/on_device.h"

namespace pileus {
namespace {

bool are_near(const std::vector<SunDirection>& suns, const SunDirection& sun) {
    const double least = sincos_deg(kMaxSliceDeg).cosine;
    for (const SunDirection& s : suns) {
        double cosine = 0;
        for (std::size_t a = 0; a < 3; ++a) cosine += double(s[a]) * double(sun[a]);
        if (!(cosine >= least)) return false;
    }
    return true;
}

}  // namespace

std::vector<int> follow_sun(const SunTurn& turn, SunSlices& s) {
    const std::size_t count = std::size_t(turn.slices);
    const auto place = [&](std::int64_t frame) {
        return std::size_t((frame % turn.slices + turn.slices) % turn.slices);
    };
    if (s.suns.size() != count || (turn.turn != s.last && turn.turn != s.last + 1)) {
        s.suns.assign(count, turn.sun);
        for (std::int64_t f = turn.turn - turn.slices + 1; f < turn.turn && turn.sun_of; ++f)
            s.suns[place(f)] = turn.sun_of(f);
    }
    s.suns[place(turn.turn)] = turn.sun;
    s.last = turn.turn;
    const bool near = are_near(s.suns, turn.sun), anew = s.held.size() != count;
    s.held.resize(count);
    std::vector<int> due;
    for (std::size_t i = 0; i < count; ++i) {
        const SunDirection& wanted = near ? s.suns[i] : turn.sun;
        if (!anew && s.held[i] == wanted) continue;
        due.push_back(int(i));
        s.held[i] = wanted;
        ++s.made;
    }
    return due;
}

void hold_sun(const SunDirection& sun, SunSlices& s) {
    for (auto* of : {&s.suns, &s.held}) of->assign(of->size(), sun);
}

Status make_shadow_slice(const Context& context, const ShadowParams& k, const ShadowBuffers& b,
                         int slice, int slices) {
    const std::uint32_t rows = std::uint32_t(k.nodes.size[1] * k.nodes.size[2]);
    const ShadowKernel kernel = shadow_kernel(*context.kernels, k.medium);
    if (slices <= 1) return run_rows(context, kernel, k, b, rows);
    constexpr std::uint32_t kPiece = 4;
    const std::uint32_t every = std::uint32_t(slices), first = std::uint32_t(slice);
    if (on_device(context.kernels->device)) {
        // A device takes all rows, of which the others want no node.
        std::vector<NodeRange> wanted(rows, NodeRange{0, 0});
        for (std::uint32_t row = first; row < rows; row += every)
            wanted[row] = b.rows != nullptr ? b.rows[row] : NodeRange{0, k.nodes.size[0]};
        ShadowBuffers own = b;
        own.rows = wanted.data();
        return run_rows(context, kernel, k, own, rows);
    }
    const std::uint32_t own = first < rows ? (rows - first + every - 1) / every : 0;
    parallel_for(context.threads, (own + kPiece - 1) / kPiece, [&](std::int64_t piece, int) {
        const std::uint32_t begin = std::uint32_t(piece) * kPiece;
        for (std::uint32_t i = begin; i < begin + kPiece && i < own; ++i)
            kernel(k, b, first + i * every, first + i * every + 1);
    });
    return Status::ok();
}

}  // namespace pileus
