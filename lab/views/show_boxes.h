// SPDX-License-Identifier: Apache-2.0
// Leaves as boxes in space: their edges, and their outline where a plane cuts them.
// in: leaves in voxels -> out: pairs of points in metres, box-local.
// docs/how-it-works.md
#pragma once
#include "lab/views/show_volume.h"

namespace pileus {

/// Metres, box-local.
struct Box {
    double low[3], high[3];
};

inline Box box_of(const Leaf& leaf, const Grid& grid) {
    Box b;
    for (int a = 0; a < 3; ++a) {
        b.low[a] = leaf.lo[a] * double(grid.cell_m[a]);
        b.high[a] = leaf.hi[a] * double(grid.cell_m[a]);
    }
    return b;
}

/// Corner `i` of a box: bit a of i chooses its side across axis a.
inline void corner_of(const Box& box, int i, double (&at)[3]) {
    for (int a = 0; a < 3; ++a) at[a] = ((i >> a) & 1) != 0 ? box.high[a] : box.low[a];
}

/// Calls edge(a, b) for the twelve edges.
template <class Edge>
void for_edges(const Box& box, Edge edge) {
    for (int axis = 0; axis < 3; ++axis)
        for (int i = 0; i < 8; ++i) {
            if (((i >> axis) & 1) != 0) continue;
            double a[3], b[3];
            corner_of(box, i, a);
            corner_of(box, i | (1 << axis), b);
            edge(a, b);
        }
}

/// The outline of the box's cut with a plane: a line on each face that the plane crosses.
template <class Edge>
void for_section(const Box& box, const MiddlePlane& plane, Edge edge) {
    const auto height = [&](const double(&p)[3]) {
        return plane.normal[0] * p[0] + plane.normal[1] * p[1] + plane.normal[2] * p[2] -
               plane.offset;
    };
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side) {
            // Go round the face; its outline crosses the plane twice or not at all.
            const int u = 1 << ((axis + 1) % 3), v = 1 << ((axis + 2) % 3), f = side << axis;
            const int around[5] = {f, f | u, f | u | v, f | v, f};
            double found[2][3];
            int count = 0;
            for (int i = 0; i < 4 && count < 2; ++i) {
                double a[3], b[3];
                corner_of(box, around[i], a);
                corner_of(box, around[i + 1], b);
                const double ha = height(a), hb = height(b);
                if ((ha < 0) == (hb < 0)) continue;
                const double t = ha / (ha - hb);
                for (int k = 0; k < 3; ++k) found[count][k] = a[k] + (b[k] - a[k]) * t;
                ++count;
            }
            if (count == 2) edge(found[0], found[1]);
        }
}

}  // namespace pileus
