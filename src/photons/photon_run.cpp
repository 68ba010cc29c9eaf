// SPDX-License-Identifier: Apache-2.0
// See photon_run.h.
// in: scene, lights -> out: slots of sums.
// docs/methods.md 3, each image frame, step 1; "Generations and error".
#include "src/photons/photon_run.h"

#include <cstring>

#include "kernels_cpu/core/profile.h"
#include "src/world/camera/view.h"
#include "src/world/light/lamps.h"
#include "src/world/phase/forward_share.h"
#include "src/world/plan_parts.h"

namespace pileus {
namespace {

/// Least share of the scattered light within a cone that is worth a table of its own.
constexpr double kLeastPeak = 0.3;

/// Batches for the standard error: the largest divisor of the generations up to 16, so that all
/// hold equally many; if that is under 8, as many as fit with slightly unequal shares.
std::uint64_t batch_count(std::uint64_t generations) {
    std::uint64_t best = 1;
    for (std::uint64_t n = 1; n <= kMostBatches && n <= generations; ++n)
        if (generations % n == 0) best = n;
    const std::uint64_t most = generations < kMostBatches ? generations : kMostBatches;
    return best >= 8 ? best : most;
}

/// The sun that the lights are planned for: one that only rises during an animation needs its
/// place among them from the start.
SunPlace first_place(const MethodRun& run) {
    const Scene& scene = *run.scene;
    SunPlace own = place_of(scene.sun);
    if (kFilms && scene.ground.present && own.elevation_deg <= 0 && moves_sun(scene))
        own.elevation_deg = highest_sun(scene, run.rest->sun);
    return own;
}

/// Photons of one light differ in colour: each channel has sums of its own.
void tell_colours(const char* what, PhotonRun& run) {
    if (run.deposit.channels == 3) return;
    run.deposit.channels = 3;
    if (kPlans)
        run.plan.need((std::string("coefficients per colour channel: coloured ") + what).c_str());
}

/// Aims the sky map at the medium's box. A coloured one asks for a set of sums per colour channel,
/// as its photons differ in colour.
Status aim_map(PhotonRun& run) {
    run.environment.ground_under_map = true;
    if (!run.environment.sky_map.present()) return Status::ok();
    PILEUS_TRY(aim_sky_map(run.world->medium.extent_m, run.world->medium.grid.periodic,
                           run.environment.sky_map));
    if (run.environment.sky_map.view.planes == 3) tell_colours("sky map", run);
    return Status::ok();
}

bool coloured_lamps(const Lighting& lighting) {
    bool coloured = false;
    for (const LampParams& l : lighting.lamps)
        coloured |= l.light[0] != l.light[1] || l.light[1] != l.light[2];
    return coloured;
}

/// Photons of a generation of a light that is up: its part of `unit_photons`, 1 at least.
std::uint64_t unit_photons_of(std::size_t light, const PhotonRun& run) {
    const std::uint64_t planned = run.light_photons[light];
    std::uint64_t all = 0;
    for (const std::uint64_t n : run.light_photons) all += n;
    if (run.unit_photons == 0 || run.unit_photons >= all || planned == 0) return planned;
    const auto part =
        std::uint64_t(double(planned) * (double(run.unit_photons) / double(all)) + 0.5);
    return part == 0 ? 1 : part < planned ? part : planned;
}

/// Photons have the numbers of a whole generation, so that none flies twice.
void set_unit_photons(std::size_t light, const PhotonRun& run, Light& of) {
    of.photons = unit_photons_of(light, run);
    of.apart = run.light_photons[light];
}

/// The set of lights is the ring's layout: a light that has set keeps its place and shoots no
/// photons; those of its day stay in the ring until they leave it.
void keep_places(const PhotonRun& run, Lighting& next) {
    std::vector<Light> lights = run.lighting.lights;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        bool found = false;
        for (const Light& n : next.lights)
            if (n.stream == lights[i].stream) lights[i] = n, found = true;
        lights[i].photons = 0;
        if (found) set_unit_photons(i, run, lights[i]);
        // A diffuse light's colour is today's for the whole ring; a beam's never changes.
        if (!found && !lights[i].beam) lights[i].colour = {0, 0, 0};
    }
    next.lights = lights;
}

/// Whether every light of `next` has a place in the ring, and the ground its map.
bool has_places(const PhotonRun& run, const Lighting& next) {
    for (const Light& light : next.lights) {
        bool found = false;
        for (const Light& place : run.lighting.lights) found |= place.stream == light.stream;
        if (!found) return false;
    }
    if (coloured_lamps(next) && run.deposit.channels != 3) return false;
    const GroundMap map = make_ground_map(run.world->medium, next), &own = run.ground_map;
    bool same = map.cells == own.cells;
    for (int a = 0; a < 2; ++a)
        same &= map.origin[a] == own.origin[a] && map.per_metre[a] == own.per_metre[a];
    return same;
}

/// Of a ring, or of groups of generations.
std::size_t slot_of(std::uint64_t generation, const PhotonRun& run) {
    return std::size_t((generation - run.ring_first) % run.photons.slots.size());
}

RingWork ring_work(const TraceInput& in) { return {slot_size(in), in.threads, in.kernels}; }

/// A generation in place of what its slot holds.
Status shoot_packed(const TraceInput& in, std::size_t number, const std::vector<double>& flux,
                    PhotonRun& run) {
    Photons& photons = run.photons;
    const bool first_turn = run.next_generation < photons.slots.size();
    const RingShot shot = begin_shot(number, first_turn, flux, photons, run.ring_sum);
    PILEUS_TRY(trace_generation(in, run.next_generation, run.scratch, photons.slots[number],
                                photons.tallies, [&](std::size_t light) {
                                    pack_light(ring_work(in), light, shot, run.scratch, photons,
                                               run.ring_sum);
                                }));
    run.interrupted = photons.slots[number].generations == 0;
    if (kStops && run.interrupted)
        drop_shot(shot, in.threads, photons, run.ring_sum);
    else
        end_shot(shot, photons, run.ring_sum);
    return Status::ok();
}

}  // namespace

