// SPDX-License-Identifier: Apache-2.0
// What a host changes in a live session: camera, lights, depths, the place of the media.
// in: values in the host's coordinates -> out: the session's scene in the media's; faults.
// docs/embedding.md, "What may change"
#include "kernels_cpu/core/profile.h"
#include "platform/fp_mode.h"
#include "src/methods/support.h"
#include "src/scene/above_ground.h"
#include "src/scene/frame_fault.h"
#include "src/scene/number_keys.h"
#include "src/scene/read_scene.h"
#include "src/session/session.h"
#include "src/world/atmosphere/atmosphere.h"
#include "src/world/camera/view.h"
#include "src/world/plan_parts.h"

namespace pileus {
namespace {

/// Of a length or its square.
bool is_positive(double v) { return v >= kMinPositive && v < 1e15; }

Status check_frustum(const Camera& camera, bool billboards) {
    if (!camera.has_frustum) return Status::ok();
    const Frustum& f = camera.frustum;
    if (!is_positive(f.half_width) || !is_positive(f.half_height) ||
        !is_positive(1 + f.shift_x * f.shift_x) || !is_positive(1 + f.shift_y * f.shift_y))
        return Status::bad_input(
            "camera.projection: no picture of a positive width and height, allowed: a perspective "
            "or orthographic projection");
    if (billboards && (f.shift_x != 0 || f.shift_y != 0))
        return Status::bad_input(
            "camera.projection: off-centre, allowed: a symmetric one with display = "
            "\"billboards\"");
    return Status::ok();
}

/// Light of suns that stand so near may be shown one beside the other for some pictures.
constexpr double kCloseDeg = 2;

// Each returns null only where check_scene would find nothing, if the scene itself is sound, and
// takes no memory. Of what is seldom set it may name a key that check_scene allows: that decides.

const char* camera_fault(const Scene& scene, const Ground& ground, const Camera& c) {
    if (const char* key = out_of_range(c)) return key;
    // Some methods and the air know one kind alone.
    if (c.orthographic != scene.camera.orthographic || c.flux != scene.camera.flux)
        return "camera.projection";
    if (is_above_air(scene.atmosphere, ground, c)) return "camera.position_m";
    return kFaultKeys[int(frame_fault(ground, c))];
}

const char* ground_fault(const Scene& scene, const Camera& camera, const Ground& ground) {
    if (const char* key = out_of_range(ground)) return key;
    if (!scene.lights.empty() || scene.atmosphere.present) return "ground";
    if (ground.present && sends_too_much(scene.surface, ground.albedo)) return "ground.albedo";
    return is_underground(ground, camera) ? "camera.position_m" : nullptr;
}

const char* lights_fault(const Scene& scene, const Ground& ground,
                         const std::vector<LightSettings>& lights) {
    // What a scene with lights may have else was asked when it got its first.
    if (scene.lights.empty() && !lights.empty()) return "light";
    for (const LightSettings& light : lights) {
        if (const char* key = out_of_range(light)) return key;
        if (light.type == LampKind::kDirectional) continue;
        if (reaches_below(ground, light)) return "light.radius_m";
        if (light.type == LampKind::kPoint) continue;
        // Of a target hosts know nothing.
        if (light.direction == Double3{}) return "light.direction";
        if (is_wide_edge(light)) return "light.penumbra_deg";
    }
    return nullptr;
}

Status refuse(const std::string& what, const char* allowed) {
    return Status::bad_input(what + ", allowed: " + allowed);
}

Status refuse_sealed(const char* what) {
    return Status::bad_input(std::string(what) +
                             ": another than when the flight was opened, allowed: what it had");
}

}  // namespace

Status Session::set_camera(const Camera& given) {
    const FpModeGuard guard;
    const Camera camera = held(given);
    // Light that was gathered for this view stays.
    if (same_view(camera, host_.camera)) return Status::ok();
    if (const char* why = made_.method->fixed_view())
        return Status::bad_input(std::string("camera: ") + why);
    PILEUS_TRY(check_frustum(camera, scene_.collectors.display.billboards));
    if (const char* key = camera_fault(scene_, host_.ground, camera)) {
        PILEUS_TRY(check_camera_in_air(scene_, camera, host_.ground));
        PILEUS_TRY(check_changed(key, scene_, [&](Scene& changed) {
            changed.camera = camera;
            changed.ground = host_.ground;
        }));
    }
    const std::uint64_t pixels =
        std::uint64_t(camera.resolution[0]) * std::uint64_t(camera.resolution[1]);
    PILEUS_TRY(check_limit(context_.limits, LimitId::kPixels, pixels, "camera.resolution"));
    if (seal_.on && camera.resolution != host_.camera.resolution)
        return refuse_sealed("camera.resolution");
    if (camera.resolution != host_.camera.resolution) scenery_.environment.depth = CameraDepth{};
    host_.camera = camera;
    changed_.stale = true;
    return Status::ok();
}

Status Session::set_depth_scale(const DepthScale& scale) {
    depth_scale_ = scale;
    return Status::ok();
}

Status Session::set_sun(const Sun& given) {
    const Sun sun = held(given);
    if (same_sun(sun, host_.sun)) return Status::ok();
    if (kAtmosphere && scene_.atmosphere.present && !sun.present)
        return refuse(kNoSunInAir, kNoSunInAirAllowed);
    if (seal_.on && scene_.atmosphere.present) return refuse_sealed("sun");
    if (const char* key = out_of_range(sun))
        PILEUS_TRY(check_changed(key, scene_, [&](Scene& changed) { changed.sun = sun; }));
    const bool anew =
        changed_.anew || !shine_alike(host_.sun, sun) || !are_within(host_.sun, sun, kCloseDeg);
    host_.sun = sun;
    changed_.stale = true;
    PILEUS_TRY(relight_air());
    changed_.air_moved = changed_.air_moved || (changed_.anew && !anew);
    changed_.anew = anew && changed_.anew;
    return Status::ok();
}

/// The sky follows the sun and the ground.
Status Session::relight_air() {
    if (!kAtmosphere || !scene_.atmosphere.present) return Status::ok();
    const FpModeGuard guard;
    const PoolGuard lent(*threads_);
    // Where memory ends, the next picture tries again.
    changed_.anew = changed_.air_old = true;
    PILEUS_TRY(pileus::relight_air(scene_.atmosphere, host_, context_.threads, world(),
                                   scenery_.environment));
    changed_.air_old = false;
    return Status::ok();
}

Status Session::set_sky(const Sky& sky, const Image* map, bool keep) {
    const FpModeGuard guard;
    if (kAtmosphere && scene_.atmosphere.present) return refuse(kSkyInAir, kSkyInAirAllowed);
    const bool kept =
        sky.present && map == nullptr && keep && scenery_.environment.sky_map.present();
    Sky next = held(kept ? host_.sky : sky);
    next.present = sky.present;
    next.mapped = kept || map != nullptr;
    if (!next.mapped) {
        // What belongs to a map says nothing without one.
        next.map_scale = Sky{}.map_scale;
        next.map_rotation_deg = Sky{}.map_rotation_deg;
    } else {
        next.radiance = Sky{}.radiance;
    }
    if (const char* key = next.mapped ? "sky" : out_of_range(next))
        PILEUS_TRY(check_changed(key, scene_, [&](Scene& changed) { changed.sky = next; }));
    if (seal_.on && (map != nullptr || (!kept && scenery_.environment.sky_map.present())))
        return refuse_sealed("sky.map");
    if (late_.ready) last_.planes = nullptr;
    if (map != nullptr || (!kept && scenery_.environment.sky_map.present())) {
        PILEUS_TRY(set_sky_map(map, next, host_.ground.present, scenery_.environment));
        changed_.anew = true;
    }
    host_.sky = scene_.sky = next;
    changed_.stale = true;
    return Status::ok();
}

Status Session::follow_sun(const Sun& sun) {
    const bool anew =
        changed_.anew || host_.sun.present != sun.present || !are_within(host_.sun, sun, kCloseDeg);
    PILEUS_TRY(set_sun(sun));
    changed_.air_moved = true;
    changed_.anew = anew;
    return Status::ok();
}

Status Session::follow_sky(const Sky& sky, const Image* map) {
    const bool anew = changed_.anew;
    PILEUS_TRY(set_sky(sky, map, false));
    changed_.air_moved = true;
    changed_.anew = anew;
    return Status::ok();
}

Status Session::set_ground(const Ground& given) {
    const Ground ground = held(given);
    if (same_ground(ground, host_.ground)) return Status::ok();
    if (seal_.on && scene_.atmosphere.present) return refuse_sealed("ground");
    if (const char* key = ground_fault(scene_, host_.camera, ground))
        PILEUS_TRY(check_changed(key, scene_, [&](Scene& changed) {
            changed.ground = ground;
            changed.lights = host_.lights;
            changed.camera = host_.camera;
        }));
    PILEUS_TRY(check_media("ground.altitude_m", ground, host_.placement.offset_m.z));
    if (ground.present != host_.ground.present && scenery_.environment.sky_map.present())
        return Status::bad_input(
            "ground: the sky map was read with it or without, allowed: as the scene has it");
    host_.ground = ground;
    changed_.stale = true;
    return relight_air();
}

Status Session::set_lights(const std::vector<LightSettings>& lights) {
    if (lights == host_.lights) return Status::ok();
    PILEUS_TRY(refuse_clouds_sky("lights"));
    if (seal_.on && seal_.lights == 0) return refuse_sealed("light");
    if (seal_.on && lights.size() > seal_.lights)
        return Status::bad_input("light: " + std::to_string(lights.size()) + ", allowed: at most " +
                                 std::to_string(seal_.lights) + ", as when the flight was opened");
    if (const char* key = lights_fault(scene_, host_.ground, lights))
        PILEUS_TRY(check_changed(key, scene_, [&](Scene& changed) {
            changed.lights = lights;
            changed.ground = host_.ground;
        }));
    host_.lights = lights;
    changed_.stale = true;
    return Status::ok();
}

/// Media and ground as a host places them.
Status Session::check_media(const char* key, const Ground& ground, double moved_m) const {
    const double low = world().medium.low_m.z + moved_m;
    if (world().media == 0 || !is_below_ground(ground, low, moved_m)) return Status::ok();
    return Status::bad_input(std::string(key) + ": the media are " +
                             below_ground_text(ground, low, moved_m));
}

Status Session::set_placement(const Double3& offset_m, double yaw_deg) {
    const Placement next{offset_m, yaw_deg};
    Status status;
    for_each_number(next, [&](const auto& key, double v) {
        if (status && !(v > key.range.low && v < key.range.high))
            status = Status::bad_input(std::string(key.name) + ": out of range, allowed: within " +
                                       end_words(key.range.high) + key.unit);
    });
    PILEUS_TRY(std::move(status));
    PILEUS_TRY(check_media("placement.offset_m", host_.ground, offset_m.z));
    const bool moves = offset_m != Double3{} || yaw_deg != 0;
    if (moves && world().media == 0)
        return Status::bad_input("placement: no media to move, allowed: 0");
    if (moves && world().solids.meshes)
        return Status::bad_input("placement: solids stay where they are, allowed: 0");
    if (yaw_deg != 0 && scenery_.environment.sky_map.present())
        return Status::bad_input("placement.yaw_deg: not below a sky map, allowed: 0");
    changed_.stale = changed_.stale || offset_m != host_.placement.offset_m ||
                     yaw_deg != host_.placement.yaw_deg;
    host_.placement = next;
    return Status::ok();
}

Status Session::set_frame(int number) {
    if (number < 0) return Status::bad_input("frame: below 0, allowed: 0 and more");
    changed_.stale = changed_.stale || number != host_.number;
    host_.number = number;
    return Status::ok();
}

Status Session::set_depth(const Rows* rows, DepthKind kind) {
    const FpModeGuard guard;
    CameraDepth& depth = scenery_.environment.depth;
    if (kind == DepthKind::kBuffer && !depth_scale_.known)
        return Status::bad_input(
            "depth: a depth buffer without a camera's near_m, allowed: a camera with it, or "
            "another kind");
    if (seal_.on && rows != nullptr && depth.metres.empty()) return refuse_sealed("depth");
    if (rows != nullptr) {
        const CameraParams camera = make_camera(host_.camera, 0, {});
        PILEUS_TRY(take_depths(*rows, kind, depth_scale_, camera, depth));
    } else if (!depth.present) {
        return Status::ok();
    }
    depth.present = rows != nullptr;
    changed_.stale = true;
    return Status::ok();
}

std::shared_ptr<const void> Session::carry_clouds() {
    if (clouds_ == nullptr) clouds_ = std::make_shared<const char>();
    return clouds_;
}

Status Session::reserve() {
    const FpModeGuard guard;
    return made_.method->reserve(view(), late_);
}

void Session::seal() {
    seal_.on = true;
    made_.method->seal();
    seal_.shine = shine_of(scenery_.lighting);
    seal_.lights = scene_.lights.size();
    const std::size_t lamps = scene_.lights.empty() ? 0 : kMaxLights;
    host_.lights.reserve(lamps);
    scene_.lights.reserve(lamps);
    scenery_.lighting.reserve(lamps);
    // Those of a picture, of the method, and of the accidents that a log is told of.
    constexpr std::size_t kMaxCounters = 16;
    report_.counters.reserve(kMaxCounters);
    counted_.reserve(kMaxCounters);
}

Status Session::reserve_depth() {
    CameraDepth& depth = scenery_.environment.depth;
    const auto& size = host_.camera.resolution;
    const std::uint64_t pixels = std::uint64_t(size[0]) * std::uint64_t(size[1]);
    PILEUS_TRY(depth.metres.resize(pixels, "camera depth"));
    for (float& metres : depth.metres.span()) metres = __builtin_inff();
    depth.columns = std::size_t(size[0]);
    depth.present = true;
    changed_.stale = true;
    return Status::ok();
}

Shine shine_of(const Lighting& l) {
    return {l.sunlit, l.map.columns > 0 || l.sky != Double3{}, l.ground.present};
}

/// Arrays of a light are made when it first shines, and others when the ground is not there.
Status Session::check_sealed() const {
    if (!seal_.on) return Status::ok();
    const Shine now = shine_of(scenery_.lighting);
    if (now.sun && !seal_.shine.sun)
        return Status::bad_input(
            "sun: it did not shine when the flight was opened, allowed: below the horizon");
    if (now.sky != seal_.shine.sky) return refuse_sealed("sky");
    return now.ground != seal_.shine.ground ? refuse_sealed("ground") : Status::ok();
}

Status Session::lit(Scenery*& scenery) {
    const FpModeGuard guard;
    const PoolGuard lent(*threads_);
    PILEUS_TRY(aim());
    scenery = &scenery_;
    return Status::ok();
}

Status Session::draw_alone(double slack_deg, const Planes*& planes) {
    const FpModeGuard guard;
    const PoolGuard lent(*threads_);
    PILEUS_TRY(aim());
    scenery_.depths = true;
    report_.counters.clear();
    RenderAsk ask;
    ask.media_only = true;
    ask.view_slack_deg = slack_deg;
    last_.planes = nullptr;
    Planes* own = nullptr;
    PILEUS_TRY(draw(view(), ask, own));
    planes = own;
    ++stats_.pictures;
    return Status::ok();
}

/// The host's values in the media's coordinates, which alone have moved.
void Session::place() { put_in_media(host_, scene_); }

}  // namespace pileus
