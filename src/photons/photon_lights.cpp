// SPDX-License-Identifier: Apache-2.0
// Which lights shoot photons, how many each, and what becomes of them when frames change them.
// in: a view of a frame -> out: PhotonLights.
// docs/methods.md 3, each image frame, step 1.
#include "src/photons/photon_state.h"
#include "src/scene/frames.h"
#include "src/world/camera/view.h"
#include "src/world/light/lights.h"
#include "src/world/phase/forward_share.h"
#include "src/world/plan_parts.h"

namespace pileus {
namespace {

/// Least share of the scattered light within a cone that is worth a table of its own.
constexpr double kMinPeak = 0.3;

/// The sun that the lights are planned for: one that only rises during an animation needs its
/// place among them from the start.
SunPlace first_place(const FrameView& view) {
    const Scene& scene = view.scene;
    SunPlace own = place_of(scene.sun);
    if (scene.ground.present && own.elevation_deg <= 0 && moves_sun(scene))
        own.elevation_deg = highest_sun(scene, view.rest->sun);
    return own;
}

std::uint64_t planned_photons(const PhotonLights& lights) {
    std::uint64_t all = 0;
    for (const std::uint64_t n : lights.light_photons) all += n;
    return all;
}

/// Photons of a generation of a light that is up: its part of `unit_photons`, 1 at least.
std::uint64_t unit_photons_of(std::size_t light, const PhotonLights& lights) {
    const std::uint64_t planned = lights.light_photons[light], all = planned_photons(lights);
    if (lights.unit_photons == 0 || lights.unit_photons >= all || planned == 0) return planned;
    const auto part =
        std::uint64_t(double(planned) * (double(lights.unit_photons) / double(all)) + 0.5);
    return part == 0 ? 1 : part < planned ? part : planned;
}

/// Photons have the numbers of a whole generation, so that none flies twice.
void set_unit_photons(std::size_t light, const PhotonLights& lights, Light& of) {
    of.photons = unit_photons_of(light, lights);
    of.apart = lights.light_photons[light];
}

/// The set of lights is the ring's layout: a light that has set keeps its place and shoots no
/// photons; those of its day stay in the ring until they leave it.
void keep_places(const PhotonLights& own, Lighting& next) {
    std::vector<Light> lights = own.lighting.lights;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        bool found = false;
        for (const Light& n : next.lights)
            if (n.stream == lights[i].stream) lights[i] = n, found = true;
        lights[i].photons = 0;
        if (found) set_unit_photons(i, own, lights[i]);
        // A diffuse light's colour is today's for the whole ring; a beam's never changes.
        if (!found && !lights[i].beam) lights[i].colour = {0, 0, 0};
    }
    next.lights = lights;
}

/// The sun's and the lamps'; those of lamps that are dark now, too, which may shine later on.
int wanted_axes(const FrameView& view, const Lighting& lighting, const DepositPlan& d) {
    std::size_t lamps = lighting.lamps.size();
    if (lamps > 0 && view.scene.lights.size() > lamps) lamps = view.scene.lights.size();
    if (lamps > std::size_t(kMaxLampAxes)) lamps = std::size_t(kMaxLampAxes);
    int axes = d.lamp_axis + int(lamps);
    while (axes > 1 && d.bands * d.bands + d.axis_degrees * axes > kMaxPacked) --axes;
    return axes > 0 ? axes : 1;
}

/// Whether every light of `next` has a place in the ring, and the ground its map.
bool has_places(const Medium& medium, const PhotonLights& lights, const Lighting& next) {
    for (const Light& light : next.lights) {
        bool found = false;
        for (const Light& place : lights.lighting.lights) found |= place.stream == light.stream;
        if (!found) return false;
    }
    if (coloured_lamps(next) && lights.deposit.channels != 3) return false;
    const GroundMap map = make_ground_map(medium, next), &own = lights.ground_map;
    bool same = map.cells == own.cells;
    for (int a = 0; a < 2; ++a)
        same &= map.origin[a] == own.origin[a] && map.per_metre[a] == own.per_metre[a];
    return same;
}

}  // namespace