bool sums_ring(const PhotonRun& run) {
    const Animation& a = run.scene->animation;
    return run.ring && a.present && a.frames > 1 && photon_slots(run) > 1;
}

Status sum_ring(const TraceInput& in, PhotonRun& run) {
    if (!sums_ring(run) || run.next_generation == run.ring_first) return Status::ok();
    return sum_ring(ring_work(in), slot_of(run.next_generation - 1, run), run.photons,
                    run.ring_sum);
}

std::uint64_t photon_slots(const PhotonRun& run) {
    const Scene& scene = *run.scene;
    if (run.ring && scene.animation.present && scene.animation.frames > 1) return run.generations;
    return kFilms && scene.output.layer_error ? batch_count(run.generations) : 1;
}

int photon_batches(const PhotonRun& run) {
    if (!kFilms) return 0;
    std::uint64_t slots = photon_slots(run);
    // Tracing that ended early has left slots without a generation.
    if (!run.scene->animation.present && run.next_generation > 0 && run.next_generation < slots)
        slots = run.next_generation;
    if (!run.scene->output.layer_error || slots < 2) return 0;
    // An animation's ring may hold more generations than the blender has planes for.
    return int(slots < kMostBatches ? slots : kMostBatches);
}

Status choose_photon_lights(std::uint64_t generations, PhotonRun& run) {
    const Scene& scene = *run.scene;
    const std::int64_t photons = run.budget_photons;
    run.plan = Plan{};
    run.deposit.channels = run.world->medium.channels;
    PILEUS_TRY(aim_map(run));
    if (run.world->solids.coloured()) tell_colours("solids", run);
    run.generations = generations;
    if (photons >= 0 && std::uint64_t(photons) < run.generations)
        run.generations = photons > 0 ? std::uint64_t(photons) : 1;
    run.sun = first_place(run);
    run.lighting = light_of(scene, run.sun, *run.world, run.environment);
    if (kPlans) explain_light(scene, run.sun, *run.world, run.environment, run.lighting, run.plan);
    if (!run.lighting.lamps.empty()) {
        if (kPlans)
            run.plan.need((std::to_string(run.lighting.lamps.size()) +
                           " lights of [[light]]: marched to the first scattering")
                              .c_str());
        if (coloured_lamps(run.lighting)) tell_colours("[[light]]", run);
    }
    note_emission(run.world->medium, run.plan);
    share_photons(std::uint64_t(photons) / run.generations, run.lighting.lights);
    run.light_photons.clear();
    for (const Light& l : run.lighting.lights) run.light_photons.push_back(l.photons);
    run.ground_map = make_ground_map(run.world->medium, run.lighting);
    return Status::ok();
}

