// SPDX-License-Identifier: Apache-2.0
// See flight.h: what a session needs, by trying.
// in: a packed scene -> out: bytes.
// docs/flight.md, "Memory"
#include <cstring>

#include "src/flight/block.h"
#include "src/flight/flight.h"

namespace pileus {
namespace {

/// What a library of the flight profile keeps in its block and an ordinary one elsewhere: handles,
/// texts, short lists; of a sky in place also lists of rows of sunlight.
constexpr std::uint64_t kSmallBytes = 512u << 10, kSkySmallBytes = 8u << 20;
/// Blocks are whole multiples of this.
constexpr std::uint64_t kUnit = 64u << 10;

/// Frame `number`: the scene's view, then nearer and from other sides, under a sun that moves.
Status set_frame(const Scene& scene, int number, Session& session) {
    PILEUS_TRY(session.set_frame(number));
    Camera camera = scene.camera;
    const Double3 away = scene.camera.position_m - scene.camera.target_m;
    const double near = number % 3 == 0 ? 1 : (number % 3 == 1 ? 0.5 : 0.25);
    const bool turned = number % 2 == 1;
    camera.position_m = camera.target_m + near * (turned ? Double3{-away.y, away.x, away.z} : away);
    // Where that is not possible it stays as it was.
    (void)bool(session.set_camera(camera));
    Sun sun = scene.sun;
    // Never over the horizon, where it would be a light that was not there.
    const bool sinks =
        sun.elevation_deg > 45 || (sun.elevation_deg <= 0 && sun.elevation_deg > -80);
    sun.elevation_deg += sinks ? -0.1 * number : 0.1 * number;
    // A sun that jumps, and another irradiance, take a whole solution.
    if (number == 3) sun.azimuth_deg += sun.azimuth_deg > 180 ? -5 : 5;
    for (float& channel : sun.irradiance) channel *= number == 5 ? 0.5f : 1.0f;
    // Clear air follows the sun, for which a flight has no memory.
    if (!sun.present || scene.atmosphere.present) return Status::ok();
    return session.set_sun(sun);
}

Status draw(Session& session, Buffer<unsigned char>& pixels) {
    const auto& size = session.camera().resolution;
    for (const PixelFormat format : {PixelFormat::kRgba8Srgb, PixelFormat::kRgba32F}) {
        FrameTarget target;
        target.has_colour = true;
        target.colour.format = format;
        target.colour.rows.first = pixels.data();
        target.colour.rows.stride = std::int64_t(size[0]) * std::int64_t(pixel_bytes(format));
        PILEUS_TRY(session.render(target));
    }
    return Status::ok();
}

Status fly(Span<const char> packed, const RenderOptions& options, bool in_place, Block& block,
           FlightNeed& need) {
    const Allocator allocator = block.allocator();
    const Executor alone{
        [](void*, std::uint32_t count, void (*body)(void*, std::uint32_t), void* data) {
            for (std::uint32_t i = 0; i < count; ++i) body(data, i);
        },
        nullptr};
    Packed scene_and_world;
    Session session;
    Buffer<unsigned char> pixels;
    const HostGuard lent({&allocator, &alone, nullptr});
    PILEUS_TRY(begin_flight(packed.data, packed.size, block.use().bytes, options, in_place, false,
                            scene_and_world, session));
    need.small = kSmallBytes + (scene_and_world.world->direct_sky ? kSkySmallBytes : 0);
    const Scene& scene = scene_and_world.scene;
    const auto& size = scene.camera.resolution;
    {
        const HostGuard own(Host{});
        PILEUS_TRY(pixels.resize(std::uint64_t(size[0]) * std::uint64_t(size[1]) * 16, "picture"));
    }
    PILEUS_TRY(draw(session, pixels));
    (void)block.seal();  // small objects lie elsewhere
    session.seal();
    // Where views decide, there is nothing to tell.
    if (!session.most_units({}, need.most)) need.most = {};
    for (int number = 1; number < 8; ++number) {
        PILEUS_TRY(set_frame(scene, number, session));
        std::uint64_t done = 0;
        if (session.light().whole > 0) PILEUS_TRY(session.step(1, done));
        PILEUS_TRY(draw(session, pixels));
    }
    return Status::ok();
}

/// The need of a flight that reads arrays in place, or has its own.
Status measure(Span<const char> packed, const RenderOptions& options, bool in_place,
               FlightNeed& need) {
    // Memory that is not touched costs nothing, so that more than enough may be asked for.
    for (std::uint64_t bytes = 64u << 20;; bytes *= 4) {
        Buffer<unsigned char> memory;
        PILEUS_TRY(memory.resize(bytes, "trial block"));
        Block* const block = Block::make(memory.data(), memory.size());
        const Status status = fly(packed, options, in_place, *block, need);
        const BlockUse& use = block->use();
        if (use.refused > 0 && bytes < std::uint64_t{1} << 36) continue;
        PILEUS_TRY(status);
        need.kept = use.kept_bytes;
        need.open = use.open_bytes;
        need.frame = use.frame_bytes;
        const std::uint64_t flown = need.kept + 2 * need.frame;
        need.block = (need.open > flown ? need.open : flown) + need.small;
        need.block = (need.block + kUnit - 1) / kUnit * kUnit;
        return Status::ok();
    }
}

}  // namespace

Status measure_flight(const std::string& packed, const RenderOptions& given, FlightNeed& need) {
    RenderOptions options = given;
    options.threads = 1;
    Buffer<char> bytes;
    PILEUS_TRY(bytes.resize(packed.size(), "packed scene"));
    std::memcpy(bytes.data(), packed.data(), packed.size());
    const Span<const char> scene{bytes.data(), bytes.size()};
    FlightNeed in_place;
    PILEUS_TRY(measure(scene, options, true, in_place));
    PILEUS_TRY(measure(scene, options, false, need));
    need.in_place = in_place.block;
    return Status::ok();
}

}  // namespace pileus
