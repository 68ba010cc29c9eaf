// SPDX-License-Identifier: Apache-2.0
// Clear air around a round earth, as a scene asks for it.
// in: keys of [atmosphere] -> out: plain values.
// docs/atmosphere.md
#pragma once
#include <string>

namespace pileus {

struct AtmosphereSettings {
    bool present = false;
    std::string date;            ///< "2026-06-21"; empty: [sun] says where the sun stands
    std::string time = "12:00";  ///< of the clock at utc_offset_h
    double utc_offset_h = 0;     ///< hours that clock is ahead of universal time
    double latitude_deg = 0, longitude_deg = 0;
    double turbidity = 2;        ///< of air and haze over that of air; [1, 10]
    double ground_albedo = 0.2;  ///< of the round earth where there is no [ground]
    bool refraction = true;      ///< lifts the sun of a date
    bool sun_disc = true;        ///< the sun itself is seen in the sky
};

}  // namespace pileus
