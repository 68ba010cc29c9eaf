// SPDX-License-Identifier: Apache-2.0
// See plan.h.
#include "src/plan/plan.h"

namespace pileus {
namespace {

double quanta(double largest, int places) {
    // Half a quantum of rounding per deposit belongs to the bound.
    return largest * double(std::uint64_t{1} << places) + 0.5;
}

}  // namespace

int fixed_point_places(double deposits, double largest) {
    const double many = deposits < 1 ? 1 : deposits;
    for (int s = 30; s >= 8; --s) {
        const double one = quanta(largest, s);
        if (one < 2147483520.0 && one * many < 4.6e18) return s;
    }
    return -1;
}

SumBound deposit_bound(const char* sum, double deposits, double largest, int places) {
    SumBound bound;
    bound.sum = sum;
    bound.addends = deposits;
    bound.largest = largest;
    bound.places = places;
    bound.worst = deposits * quanta(largest, places);
    return bound;
}

}  // namespace pileus
