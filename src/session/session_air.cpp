// SPDX-License-Identifier: Apache-2.0
// The clock and the haze of a session whose scene has air.
// in: hours after the scene's date, a turbidity -> out: sun, moon and stars, tables of the air.
// docs/whole-sky.md
#include "kernels_cpu/core/profile.h"
#include "src/session/session.h"
#include "src/world/atmosphere/atmosphere.h"

namespace pileus {
namespace {

constexpr const char* kSealed =
    "atmosphere: another than when the flight was opened, allowed: what it had";

}  // namespace

Status Session::set_hours(double hours, const Sun& sun) {
    const AtmosphereSettings& air = scene_.atmosphere;
    if (!kAtmosphere || !air.present || air.date.empty())
        return Status::bad_input("hours: of a scene without a date, allowed: atmosphere.date");
    if (seal_.on) return Status::bad_input(kSealed);
    Sun placed = sun;
    place_sun(air, hours, placed);
    place_night(air, hours, host_.night);
    changed_.stale = true;
    return set_sun(placed);
}

Status Session::set_turbidity(double turbidity) {
    if (!kAtmosphere || !scene_.atmosphere.present)
        return Status::bad_input("turbidity: no air, allowed: a scene with [atmosphere]");
    if (!(turbidity >= 1 && turbidity <= 10))
        return Status::bad_input("turbidity: out of range, allowed: 1 to 10");
    if (turbidity == scene_.atmosphere.turbidity) return Status::ok();
    if (seal_.on) return Status::bad_input(kSealed);
    scene_.atmosphere.turbidity = turbidity;
    changed_.stale = true;
    return relight_air();
}

}  // namespace pileus
