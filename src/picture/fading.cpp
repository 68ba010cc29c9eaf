// SPDX-License-Identifier: Apache-2.0
// See fading.h. What is kept of a picture; mix_pictures.cpp mixes.
#include "src/picture/fading.h"

#include <cstring>

#include "platform/threads.h"

namespace pileus {
namespace {

Status copy_plane(int threads, const Buffer<float>& from, Buffer<float>& to) {
    constexpr std::size_t kPiece = std::size_t{1} << 16;
    PILEUS_TRY(allocate_once(
        Array<float>{"fading picture", from.size(), Stage::kDisplay, Stage::kWrite}, to));
    parallel_for(threads, std::int64_t((from.size() + kPiece - 1) / kPiece),
                 [&](std::int64_t i, int) {
                     const std::size_t begin = std::size_t(i) * kPiece;
                     const std::size_t left = from.size() - begin;
                     const std::size_t own = left < kPiece ? left : kPiece;
                     std::memcpy(to.data() + begin, from.data() + begin, own * sizeof(float));
                 });
    return Status::ok();
}

/// Planes of which some pixels were marched, or all.
struct Marched {
    const float *transmittance, *colour;
    PixelLattice lattice;
};

/// Where media show: of each row of the lattice the columns, two numbers; then all together.
Status find_media(int threads, const Marched& in, FadingPicture& kept) {
    const PixelLattice& g = in.lattice;
    Buffer<std::int32_t> ends;
    PILEUS_TRY(ends.resize(2 * std::uint64_t(g.height), "counters"));
    const std::size_t columns = std::size_t(g.width), pixels = columns * std::size_t(g.height);
    parallel_for(threads, g.height, [&](std::int64_t y, int) {
        const std::size_t first = std::size_t(y) * columns;
        const auto shows = [&](std::size_t at) {
            return in.transmittance[at] != 1.0f || in.colour[at] != 0.0f ||
                   in.colour[pixels + at] != 0.0f || in.colour[2 * pixels + at] != 0.0f;
        };
        std::size_t left = 0, right = columns;
        while (left < columns && !shows(first + left)) ++left;
        while (right > left && !shows(first + right - 1)) --right;
        ends[2 * std::size_t(y)] = std::int32_t(left);
        ends[2 * std::size_t(y) + 1] = std::int32_t(right);
    });
    std::int32_t low[2] = {g.width, g.height}, high[2] = {0, 0};
    for (std::int32_t y = 0; y < g.height; ++y) {
        const std::int32_t left = ends[2 * std::size_t(y)], right = ends[2 * std::size_t(y) + 1];
        if (left >= right) continue;
        low[0] = left < low[0] ? left : low[0], high[0] = right > high[0] ? right : high[0];
        low[1] = y < low[1] ? y : low[1], high[1] = y + 1;
    }
    // Pixels between marched ones show what either does, those at the margin what the last does.
    const auto before = [&](int a) {
        return low[a] == 0 ? 0 : g.first[a] + (low[a] - 1) * g.every + 1;
    };
    const auto after = [&](int a, std::int32_t count, std::int32_t all) {
        return high[a] == count ? all : g.first[a] + high[a] * g.every;
    };
    kept.left = before(0), kept.right = after(0, g.width, kept.width);
    kept.first = before(1), kept.last = after(1, g.height, kept.height);
    if (high[1] == 0) kept.left = kept.right = kept.first = kept.last = 0;
    return Status::ok();
}

/// Rows in which no media show.
void clear_rows(std::uint32_t begin, std::uint32_t end, std::uint32_t rows, Planes& planes) {
    const std::size_t pixels = planes.transmittance.size(), width = pixels / rows;
    const std::size_t first = begin * width, count = (end - begin) * width;
    for (std::size_t i = first; i < first + count; ++i) planes.transmittance[i] = 1.0f;
    for (std::size_t c = 0; c < 3; ++c)
        std::memset(planes.colour.data() + c * pixels + first, 0, count * sizeof(float));
}

/// What was left to the last pass; rows between marched ones only where media show.
Status make_late_rows(const Context& context, const LateRows& late, const FadingPicture& found,
                      Planes& planes) {
    constexpr std::uint32_t kPiece = 4;
    const KernelTable& kernels = *context.kernels;
    const std::uint32_t rows = std::uint32_t(late.params.back.camera.height);
    BackgroundBuffers back = late.buffers.back;
    back.colour = planes.background.data();
    back.opaque_depth = planes.opaque_depth.empty() ? nullptr : planes.opaque_depth.data();
    UpsampleBuffers up = late.buffers.up;
    up.whole_opaque = back.opaque_depth;
    up.whole_transmittance = planes.transmittance.data();
    up.whole_colour = planes.colour.data();
    up.whole_half = up.whole_depth = nullptr;
    Buffer<std::int64_t> counts;
    PILEUS_TRY(counts.resize(rows, "counters"));
    up.kept = counts.data();
    parallel_for(context.threads, (rows + kPiece - 1) / kPiece, [&](std::int64_t piece, int) {
        const std::uint32_t begin = std::uint32_t(piece) * kPiece;
        const std::uint32_t end = begin + kPiece < rows ? begin + kPiece : rows;
        kernels.background_rows(late.params.back, back, begin, end);
        if (late.params.filled == 0) return;
        if (std::int32_t(end) > found.first && std::int32_t(begin) < found.last)
            kernels.upsample_rows(late.params.up, up, begin, end);
        else
            clear_rows(begin, end, rows, planes);
    });
    return Status::ok();
}

}  // namespace

bool are_whole(const Planes& planes, std::int32_t width, std::int32_t height) {
    const std::uint64_t pixels = std::uint64_t(width) * std::uint64_t(height);
    const auto fits = [&](const Buffer<float>& plane, std::uint64_t numbers) {
        return plane.empty() || plane.size() == numbers * pixels;
    };
    return pixels > 0 && planes.transmittance.size() == pixels &&
           planes.colour.size() >= 3 * pixels && fits(planes.background, 3) &&
           fits(planes.cloud, 3) && fits(planes.opaque_depth, 1);
}

Status copy_picture(const Context& context, const Planes& from, Planes& to) {
    const int threads = context.threads;
    PILEUS_TRY(copy_plane(threads, from.transmittance, to.transmittance));
    PILEUS_TRY(copy_plane(threads, from.colour, to.colour));
    PILEUS_TRY(copy_plane(threads, from.background, to.background));
    PILEUS_TRY(copy_plane(threads, from.cloud, to.cloud));
    PILEUS_TRY(copy_plane(threads, from.half_depth, to.half_depth));
    return copy_plane(threads, from.opaque_depth, to.opaque_depth);
}

Status keep_picture(const Context& context, std::int32_t width, std::int32_t height,
                    const LateRows* late, Planes& planes, FadingPicture& kept) {
    FadingPicture found;
    found.width = width;
    found.height = height;
    Marched marched{planes.transmittance.data(), planes.colour.data(),
                    PixelLattice{1, {0, 0}, width, height}};
    if (late != nullptr && late->params.filled != 0)
        marched = {late->buffers.up.transmittance, late->buffers.up.colour,
                   late->params.up.lattice};
    PILEUS_TRY(find_media(context.threads, marched, found));
    if (late != nullptr) PILEUS_TRY(make_late_rows(context, *late, found, planes));
    found.planes.transmittance.swap(planes.transmittance);
    found.planes.colour.swap(planes.colour);
    found.planes.background.swap(planes.background);
    found.planes.cloud.swap(planes.cloud);
    found.planes.opaque_depth.swap(planes.opaque_depth);
    kept = std::move(found);
    return Status::ok();
}

}  // namespace pileus
