// SPDX-License-Identifier: Apache-2.0
// Part of pileus.hpp: the values that sessions and worlds take and give.
// Metres, degrees, linear R G B; what is left as it is here is fine. docs/embedding.md
#ifndef PILEUS_TYPES_HPP
#define PILEUS_TYPES_HPP

#include <pileus/pileus.h>

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>

namespace pileus::embed {

/// Sizes before memory.
struct Plan {
    glm::uvec3 cells{0};             ///< of the media's grid
    std::uint64_t peak_bytes = 0;    ///< of a world and one session together, an upper bound
    std::uint64_t world_bytes = 0;   ///< of that the world's own, shared by its sessions
    glm::dvec3 low_m{0}, high_m{0};  ///< corners of the media's box
};

/// Particles from memory; strides are the bytes from one to the next. Their unit, and what
/// `density` means, is what the scene says of its file of particles.
struct Particles {
    std::uint64_t count = 0;
    const float* position = nullptr;    ///< x, y, z of each; -1e12 to 1e12
    const float* radius = nullptr;      ///< above 0, to 1e12; null where the scene has radius_m
    const float* density = nullptr;     ///< 0 to 1e12; null: 1
    const std::uint64_t* id = nullptr;  ///< up to 2^53, for density.share; null: none
    const float* velocity = nullptr;    ///< x, y, z of each, lengths per second; null: at rest
    std::uint32_t position_stride = 3 * sizeof(float), radius_stride = sizeof(float);
    std::uint32_t density_stride = sizeof(float), id_stride = sizeof(std::uint64_t);
    std::uint32_t velocity_stride = 3 * sizeof(float);
    const float* colour = nullptr;    ///< factors on the medium's albedo, 0 to 1; null: 1
    const float* emission = nullptr;  ///< factors on the medium's emission, 0 to 1e9; null: 1
    std::uint32_t colour_stride = 3 * sizeof(float), emission_stride = 3 * sizeof(float);
};

/// Densities from memory instead of a scene's: values[(z * size.y + y) * size.x + x] fill the
/// bounds_m of medium number `medium`; or `particles`, where that medium is a file of particles,
/// which need not exist. Copied.
struct Density {
    std::uint32_t medium = 0;
    glm::uvec3 size{0};                    ///< 1 to 4096 each
    const float* values = nullptr;         ///< finite, not negative
    const Particles* particles = nullptr;  ///< not null: `size` and `values` do not count
};

/// A perspective or, where height_m > 0, an orthographic camera.
struct Camera {
    glm::uvec2 size{0};                     ///< pixels; 0: as before
    glm::dvec3 position_m{0}, target_m{0};  ///< of the eye, and what it looks at
    glm::dvec3 up{0, 0, 1};
    double fov_deg = 40;  ///< vertical, perspective only; in (0, 180)
    double height_m = 0;  ///< of the picture, orthographic only
    double near_m = 0,
           far_m = 0;  ///< for depth buffers only; far_m 0: infinite. Nothing is clipped
};

/// How a projection's clip space counts depth: kZero with GLM_FORCE_DEPTH_ZERO_TO_ONE, Vulkan and
/// Direct3D. Reversed and infinite projections are told by the matrix.
enum class Clip { kMinusOne = PILEUS_CLIP_MINUS_ONE, kZero = PILEUS_CLIP_ZERO };

struct Sun {
    double azimuth_deg = 0, elevation_deg = 45;  ///< elevation in [-90, 90]
    glm::vec3 irradiance{1};                     ///< on a plane that faces it, >= 0
    bool present = true;
};

/// A light besides sun and sky; docs/lights.md has the units.
struct SceneLight {
    enum class Type {
        kPoint = PILEUS_LAMP_POINT,
        kSpot = PILEUS_LAMP_SPOT,
        kDirectional = PILEUS_LAMP_DIRECTIONAL
    };
    Type type = Type::kPoint;
    glm::dvec3 position_m{0};                    ///< point, spot
    glm::dvec3 direction{0, 0, -1};              ///< spot: where it shines
    double cone_deg = 40, penumbra_deg = 0;      ///< spot: (0, 360]; up to half of that
    double radius_m = 0;                         ///< point, spot; 0: a point
    std::uint32_t shadow_samples = 0;            ///< up to 64; 0: 8; 1: shadows of a point
    double azimuth_deg = 0, elevation_deg = 45;  ///< directional: where it stands, as the sun
    glm::vec3 light{1};  ///< radiant intensity; directional: irradiance on a plane that faces it
};

/// Of one radiance, or of a picture: latitude-longitude, rows from the zenith, three floats a texel
/// (docs/scene.md, "Sky map"). Copied.
struct Sky {
    glm::vec3 radiance{0};        ///< used without a map; >= 0
    glm::uvec2 map_size{0};       ///< columns, rows; columns = 2 rows; 0: no map
    const float* map = nullptr;   ///< [row][column][3]; null: keep the map there is
    double map_scale = 1;         ///< on its values; 0 counts as 1
    double map_rotation_deg = 0;  ///< from north towards east
    bool present = true;
};

struct Ground {
    double altitude_m = 0;
    double albedo = 0.2;  ///< in [0, 1]
    bool present = true;
};

enum class Depth : std::uint32_t {
    kDistance = PILEUS_DEPTH_DISTANCE,  ///< metres along each pixel's ray; infinity: nothing
    kViewZ = PILEUS_DEPTH_VIEW_Z,       ///< metres along the view's axis; infinity: nothing
    kBuffer = PILEUS_DEPTH_BUFFER  ///< a depth buffer of the camera's projection, 0..1; its far
                                   ///< end: nothing
};

/// Opaque things of the caller, which end rays.
struct DepthImage {
    const float* values = nullptr;  ///< as many as the camera has pixels; null: nothing solid
    Depth kind = Depth::kDistance;
    std::int64_t stride = 0;  ///< bytes from row to row; 0: rows lie close
    bool bottom_up = false;   ///< the first row in memory is the picture's lowest, as in OpenGL
};

enum class Format : std::uint32_t {
    kRgba8Srgb =
        PILEUS_FORMAT_RGBA8_SRGB,  ///< 4 bytes a pixel, tone curve and sRGB as the program's PNGs
    kRgba16F = PILEUS_FORMAT_RGBA16F,  ///< 4 IEEE halves, linear radiance
    kRgba32F = PILEUS_FORMAT_RGBA32F   ///< 4 floats, linear radiance
};

enum class Blend : std::uint32_t {
    kReplace = PILEUS_BLEND_REPLACE,  ///< the whole picture; alpha: the media's
    kOver = PILEUS_BLEND_OVER,        ///< the media over what the buffer holds
    kMedia = PILEUS_BLEND_MEDIA       ///< the media alone, premultiplied by their alpha
};

/// Buffers of the caller, for one picture.
struct Frame {
    void* colour = nullptr;  ///< first byte of the first row in memory; null: none
    Format format = Format::kRgba8Srgb;
    Blend blend = Blend::kReplace;
    std::int64_t colour_stride = 0;  ///< bytes from row to row; 0: rows lie close
    bool bottom_up = false;    ///< the first row in memory is the picture's lowest; both buffers
    float exposure_stops = 0;  ///< 8 bit only: doubles or halves the light
    float* depth = nullptr;    ///< where half of the light is gone, or the opaque thing; null: none
    Depth depth_kind = Depth::kDistance;
    std::int64_t depth_stride = 0;
    std::uint64_t* hash = nullptr;  ///< of the whole picture, as the program's; null: none is made
};

/// What a step counts.
struct Light {
    std::uint32_t whole = 0;         ///< units that a first picture should have; 0: there are none
    std::uint64_t unit_photons = 0;  ///< photons or paths of one unit
    std::uint64_t units = 0;         ///< of light that the next picture shows
    std::string unit;                ///< "generation", "sample" or ""
};

/// What a frame may cost, as pileus_work; 0: as the scene has it.
struct Work {
    std::uint32_t scale = 0, temporal = 0, steps = 0, light_refresh = 0;
    std::uint64_t photons = 0;
};

/// Counts of what was done, to see that a frame makes nothing again.
struct Stats {
    std::uint32_t prepared = 0;  ///< 1: once for all; more where a light appeared
    std::uint64_t pictures = 0, units = 0;
    std::uint64_t shared_bytes = 0;  ///< of arrays of the world
    std::uint64_t own_bytes = 0;     ///< peak of the session's own arrays by its plan
    double render_s = 0;             ///< wall time of the last render
    double stages_s = 0;             ///< of that in named stages
};

}  // namespace pileus::embed

#endif  // PILEUS_TYPES_HPP
