// SPDX-License-Identifier: Apache-2.0
// See lane_floor.h. Chooses the floors compiled with the same flags as a kernel table.
// in: the table's name, PILEUS_HAVE_<ISA> from the build -> out: a table or null.
#include "tools/bench/lane_floor.h"

#include <cstring>

namespace bench {

extern const LaneFloors lane_floors_scalar;
#ifdef PILEUS_HAVE_VEC4
extern const LaneFloors lane_floors_vec4;
#endif
#ifdef PILEUS_HAVE_SSE2
extern const LaneFloors lane_floors_sse2;
#endif
#ifdef PILEUS_HAVE_AVX2
extern const LaneFloors lane_floors_avx2;
#endif
#ifdef PILEUS_HAVE_AVX512
extern const LaneFloors lane_floors_avx512;
#endif

const LaneFloors* lane_floors(const char* isa) {
    if (std::strcmp(isa, "scalar") == 0) return &lane_floors_scalar;
#ifdef PILEUS_HAVE_VEC4
    if (std::strcmp(isa, "vec4") == 0) return &lane_floors_vec4;
#endif
#ifdef PILEUS_HAVE_SSE2
    if (std::strcmp(isa, "sse2") == 0) return &lane_floors_sse2;
#endif
#ifdef PILEUS_HAVE_AVX2
    if (std::strcmp(isa, "avx2") == 0) return &lane_floors_avx2;
#endif
#ifdef PILEUS_HAVE_AVX512
    if (std::strcmp(isa, "avx512") == 0) return &lane_floors_avx512;
#endif
    return nullptr;
}

}  // namespace bench
