// SPDX-License-Identifier: Apache-2.0
// See upsample.h.
#include "src/picture/upsample.h"

#include <cstring>

#include "platform/threads.h"
#include "src/picture/late_rows.h"

namespace pileus {
namespace {

std::uint64_t pixels_of(const PixelLattice& g) {
    return std::uint64_t(g.width) * std::uint64_t(g.height);
}

/// The most of them in a picture, wherever a lattice begins.
std::uint64_t most_pixels_of(const PixelLattice& g, std::uint64_t width, std::uint64_t height) {
    const std::uint64_t every = std::uint64_t(g.every);
    return (width + every - 1) / every * ((height + every - 1) / every);
}

/// So many numbers for each of `pixels`: marched ones, or those of the frame before.
Array<float> marched(std::uint64_t numbers, std::uint64_t pixels, Stage last = Stage::kWrite) {
    return {"marched pixels", bytes_of(numbers, pixels), Stage::kDisplay, last};
}

Array<std::int64_t> recalled_counts(std::uint64_t rows) {
    return {"marched pixels", rows, Stage::kDisplay, Stage::kDisplay};
}

/// Planes of the marched pixels, with what stands behind each.
Status outfit(const PixelLattice& g, int width, bool half_depth, const Planes& whole, Planes& few) {
    const std::uint64_t n = pixels_of(g),
                        height = whole.transmittance.size() / std::uint64_t(width);
    const std::uint64_t most = most_pixels_of(g, std::uint64_t(width), height);
    const auto fit = [&](std::uint64_t numbers, Buffer<float>& plane) {
        const Array<float> own = marched(numbers, n), room = marched(numbers, most);
        return plane.fit(own.count, room.count, own.name);
    };
    PILEUS_TRY(fit(1, few.transmittance));
    PILEUS_TRY(fit(3, few.colour));
    PILEUS_TRY(fit(half_depth ? 1 : 0, few.half_depth));
    PILEUS_TRY(fit(whole.optical_depth.empty() ? 0 : 1, few.optical_depth));
    PILEUS_TRY(fit(whole.opaque_depth.empty() ? 0 : 1, few.opaque_depth));
    take_behind(g, width, whole, few);
    return Status::ok();
}

UpsampleParams params_of(const UpsampleInput& in, const PixelLattice& lattice,
                         const UpsampleMemory& memory) {
    UpsampleParams k{};
    k.lattice = lattice;
    k.rule = std::int32_t(in.settings.upsample);
    k.camera = in.camera;
    k.before = memory.camera;
    k.remembers = memory.ready ? 1 : 0;
    k.still = std::memcmp(&memory.camera, &in.camera, sizeof in.camera) == 0 &&
                      memory.to_sun == in.to_sun && memory.light == in.light
                  ? 1
                  : 0;
    k.medium = in.medium;
    return k;
}

UpsampleBuffers buffers_of(const UpsampleMemory& memory, Planes& planes) {
    const Planes& few = memory.few;
    return {few.transmittance.data(),    few.colour.data(),
            few.half_depth.data(),       few.optical_depth.data(),
            few.opaque_depth.data(),     planes.opaque_depth.data(),
            memory.transmittance.data(), memory.colour.data(),
            memory.opaque_depth.data(),  planes.transmittance.data(),
            planes.colour.data(),        planes.half_depth.data(),
            planes.optical_depth.data(), nullptr};
}

Status fill_in(const Context& context, const UpsampleInput& in, const PixelLattice& lattice,
               UpsampleMemory& memory, Planes& planes) {
    const StageClock clock(context, "upsampling");
    const UpsampleParams k = params_of(in, lattice, memory);
    UpsampleBuffers b = buffers_of(memory, planes);
    if (planes.late != nullptr) {
        leave_upsampling(k, b, *planes.late);
        return Status::ok();
    }
    const std::uint32_t rows = std::uint32_t(in.camera.height);
    Buffer<std::int64_t> kept;
    PILEUS_TRY(allocate(recalled_counts(rows), kept));
    b.kept = kept.data();
    PILEUS_TRY(run_rows(context, context.kernels->upsample_rows, k, b, rows));
    for (std::int64_t n : kept.span()) memory.recalled += std::uint64_t(n);
    return Status::ok();
}

Status copy(int threads, const Buffer<float>& from, Buffer<float>& to) {
    constexpr std::size_t kPiece = std::size_t{1} << 16;
    const std::size_t count = from.size();
    PILEUS_TRY(allocate_once(marched(1, count), to));
    parallel_for(threads, std::int64_t((count + kPiece - 1) / kPiece), [&](std::int64_t i, int) {
        const std::size_t begin = std::size_t(i) * kPiece;
        const std::size_t own = begin + kPiece < count ? kPiece : count - begin;
        std::memcpy(to.data() + begin, from.data() + begin, own * sizeof(float));
    });
    return Status::ok();
}

Status remember(const Context& context, const UpsampleInput& in, const Planes& planes,
                UpsampleMemory& memory) {
    const StageClock clock(context, "upsampling");
    PILEUS_TRY(copy(context.threads, planes.transmittance, memory.transmittance));
    PILEUS_TRY(copy(context.threads, planes.colour, memory.colour));
    PILEUS_TRY(copy(context.threads, planes.opaque_depth, memory.opaque_depth));
    memory.camera = in.camera;
    memory.to_sun = in.to_sun;
    memory.light = in.light;
    memory.ready = true;
    return Status::ok();
}

/// Place of frame n in a cell of two by two, opposite corners first.
constexpr int kTurnX[4] = {0, 1, 1, 0}, kTurnY[4] = {0, 1, 0, 1};

}  // namespace

void take_behind(const PixelLattice& g, int width, const Planes& whole, Planes& few) {
    for (std::size_t i = 0; i < few.opaque_depth.size(); ++i) {
        const std::size_t across = std::size_t(g.width), every = std::size_t(g.every);
        const std::size_t x = i % across * every + std::size_t(g.first[0]);
        const std::size_t y = i / across * every + std::size_t(g.first[1]);
        few.opaque_depth[i] = whole.opaque_depth[y * std::size_t(width) + x];
    }
}

PixelLattice upsample_lattice(const UpsampleSettings& s, const CameraParams& camera, int frame,
                              bool remembers) {
    PixelLattice g = whole_lattice(camera);
    if (s.temporal > 0 && remembers) {
        // Of a cell of four by four the corners of each quarter in turn, opposite ones first.
        const int coarse = frame % 4, fine = frame / 4 % 4;
        g.every = s.temporal;
        g.first[0] = s.temporal == 2 ? kTurnX[coarse] : 2 * kTurnX[coarse] + kTurnX[fine];
        g.first[1] = s.temporal == 2 ? kTurnY[coarse] : 2 * kTurnY[coarse] + kTurnY[fine];
    } else if (s.temporal == 0 && s.scale > 1) {
        g.every = s.scale;
        g.first[0] = g.first[1] = s.scale / 2;
    }
    // A picture smaller than a cell has its first pixel marched.
    const int size[2] = {camera.width, camera.height};
    for (int a = 0; a < 2; ++a)
        if (g.first[a] >= size[a]) g.first[a] = size[a] - 1;
    g.width = (camera.width - g.first[0] + g.every - 1) / g.every;
    g.height = (camera.height - g.first[1] + g.every - 1) / g.every;
    return g;
}

Status upsample_picture(const Context& context, const UpsampleInput& in, int frame,
                        UpsampleMemory& memory, Planes& planes) {
    const UpsampleSettings& s = in.settings;
    const PixelLattice lattice = upsample_lattice(s, in.camera, frame, memory.ready);
    memory.marched += pixels_of(lattice);
    if (lattice.every == 1) {
        PILEUS_TRY(in.march(lattice, planes));
    } else {
        const bool half = s.temporal > 0 || !planes.half_depth.empty();
        {
            const StageClock clock(context, "upsampling");
            PILEUS_TRY(outfit(lattice, in.camera.width, half, planes, memory.few));
        }
        PILEUS_TRY(in.march(lattice, memory.few));
        PILEUS_TRY(fill_in(context, in, lattice, memory, planes));
    }
    return s.temporal > 0 ? remember(context, in, planes, memory) : Status::ok();
}

Status reserve_upsampling(const UpsampleSettings& s, const std::array<int, 2>& resolution,
                          bool solid, UpsampleMemory& memory) {
    PixelLattice densest{};
    densest.every = 2;
    const std::uint64_t width = std::uint64_t(resolution[0]), height = std::uint64_t(resolution[1]);
    const std::uint64_t few = most_pixels_of(densest, width, height);
    const auto room = [](std::uint64_t numbers, std::uint64_t pixels, Buffer<float>& plane) {
        const Array<float> own = marched(numbers, pixels);
        return plane.reserve(own.count, own.name);
    };
    PILEUS_TRY(room(1, few, memory.few.transmittance));
    PILEUS_TRY(room(3, few, memory.few.colour));
    PILEUS_TRY(room(1, few, memory.few.half_depth));
    PILEUS_TRY(room(solid ? 1 : 0, few, memory.few.opaque_depth));
    if (s.temporal == 0) return Status::ok();
    PILEUS_TRY(room(1, width * height, memory.transmittance));
    PILEUS_TRY(room(3, width * height, memory.colour));
    return room(solid ? 1 : 0, width * height, memory.opaque_depth);
}

void forget_pictures(UpsampleMemory& memory) {
    UpsampleMemory fresh;
    // Memory that keeps stays, in a flight.
    const auto keep = [](Buffer<float>& from, Buffer<float>& to) {
        (void)from.resize(0, "");
        to.swap(from);
    };
    keep(memory.few.transmittance, fresh.few.transmittance);
    keep(memory.few.colour, fresh.few.colour);
    keep(memory.few.half_depth, fresh.few.half_depth);
    keep(memory.few.opaque_depth, fresh.few.opaque_depth);
    keep(memory.transmittance, fresh.transmittance);
    keep(memory.colour, fresh.colour);
    keep(memory.opaque_depth, fresh.opaque_depth);
    memory = std::move(fresh);
}

Status check_upsampling(const Scene& scene, const char* method, const UpsampleSettings& s) {
    const auto fault = [&](const char* key, int value, const std::string& allowed) {
        return Status::bad_input(scene.file + ": " + method + "." + key + ": " +
                                 std::to_string(value) + ", allowed: " + allowed);
    };
    if (s.scale == 3) return fault("scale", s.scale, "1, 2, 4");
    if (s.temporal == 1 || s.temporal == 3) return fault("temporal", s.temporal, "0, 2, 4");
    if (s.temporal > 0 && s.scale > 1)
        return fault("scale", s.scale,
                     "1 where " + std::string(method) + ".temporal thins out pixels already");
    return Status::ok();
}

FrameWork work_of(const UpsampleSettings& s) {
    FrameWork work;
    work.temporal = s.temporal;
    work.scale = s.temporal > 0 ? 0 : s.scale;
    return work;
}

void put_work(const FrameWork& work, UpsampleSettings& s) {
    if (work.scale > 0) s.scale = work.scale;
    s.temporal = work.temporal;
}

void note_upsampling(const Scene& scene, const UpsampleSettings& s, Plan& plan) {
    if (s.scale > 1) plan.need("pixels between marched ones: approximation");
    if (s.temporal > 0) plan.need("pixels from the frame before: approximation");
    if (s.temporal > 0 && !scene.animation.is_film())
        plan.leave_out("pixels from the frame before", "one frame");
}

void add_upsample_row(const UpsampleSettings& s, const std::array<int, 2>& resolution, bool solid,
                      bool half_depth, bool optical_depth, Stage last, MemoryTable& table) {
    const int every = s.every();
    if (every <= 1) return;
    const auto few = [&](int n) {
        return (std::uint64_t(n) + std::uint64_t(every) - 1) / std::uint64_t(every);
    };
    const std::uint64_t thin = few(resolution[0]) * few(resolution[1]);
    const std::uint64_t pixels = std::uint64_t(resolution[0]) * std::uint64_t(resolution[1]);
    const std::uint64_t solids = solid ? 1 : 0;
    const std::uint64_t planes = 4 + solids + (half_depth ? 1 : 0) + (optical_depth ? 1 : 0);
    const std::uint64_t before = s.temporal > 0 ? 4 + solids : 0;
    add(table, marched(planes, thin, last), marched(before, pixels, last),
        recalled_counts(std::uint64_t(resolution[1])));
}

}  // namespace pileus
