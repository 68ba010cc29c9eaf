// SPDX-License-Identifier: Apache-2.0
// See cloud.h. Where clouds stand, the laws between their keys, and what their types bring.
// in: settings -> out: sizes, places, boxes; faults. docs/generators.md, "Place and size"
#include <algorithm>
#include <cmath>
#include <limits>

#include "src/base/number_text.h"
#include "src/scene/above_ground.h"
#include "src/scene/checks/check_keys.h"
#include "src/scene/media/cloud_types.h"
#include "src/world/density/cloud.h"

namespace pileus {
namespace {

/// What layers do not have.
constexpr const char* kHeapKeys[] = {"radius_m", "outline", "wind_deg"};
/// What lenses do not have either.
constexpr const char* kTurretKeys[] = {
    "turrets", "tall",  "slimness",   "dilution", "entrainment_per_km",
    "age",     "age_s", "lifetime_s", "anvil",    "shelf"};

// Of layers and fields: how far the box reaches over the base and under it, in heights.
constexpr double kLayerOver = 1.2, kLayerUnder = 0.08;
/// Mean cosine of ice crystals in visible light: Heymsfield and Platt 1984; Macke et al. 1996.
constexpr double kIceCosine = 0.78;

/// Largest height at which [low, high] of the cloud's heights fits [from, to] around `at`.
double fitting(double low, double high, double from, double to, double at) {
    double most = std::numeric_limits<double>::infinity();
    if (low < 0) most = std::min(most, (at - from) / -low);
    if (high > 0) most = std::min(most, (to - at) / high);
    return most;
}

/// The foot and the largest height within a box; what the scene leaves out is in the middle.
void fit_heap(const MediumSettings& medium, const CloudHeap& heap, CloudInGrid& place) {
    const auto& box = place.bounds_m;
    const Double3 &low = heap.extent[0], &high = heap.extent[1];
    // Over its rain it stands on its level, where the box holds that.
    const double base = place.cloud.base_m;
    const bool at_base = medium.cloud.base_m != kOfType ||
                         (place.cloud.rains() && base > box[0].z && base < box[1].z);
    const double under = place.cloud.rains() ? 0 : low.z;
    double most = at_base ? fitting(under, high.z, box[0].z, box[1].z, base)
                          : (box[1].z - box[0].z) / (high.z - low.z);
    for (int a = 0; a < 2; ++a)
        most = std::min(most, medium.cloud.has_place()
                                  ? fitting(low[a], high[a], box[0][a], box[1][a],
                                            medium.cloud.position_m[std::size_t(a)])
                                  : (box[1][a] - box[0][a]) / (high[a] - low[a]));
    place.allowed_m = most;
    if (medium.cloud.height_m == kOfType && medium.cloud.radius_m == kOfType) {
        place.cloud.radius_m *= most / place.cloud.height_m;
        place.cloud.height_m = most;
    }
    const double h = place.cloud.height_m;
    place.foot_m.z = at_base ? base : box[0].z - low.z * h;
    for (int a = 0; a < 2; ++a)
        place.foot_m[a] = medium.cloud.has_place()
                              ? medium.cloud.position_m[std::size_t(a)]
                              : 0.5 * (box[0][a] + box[1][a] - (low[a] + high[a]) * h);
}

/// A layer or a field fills its box; what the scene leaves out is the type's where that fits.
void fit_layer(const MediumSettings& medium, CloudForm form, CloudInGrid& place) {
    CloudSettings& cloud = place.cloud;
    const auto& box = place.bounds_m;
    const double room = (box[1].z - box[0].z) / (kLayerOver + kLayerUnder);
    place.allowed_m = room;
    if (medium.cloud.height_m == kOfType) cloud.height_m = std::min(cloud.height_m, room);
    const double over = kLayerOver * cloud.height_m, under = kLayerUnder * cloud.height_m;
    const bool within = cloud.base_m >= box[0].z && cloud.base_m + over <= box[1].z * (1 + 1e-9);
    if (medium.cloud.base_m == kOfType && !within) cloud.base_m = box[0].z + under;
    if (form == CloudForm::kGround) cloud.base_m = box[0].z;
    if (medium.cloud.base_m != kOfType && !within) place.allowed_m = 0;
    place.foot_m = {0.5 * (box[0].x + box[1].x), 0.5 * (box[0].y + box[1].y), cloud.base_m};
}

/// The floor of a box that the scene does not give: rain falls to the ground, of which is not known
/// here where it lies.
double floor_of(const CloudSettings& cloud, double lowest) {
    return cloud.rains() ? std::min(lowest, 0.0) : lowest;
}

/// The box of a layer or a field that the scene gives none.
void box_layer(const MediumSettings& medium, CloudForm form, CloudInGrid& place) {
    const CloudSettings& cloud = place.cloud;
    const bool placed = medium.cloud.has_place();
    const double x = placed ? medium.cloud.position_m[0] : 0.0;
    const double y = placed ? medium.cloud.position_m[1] : 0.0;
    const double half = form == CloudForm::kField     ? 5 * cloud.radius_m
                        : form == CloudForm::kStreaks ? 10 * cloud.cell_m
                                                      : 3 * cloud.cell_m;
    const double under = form == CloudForm::kGround ? 0 : kLayerUnder * cloud.height_m;
    place.bounds_m = {Double3{x - half, y - half, floor_of(cloud, cloud.base_m - under)},
                      Double3{x + half, y + half, cloud.base_m + kLayerOver * cloud.height_m}};
}

}  // namespace

bool fits(const CloudInGrid& place) {
    // What sums of doubles round is no fault.
    return place.cloud.height_m <= place.allowed_m * (1 + 1e-9) && place.cloud.height_m > 0;
}

/// Laws between its own keys, and what the type brings.
void check_cloud(SceneCheck& check, std::size_t index) {
    MediumSettings& medium = check.scene.media[index];
    const std::string path = "medium." + std::to_string(index) + ".";
    const auto fault = [&](const char* key, const std::string& text) {
        const Node* node = check.key(path + "cloud." + key);
        if (node == nullptr) node = check.key(path + "bounds_m");
        if (node == nullptr) node = check.key(path + "density");
        check.faults.add(node->at, path + "cloud." + key, text);
    };
    const bool boxed = check.valid_key(path + "bounds_m") != nullptr;
    if (!boxed && (check.key(path + "bounds_m") != nullptr || !check.written)) {
        // Of a struct, or with a fault of its own.
        if (check.lacks(path + "bounds_m"))
            check.faults.add(check.key(path + "density")->at, path + "bounds_m",
                             "missing, nothing, allowed: the box of the cloud");
        return;
    }
    CloudHeap heap;
    CloudInGrid place;
    const Status placed = place_cloud(medium, heap, place);
    if (!placed) {
        fault("type", placed.message);
        return;
    }
    if (!fits(place)) {
        const bool by_radius = medium.cloud.height_m == kOfType && medium.cloud.radius_m != kOfType;
        const double asked = by_radius ? place.cloud.radius_m : place.cloud.height_m;
        const double most = place.allowed_m * asked / place.cloud.height_m;
        if (most > 0)
            fault(by_radius ? "radius_m" : "height_m",
                  "does not fit bounds_m, " + number_text(asked) + ", allowed: at most " +
                      number_text(most) + " in this box, with what bends and lumps add");
        else
            fault(medium.cloud.has_place() ? "position_m" : "base_m",
                  "outside bounds_m, allowed: within the box");
        return;
    }
    const CloudType& type = cloud_type(medium.cloud.type);
    if (type.cover == 0 && check.valid_key(path + "cloud.cover") != nullptr)
        fault("cover", "for fields and layers only, allowed: left out");
    const bool streaks = type.form == CloudForm::kStreaks;
    if (type.cell_m == 0 && check.valid_key(path + "cloud.cell_m") != nullptr)
        fault("cell_m", "for layers only, allowed: left out");
    for (const char* key : kHeapKeys)
        if (type.cell_m > 0 && check.valid_key(path + "cloud." + key) != nullptr)
            fault(key, "for heaps, fields and lenses only, allowed: left out");
    const bool lens = type.form == CloudForm::kLens;
    for (const char* key : kTurretKeys)
        if ((type.cell_m > 0 || lens) && check.valid_key(path + "cloud." + key) != nullptr)
            fault(key, "for heaps and fields only, allowed: left out");
    if (check.valid_key(path + "cloud.age_s") != nullptr &&
        check.valid_key(path + "cloud.age") != nullptr)
        fault("age", "conflicts with age_s, by which a cloud ages, allowed: one of them");
    if (type.cell_m == 0 && !lens && check.valid_key(path + "cloud.lifetime_s") != nullptr &&
        check.lacks(path + "cloud.age_s"))
        fault("lifetime_s", "nothing lives without age_s, allowed: with age_s, or left out");
    if (!type.rains && check.valid_key(path + "cloud.rain") != nullptr)
        fault("rain", "for congestus, cumulonimbus and nimbostratus only, allowed: left out");
    if (!(place.cloud.anvil > 0) && check.valid_key(path + "cloud.mamma") != nullptr)
        fault("mamma", "for clouds with an anvil only, allowed: left out");
    if (((type.cell_m > 0 && !streaks) || lens) &&
        check.valid_key(path + "cloud.turn_deg") != nullptr)
        fault("turn_deg", "for heaps, fields and cirrus only, allowed: left out");
    if (!lens && check.valid_key(path + "cloud.plates") != nullptr)
        fault("plates", "for lenticularis only, allowed: left out");
    if ((lens || streaks) && check.valid_key(path + "cloud.erosion") != nullptr)
        fault("erosion", "for clouds with lumps only, allowed: left out");
    if (type.cell_m > 0 && !streaks && check.valid_key(path + "cloud.shear") != nullptr)
        fault("shear", "for heaps, fields, lenses and cirrus only, allowed: left out");
    if (type.cell_m > 0 && boxed && check.valid_key(path + "cloud.position_m") != nullptr)
        fault("position_m", "conflicts with bounds_m, which a layer fills, allowed: left out");
    if (!boxed) {
        medium.box.has_bounds = true;
        medium.box.bounds_m = place.bounds_m;
        const Ground& ground = check.scene.ground;
        // Rain falls to the ground.
        double& floor = medium.box.bounds_m[0].z;
        if (medium.cloud.rains() && ground.present && ground.altitude_m < place.foot_m.z)
            floor = ground.altitude_m;
        if (is_below_ground(ground, medium.box.bounds_m[0].z, 0))
            fault("base_m", below_ground_text(ground, medium.box.bounds_m[0].z, 0));
    }
    if (check.written && check.key(path + "extinction_per_m") == nullptr &&
        medium.optics.transfer.empty())
        medium.optics.extinction_per_m = type.extinction_per_m > 0
                                             ? type.extinction_per_m
                                             : cloud_extinction_per_m(place.cloud.height_m);
    if (check.written && check.key(path + "phase") == nullptr) {
        const double radius = type.effective_radius_um;
        medium.optics.phase.type = radius < 0 ? "henyey-greenstein" : "cloud";
        if (radius < 0)
            medium.optics.phase.numbers["g"] = kIceCosine;
        else
            medium.optics.phase.numbers["effective_radius_um"] =
                radius > 0 ? radius : cloud_radius_um(place.cloud.height_m);
    }
}

Status place_cloud(const MediumSettings& medium, CloudHeap& heap, CloudInGrid& place) {
    place.cloud = resolved_cloud(medium.cloud);
    const CloudForm form = cloud_type(medium.cloud.type).form;
    if (medium.box.has_bounds) place.bounds_m = medium.box.bounds_m;
    if (form != CloudForm::kHeap && form != CloudForm::kLens) {
        if (!medium.box.has_bounds) box_layer(medium, form, place);
        fit_layer(medium, form, place);
        place.full_m = place.cloud.height_m;
        return Status::ok();
    }
    if (form == CloudForm::kLens)
        heap.extent = lens_extent(place.cloud);
    else
        PILEUS_TRY(grow_cloud(place.cloud, heap));
    if (medium.box.has_bounds) {
        fit_heap(medium, heap, place);
        place.full_m = place.cloud.height_m;
        return Status::ok();
    }
    const double h = place.full_m = place.allowed_m = place.cloud.height_m;
    const bool placed = medium.cloud.has_place();
    place.foot_m = {placed ? medium.cloud.position_m[0] : 0.0,
                    placed ? medium.cloud.position_m[1] : 0.0, place.cloud.base_m};
    place.bounds_m = {place.foot_m + heap.extent[0] * h, place.foot_m + heap.extent[1] * h};
    place.bounds_m[0].z = floor_of(place.cloud, place.bounds_m[0].z);
    return Status::ok();
}

std::array<int, 3> default_cloud_size(const MediumSettings& medium) {
    const CloudForm form = cloud_type(medium.cloud.type).form;
    const bool wide = cloud_type(medium.cloud.type).anvil > 0;
    const bool lens = form == CloudForm::kLens;
    const double cells = lens                                ? 320
                         : form == CloudForm::kHeap && !wide ? 256
                         : wide || form == CloudForm::kField ? 384
                                                             : 448;
    const auto& box = medium.box.bounds_m;
    double longest = 0;
    for (int a = 0; a < 3; ++a) longest = std::max(longest, box[1][a] - box[0][a]);
    // Lenses are flat, and their rims thin.
    std::array<int, 3> size{3, 3, lens ? 96 : 24};
    for (int a = 0; a < 3 && longest > 0; ++a)
        size[std::size_t(a)] = std::max(
            size[std::size_t(a)], int(std::ceil(cells * (box[1][a] - box[0][a]) / longest - 1e-9)));
    return size;
}

}  // namespace pileus
