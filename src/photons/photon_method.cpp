// SPDX-License-Identifier: Apache-2.0
// See photon_method.h.
// in: frames, units of light -> out: slots of sums, filled; pictures.
// docs/collectors.md
#include "src/photons/photon_method.h"

#include "src/methods/most_units.h"
#include "src/photons/lit_march.h"
#include "src/photons/photon_report.h"
#include "src/picture/late_rows.h"

namespace pileus {

Status PhotonMethod::choose_and_measure(const Context& context, const FrameView& view, Plan& plan) {
    PILEUS_TRY(choose(view));
    return measure(context, view, plan);
}

Status PhotonMethod::lay_out(const Context& context, const FrameView& view) {
    return lay_out_photons(trace_input(context, view), shared_);
}

Status PhotonMethod::plan(const Context& context, const FrameView& view, Plan& plan) {
    // `prepare` has chosen by the values.
    if (!shared_.outlined_only) return measure(context, view, plan);
    PILEUS_TRY(check(context, view));
    return choose_and_measure(context, view, plan);
}

void PhotonMethod::seal() {
    shared_.sealed = true;
    shared_.picture.near_light = Buffer<float>();
}

/// What the slots have no place for is laid out anew; one sum of other photons begins anew.
Status PhotonMethod::relight(const Context& context, const FrameView& view, bool new_sky) {
    PhotonRing& ring = shared_.ring;
    Lighting before;
    if (!ring.on) before = shared_.lights.lighting;
    const bool placed = !new_sky && relight_photons(view, shared_);
    if (!placed || is_turned(view)) {
        if (shared_.sealed)
            return Status::bad_input(
                "lights: one that was not there when the flight was opened, allowed: those of the "
                "packed scene");
        shared_.picture.upsample.ready &= placed;
        Plan plan;
        PILEUS_TRY(choose_and_measure(context, view, plan));
        forget_sun_shadow(shared_);
        return lay_out(context, view);
    }
    if (ring.on || same_lights(before, shared_.lights.lighting)) return Status::ok();
    restart_photons(context.threads, 0, shared_);
    ring.photons.tallies.assign(shared_.lights.lighting.lights.size(), TraceTally{});
    return Status::ok();
}

Status PhotonMethod::set_view(const Context& context, const FrameView& view,
                              const ViewChange& change) {
    if (shared_.hosted) return relight(context, view, change.new_sky);
    follow_lights(view, shared_);
    if (change.new_run) {
        shared_.picture.upsample.ready = false;
        forget_sun_shadow(shared_);
    }
    return Status::ok();
}

Status PhotonMethod::accumulate(const Context& context, const FrameView& view, std::uint64_t units,
                                std::uint64_t& done) {
    PhotonRing& ring = shared_.ring;
    const std::uint64_t held = ring.next_generation - ring.first, most = most_generations();
    // One sum takes no more than was proven for it.
    if (!ring.on && held + units > most) units = held < most ? most - held : 0;
    for (done = 0; done < units; ++done) {
        ring.interrupted = context.stop();
        if (ring.interrupted) return Status::ok();
        // A host's ledger is that of the last turn of the ring, so that its bounds hold for ever.
        if (shared_.hosted && (ring.next_generation - ring.first) % ring.generations == 0)
            ring.photons.tallies.assign(shared_.lights.lighting.lights.size(), TraceTally{});
        PILEUS_TRY(shoot_generation(context, trace_input(context, view), shared_));
        if (ring.interrupted) return Status::ok();
        // A film tells of all that its frame gets.
        if (shared_.hosted) context.tell("photons", double(done + 1) / double(units));
    }
    return Status::ok();
}

void PhotonMethod::restart(const Context& context, std::uint64_t first) {
    restart_photons(context.threads, first, shared_);
}

Status PhotonMethod::render(const Context& context, const FrameView& view, const RenderAsk& ask,
                            Planes*& planes) {
    PhotonPicture& picture = shared_.picture;
    picture.frame = view.frame;
    picture.turn = shared_.hosted ? picture.turn + 1 : view.frame;
    picture.alone = ask.media_only;
    if (!shared_.hosted) settle_ring(shared_);
    planes = &picture.planes;
    picture.planes.clamped = 0;
    picture.planes.late = late_photons(ask.late, view, shared_);
    return compose(context, view, picture.planes);
}

LightUnits PhotonMethod::progress() const {
    const PhotonRing& ring = shared_.ring;
    LightUnits out;
    out.unit = "generation";
    out.stage = "photons";
    out.whole = ring.generations;
    for (const Light& light : shared_.lights.lighting.lights) out.unit_photons += light.photons;
    for (const PhotonSlot& slot : ring.photons.slots) out.held += slot.generations;
    out.prepared = ring.layouts;
    out.one_sum = !ring.on;
    out.ring = ring.on && ring.animated ? ring.generations : 0;
    out.interrupted = ring.interrupted;
    return out;
}

FrameWork PhotonMethod::full_work() const {
    FrameWork out;
    if (shared_.picture.thins) out = work_of(shared_.picture.thin);
    out.light_refresh = shared_.shadow.light_refresh;
    out.photons = 0;
    for (const Light& light : shared_.lights.lighting.lights)
        out.photons += std::int64_t(light.photons);
    return out;
}

Status PhotonMethod::reserve(const FrameView& view, LateRows& late) {
    PhotonPicture& picture = shared_.picture;
    const auto& size = view.scene.camera.resolution;
    const Medium& medium = view.world.medium;
    const bool solid = shared_.lights.lighting.opaque() || view.environment.depth.present;
    PILEUS_TRY(reserve_depths(size, solid, picture.planes));
    PILEUS_TRY(reserve_lamp_nodes(medium, view.scene.lights.size(), picture.lamps));
    shared_.shadow.slices.reserve();
    picture.ground_shadow.slices.reserve();
    const GroundMap& map = shared_.lights.ground_map;
    const std::uint64_t cells = std::uint64_t(map.cells) * std::uint64_t(map.cells);
    const Array<float> light = arrays::ground_light(cells);
    PILEUS_TRY(late.map.reserve(light.count, light.name));
    if (!picture.thins) return Status::ok();
    return reserve_upsampling(picture.thin, size, solid, picture.upsample);
}

Status PhotonMethod::set_limits(const FrameWork& work) { return limit_photons(work, shared_); }

Status PhotonMethod::worst_case(const FrameView& view, const FrameWork& work,
                                FrameUnits& units) const {
    const Medium& medium = view.world.medium;
    const Lighting& lighting = shared_.lights.lighting;
    most_pixels(work, view.scene.camera.resolution, lighting.opaque(), shared_.picture.upsample,
                units);
    std::uint64_t samples = 0;
    PILEUS_TRY(most_grid_samples(medium, samples));
    units.samples = medium.sigma > 0 ? units.rays * samples : 0;
    // Each light has one photon or more.
    units.photons = std::uint64_t(work.photons) + lighting.lights.size();
    return add_lamp_samples(medium, lighting, units);
}

void PhotonMethod::count(Counts& counts) const { count_photons(shared_.ring, counts); }

/// No frame gets more.
void PhotonMethod::release(Phase phase) {
    if (phase != Phase::kEnded) return;
    shared_.ring.scratch.sums = Buffer<std::int64_t>();
    shared_.majorants.tracking = Buffer<float>();
}

}  // namespace pileus
