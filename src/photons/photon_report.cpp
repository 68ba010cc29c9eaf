// SPDX-License-Identifier: Apache-2.0
// See photon_report.h.
// in: tallies, slots -> out: rows of the report.
// docs/report.md.
#include "src/photons/photon_report.h"

#include "platform/threads.h"
#include "src/base/digest.h"
#include "src/picture/finish_frame.h"
#include "src/world/plan_parts.h"

namespace pileus {
namespace {

/// Binomial standard error of a share of n photons (fates are exclusive outcomes of each).
double share_error(double share, double n) {
    return n > 1 && share > 0 && share < 1 ? __builtin_sqrt(share * (1 - share) / (n - 1)) : 0;
}

EnergyRow energy_row(const std::string& light, const Fates& f) {
    EnergyRow row;
    // The first colour channel in which the light shines.
    std::size_t c = 0;
    while (c < 2 && f.emitted[c] == 0) ++c;
    row.light = light;
    row.balance_quanta = f.emitted[c] - f.top[c] - f.bottom[c] - f.sides[c] - f.absorbed[c] -
                         f.ground[c] - f.sky[c] - f.terminated[c] - f.solid[c];
    const double unit = double(f.emitted[c]);
    if (unit <= 0) return row;
    // A photon that carries a share of its power counts as that share: its variance is less yet.
    const double photons = unit / double(kPhotonQuanta);
    row.emitted = 1;
    row.top = double(f.top[c]) / unit;
    row.bottom = double(f.bottom[c]) / unit;
    row.sides = double(f.sides[c]) / unit;
    row.absorbed = double(f.absorbed[c]) / unit;
    row.ground = double(f.ground[c]) / unit;
    row.sky = double(f.sky[c]) / unit;
    row.solid = double(f.solid[c]) / unit;
    row.terminated = double(f.terminated[c]) / unit;
    row.direct_bottom = double(f.direct_bottom[c]) / unit;
    row.error.top = share_error(row.top, photons);
    row.error.bottom = share_error(row.bottom, photons);
    row.error.sides = share_error(row.sides, photons);
    row.error.absorbed = share_error(row.absorbed, photons);
    return row;
}

/// Whole numbers, in the same order whether they are packed or not.
std::uint64_t digest_of(const PhotonSlot& slot) {
    Digest d;
    d.integers(slot.sums.span());
    const PackedSums& packed = slot.packed;
    std::int64_t numbers[kMaxPacked];
    for (std::size_t l = 0; l < packed.lights; ++l) {
        for (std::uint64_t set = 0; set < packed.count; ++set) {
            numbers_of_set(slot, l, 0, set, int(packed.numbers), numbers);
            d.integers({numbers, std::size_t(packed.numbers)});
        }
        const std::size_t ground = packed.ground.size() / packed.lights;
        d.integers({packed.ground.data() + l * ground, ground});
    }
    return d.value();
}

}  // namespace

void digest_photons(int threads, Photons& photons) {
    parallel_for(threads, std::int64_t(photons.slots.size()), [&](std::int64_t s, int) {
        PhotonSlot& slot = photons.slots[std::size_t(s)];
        if (slot.digested == slot.serial) return;
        slot.digest = digest_of(slot);
        slot.digested = slot.serial;
    });
}

std::string photon_digest(const Photons& photons) {
    Digest d;
    for (const PhotonSlot& slot : photons.slots)
        d.u64(slot.digested == slot.serial ? slot.digest : digest_of(slot));
    return d.hex();
}

void report_photons(const PhotonState& state, Report& report) {
    const PhotonRing& ring = state.ring;
    const std::vector<Light>& lights = state.lights.lighting.lights;
    const TraceTally all = tally_of(ring);
    PhotonCounts& out = report.photons;
    out.generations = ring.next_generation;
    report.interrupted = ring.interrupted;
    out.ring_generations = out.ring_whole = 0;
    if (ring.on && ring.animated && ring.photons.slots.size() == ring.generations) {
        out.ring_whole = ring.generations;
        for (const PhotonSlot& slot : ring.photons.slots)
            out.ring_generations += slot.generations > 0 ? 1 : 0;
    }
    const int batches = photon_batches(state);
    report.errors.of = report.errors.known ? "noise of " + std::to_string(batches) +
                                                 " batches of photons, without bias"
                       : batches > 1       ? "none: no pixel with A > 0.02"
                       : state.error_layer ? "none: one generation of photons has no scatter"
                                           : "none: the layer \"error\" tells it";
    out.energy.clear();
    for (std::size_t l = 0; l < ring.photons.tallies.size(); ++l) {
        const TraceTally& t = ring.photons.tallies[l];
        out.energy.push_back(energy_row(lights[l].name, t.light));
        if (t.shadow.emitted[0] > 0)
            out.energy.push_back(energy_row(lights[l].name + ": kept from the ground", t.shadow));
    }
    out.traced = std::uint64_t(all.photons);
    report.events.scatterings = std::uint64_t(all.scatterings);
    report.events.tentative = std::uint64_t(all.tentative);
    report.events.crossings = std::uint64_t(all.crossings);
    if (all.photons > 0)
        out.mean_path_m =
            double(all.path) / 1048576.0 * state.lights.diagonal_m / double(all.photons);
    report.executed.emplace_back("absorption_tests", std::uint64_t(all.absorption_tests));
    report.executed.emplace_back("ground_bounces", std::uint64_t(all.bounces));
}

void explain_photon_lights(const FrameView& view, const PhotonState& state, Plan& plan) {
    const World& world = view.world;
    const Lighting& lighting = state.lights.lighting;
    int channels = world.medium.channels;
    const auto tell_colours = [&](const char* what) {
        if (channels == 3) return;
        channels = 3;
        plan.need((std::string("coefficients per colour channel: coloured ") + what).c_str());
    };
    const SkyMap& map = view.environment.sky_map;
    if (map.present() && map.view.planes == 3) tell_colours("sky map");
    if (world.solids.coloured()) tell_colours("solids");
    explain_light(view.scene, state.lights.sun, world, view.environment, lighting, plan);
    if (!lighting.lamps.empty()) {
        plan.need((std::to_string(lighting.lamps.size()) +
                   " lights of [[light]]: marched to the first scattering")
                      .c_str());
        if (coloured_lamps(lighting)) tell_colours("[[light]]");
    }
    note_emission(world.medium, true, plan);
}

void explain_axis(const char* why, const PhotonState& state, Plan& plan) {
    if (state.lights.deposit.axis_degrees > 0) return;
    plan.leave_out("degrees about the sun's axis",
                   why != nullptr ? why : "no phase function has moments there");
}

void explain_split(bool split, const PhotonState& state, Plan& plan) {
    if (split) return;
    plan.leave_out("first-order split", state.lights.lighting.sunlit ? "switched off" : "no sun");
}

void explain_photon_picture(const FrameView& view, const PhotonState& state, const char* display,
                            Plan& plan) {
    const World& world = view.world;
    for (const Light& l : state.lights.lighting.lights)
        plan.need(("photons from the " + l.name).c_str());
    plan.need(display);
    if (state.lights.deposit.channels == 1)
        plan.leave_out("coefficients per colour channel", "achromatic medium: one set per light");
    if (is_white(world.medium)) plan.leave_out("absorption", "albedo 1");
    note_solids(world.solids, view.environment.depth, plan);
    note_surface_light(world.solids, false, false, plan);
    note_upsampling(view.scene, state.picture.thin, plan);
    note_depths(state.lights.lighting, view.wants_depth(), plan);
    if (!state.error_layer) plan.leave_out("batches and second moments", "no error layer");
}

LightGoal photon_goal(const PhotonState& state, std::uint64_t most) {
    const Budget& budget = state.budget;
    const std::uint64_t whole = state.ring.generations;
    const auto wanted = std::uint64_t(budget.generations);
    LightGoal out;
    // Where a time or an error ends it, as many as the sums have room for.
    out.most = wanted == 0 ? whole : wanted < most ? wanted : most;
    if (wanted == 0 && (budget.seconds > 0 || budget.error > 0)) out.most = most;
    out.error = budget.error;
    out.seconds = budget.seconds;
    out.first_look = whole < out.most ? whole : out.most;
    out.doubles = true;
    out.first = "the first generation";
    return out;
}

void digest_photon_sums(const Context& context, PhotonMethod& of, Digests& digests) {
    if (!context.digests) return;
    const StageClock clock(context, "digests");
    Photons& sums = of.sums();
    digest_photons(context.threads, sums);
    digests.emplace_back("photons", photon_digest(sums));
}

void PhotonReport::digest_picture(const Context& context, Digests& digests) {
    digest_photon_sums(context, photons_, digests);
    const std::string& colours = photons_.photons().picture.colours;
    if (!colours.empty()) digests.emplace_back("colours", colours);
}

FinishedParts PhotonReport::finished() const {
    FinishedParts parts;
    parts.batches = true;
    parts.cell_m = photons_.photons().cell_m;
    parts.wide = parts.cell_m > 0 && !photons_.photons().lights.deposit.apart();
    return parts;
}

void PhotonReport::budget_used(int frame, const Report& report, Budget& used) const {
    const PhotonState& state = photons_.photons();
    if (report.photons.generations == 0) return;
    used.photons = state.lights.budget_photons;
    // A film's ring counts on from frame to frame; its length is that of the first one.
    const bool ring = state.ring.animated && state.ring.on;
    used.generations = std::int64_t(report.photons.generations) - (ring ? frame : 0);
}

}  // namespace pileus
