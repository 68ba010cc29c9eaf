/* SPDX-License-Identifier: Apache-2.0
 * The C interface of pileus: worlds, sessions, frames. C99; C++ programs may prefer pileus.hpp.
 *
 * A scene is text. A world is what of it depends on neither camera, light nor method: made once,
 * read only, shared by any number of sessions. A session is one camera, one light and one method
 * over a world: set what changed, step the light, render into memory of your own.
 *
 * Rules of all functions
 * - A result other than PILEUS_OK leaves outputs as they were; `error`, where not null, then holds
 *   the code and a line for each fault. Nothing is written to stdout or stderr, no signal handler
 * or floating-point mode of yours is changed, nothing is kept outside handles.
 * - Handles are used by one thread at a time; different handles by as many threads as you like. A
 *   world and a scene are read only once made, so that threads share them.
 * - Structs begin with their size, which PILEUS_INIT sets: a library that is newer or older than
 * the header reads the part that both know.
 * - Lengths are metres, angles degrees. x points east, y north, z up; an azimuth counts from north
 *   (+y) towards east (+x). Matrices are column-major, as OpenGL and GLM store them.
 * - Pictures are the same bits for any number of threads, on any processor, as the program `pileus`
 *   makes of the same scene. docs/embedding.md shows how to use all of this.
 */
#ifndef PILEUS_H
#define PILEUS_H

#include <stddef.h>
#include <stdint.h>

#if defined(PILEUS_STATIC)
#define PILEUS_API
#elif defined(_WIN32) && defined(PILEUS_BUILD)
#define PILEUS_API __declspec(dllexport)
#elif defined(_WIN32)
#define PILEUS_API __declspec(dllimport)
#else
#define PILEUS_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

/** Grows when functions or members are added; what is there keeps its meaning. */
#define PILEUS_API_VERSION 3

/** Clears a struct and sets its size: `pileus_camera camera; PILEUS_INIT(camera);` */
#define PILEUS_INIT(s) pileus_init(&(s), (uint32_t)sizeof(s))

typedef enum pileus_code {
    PILEUS_OK = 0,
    PILEUS_CHECK_FAILED = 1, /**< kernels that give other bits than they must */
    PILEUS_BAD_INPUT = 2,    /**< an argument, a scene or a file of it */
    PILEUS_LIMIT = 3,        /**< out of memory, or more than a limit allows */
    PILEUS_IO = 4            /**< reading or writing failed half way */
} pileus_code;

/** Longer messages end in "...". */
typedef struct pileus_error {
    uint32_t struct_size;
    int32_t code; /**< a pileus_code */
    char message[2040];
} pileus_error;

/** Clears `size` bytes and stores `size` in the first four. */
PILEUS_API void pileus_init(void* pileus_struct, uint32_t size);

/** "major.minor.patch"; and the PILEUS_API_VERSION that the library was built with. */
PILEUS_API const char* pileus_version(void);
PILEUS_API uint32_t pileus_api_version(void);

/* ---- The host ---------------------------------------------------------------------------- */

/** What the library may use. A cleared one is fine: all threads, the C runtime's memory. Pointers
 * must stay valid as long as the handles made with them. Callbacks never come from two threads of
 * one call at once, but for allocate and release, which may; where `run` is given, they may come
 * from its threads. */
typedef struct pileus_host {
    uint32_t struct_size;
    uint32_t threads; /**< 0: as many as there are processors */
    const char* isa;  /**< "scalar", "avx2", ...; null: the widest of this machine */
    uint64_t
        memory_limit; /**< bytes a world or session may need by its plan; 0: the default limit */
    void* user;       /**< handed to the callbacks */
    /** Arrays: at least `bytes` at a multiple of `alignment`, or null. Both or neither. */
    void* (*allocate)(void* user, size_t bytes, size_t alignment);
    void (*release)(void* user, void* memory);
    /** Calls body(data, index) once for each index in [0, count), at once or one after the other,
     * and returns when all have returned. Null: OpenMP's where they sleep while
     * they wait, else threads of the session's own. */
    void (*run)(void* user, uint32_t count, void (*body)(void* data, uint32_t index), void* data);
    /** A line for a person: what is doubtful about a picture. */
    void (*log)(void* user, const char* line);
    /** The share done of a stage, 0 to 1. */
    void (*progress)(void* user, const char* stage, double share);
    /** Asked now and then; anything but 0 ends a step early. */
    int32_t (*stop)(void* user);
} pileus_host;

/* ---- Scenes ------------------------------------------------------------------------------ */

typedef struct pileus_scene pileus_scene;

/** Reads a scene file (docs/scene.md). `overrides`: "key=value" texts as of the program's --set.
 * Its camera, sun, sky, ground and method are where a session begins. */
