// SPDX-License-Identifier: Apache-2.0
// The scene as a user wrote it, after checking: plain values in the units of the keys.
// in: TOML (docs/scene.md) -> out: this struct, read only afterwards.
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "src/base/vectors.h"
#include "src/scene/animation.h"
#include "src/scene/atmosphere_settings.h"
#include "src/scene/clouds_settings.h"
#include "src/scene/detail_settings.h"
#include "src/scene/light_settings.h"
#include "src/scene/particle_settings.h"
#include "src/scene/sky_settings.h"
#include "src/scene/weather_settings.h"

namespace pileus {

using Float3 = std::array<float, 3>;

struct Image;

/// The image plane of a host's projection, at distance 1, or in metres of parallel rays.
struct Frustum {
    double half_width = 0, half_height = 0;  ///< > 0
    double shift_x = 0, shift_y = 0;         ///< of its middle, to the right and up
    bool operator==(const Frustum& o) const {
        return half_width == o.half_width && half_height == o.half_height && shift_x == o.shift_x &&
               shift_y == o.shift_y;
    }
};

struct Camera {
    Double3 position_m{0, -3000, 600}, target_m{0, 0, 900}, up{0, 0, 1};
    bool position_by_place = false, target_by_place = false;  ///< by the weather file's map
    Double3 position_place{}, target_place{};  ///< longitude, latitude in degrees, height in m
    bool orthographic = false;                 ///< parallel rays, or none at all (flux)
    bool flux = false;       ///< a flat detector of light from its front; orthographic too
    double fov_deg = 40;     ///< vertical, perspective only; in (0, 180)
    double height_m = 2000;  ///< orthographic and flux; > 0
    std::array<int, 2> resolution{960, 540};
    bool has_frustum = false;  ///< a session's: instead of fov_deg and height_m
    Frustum frustum;
    std::string depth;             ///< image of the way to solid things; empty: none
    bool depth_on_axis = false;    ///< depth_kind = "z": along the view's axis, not along each ray
    double depth_scale = 1;        ///< metres per unit of its values; > 0
    double aperture_radius_m = 0;  ///< of the lens; 0: a pinhole
    double focus_distance_m = 0;   ///< along the view; 0: the target's
    double shutter_s = 0;          ///< how long it is open, the frame's time in the middle
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
    Float3 radiance{0, 0, 0};        ///< constant; unused with a map
    std::string map;                 ///< path of an image, relative to the scene file; empty: none
    const Image* picture = nullptr;  ///< in place of that file; a map's name must be given, too
    double map_scale = 1;            ///< factor on its values; >= 0
    double map_rotation_deg = 0;     ///< turns it from north towards east
};

struct Ground {
    bool present = false;
    double altitude_m = 0, albedo = 0.2;
};

/// A mesh of triangles that hides, is lit and casts shadows.
struct SolidSettings {
    std::string file;  ///< as MediumSettings::file
    Float3 albedo{0.2f, 0.2f, 0.2f};
    Double3 position_m{}, rotation_deg{};  ///< turned about x, then y, then z
    double scale = 1;                      ///< metres per unit of the file
    bool y_up = false;                     ///< the file's y points up; glTF's always does
};

/// A phase function by its name, and its numbers by the names of their keys (docs/scene.md):
/// phase.type = "henyey-greenstein", phase.numbers["g"] = 0.85. One left out has its row's default.
struct PhaseSettings {
    std::string type = "isotropic";         ///< a name of phase_row.h
    std::map<std::string, double> numbers;  ///< those that the type asks for, and no others
    std::string file;                       ///< table, moments; as MediumSettings::file
};

/// What a medium is at one value of the field that it shows; linear in between.
struct TransferRow {
    double value = 0;
    double extinction_per_m = 0;  ///< >= 0
    Float3 albedo{1, 1, 1};
};

enum class RawType { kUint8, kUint16, kFloat32 };

struct MediumSettings {
    /// A name of density_row.h; empty: a file.
    std::string density = "procedural:cumulus";
    std::string file;     ///< as written, relative to the scene file
    int first_frame = 0;  ///< of a sequence: the number of the file of frame 0
    std::string format;   ///< a name of volume_format.h; empty: by extension
    std::string grid;     ///< of a file with several; empty: the first of floats
    RawType raw_type = RawType::kFloat32;
    std::array<int, 3> raw_size{0, 0, 0};
    bool raw_big_endian = false;
    WeatherSettings weather;     ///< of a NetCDF file
    ParticleSettings particles;  ///< of a medium made of particles
    bool has_bounds = false;
    std::array<Double3, 2> bounds_m{};
    std::array<int, 3> resolution{0, 0, 0};  ///< procedural and uniform shapes; 0: a default
    std::int64_t shape_seed = 0;             ///< another cumulus for each; key `shape_seed`
    const float* values =
        nullptr;                  ///< a host's cells, as many as `resolution`; null: the row's own
    SkySettings sky;              ///< of a procedural sky
    double extinction_per_m = 0;  ///< at density 1
    double extinction_scale = 1;  ///< for files that hold extinction; >= 0
    Float3 albedo{1, 1, 1};
    Float3 emission{0, 0, 0};  ///< radiance per metre where the density is 1; >= 0
    PhaseSettings phase;
    DetailSettings detail;
    bool periodic = false;  ///< boundary = "periodic": repeats without end along x and y
    bool constant = false;  ///< interpolation = "constant": a cell has one value
    std::vector<TransferRow> transfer;  ///< by rising values; none: extinction as the file has it
    bool y_up = false;

