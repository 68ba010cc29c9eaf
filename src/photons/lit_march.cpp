// SPDX-License-Identifier: Apache-2.0
// See lit_march.h.
// in: sums, nodes, a camera -> out: planes.
// docs/methods.md 3, each image frame, steps 4 and 5; repairs 3 and 4.
#include "src/photons/lit_march.h"

#include "platform/threads.h"
#include "src/methods/scenery.h"
#include "src/picture/background.h"
#include "src/picture/late_rows.h"
#include "src/picture/march_view.h"
#include "src/picture/nodes/node_rows.h"
#include "src/picture/nodes/solid_shadow.h"
#include "src/run/on_device.h"
#include "src/world/camera/view.h"
#include "src/world/light/behind.h"

namespace pileus {
namespace {

constexpr float kCut = 1e-4f;  // transmittance that no eye misses
/// What lies behind three quarters of the light's extinction is seen more coarsely: against even
/// steps relMSE 1e-6 on the default cumulus (docs/performance.md, "A march's steps").
constexpr float kWiderBelow[kWiderSteps] = {0.25f, 0.05f, 0.01f};

MediumView medium_of(const FrameView& view, const PhotonState& state) {
    return make_medium_view(view.world.medium, state.majorants);
}

NodeGrid shadow_grid(const FrameView& view) {
    return make_half_grid(view.world.medium.grid, view.world.medium.extent_m);
}

/// Of each medium's extinction what counts where turns within the peak do not.
void set_rest(const Medium& medium, const Beam& beam, float (&rest)[kMaxMedia][3]) {
    for (int i = 0; i < medium.count; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            rest[i][c] = float(counting_share(medium.optics[std::size_t(i)], c, beam.shares[i]));
}

/// Of extinction what counts in every medium.
double least_rest(const Medium& medium, const Beam& beam, std::size_t channel) {
    double least = 1;
    for (int i = 0; i < medium.count; ++i)
        least =
            std::min(least, counting_share(medium.optics[std::size_t(i)], channel, beam.shares[i]));
    return least;
}

SunTurn turn_of(const FrameView& view, const PhotonState& state) {
    return turn_of_sun(view, state.shadow.light_refresh, state.picture.turn);
}

}  // namespace

namespace {

/// What scatterings within the peak leave in the sun's beam and in lamps'.
Status make_beam_tables(const Context& context, const FrameView& view, PhotonState& state) {
    const float peak_turn = state.lights.deposit.peak_turn;
    Beam& beam = state.shadow.beam;
    const bool points = beam_of_points(view, state);
    if (!(peak_turn > 0) || (beam.sets > 0 && (beam.points || !points))) return Status::ok();
    const StageClock clock(context, "shadow");
    const bool apart = state.lights.deposit.apart();
    PILEUS_TRY(make_beam(view.world.medium, peak_turn, points,
                         apart ? BeamTurns::kPeak : BeamTurns::kAll, context.threads,
                         Stage::kShadow, beam));
    if (apart)
        set_horizon(view.world.medium, beam, state.lights.deposit.peak_deg, state.shadow.behind);
    return Status::ok();
}

}  // namespace

Status make_sun_shadow(const Context& context, const FrameView& view, PhotonState& state) {
    PILEUS_TRY(make_beam_tables(context, view, state));
    const Lighting& lighting = state.lights.lighting;
    const DepositPlan& deposit = state.lights.deposit;
    SunShadow& shadow = state.shadow;
    if (!lighting.sunlit || deposit.first_order != 2) return Status::ok();
    const StageClock clock(context, "shadow");
    shadow.nodes = shadow_grid(view);
    if (shadow.depth.size() != node_count(shadow.nodes)) shadow.slices.held.clear();
    PILEUS_TRY(
        allocate_once(arrays::shadow(node_count(shadow.nodes), Stage::kShadow), shadow.depth));
    ShadowParams k{};
    k.medium = medium_of(view, state);
    k.nodes = shadow.nodes;
    const std::vector<int> due = follow_sun(turn_of(view, state), shadow.slices);
    ShadowBuffers b{shadow.depth.data()};
    std::vector<NodeRange> rows;
    if (!due.empty()) {
        rows = nodes_in_medium(k.nodes, k.medium);
        b.rows = rows.data();
    }
    for (const int slice : due) {
        const SunDirection& sun = shadow.slices.held[std::size_t(slice)];
        for (std::size_t a = 0; a < 3; ++a) k.to_sun[a] = sun[a];
        PILEUS_TRY(make_shadow_slice(context, k, b, slice, shadow.light_refresh));
    }
    if (lighting.solids != nullptr && !shadow.ready)
        PILEUS_TRY(solid_visibility(context, *lighting.solids, shadow.nodes, lighting.to_sun,
                                    shadow.visibility));
    shadow.ready = true;
    return Status::ok();
}

void forget_sun_shadow(PhotonState& state) {
    state.shadow.ready = false;
    state.shadow.slices.held.clear();
    state.picture.ground_shadow.slices.held.clear();
}

std::uint64_t sun_shadow_numbers(const FrameView& view) {
    return node_count(shadow_grid(view)) * (view.world.solids.meshes ? 2 : 1);
}

namespace {

bool same_nodes(const NodeGrid& a, const NodeGrid& b) {
    for (int i = 0; i < 3; ++i)
        if (a.size[i] != b.size[i] || a.per_metre[i] != b.per_metre[i]) return false;
    return true;
}

/// Nodes hold colours, not harmonics alone.
bool reads_planes(const MarchParams& k) { return k.bands == 0 || k.near.size[0] > 0; }

/// Puts what a march reads of each node side by side.
Status pack_nodes(const Context& context, const NodeGrid& nodes, const MediumView& medium,
                  PhotonState& state, NodeLight& light) {
    if (light.quads != nullptr) return Status::ok();
    const StageClock clock(context, "pack");
    const std::size_t count = std::size_t(node_count(nodes));
    PILEUS_TRY(allocate_once(arrays::lit_quads(count), state.picture.lit_quads));
    const float* depth = sun_depths_at(state.shadow, nodes);
    const std::vector<NodeRange> rows = nodes_in_medium(nodes, medium);
    const std::size_t ny = std::size_t(nodes.size[1]), nx = std::size_t(nodes.size[0]);
    parallel_for(context.threads, nodes.size[2], [&](std::int64_t z, int) {
        for (std::size_t row = std::size_t(z) * ny; row < (std::size_t(z) + 1) * ny; ++row)
            for (int x = rows[row].first; x < rows[row].last; ++x) {
                const std::size_t n = row * nx + std::size_t(x);
                float* quad = state.picture.lit_quads.data() + 4 * n;
                for (std::size_t c = 0; c < 3; ++c) quad[c] = light.planes[c * count + n];
                quad[3] = depth != nullptr ? depth[n] : 0.0f;
            }
    });
    light.quads = state.picture.lit_quads.data();
    light.depths = depth != nullptr;
    return Status::ok();
}

Status march_rows(const Context& context, const FrameView& view, const PhotonState& state,
                  const NodeLight& source, const MarchParams& params, float* target,
                  const float* surfaces, Planes& planes) {
    const StageClock clock(context, "march");
    MarchParams k = params;
    k.together = source.depths ? 1 : 0;
    MarchBuffers b{};
    b.quads = source.quads;
    b.near = source.near;
    b.optical_depth = state.shadow.depth.data();
    b.beam = state.shadow.beam.tables.data();
    b.source = source.planes;
    b.opaque_depth = planes.opaque_depth.data();
    b.parts = view.world.medium.parts.data();
    b.transmittance = planes.transmittance.data();
    b.half_depth = planes.half_depth.data();
    b.colour = target;
    b.visibility = state.shadow.visibility.data();
    if (has_meshes(state.lights.lighting)) b.surfaces = surfaces;
    PILEUS_TRY(run_rows(context, march_kernel(*context.kernels, k.medium), k, b,
                        std::uint32_t(k.lattice.height)));
    return Status::ok();
}

}  // namespace

bool reads_quads(const Context& context, int channels, const NodeGrid& nodes) {
    return channels == 3 && node_count(nodes) > 1 && !on_device(context.kernels->device);
}

const float* sun_depths_at(const SunShadow& shadow, const NodeGrid& nodes) {
    const bool same = same_nodes(shadow.nodes, nodes) && shadow.depth.size() == node_count(nodes);
    return same ? shadow.depth.data() : nullptr;
}

Status march_lit(const Context& context, const FrameView& view, PhotonState& state,
                 const NodeLight& source, const MarchParams& k, float* target, Planes& planes) {
    NodeLight packed = source;
    if (reads_planes(k) && reads_quads(context, k.channels, k.source))
        PILEUS_TRY(pack_nodes(context, k.source, k.medium, state, packed));
    return march_rows(context, view, state, packed, k, target, planes.background.data(), planes);
}

Status march_thinned(const Context& context, const FrameView& view, const NodeLight& source,
                     const MarchParams& k, PhotonState& state, Planes& planes) {
    const UpsampleSettings& thin = state.picture.thin;
    if (thin.every() == 1)
        return march_lit(context, view, state, source, k, planes.colour.data(), planes);
    UpsampleMemory& memory = state.picture.upsample;
    planes.optical_depth = Buffer<float>();  // has its own march
    if (memory.camera.width != k.camera.width || memory.camera.height != k.camera.height ||
        memory.opaque_depth.size() != planes.opaque_depth.size())
        memory.ready = false;
    UpsampleInput in;
    in.settings = thin;
    in.camera = k.camera;
    in.medium = k.medium;
    in.to_sun = state.lights.lighting.to_sun;
    in.light =
        ((state.ring.relights + state.shadow.slices.made) << 32) + state.ring.next_generation;
    NodeLight packed = source;
    if (reads_planes(k) && reads_quads(context, k.channels, k.source))
        PILEUS_TRY(pack_nodes(context, k.source, k.medium, state, packed));
    in.march = [&](const PixelLattice& lattice, Planes& few) {
        MarchParams own = k;
        own.lattice = lattice;
        return march_rows(context, view, state, packed, own, few.colour.data(),
                          planes.background.data(), few);
    };
    return upsample_picture(context, in, state.picture.frame, memory, planes);
}

LateRows* late_photons(LateRows* late, const FrameView& view, const PhotonState& state) {
    if (photon_batches(state) > 0) return nullptr;
    return late_rows_of(late, state.lights.lighting, view.world.medium, state.picture.thin,
                        view.camera, view.frame);
}

void add_picture_rows(const Context& context, const FrameView& view, const PhotonState& state,
                      MemoryTable& table) {
    const auto& size = view.scene.camera.resolution;
    const Lighting& lighting = state.lights.lighting;
    const UpsampleSettings& thin = state.picture.thin;
    const std::uint64_t pixels = std::uint64_t(size[0]) * std::uint64_t(size[1]);
    add(table, arrays::ground_shadow(most_ground_nodes(view.world.medium, lighting, pixels)));
    add_upsample_row(thin, size, lighting.opaque(), view.wants_depth() || thin.temporal > 0, false,
                     context.frames > 1 ? Stage::kWrite : Stage::kDisplay, table);
}

float least_light(const FrameView& view, const PhotonState& state, const Lighting& light,
                  std::size_t channel) {
    const bool apart = state.lights.deposit.apart();
    const double share = apart ? least_rest(view.world.medium, state.shadow.beam, channel) : 1.0;
    return -float(share * light.constant[channel]);
}

namespace {

/// Turns within the peak go on as they came.
void set_apart(const FrameView& view, const PhotonState& state, const Lighting& light,
               MarchParams& k) {
    const Medium& medium = view.world.medium;
    const Beam& beam = state.shadow.beam;
    k.apart = medium.channels > 1 ? 3 : 1;
    k.peak_turn = state.lights.deposit.peak_turn;
    set_rest(medium, beam, k.rest);
    k.behind = state.shadow.behind;
    set_behind(light, light.ground.radiance(), k.behind);
    k.behind.hidden = view.environment.depth.present ? 1 : 0;
}

}  // namespace

MarchParams lit_march_params(const FrameView& view, const PhotonState& state, const LightInput& lit,
                             const NodeGrid& source) {
    const Lighting& light = *lit.lighting;
    MarchParams k{};
    k.medium = medium_of(view, state);
    k.camera = lit.camera;
    k.lattice = whole_lattice(lit.camera);
    k.media = view.world.medium.count;
    for (std::size_t c = 0; c < 3; ++c) {
        k.sun_travel[c] = -light.to_sun[c];
        k.constant[c] = float(light.constant[c]);
        k.least[c] = least_light(view, state, light, c);
    }
    for (int i = 0; i < view.world.medium.count; ++i) {
        const Optics& optics = view.world.medium.optics[std::size_t(i)];
        k.phase[i] = optics.phase;
        for (std::size_t c = 0; c < 3 && state.lights.deposit.first_order == 2; ++c)
            k.sun_source[i][c] = float(light.sun_irradiance[c] * double(optics.albedo[c]));
    }
    k.beam_sets =
        lit.first_order_alone || state.lights.deposit.first_order != 2 ? 0 : state.shadow.beam.sets;
    for (int c = 0; c < 3; ++c) k.beam_rest[c] = state.shadow.beam.rest[c];
    if (state.lights.deposit.apart() && !lit.first_order_alone) set_apart(view, state, light, k);
    k.shadow = state.shadow.nodes;
    k.source = source;
    k.channels = 3;
    k.cut = kCut;
    for (int i = 0; i < kWiderSteps && !view.world.medium.grid.constant; ++i)
        k.wider[i] = kWiderBelow[i];
    return k;
}

std::uint64_t near_nodes_of(const Context& context, const FrameView& view, const NodeGrid& nodes) {
    if (context.frames > 1) return most_near_nodes(nodes);
    const CameraParams camera = make_camera(view.scene.camera, 0, view.world.medium.low_m);
    return node_count(near_nodes(nodes, camera.origin));
}

int stored_harmonics(const DepositPlan& deposit) {
    const int numbers = deposit.bands * deposit.bands + axis_numbers(deposit);
    return (numbers + kHarmonicsAbreast - 1) / kHarmonicsAbreast * kHarmonicsAbreast;
}

void set_harmonic_sets(const LightInput& lit, int sets, const float (&colour)[3][3],
                       MarchParams& k) {
    const DepositPlan& deposit = lit.deposit;
    k.bands = deposit.bands;
    k.degrees = deposit.axis_degrees;
    k.axes = deposit.axes;
    for (int i = 0; i < kMaxAxes; ++i) k.axis[i] = lit.axes[i];
    k.sets = sets;
    k.harmonics = stored_harmonics(deposit);
    for (int s = 0; s < sets; ++s)
        for (int c = 0; c < 3; ++c) k.set_colour[s][c] = colour[s][c];
}

void gather_by_node(const Context& context, const MarchParams& k, std::uint64_t nodes,
                    Span<const float> numbers, Span<float> by_node) {
    constexpr std::uint64_t kPiece = 1024;
    const std::size_t own = std::size_t(k.bands * k.bands + k.degrees * k.axes);
    const std::size_t stored = std::size_t(k.harmonics), sets = std::size_t(k.sets);
    const auto pieces = std::int64_t((nodes + kPiece - 1) / kPiece);
    parallel_for(context.threads, pieces, [&](std::int64_t piece, int) {
        const std::uint64_t begin = std::uint64_t(piece) * kPiece;
        for (std::size_t n = begin; n < nodes && n < begin + kPiece; ++n)
            for (std::size_t s = 0; s < sets; ++s)
                for (std::size_t i = 0; i < stored; ++i)
                    by_node[(n * sets + s) * stored + i] =
                        i < own ? numbers[n * (sets * own + 1) + s * own + i] : 0.0f;
    });
}

Status add_lit_lamps(const Context& context, const FrameView& view, PhotonState& state,
                     const LightInput& lit, Planes& planes) {
    const Medium& medium = view.world.medium;
    // The media's own light is neither the sun's nor scattered once.
    const bool glows = emits(medium) && lit.lighting == &state.lights.lighting;
    if (lit.lighting->lamps.empty() && !glows) return Status::ok();
    PILEUS_TRY(make_lamp_nodes(context, medium, state.majorants, *lit.lighting, false,
                               state.picture.lamps));
    LampMarchParams k = lamp_march_params(medium, state.majorants, *lit.lighting, lit.camera,
                                          state.picture.lamps, kCut);
    k.emits = glows ? 1 : 0;
    const Beam& beam = state.shadow.beam;
    k.beam_sets =
        lit.first_order_alone || !(lamp_peak_turn(state.lights.deposit) > 0) ? 0 : beam.sets;
    k.beam_points = beam.points ? 1 : 0;
    for (int c = 0; c < 3; ++c) k.beam_rest[c] = beam.rest[c];
    if (state.lights.deposit.apart() && !lit.first_order_alone) {
        k.ordinates = medium.channels;
        k.peak_turn = state.lights.deposit.peak_turn;
        set_rest(medium, beam, k.rest);
    }
    return add_lamp_light(context, medium, k, state.picture.lamps, planes, 0, beam.tables.data());
}

Status fill_lit_background(const Context& context, const FrameView& view, PhotonState& state,
                           const LightInput& lit, int batch, Planes& planes) {
    if (state.picture.alone)
        return show_nothing_behind(*lit.lighting, lit.camera, context.threads, planes);
    PILEUS_TRY(make_ground_shadow(context, view.world.medium, medium_of(view, state),
                                  state.lights.lighting, lit.camera, turn_of(view, state),
                                  state.picture.ground_shadow));
    const StageClock clock(context, "background");
    const Lighting& light = *lit.lighting;
    Buffer<float> own;
    Buffer<float>& map = planes.late != nullptr ? planes.late->map : own;
    PILEUS_TRY(reconstruct_ground(lit, state.lights.ground_map, batch, map));
    BackgroundParams k = background_params(medium_of(view, state), lit.camera, light);
    k.map.size[0] = k.map.size[1] = state.lights.ground_map.cells;
    k.map.size[2] = 1;
    for (int a = 0; a < 2; ++a) {
        k.map.per_metre[a] = state.lights.ground_map.per_metre[a];
        k.map_origin[a] = state.lights.ground_map.origin[a];
    }
    BackgroundBuffers b{map.data(), planes.background.data(), planes.opaque_depth.data()};
    read_ground_shadow(state.picture.ground_shadow, k, b);
    if (planes.late != nullptr) return leave_background(context, k, b, *planes.late);
    return show_background(context, light, k, b);
}

void cut_below_zero(const Context& context, Planes& planes) {
    const StageClock clock(context, "layers");
    const std::size_t pixels = planes.transmittance.size();
    for (std::size_t i = 0; i < 3 * pixels; ++i)
        if (planes.colour[i] < 0) planes.colour[i] = 0, ++planes.clamped;
}

}  // namespace pileus
