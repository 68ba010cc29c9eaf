// SPDX-License-Identifier: Apache-2.0
// What method `particles` keeps between its calls.
// in: a scene -> out: its octree, light at each particle, planes of pixels.
// docs/particles.md, "The method".
#pragma once
#include <array>

#include "kernels_cpu/particles/particle_board_params.h"
#include "src/methods/method.h"
#include "src/picture/layers.h"
#include "src/picture/nodes/sky_nodes.h"
#include "src/picture/ordinates/ordinates.h"
#include "src/world/majorant/majorants.h"
#include "src/world/particles/particle_tree.h"

namespace pileus {

/// How much of the extinction towards the sun counts for an order of its light, how much of the
/// light it is, and its Henyey-Greenstein phase function; the first has the medium's.
struct ParticleOrder {
    float extinction = 1, share = 1, g = 0;
};

struct ParticlesState {
    ParticlesSettings settings;   ///< the scene's, with the bins of the budget
    bool outlined_only = true;    ///< sizes are known, values are not
    bool hosted = false;          ///< a host's pictures have no layers of files
    std::uint64_t particles = 0;  ///< once they are read; before: 0
    ParticleTree tree;
    Majorants majorants;             ///< of the grid, which ground and solids see
    Buffer<ParticleBall> occluders;  ///< empty: all cast shadows
    int light_orders = 1;            ///< of a light's light
    int orders = 0;                  ///< of the sun's; 0: no sun
    std::array<ParticleOrder, kMaxParticleOrders> order{};
    Buffer<ParticleShade> shade;  ///< [ball]
    Buffer<float> sky;            ///< [channel][ball]; empty: none
    Buffer<float> seen;           ///< [ball]: share of the sun that solids leave; empty: all
    Buffer<float> lamp_depth, lamp_reach, lamp_seen;  ///< [lamp][ball]
    /// [channel][ball]: light of lamps and sky, or all that balls send on of it and their own
    /// (has_own_light); empty: `sky` alone.
    Buffer<float> around_balls;
    SkyNodes sky_nodes;
    OrdinateNodes ordinates;  ///< of scattering = "ordinates", in place of the sky's nodes
    bool lit = false;         ///< for the sun and the lamps below
    std::array<float, 3> to_sun{};
    std::vector<LampParams> lamps;
    CameraParams camera{};
    Planes planes;
};

namespace arrays {

inline Array<ParticleShade> particle_shades(std::uint64_t particles) {
    return {"particles' depths towards the sun", particles, Stage::kShadow, Stage::kWrite};
}
/// From one place in each particle after the other.
inline Array<float> particle_depths(std::uint64_t particles, int samples) {
    return {"particles' single depths", bytes_of(particles, std::uint64_t(samples)), Stage::kShadow,
            Stage::kShadow};
}
/// For each lamp, and so often: depths, their growth over a radius, shares that solids leave.
inline Array<float> particle_lamps(std::uint64_t particles, std::uint64_t lamps) {
    return {"particles' depths towards lights", bytes_of(particles, lamps), Stage::kShadow,
            Stage::kWrite};
}
inline Array<float> particle_seen(std::uint64_t particles) {
    return {"shadow of solids on particles", particles, Stage::kShadow, Stage::kWrite};
}
inline Array<float> particle_around(std::uint64_t particles) {
    return {"particles' light around", bytes_of(particles, 3), Stage::kDisplay, Stage::kWrite};
}
inline Array<float> particle_sky(std::uint64_t particles) {
    return {"particles' skylight", bytes_of(particles, 3), Stage::kShadow, Stage::kWrite};
}
inline Array<float> particle_bins(std::uint64_t threads, std::int32_t bins) {
    return {"bins along rays", bytes_of(threads, particle_scratch_floats(bins)), Stage::kDisplay,
            Stage::kDisplay};
}

/// Share of the sky that each ball sees, tiles that find it, and a picture of it.
inline Array<float> particle_occlusion(std::uint64_t particles, std::uint64_t pixels) {
    return {"occlusion", sum_of_bytes(bytes_of(particles, 9), bytes_of(pixels, 5)), Stage::kDisplay,
            Stage::kLayers};
}

inline Array<ParticleBoard> particle_boards(std::uint64_t particles) {
    return {"billboards", particles, Stage::kDisplay, Stage::kDisplay};
}

}  // namespace arrays

/// Most bins along a ray.
constexpr int kMaxParticleBins = 4096;

/// Places in each particle that are lit.
inline int light_samples(const ParticlesSettings& settings) {
    return settings.light == ParticleLight::kCentre ? 1 : 4;
}

/// Whether balls differ in colour or shine.
bool has_own_light(const FrameView& view, const ParticlesState& state);

/// [channel][ball]: light of sky and lamps; null: none.
inline const float* light_from_around(const ParticlesState& state) {
    return state.around_balls.empty() ? state.sky.data() : state.around_balls.data();
}

/// The orders that a scene asks for.
void choose_orders(const FrameView& view, ParticlesState& state);

/// Light at every particle, for the sun of the view; kept while that stays. kLimit: out
/// of memory.
Status light_particles(const Context& context, const FrameView& view, ParticlesState& state);

/// What nodes hold, [set][node], each set in its colour, at every ball, into `sky`, which there is.
void light_by_nodes(const Context& context, const NodeGrid& grid, const float* light,
                    std::size_t sets, const float (*colours)[3], ParticlesState& state);
/// Solves for the light of the view; the nodes are prepared. kLimit: out of memory.
Status solve_particles(const Context& context, const FrameView& view, ParticlesState& state);
/// What solutions send from each ball towards the camera, into `sky`. kLimit: out of memory.
Status light_by_ordinates(const Context& context, const FrameView& view, ParticlesState& state);
/// Whether light is solved for so.
inline bool by_ordinates(const ParticlesState& state) { return !state.ordinates.density.empty(); }

/// Whether particles move while the shutter is open.
bool moves(const FrameView& view, const ParticlesState& state);

/// As billboards, into the planes; `march` tells their light. The tree holds a ball. kLimit: out
/// of memory.
Status show_boards(const Context& context, const FrameView& view, const ParticleMarchParams& march,
                   ParticlesState& state);

/// Light at each ball alone, of what is around it: no sun.
ParticleMarchParams lit_from_around(const FrameView& view, const ParticlesState& state);

/// By the scene's display, into the planes. The tree holds a ball. kLimit: out of memory.
Status draw_particles(const Context& context, const FrameView& view, const ParticleMarchParams& k,
                      ParticlesState& state);

/// Into state.planes.occlusion, after the picture. kLimit: out of memory.
Status show_occlusion(const Context& context, const FrameView& view, ParticlesState& state);

/// Data of whole rays, where layers show them: after all that looks at where colours end. kLimit:
/// out of memory.
Status follow_particles(const Context& context, const FrameView& view, ParticlesState& state);

/// Into the planes. kLimit: out of memory.
Status show_particles(const Context& context, const FrameView& view, ParticlesState& state);

}  // namespace pileus
