// SPDX-License-Identifier: Apache-2.0
// What a flight library never has, told to compilers, so that nothing of it is linked.
// in: PILEUS_FLIGHT -> out: constants. docs/flight.md, "Build"
#pragma once

namespace pileus {

#ifdef PILEUS_FLIGHT
constexpr bool kFlight = true;
#else
constexpr bool kFlight = false;
#endif

constexpr bool kDevices = !kFlight;  ///< whole launches on another processor
constexpr bool kMeshes = !kFlight;   ///< solid things but a host's images of depth
constexpr bool kFilms = !kFlight;    ///< pictures and layers of files

/// A function of files' pictures in a table; in a flight library nothing refers to it.
template <class Function>
constexpr Function* of_films(Function* function) {
    return kFilms ? function : nullptr;
}

}  // namespace pileus