Status sums_overflow(const char* key, const PhotonRun& run) {
    const bool camera = run.deposit.mode == kDepositCamera;
    return Status::limit(run.scene->file + ": " + key + ": " + std::to_string(run.budget_photons) +
                         " photons could overflow the 64-bit sums; take fewer" +
                         (camera ? ", or a closure other than \"camera\"" : ""));
}

TraceInput photon_trace_input(const Context& context, const PhotonRun& run) {
    TraceInput in;
    in.medium = &run.world->medium;
    in.lighting = &run.lighting;
    in.majorants = run.majorants.tracking.span();
    in.block = run.majorants.block;
    in.deposit = run.deposit;
    in.seed = std::uint64_t(run.scene->seed);
    in.threads = context.threads;
    in.kernels = context.kernels;
    in.max_events = run.max_events;
    in.ground = run.ground_map;
    in.shared_sums = run.plan.accumulation.shared;
    in.packs = sums_ring(run);
    return in;
}

Status lay_out_photons(const TraceInput& in, PhotonRun& run) {
    ++run.layouts;
    run.ring_first = run.next_generation;
    PILEUS_TRY(prepare_trace(in, run.scratch));
    run.photons.tallies.assign(run.lighting.lights.size(), TraceTally{});
    run.photons.slots.clear();
    run.photons.slots.resize(std::size_t(photon_slots(run)));
    const std::size_t lights = run.lighting.lights.size();
    for (PhotonSlot& slot : run.photons.slots)
        PILEUS_TRY(allocate_slot(slot_size(in), lights, in.packs, slot));
    if (!in.packs) return Status::ok();
    return begin_ring(ring_work(in), run.next_generation == 0, run.photons, run.ring_sum);
}

Status shoot_generation(TraceInput in, const Context& context, PhotonRun& run) {
    in.ended = patient_stop(context);
    const std::size_t number = slot_of(run.next_generation, run);
    PhotonSlot& slot = run.photons.slots[number];
    // In an animation each generation has a slot of its own: the oldest gives way, exactly.
    const bool ring =
        run.ring && run.photons.slots.size() == run.generations && run.scene->animation.present;
    std::vector<double> flux;
    for (const Light& l : run.lighting.lights) {
        flux.push_back(l.photons > 0 ? l.power_m2 / double(l.photons) : 0);
        if (l.beam) slot.sun_travel = l.travel;
    }
    if (in.packs) {
        PILEUS_TRY(shoot_packed(in, number, flux, run));
    } else {
        if (ring && slot.generations > 0) empty_slot(slot, context.threads);
        slot.flux_per_photon_m2 = flux;
        const std::uint64_t before = slot.generations;
        PILEUS_TRY(
            trace_generation(in, run.next_generation, run.scratch, slot, run.photons.tallies));
        run.interrupted = slot.generations == before;
    }
    if (!kStops || !run.interrupted) ++run.next_generation;
    return Status::ok();
}

void aim_deposit(PhotonRun& run) {
    const Camera& seen = run.scene->camera;
    const CameraParams camera = make_camera(seen, 0, run.world->medium.low_m);
    run.deposit.orthographic = seen.orthographic;
    for (int a = 0; a < 3; ++a)
        run.deposit.camera[a] = seen.orthographic ? -camera.forward[a] : camera.origin[a];
}