PILEUS_API pileus_code pileus_scene_read(const char* path, const char* const* overrides,
                                         uint32_t override_count, pileus_scene** scene,
                                         pileus_error* error);

/** The same from text; `directory` is where relative paths begin, null: the current one. */
PILEUS_API pileus_code pileus_scene_parse(const char* text, const char* directory,
                                          const char* const* overrides, uint32_t override_count,
                                          pileus_scene** scene, pileus_error* error);
PILEUS_API void pileus_scene_free(pileus_scene* scene);

/* ---- Worlds ------------------------------------------------------------------------------ */

typedef struct pileus_world pileus_world;

/** Sizes before memory. */
typedef struct pileus_plan {
    uint32_t struct_size;
    uint32_t cells[3];          /**< of the media's grid */
    uint64_t peak_bytes;        /**< of a world and one session of it together, an upper bound */
    uint64_t world_bytes;       /**< of that the world's own, shared by its sessions */
    double low_m[3], high_m[3]; /**< corners of the media's box */
} pileus_plan;

/** From sizes of files alone: reads no values, takes no memory to speak of. */
PILEUS_API pileus_code pileus_plan_scene(const pileus_scene* scene, const pileus_host* host,
                                         pileus_plan* plan, pileus_error* error);

/** Particles from memory. Strides are the bytes from one particle to the next. Their unit, and what
 * `density` means, is what the scene says of its file of particles (docs/particles.md). */
typedef struct pileus_particles {
    uint32_t struct_size;
    uint32_t position_stride, radius_stride, density_stride, id_stride, velocity_stride;
    uint64_t count;
    const float* position; /**< x, y, z of each; -1e12 to 1e12 */
    const float* radius;   /**< 1e-9 m to 1e12; null where the scene has radius_m */
    const float* density;  /**< 0 to 1e12; null: 1 */
    const uint64_t* id;    /**< up to 2^53, for density.share; null: none */
    const float* velocity; /**< x, y, z of each, lengths per second; null: at rest */
    uint32_t colour_stride, emission_stride;
    const float *colour, *emission; /**< r, g, b: factors on the medium's, up to 1, 1e9; null: 1 */
} pileus_particles;

/** Densities from memory instead of the scene's file, once for a medium: values[(z*size[1] +
 * y)*size[0] + x], the scene's medium number `medium` fills its bounds_m with them; or `particles`,
 * where that medium is a file of particles, which need not exist. Copied. */
typedef struct pileus_density {
    uint32_t struct_size;
    uint32_t medium;
    uint32_t size[3];
    const float* values;               /**< finite, not negative */
    const pileus_particles* particles; /**< not null: `size` and `values` do not count */
} pileus_density;

/** Loads or makes the media and solids. `host` may be null. The scene may be freed afterwards.
 * `densities` may be null where `density_count` is 0. */
PILEUS_API pileus_code pileus_world_create(const pileus_scene* scene, const pileus_host* host,
                                           const pileus_density* densities, uint32_t density_count,
                                           pileus_world** world, pileus_error* error);

/** Sessions keep their world alive: it may be freed before them. */
PILEUS_API void pileus_world_free(pileus_world* world);

/* ---- Sessions ---------------------------------------------------------------------------- */

typedef struct pileus_session pileus_session;

/** Prepares the scene's method over a world made from the same scene, or from one with the same
 * media. Overrides may choose another method ("method.name=\"raymarch\"") or its settings. */
PILEUS_API pileus_code pileus_session_create(const pileus_world* world, const pileus_scene* scene,
                                             const pileus_host* host, pileus_session** session,
                                             pileus_error* error);
PILEUS_API void pileus_session_free(pileus_session* session);

/** A perspective or, where height_m > 0, an orthographic camera. */
typedef struct pileus_camera {
    uint32_t struct_size;
    uint32_t width, height;            /**< pixels; 0: as before */
    double position_m[3], target_m[3]; /**< of the eye, and what it looks at */
    double up[3];                      /**< all 0: z */
    double fov_deg;                    /**< vertical, perspective only */
    double height_m;                   /**< of the picture, orthographic only */
    /** For depth buffers only, far_m beyond near_m; far_m 0: infinite. Nothing is clipped. */
    double near_m, far_m;
} pileus_camera;

PILEUS_API pileus_code pileus_session_set_camera(pileus_session* session,
                                                 const pileus_camera* camera, pileus_error* error);

/** How a projection's clip space counts depth: OpenGL -1..1, Vulkan and Direct3D 0..1. Reversed and
 * infinite projections are told by the matrix. */
typedef enum pileus_clip { PILEUS_CLIP_MINUS_ONE = 0, PILEUS_CLIP_ZERO = 1 } pileus_clip;

