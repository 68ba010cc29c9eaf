// SPDX-License-Identifier: Apache-2.0
// Normals of light on smooth solids, between those of a triangle's corners.
// in: a place on a triangle, the ray that met it -> out: a unit normal on the ray's side.
// Phong 1975, "Illumination for computer generated pictures"; docs/solids.md, "Smooth normals".
#pragma once
#include "kernels_cpu/core/vec.h"
#include "kernels_cpu/solids/solids_params.h"

namespace pileus {
inline namespace PILEUS_ISA {

PILEUS_FN std::int64_t whole_below(double v) {
    const auto i = std::int64_t(v);
    return double(i) > v ? i - 1 : i;
}

/// What part each corner has in a place on the triangle: areas seen along the longest axis of its
/// normal. Not negative, 1 in all, though the place lies beside the triangle by rounding; in a
/// periodic medium it may lie in another copy.
PILEUS_FN void corner_shares(const SolidsView& s, const SolidTriangle& t, const float (&at)[3],
                             float (&share)[3]) {
    int across = abs_(t.normal[0]) > abs_(t.normal[1]) ? 0 : 1;
    if (abs_(t.normal[2]) > abs_(t.normal[across])) across = 2;
    const int u = across == 2 ? 0 : across + 1, v = u == 2 ? 0 : u + 1;
    double place[3];
    for (int a = 0; a < 3; ++a) {
        place[a] = double(at[a]);
        if (a == 2 || !(s.period[a] > 0)) continue;
        const double period = double(s.period[a]);
        const double copy = (place[a] - double(t.corner[0][a])) / period + 0.5;
        place[a] -= double(whole_below(copy)) * period;
    }
    double x[3], y[3], area[3], sum = 0;
    for (int i = 0; i < 3; ++i)
        x[i] = double(t.corner[i][u]) - place[u], y[i] = double(t.corner[i][v]) - place[v];
    for (int i = 0; i < 3; ++i) {
        const int j = i == 2 ? 0 : i + 1, k = j == 2 ? 0 : j + 1;
        area[i] = x[j] * y[k] - x[k] * y[j];
        sum += area[i];
    }
    double all = 0;
    for (double& a : area) {
        a = a * sum > 0 ? a / sum : 0;
        all += a;
    }
    for (int i = 0; i < 3; ++i) share[i] = all > 0 ? float(area[i] / all) : 1.0f / 3.0f;
}

/// The normal of light at `at`, where a ray along `d` has met the triangle on its `side` of the
/// normal, -1 or 1. One that faces away from where the ray came from is turned until it is seen
/// edge on. `normal`, the triangle's own, stays where nothing is left of it.
PILEUS_FN void smooth_normal(const SolidsView& s, const SolidTriangle& t, const float (&at)[3],
                             const float (&d)[3], float side, float (&normal)[3]) {
    float share[3], n[3], away = 0, square = 0;
    corner_shares(s, t, at, share);
    const float* corner = s.normals + 9 * (std::int64_t(t.smooth) - 1);
    for (int a = 0; a < 3; ++a) {
        n[a] = side * (share[0] * corner[a] + share[1] * corner[3 + a] + share[2] * corner[6 + a]);
        away += n[a] * d[a];
    }
    for (int a = 0; a < 3; ++a) {
        if (away > 0.0f) n[a] -= away * d[a];
        square += n[a] * n[a];
    }
    if (!(square > 1e-8f)) return;
    const float unit = 1.0f / sqrt_(square);
    for (int a = 0; a < 3; ++a) normal[a] = n[a] * unit;
}

}  // namespace PILEUS_ISA
}  // namespace pileus