bool coloured_lamps(const Lighting& lighting) {
    bool coloured = false;
    for (const LampParams& l : lighting.lamps)
        coloured |= l.light[0] != l.light[1] || l.light[1] != l.light[2];
    return coloured;
}

Status choose_photon_lights(const FrameView& view, std::uint64_t generations, PhotonState& state) {
    PhotonLights& lights = state.lights;
    const World& world = view.world;
    SkyMap& map = view.environment.sky_map;
    if (map.present())
        PILEUS_TRY(aim_sky_map(world.medium.extent_m, world.medium.grid.periodic, map));
    state.ring.generations = generations;
    if (lights.budget_photons >= 0 && std::uint64_t(lights.budget_photons) < generations)
        state.ring.generations =
            lights.budget_photons > 0 ? std::uint64_t(lights.budget_photons) : 1;
    lights.sun = first_place(view);
    lights.lighting = light_of(view.scene, lights.sun, world, view.environment);
    // Photons of one light that differ in colour: each channel has sums of its own.
    const bool coloured = (map.present() && map.view.planes == 3) || world.solids.coloured() ||
                          coloured_lamps(lights.lighting);
    lights.deposit.channels = coloured ? 3 : world.medium.channels;
    share_photons(std::uint64_t(lights.budget_photons) / state.ring.generations,
                  lights.lighting.lights);
    lights.light_photons.clear();
    for (const Light& l : lights.lighting.lights) lights.light_photons.push_back(l.photons);
    lights.ground_map = make_ground_map(world.medium, lights.lighting);
    double square = 0;
    for (const double side : world.medium.extent_m) square += side * side;
    lights.diagonal_m = __builtin_sqrt(square);
    return Status::ok();
}

void aim_deposit(const FrameView& view, PhotonState& state) {
    const Camera& seen = view.scene.camera;
    const CameraParams camera = make_camera(seen, 0, view.world.medium.low_m);
    DepositPlan& deposit = state.lights.deposit;
    deposit.orthographic = seen.orthographic;
    for (int a = 0; a < 3; ++a)
        deposit.camera[a] = seen.orthographic ? -camera.forward[a] : camera.origin[a];
}

const char* why_no_peak(const FrameView& view, double peak_deg, bool harmonics,
                        const PhotonState& state) {
    const Medium& medium = view.world.medium;
    if (!(peak_deg > 0)) return "switched off";
    const DepositPlan& deposit = state.lights.deposit;
    if (!harmonics && !has_axes(state.lights.lighting)) return "no sun";
    // The first order of lamps is always the march's.
    if (state.lights.lighting.sunlit ? deposit.first_order != 2 : deposit.mode == kDepositOutgoing)
        return "the march does not show the first order";
    if (medium.count != 1 && !harmonics) return "other than one medium";
    for (int i = 0; i < medium.count; ++i)
        if (forward_share(medium.optics[std::size_t(i)].phase, peak_deg) >= kMinPeak)
            return nullptr;
    return "the phase function has no peak";
}

bool has_axes(const Lighting& lighting) { return lighting.sunlit || !lighting.lamps.empty(); }

void choose_axes(const FrameView& view, PhotonState& state) {
    DepositPlan& d = state.lights.deposit;
    d.lamp_axis = state.lights.lighting.sunlit ? 1 : 0;
    d.axes = wanted_axes(view, state.lights.lighting, d);
}