    // Long, and lists of media have each of them in several places: in src/scene/scene.cpp once.
    MediumSettings();
    MediumSettings(const MediumSettings&);
    MediumSettings& operator=(const MediumSettings&);
    ~MediumSettings();
};

/// Who adds to which sums: see src/plan/accumulation.h.
enum class AccumulationChoice { kAuto, kPrivate, kShared };

/// Who blends billboards: pileus itself, or OpenGL by a foreign library for comparison.
enum class Compositor { kBuiltin, kOsmesa, kEgl };

enum class UpsampleKind { kDepth, kLinear, kNearest };

/// Few pixels are marched, the others filled in.
struct UpsampleSettings {
    int scale = 1;     ///< one pixel of so many along x and y is marched: 1, 2 or 4
    int temporal = 0;  ///< 2 or 4: the same, another one each frame, the rest from the frame before
    UpsampleKind upsample = UpsampleKind::kDepth;

    /// Marched pixels lie so far apart.
    int every() const { return temporal > 0 ? temporal : scale; }
};

/// Directions in which nodes keep their light: along the line to the camera; around it each ray's
/// own, too; or all.
enum class NodeDirections { kNear, kCamera, kAll };

struct CollectorSettings {
    std::int64_t photons = 5'000'000;  ///< over the whole ring
    int generations = 50;
    int bands = 4;  ///< 1..8
    int samples = 20'000;
    bool local_tracking = true;
    bool lobe_closure = false;    ///< closure = "lobe"
    bool camera_closure = false;  ///< closure = "camera": cells lit towards a fixed camera
    int cell_voxels = 2;          ///< edge of such a cell, voxels; 1..64
    bool paper = false;           ///< variant = "paper"
    bool billboards = false;      ///< display = "billboards"
    bool guided_nodes = false;    ///< node_filter = "guided" or "surroundings"
    NodeDirections directions = NodeDirections::kNear;
    Compositor compositor = Compositor::kBuiltin;
    bool rejection_sampler = false;  ///< sampler = "rejection" (paper) or "stratified"
    bool variance_field = false;     ///< placement = "variance" or "gradient"
    int variance_radius = 2;         ///< voxels, 1..8
    double density_range = 0.1;      ///< stop splitting below this range of density; [0, 1]
    double peak_deg = 20;            ///< scatterings within it are the sun's own light; [0, 90]
    double influence_radius = 0.05;  ///< of a sample, as a share of the box's diagonal; (0, 1]
    double radius_factor = 1.35;     ///< billboard radius over r; best only; [1, 3]
    int axis_degrees = 8;
    bool first_order_split = true;
    bool window = false;  ///< sinc window against ringing
    UpsampleSettings thin;
    int light_refresh = 1;  ///< frames in which sunlight on nodes follows a sun that moves; 1..64
    AccumulationChoice accumulation = AccumulationChoice::kAuto;
};

enum class GridClosure { kSh, kPublished, kMean, kCamera };

struct PhotonGridSettings {
    std::int64_t photons = 5'000'000;  ///< over all generations
    int generations = 16;
    bool ring = false;                  ///< an animation keeps every generation apart
    std::array<int, 3> cells{0, 0, 0};  ///< of the grid that gathers; 0: chosen
    GridClosure closure = GridClosure::kSh;
    int bands = 4;         ///< closure = "sh"; 1..8
    int axis_degrees = 8;  ///< closure = "sh"
    double peak_deg = 20;  ///< as CollectorSettings::peak_deg
    bool local_tracking = true;
    bool first_order_split = true;
    NodeDirections directions = NodeDirections::kNear;  ///< never kAll
    UpsampleSettings thin;
    int light_refresh = 1;  ///< frames in which sunlight on nodes follows a sun that moves; 1..64
    AccumulationChoice accumulation = AccumulationChoice::kAuto;
};

struct PathSettings {
    std::int64_t samples_per_pixel = 64;
    int max_depth = 0;        ///< scatterings after which light is not followed; 0: unlimited
    bool centre = false;      ///< pixel = "centre": rays through the middles of pixels only
    double target_error = 0;  ///< mean relative standard error to reach; 0: none
    std::int64_t max_samples_per_pixel = 65536;  ///< where an error or a time decides
    bool guide = true;  ///< a peaked phase function's light is also sought from near the sun
};

enum class FilterKind { kNone, kRegression, kOidn };

/// What makes a noisy picture smooth.
struct FilterSettings {
    FilterKind kind = FilterKind::kNone;
    int radius_pixels = 0;  ///< of the windows; 0: by the noise
};

enum class RaymarchIntegrator { kClosed, kRiemann, kTrapezoid, kSimpson, kSimpson38 };
enum class RaymarchSpacing { kUniform, kVoxel, kOptimal, kGeometric };
enum class RaymarchJitterKind { kNone, kHash, kBlueNoise };
enum class RaymarchLightKind { kAuto, kMarch, kBuffer, kBufferExact };
enum class RaymarchPowderKind { kNone, kPowder, kBeerPowder, kDirectional };

struct RaymarchSettings {
    RaymarchIntegrator integrator = RaymarchIntegrator::kClosed;
    int steps = 256;  ///< of a ray through the medium; 0: it is not seen
    RaymarchSpacing spacing = RaymarchSpacing::kUniform;
    double first_step_m = 0;  ///< geometric: at least; optimal: where steps stop shrinking; 0: auto
    double growth = 1.01;     ///< geometric: of one step over the one before
    bool stretch = false;     ///< occlusion = "stretch"
    bool forward = false;     ///< scattering = "forward"
    bool many = true;         ///< scattering = "octaves"
    int octaves = 8;          ///< 1..8
    double octave_extinction = 0.45, octave_share = 0.65, octave_anisotropy = 0.75;
    double cone_deg = 40;       ///< at its apex
    double forward_share = -1;  ///< >= 0: instead of what the phase function keeps in the cone
    RaymarchLightKind light = RaymarchLightKind::kAuto;
    int light_steps = 0;  ///< 0: of a voxel, to the end
    double light_first_step_m = 0, light_growth = 1;
    bool sky_ambient = true;  ///< sky_light = "ambient"
    bool detail = false;      ///< coarser densities for steps and pixels wider than cells
    bool light_cone = false;  ///< light_path = "cone"
    RaymarchJitterKind jitter = RaymarchJitterKind::kNone;
    double jitter_share = 1;  ///< of a panel
    double grid_lock_m = 0;   ///< 0: none
    RaymarchPowderKind powder = RaymarchPowderKind::kNone;
    double powder_strength = 1;
    Float3 ambient{0, 0, 0};  ///< emission over extinction
    double stop_below = 1e-4;
    UpsampleSettings thin;
    int light_refresh = 1;    ///< frames in which sunlight on nodes follows a sun that moves; 1..64
    bool peak_phase = false;  ///< phase = "peak": over its largest value
};

/// Method optical-depth; src/scene/keys/optical_depth.cpp says what each means.
struct OpticalDepthSettings {
    int steps = 0;                           ///< of a ray; 0: one a cell
    bool exact = false;                      ///< buffer = "exact"
    std::array<int, 3> resolution{0, 0, 0};  ///< cells of the buffer; 0: the medium's
    double intensity = 1;
    Float3 ambient{0, 0, 0};
    double powder_strength = 1, powder_depth = 2;
    bool powder_by_extinction = false;
    double g = -2;                    ///< within [-1, 1]: instead of the medium's phase function
    double max_extinction_per_m = 0;  ///< 0: no bound
    double light_scale = 1;           ///< on extinction towards the sun
    double stop_below = 1e-4;
};

enum class ParticleLight { kCentre, kLinear, kExact };
enum class ParticleScattering { kSingle, kEffective, kSimilarity, kOctaves };

/// Method particles; src/scene/keys/particles.cpp says what each means.
struct ParticlesSettings {
    ParticleScattering scattering = ParticleScattering::kSingle;
    int octaves = 8;  ///< 1..8
    double octave_extinction = 0.45, octave_share = 0.65, octave_anisotropy = 0.75;
    double cone_deg = 40;     ///< at its apex
    bool sky_ambient = true;  ///< sky_light = "ambient"
    int bins = 256;           ///< along a ray, 1..4096
    int leaf = 16;            ///< most particles in one, 1..1024
    ParticleLight light = ParticleLight::kLinear;
    double shadow_density = 1;  ///< factor on extinction towards lights; >= 0
    double occluders = 1;       ///< share of particles that cast shadows, denser in return; (0, 1]
    double light_bias = 0;      ///< places that are lit, moved to a parallel light, radii
    double solid_shadow = 0;    ///< share of light left behind solids; [0, 1]
    bool billboards = false;    ///< display = "billboards"; else marched
    double display_scale = 1;   ///< of billboards: on radii, extinction times area kept; > 0
    double falloff = 2.5;       ///< of billboards: the power of 1 - distance^2; 0..16
    double most_depth = 0;      ///< towards the sun, where the walk ends; 0: none
    double stop_below = 1e-4;
};

struct OutputSettings {
    std::vector<std::string> files;  ///< relative to the scene's folder
    std::string report;
    bool layer_depth = false, layer_error = false, layer_cloud = false;
    bool layer_optical_depth = false, layer_transmittance = false;
    bool layer_light = false, layer_order = false;
    bool layer_reflectance = false, layer_shadow = false, layer_occlusion = false;
};

struct Scene {
    std::int64_t seed = 0;
    Camera camera;
    Sun sun;
    Sky sky;
    Ground ground;
    AtmosphereSettings atmosphere;      ///< in place of the sky; colours the sun
    std::vector<LightSettings> lights;  ///< besides sun and sky
    std::vector<SolidSettings> solids;
    std::vector<MediumSettings> media;
    CloudsSettings clouds;   ///< kinds and places of many clouds, in place of media
    int sequence_frame = 0;  ///< frame whose density files are read; set by whoever renders it
    std::string method = "collectors";
    CollectorSettings collectors;
    PathSettings path;
    FilterSettings filter;
    RaymarchSettings raymarch;
    OpticalDepthSettings optical_depth;
    PhotonGridSettings photon_grid;
    ParticlesSettings particles;
    OutputSettings output;
    Animation animation;
    std::vector<std::string> overrides;         ///< texts of the --set options
    std::string text;                           ///< the file's own text
    std::string file;                           ///< name for messages
    std::string directory;                      ///< paths in the scene are relative to it
    std::map<std::string, std::string> places;  ///< of its keys, "file:line:column", for messages

    /// Whether pictures need the distance to the media: a layer shows it, or the air before them.
    bool wants_depth() const { return output.layer_depth || atmosphere.present; }
};

}  // namespace pileus
