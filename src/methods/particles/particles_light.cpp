// SPDX-License-Identifier: Apache-2.0
// See particles_state.h. Sunlight and skylight at every particle, and the march of a picture.
// in: an octree, lights -> out: light per particle; planes of pixels.
// docs/particles.md, "Light", "Display".
#include "kernels_cpu/display/march_ray.h"
#include "kernels_cpu/particles/particle_light.h"
#include "platform/threads.h"
#include "src/methods/particles/light_places.h"
#include "src/methods/particles/particles_state.h"
#include "src/methods/particles/sun_tiles.h"
#include "src/methods/particles/view_tiles.h"
#include "src/picture/nodes/node_grid.h"
#include "src/world/phase/forward_share.h"

namespace pileus {
namespace {

/// What scattering leaves in place of light scattered once: octaves as raymarch has them.
Octaves octaves_of(const ParticlesState& state) {
    const ParticlesSettings& s = state.settings;
    const bool many = s.scattering == ParticleScattering::kOctaves;
    return {many ? s.octaves.count : 1, float(s.octaves.extinction), float(s.octaves.share)};
}

/// Corners of a tetrahedron of unit arms along light_axes: two opposite edges lie across the light,
/// so that a mirror image of light and balls has the mirrored corners.
constexpr float kAcross = 0.81649658093f, kAlong = 0.57735026919f;
constexpr float kCorners[4][3] = {
    {kAcross, 0, -kAlong}, {-kAcross, 0, -kAlong}, {0, kAcross, kAlong}, {0, -kAcross, kAlong}};
/// Their distance from the centre, in radii: along any axis their mean square is that of a ball's
/// extinction, 1/9.
constexpr float kReach = 0.57735026919f;

Status light_by_sun(const Context& context, const FrameView& view, ParticlesState& state) {
    const StageClock clock(context, "light");
    const std::size_t count = state.tree.balls.size();
    const LightPlaces places = light_places(state.settings, view.lighting.to_sun);
    PILEUS_TRY(allocate_once(arrays::particle_shades(count), state.shade));
    Buffer<float> depths;
    PILEUS_TRY(allocate(arrays::particle_depths(count, places.count), depths));
    SunTiles tiles;
    PILEUS_TRY(make_sun_tiles(context, state.tree, casts_of(state), view.lighting.to_sun, tiles));
    const double most = state.settings.shadows.most_depth;
    for (int n = 0; n < places.count; ++n)
        PILEUS_TRY(sun_depths(context, tiles, places.offset[n], most > 0 ? float(most) : 3e38f,
                              depths.data() + std::size_t(n) * count, n, places.count));
    parallel_each(context.threads, count, [&](std::size_t i) {
        state.shade[i] = shade_of(depths.data() + i, count, places);
    });
    return Status::ok();
}

}  // namespace

void light_by_nodes(const Context& context, const NodeGrid& grid, const float* light,
                    std::size_t sets, const float (*colours)[3], ParticlesState& state) {
    const std::size_t count = state.tree.balls.size(), nodes = std::size_t(node_count(grid));
    parallel_each(context.threads, count, [&](std::size_t i) {
        float sum[3] = {};
        const float* p = state.tree.balls[i].centre;
        const Corners<float> at =
            node_corners(node_position(grid, Vec<float>{p[0], p[1], p[2]}), grid.size, false);
        for (std::size_t s = 0; s < sets; ++s) {
            const float between = interpolate(light + s * nodes, at);
            for (int c = 0; c < 3; ++c) sum[c] += (between > 0 ? between : 0) * colours[s][c];
        }
        for (std::size_t c = 0; c < 3; ++c) state.sky[c * count + i] = sum[c];
    });
}

LightPlaces light_places(const ParticlesSettings& settings, const std::array<float, 3>& to_light) {
    LightPlaces places;
    places.count = light_samples(settings);
    const float bias = float(settings.shadows.bias);
    const LightAxes<float> axes = light_axes(Vec<float>{to_light[0], to_light[1], to_light[2]});
    for (int n = 0; n < places.count; ++n) {
        const Vec<float> arm = along_axes(axes, kCorners[n]);
        places.arm[n] = {arm.x, arm.y, arm.z};
        for (std::size_t a = 0; a < 3; ++a) {
            const float own = places.count > 1 ? kReach * places.arm[n][a] : 0.0f;
            places.offset[n][a] = own + bias * to_light[a];
        }
    }
    return places;
}
LightPlaces light_places(const ParticlesSettings& settings, const LampParams& lamp) {
    if (lamp.parallel != 0)
        return light_places(settings, std::array<float, 3>{lamp.at[0], lamp.at[1], lamp.at[2]});
    LightPlaces places;
    places.count = light_samples(settings);
    places.turned = places.count > 1;
    for (int n = 0; n < places.count; ++n)
        for (std::size_t a = 0; a < 3 && places.turned; ++a) {
            places.arm[n][a] = kCorners[n][a];
            places.offset[n][a] = kReach * kCorners[n][a];
        }
    return places;
}

ParticleShade shade_of(const float* depths, std::size_t stride, const LightPlaces& places) {
    if (places.count == 1) return {depths[0], {0, 0, 0}};
    ParticleShade shade{};
    const float d[4] = {depths[0], depths[stride], depths[2 * stride], depths[3 * stride]};
    // Pair by pair, as mirrors exchange them.
    shade.depth = 0.25f * ((d[0] + d[1]) + (d[2] + d[3]));
    for (std::size_t a = 0; a < 3; ++a)
        shade.slope[a] = 0.75f / kReach *
                         ((places.arm[0][a] * d[0] + places.arm[1][a] * d[1]) +
                          (places.arm[2][a] * d[2] + places.arm[3][a] * d[3]));
    return shade;
}

void choose_orders(const FrameView& view, ParticlesState& state) {
    const ParticlesSettings& s = state.settings;
    const Optics& optics = view.world.medium.optics[0];
    const float mean_cosine = phase_moment(optics.phase, 1);
    double albedo = 0;
    for (const float a : optics.albedo) albedo += double(a) / 3;
    state.order[0] = ParticleOrder{};
    if (s.scattering == ParticleScattering::kEffective)
        state.order[0].extinction =
            float(1 - albedo * forward_share(optics.phase, 0.5 * s.octaves.cone_deg));
    if (s.scattering == ParticleScattering::kSimilarity)
        state.order[0].extinction = float(1 - albedo * double(mean_cosine));
    // A denser shadow is one of more extinction on the way of the light alone.
    // The first order of the sun loses what turns out of the peak of the phase function.
    if (by_ordinates(state)) state.order[0].extinction = state.ordinates.optics[0][0].rest;
    state.order[0].extinction *= float(s.shadows.density);
    state.light_orders = s.scattering == ParticleScattering::kOctaves ? s.octaves.count : 1;
    state.orders = view.lighting.sunlit ? state.light_orders : 0;
    for (std::size_t n = 1; n < std::size_t(state.light_orders); ++n) {
        const ParticleOrder& before = state.order[n - 1];
        const float g = n == 1 ? mean_cosine : before.g;
        state.order[n] = {before.extinction * float(s.octaves.extinction),
                          before.share * float(s.octaves.share), g * float(s.octaves.anisotropy)};
    }
}

Status light_particles(const Context& context, const FrameView& view, ParticlesState& state) {
    // Keys that move the media move what shines on them.
    if (state.lit && state.to_sun == view.lighting.to_sun &&
        same_lamps(state.lamps, view.lighting.lamps))
        return Status::ok();
    state.lit = false;
    choose_orders(view, state);
    if (state.tree.balls.empty()) return Status::ok();
    const double share = state.settings.shadows.occluders;
    if (share < 1 && state.occluders.empty())
        PILEUS_TRY(choose_occluders(state.tree, share, state.occluders));
    if (state.settings.light != ParticleLight::kExact) {
        if (state.orders > 0)
            PILEUS_TRY(light_by_sun(context, view, state));
        else
            PILEUS_TRY(
                allocate_once(arrays::particle_shades(state.tree.balls.size()), state.shade));
    }
    if (view.world.solids.meshes && state.orders > 0) {
        const StageClock clock(context, "solid shadow");
        PILEUS_TRY(allocate_once(arrays::particle_seen(state.tree.balls.size()), state.seen));
        LampParams sun{};
        sun.parallel = 1;
        for (int a = 0; a < 3; ++a) sun.at[a] = view.lighting.to_sun[std::size_t(a)];
        see_past_solids(context, view, state, sun, state.seen.data());
    }
    PILEUS_TRY(light_by_lamps(context, view, state));
    if (by_ordinates(state)) {
        PILEUS_TRY(solve_particles(context, view, state));
    } else if (state.settings.sky_ambient) {
        state.sky_nodes.seen.truncate(0);  // the medium may be another frame's
        PILEUS_TRY(make_sky_nodes(context, view.world.medium, state.majorants, view.lighting, 0,
                                  octaves_of(state), SkyView{}, state.sky_nodes));
        state.sky.truncate(0);
        if (state.sky_nodes.sets > 0) {
            PILEUS_TRY(allocate_once(arrays::particle_sky(state.tree.balls.size()), state.sky));
            const SkyNodes& nodes = state.sky_nodes;
            light_by_nodes(context, nodes.grid, nodes.light.data(), std::size_t(nodes.sets),
                           nodes.colour, state);
        }
    }
    state.lit = true;
    state.to_sun = view.lighting.to_sun;
    state.lamps = view.lighting.lamps;
    return Status::ok();
}

namespace {

ParticleMarchParams march_params(const FrameView& view, const ParticlesState& state) {
    const ParticlesSettings& s = state.settings;
    const Optics& optics = view.world.medium.optics[0];
    ParticleMarchParams k{};
    k.view = state.tree.view();
    k.camera = state.camera;
    k.bins = state.settings.bins;
    k.orders = state.orders;
    k.phase = optics.phase;
    k.cut = float(s.stop_below);
    k.exact = s.light == ParticleLight::kExact ? 1 : 0;
    k.most = s.shadows.most_depth > 0 ? float(s.shadows.most_depth) : 3e38f;
    for (int a = 0; a < 3; ++a) {
        k.sun_travel[a] = -view.lighting.to_sun[std::size_t(a)];
        k.albedo[a] = has_own_light(view, state) ? 1 : optics.albedo[a];
    }
    float absorbed[3] = {1, 1, 1};
    for (int n = 0; n < state.light_orders; ++n) {
        const ParticleOrder& order = state.order[std::size_t(n)];
        k.order_g[n] = order.g;
        k.thinner[n] = order.extinction;
        for (int c = 0; c < 3; ++c) {
            // Each octave is scattered once more.
            absorbed[c] *= optics.albedo[c];
            k.sun[n][c] = float(view.lighting.sun_irradiance[c]) * absorbed[c] * order.share;
        }
    }
    return k;
}

}  // namespace

Status show_particles(const Context& context, const FrameView& view, ParticlesState& state) {
    Planes& planes = state.planes;
    if (state.tree.balls.empty()) {
        for (float& t : planes.transmittance.span()) t = 1;
        for (float& d : planes.half_depth.span()) d = __builtin_inff();
        return Status::ok();
    }
    if (by_ordinates(state)) PILEUS_TRY(light_by_ordinates(context, view, state));
    const ParticleMarchParams k = march_params(view, state);
    PILEUS_TRY(light_around(context, view, k, state));
    return draw_particles(context, view, k, state);
}

ParticleMarchParams lit_from_around(const FrameView& view, const ParticlesState& state) {
    ParticleMarchParams k = march_params(view, state);
    k.orders = 0;
    for (float& v : k.albedo) v = 1;
    return k;
}

Status draw_particles(const Context& context, const FrameView& view, const ParticleMarchParams& k,
                      ParticlesState& state) {
    Planes& planes = state.planes;
    if (state.settings.billboards) return show_boards(context, view, k, state);
    const StageClock clock(context, "march");
    ParticleMarchBuffers b{};
    b.shade = state.shade.data();
    b.sky = light_from_around(state);
    b.seen = state.seen.data();
    b.tint = state.tree.colour.data();
    b.balls = state.tree.balls.size();
    b.opaque_depth = planes.opaque_depth.data();
    b.transmittance = planes.transmittance.data();
    b.colour = planes.colour.data();
    b.half_depth = planes.half_depth.data();
    b.optical_depth = planes.optical_depth.data();
    return march_particles(context, state.tree, k, b);
}

}  // namespace pileus
