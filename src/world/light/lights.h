// SPDX-License-Identifier: Apache-2.0
// Which lights a scene needs photons from, and how many each.
// in: sun, sky, ground, medium -> out: a list of lights with power, and what is left out and why.
// docs/methods.md 3 "Shoot"; docs/collectors.md derives the ground and the furnace identity.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "kernels_cpu/core/profile.h"
#include "kernels_cpu/light/lamp_params.h"
#include "kernels_cpu/light/sun_heights_params.h"
#include "src/plan/plan.h"
#include "src/scene/scene.h"
#include "src/world/light/ground_look.h"
#include "src/world/light/sky_map.h"
#include "src/world/medium/medium.h"

namespace pileus {

struct CameraDepth;
struct Solids;

/// A light that shoots photons. Its radiance (diffuse) or irradiance on a plane facing it (beam)
/// is `colour`; `power_m2` is its flux into the box per unit of that. A sky map has its own
/// radiances: its colour is 1 and its photons carry shares of their texel's brightest channel.
struct Light {
    std::string name;
    bool beam = false;
    bool map = false;
    bool lamps = false;  ///< all of Lighting::lamp_emission, whose powers are shares of power_m2
    int emitter = -1;    ///< of the medium, whose densities send it out; -1: none
    int hemisphere = 0;  ///< diffuse: 0 all directions, -1 travelling down, +1 travelling up
    std::array<float, 3> travel{0, 0, -1};
    Double3 colour{};
    double power_m2 = 0;
    std::array<float, 6> face_cdf{};
    std::uint64_t photons = 0;  ///< per generation
    std::uint64_t apart = 0;    ///< numbers between those of two generations; 0: as many as photons
    std::uint32_t stream = 0;   ///< of random numbers; one per kind of light
};

/// The ground as a light. Radiances are those of it unshadowed, by what shines on it.
struct GroundLighting {
    bool present = false;
    double z = 0;       ///< m, box-local
    double albedo = 0;  ///< of even light
    GroundPaint paint{};
    /// Of lamps that of parallel ones, which light it evenly.
    Double3 diffuse{}, sun{}, lamps{};
    Double3 beam{};  ///< as `sun`, by the sun as the media have it

    Double3 radiance() const { return diffuse + sun + lamps; }
};

/// Everything about illumination that is not in the medium.
struct Lighting {
    const Solids* solids = nullptr;      ///< what casts shadows and hides; null: nothing does
    const CameraDepth* depth = nullptr;  ///< what hides alone; null: nothing does
    std::vector<Light> lights;
    std::vector<LampParams> lamps;            ///< point, spot and parallel lights
    std::vector<LampParams> lamp_spots;       ///< [lamp]: spot_on_ground
    std::vector<LampEmission> lamp_emission;  ///< of each, for photons
    Double3 constant{};  ///< source everywhere in the medium (furnace identity)
    bool sunlit = false;
    std::array<float, 3> to_sun{0, 0, 1};
    Double3 sun_irradiance{};  ///< at the media's middle
    SunHeights sun_heights{};  ///< at any height; no rows: that
    Double3 sky{};             ///< radiance of a constant sky
    SkyMapView map{};          ///< or a map of it
    bool air = false;          ///< between the camera and all else
    GroundLighting ground;

    /// Lists are copied where they lie, never moved: a session has room for the most that it may
    /// have, and frames take none.
    Lighting() = default;
    Lighting(const Lighting&) = default;
    Lighting& operator=(const Lighting&) = default;
    /// Room for all kinds of lights, and for so many lamps.
    void reserve(std::size_t lamp_count) {
        lights.reserve(kLights ? 4 + std::size_t(kMaxMedia) : 4);
        lamps.reserve(lamp_count);
        lamp_spots.reserve(lamp_count);
        lamp_emission.reserve(lamp_count);
    }

    /// Whether rays may end before the sky.
    bool opaque() const { return ground.present || solids != nullptr || depth != nullptr; }
    /// Whether the ground sends light back.
    bool has_bright_ground() const { return ground.present && ground.albedo > 0; }
};

/// What shines on a frame, in the media's coordinates. References outlive the call.
struct Shining {
    const Sun& sun;
    const Sky& sky;
    const Ground& ground;
    const std::vector<LightSettings>& lamps;
    bool solids = false;  ///< the scene has some
    SunHeights sun_heights{};
    /// What the ground looks like, and where the media stand on it; null: grey land.
    const GroundLook* look = nullptr;
    const Placement* placement = nullptr;
    double time_s = 0;  ///< that waves have run
};

/// The light of medium.emitters[which]: its radiance where the medium is thick and scatters
/// nothing.
Light emission_light(const Medium& medium, std::size_t which);

/// Works out the lights. `place`: of the sun. `map`: null or empty: a constant sky; photons are
/// drawn from one that was aimed at the medium's box. `solids`, `depth`: null or without any: none.
Lighting make_lighting(const Shining& shining, const Medium& medium, const SunPlace& place,
                       const SkyMap* map = nullptr, const Solids* solids = nullptr,
                       const CameraDepth* depth = nullptr);

/// What was left out of them, and why.
void explain_lighting(const Shining& shining, const Medium& medium, const SunPlace& place,
                      const Lighting& made, Plan& plan);

/// The same light without sky and lamps: the ground then sends back sunlight alone.
Lighting sun_alone(const Lighting& all);

/// Irradiance of the sun on a plane that faces it at z, m, box-local; nothing in its way but air.
Double3 sun_at_height(const Lighting& light, double z);

/// The sun at the media's middle everywhere: no air between them and the ground.
void set_one_sun(Lighting& light);

/// Where media stand on a ground at this height, m, box-local.
GroundStand stand_of(const Medium& medium, const Placement& placement, double ground_z);

/// Whether the ground sends channels back unlike.
bool has_coloured_ground(const Lighting& light);

/// Whether all that shines is the same but for the sun's direction.
bool same_shine(const Lighting& a, const Lighting& b);

/// Shares `per_generation` photons among the lights by power; every light with power gets one.
void share_photons(std::uint64_t per_generation, std::vector<Light>& lights);

/// A diffuse light on the box's faces: all directions, or one hemisphere of travel.
Light diffuse_light(const Medium& medium, int hemisphere);

/// The light of a sky map that was aimed at the box.
Light map_light(const SkyMap& map);

/// A beam travelling along `travel` over the box's silhouette.
Light beam_light(const Medium& medium, const Double3& travel);

// Lights besides sun and sky, as kernels take them. docs/lights.md

/// Lights in box-local metres. Dark ones and those below a ground's altitude are left out: the
/// ground hides them from all that is above.
std::vector<LampParams> make_lamps(const std::vector<LightSettings>& lights, const Ground& ground,
                                   const Medium& medium);
/// What the ground sends up of a point or spot light, as a light of its own: one below the middle
/// of where its light falls, by as much as that is wide. Its intensity falls off with the angle
/// from straight up nearly as the cosine: x^2 (3 - 2 x) has the same flux. Strength 0 where it
/// sends nothing: without a ground, of parallel lights, and where the medium between takes most of
/// it.
LampParams spot_on_ground(const LampParams& lamp, const Lighting& light, const Medium& medium);
/// Which were left out, and why.
void explain_lamps(const std::vector<LightSettings>& lights, const Ground& ground,
                   const Medium& medium, Plan& plan);

/// Radiance that a parallel lamp gives the unshadowed ground; 0 of others, and without a ground.
Double3 ground_of_lamp(const Lighting& light, const LampParams& lamp);

bool same_lamps(const std::vector<LampParams>& a, const std::vector<LampParams>& b);

}  // namespace pileus
