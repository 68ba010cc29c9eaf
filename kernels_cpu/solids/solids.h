// SPDX-License-Identifier: Apache-2.0
// Rays against solid things: the nearest hit, or whether anything is in the way.
// in: rays -> out: distance and triangle; the same whatever the tree looks like.
// Woop, Benthin, Wald 2013, "Watertight ray/triangle intersection"; docs/solids.md.
// Rays of different lanes part ways at once: each walks the tree alone.
#pragma once
#include "kernels_cpu/core/meshes.h"
#include "kernels_cpu/core/vec.h"
#include "kernels_cpu/solids/smooth_normal.h"
#include "kernels_cpu/solids/solids_params.h"

#if defined(__CUDACC__)
#define PILEUS_CALLED [[maybe_unused]] __host__ __device__ static
#else
#define PILEUS_CALLED [[gnu::noinline, maybe_unused]] static
#endif

namespace pileus {
inline namespace PILEUS_ISA {

/// A ray made ready for boxes and triangles.
struct SolidRay {
    float o[3], d[3], inverse[3];
    float pad;         // more than rounding can move a hit sideways
    int kx, ky, kz;    // kz: the longest axis of d
    float sx, sy, sz;  // the shear that makes d its unit vector
};

PILEUS_FN float larger(float a, float b) { return a > b ? a : b; }
PILEUS_FN float smaller(float a, float b) { return a < b ? a : b; }

/// What rounding is held against: how far away the farthest corner of all lies, times 2^-21.
PILEUS_FN float solid_pad(const SolidNode& all, const float (&o)[3]) {
    float far = 0;
    for (int a = 0; a < 3; ++a)
        far = larger(far, larger(abs_(all.low[a] - o[a]), abs_(all.high[a] - o[a])));
    return far * 0x1p-21f;
}

PILEUS_FN SolidRay solid_ray(const SolidsView& s, const float (&o)[3], const float (&d)[3]) {
    SolidRay r{};
    for (int a = 0; a < 3; ++a) {
        r.o[a] = o[a], r.d[a] = d[a];
        r.inverse[a] = 1.0f / copysign_(larger(abs_(d[a]), 1e-18f), d[a]);
    }
    r.kz = abs_(d[0]) > abs_(d[1]) ? 0 : 1;
    if (abs_(d[2]) > abs_(d[r.kz])) r.kz = 2;
    r.kx = r.kz == 2 ? 0 : r.kz + 1;
    r.ky = r.kx == 2 ? 0 : r.kx + 1;
    r.sx = d[r.kx] / d[r.kz], r.sy = d[r.ky] / d[r.kz], r.sz = 1.0f / d[r.kz];
    r.pad = solid_pad(s.nodes[0], r.o);
    return r;
}

/// Whether the ray meets the box, widened by its pad, before `limit`; never wrong about a hit.
PILEUS_FN bool meets_box(const SolidNode& n, const SolidRay& r, float limit, float& from) {
    float near = 0, far = limit;
    for (int a = 0; a < 3; ++a) {
        const float low = ((n.low[a] - r.pad) - r.o[a]) * r.inverse[a];
        const float high = ((n.high[a] + r.pad) - r.o[a]) * r.inverse[a];
        near = larger(near, smaller(low, high));
        far = smaller(far, larger(low, high));
    }
    from = near;
    return near <= far * (1.0f + 0x1p-20f);
}

/// Metres to the triangle, or below 0: edges that two triangles share belong to at least one.
PILEUS_FN float meets_triangle(const SolidTriangle& t, const SolidRay& r) {
    float x[3], y[3], z[3];
    for (int i = 0; i < 3; ++i) {
        const float* c = t.corner[i];
        z[i] = c[r.kz] - r.o[r.kz];
        x[i] = (c[r.kx] - r.o[r.kx]) - r.sx * z[i];
        y[i] = (c[r.ky] - r.o[r.ky]) - r.sy * z[i];
    }
    float u = x[2] * y[1] - y[2] * x[1];
    float v = x[0] * y[2] - y[0] * x[2];
    float w = x[1] * y[0] - y[1] * x[0];
    if (u == 0.0f || v == 0.0f || w == 0.0f) {
        // On an edge, or too close to tell: products of floats are exact in double.
        u = float(double(x[2]) * double(y[1]) - double(y[2]) * double(x[1]));
        v = float(double(x[0]) * double(y[2]) - double(y[0]) * double(x[2]));
        w = float(double(x[1]) * double(y[0]) - double(y[1]) * double(x[0]));
    }
    if ((u < 0.0f || v < 0.0f || w < 0.0f) && (u > 0.0f || v > 0.0f || w > 0.0f)) return -1.0f;
    const float sum = u + v + w;
    if (sum == 0.0f) return -1.0f;
    const float distance = (u * z[0] + v * z[1] + w * z[2]) * r.sz / sum;
    return distance > 0.0f ? distance : -1.0f;  // no number is no hit
}

/// The nearest triangle before `limit`, of equals the first by number; -1: none. `any`: the first
/// found will do.
PILEUS_FN std::int32_t solid_walk(const SolidsView& s, const SolidRay& r, float limit, bool any_hit,
                                  float& distance) {
    std::int32_t stack[kSolidDepth], found = -1;
    int depth = 0;
    float from = 0;
    distance = limit;
    if (!meets_box(s.nodes[0], r, distance, from)) return -1;
    std::int32_t at = 0;
    for (;;) {
        const SolidNode& n = s.nodes[at];
        for (std::int32_t i = n.next; i < n.next + n.count; ++i) {
            const float t = meets_triangle(s.triangles[i], r);
            if (t < 0.0f || t > distance || (t == distance && found < 0)) continue;
            if (t == distance && s.triangles[i].number > s.triangles[found].number) continue;
            distance = t, found = i;
            if (any_hit) return found;
        }
        if (n.count <= 0) {
            // The nearer child first, by the side that the ray comes from.
            const bool turned = r.d[-n.count] < 0.0f;
            const std::int32_t first = turned ? n.next : at + 1, second = turned ? at + 1 : n.next;
            const bool one = meets_box(s.nodes[first], r, distance, from);
            if (meets_box(s.nodes[second], r, distance, from)) stack[depth++] = second;
            if (one) {
                at = first;
                continue;
            }
        }
        // What a hit has hidden meanwhile is left out by the same test again.
        do {
            if (depth == 0) return found;
            at = stack[--depth];
        } while (!meets_box(s.nodes[at], r, distance, from));
    }
}

/// A ray's way through repetitions that lie side by side, each in a cell of its own.
struct SolidCells {
    double low[2], period[2], from[2], along[2];
    std::int64_t cell[2];
};

/// Metres along the ray to the next cell, and the axis of the face between.
PILEUS_FN double next_solid_cell(const SolidCells& c, int& axis) {
    double nearest = 1e300;
    for (int a = 0; a < 2; ++a) {
        if (abs_(float(c.along[a])) < 1e-18f) continue;
        const double face = c.low[a] + double(c.cell[a] + (c.along[a] > 0 ? 1 : 0)) * c.period[a];
        const double way = (face - c.from[a]) / c.along[a];
        if (way < nearest) nearest = way, axis = a;
    }
    return nearest;
}

/// What of the ray lies between the lowest and the highest of all triangles, metres.
PILEUS_FN bool within_solid_layer(const SolidNode& all, const SolidRay& r, float& near,
                                  float& far) {
    const float low = ((all.low[2] - r.pad) - r.o[2]) * r.inverse[2];
    const float high = ((all.high[2] + r.pad) - r.o[2]) * r.inverse[2];
    near = larger(near, smaller(low, high));
    far = smaller(far, larger(low, high));
    return near <= far;
}

/// solid_walk through repetitions: each is met by the ray moved back into the first, from shortly
/// before its cell, so that it is as exact there as here.
PILEUS_FN std::int32_t solid_copies(const SolidsView& s, const float (&o)[3], const float (&d)[3],
                                    float limit, bool any_hit, float& distance) {
    const SolidNode& all = s.nodes[0];
    float near = 0, far = limit;
    distance = limit;
    if (!within_solid_layer(all, solid_ray(s, o, d), near, far)) return -1;
    SolidCells c{};
    double at = double(near);
    for (int a = 0; a < 2; ++a) {
        c.low[a] = double(all.low[a]), c.period[a] = double(s.period[a]);
        c.from[a] = double(o[a]), c.along[a] = double(d[a]);
        const double place = (c.from[a] + c.along[a] * at - c.low[a]) / c.period[a];
        // Farther away than floats can tell places apart nothing is looked for.
        if (!(abs_(float(place)) < 0x1p40f)) return -1;
        c.cell[a] = whole_below(place);
    }
    const double before = 0x1p-10 * (c.period[0] < c.period[1] ? c.period[0] : c.period[1]);
    for (int n = 0; n < kMaxSolidCopies && at <= double(far); ++n) {
        const double start = at > before ? at - before : 0.0;
        float from[3];
        for (int a = 0; a < 2; ++a)
            from[a] = float(c.from[a] + c.along[a] * start - double(c.cell[a]) * c.period[a]);
        from[2] = float(double(o[2]) + double(d[2]) * start);
        float way = 0;
        const std::int32_t found =
            solid_walk(s, solid_ray(s, from, d), float(double(far) - start), any_hit, way);
        if (found >= 0) {
            distance = float(start + double(way));
            return found;
        }
        int axis = -1;
        at = next_solid_cell(c, axis);
        if (axis < 0) return -1;
        c.cell[axis] += c.along[axis] > 0 ? 1 : -1;
    }
    return -1;
}

PILEUS_CALLED std::int32_t nearest_solid(const SolidsView& s, const float (&o)[3],
                                         const float (&d)[3], float limit, float& distance) {
    if (s.period[0] > 0) return solid_copies(s, o, d, limit, false, distance);
    return solid_walk(s, solid_ray(s, o, d), limit, false, distance);
}
PILEUS_CALLED bool solid_between(const SolidsView& s, const float (&o)[3], const float (&d)[3],
                                 float limit) {
    float distance = 0;
    if (s.period[0] > 0) return solid_copies(s, o, d, limit, true, distance) >= 0;
    return solid_walk(s, solid_ray(s, o, d), limit, true, distance) >= 0;
}

/// Of each lane: metres to what it meets first, infinity without; which triangle, -1.
template <class T>
struct SolidHit {
    T distance;
    I_of<T> triangle;
};

template <class T>
PILEUS_FN SolidHit<T> hit_solids(const SolidsView& s, const Vec<T>& o, const Vec<T>& d, T limit,
                                 M_of<T> m) {
    SolidHit<T> hit{all<T>(__builtin_inff()), all<I_of<T>>(-1)};
    for (std::uint32_t lanes = has_meshes(s) ? bits_of(m) : 0u; lanes != 0; lanes &= lanes - 1) {
        const int i = lowest_bit(lanes);
        const float from[3] = {lane(o.x, i), lane(o.y, i), lane(o.z, i)};
        const float along[3] = {lane(d.x, i), lane(d.y, i), lane(d.z, i)};
        float distance = 0;
        const std::int32_t found = nearest_solid(s, from, along, lane(limit, i), distance);
        if (found < 0) continue;
        set_lane(hit.distance, i, distance);
        set_lane(hit.triangle, i, found);
    }
    return hit;
}

/// Lanes of `m` whose rays meet anything before `limit`.
template <class T>
PILEUS_FN M_of<T> behind_solids(const SolidsView& s, const Vec<T>& o, const Vec<T>& d, T limit,
                                M_of<T> m) {
    I_of<T> blocked{};
    for (std::uint32_t lanes = has_meshes(s) ? bits_of(m) : 0u; lanes != 0; lanes &= lanes - 1) {
        const int i = lowest_bit(lanes);
        const float from[3] = {lane(o.x, i), lane(o.y, i), lane(o.z, i)};
        const float along[3] = {lane(d.x, i), lane(d.y, i), lane(d.z, i)};
        set_lane(blocked, i, solid_between(s, from, along, lane(limit, i)) ? 1 : 0);
    }
    return blocked > 0;
}

/// Where rays met solids: a place just off the surface on their own side, and the normal there,
/// which on smooth ones is that of light.
template <class T>
struct SolidPlace {
    Vec<T> at, normal;
    T albedo[3];
};

/// `Smooth`: normals of smooth solids lie between those of their corners; else all are flat.
template <bool Smooth = true, class T>
PILEUS_FN SolidPlace<T> place_on_solid(const SolidsView& s, const Vec<T>& o, const Vec<T>& d,
                                       const SolidHit<T>& hit) {
    SolidPlace<T> p{};
    T distance{};
    for (int i = 0; i < width_of<T>; ++i) {
        const std::int32_t number = lane(hit.triangle, i);
        if (number < 0) continue;
        const SolidTriangle& t = s.triangles[number];
        set_lane(distance, i, lane(hit.distance, i));
        set_lane(p.normal.x, i, t.normal[0]);
        set_lane(p.normal.y, i, t.normal[1]);
        set_lane(p.normal.z, i, t.normal[2]);
        for (int c = 0; c < 3; ++c) set_lane(p.albedo[c], i, s.albedo[3 * t.colour + c]);
    }
    const T side = copysign_(all<T>(1.0f), T{} - dot(p.normal, d));
    p.normal = {p.normal.x * side, p.normal.y * side, p.normal.z * side};
    // Sixteen times what rounding takes: the next ray begins clear of the plane.
    const T far = max_(max_(abs_(o.x), abs_(o.y)), abs_(o.z)) + distance;
    const T lift = far * 0x1p-19f;
    p.at = {o.x + d.x * distance + p.normal.x * lift, o.y + d.y * distance + p.normal.y * lift,
            o.z + d.z * distance + p.normal.z * lift};
    if (!Smooth || s.normals == nullptr) return p;
    for (int i = 0; i < width_of<T>; ++i) {
        const std::int32_t number = lane(hit.triangle, i);
        if (number < 0 || s.triangles[number].smooth == 0) continue;
        const float way = lane(distance, i);
        const float along[3] = {lane(d.x, i), lane(d.y, i), lane(d.z, i)};
        const float at[3] = {lane(o.x, i) + along[0] * way, lane(o.y, i) + along[1] * way,
                             lane(o.z, i) + along[2] * way};
        float n[3] = {lane(p.normal.x, i), lane(p.normal.y, i), lane(p.normal.z, i)};
        smooth_normal(s, s.triangles[number], at, along, lane(side, i), n);
        set_lane(p.normal.x, i, n[0]), set_lane(p.normal.y, i, n[1]), set_lane(p.normal.z, i, n[2]);
    }
    return p;
}

}  // namespace PILEUS_ISA
}  // namespace pileus
