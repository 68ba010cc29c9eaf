// SPDX-License-Identifier: Apache-2.0
// What lamps light where a ray ends: a solid, land or a sea.
// in: rays, the depth at which they end -> out: place, normal, albedo, facets of water.
// docs/lights.md, "By marching"; docs/ground.md
#pragma once
#include "kernels_cpu/display/march_ray.h"
#include "kernels_cpu/light/ground.h"
#include "kernels_cpu/raymarch/lamp_march_params.h"
#include "kernels_cpu/solids/solids.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// What a ray ends at: the ground, or a solid before it.
template <class T>
struct LampSurface {
    M_of<T> met, water;
    Vec<T> at, normal;
    T albedo[3];
    Vec<T> from;  // of water: where it is seen from, its facets, what of them is seen
    SeaPlace<T> facets;
    T seen;
};

/// Albedos of a painted ground in place of the grey one.
template <class T>
PILEUS_FN void paint_lit_ground(const LampMarchParams& k, const Ray<T>& ray, T opaque,
                                LampSurface<T>& s) {
    const T rise = max_(T{} - ray.direction.z, T{});
    const T way = k.camera.orthographic != 0 ? all<T>(1.0f) : select(s.met, opaque, T{});
    const T metres = pixel_on_ground(k.paint, way, rise);
    T share[3], enters = all<T>(1.0f);
    ground_share(k.paint, s.at, map_level(k.paint, metres), share);
    if (k.paint.sea != nullptr) {
        s.water = s.met;
        s.from = {T{} - ray.direction.x, T{} - ray.direction.y, rise};
        s.facets = sea_place(*k.paint.sea, k.paint.waves, s.at, metres, rise);
        s.seen = sea_sight(*k.paint.sea, s.facets, s.from).seen;
        enters = 1.0f - sea_reflects(*k.paint.sea, rise);
    }
    for (int c = 0; c < 3; ++c) s.albedo[c] = s.albedo[c] * share[c] * enters;
}

/// Of rays that end `opaque` metres away, unless a depth image has something nearer there.
template <class T>
PILEUS_FN LampSurface<T> lamp_surface(const LampMarchParams& k, const Ray<T>& ray, T opaque,
                                      M_of<T> real) {
    LampSurface<T> s{};
    const M_of<T> ends = real & (opaque < 3e38f);
    SolidHit<T> hit{};
    M_of<T> solid = ends & lnot(ends);
    if (has_meshes(k.solids) && any(ends)) {
        hit = hit_solids(k.solids, ray.origin, ray.direction, opaque * (1 + 1e-5f), ends);
        solid = ends & (hit.triangle >= 0);
    }
    const T height = ray.origin.z - k.ground_z;
    const T way = height / max_(T{} - ray.direction.z, all<T>(1e-18f));
    const M_of<T> open = ends & lnot(solid), there = abs_(opaque - way) <= way * 1e-4f;
    s.met = open & there & (ray.direction.z < 0.0f) & (height >= 0.0f);
    if (k.ground == 0) s.met = s.met & lnot(s.met);
    s.at = along(ray, select(s.met, opaque, T{}));
    s.at.z = all<T>(k.ground_z);
    s.normal.z = all<T>(1.0f);
    for (T& albedo : s.albedo) albedo = all<T>(k.ground_albedo);
    s.water = s.met & lnot(s.met);
    if (is_painted(k.paint) && any(s.met)) paint_lit_ground(k, ray, opaque, s);
    if (!any(solid)) return s;
    const SolidPlace<T> place = place_on_solid(k.solids, ray.origin, ray.direction, hit);
    const auto take = [&](T& own, T of_solid) { own = select(solid, of_solid, own); };
    take(s.at.x, place.at.x), take(s.at.y, place.at.y), take(s.at.z, place.at.z);
    take(s.normal.x, place.normal.x), take(s.normal.y, place.normal.y);
    take(s.normal.z, place.normal.z);
    for (int c = 0; c < 3; ++c) take(s.albedo[c], place.albedo[c]);
    s.met = s.met | solid;
    return s;
}

}  // namespace PILEUS_ISA
}  // namespace pileus
