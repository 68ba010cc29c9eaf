// SPDX-License-Identifier: Apache-2.0
// Every array of method `photon-grid`, and what its photons cost; in no flight.
// in: PhotonGridState, outlined or prepared -> out: rows; kLimit where something is too much.
// docs/report.md, "Plan"; docs/photon-grid.md, "Memory".
#include "src/methods/photon_grid/photon_grid_state.h"
#include "src/photons/lit_march.h"
#include "src/photons/photon_report.h"
#include "src/run/on_device.h"
#include "src/world/plan_parts.h"

namespace pileus {
namespace {

using Size = std::uint64_t;

/// Harmonics of a cell as the march reads them.
Size harmonic_numbers(const PhotonGridState& state) {
    return Size(harmonic_sets(state.lights.deposit.channels, state.lights.lighting)) *
           Size(stored_harmonics(state.lights.deposit));
}

/// Numbers per cell while it is shown.
Size light_numbers(const FrameView& view, const PhotonGridState& state) {
    return shows_harmonics(view, state) ? harmonic_numbers(state)
                                        : 3 * (1 + Size(photon_batches(state)));
}

void add_photons(const FrameView& view, const PhotonGridState& state, const Context& context,
                 Size private_sums, MemoryTable& t) {
    const Medium& m = view.world.medium;
    const Size threads = Size(context.threads);
    // A wanted error looks at pictures between photons.
    const bool looks = context.frames > 1 || state.budget.error > 0;
    const Stage traced = looks ? Stage::kWrite : Stage::kPhotons;
    const Size blocks = state.outlined_only
                            ? most_tracking_blocks(m.grid, state.settings.local_tracking)
                            : state.majorants.tracking.size();
    add_majorant_rows(m.grid, blocks, threads, traced, t);
    add(t, arrays::cell_marks(state.cells.count()));
    if (m.count > 1) add(t, arrays::cell_shares(state.cells.count(), Size(m.count)));
    add_slot_rows(grid_slot(state), state.lights.lighting.lights.size(), photon_slots(state),
                  sums_ring(state), t);
    add(t, arrays::photon_tallies(threads, traced));
    const auto own = arrays::photon_sums(0, 0, traced);
    t.add(own.name, own.first, own.last, private_sums);
}

void add_picture(const FrameView& view, const PhotonGridState& state, const Context& context,
                 MemoryTable& t) {
    const OutputSettings& output = view.scene.output;
    const auto& size = view.scene.camera.resolution;
    const Size pixels = Size(size[0]) * Size(size[1]);
    const Size planes = 3 * (1 + Size(photon_batches(state)));
    const Size parts = (output.layer_light ? 3u : 0u) + (output.layer_order ? 3u : 0u);
    const Size extra = parts + whole_ray_planes(output);
    const Size ground = grid_slot(state).ground_cells;
    const bool solid = state.lights.lighting.opaque();
    add(t, arrays::cell_light(light_numbers(view, state), state.cells.count()));
    if (shows_near(view, state))
        add(t, arrays::near_nodes(planes / 3 * harmonic_numbers(state),
                                  near_nodes_of(context, view, cell_nodes(view, state))));
    const bool reads_quads = (planes == 3 || parts > 0) && !shows_harmonics(view, state) &&
                             state.cells.count() > 1 && !on_device(context.kernels->device);
    add(t, arrays::lit_quads(reads_quads ? state.cells.count() : 0));
    add(t, arrays::picture_planes(plane_count(planes, solid, view.wants_depth()) + extra, pixels));
    if (extra > 0)
        add(t, renamed(arrays::picture_planes(plane_count(parts > 0 ? 3 : 0, solid, false), pixels),
                       "planes of a part", Stage::kDisplay, Stage::kDisplay));
    if (parts > 0)
        add(t, renamed(arrays::cell_light(3, state.cells.count()), "light of a part",
                       Stage::kDisplay, Stage::kDisplay));
    add(t, arrays::ground_light(ground));
    if (planes > 3 && ground > 0)
        add(t, arrays::batch_background(pixels), arrays::ground_light(ground));
    const Stage shadows = context.frames > 1 ? Stage::kPhotons : Stage::kShadow;
    if (state.lights.lighting.sunlit && state.lights.deposit.first_order == 2)
        add(t, arrays::shadow(sun_shadow_numbers(view), shadows));
    add(t, arrays::beam_tables(beam_sets(view, state), shadows));
    add(t, arrays::lamp_depths(lamp_numbers(view.world.medium, state.lights.lighting)));
    add_image_rows(Size(size[0]), Size(size[1]), 4 + extra_layers(output, view.depths, planes > 3),
                   t);
}

MemoryTable memory_of(const FrameView& view, const PhotonGridState& state, const Context& context,
                      Size private_sums) {
    MemoryTable t;
    add_density_rows(view.world.medium.grid, view.world.source, Size(view.world.medium.count),
                     phase_bytes(view.world.medium), Size(context.threads),
                     sky_map_bytes(view.environment.sky_map, view.environment.look), t);
    add_photons(view, state, context, private_sums, t);
    add_picture(view, state, context, t);
    return t;
}

}  // namespace

std::uint64_t photon_grid_peak(const Context& context, const FrameView& view,
                               const PhotonGridState& state) {
    return memory_of(view, state, context, 0).peak();
}

Status measure_grid_memory(const Context& context, const FrameView& view,
                           const PhotonGridState& state, std::uint64_t photons, Plan& plan) {
    const Scene& scene = view.scene;
    const World& world = view.world;
    const double max_events = double(state.lights.max_events);
    const Size own =
        scratch_bytes(plan.accumulation.bytes, bytes_of_grid_thread(state), sums_ring(state));
    plan.memory = memory_of(view, state, context, own);
    add_picture_rows(context, view, state, plan.memory);
    add_solid_rows(scene, context.limits, world.solids, view.environment.depth, plan.memory);
    PILEUS_TRY(check_limit(context.limits, LimitId::kMemory, plan.memory.peak(), scene.file));
    const bool open = state.budget.seconds > 0;
    plan.work = estimate_work(medium_work(world.medium, world.source.mean_density, max_events,
                                          open ? 0 : double(photons)));
    return check_work(plan.work, context.limits, scene.file);
}

}  // namespace pileus