/** The same from matrices: world to view (a rigid motion; the view looks along -z, y up) and view
 * to clip (perspective or orthographic; may be off-centre). `width`, `height`: pixels, 0: as
 * before. */
PILEUS_API pileus_code pileus_session_set_matrices(pileus_session* session, const double view[16],
                                                   const double projection[16], pileus_clip clip,
                                                   uint32_t width, uint32_t height,
                                                   pileus_error* error);

/** Pixels of the camera as it is set now, which the caller's buffers must have. */
PILEUS_API pileus_code pileus_session_size(const pileus_session* session, uint32_t* width,
                                           uint32_t* height, pileus_error* error);

typedef struct pileus_sun {
    uint32_t struct_size;
    int32_t present;
    double azimuth_deg, elevation_deg; /**< elevation in [-90, 90] */
    float irradiance[3];               /**< on a plane that faces it, linear R G B, >= 0 */
} pileus_sun;
PILEUS_API pileus_code pileus_session_set_sun(pileus_session* session, const pileus_sun* sun,
                                              pileus_error* error);

/** A sky of one radiance, or of a picture: latitude-longitude, rows from the zenith, three floats a
 * texel, linear. docs/scene.md, "Sky map", has the directions. The picture is copied.
 * PILEUS_BAD_INPUT in scenes with [atmosphere], which has its own sky, and a sun. */
typedef struct pileus_sky {
    uint32_t struct_size;
    int32_t present;
    float radiance[3];    /**< used without a map */
    uint32_t map_size[2]; /**< columns, rows; columns = 2 rows; both 0: no map */
    const float* map;     /**< [row][column][3]; null: keep the map there is, as it is */
    double map_scale, map_rotation_deg; /**< of `map`; scale 0 counts as 1 */
} pileus_sky;
PILEUS_API pileus_code pileus_session_set_sky(pileus_session* session, const pileus_sky* sky,
                                              pileus_error* error);

typedef struct pileus_ground {
    uint32_t struct_size;
    int32_t present;
    double altitude_m, albedo;
} pileus_ground;
PILEUS_API pileus_code pileus_session_set_ground(pileus_session* session,
                                                 const pileus_ground* ground, pileus_error* error);

typedef enum pileus_light_type { PILEUS_POINT, PILEUS_SPOT, PILEUS_DIRECTIONAL } pileus_light_type;
/** A light besides sun and sky; docs/lights.md has the units. */
typedef struct pileus_light {
    uint32_t struct_size, type;        /**< a pileus_light_type */
    double position_m[3], radius_m;    /**< point, spot; radius 0: a point */
    double direction[3];               /**< spot: where it shines; not 0 */
    double cone_deg, penumbra_deg;     /**< spot: (0, 360]; up to half of that */
    double azimuth_deg, elevation_deg; /**< directional: where it stands, as the sun */
    float light[3]; /**< radiant intensity; directional: irradiance on a plane that faces it */
    uint32_t reserved, shadow_samples; /**< not read; places on a sphere, 0: 8, 1: its middle */
} pileus_light;

/** Lights in place of all that the session had, the scene's included; up to 64, 0: none. Each
 * element has the size that the first one tells. Errors: those of a scene's [[light]]. */
PILEUS_API pileus_code pileus_session_set_lights(pileus_session* session,
                                                 const pileus_light* lights, uint32_t count,
                                                 pileus_error* error);

/** Moves all media: turned about the z axis through the world's origin (counter-clockwise seen from
 * above), then shifted. Nothing is prepared again. Not in a world with solids, not below the
 * ground. */
typedef struct pileus_placement {
    uint32_t struct_size;
    double offset_m[3];
    double yaw_deg;
} pileus_placement;
PILEUS_API pileus_code pileus_session_set_placement(pileus_session* session,
                                                    const pileus_placement* placement,
                                                    pileus_error* error);

typedef enum pileus_depth {
    PILEUS_DISTANCE = 0, /**< metres along each pixel's ray; infinity: nothing */
    PILEUS_VIEW_Z = 1,   /**< metres along the view's axis; infinity: nothing */
    PILEUS_BUFFER = 2 /**< a depth buffer of the camera's projection, 0..1; its far end: nothing */
} pileus_depth;

/** Opaque things of the caller, which end rays: terrain, aircraft, runways. */
typedef struct pileus_depth_image {
    uint32_t struct_size;
    uint32_t kind;       /**< a pileus_depth */
    const float* values; /**< as many as the camera has pixels; null: nothing solid */
    int64_t stride;      /**< bytes from row to row; 0: rows lie close */
    int32_t bottom_up;   /**< not 0: the first row in memory is the picture's lowest */
} pileus_depth_image;

