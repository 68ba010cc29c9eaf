// SPDX-License-Identifier: Apache-2.0
// See photon_state.h.
// in: lights, a generation's number -> out: slots of sums.
// docs/methods.md 3, "Generations and error".
#include "src/photons/photon_state.h"

#include "src/run/work_share.h"

namespace pileus {
namespace {

/// Batches for the standard error: the largest divisor of the generations up to 16, so that all
/// hold equally many; if that is under 8, as many as fit with slightly unequal shares.
std::uint64_t batch_count(std::uint64_t generations) {
    std::uint64_t best = 1;
    for (std::uint64_t n = 1; n <= kMaxBatches && n <= generations; ++n)
        if (generations % n == 0) best = n;
    const std::uint64_t most = generations < kMaxBatches ? generations : kMaxBatches;
    return best >= 8 ? best : most;
}

/// Of a ring, or of groups of generations.
std::size_t slot_of(std::uint64_t generation, const PhotonRing& ring) {
    return std::size_t((generation - ring.first) % ring.photons.slots.size());
}

RingWork ring_work(const TraceInput& in) { return {slot_size(in), in.threads, in.kernels}; }

/// Per light, m^2 per photon.
std::vector<double> flux_of(const PhotonState& state) {
    std::vector<double> flux;
    for (const Light& l : state.lights.lighting.lights)
        flux.push_back(l.photons > 0 ? l.power_m2 / double(l.photons) : 0);
    return flux;
}
void take_sun(const PhotonState& state, PhotonSlot& slot) {
    for (const Light& l : state.lights.lighting.lights)
        if (l.beam) slot.sun_travel = l.travel;
}

/// A generation in place of what its slot holds.
Status shoot_packed(const TraceInput& in, std::size_t number, const std::vector<double>& flux,
                    PhotonRing& ring) {
    Photons& photons = ring.photons;
    const bool first_turn = ring.next_generation < photons.slots.size();
    const RingShot shot = begin_shot(number, first_turn, flux, photons, ring.sum);
    PILEUS_TRY(trace_generation(in, ring.next_generation, ring.scratch, photons.slots[number],
                                photons.tallies, [&](std::size_t light) {
                                    pack_light(ring_work(in), light, shot, ring.scratch, photons,
                                               ring.sum);
                                }));
    ring.interrupted = photons.slots[number].generations == 0;
    if (ring.interrupted)
        drop_shot(shot, in.threads, photons, ring.sum);
    else
        end_shot(shot, photons, ring.sum);
    return Status::ok();
}

}  // namespace

void begin_photons(const MethodInputs& inputs, PhotonState& state) {
    const Animation& animation = inputs.scene.animation;
    state.budget = inputs.budget;
    state.hosted = inputs.live;
    state.error_layer = inputs.scene.output.layer_error;
    state.ring.animated = inputs.live || animation.present;
    state.ring.many_frames = inputs.live || animation.is_film();
}

bool sums_ring(const PhotonState& state) {
    return state.ring.on && state.ring.many_frames && state.ring.generations > 1;
}

Status sum_ring(const TraceInput& in, PhotonState& state) {
    PhotonRing& ring = state.ring;
    if (!sums_ring(state) || ring.next_generation == ring.first) return Status::ok();
    return sum_ring(ring_work(in), slot_of(ring.next_generation - 1, ring), ring.photons, ring.sum);
}

std::uint64_t photon_slots(const PhotonState& state) {
    const PhotonRing& ring = state.ring;
    if (ring.on && ring.many_frames) return ring.generations;
    return state.error_layer ? batch_count(ring.generations) : 1;
}

int photon_batches(const PhotonState& state) {
    const PhotonRing& ring = state.ring;
    std::uint64_t slots = photon_slots(state);
    // Tracing that ended early has left slots without a generation.
    if (!ring.animated && ring.next_generation > 0 && ring.next_generation < slots)
        slots = ring.next_generation;
    if (!state.error_layer || slots < 2) return 0;
    // A host's ring is full, or tells of no error: its oldest slot may be any.
    if (state.hosted)
        for (const PhotonSlot& slot : ring.photons.slots)
            if (slot.generations == 0) return 0;
    // An animation's ring may hold more generations than the blender has planes for.
    return int(slots < kMaxBatches ? slots : kMaxBatches);
}

Status sums_overflow(const char* key, const FrameView& view, const PhotonState& state) {
    const bool camera = state.lights.deposit.mode == kDepositCamera;
    return Status::limit(view.scene.file + ": " + key + ": " +
                         std::to_string(state.lights.budget_photons) +
                         " photons could overflow the 64-bit sums; take fewer" +
                         (camera ? ", or a closure other than \"camera\"" : ""));
}

TraceInput photon_trace_input(const Context& context, const FrameView& view,
                              const PhotonState& state) {
    TraceInput in;
    in.medium = &view.world.medium;
    in.lighting = &state.lights.lighting;
    in.majorants = state.majorants.tracking.span();
    in.block = state.majorants.block;
    in.deposit = state.lights.deposit;
    in.seed = std::uint64_t(view.scene.seed);
    in.threads = context.threads;
    in.kernels = context.kernels;
    in.max_events = state.lights.max_events;
    in.ground = state.lights.ground_map;
    in.shared_sums = state.ring.shared_sums;
    in.packs = sums_ring(state);
    in.part = context.sharing != nullptr ? context.sharing->part() : context.part;
    return in;
}

Status lay_out_photons(const TraceInput& in, PhotonState& state) {
    PhotonRing& ring = state.ring;
    const std::size_t lights = state.lights.lighting.lights.size();
    ++ring.layouts;
    ring.first = ring.next_generation;
    PILEUS_TRY(prepare_trace(in, ring.scratch));
    ring.photons.tallies.assign(lights, TraceTally{});
    ring.photons.slots.clear();
    ring.photons.slots.resize(std::size_t(photon_slots(state)));
    for (PhotonSlot& slot : ring.photons.slots)
        PILEUS_TRY(allocate_slot(slot_size(in), lights, in.packs, slot));
    if (!in.packs) return Status::ok();
    return begin_ring(ring_work(in), ring.next_generation == 0, ring.photons, ring.sum);
}

void restart_photons(int threads, std::uint64_t first, PhotonState& state) {
    PhotonRing& ring = state.ring;
    for (PhotonSlot& slot : ring.photons.slots)
        if (slot.generations > 0 || !slot.parts.empty()) empty_slot(slot, threads);
    ring.next_generation = ring.begin = first;
    if (!ring.on) ring.first = first;
    ring.fresh = ring.on;
}

void begin_slot(const PhotonState& state, PhotonSlot& slot) {
    take_sun(state, slot);
    slot.flux_per_photon_m2 = flux_of(state);
}

Status shoot_generation(const Context& context, TraceInput in, PhotonState& state) {
    PhotonRing& ring = state.ring;
    in.ended = patient_stop(context);
    const std::size_t number = slot_of(ring.next_generation, ring);
    PhotonSlot& slot = ring.photons.slots[number];
    // In an animation each generation has a slot of its own: the oldest is replaced, exactly.
    const bool turns = ring.on && ring.photons.slots.size() == ring.generations && ring.animated;
    if (in.packs) {
        take_sun(state, slot);
        PILEUS_TRY(shoot_packed(in, number, flux_of(state), ring));
    } else {
        if (turns && slot.generations > 0) empty_slot(slot, context.threads);
        begin_slot(state, slot);
        const std::uint64_t before = slot.generations;
        PILEUS_TRY(
            trace_generation(in, ring.next_generation, ring.scratch, slot, ring.photons.tallies));
        ring.interrupted = slot.generations == before;
    }
    if (!ring.interrupted) ++ring.next_generation;
    return Status::ok();
}

}  // namespace pileus
