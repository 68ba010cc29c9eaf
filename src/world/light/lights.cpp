// SPDX-License-Identifier: Apache-2.0
// See lights.h.
#include "src/world/light/lights.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "kernels_cpu/light/sun_heights.h"
#include "src/base/angles.h"
#include "src/base/random_streams.h"
#include "src/world/solids/camera_depth.h"
#include "src/world/solids/solids.h"

namespace pileus {
namespace {

double magnitude(double v) { return v < 0 ? -v : v; }

/// Size of a colour whose channels may differ in sign: what its noise grows with.
double strength(const Double3& c) { return magnitude(c[0]) + magnitude(c[1]) + magnitude(c[2]); }

/// Area of one face across `axis` through which light enters: none beside a periodic medium.
double face_area(const Medium& m, int axis) {
    if (m.grid.periodic && axis < 2) return 0;
    return m.extent_m[(axis + 1) % 3] * m.extent_m[(axis + 2) % 3];
}

/// Turns the flux through each face into shares and their sum.
void set_faces(const double (&flux)[6], Light& light) {
    double total = 0, sum = 0;
    for (double f : flux) total += f;
    light.power_m2 = total;
    for (std::size_t f = 0; f < 6; ++f) {
        sum += flux[f];
        light.face_cdf[f] = total > 0 ? float(sum / total) : 1.0f;
    }
    light.face_cdf[5] = 1.0f;
}

bool any_positive(const Double3& c) { return c[0] > 0 || c[1] > 0 || c[2] > 0; }

/// Why the sun's light is none; null: it shines, or there is none.
const char* hidden_sun(const Shining& shining, const Medium& medium, const Double3& to_sun) {
    if (shining.ground.present && to_sun[2] <= 0) return "below the ground's horizon";
    if (medium.grid.periodic && to_sun[2] == 0)
        return "exactly at the horizon of a periodic medium: it meets no face";
    return nullptr;
}

void make_sun(const Shining& shining, const Medium& medium, const SunPlace& place, Lighting& out) {
    const Double3 to_sun = towards_deg(place.azimuth_deg, place.elevation_deg);
    for (std::size_t c = 0; c < 3; ++c) {
        out.to_sun[c] = float(to_sun[c]);
        if (shining.sun.present) out.sun_irradiance[c] = double(shining.sun.irradiance[c]);
    }
    out.sunlit = any_positive(out.sun_irradiance) && hidden_sun(shining, medium, to_sun) == nullptr;
    if (!out.sunlit) out.sun_irradiance = {};
    if (out.sunlit) out.sun_heights = shining.sun_heights;
}

/// Radiance of the unshadowed ground: albedo / pi times what falls on it.
void make_ground(const Shining& shining, const Medium& medium, const SkyMap* map,
                 double elevation_deg, Lighting& out) {
    out.ground.present = shining.ground.present;
    if (!out.ground.present) return;
    const double height = sincos_deg(elevation_deg).sine;
    out.ground.z = shining.ground.altitude_m - medium.low_m[2];
    const double own = shining.ground.albedo;
    GroundAlbedo albedo{own, own};
    GroundStand stand;
    if (shining.look != nullptr) {
        stand = stand_of(medium, *shining.placement, out.ground.z);
        albedo = ground_albedo(*shining.look, own, stand, height);
    }
    out.ground.albedo = albedo.even;
    Double3 sky = out.sky;
    if (map != nullptr) sky = map->ground_irradiance / kPi64;
    out.ground.diffuse = out.ground.albedo * sky;
    const Double3 sun = sun_at_height(out, out.ground.z);
    out.ground.beam = albedo.sun / kPi64 * out.sun_irradiance * height;
    out.ground.sun = albedo.sun / kPi64 * sun * height;
    if (shining.look == nullptr) return;
    out.ground.paint = make_paint(*shining.look, own, albedo, stand, shining.time_s);
    // Half of the media's height, where what is mirrored stands.
    out.ground.paint.mirror_m = float(std::max(stand.top_m - 0.5 * stand.extent_m[2], 0.0));
}

bool is_dark(const Medium& medium) { return medium.sigma <= 0 || medium.density_max <= 0; }

/// The cone in which photons of a point far off meet the box: all others are lost, but to a ground.
void aim_emission(const Medium& medium, bool ground, LampEmission& e) {
    Double3 way{};
    double reach = 0;
    for (int a = 0; a < 3; ++a) {
        way[a] = 0.5 * medium.extent_m[a] - double(e.lamp.at[a]);
        reach += 0.25 * medium.extent_m[a] * medium.extent_m[a];
    }
    const double distance = glm::length(way);
    e.span = 2;
    e.axis[2] = 1;
    // Wider by a hundredth, for rounding.
    const double sine = 1.01 * (__builtin_sqrt(reach) + double(e.lamp.radius)) / distance;
    if (ground || !(sine < 1)) return;
    // 1 - cosine without a difference of near numbers.
    // However far: 0 would be a spot.
    e.span = float(std::max(sine * sine / (1 + __builtin_sqrt(1 - sine * sine)), 1e-30));
    for (int a = 0; a < 3; ++a) e.axis[a] = float(way[a] / distance);
}

/// Flux of a lamp's photons, in its unit times m^2.
double power_of(const Medium& medium, bool ground, LampEmission& e) {
    const LampParams& lamp = e.lamp;
    if (lamp.parallel != 0) {
        const Light beam =
            beam_light(medium, {-double(lamp.at[0]), -double(lamp.at[1]), -double(lamp.at[2])});
        for (std::size_t f = 0; f < 6; ++f) e.face_cdf[f] = beam.face_cdf[f];
        return double(lamp.strength) * beam.power_m2;
    }
    if (lamp.edge < -1) {
        aim_emission(medium, ground, e);
        return double(lamp.strength) * 2 * kPi64 * double(e.span);
    }
    for (int a = 0; a < 3; ++a) e.axis[a] = lamp.axis[a];
    const double width = 1 / double(lamp.slope), inner = 1 - (double(lamp.edge) + width);
    return double(lamp.strength) * 2 * kPi64 * ((inner > 0 ? inner : 0) + 0.5 * width);
}

/// Radiance that parallel lamps give the unshadowed ground.
Double3 ground_of_lamps(const Lighting& light) {
    Double3 sum{};
    for (const LampParams& lamp : light.lamps) sum += ground_of_lamp(light, lamp);
    return sum;
}

/// The strongest lamps get axes of their own, in the lamps' order.
void give_axes(const std::vector<double>& power, std::vector<LampEmission>& lamps) {
    std::int32_t next = 0;
    for (std::size_t i = 0; i < power.size(); ++i) {
        int stronger = 0;
        for (std::size_t j = 0; j < power.size(); ++j)
            stronger += power[j] > power[i] || (power[j] == power[i] && j < i) ? 1 : 0;
        lamps[i].own_axis = stronger < kMaxLampAxes ? next++ : -1;
    }
}

/// Photons of all lamps.
Light lamp_light(const Medium& medium, Lighting& out) {
    Light light;
    light.lamps = true;
    light.face_cdf.fill(1.0f);
    out.lamp_emission.clear();
    std::vector<double> power;
    for (const LampParams& lamp : out.lamps) {
        LampEmission e{};
        e.lamp = lamp;
        power.push_back(power_of(medium, out.ground.present, e));
        light.power_m2 += power.back();
        out.lamp_emission.push_back(e);
    }
    double below = 0;
    for (std::size_t i = 0; i < power.size(); ++i) {
        out.lamp_emission[i].below = light.power_m2 > 0 ? float(below / light.power_m2) : 0;
        below += power[i];
    }
    give_axes(power, out.lamp_emission);
    return light;
}

void add_light(const char* name, std::uint32_t stream, const Double3& colour, Light light,
               Lighting& out) {
    light.name = name;
    light.stream = stream;
    light.colour = colour;
    out.lights.push_back(std::move(light));
}

}  // namespace

GroundStand stand_of(const Medium& medium, const Placement& placement, double ground_z) {
    GroundStand out;
    for (int a = 0; a < 3; ++a) {
        out.low_m[a] = medium.low_m[std::size_t(a)];
        out.extent_m[a] = medium.extent_m[std::size_t(a)];
    }
    out.placement = placement;
    out.top_m = std::max(medium.extent_m[2] - ground_z, 0.0);
    return out;
}

Light diffuse_light(const Medium& medium, int hemisphere) {
    Light light;
    light.hemisphere = hemisphere;
    double flux[6];
    for (int f = 0; f < 6; ++f) {
        // Half of what a side face receives comes from each hemisphere; the top face is reached
        // only by light that travels down, the bottom only by light that travels up.
        double share = hemisphere == 0 ? 1.0 : 0.5;
        if (f == 4 && hemisphere != 0) share = hemisphere > 0 ? 1.0 : 0.0;
        if (f == 5 && hemisphere != 0) share = hemisphere < 0 ? 1.0 : 0.0;
        flux[f] = kPi64 * share * face_area(medium, f / 2);
    }
    set_faces(flux, light);
    return light;
}

Light beam_light(const Medium& medium, const Double3& travel) {
    Light light;
    light.beam = true;
    double flux[6] = {};
    for (std::size_t a = 0; a < 3; ++a) {
        const double area = magnitude(travel[a]) * face_area(medium, int(a));
        flux[2 * a + (travel[a] > 0 ? 0 : 1)] = area;
        light.travel[a] = float(travel[a]);
    }
    set_faces(flux, light);
    return light;
}

Light map_light(const SkyMap& map) {
    Light light;
    light.map = true;
    light.colour = {1, 1, 1};
    light.power_m2 = map.power_m2;
    light.face_cdf.fill(1.0f);
    return light;
}

Light emission_light(const Medium& medium, std::size_t which) {
    const Emitter& emitter = medium.emitters[which];
    Light light;
    light.emitter = int(which);
    light.face_cdf.fill(1.0f);
    light.power_m2 = 4 * kPi64 * double(medium.sigma) * emitter.mass_m3;
    return light;
}

Lighting sun_alone(const Lighting& all) {
    Lighting sun = all;
    for (Light& light : sun.lights) {
        if (light.beam) continue;
        light.colour = light.map || light.hemisphere <= 0 ? Double3{} : all.ground.sun;
    }
    sun.constant = sun.sky = sun.ground.diffuse = sun.ground.lamps = {};
    sun.map = SkyMapView{};
    sun.lamps.clear();
    sun.lamp_spots.clear();
    return sun;
}

Double3 ground_of_lamp(const Lighting& light, const LampParams& lamp) {
    Double3 sum{};
    for (int c = 0; c < 3 && light.ground.present && lamp.parallel != 0; ++c)
        sum[c] = light.ground.albedo / kPi64 * double(lamp.light[c]) * double(lamp.at[2]);
    return sum;
}

Double3 sun_at_height(const Lighting& light, double z) {
    // Parts of the light without the sun have none at any height.
    const bool one = light.sun_heights.rows == 0 || light.sun_irradiance == Double3{};
    if (one) return light.sun_irradiance;
    Double3 sun{};
    for (int c = 0; c < 3; ++c) sun[c] = double(sun_at(light.sun_heights, float(z), c));
    return sun;
}

bool has_coloured_ground(const Lighting& light) {
    const GroundPaint& paint = light.ground.paint;
    const bool grey = paint.share[0] == paint.share[1] && paint.share[0] == paint.share[2];
    return light.ground.present && paint.on != 0 && (!grey || paint.map.planes == 3);
}

void set_one_sun(Lighting& light) {
    light.sun_heights = SunHeights{};
    light.ground.sun = light.ground.beam;
}

bool same_shine(const Lighting& a, const Lighting& b) {
    return a.sunlit == b.sunlit && a.sky == b.sky && a.sun_irradiance == b.sun_irradiance &&
           a.ground.present == b.ground.present && a.ground.z == b.ground.z &&
           a.ground.albedo == b.ground.albedo && same_lamps(a.lamps, b.lamps);
}

void share_photons(std::uint64_t per_generation, std::vector<Light>& lights) {
    double total = 0;
    for (const Light& l : lights) total += strength(l.colour) * l.power_m2;
    for (Light& l : lights) {
        const double power = strength(l.colour) * l.power_m2;
        const double share = total > 0 ? power / total : 1.0 / double(lights.size());
        l.photons = std::uint64_t(double(per_generation) * share + 0.5);
        if (l.photons == 0 && per_generation > 0) l.photons = 1;
    }
}

Lighting make_lighting(const Shining& shining, const Medium& medium, const SunPlace& place,
                       const SkyMap* map, const Solids* solids, const CameraDepth* depth) {
    Lighting out;
    if (solids != nullptr && solids->meshes) out.solids = solids;
    if (depth != nullptr && depth->present) out.depth = depth;
    const bool mapped = map != nullptr && map->present();
    if (mapped) out.map = map->view;
    make_sun(shining, medium, place, out);
    for (std::size_t c = 0; c < 3; ++c)
        if (shining.sky.present && !mapped) out.sky[c] = double(shining.sky.radiance[c]);
    make_ground(shining, medium, mapped ? map : nullptr, place.elevation_deg, out);
    if (!shining.lamps.empty()) out.lamps = make_lamps(shining.lamps, shining.ground, medium);
    for (const LampParams& lamp : out.lamps)
        out.lamp_spots.push_back(spot_on_ground(lamp, out, medium));
    out.ground.lamps = ground_of_lamps(out);
    if (is_dark(medium)) return out;
    if (out.sunlit) {
        const Light sun = beam_light(medium, -towards_deg(place.azimuth_deg, place.elevation_deg));
        add_light("sun", kSunStream, out.sun_irradiance, sun, out);
    }
    if (!out.lamps.empty())
        add_light("lights", kLampStream, {1, 1, 1}, lamp_light(medium, out), out);

    // A white medium in a uniform field shows that field everywhere, whatever its shape: take the
    // sky's radiance out as a constant, and light the cloud from below by what the ground's
    // radiance differs from it.
    const bool white = is_white(medium);
    Double3 below = out.ground.radiance();
    if (mapped && map->power_m2 > 0) {
        add_light("sky", kSkyStream, {1, 1, 1}, map_light(*map), out);
    } else if (white && any_positive(out.sky) && !shining.solids) {
        out.constant = out.sky;
        below -= out.sky;
    } else if (any_positive(out.sky)) {
        add_light("sky", kSkyStream, out.sky, diffuse_light(medium, out.ground.present ? -1 : 0),
                  out);
    }
    if (out.ground.present && below != Double3{})
        add_light("ground", kGroundStream, below, diffuse_light(medium, 1), out);
    for (std::size_t e = 0; e < medium.emitters.size(); ++e) {
        const int which = medium.emitters[e].medium;
        const float* emission = medium.optics[std::size_t(which)].emission;
        const std::string name = "emission of medium " + std::to_string(which);
        add_light(name.c_str(), kEmissionStream + std::uint32_t(which),
                  {double(emission[0]), double(emission[1]), double(emission[2])},
                  emission_light(medium, e), out);
    }
    return out;
}

void explain_lighting(const Shining& shining, const Medium& medium, const SunPlace& place,
                      const Lighting& made, Plan& plan) {
    const bool mapped = made.map.columns > 0;
    if (shining.sky.present && !mapped) plan.leave_out("sky map", "constant sky");
    bool shines = false;
    for (const float irradiance : shining.sun.irradiance)
        shines = shines || (shining.sun.present && irradiance > 0);
    const Double3 to_sun = towards_deg(place.azimuth_deg, place.elevation_deg);
    const char* hidden = shines ? hidden_sun(shining, medium, to_sun) : nullptr;
    if (hidden != nullptr) plan.leave_out("sun", hidden);
    if (made.sunlit && shining.sun.angular_radius_deg > 0)
        plan.leave_out("the sun's disc", "a point to this method: path alone knows it");
    if (!made.ground.present) plan.leave_out("ground bounce", "no ground");
    explain_lamps(shining.lamps, shining.ground, medium, plan);
    if (medium.grid.periodic) plan.leave_out("side faces", "periodic medium: it has none");
    if (is_dark(medium)) return plan.leave_out("photons", "no medium to scatter them");
    if (!made.sunlit && (!shining.sun.present || !shining.ground.present))
        plan.leave_out("sun photons", "no sunlight");
    const auto is_sky = [](const Light& light) { return light.stream == kSkyStream; };
    if (std::any_of(made.lights.begin(), made.lights.end(), is_sky)) return;
    if (made.constant != Double3{})
        plan.leave_out("sky photons", "constant sky and albedo 1: the furnace identity");
    else
        plan.leave_out("sky photons", "no sky");
}

}  // namespace pileus