/** Copies the depths for the camera as it is set now; they stay until they are set again. */
PILEUS_API pileus_code pileus_session_set_depth(pileus_session* session,
                                                const pileus_depth_image* depth,
                                                pileus_error* error);

/** Number of the picture, which jitter, pixels that are marched in turn and the noise of paths go
 * by; from 0 on. Without it every picture is number 0. */
PILEUS_API pileus_code pileus_session_set_frame(pileus_session* session, int32_t number,
                                                pileus_error* error);

/** What a step counts. */
typedef struct pileus_light_info {
    uint32_t struct_size;
    uint32_t whole;        /**< units that a first picture should have: a ring; samples; 0: none */
    uint64_t unit_photons; /**< photons or paths of one unit */
    uint64_t units;        /**< of light that the next picture shows */
    char unit[24];         /**< "generation", "sample" or "" */
} pileus_light_info;
PILEUS_API pileus_code pileus_session_light(const pileus_session* session, pileus_light_info* info,
                                            pileus_error* error);

/** Traces `units` units of light for the camera and lights as they are set now: generations of
 * photons (collectors; the oldest of a full ring give way), samples of every pixel (path; a new
 * camera, light or frame begins anew); nothing in methods without (raymarch). Never counts time.
 * `done`, where not null: how many were traced before `stop` ended it. */
PILEUS_API pileus_code pileus_session_step(pileus_session* session, uint32_t units, uint32_t* done,
                                           pileus_error* error);

typedef enum pileus_format {
    PILEUS_RGBA8_SRGB = 0, /**< 4 bytes a pixel, tone curve and sRGB as in the program's PNGs */
    PILEUS_RGBA16F = 1,    /**< 4 IEEE halves, linear radiance */
    PILEUS_RGBA32F = 2     /**< 4 floats, linear radiance */
} pileus_format;

typedef enum pileus_blend {
    PILEUS_REPLACE =
        0,           /**< the whole picture, sky and ground behind the media; alpha: the media's */
    PILEUS_OVER = 1, /**< the media over what the buffer holds */
    PILEUS_MEDIA = 2 /**< the media alone, premultiplied by their alpha */
} pileus_blend;

/** Buffers of the caller, for one picture. */
typedef struct pileus_frame {
    uint32_t struct_size;
    void* colour;          /**< first byte of the first row in memory; may be null */
    int64_t colour_stride; /**< bytes from row to row; 0: rows lie close */
    uint32_t format;       /**< a pileus_format */
    uint32_t blend;        /**< a pileus_blend */
    int32_t bottom_up; /**< not 0: the first row in memory is the picture's lowest; both buffers */
    float exposure_stops; /**< RGBA8 only: doubles or halves the light; -100 to 100 */
    float* depth;         /**< where half of the light is gone, or the opaque thing; null: none */
    int64_t depth_stride; /**< bytes; 0: rows lie close */
    uint32_t depth_kind;  /**< a pileus_depth */
    uint64_t* hash;       /**< null: none is made; else of the whole picture, as the program's */
} pileus_frame;

/** Draws what the session holds now. Light is not traced: see pileus_session_step. */
PILEUS_API pileus_code pileus_session_render(pileus_session* session, const pileus_frame* frame,
                                             pileus_error* error);

/** Counts of what was done, to see that a frame makes nothing again. */
typedef struct pileus_stats {
    uint32_t struct_size;
    uint32_t prepared;     /**< 1: once for all; more where a light appeared that was not there */
    uint64_t pictures;     /**< rendered */
    uint64_t units;        /**< of light traced */
    uint64_t shared_bytes; /**< of arrays of the world */
    uint64_t own_bytes;    /**< peak of the session's own arrays by its plan */
    double render_s;       /**< wall time of the last render */
    double stages_s;       /**< of that in named stages; the rest is the fixed cost */
} pileus_stats;
PILEUS_API pileus_code pileus_session_stats(const pileus_session* session, pileus_stats* stats,
                                            pileus_error* error);

/** The report as the program writes it (docs/report.md), JSON, ended by a zero. `needed`: bytes
 * with the zero; `text` may be null where `size` is 0. Too small a size: PILEUS_LIMIT. The text
 * stays the same until the session steps or renders. */
PILEUS_API pileus_code pileus_session_report(const pileus_session* session, char* text, size_t size,
                                             size_t* needed, pileus_error* error);

#include "pileus_compare.h"
#include "pileus_living.h"
#include "pileus_work.h"

/** Turns `position_m` about the vertical axis through `target_m`, counter-clockwise seen from
 * above, by the bits of the program's animation.camera_orbit_deg. */
PILEUS_API void pileus_orbit(const double position_m[3], const double target_m[3], double degrees,
                             double turned_m[3]);

#ifdef __cplusplus
}
#endif

#endif /* PILEUS_H */
