// SPDX-License-Identifier: Apache-2.0
// See clouds.h. Kinds, places, light and shadows; clouds_frame.cpp draws.
#include "src/clouds/clouds.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "platform/fp_mode.h"
#include "src/methods/registry.h"
#include "src/scene/above_ground.h"
#include "src/scene/method_column.h"
#include "src/scene/number_keys.h"

namespace pileus {
namespace {

/// Angle between two suns is above so many degrees.
bool moved(const Sun& a, const Sun& b, double degrees) {
    const Double3 from = towards_deg(a.azimuth_deg, a.elevation_deg);
    const Double3 to = towards_deg(b.azimuth_deg, b.elevation_deg);
    // |a - b| = 2 sin(angle / 2), whose halves are small.
    return glm::length(from - to) > 2 * sincos_deg(0.5 * degrees).sine;
}

/// But for where the sun stands.
bool same_light(const CloudLight& a, const CloudLight& b) {
    return a.sun.present == b.sun.present && a.sun.irradiance == b.sun.irradiance &&
           a.sky.present == b.sky.present && a.sky.radiance == b.sky.radiance &&
           a.ground.present == b.ground.present && a.ground.albedo == b.ground.albedo &&
           a.ground.altitude_m == b.ground.altitude_m;
}

double lowest_of(const CloudBox& box) {
    double lowest = box.corners[0].z;
    for (const Double3& corner : box.corners) lowest = std::min(lowest, corner.z);
    return lowest;
}

}  // namespace

Status Clouds::open(Session& sky) {
    const World& world = sky.world();
    if (world.media > 0)
        return Status::bad_input("sky: " + std::to_string(world.media) +
                                 " media, allowed: a scene without [[medium]]");
    if (sky.scenery().scene->camera.flux)
        return Status::bad_input(
            "sky: camera.projection \"flux\", allowed: perspective, orthographic");
    if (sky.light_count() > 0)
        return Status::bad_input("sky: " + std::to_string(sky.light_count()) +
                                 " of [[light]], allowed: none, as clouds know sun and sky alone");
    if (!(sky.work() == sky.whole_work()))
        return Status::bad_input(
            "sky: work that was set, allowed: the scene's; clouds have "
            "pileus_clouds_set_detail");
    sky_ = &sky;
    in_sky_ = sky.carry_clouds();
    options_ = RenderOptions{};
    options_.threads = sky.context().threads;
    options_.kernels = sky.context().kernels;
    options_.limits = sky.context().limits;
    options_.digests = false;
    return Status::ok();
}

Status Clouds::add_kind(const Scene& scene, std::shared_ptr<const World> world, std::size_t& kind) {
    const Medium& medium = world->medium;
    if (world->media == 0 || world->direct_sky || medium.grid.periodic)
        return Status::bad_input(
            "kind: a scene without media, or with one that has no end, allowed: media in boxes");
    if (world->media != scene.media.size())
        return Status::bad_input(
            "kind: a world of another scene, allowed: that which it was made of");
    if (world->solids.meshes)
        return Status::bad_input("kind: a scene with [[solid]], allowed: media alone");
    MethodRow row;
    PILEUS_TRY(find_method(scene, row));
    const MethodColumn column = method_column(scene);
    const bool grid = column == MethodColumn::kPhotonGrid;
    const bool to_camera = has_camera_closure(scene);
    if (column == MethodColumn::kCollectorBillboards || (to_camera && !grid))
        return Status::bad_input(
            "kind: collectors.display \"billboards\" or closure \"camera\", allowed: pictures of "
            "parts, by \"march\", and light towards all sides");
    if (to_camera)
        return Status::bad_input(
            "kind: photon_grid.closure \"camera\", allowed: another, with light towards all sides");
    CloudKind made;
    made.scene = scene;
    made.scene.atmosphere = AtmosphereSettings{};
    made.scene.solids.clear();
    made.world = std::move(world);
    made.low_m = medium.low_m;
    for (int a = 0; a < 3; ++a) made.high_m[a] = made.low_m[a] + medium.extent_m[a];
    kinds_.push_back(std::move(made));
    kind = kinds_.size() - 1;
    return Status::ok();
}

Status Clouds::check_height(const std::string& where, const Ground& ground,
                            const CloudPlace& place) const {
    const CloudKind& kind = kinds_[place.kind];
    const double lowest = lowest_of(box_of(place, kind.low_m, kind.high_m));
    if (!is_below_ground(ground, lowest, place.offset_m.z)) return Status::ok();
    return Status::bad_input(where + below_ground_text(ground, lowest, place.offset_m.z));
}

Status Clouds::place(const std::vector<CloudPlace>& places) {
    for (std::size_t i = 0; i < places.size(); ++i) {
        const CloudPlace& p = places[i];
        const std::string where = "places[" + std::to_string(i) + "].";
        if (p.kind >= kinds_.size())
            return Status::bad_input(where + "kind: " + std::to_string(p.kind) +
                                     ", allowed: below " + std::to_string(kinds_.size()));
        const CloudPlaceSettings given{"", p.offset_m, p.yaw_deg, p.scale};
        PILEUS_TRY(check_numbers(where.c_str(), given));
        PILEUS_TRY(check_height(where + "offset_m: the cloud is ", sky_->ground(), p));
    }
    clouds_.resize(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        std::unique_ptr<Cloud>& cloud = clouds_[i];
        const CloudPlace& p = places[i];
        const bool same = cloud != nullptr && cloud->place.kind == p.kind &&
                          cloud->place.offset_m == p.offset_m &&
                          cloud->place.yaw_deg == p.yaw_deg && cloud->place.scale == p.scale;
        if (!same) set_anew(p, cloud);
    }
    drop_groups();
    shaded_ = false;
    return Status::ok();
}

void Clouds::set_anew(const CloudPlace& place, std::unique_ptr<Cloud>& cloud) const {
    cloud = std::make_unique<Cloud>();
    cloud->place = place;
    cloud->box = box_of(place, kinds_[place.kind].low_m, kinds_[place.kind].high_m);
    cloud->group = SIZE_MAX;
}

void Clouds::restart() {
    for (auto& cloud : clouds_) set_anew(CloudPlace(cloud->place), cloud);
    groups_.clear();
    given_ = light_ = CloudLight{};
    lit_ = shaded_ = false;
}

/// Sessions of kinds and turns that no place has any more.
void Clouds::drop_groups() {
    std::vector<std::size_t> moved_to(groups_.size(), SIZE_MAX);
    std::size_t kept = 0;
    for (std::size_t g = 0; g < groups_.size(); ++g) {
        const bool used = std::any_of(clouds_.begin(), clouds_.end(), [&](const auto& cloud) {
            return groups_[g]->is(cloud->place.kind, cloud->place.yaw_deg);
        });
        if (!used) continue;
        moved_to[g] = kept;
        std::swap(groups_[kept++], groups_[g]);
    }
    groups_.resize(kept);
    for (auto& cloud : clouds_)
        if (cloud->group != SIZE_MAX) cloud->group = moved_to[cloud->group];
}

/// What all kinds and turns take, as soon as one of each kind tells; before most of them are made.
Status Clouds::check_memory(const CloudGroup& next, std::size_t kind) const {
    const auto is_made = [&](double yaw_deg) {
        return std::any_of(groups_.begin(), groups_.end(),
                           [&](const auto& group) { return group->is(kind, yaw_deg); });
    };
    std::vector<double> turns;
    for (const auto& cloud : clouds_)
        if (cloud->place.kind == kind && !is_made(cloud->place.yaw_deg))
            turns.push_back(cloud->place.yaw_deg);
    std::sort(turns.begin(), turns.end());
    turns.erase(std::unique(turns.begin(), turns.end()), turns.end());
    std::uint64_t all = bytes_of(next.own_bytes(), turns.size());
    for (const auto& group : groups_) all = sum_of_bytes(all, group->own_bytes());
    return check_limit(
        options_.limits, LimitId::kMemory, all,
        "clouds: light of " + std::to_string(groups_.size() + turns.size()) + " kinds and turns");
}

Status Clouds::set_detail(const CloudDetail& d) {
    PILEUS_TRY(check_numbers("detail.", d));
    if (d.near_scale != 1 && d.near_scale != 2 && d.near_scale != 4)
        return Status::bad_input("detail.near_scale: " + std::to_string(d.near_scale) +
                                 ", allowed: 1, 2, 4");
    if (d.frame_pixels < 1)
        return Status::bad_input("detail.frame_pixels: " + std::to_string(d.frame_pixels) +
                                 ", allowed: 1 and more");
    detail_ = d;
    return Status::ok();
}

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

/// Groups whose light is older than the sun are lit anew, one in each frame.
Status Clouds::light_up(const Scenery& scenery) {
    const Scene& scene = *scenery.scene;
    if (scene.sky.present && scenery.environment.sky_map.present() && !scene.atmosphere.present)
        return Status::bad_input(
            "sky.map: a picture, allowed for clouds: [atmosphere] or a constant radiance");
    // The ground may have been raised since the clouds were placed.
    for (std::size_t i = 0; i < clouds_.size(); ++i)
        PILEUS_TRY(check_height("ground.altitude_m: cloud " + std::to_string(i) + " is ",
                                sky_->ground(), clouds_[i]->place));
    const bool air = scene.atmosphere.present;
    CloudLight now;
    now.sun = scene.sun;
    now.sky = scene.sky;
    now.ground = scene.ground;
    if (!lit_ || moved(given_.sun, now.sun, detail_.on ? detail_.sun_deg : 0) ||
        !same_light(given_, now)) {
        const CloudLight given = now;
        if (air) {
            double height = 0;
            for (const auto& cloud : clouds_)
                height += cloud->box.middle.z / double(clouds_.size());
            const double sea = scene.ground.present ? scene.ground.altitude_m : 0;
            PILEUS_TRY(light_atmosphere(scene.atmosphere, scene.sun, scene.ground, height - sea,
                                        sky_->context().threads, air_, air_map_));
            for (std::size_t c = 0; c < 3; ++c)
                now.sun.irradiance[c] = float(air_.above[int(c)] * air_.sunlight[c]);
            now.sky = Sky{};
            now.sky.present = true;
            now.map = &air_map_;
        }
        now.version = light_.version + 1;
        light_ = now;
        given_ = given;
        lit_ = true;
    }
    for (auto& cloud : clouds_) {
        if (cloud->group != SIZE_MAX) continue;
        // One that could not be made is tried again.
        std::size_t group = 0;
        PILEUS_TRY(group_of(cloud->place, group));
        cloud->group = group;
    }
    for (auto& group : groups_) {
        if (group->lit() == light_.version) continue;
        const StageClock clock(sky_->context(), "clouds lit");
        PILEUS_TRY(group->light(light_));
        ++stats_.lit;
        shaded_ = false;
        if (detail_.on) break;
    }
    return Status::ok();
}

Status Clouds::cast_shadows() {
    if (shaded_) return Status::ok();
    plane_ = sun_plane(light_.sun);
    std::vector<ShadowSource> sources;
    for (const auto& cloud : clouds_) {
        const CloudGroup& group = *groups_[cloud->group];
        ShadowSource source;
        source.middle = cloud->box.middle;
        source.radius = group.shadow_radius() * cloud->place.scale;
        if (!group.shadow().empty()) source.shadow = group.shadow().data();
        sources.push_back(source);
    }
    for (std::size_t i = 0; i < clouds_.size(); ++i)
        PILEUS_TRY(shade_cloud(plane_, sources, i, clouds_[i]->shade));
    on_ground_ = CloudsOnGround{};
    if (light_.ground.present && light_.sun.present)
        PILEUS_TRY(shade_ground(plane_, sources, light_.ground.altitude_m, on_ground_));
    shaded_ = true;
    return Status::ok();
}

}  // namespace pileus
