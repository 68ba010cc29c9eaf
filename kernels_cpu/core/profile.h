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
constexpr bool kPlans = !kFlight;    ///< lists for people: what runs, why not, bytes, times
constexpr bool kMeters = !kFlight;   ///< fluxes through faces and into cells
constexpr bool kClouds = !kFlight;   ///< many clouds, and a picture taken over
constexpr bool kStops = !kFlight;    ///< a host that ends work before it is done
constexpr bool kChecks = !kFlight;   ///< of scenes: a packed one was checked when it was packed

// What a flight library may be configured without, cmake/PileusFlight.cmake; then no scene with it
// is opened.
#ifdef PILEUS_WITHOUT_LIGHTS
constexpr bool kLights = false;  ///< [[light]], and media that emit
#else
constexpr bool kLights = true;
#endif
#ifdef PILEUS_WITHOUT_ATMOSPHERE
constexpr bool kAtmosphere = false;  ///< clear air
#else
constexpr bool kAtmosphere = true;
#endif

/// A function for a table, or null in a library without what it is for: nothing refers to it then.
template <class Function>
constexpr Function* kept(bool here, Function* function) {
    return here ? function : nullptr;
}

}  // namespace pileus
