// SPDX-License-Identifier: Apache-2.0
// What a flight library may be configured without, so that nothing of it is linked.
// in: PILEUS_WITHOUT_LIGHTS, PILEUS_WITHOUT_ATMOSPHERE -> out: constants. docs/flight.md, "Build"
#pragma once

namespace pileus {

// Of such a library no scene with it is opened, cmake/PileusFlight.cmake.
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

}  // namespace pileus
