// SPDX-License-Identifier: Apache-2.0
// See clouds.h. Kinds, layers and places; clouds_light.cpp lights them, clouds_frame.cpp draws.
#include "src/clouds/clouds.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "platform/fp_mode.h"
#include "src/base/angles.h"
#include "src/base/number_text.h"
#include "src/methods/registry.h"
#include "src/scene/above_ground.h"
#include "src/scene/method_column.h"
#include "src/scene/number_keys.h"

namespace pileus {
namespace {

/// Clouds move by so much at the most, m.
constexpr double kMaxMoveM = 1e7;

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

/// Nothing shines; the ground is there from the beginning, as a sky's map is read with it.
CloudLight Clouds::no_light() const {
    CloudLight light;
    light.ground = sky_->ground();
    return light;
}

Status Clouds::add_layer(const Scene& scene, std::shared_ptr<const World> world) {
    if (layers_.size() == kMaxCloudLayers)
        return Status::bad_input("layer: one more than " + std::to_string(kMaxCloudLayers) +
                                 ", allowed: up to " + std::to_string(kMaxCloudLayers));
    PILEUS_TRY(SkyLayer::check(scene, *world));
    auto made = std::make_unique<SkyLayer>();
    PILEUS_TRY(made->open(scene, std::move(world), no_light(), sky_->camera(), options_));
    std::uint64_t all = made->own_bytes();
    for (const auto& layer : layers_) all = sum_of_bytes(all, layer->own_bytes());
    PILEUS_TRY(check_limit(options_.limits, LimitId::kMemory, all, "layers of the sky"));
    PILEUS_TRY(made->check_height("layer: ", sky_->ground(), moved_));
    if (moved_ != Double3{}) PILEUS_TRY(made->move(moved_));
    layers_.push_back(std::move(made));
    shaded_ = false;
    ++shading_;
    return Status::ok();
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
        if (!(p.presence > 0 && p.presence <= 1))
            return Status::bad_input(where + "presence: " + number_text(p.presence) +
                                     ", allowed: above 0, up to 1");
        CloudPlace moved = p;
        moved.offset_m += moved_;
        PILEUS_TRY(check_height(where + "offset_m: the cloud is ", sky_->ground(), moved));
    }
    bool same_places = clouds_.size() == places.size();
    clouds_.resize(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        std::unique_ptr<Cloud>& cloud = clouds_[i];
        CloudPlace p = places[i];
        p.offset_m += moved_;
        const bool same = cloud != nullptr && cloud->place.kind == p.kind &&
                          cloud->place.yaw_deg == p.yaw_deg && cloud->place.scale == p.scale;
        same_places = same_places && same && cloud->place.offset_m == p.offset_m;
        if (!same)
            set_anew(p, cloud);
        else if (cloud->place.offset_m != p.offset_m)
            shift(p.offset_m - cloud->place.offset_m, *cloud);
        cloud->place = p;
    }
    drop_groups();
    shaded_ = shaded_ && same_places;
    return Status::ok();
}

/// Its pictures go with it.
void Clouds::shift(const Double3& by, Cloud& cloud) const {
    cloud.place.offset_m += by;
    const CloudKind& kind = kinds_[cloud.place.kind];
    cloud.box = box_of(cloud.place, kind.low_m, kind.high_m);
    pileus::shift(by, cloud.newer);
    pileus::shift(by, cloud.older);
}

Status Clouds::move(const Double3& offset_m) {
    for (int a = 0; a < 3; ++a)
        if (!(offset_m[a] >= -kMaxMoveM && offset_m[a] <= kMaxMoveM))
            return Status::bad_input("offset_m: " + number_text(offset_m[a]) +
                                     ", allowed: within 1e7 m");
    const Double3 by = offset_m - moved_;
    if (by == Double3{}) return Status::ok();
    for (const auto& cloud : clouds_) {
        CloudPlace next = cloud->place;
        next.offset_m += by;
        PILEUS_TRY(check_height("offset_m: a cloud is ", sky_->ground(), next));
    }
    for (std::size_t i = 0; i < layers_.size(); ++i)
        PILEUS_TRY(layers_[i]->check_height("offset_m: layer " + std::to_string(i) + " is ",
                                            sky_->ground(), offset_m));
    for (std::size_t i = 0; i < layers_.size(); ++i) {
        const Status moved = layers_[i]->move(offset_m);
        if (moved) continue;
        while (i-- > 0) (void)layers_[i]->move(moved_);
        return moved;
    }
    for (auto& cloud : clouds_) shift(by, *cloud);
    moved_ = offset_m;
    // All that shades has gone as far, and its shadows with it.
    for (ShadowSource& source : sources_) source.middle += by;
    for (int a = 0; a < 2; ++a) on_ground_.low[a] += by[a];
    if (by.z != 0) shaded_ = false;
    return Status::ok();
}

void Clouds::set_anew(const CloudPlace& place, std::unique_ptr<Cloud>& cloud) const {
    cloud = std::make_unique<Cloud>();
    cloud->place = place;
    cloud->box = box_of(place, kinds_[place.kind].low_m, kinds_[place.kind].high_m);
    cloud->group = SIZE_MAX;
}

Status Clouds::restart() {
    for (auto& cloud : clouds_) set_anew(CloudPlace(cloud->place), cloud);
    groups_.clear();
    given_ = light_ = CloudLight{};
    lit_ = shaded_ = false;
    for (auto& layer : layers_) PILEUS_TRY(layer->restart(no_light(), sky_->camera()));
    return Status::ok();
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

}  // namespace pileus
