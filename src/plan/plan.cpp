// SPDX-License-Identifier: Apache-2.0
// See plan.h.
#include "src/plan/plan.h"

namespace pileus {

int fixed_point_places(double deposits, double largest) {
    const double many = deposits < 1 ? 1 : deposits;
    for (int s = 30; s >= 8; --s) {
        const double quantum = double(std::uint64_t{1} << s);
        // Half a quantum of rounding per deposit belongs to the bound.
        const double one = largest * quantum + 0.5;
        if (one < 2147483520.0 && one * many < 4.6e18) return s;
    }
    return -1;
}

}  // namespace pileus
