// SPDX-License-Identifier: Apache-2.0
// See group.h.
#include "src/clouds/group.h"

#include <glm/geometric.hpp>

namespace pileus {
namespace {

/// Views from the side by which a cloud's mean radiance is found, and pixels along their sides.
constexpr int kMeanViews = 4, kMeanPixels = 24;

/// As a cloud that is turned by `yaw_deg` has it; in the range of an azimuth.
double seen_azimuth(double azimuth_deg, double yaw_deg) {
    const double sum = azimuth_deg + yaw_deg;
    return sum > 360 ? sum - 360 : sum < -360 ? sum + 360 : sum;
}

}  // namespace

std::array<float, 3> light_gain(const std::array<float, 3>& then, const std::array<float, 3>& now) {
    // A light that was all but out says nothing of another one's colour.
    constexpr float kMaxGain = 4;
    std::array<float, 3> gain{1, 1, 1};
    for (std::size_t c = 0; c < 3; ++c)
        if (then[c] > 0 && then[c] != now[c]) {
            const float ratio = now[c] / then[c];
            gain[c] = ratio < kMaxGain ? ratio : kMaxGain;
        }
    return gain;
}

SunPlane sun_plane(const Sun& sun) {
    SunPlane out;
    out.to_sun = towards_deg(sun.azimuth_deg, sun.elevation_deg);
    // The azimuth's own turn, so that a sun at the zenith has axes, too.
    const SineCosine az = sincos_deg(sun.azimuth_deg), el = sincos_deg(sun.elevation_deg);
    out.up = {-az.sine * el.sine, -az.cosine * el.sine, el.cosine};
    // As a camera that looks along the sunlight has it.
    out.right = glm::cross(-out.to_sun, out.up);
    return out;
}

Status CloudGroup::open(const CloudKind& kind, std::size_t number, double yaw_deg,
                        const CloudLight& light, double ground_m, const RenderOptions& options) {
    kind_ = number;
    yaw_deg_ = yaw_deg;
    middle_ = (kind.low_m + kind.high_m) * 0.5;
    radius_ = 0.5 * glm::length(kind.high_m - kind.low_m);
    FrameState frame = kind.scene;
    frame.sun = light.sun;
    frame.sun.azimuth_deg = seen_azimuth(light.sun.azimuth_deg, yaw_deg);
    frame.sky = light.sky;
    ground_ = light.ground;
    // The sun's own camera is two radii off.
    const double lowest = middle_.z - 3 * radius_;
    ground_.altitude_m = ground_m < lowest ? ground_m : lowest;
    frame.ground = ground_;
    frame.lights.clear();
    session_ = std::make_unique<Session>();
    PILEUS_TRY(session_->open(kind.scene, frame, options, kind.world));
    FrameWork work;
    work.scale = 1;
    has_scale_ = bool(session_->set_work(work));
    return this->light(light);
}

Status CloudGroup::stand_over(double ground_m) {
    if (!(ground_m < ground_.altitude_m)) return Status::ok();
    ground_.altitude_m = ground_m;
    return session_->set_ground(ground_);
}

/// All units of light that a picture should have.
Status CloudGroup::trace() {
    const LightUnits units = session_->light();
    std::uint64_t done = 0;
    return units.whole > 0 ? session_->step(units.whole, done) : Status::ok();
}

Status CloudGroup::mean_radiance(std::array<double, 3>& mean) {
    mean = {};
    double alpha = 0;
    for (int i = 0; i < kMeanViews; ++i) {
        Camera camera = parallel_camera(kMeanPixels, towards_deg(360.0 / kMeanViews * i, 0));
        const Planes* planes = nullptr;
        PILEUS_TRY(draw(camera, Work{}, planes));
        const std::size_t pixels = planes->transmittance.size();
        const Buffer<float>& colour = planes->cloud.empty() ? planes->colour : planes->cloud;
        for (std::size_t j = 0; j < pixels; ++j) {
            alpha += double(1.0f - planes->transmittance[j]);
            for (std::size_t c = 0; c < 3; ++c) mean[c] += double(colour[c * pixels + j]);
        }
    }
    for (double& v : mean) v = alpha > 0 ? v / alpha : 0;
    return Status::ok();
}

Status CloudGroup::light(const CloudLight& light) {
    Sun sun = light.sun;
    sun.azimuth_deg = seen_azimuth(sun.azimuth_deg, yaw_deg_);
    PILEUS_TRY(session_->set_sun(sun));
    ground_.present = light.ground.present;
    std::array<double, 3> alone{}, all{};
    const bool shines = sun.present && sun.elevation_deg > 0;
    if (shines) {
        // The sun's own light first: a black sky, a black ground.
        Sky black;
        black.present = light.sky.present;
        ground_.albedo = 0;
        PILEUS_TRY(session_->set_sky(black, nullptr, false));
        PILEUS_TRY(session_->set_ground(ground_));
        PILEUS_TRY(trace());
        PILEUS_TRY(mean_radiance(alone));
    }
    Sky sky = light.sky;
    if (light.map != nullptr) {
        sky.map_rotation_deg = yaw_deg_;
        sky.map_scale = 1;
    }
    ground_.albedo = light.ground.albedo;
    PILEUS_TRY(session_->set_sky(sky, light.map, false));
    PILEUS_TRY(session_->set_ground(ground_));
    PILEUS_TRY(trace());
    // Without a sun all of it is the sky's, and nothing is to be taken away.
    PILEUS_TRY(mean_radiance(all));
    for (std::size_t c = 0; c < 3; ++c)
        ambient_[c] = float(all[c] > alone[c] ? all[c] - alone[c] : 0);
    PILEUS_TRY(draw_shadow(light));
    lit_ = light.version;
    lit_sun_ = light.sun;
    lit_level_ = light.level;
    return Status::ok();
}

/// Sees all of the cloud from a direction, from two radii off.
Camera CloudGroup::parallel_camera(int pixels, const Double3& from) const {
    Camera camera = session_->camera();
    camera.has_frustum = false;
    camera.orthographic = true;
    camera.fov_deg = Camera{}.fov_deg;
    camera.height_m = 2 * radius_;
    camera.resolution = {pixels, pixels};
    camera.position_m = middle_ + from * (2 * radius_);
    camera.target_m = middle_;
    camera.up = {0, 0, 1};
    return camera;
}

Status CloudGroup::draw_shadow(const CloudLight& light) {
    shadow_ = Buffer<float>();
    if (!light.sun.present || light.sun.elevation_deg <= 0) return Status::ok();
    Sun sun = light.sun;
    sun.azimuth_deg = seen_azimuth(sun.azimuth_deg, yaw_deg_);
    const SunPlane plane = sun_plane(sun);
    Camera camera = parallel_camera(kSunTexels, plane.to_sun);
    camera.up = plane.up;
    const Planes* planes = nullptr;
    PILEUS_TRY(draw(camera, Work{}, planes));
    PILEUS_TRY(shadow_.resize(kSunTexels * kSunTexels, "shadow of a cloud"));
    for (std::size_t i = 0; i < shadow_.size(); ++i) shadow_[i] = planes->transmittance[i];
    return Status::ok();
}

Status CloudGroup::draw(const Camera& camera, const Work& given, const Planes*& planes) {
    PILEUS_TRY(session_->set_camera(camera));
    PILEUS_TRY(session_->set_frame(given.frame));
    if (has_scale_) {
        FrameWork work;
        work.scale = given.scale;
        PILEUS_TRY(session_->set_work(work));
    }
    // Light of these belongs to one camera.
    const LightUnits units = session_->light();
    if (units.whole > 0 && std::strcmp(units.unit, "sample") == 0) {
        std::uint64_t done = 0;
        PILEUS_TRY(session_->step(units.whole, done));
    }
    return session_->draw_alone(given.slack_deg, planes);
}

}  // namespace pileus
