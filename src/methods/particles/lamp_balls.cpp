// SPDX-License-Identifier: Apache-2.0
// Light of points, spots and parallel lights at every particle, and the shadow of solids on them.
// in: an octree, lamps, solids -> out: depths to each lamp; light that balls scatter to the camera.
// Monette and Whitehead 2014, 3.3 and 3.4; docs/particles.md, "Lights".
#include "kernels_cpu/particles/particle_lamps.h"
#include "kernels_cpu/solids/solids.h"
#include "platform/threads.h"
#include "src/methods/particles/light_places.h"
#include "src/methods/particles/sun_tiles.h"
#include "src/run/device_launch.h"
#include "src/run/on_device.h"

namespace pileus {
namespace {

constexpr std::size_t kBallsAtOnce = 256;

/// The stage whose progress is reported, the share of it that is done and that is to do.
struct Progress {
    const char* stage;
    double from, share;
};

/// A kernel for all balls: in pieces, or at once on a device.
template <class Kernel, class Params, class Buffers>
Status over_balls(const Context& context, Kernel kernel, const Params& k, const Buffers& b,
                  std::size_t count, const Progress& told) {
    if (on_device(context.kernels->device))
        return launch_on_device(*context.kernels->device, k, b, std::uint32_t(count));
    const std::size_t pieces = (count - 1) / kBallsAtOnce + 1;
    parallel_for(context.threads, std::int64_t(pieces), [&](std::int64_t piece, int thread) {
        if (thread == 0)
            context.tell(told.stage, told.from + told.share * double(piece) / double(pieces));
        const std::size_t begin = std::size_t(piece) * kBallsAtOnce;
        kernel(k, b, std::uint32_t(begin), std::uint32_t(std::min(begin + kBallsAtOnce, count)));
    });
    return Status::ok();
}

/// Of place number `n` in a ball.
std::array<float, 3> offset_in(const ParticleBall& ball, const LampParams& lamp,
                               const LightPlaces& places, int n) {
    const std::array<float, 3>& own = places.offset[n];
    if (!places.turned) return own;
    const Vec<float> way{lamp.at[0] - ball.centre[0], lamp.at[1] - ball.centre[1],
                         lamp.at[2] - ball.centre[2]};
    const Vec<float> moved = along_axes(light_axes(way), {own[0], own[1], own[2]});
    return {moved.x, moved.y, moved.z};
}

/// Share of a ball's places that a lamp reaches past the solids, what is left in their shadow
/// included.
float seen_by(const SolidsView& solids, const ParticleBall& ball, const LampParams& lamp,
              const LightPlaces& places, float left) {
    float seen = 0;
    const bool sphere = lamp.radius > 0;
    const int looks = sphere ? lamp.places : 1;
    const float turn = sphere ? turn_of_ball(ball) : 0;
    for (int n = 0; n < places.count; ++n) {
        const std::array<float, 3> offset = offset_in(ball, lamp, places, n);
        for (int i = 0; i < looks; ++i) {
            float o[3], d[3], square = 0, limit = 3e38f;
            for (int a = 0; a < 3; ++a) {
                o[a] = ball.centre[a] + offset[std::size_t(a)] / ball.per_radius;
                d[a] = lamp.parallel != 0 ? lamp.at[a] : lamp.at[a] - o[a];
                square += d[a] * d[a];
            }
            if (sphere) {
                const Vec<float> from{o[0], o[1], o[2]};
                const LampSight<float> place = lamp_place(lamp, lamp_cone(lamp, from), i, turn);
                d[0] = place.way.x, d[1] = place.way.y, d[2] = place.way.z;
                limit = place.distance;
            } else if (lamp.parallel == 0) {
                limit = __builtin_sqrtf(square);
                for (float& v : d) v /= limit > 0 ? limit : 1;
            }
            seen += limit > 0 && solid_between(solids, o, d, limit) ? left : 1;
        }
    }
    return seen / float(places.count * looks);
}

}  // namespace

void see_past_solids(const Context& context, const FrameView& view, const ParticlesState& state,
                     const LampParams& lamp, float* seen) {
    const SolidsView solids = view.world.solids.view();
    // Meshes may have no triangle with an area: then there is no tree to walk.
    if (solids.count == 0) {
        for (std::size_t i = 0; i < state.tree.balls.size(); ++i) seen[i] = 1;
        return;
    }
    const LightPlaces places = light_places(state.settings, lamp);
    const float left = float(state.settings.shadows.solid);
    parallel_each(context.threads, state.tree.balls.size(), [&](std::size_t i) {
        seen[i] = seen_by(solids, state.tree.balls[i], lamp, places, left);
    });
}

Status light_by_lamps(const Context& context, const FrameView& view, ParticlesState& state) {
    const std::vector<LampParams>& lamps = view.lighting.lamps;
    if (lamps.empty()) return Status::ok();
    const StageClock clock(context, "lights");
    const std::size_t count = state.tree.balls.size();
    PILEUS_TRY(allocate_once(arrays::particle_lamps(count, lamps.size()), state.lamp_depth));
    PILEUS_TRY(allocate_once(arrays::particle_lamps(count, lamps.size()), state.lamp_reach));
    if (view.world.solids.meshes)
        PILEUS_TRY(allocate_once(arrays::particle_lamps(count, lamps.size()), state.lamp_seen));
    const double most = state.settings.shadows.most_depth;
    Buffer<float> depths;
    for (std::size_t l = 0; l < lamps.size(); ++l) {
        const LampParams& lamp = lamps[l];
        const LightPlaces places = light_places(state.settings, lamp);
        PILEUS_TRY(allocate_once(arrays::particle_depths(count, places.count), depths));
        SunTiles tiles;
        if (lamp.parallel != 0)
            PILEUS_TRY(make_sun_tiles(context, state.tree, casts_of(state),
                                      {lamp.at[0], lamp.at[1], lamp.at[2]}, tiles));
        ParticleLampDepths k{};
        k.view = state.tree.view();
        k.lamp = lamp;
        k.most = most > 0 ? float(most) : 3e38f;
        for (int n = 0; n < places.count; ++n) {
            const ParticleLampDepthBuffers b{depths.data() + std::size_t(n) * count};
            if (lamp.parallel != 0) {
                PILEUS_TRY(sun_depths(context, tiles, places.offset[n], k.most, b.depth));
                continue;
            }
            for (std::size_t a = 0; a < 3; ++a) k.offset[a] = places.offset[n][a];
            k.turned = places.turned ? 1 : 0;
            const double steps = double(lamps.size()) * places.count;
            PILEUS_TRY(over_balls(context, context.kernels->particle_lamp_depths, k, b, count,
                                  {"lights", (double(l) * places.count + n) / steps, 1 / steps}));
        }
        parallel_each(context.threads, count, [&](std::size_t i) {
            const ParticleShade s = shade_of(depths.data() + i, count, places);
            float square = 0;
            for (const float v : s.slope) square += v * v;
            state.lamp_depth[l * count + i] = s.depth;
            state.lamp_reach[l * count + i] = __builtin_sqrtf(square);
        });
        if (view.world.solids.meshes)
            see_past_solids(context, view, state, lamp, state.lamp_seen.data() + l * count);
    }
    return Status::ok();
}

bool has_own_light(const FrameView& view, const ParticlesState& state) {
    return !state.tree.colour.empty() || emits(view.world.medium);
}

namespace {

/// Light of the lamps and the sky at each ball, before it is scattered there.
Status gather_lamps(const Context& context, const FrameView& view, const ParticleMarchParams& k,
                    ParticlesState& state) {
    const std::vector<LampParams>& lamps = view.lighting.lamps;
    const std::size_t count = state.tree.balls.size();
    ParticleLampLight b{};
    b.lamps = lamps.data();
    b.count = std::int32_t(lamps.size());
    b.orders = state.light_orders;
    const Optics& optics = view.world.medium.optics[0];
    float absorbed[3] = {1, 1, 1};
    for (int n = 0; n < b.orders; ++n)
        for (int c = 0; c < 3; ++c) {
            b.share[n][c] = absorbed[c] * state.order[std::size_t(n)].share;
            absorbed[c] *= optics.albedo[c];
        }
    b.depth = state.lamp_depth.data();
    b.reach = state.lamp_reach.data();
    b.seen = state.lamp_seen.data();
    b.sky = state.sky.data();
    b.tint = state.tree.colour.data();
    b.light = state.around_balls.data();
    b.balls = count;
    return over_balls(context, context.kernels->particle_lamp_light, k, b, count,
                      {"light of lights", 0, 1});
}

/// What each ball sends on of the light `around` [channel][ball], null: none, and of its own.
void add_own_light(const Context& context, const FrameView& view, const float* around,
                   ParticlesState& state) {
    const std::size_t count = state.tree.balls.size();
    const Optics& optics = view.world.medium.optics[0];
    const auto factor = [](const Buffer<float>& vectors, std::size_t i, std::size_t c) {
        return vectors.empty() ? 1.0f : vectors[3 * i + c];
    };
    parallel_each(context.threads, count, [&](std::size_t i) {
        for (std::size_t c = 0; c < 3; ++c) {
            const float light = around != nullptr ? around[c * count + i] : 0;
            state.around_balls[c * count + i] =
                optics.albedo[c] * factor(state.tree.colour, i, c) * light +
                optics.emission[c] * factor(state.tree.emission, i, c);
        }
    });
}

}  // namespace

Status light_around(const Context& context, const FrameView& view, const ParticleMarchParams& k,
                    ParticlesState& state) {
    const bool lamps = !view.lighting.lamps.empty(), own = has_own_light(view, state);
    if (!lamps && !own) {
        return state.around_balls.resize(0, "particles' light around");
    }
    const StageClock clock(context, "light of lights");
    PILEUS_TRY(allocate_once(arrays::particle_around(state.tree.balls.size()), state.around_balls));
    if (lamps) PILEUS_TRY(gather_lamps(context, view, k, state));
    if (own)
        add_own_light(context, view, lamps ? state.around_balls.data() : state.sky.data(), state);
    return Status::ok();
}

}  // namespace pileus
