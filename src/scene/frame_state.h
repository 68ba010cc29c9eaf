// SPDX-License-Identifier: Apache-2.0
// What changes between two frames: what a host sets and what an animation moves.
// in: keys of [camera], [sun], [sky], [ground], [[light]] -> out: plain values. docs/scene.md
#pragma once
#include <array>
#include <vector>

#include "src/base/vectors.h"
#include "src/scene/animation.h"
#include "src/scene/light_settings.h"

namespace pileus {

/// The image plane of a host's projection, at distance 1, or in metres of parallel rays.
struct Frustum {
    double half_width = 0, half_height = 0;  ///< > 0
    double shift_x = 0, shift_y = 0;         ///< of its middle, to the right and up
    bool operator==(const Frustum& o) const {
        return half_width == o.half_width && half_height == o.half_height && shift_x == o.shift_x &&
               shift_y == o.shift_y;
    }
};

/// The part of a larger picture that a camera's `resolution` counts.
struct PictureWindow {
    std::array<int, 2> at{0, 0};    ///< its first pixel there
    std::array<int, 2> more{0, 0};  ///< pixels that the picture has more
    int parts = 1, part = 0;        ///< rows are those of one of several parts: CameraParams

    bool operator==(const PictureWindow& o) const {
        return at == o.at && more == o.more && parts == o.parts && part == o.part;
    }
};

struct Camera {
    Double3 position_m{0, -3000, 600}, target_m{0, 0, 900}, up{0, 0, 1};
    bool orthographic = false;  ///< parallel rays, or none at all (flux)
    bool flux = false;          ///< a flat detector of light from its front; orthographic too
    double fov_deg = 40;        ///< vertical, perspective only; in (0, 180)
    double height_m = 2000;     ///< orthographic and flux; > 0
    std::array<int, 2> resolution{960, 540};
    PictureWindow window;  ///< set where camera.crop is: src/plan/crop.h
    /// Of all of the picture: what is chosen by a number of pixels is chosen by this one, so that
    /// parts have the bits of the whole.
    std::uint64_t whole_pixels() const {
        return std::uint64_t(resolution[0] + window.more[0]) *
               std::uint64_t(resolution[1] + window.more[1]);
    }
    bool has_frustum = false;  ///< a session's: instead of fov_deg and height_m
    Frustum frustum;
};

struct Sun {
    bool present = false;
    double azimuth_deg = 0;     ///< from +y (north) towards +x (east)
    double elevation_deg = 45;  ///< [-90, 90]
    Float3 irradiance{1, 1, 1};
    double angular_radius_deg = 0;  ///< of its disc; 0: a point. Method path alone
};
inline SunPlace place_of(const Sun& sun) { return {sun.azimuth_deg, sun.elevation_deg}; }

struct Sky {
    bool present = false;
    bool mapped = false;          ///< by a map: of a file (ViewFiles) or of a host; else `radiance`
    Float3 radiance{0, 0, 0};     ///< constant; unused with a map
    double map_scale = 1;         ///< factor on its values; >= 0
    double map_rotation_deg = 0;  ///< turns it from north towards east
};

struct Ground {
    bool present = false;
    double altitude_m = 0, albedo = 0.2;
};

/// What a date tells of the night: where the moon is seen and what of it is lit, how the stars are
/// turned.
struct Night {
    bool moon = false, stars = false;  ///< placed
    double moon_azimuth_deg = 0, moon_elevation_deg = 0;
    double moon_radius_deg = 0;    ///< of its disc
    Double3 moon_light{};          ///< above the air, over the sun's
    Double3 moon_to_sun{0, 0, 1};  ///< unit vector from the moon: east, north, up
    double centuries = 0;          ///< since 2000, of terrestrial time
    double sidereal_deg = 0;       ///< of the place
    double latitude_deg = 0;
    bool refraction = true;  ///< lifts stars
};

/// How far all media have moved, and turned about the z axis through the origin before that, from
/// north to west.
struct Placement {
    Double3 offset_m{};
    double yaw_deg = 0;
};

/// What of a frame its world is made by. Frames of equal keys could share one.
struct WorldKey {
    int sequence_frame = 0;  ///< whose files are read, of densities and of depths
    double wind_s = 0;       ///< that the wind has blown beside the time of each sky
};

/// All that a host sets and an animation moves; nothing else changes between frames.
struct FrameState {
    Camera camera;
    Sun sun;
    Night night;  ///< of a date that has one; a host's sun leaves it as it is
    Sky sky;
    Ground ground;
    std::vector<LightSettings> lights;  ///< besides sun and sky
    Placement placement;
    int number = 0;          ///< a host's: what noise and pixels marched in turn go by
    double hours_later = 0;  ///< after atmosphere.time
    WorldKey world;          ///< set by whoever renders it
};

bool same_sun(const Sun& a, const Sun& b);
/// Whether two suns stand no more than so many degrees apart.
bool are_within(const Sun& a, const Sun& b, double degrees);
/// Whether both are there or not, and as bright within one part in a hundred: of a date the sun's
/// distance changes with it.
bool shine_alike(const Sun& a, const Sun& b);
bool same_ground(const Ground& a, const Ground& b);
/// What a host may change of a camera.
bool same_view(const Camera& a, const Camera& b);

/// `out`: the same in the coordinates of the media, which alone have moved by `host.placement`.
/// Takes no memory where `out` has had room for the lights.
void put_in_media(const FrameState& host, FrameState& out);

}  // namespace pileus
