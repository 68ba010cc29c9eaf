// SPDX-License-Identifier: Apache-2.0
// See clouds.h. Light and shadows of kinds and layers; what is at a place.
#include <algorithm>
#include <glm/geometric.hpp>

#include "platform/fp_mode.h"
#include "src/base/angles.h"
#include "src/clouds/clouds.h"

namespace pileus {
namespace {

/// Where the moon lights the clouds it takes the sun's place.
void take_place(const Atmosphere& air, Sun& sun) {
    sun.azimuth_deg = air.azimuth_deg;
    sun.elevation_deg = air.elevation_deg;
}

/// But for where the sun stands.
bool same_light(const CloudLight& a, const CloudLight& b) {
    return shine_alike(a.sun, b.sun) && a.sky.present == b.sky.present &&
           a.sky.radiance == b.sky.radiance && a.ground.present == b.ground.present &&
           a.ground.albedo == b.ground.albedo && a.ground.altitude_m == b.ground.altitude_m;
}

}  // namespace

/// The session of a kind and a turn; makes it.
Status Clouds::group_of(const CloudPlace& place, std::size_t& group) {
    const double ground_m = (light_.ground.altitude_m - place.offset_m.z) / place.scale - 1;
    for (group = 0; group < groups_.size(); ++group)
        if (groups_[group]->is(place.kind, place.yaw_deg))
            return light_.ground.present ? groups_[group]->stand_over(ground_m) : Status::ok();
    const StageClock clock(sky_->context(), "clouds lit");
    auto made = std::make_unique<CloudGroup>();
    PILEUS_TRY(
        made->open(kinds_[place.kind], place.kind, place.yaw_deg, light_, ground_m, options_));
    PILEUS_TRY(check_memory(*made, place.kind));
    ++stats_.lit;
    groups_.push_back(std::move(made));
    return Status::ok();
}

/// What shines on the clouds, where it has changed by more than a cloud's light may be off.
Status Clouds::take_light(const Scenery& scenery) {
    const Scene& scene = *scenery.scene;
    CloudLight now;
    now.sun = scene.sun;
    now.sky = scene.sky;
    now.ground = scene.ground;
    if (lit_ && are_within(given_.sun, now.sun, detail_.on ? detail_.sun_deg : 0) &&
        same_light(given_, now))
        return Status::ok();
    const CloudLight given = now;
    if (scene.atmosphere.present) {
        double height = 0;
        const double all = double(clouds_.size() + layers_.size());
        for (const auto& cloud : clouds_) height += cloud->box.middle.z / all;
        for (const auto& layer : layers_) height += layer->middle_m() / all;
        const double sea = scene.ground.present ? scene.ground.altitude_m : 0;
        PILEUS_TRY(light_atmosphere(scene.atmosphere, scene.sun, scene.ground,
                                    std::max(height - sea, 0.0), sky_->context().threads, air_,
                                    air_map_, scene.night));
        if (air_.moonlit) take_place(air_, now.sun);
        for (std::size_t c = 0; c < 3; ++c)
            now.sun.irradiance[c] = float(air_.above[int(c)] * air_.sunlight[c]);
        now.sky = Sky{};
        now.sky.present = true;
        now.map = &air_map_;
    }
    const bool shines = now.sun.present && now.sun.elevation_deg > 0;
    const double sine = shines ? sincos_deg(now.sun.elevation_deg).sine : 0;
    const SkyMap& map = scenery.environment.sky_map;
    for (std::size_t c = 0; c < 3; ++c) {
        double level = sine * double(now.sun.irradiance[c]);
        if (map.present())
            level += map.ground_irradiance[int(c)];
        else if (now.sky.present)
            level += kPi64 * double(now.sky.radiance[c]);
        now.level[c] = float(level);
    }
    now.version = light_.version + 1;
    light_ = now;
    given_ = given;
    lit_ = true;
    return Status::ok();
}

/// Groups whose light is of another sun are lit anew, one in each frame: that whose sun is farthest
/// off, so that none waits for more frames than there are groups; those first that have a sun that
/// has set.
Status Clouds::light_groups() {
    const Double3 sun = towards_deg(light_.sun.azimuth_deg, light_.sun.elevation_deg);
    const auto wrong = [&](const CloudGroup& group) {
        const Sun& was = group.lit_sun();
        const double off = glm::length(towards_deg(was.azimuth_deg, was.elevation_deg) - sun);
        const bool set = was.elevation_deg > 0 && light_.sun.elevation_deg <= 0;
        return set ? off + 4 : off;
    };
    for (;;) {
        CloudGroup* worst = nullptr;
        for (auto& group : groups_)
            if (group->lit() != light_.version &&
                (worst == nullptr || wrong(*group) > wrong(*worst)))
                worst = group.get();
        if (worst == nullptr) return Status::ok();
        const StageClock clock(sky_->context(), "clouds lit");
        // Its shadow is another one, or none where memory ends.
        shaded_ = false;
        sources_.clear();
        PILEUS_TRY(worst->light(light_));
        ++stats_.lit;
        if (detail_.on) return Status::ok();
    }
}

/// Each layer has the sun of this frame through the air above it, and the sky of the clouds.
Status Clouds::light_layers(const Scenery& scenery) {
    const Scene& scene = *scenery.scene;
    const double sea = scene.ground.present ? scene.ground.altitude_m : 0;
    for (auto& layer : layers_) {
        Sun sun = scene.sun;
        if (scene.atmosphere.present && air_.moonlit) take_place(air_, sun);
        if (scene.atmosphere.present) {
            const double height_km = 1e-3 * std::clamp(layer->middle_m() - sea, 0.0, 50000.0);
            const std::array<double, 3> share =
                sunlight(air_.tables, height_km, sincos_deg(sun.elevation_deg).sine);
            for (std::size_t c = 0; c < 3; ++c)
                sun.irradiance[c] = float(air_.above[int(c)] * share[c]);
        }
        PILEUS_TRY(layer->light(light_, sun, sky_->camera()));
    }
    return Status::ok();
}

Status Clouds::light_up(const Scenery& scenery) {
    const Scene& scene = *scenery.scene;
    if (scene.sky.present && scenery.environment.sky_map.present() && !scene.atmosphere.present)
        return Status::bad_input(
            "sky.map: a picture, allowed for clouds: [atmosphere] or a constant radiance");
    // The ground may have been raised since the clouds were placed.
    for (std::size_t i = 0; i < clouds_.size(); ++i)
        PILEUS_TRY(check_height("ground.altitude_m: cloud " + std::to_string(i) + " is ",
                                sky_->ground(), clouds_[i]->place));
    for (std::size_t i = 0; i < layers_.size(); ++i)
        PILEUS_TRY(layers_[i]->check_height(
            "ground.altitude_m: layer " + std::to_string(i) + " is ", sky_->ground(), moved_));
    PILEUS_TRY(take_light(scenery));
    for (auto& cloud : clouds_) {
        if (cloud->group != SIZE_MAX) continue;
        // One that could not be made is tried again.
        std::size_t group = 0;
        PILEUS_TRY(group_of(cloud->place, group));
        cloud->group = group;
    }
    PILEUS_TRY(light_groups());
    return light_layers(scenery);
}

Status Clouds::cast_shadows() {
    const SunPlane plane = pileus::sun_plane(light_.sun);
    for (auto& layer : layers_) {
        bool changed = false;
        const StageClock clock(sky_->context(), "shadows of layers");
        PILEUS_TRY(layer->follow_shadow(plane, light_.sun.present, sky_->camera().position_m,
                                        detail_.on ? detail_.sun_deg : 0, !detail_.on, changed));
        if (!changed) continue;
        shaded_ = false;
        ++shading_;
    }
    if (shaded_) return Status::ok();
    plane_ = plane;
    sources_.clear();
    for (const auto& cloud : clouds_) {
        const CloudGroup& group = *groups_[cloud->group];
        ShadowSource source;
        source.middle = cloud->box.middle;
        source.radius = group.shadow_radius() * cloud->place.scale;
        if (!group.shadow().empty()) source.shadow = group.shadow().data();
        sources_.push_back(source);
    }
    for (const auto& layer : layers_)
        sources_.push_back(light_.sun.present ? layer->shadow() : ShadowSource{});
    for (std::size_t i = 0; i < clouds_.size(); ++i)
        PILEUS_TRY(shade_cloud(plane_, sources_, i, clouds_[i]->shade));
    on_ground_ = CloudsOnGround{};
    if (light_.ground.present && light_.sun.present)
        PILEUS_TRY(shade_ground(plane_, sources_, light_.ground.altitude_m, on_ground_));
    shaded_ = true;
    return Status::ok();
}

float Clouds::sky_left(double z) const {
    float left = 1;
    for (const auto& layer : layers_)
        if (z < layer->middle_m()) left *= layer->mean_left();
    return left;
}

double Clouds::extinction_of_clouds(const Double3& at) const {
    double all = 0;
    for (const auto& cloud : clouds_) {
        const CloudPlace& place = cloud->place;
        const CloudKind& kind = kinds_[place.kind];
        const Medium& medium = kind.world->medium;
        const Double3 own =
            turned_back(at - place.offset_m, sincos_deg(place.yaw_deg)) / place.scale;
        float local[3];
        bool inside = true;
        for (int a = 0; a < 3; ++a) {
            inside = inside && own[a] >= kind.low_m[a] && own[a] <= kind.high_m[a];
            local[a] = float(own[a] - kind.low_m[a]) / medium.grid.cell_m[a];
        }
        if (!inside || medium.volume.density.empty()) continue;
        all += place.presence * double(medium.sigma) *
               double(density_at(medium.volume.density.span(), medium.grid, local)) / place.scale;
    }
    return all;
}

Status Clouds::extinction_at(const Double3& at, double& extinction) {
    const FpModeGuard guard;
    const PoolGuard lent(threads_);
    extinction = extinction_of_clouds(at);
    for (auto& layer : layers_) {
        double own = 0;
        PILEUS_TRY(layer->extinction_at(at, own));
        extinction += own;
    }
    return Status::ok();
}

Status Clouds::prepare() {
    const FpModeGuard guard;
    const PoolGuard lent(threads_);
    Scenery* around = nullptr;
    PILEUS_TRY(sky_->lit(around));
    PILEUS_TRY(light_up(*around));
    return cast_shadows();
}

}  // namespace pileus
