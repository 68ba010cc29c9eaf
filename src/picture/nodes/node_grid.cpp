// SPDX-License-Identifier: Apache-2.0
// See node_grid.h.
#include "src/picture/nodes/node_grid.h"

namespace pileus {

NodeGrid make_node_grid(const Grid& grid, const double (&extent_m)[3], double spacing_m) {
    NodeGrid g{};
    for (int a = 0; a < 3; ++a) {
        const double wanted = spacing_m > 0 ? extent_m[a] / spacing_m + 0.5 : 1;
        int n = wanted > grid.size[a] ? grid.size[a] : int(wanted);
        if (n < 1) n = 1;
        g.size[a] = n;
        g.per_metre[a] = float(n / extent_m[a]);
    }
    return g;
}

NodeGrid make_half_grid(const Grid& grid, const double (&extent_m)[3]) {
    NodeGrid g{};
    for (int a = 0; a < 3; ++a) {
        g.size[a] = (grid.size[a] + 1) / 2;
        g.per_metre[a] = float(g.size[a] / extent_m[a]);
    }
    return g;
}

}  // namespace pileus