void choose_peak(double peak_deg, PhotonRun& run) {
    const Medium& medium = run.world->medium;
    run.deposit.peak_turn = 0;
    const char* why = nullptr;
    if (!(peak_deg > 0))
        why = "switched off";
    else if (!run.lighting.sunlit)
        why = "no sun";
    else if (run.deposit.first_order != 2)
        why = "the march does not show the first order";
    else if (medium.count != 1)
        why = "other than one medium";
    else if (forward_share(medium.optics[0].phase, peak_deg) < kLeastPeak)
        why = "the phase function has no peak";
    if (why != nullptr)
        run.plan.leave_out("the beam's peak", why);
    else
        run.deposit.peak_turn = turn_of_deg(peak_deg);
}

Status check_camera_closure(const char* key, const PhotonRun& run) {
    const Medium& medium = run.world->medium;
    for (int i = 0; i < medium.count && run.deposit.mode == kDepositCamera; ++i)
        if (needle_shares(medium.optics[std::size_t(i)].phase).any())
            return Status::bad_input(run.scene->file + ": " + key + ": \"camera\" with medium." +
                                     std::to_string(i) +
                                     ".phase, a lobe of g = 1 or -1, allowed: another closure, or "
                                     "a wider lobe");
    return Status::ok();
}

std::uint64_t beam_sets(const PhotonRun& run) {
    return run.deposit.peak_turn > 0 ? std::uint64_t(run.world->medium.channels) : 0;
}

void set_photon_sun(const SunPlace& sun, PhotonRun& run) {
    // Lamps and ground move where the media do.
    if (sun == run.sun && !moves_media(*run.scene)) return;
    Lighting next = light_of(*run.scene, sun, *run.world, run.environment);
    keep_places(run, next);
    run.lighting = next;
    run.sun = sun;
    run.shadow_ready = false;
}

bool relight_photons(PhotonRun& run) {
    const SunPlace sun = place_of(run.scene->sun);
    Lighting next = light_of(*run.scene, sun, *run.world, run.environment);
    if (!has_places(run, next)) return false;
    keep_places(run, next);
    const Lighting& before = run.lighting;
    if (!same_lights(before, next) || before.constant != next.constant || before.sky != next.sky ||
        before.ground_diffuse != next.ground_diffuse || before.ground_sun != next.ground_sun)
        ++run.relights;
    if (next.sunlit != before.sunlit || next.to_sun != before.to_sun) run.shadow_ready = false;
    run.lighting = next;
    run.sun = sun;
    return true;
}

Status refuse_new_lights() {
    return Status::bad_input(
        "lights: one that was not there when the flight was opened, allowed: those of the packed "
        "scene");
}

Status set_photon_limits(const FrameWork& work, MethodRun& method_run) {
    PhotonRun& run = static_cast<PhotonRun&>(method_run);
    const std::uint64_t photons = std::uint64_t(work.photons);
    std::uint64_t all = 0;
    for (const std::uint64_t n : run.light_photons) all += n;
    if (!run.ring && photons < all)
        return Status::bad_input("work.photons: " + std::to_string(photons) +
                                 ", but all generations are one sum, allowed: 0, or ring = true");
    run.light_refresh = work.light_refresh;
    if (run.thins) put_work(work, run.thin);
    run.unit_photons = photons < all ? photons : 0;
    std::vector<Light>& lights = run.lighting.lights;
    for (std::size_t i = 0; i < lights.size(); ++i)
        if (lights[i].photons > 0) set_unit_photons(i, run, lights[i]);
    return Status::ok();
}

bool same_lights(const Lighting& a, const Lighting& b) {
    if (a.lights.size() != b.lights.size() || a.ground != b.ground || a.ground_z != b.ground_z ||
        a.ground_albedo != b.ground_albedo || a.map.columns != b.map.columns ||
        !same_lamps(a.lamps, b.lamps))
        return false;
    for (std::size_t i = 0; i < a.lights.size(); ++i) {
        const Light &x = a.lights[i], &y = b.lights[i];
        if (x.stream != y.stream || x.travel != y.travel || x.colour != y.colour ||
            x.power_m2 != y.power_m2 || x.photons != y.photons || x.face_cdf != y.face_cdf)
            return false;
    }
    return true;
}

}  // namespace pileus