void choose_peak(const FrameView& view, double peak_deg, bool harmonics, PhotonState& state) {
    const bool peak = why_no_peak(view, peak_deg, harmonics, state) == nullptr;
    DepositPlan& deposit = state.lights.deposit;
    deposit.peak_turn = peak ? turn_of_deg(peak_deg) : 0;
    deposit.peak_deg = peak ? peak_deg : 0;
    deposit.by_bands = harmonics;
    const Medium& medium = view.world.medium;
    for (int i = 0; i < medium.count && deposit.apart(); ++i) {
        const std::vector<double> kept =
            peak_moments(medium.optics[std::size_t(i)].phase, deposit.peak_turn);
        for (std::size_t l = 0; l < kMaxBands + kMaxAxisDegrees; ++l)
            deposit.kept[i][l] = l < kept.size() ? float(kept[l]) : 0.0f;
    }
}

Status check_camera_closure(const char* key, const FrameView& view, const PhotonState& state) {
    const Medium& medium = view.world.medium;
    for (int i = 0; i < medium.count && state.lights.deposit.mode == kDepositCamera; ++i)
        if (needle_shares(medium.optics[std::size_t(i)].phase).any())
            return Status::bad_input(view.scene.file + ": " + key + ": \"camera\" with medium." +
                                     std::to_string(i) +
                                     ".phase, a lobe of g = 1 or -1, allowed: another closure, or "
                                     "a wider lobe");
    return Status::ok();
}

bool beam_of_points(const FrameView& view, const PhotonState& state) {
    return !view.scene.lights.empty() || !state.lights.lighting.lamps.empty();
}

std::uint64_t beam_sets(const FrameView& view, const PhotonState& state) {
    if (!(state.lights.deposit.peak_turn > 0)) return 0;
    return std::uint64_t(view.world.medium.channels) * (beam_of_points(view, state) ? 2 : 1);
}

void follow_lights(const FrameView& view, PhotonState& state) {
    PhotonLights& lights = state.lights;
    const SunPlace sun = sun_at(view.scene, view.rest->sun, view.frame);
    // Lamps and ground move where the media do.
    if (sun == lights.sun && !moves_media(view.scene)) return;
    Lighting next = view.lighting;
    keep_places(lights, next);
    lights.lighting = next;
    lights.sun = sun;
    state.shadow.ready = false;
}

bool relight_photons(const FrameView& view, PhotonState& state) {
    PhotonLights& lights = state.lights;
    Lighting next = view.lighting;
    const DepositPlan& deposit = lights.deposit;
    if (!has_places(view.world.medium, lights, next) ||
        (deposit.axis_degrees > 0 && wanted_axes(view, next, deposit) > deposit.axes))
        return false;
    keep_places(lights, next);
    const Lighting& before = lights.lighting;
    if (!same_lights(before, next) || before.constant != next.constant || before.sky != next.sky ||
        before.ground.radiance() != next.ground.radiance())
        ++state.ring.relights;
    if (next.sunlit != before.sunlit || next.to_sun != before.to_sun) state.shadow.ready = false;
    lights.lighting = next;
    lights.sun = place_of(view.scene.sun);
    return true;
}

Status limit_photons(const FrameWork& work, PhotonState& state) {
    PhotonLights& lights = state.lights;
    const std::uint64_t photons = std::uint64_t(work.photons), all = planned_photons(lights);
    if (!state.ring.on && photons < all)
        return Status::bad_input("work.photons: " + std::to_string(photons) +
                                 ", but all generations are one sum, allowed: 0, or ring = true");
    state.shadow.light_refresh = work.light_refresh;
    if (state.picture.thins) put_work(work, state.picture.thin);
    lights.unit_photons = photons < all ? photons : 0;
    std::vector<Light>& shining = lights.lighting.lights;
    for (std::size_t i = 0; i < shining.size(); ++i)
        if (shining[i].photons > 0) set_unit_photons(i, lights, shining[i]);
    return Status::ok();
}

bool same_lights(const Lighting& a, const Lighting& b) {
    if (a.lights.size() != b.lights.size() || a.ground.present != b.ground.present ||
        a.ground.z != b.ground.z || a.ground.albedo != b.ground.albedo ||
        a.map.columns != b.map.columns || !same_lamps(a.lamps, b.lamps))
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
