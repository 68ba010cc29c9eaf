// SPDX-License-Identifier: Apache-2.0
// See layer.h.
#include "src/clouds/layer.h"

#include <algorithm>
#include <cstring>
#include <glm/geometric.hpp>

#include "src/base/angles.h"
#include "src/base/powers.h"
#include "src/methods/registry.h"
#include "src/scene/above_ground.h"
#include "src/scene/method_column.h"

namespace pileus {
namespace {

/// Half a side of a layer's shadow, m; it is drawn anew where the eye has gone a quarter of that.
constexpr double kShadowRadius = 24000;
/// A sun lower than this throws shadows that are longer than the square is wide.
constexpr double kLowestSine = 0.03;
/// Steps of a shadow's ray.
constexpr int kShadowSteps = 64;
/// Where less comes through, rays end.
constexpr double kLeastLeft = 1e-10;
/// To the middle of a layer at the least and at the most, m.
constexpr double kNearestM = 10, kFarthestM = 200000;
constexpr double kLn2 = 0.693147180559945309;

/// What lets light through, and no light: as few steps as a shadow shows.
void make_sunward(Scene& scene) {
    scene.method = "raymarch";
    scene.raymarch = RaymarchSettings{};
    scene.raymarch.march.steps = kShadowSteps;
    scene.raymarch.march.stop_below = kLeastLeft;
    scene.raymarch.scattering.many = scene.raymarch.scattering.automatic = false;
    scene.raymarch.light.sky_ambient = false;
    scene.sun = Sun{};
    scene.sky = Sky{};
    scene.ground = Ground{};
    scene.lights.clear();
}

/// Whether it has sides.
bool is_boxed(const World& world) {
    if (world.medium.grid.periodic) return false;
    return !world.direct_sky || world.layer.params.boxed != 0;
}

void set_altitudes(const World& world, double& low_m, double& high_m) {
    low_m = world.medium.low_m.z;
    high_m = low_m + world.medium.extent_m[2];
    if (!world.direct_sky) return;
    low_m = double(world.layer.params.low_m);
    high_m = low_m + double(world.layer.params.height_m);
}

}  // namespace

Status SkyLayer::check(const Scene& scene, const World& world) {
    if (world.media == 0 || world.media != scene.media.size())
        return Status::bad_input(
            "layer: a scene without media, or a world of another scene, "
            "allowed: a scene with [[medium]] and its world");
    if (world.solids.meshes)
        return Status::bad_input("layer: a scene with [[solid]], allowed: media alone");
    if (scene.clouds.present())
        return Status::bad_input("layer: [clouds] of its own, allowed: a scene with [[medium]]");
    MethodRow row;
    PILEUS_TRY(find_method(scene, row));
    if (method_column(scene) == MethodColumn::kCollectorBillboards)
        return Status::bad_input("layer: collectors.display \"billboards\", allowed: \"march\"");
    if (has_camera_closure(scene))
        return Status::bad_input("layer: closure \"camera\", allowed: light towards all sides");
    return Status::ok();
}

Status SkyLayer::open(const Scene& scene, std::shared_ptr<const World> world,
                      const CloudLight& light, const Camera& camera, const RenderOptions& options) {
    scene_ = scene;
    // The sky's, which all of it is seen through.
    scene_.atmosphere = AtmosphereSettings{};
    scene_.crop = {};
    world_ = std::move(world);
    options_ = options;
    set_altitudes(*world_, low_m_, high_m_);
    boxed_ = is_boxed(*world_);
    return restart(light, camera);
}

Status SkyLayer::restart(const CloudLight& light, const Camera& camera) {
    FrameState frame = scene_;
    frame.camera = camera;
    frame.sun = light.sun;
    frame.sky = light.map != nullptr ? Sky{} : light.sky;
    frame.ground = light.ground;
    frame.lights.clear();
    session_ = std::make_unique<Session>();
    PILEUS_TRY(session_->open(scene_, frame, options_, world_));
    Scene sunward = scene_;
    make_sunward(sunward);
    frame = sunward;
    frame.camera.orthographic = true;
    frame.camera.fov_deg = Camera{}.fov_deg;
    frame.camera.position_m = {0, 0, high_m_ + kShadowRadius};
    frame.camera.target_m = {0, 0, low_m_};
    frame.camera.up = {0, 1, 0};
    frame.camera.height_m = 2 * kShadowRadius;
    frame.camera.resolution = {kLayerTexels, kLayerRows};
    sunward_ = std::make_unique<Session>();
    PILEUS_TRY(sunward_->open(sunward, frame, options_, world_));
    shown_ = Map{};
    next_ = Map{};
    version_ = 0;
    stepped_ = false;
    if (offset_ != Double3{}) PILEUS_TRY(move(Double3(offset_)));
    return Status::ok();
}

Status SkyLayer::light(const CloudLight& light, const Sun& sun, const Camera& camera) {
    const bool first = version_ == 0;
    PILEUS_TRY(first ? session_->set_sun(sun) : session_->follow_sun(sun));
    if (version_ == light.version) return Status::ok();
    Sky sky = light.sky;
    if (light.map != nullptr) sky.map_scale = 1;
    PILEUS_TRY(first ? session_->set_sky(sky, light.map, false)
                     : session_->follow_sky(sky, light.map));
    // A ground that rises needs the camera that stands on it first.
    if (!session_->set_ground(light.ground)) {
        PILEUS_TRY(session_->set_camera(camera));
        PILEUS_TRY(session_->set_ground(light.ground));
    }
    version_ = light.version;
    stepped_ = false;
    return Status::ok();
}

Status SkyLayer::check_height(const std::string& where, const Ground& ground,
                              const Double3& offset_m) const {
    const double low = world_->medium.low_m.z + offset_m.z;
    if (!is_below_ground(ground, low, offset_m.z)) return Status::ok();
    return Status::bad_input(where + below_ground_text(ground, low, offset_m.z));
}

Status SkyLayer::move(const Double3& offset_m) {
    PILEUS_TRY(session_->set_placement(offset_m, 0));
    PILEUS_TRY(sunward_->set_placement(offset_m, 0));
    for (Map* map : {&shown_, &next_}) map->middle += offset_m - offset_;
    offset_ = offset_m;
    return Status::ok();
}

Status SkyLayer::draw(const Camera& camera, int frame, Span<const float> opaque,
                      const Planes*& planes) {
    PILEUS_TRY(session_->set_camera(camera));
    PILEUS_TRY(session_->set_frame(frame));
    if (opaque.empty()) {
        PILEUS_TRY(session_->set_depth(nullptr, DepthKind::kDistance));
    } else {
        Rows rows;
        // Depths are read alone.
        rows.first = reinterpret_cast<unsigned char*>(const_cast<float*>(opaque.data));
        rows.stride = std::int64_t(camera.resolution[0]) * std::int64_t(sizeof(float));
        PILEUS_TRY(session_->set_depth(&rows, DepthKind::kDistance));
    }
    const LightUnits units = session_->light();
    const bool of_camera = units.whole > 0 && std::strcmp(units.unit, "sample") == 0;
    if (units.whole > 0 && (of_camera || !stepped_ || units.held == 0)) {
        std::uint64_t done = 0;
        PILEUS_TRY(session_->step(units.whole, done));
        stepped_ = true;
    }
    return session_->draw_alone(0, planes);
}

/// Rows [map.rows, rows) of the square that the sun sees.
Status SkyLayer::draw_shadow_rows(Map& map, int rows) {
    const double rise = map.plane.to_sun.z;
    Camera camera = sunward_->camera();
    camera.resolution = {kLayerTexels, kLayerRows};
    // All of the square's edge lies above the layer.
    const double above = (kShadowRadius * map.plane.up.z + (high_m_ - low_m_)) / rise + 1;
    const Double3 eye = map.middle + map.plane.to_sun * above;
    camera.position_m = eye;
    camera.target_m = map.middle;
    camera.up = map.plane.up;
    camera.has_frustum = true;
    const double step = 2 * kShadowRadius / kLayerTexels;
    for (; map.rows < rows; map.rows += kLayerRows) {
        camera.frustum = {kShadowRadius, 0.5 * kLayerRows * step, 0,
                          kShadowRadius - (map.rows + 0.5 * kLayerRows) * step};
        PILEUS_TRY(sunward_->set_camera(camera));
        const Planes* planes = nullptr;
        PILEUS_TRY(sunward_->draw_alone(0, planes));
        float* const to = map.texels.data() + std::size_t(map.rows) * kLayerTexels;
        const double g = double(mean_cosine(world_->medium));
        for (std::size_t i = 0; i < std::size_t(kLayerRows) * kLayerTexels; ++i)
            to[i] = total_left(planes->transmittance[i], g);
    }
    return Status::ok();
}

Status SkyLayer::extinction_at(const Double3& at, double& extinction) {
    // What a short way through the place leaves.
    constexpr float kWayM = 8;
    Camera camera = sunward_->camera();
    camera.position_m = at - Double3{0.5 * double(kWayM), 0, 0};
    camera.target_m = at;
    camera.up = {0, 0, 1};
    camera.has_frustum = true;
    camera.frustum = {0.5, 0.5, 0, 0};
    camera.resolution = {1, 1};
    Rows rows;
    float way = kWayM;
    rows.first = reinterpret_cast<unsigned char*>(&way);
    rows.stride = sizeof way;
    PILEUS_TRY(sunward_->set_camera(camera));
    PILEUS_TRY(sunward_->set_depth(&rows, DepthKind::kDistance));
    const Planes* planes = nullptr;
    PILEUS_TRY(sunward_->draw_alone(0, planes));
    const double left = double(planes->transmittance[0]);
    extinction = left < 1 ? -kLn2 * log2_of(std::max(left, 1e-12)) / double(kWayM) : 0;
    return Status::ok();
}

/// Draws the square of a sun around `eye` into `next_`, as far as so many rows.
Status SkyLayer::draw_next(const SunPlane& plane, const Double3& eye, int rows) {
    if (next_.rows == 0) {
        next_.plane = plane;
        next_.middle = {eye.x, eye.y, middle_m()};
        // All of a box, where the square has room for it.
        const Medium& medium = world_->medium;
        for (int a = 0; boxed_ && a < 2; ++a)
            if (medium.extent_m[a] < kShadowRadius)
                next_.middle[a] = medium.low_m[a] + 0.5 * medium.extent_m[a] + offset_[a];
        if (next_.texels.empty())
            PILEUS_TRY(next_.texels.resize(kLayerTexels * kLayerTexels, "shadow of a layer"));
    }
    return draw_shadow_rows(next_, rows);
}

Status SkyLayer::follow_shadow(const SunPlane& plane, bool sun, const Double3& eye, double sun_deg,
                               bool at_once, bool& changed) {
    changed = false;
    if (mean_ < 0) {
        Sun zenith;
        zenith.elevation_deg = 90;
        PILEUS_TRY(draw_next(sun_plane(zenith), eye, kLayerTexels));
        double sum = 0;
        for (const float left : next_.texels.span()) sum += double(left);
        mean_ = float(sum / double(next_.texels.size()));
        next_.rows = 0;
        changed = true;
    }
    if (!sun || plane.to_sun.z < kLowestSine) {
        changed = changed || shown_.made;
        shown_.made = false;
        next_.rows = 0;
        return Status::ok();
    }
    const auto off = [&](const Map& map) {
        const double x = map.middle.x - eye.x, y = map.middle.y - eye.y;
        const double far = 0.25 * kShadowRadius;
        const bool gone = !boxed_ && x * x + y * y > far * far;
        // |a - b| = 2 sin(angle / 2), whose halves are small.
        return gone ||
               glm::length(map.plane.to_sun - plane.to_sun) > 2 * sincos_deg(0.5 * sun_deg).sine;
    };
    if (shown_.made && next_.rows == 0 && !off(shown_)) return Status::ok();
    // A clock that jumps does not wait for the shadow of another hour.
    constexpr double kJump = 8;
    const auto jumped = [&](const Map& map) {
        return glm::length(map.plane.to_sun - plane.to_sun) >
               2 * sincos_deg(0.5 * kJump * sun_deg).sine;
    };
    if (next_.rows > 0 && jumped(next_)) next_.rows = 0;
    const int rows = shown_.made && !at_once ? next_.rows + kLayerRows : kLayerTexels;
    PILEUS_TRY(draw_next(plane, eye, rows));
    if (next_.rows < kLayerTexels) return Status::ok();
    next_.made = true;
    std::swap(shown_, next_);
    next_.rows = 0;
    next_.made = false;
    changed = true;
    return Status::ok();
}

ShadowSource SkyLayer::shadow() const {
    ShadowSource out;
    out.middle = shown_.middle;
    out.middle.z = middle_m();
    out.radius = kShadowRadius;
    out.plane = &shown_.plane;
    out.beyond = mean_left();
    if (!shown_.made) return out;
    out.shadow = shown_.texels.data();
    out.side = kLayerTexels;
    return out;
}

double SkyLayer::way_to_middle(const Double3& eye, const Double3& ray) const {
    Double3 low = world_->medium.low_m + offset_, high = low;
    for (int a = 0; a < 3; ++a) high[a] += world_->medium.extent_m[a];
    low.z = low_m_ + offset_.z, high.z = high_m_ + offset_.z;
    double enters = 0, leaves = kFarthestM;
    // Sides of a level sheet are its base and its top alone.
    for (int a = boxed_ ? 0 : 2; a < 3; ++a) {
        if (ray[a] == 0) {
            if (eye[a] < low[a] || eye[a] > high[a]) return kFarthestM;
            continue;
        }
        const double s = (low[a] - eye[a]) / ray[a], t = (high[a] - eye[a]) / ray[a];
        enters = std::max(enters, std::min(s, t));
        leaves = std::min(leaves, std::max(s, t));
    }
    if (!(leaves > enters)) return kFarthestM;
    return std::clamp(0.5 * (enters + leaves), kNearestM, kFarthestM);
}

std::uint64_t SkyLayer::own_bytes() const {
    const std::uint64_t shared = bytes_of_world(*world_);
    std::uint64_t all = 0;
    for (const Session* session : {session_.get(), sunward_.get()}) {
        const std::uint64_t peak = session->plan().memory.peak();
        all += peak > shared ? peak - shared : 0;
    }
    return all;
}

}  // namespace pileus
