/* SPDX-License-Identifier: Apache-2.0
 * The C interface of pileus, all of it. C99; C++ programs may prefer pileus.hpp.
 *
 * A scene is text. A world is what of it depends on neither camera, light nor method: made once,
 * read only, shared by any number of sessions. A session is one camera, one light and one method
 * over a world: set what changed, step the light, render into memory of your own.
 *
 * Rules of all functions
 * - A result other than PILEUS_OK leaves outputs as they were; `error`, where not null, then holds
 *   the code and a line for each fault. Nothing is written to stdout or stderr, no signal handler
 *   or floating-point mode of yours is changed, nothing is kept outside handles.
 * - Handles are used by one thread at a time; different handles by as many threads as you like. A
 *   world and a scene are read only once made, so that threads share them.
 * - Structs are made by their pileus_*_default(), which has values that are fine as they are. It
 *   marks them with their size: a library that is newer or older than the header reads the part
 *   that both know, and structs that were cleared or never written are refused.
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

/** Of this header; the library's own by pileus_version. */
#define PILEUS_VERSION_MAJOR 1
#define PILEUS_VERSION_MINOR 0
#define PILEUS_VERSION_PATCH 0
/** What pileus_version() of the same version returns. */
#define PILEUS_VERSION_STRING "1.0.0-rc2"

/** Grows when functions or members are added; what is there keeps its meaning. */
#define PILEUS_API_VERSION 6

/* ---- Results and structs ----------------------------------------------------------------- */

/* Threads: all at once. Texts that are returned are the library's and stay. */

typedef enum pileus_code {
    PILEUS_OK = 0,
    PILEUS_ERROR_CHECK = 1, /**< kernels that give other bits than they must */
    PILEUS_ERROR_INPUT = 2, /**< an argument, a scene or a file of it */
    PILEUS_ERROR_LIMIT = 3, /**< out of memory, or more than a limit allows */
    PILEUS_ERROR_IO = 4     /**< reading or writing failed half way */
} pileus_code;

/** Longer messages end in "...". */
typedef struct pileus_error {
    uint32_t struct_size;
    int32_t code; /**< a pileus_code */
    char message[2040];
} pileus_error;

/** Clears a struct and marks it, for structs whose zeros are what you want:
 * `pileus_error error; PILEUS_INIT(error);` */
#define PILEUS_INIT(s) pileus_init(&(s), (uint32_t)sizeof(s))

/** Clears `size` bytes, 4 to 65535, and stores in the first four their number and a mark: this is
 * what `struct_size` holds. Nothing where `size` is out of range. */
PILEUS_API void pileus_init(void* pileus_struct, uint32_t size);

/** The same, and then the defaults of struct number `kind`, which pileus_*_default() know. */
PILEUS_API void pileus_default(uint32_t kind, void* pileus_struct, uint32_t size);

/** "major.minor.patch", before a release with "-rc1" and the like; and the PILEUS_API_VERSION that
 * the library was built with. */
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
    /** Not 0: sessions can give what output.layers of their scene names (pileus_frame.layers), and
     * make it in every picture. */
    int32_t layers;
} pileus_host;

/* ---- Scenes ------------------------------------------------------------------------------ */

/* Threads: a scene is read by any number at once, and set or freed by one while no other uses it.
 * Lifetime: until it is freed; worlds and sessions need it only while they are made. */
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

/** Sets a key of a scene as the program's --set does: pileus_scene_set(scene, "medium.0.albedo",
 * "0.9", &error). The value is TOML, or a text without quotes. The scene is read anew with it and
 * is as it was where that fails: PILEUS_ERROR_INPUT with a line for each fault. Worlds and sessions
 * made before do not change. One thread at a time, and none that reads the scene meanwhile. */
PILEUS_API pileus_code pileus_scene_set(pileus_scene* scene, const char* key, const char* value,
                                        pileus_error* error);
/** The same with `count` numbers: 1 is a number, more are a list. Finite. */
PILEUS_API pileus_code pileus_scene_set_numbers(pileus_scene* scene, const char* key,
                                                const double* values, uint32_t count,
                                                pileus_error* error);

/** The scene as text that reads as the same scene: what was read, with all that was set. TOML,
 * ended by a zero. `needed`: bytes with the zero; `text` may be null where `size` is 0. Too small a
 * size: PILEUS_ERROR_LIMIT. Relative paths in it begin where they began. */
PILEUS_API pileus_code pileus_scene_dump(const pileus_scene* scene, char* text, size_t size,
                                         size_t* needed, pileus_error* error);
PILEUS_API void pileus_scene_free(pileus_scene* scene);

/** A key that scenes may hold, as docs/scene.md lists them. Texts are the library's and stay. */
typedef struct pileus_key {
    uint32_t struct_size;
    uint32_t numbers;  /**< how many numbers a value has; 0: it is no number */
    double low, high;  /**< of each number */
    const char* name;  /**< "medium.N.albedo"; N: a whole number, from 0 on */
    const char* unit;  /**< "m", "deg", ...; "": none */
    const char* help;  /**< what it is, a sentence */
    char allowed[256]; /**< what a value may be, in words; longer ones end in "..." */
    char value[128];   /**< the default as TOML; "": none, `help` says what leaving it out means */
} pileus_key;
PILEUS_API uint32_t pileus_key_count(void);
/** Number `index`, from 0 on, in the order of docs/scene.md. */
PILEUS_API pileus_code pileus_key_at(uint32_t index, pileus_key* key, pileus_error* error);

/* ---- Worlds ------------------------------------------------------------------------------ */

/* Threads: worlds are made at once on any threads, and one world is used by any number at once.
 * Lifetime: until it and all of its sessions are freed; what its host's functions point to as long.
 */
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

/* Threads: different sessions at once; one session on any thread, but one at a time, functions that
 * only tell included. pileus_session_cancel alone may come at any time. Lifetime: until it is
 * freed, not while a call runs; it keeps its world, and its host's functions must stay as long.
 * Structs and arrays that are handed over are copied before a call returns, buffers of a frame
 * written. */
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
 * PILEUS_ERROR_INPUT in scenes with [atmosphere], which has its own sky, and a sun. */
typedef struct pileus_environment {
    uint32_t struct_size;
    int32_t present;
    float radiance[3];    /**< used without a map */
    uint32_t map_size[2]; /**< columns, rows; columns = 2 rows; both 0: no map */
    const float* map;     /**< [row][column][3]; null: keep the map there is, as it is */
    double map_scale, map_rotation_deg; /**< of `map`; scale 0 counts as 1 */
} pileus_environment;
PILEUS_API pileus_code pileus_session_set_environment(pileus_session* session,
                                                      const pileus_environment* sky,
                                                      pileus_error* error);

typedef struct pileus_ground {
    uint32_t struct_size;
    int32_t present;
    double altitude_m, albedo;
} pileus_ground;
PILEUS_API pileus_code pileus_session_set_ground(pileus_session* session,
                                                 const pileus_ground* ground, pileus_error* error);

typedef enum pileus_lamp_type {
    PILEUS_LAMP_POINT,
    PILEUS_LAMP_SPOT,
    PILEUS_LAMP_DIRECTIONAL
} pileus_lamp_type;
/** A light besides sun and sky; docs/lights.md has the units. */
typedef struct pileus_lamp {
    uint32_t struct_size, type;        /**< a pileus_lamp_type */
    double position_m[3], radius_m;    /**< point, spot; radius 0: a point */
    double direction[3];               /**< spot: where it shines; not 0 */
    double cone_deg, penumbra_deg;     /**< spot: (0, 360]; up to half of that */
    double azimuth_deg, elevation_deg; /**< directional: where it stands, as the sun */
    float light[3]; /**< radiant intensity; directional: irradiance on a plane that faces it */
    uint32_t reserved, shadow_samples; /**< not read; places on a sphere, 0: 8, 1: its middle */
} pileus_lamp;

/** Lights in place of all that the session had, the scene's included; up to 64, 0: none. Each
 * element has the size that the first one tells. Errors: those of a scene's [[light]]. */
PILEUS_API pileus_code pileus_session_set_lamps(pileus_session* session, const pileus_lamp* lights,
                                                uint32_t count, pileus_error* error);

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

/** Takes extinction, albedo, emission and phase function of each medium from another scene with as
 * many media, of which nothing else counts. Light begins anew; all that was set stays. Pictures
 * have the bits of a session that was made over a world of such a scene. Densities are not read or
 * made again where they are one medium of the program's own shapes, or cells of your memory.
 * PILEUS_ERROR_INPUT: a flight; densities of your memory but for one medium of cells;
 * PILEUS_ERROR_LIMIT. After a fault the session is as it was. */
PILEUS_API pileus_code pileus_session_set_media(pileus_session* session, const pileus_scene* scene,
                                                pileus_error* error);

typedef enum pileus_depth {
    PILEUS_DEPTH_DISTANCE = 0, /**< metres along each pixel's ray; infinity: nothing */
    PILEUS_DEPTH_VIEW_Z = 1,   /**< metres along the view's axis; infinity: nothing */
    PILEUS_DEPTH_BUFFER =
        2 /**< a depth buffer of the camera's projection, 0..1; its far end: nothing */
} pileus_depth;

/** Opaque things of the caller, which end rays: terrain, aircraft, runways. */
typedef struct pileus_depth_image {
    uint32_t struct_size;
    uint32_t kind;       /**< a pileus_depth */
    const float* values; /**< as many as the camera has pixels; null: nothing solid */
    int64_t stride;      /**< bytes from row to row; 0: tightly packed */
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
typedef struct pileus_progress {
    uint32_t struct_size;
    uint32_t whole;        /**< units that a first picture should have: a ring; samples; 0: none */
    uint64_t unit_photons; /**< photons or paths of one unit */
    uint64_t units;        /**< of light that the next picture shows */
    char unit[24];         /**< "generation", "sample" or "" */
} pileus_progress;
PILEUS_API pileus_code pileus_session_progress(const pileus_session* session, pileus_progress* info,
                                               pileus_error* error);

/** Traces `units` units of light for the camera and lights as they are set now: generations of
 * photons (collectors; the oldest of a full ring give way), samples of every pixel (path; a new
 * camera, light or frame begins anew); nothing in methods without (raymarch). Never counts time.
 * `done`, where not null: how many were traced before `stop` ended it. */
PILEUS_API pileus_code pileus_session_step(pileus_session* session, uint32_t units, uint32_t* done,
                                           pileus_error* error);

/** Ends one call early, the one that runs or else the next: pileus_session_step returns PILEUS_OK
 * with fewer units in `done`; pileus_session_render of a marched picture PILEUS_ERROR_CHECK, and
 * its buffers are not to be shown; it counts as a picture for what goes by their number. The one
 * function of a session that any thread may call while another uses it, a signal handler, too.
 * Nothing happens where `session` is null, a flight's, or drawn by pileus_clouds_render. */
PILEUS_API void pileus_session_cancel(pileus_session* session);

typedef enum pileus_format {
    PILEUS_FORMAT_RGBA8_SRGB =
        0,                     /**< 4 bytes a pixel, tone curve and sRGB as in the program's PNGs */
    PILEUS_FORMAT_RGBA16F = 1, /**< 4 IEEE halves, linear radiance */
    PILEUS_FORMAT_RGBA32F = 2, /**< 4 floats, linear radiance */
    PILEUS_FORMAT_BGRA8_SRGB = 3,  /**< as RGBA8, blue first */
    PILEUS_FORMAT_RGB10A2_SRGB = 4 /**< a 32-bit word, red in its lowest 10 bits; curve as RGBA8 */
} pileus_format;

typedef enum pileus_depth_format {
    PILEUS_DEPTH_R32F = 0, /**< a float */
    PILEUS_DEPTH_R16F = 1  /**< an IEEE half, of which 65504 is the largest before infinity */
} pileus_depth_format;

typedef enum pileus_blend {
    PILEUS_BLEND_REPLACE =
        0, /**< the whole picture, sky and ground behind the media; alpha: the media's */
    PILEUS_BLEND_OVER = 1, /**< the media over what the buffer holds */
    PILEUS_BLEND_MEDIA = 2 /**< the media alone, premultiplied by their alpha */
} pileus_blend;

/** A layer of a picture, numbers of one channel: one of docs/formats.md, "Pictures out", that
 * every picture has, as "R", or output.layers of the scene of a session whose host asked for
 * layers, as "tau". */
typedef struct pileus_layer {
    uint32_t struct_size;
    uint32_t reserved;
    const char* name;
    float* values;  /**< as many as the camera has pixels, rows as pileus_frame.bottom_up tells */
    int64_t stride; /**< bytes from row to row; 0: tightly packed */
} pileus_layer;

/** Buffers of the caller, for one picture. */
typedef struct pileus_frame {
    uint32_t struct_size;
    void* colour;          /**< first byte of the first row in memory; may be null */
    int64_t colour_stride; /**< bytes from row to row; 0: tightly packed */
    uint32_t format;       /**< a pileus_format */
    uint32_t blend;        /**< a pileus_blend */
    int32_t bottom_up; /**< not 0: the first row in memory is the picture's lowest; both buffers */
    float exposure_stops;  /**< 8 and 10 bits: doubles or halves the light; -100 to 100 */
    float* depth;          /**< where half of the light is gone, or the opaque thing; null: none */
    int64_t depth_stride;  /**< bytes; 0: tightly packed */
    uint32_t depth_kind;   /**< a pileus_depth */
    uint64_t* hash;        /**< null: none is made; else of the whole picture, as the program's */
    uint32_t depth_format; /**< a pileus_depth_format: what lies at `depth` */
    uint32_t layer_count;  /**< of `layers`, up to 256; not of flights and skies of clouds */
    /** Each as a file of the picture would have it, of which a hand-over mixes none. Elements have
     * the size that the first tells. PILEUS_ERROR_INPUT: one that the picture has not. */
    const pileus_layer* layers;
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
 * with the zero; `text` may be null where `size` is 0. Too small a size: PILEUS_ERROR_LIMIT. The
 * text stays the same until the session steps or renders. */
PILEUS_API pileus_code pileus_session_report(const pileus_session* session, char* text, size_t size,
                                             size_t* needed, pileus_error* error);

/* ---- Work -------------------------------------------------------------------------------- */

/* Threads and lifetime: as the other functions of a session. */

/** What a frame may cost, in units that no clock decides: the same work makes the same bits on any
 * machine. 0 in a member: as the scene has it. */
typedef struct pileus_work {
    uint32_t struct_size;
    uint32_t scale;    /**< 1, 2, 4: one pixel of so many along x and y is marched */
    uint32_t temporal; /**< 2, 4: the same by temporal reprojection; where the scene has it alone */
    uint32_t steps;    /**< most of a ray: raymarch, optical-depth; bins: particles, marched */
    uint32_t light_refresh; /**< 1 to 64: frames in which sunlight on nodes follows the sun */
    uint32_t reserved;
    uint64_t photons; /**< of one unit of light, at most the scene's: collectors, and photon-grid
                           with ring = true */
} pileus_work;

/** For the steps and pictures from now on. PILEUS_ERROR_INPUT: a member that the session's method
 * does not have, or more photons than the scene's; in a flight also more steps. */
PILEUS_API pileus_code pileus_session_set_work(pileus_session* session, const pileus_work* work,
                                               pileus_error* error);
/** As it is set now, members filled in that the method has. */
PILEUS_API pileus_code pileus_session_work(const pileus_session* session, pileus_work* work,
                                           pileus_error* error);

/** What the governor remembers. Set target_s; the rest is its own. */
typedef struct pileus_governor {
    uint32_t struct_size;
    uint32_t level;  /**< 0: all of the scene's work; each more is less work */
    double target_s; /**< wall time that a frame may take, above 0 */
    uint32_t own_counts[4];
    double own_times[16];
} pileus_governor;

/** Chooses the work of the next frame. `frame_s`: seconds that the frame before took, by your own
 * clock; 0 before the first. The library looks at no clock: the same seconds give the same work.
 * Keep `work` beside the frame, set it, and the frame can be made again to the bit. */
PILEUS_API pileus_code pileus_session_govern(const pileus_session* session,
                                             pileus_governor* governor, double frame_s,
                                             pileus_work* work, pileus_error* error);

/** Maximum cost of a frame: one unit of light (pileus_session_step) and one picture. It
 * depends on the work, the sizes and the kinds of light, not on where the camera is or what it
 * sees. */
typedef struct pileus_units {
    uint32_t struct_size;
    uint32_t reserved;
    uint64_t pixels;  /**< of the picture */
    uint64_t rays;    /**< pixels that are marched; path: samples of pixels */
    uint64_t samples; /**< places at which these rays look up the medium; path: 0 */
    uint64_t photons; /**< of the unit of light: collectors, photon-grid */
} pileus_units;

/** Of a frame of this work; null: as it is set now. Ask once camera, lights and depths are set: a
 * picture that cannot use the one before (`temporal`) has all its pixels marched.
 * PILEUS_ERROR_INPUT: as pileus_session_set_work; or what a frame takes depends on the view:
 * particles, billboards, a periodic medium that is marched by its cells. */
PILEUS_API pileus_code pileus_session_most_units(pileus_session* session, const pileus_work* work,
                                                 pileus_units* most, pileus_error* error);

/** What one unit of each costs where it costs the most, in seconds, instructions or whatever adds
 * up; `fixed`: of a frame whatever its work. 0 and more. docs/flight.md, "Work". */
typedef struct pileus_costs {
    uint32_t struct_size;
    uint32_t reserved;
    double fixed, pixel, ray, sample, photon;
} pileus_costs;

/** The governor's first work, from all to less and less, whose most units cost no more than `most`:
 * no clock, and no frame above it. PILEUS_ERROR_LIMIT: even the least costs more; `work` is that.
 * Errors: those of pileus_session_most_units. */
PILEUS_API pileus_code pileus_session_fit(pileus_session* session, const pileus_costs* costs,
                                          double most, pileus_work* work, pileus_error* error);

/* ---- Hand-over --------------------------------------------------------------------------- */

/* Threads: both sessions are used by this call alone. Lifetime: each stays its own handle. */

/** Exchanges two sessions over different worlds: from its next picture on `session` draws the world
 * of `next` by the light that `next` was given, and its own last picture fades away over `frames`
 * pictures; picture i of them has i / frames of the new world. 0 and 1 switch at once, and so does
 * a session without a picture; at most 10 000. `next` gets what `session` drew before, to be freed
 * or to be lit over a later world (a session belongs to its world: make another one). A hand-over
 * while an earlier one fades goes on from the mixture that was shown.
 *
 * `session` keeps its camera, depth image, placement and frame number, its work where both scenes
 * allow the same, its threads, and its host's functions; memory goes back to whom it came from.
 * Sun, sky, ground and lights are those that were set in `next`: set them there before it is lit.
 *
 * Call it between two frames, before what is set for the next one. Neither session may be in use
 * meanwhile. PILEUS_ERROR_INPUT: another method, another size of pictures, another number of
 * threads, a session of a flight or without media, the same session twice; a view that `next`
 * cannot have. PILEUS_ERROR_LIMIT: out of memory. After a fault `session` is as it was.
 * docs/living.md has a loop that uses it. */
PILEUS_API pileus_code pileus_session_hand_over(pileus_session* session, pileus_session* next,
                                                uint32_t frames, pileus_error* error);

/* ---- Skies of many clouds ---------------------------------------------------------------- */

/* The sky around clouds is a session over a scene without media: its camera, sun, air or
 * environment, ground, depths and frame number are those of the pictures, and are set in it. A kind
 * is a world and a scene as for a session of its own. docs/clouds.md
 * Threads: one uses a sky and its clouds at a time. Lifetime: clouds keep their sky; worlds and
 * scenes of kinds are needed only while they are added. */
typedef struct pileus_clouds pileus_clouds;

/** Clouds in a sky, none at first. `sky` may be drawn by itself, too, and is then without clouds;
 * freed before them it goes with the last of its clouds. PILEUS_ERROR_INPUT: a session with media,
 * one of a flight. */
PILEUS_API pileus_code pileus_clouds_create(pileus_session* sky, pileus_clouds** clouds,
                                            pileus_error* error);
PILEUS_API void pileus_clouds_free(pileus_clouds* clouds);

/** A kind of cloud: media in boxes, with a method of sessions. Of its scene sun, sky, air, ground,
 * lights and camera do not count. `kind` is its number, from 0 on. World and scene may be freed
 * afterwards. */
PILEUS_API pileus_code pileus_clouds_add_kind(pileus_clouds* clouds, const pileus_world* world,
                                              const pileus_scene* scene, uint32_t* kind,
                                              pileus_error* error);

/** Where a cloud stands: turned about the z axis through its kind's origin (counter-clockwise seen
 * from above), made larger, then shifted. */
typedef struct pileus_cloud {
    uint32_t struct_size;
    uint32_t kind;
    double offset_m[3]; /**< each within 1e7 */
    double yaw_deg;     /**< -360 to 360; clouds of one kind and turn share their light */
    double scale;       /**< 0.01 to 100, 0: 1; the optical thickness stays as it is */
    double
        presence; /**< above 0 to 1, 0: 1; factor on its alpha and light, to let it come and go */
} pileus_cloud;

/** All clouds, up to 1000, in place of those that there were; each element has the size that the
 * first tells.
 * One that has the number, kind, turn and size that it had keeps its pictures, wherever it goes.
 * What a new kind or turn needs is lit with the next picture. */
PILEUS_API pileus_code pileus_clouds_place(pileus_clouds* clouds, const pileus_cloud* places,
                                           uint32_t count, pileus_error* error);

/** How exact far clouds are. 0 in a member: what is in brackets. */
typedef struct pileus_cloud_detail {
    uint32_t struct_size;
    int32_t off;           /**< not 0: every cloud is marched whole in every picture */
    double error_px;       /**< pixels that parts of a far cloud may be off, 0.001 to 16 [0.5] */
    double near_px;        /**< clouds of that size are marched in every picture [256] */
    uint32_t near_scale;   /**< of those one pixel of so many along x and y, 1, 2, 4 [2] */
    uint32_t blend_frames; /**< over which an impostor of a far cloud cross-fades to the next [8] */
    double sharpness;      /**< texels of a far cloud for a pixel along x and y, 0.25 to 4 [1] */
    uint64_t frame_pixels; /**< of far clouds that one picture may draw anew [60000] */
    double sun_deg;        /**< that the sun may move before clouds are lit anew, to 10 [0.5] */
} pileus_cloud_detail;
PILEUS_API pileus_code pileus_clouds_set_detail(pileus_clouds* clouds,
                                                const pileus_cloud_detail* detail,
                                                pileus_error* error);

/** Draws sky, ground and clouds for what the sky is set to now, as pileus_session_render does. */
PILEUS_API pileus_code pileus_clouds_render(pileus_clouds* clouds, const pileus_frame* frame,
                                            pileus_error* error);

/** Of the last picture. */
typedef struct pileus_cloud_stats {
    uint32_t struct_size;
    uint32_t clouds, visible; /**< in all; of them in the picture */
    uint32_t marched;         /**< drawn anew for this picture */
    uint32_t captured;        /**< far clouds whose picture was drawn anew */
    uint32_t lit;             /**< kinds in a turn that were lit */
    uint64_t marched_pixels, captured_pixels;
    double worst_px; /**< largest error of a far cloud's picture, in pixels */
} pileus_cloud_stats;
PILEUS_API pileus_code pileus_clouds_stats(const pileus_clouds* clouds, pileus_cloud_stats* stats,
                                           pileus_error* error);

/* ---- The whole sky ----------------------------------------------------------------------- */

/* All that is above a host's ground in one picture: air, haze, sun, sheets of clouds and clouds by
 * number, sorted by depth in each pixel, over what the host has drawn. docs/whole-sky.md
 * Threads: one uses a sky, its session and its clouds at a time. Lifetime: until it is freed. */
typedef struct pileus_sky pileus_sky;

/** From a scene without [[medium]]: its [atmosphere] or sky, its [clouds], its [weather]. `host`
 * may be null; the scene may be freed afterwards. Errors: those of a scene's files. */
PILEUS_API pileus_code pileus_sky_create(const pileus_scene* scene, const pileus_host* host,
                                         pileus_sky** sky, pileus_error* error);
PILEUS_API void pileus_sky_free(pileus_sky* sky);

/** The sky's session, in which camera, sun, ground and frame number are set; and its clouds, for
 * kinds, places and detail. Both are the sky's and are not freed; of a null sky null. */
PILEUS_API pileus_session* pileus_sky_session(pileus_sky* sky);
PILEUS_API pileus_clouds* pileus_sky_clouds(pileus_sky* sky);

/** One more sheet of clouds, up to 8: media that stay where their scene has them, without end or in
 * boxes, drawn in each picture by the scene's own method. Of its scene sun, sky, air, ground and
 * camera do not count. */
PILEUS_API pileus_code pileus_sky_add_layer(pileus_sky* sky, const pileus_world* world,
                                            const pileus_scene* scene, pileus_error* error);

/** Clouds, haze, fog and rain of a report, METAR or SPECI, in place of all clouds and layers there
 * are. `seed`: other clouds of the same report; `elevation_m`: of the station. Needs [atmosphere].
 * PILEUS_ERROR_INPUT: a report that cannot be read, and all is as it was. docs/metar.md */
PILEUS_API pileus_code pileus_sky_set_weather(pileus_sky* sky, const char* metar, uint32_t seed,
                                              double elevation_m, pileus_error* error);

/** Places sun, moon and stars so many hours after the scene's date and time, which it must have;
 * within 1e6. */
PILEUS_API pileus_code pileus_sky_set_time(pileus_sky* sky, double hours, pileus_error* error);

/** Where all clouds and layers are beside their places: by wind, or because a host's own origin has
 * moved. Within 1e7 m. Nothing is drawn or lit anew for it. */
PILEUS_API pileus_code pileus_sky_move(pileus_sky* sky, const double offset_m[3],
                                       pileus_error* error);

/** Draws all of it. `depth`: what the host has drawn, of the camera as it is set; null: as it was
 * set last. PILEUS_BLEND_OVER: where the host has something, that is seen through air and clouds;
 * where it has nothing, and before the sky's own ground, the sky takes its place.
 * PILEUS_BLEND_MEDIA: the same to be laid over it later, light and alpha (the mean of R, G, B).
 * PILEUS_BLEND_REPLACE: as pileus_clouds_render. */
PILEUS_API pileus_code pileus_sky_render(pileus_sky* sky, const pileus_depth_image* depth,
                                         const pileus_frame* frame, pileus_error* error);

/** What a sky does at a place; light without the host's own things. */
typedef struct pileus_sky_light {
    uint32_t struct_size;
    float sun_share;      /**< of sunlight that clouds let through; 0: a sun below the horizon */
    double position_m[3]; /**< yours: where */
    float sun[3];         /**< irradiance on a plane that faces the sun, through air and clouds */
    float level[3];       /**< irradiance of the sky on level ground */
    double extinction_per_m; /**< of clouds there; visibility 3.912 / extinction, m */
    /** Irradiance over pi, by channel, of sky and ground on a plane of normal (x, y, z): the sum of
     * these times 1, x, y, z, xy, yz, zx, xx - yy, 3 zz - 1. */
    float around[3][9];
} pileus_sky_light;

/** Fills `count` of them, up to 65536, by the sun as it is set and shadows as they follow it. */
PILEUS_API pileus_code pileus_sky_light_at(pileus_sky* sky, pileus_sky_light* places,
                                           uint32_t count, pileus_error* error);

typedef enum pileus_shadow_format {
    PILEUS_SHADOW_R8 = 0,    /**< a byte, 255: all of the sun */
    PILEUS_SHADOW_RGBA8 = 1, /**< the byte three times, and 255 */
    PILEUS_SHADOW_R16F = 2,  /**< an IEEE half, 0 to 1 */
    PILEUS_SHADOW_R32F = 3   /**< a float, 0 to 1 */
} pileus_shadow_format;

/** A map of the sunlight that clouds let through to a host's terrain. Texels run from west to east,
 * rows from the north to the south. */
typedef struct pileus_shadow_map {
    uint32_t struct_size;
    uint32_t width, height;     /**< texels, up to 16384 */
    uint32_t format;            /**< a pileus_shadow_format */
    double low_m[2], size_m[2]; /**< x, y of the south-west corner; extents */
    double altitude_m;          /**< of all texels, where `heights` is null */
    const float* heights;       /**< altitude of each, tightly packed, rows as in memory; null */
    void* texels;
    int64_t stride;           /**< bytes from row to row; 0: tightly packed */
    int32_t bottom_up;        /**< not 0: the first row in memory is the southern one */
    uint32_t first_row, rows; /**< rows of memory to write; rows 0: all from first_row on */
} pileus_shadow_map;

/** Writes rows of it, by shadows as they follow the sun. A few rows a frame refresh it in slices.
 * All 0 where the sun is below the horizon. */
PILEUS_API pileus_code pileus_sky_shadow(pileus_sky* sky, const pileus_shadow_map* map,
                                         pileus_error* error);

/** What the clear air and haze do between the camera and something `metres` away: `left` of its
 * R, G, B, and `light` that is added. Infinity: left 0, and the light of the sky there. */
PILEUS_API pileus_code pileus_sky_air(pileus_sky* sky, const double direction[3], double metres,
                                      float left[3], float light[3], pileus_error* error);

/* ---- Flights ----------------------------------------------------------------------------- */

/* Sessions whose memory lies in one block of the caller; none is asked for once one is open. All of
 * it is in the library of the flight profile, too, with the pileus_session_* of one method.
 * docs/flight.md says what is promised and how it is checked.
 * Threads: as sessions; different blocks at once. Lifetime: that of the block. */

/** What the head of a packed scene tells. The program makes one: `pileus pack SCENE -o FILE`. */
typedef struct pileus_packed {
    uint32_t struct_size;
    uint32_t width, height; /**< of the scene's camera, pixels; the most that frames may have */
    uint32_t reserved;
    /** That a session of it needs, with threads of one; with pileus_flight.depth up to 16 bytes a
     * pixel and 1 KiB more. */
    uint64_t block_bytes;
    char method[24];
    uint64_t in_place_bytes; /**< the same with pileus_flight.in_place */
} pileus_packed;

/** Reads the head and compares the digest of all bytes, head included. PILEUS_ERROR_INPUT: no
 * packed scene, one of another version, or one that was changed. */
PILEUS_API pileus_code pileus_packed_read(const void* scene, size_t scene_bytes,
                                          pileus_packed* packed, pileus_error* error);

/** What a session of a flight is made of. All pointers but `scene` must stay valid as long as the
 * session; `scene`, too, with `in_place`. */
typedef struct pileus_flight {
    uint32_t struct_size;
    uint32_t threads;  /**< bodies that `run` gets at a time; 0 or 1: the caller's thread alone */
    const void* scene; /**< packed; without `in_place` read only while the session is opened */
    size_t scene_bytes;
    void* block; /**< at any address */
    size_t block_bytes;
    void* user; /**< handed to the callbacks */
    /** As pileus_host.run; may be null. */
    void (*run)(void* user, uint32_t count, void (*body)(void* data, uint32_t index), void* data);
    /** As pileus_host.log; may be null. */
    void (*log)(void* user, const char* line);
    const char* isa; /**< null: the widest of this machine that was compiled in */
    /** The first picture is drawn into it while the session is opened. Frames to come may be of any
     * other kind: other formats, blends, hashes, depths. */
    const pileus_frame* frame;
    int32_t depth; /**< not 0: frames will get depth images (pileus_session_set_depth) */
    /** Not 0: densities and other arrays of numbers are read where they lie in `scene`, which must
     * begin at a multiple of 64 bytes and is never written to. Machines that are not little-endian
     * copy them nevertheless. The pictures are the same. */
    int32_t in_place;
} pileus_flight;

/** Makes a session in the block: world, light of the first picture, that picture. Afterwards
 * nothing of it asks anyone for memory: functions of pileus_session_* take what they need for the
 * time of a call from the rest of the block, and give all of it back: PILEUS_ERROR_LIMIT where that
 * is too little, and the session goes on. A picture that would be larger, a sky map, more lights
 * than the packed scene's are refused. The session ends with the block: forget both. Errors: those
 * of pileus_packed_read; PILEUS_ERROR_LIMIT: the block is smaller than the packed scene tells, or
 * needs. */
PILEUS_API pileus_code pileus_flight_open(const pileus_flight* flight, pileus_session** session,
                                          pileus_error* error);

/** Where an ordinary library, which has small memory of its own, gives that back; the block, which
 * may be gone already, is not looked at. In a library of the flight profile nothing happens. */
PILEUS_API void pileus_flight_close(pileus_session* session);

/** What has been taken of the block, bytes. */
typedef struct pileus_flight_use {
    uint32_t struct_size;
    uint32_t reserved;
    uint64_t block_bytes; /**< as given */
    uint64_t kept_bytes;  /**< of what the session is */
    uint64_t open_bytes;  /**< the most while it was made */
    uint64_t frame_bytes; /**< the most that a call took since */
    uint64_t frame_room;  /**< what calls may take */
    uint64_t taken;       /**< pieces that calls took and gave back */
    uint64_t refused;     /**< pieces for which there was no room: 0, or the block is too small */
    uint64_t kept;        /**< pieces that calls did not give back: 0, or the library is wrong */
    uint64_t lost;        /**< pieces of the session that calls gave back: likewise */
} pileus_flight_use;
PILEUS_API pileus_code pileus_flight_usage(const pileus_session* session, pileus_flight_use* use,
                                           pileus_error* error);

/* ---- Comparing --------------------------------------------------------------------------- */

/* Threads: all at once. Pictures are read while a call runs. */

/** Linear radiances in the caller's memory, rows from the top. */
typedef struct pileus_picture {
    uint32_t struct_size;
    uint32_t width, height;
    uint32_t channels;   /**< 3: R G B; 4: and alpha */
    const float* values; /**< [row][column][channels] */
    int64_t stride;      /**< bytes from row to row; 0: tightly packed */
} pileus_picture;

/** As `pileus compare` prints them: docs/compare.md, "Figures". */
typedef struct pileus_figures {
    uint32_t struct_size;
    int32_t identical;
    uint64_t pixels, cloud_pixels, not_finite;
    double mean, mean_reference;
    double rmse, relmse, relmse_trimmed;
    double bias, largest;
    uint32_t largest_at[2]; /**< column, row */
    double percentile_999, relative_percentile_999;
    double flip, flip_percentile_99, flip_largest; /**< of HDR-FLIP; NaN where it is left out */
} pileus_figures;

/** Measures `a` against `reference`, both of one size. Pixels count whose alpha in the reference is
 * above `alpha_least` (the program: 0.02); below 0, or without an alpha, all do. FLIP, over all
 * pixels, takes longer than all the rest. `host` may be null. */
PILEUS_API pileus_code pileus_compare(const pileus_picture* a, const pileus_picture* reference,
                                      double alpha_least, int32_t with_flip,
                                      const pileus_host* host, pileus_figures* figures,
                                      pileus_error* error);

/* ---- Defaults ---------------------------------------------------------------------------- */

#ifdef __cplusplus
#define PILEUS_INLINE inline
#else
#define PILEUS_INLINE static inline
#endif
/* clang-format off */
#define PILEUS_STRUCT(kind, name) \
    PILEUS_INLINE pileus_##name pileus_##name##_default(void) { \
        pileus_##name made; \
        pileus_default(kind, &made, (uint32_t)sizeof made); \
        return made; \
    }
/* clang-format on */

/* What differs from 0: */
PILEUS_STRUCT(0, error)
PILEUS_STRUCT(0, host) /* all threads, the C runtime's memory */
PILEUS_STRUCT(0, plan)
PILEUS_STRUCT(1, particles) /* strides of tightly packed values */
PILEUS_STRUCT(0, density)
PILEUS_STRUCT(2, camera)      /* up z, fov_deg 40; its place and target are yours */
PILEUS_STRUCT(3, sun)         /* present, elevation_deg 45, irradiance 1 */
PILEUS_STRUCT(4, environment) /* present, map_scale 1; black */
PILEUS_STRUCT(5, ground)      /* present, albedo 0.2 */
PILEUS_STRUCT(6, lamp) /* a point of intensity 1; as a spot down, cone_deg 40; elevation 45 */
PILEUS_STRUCT(0, placement)
PILEUS_STRUCT(0, depth_image) /* distances */
PILEUS_STRUCT(0, progress)
PILEUS_STRUCT(0, layer)
PILEUS_STRUCT(0, frame) /* RGBA8, the whole picture in place of what the buffer holds */
PILEUS_STRUCT(0, stats)
PILEUS_STRUCT(0, work)     /* as the scene has it */
PILEUS_STRUCT(7, governor) /* target_s 1/30 */
PILEUS_STRUCT(0, units)
PILEUS_STRUCT(0, costs)
PILEUS_STRUCT(8, cloud)        /* scale 1, presence 1 */
PILEUS_STRUCT(9, cloud_detail) /* what is in brackets there */
PILEUS_STRUCT(0, cloud_stats)
PILEUS_STRUCT(0, sky_light)
PILEUS_STRUCT(0, shadow_map) /* R8, all rows */
PILEUS_STRUCT(0, packed)
PILEUS_STRUCT(0, flight) /* the caller's thread alone */
PILEUS_STRUCT(0, flight_use)
PILEUS_STRUCT(10, picture) /* three channels */
PILEUS_STRUCT(0, figures)
PILEUS_STRUCT(0, key)

/* ---- Helpers ----------------------------------------------------------------------------- */

/* Threads: all at once. */

/** Turns `position_m` about the vertical axis through `target_m`, counter-clockwise seen from
 * above, by the bits of the program's animation.camera_orbit_deg. */
PILEUS_API void pileus_orbit(const double position_m[3], const double target_m[3], double degrees,
                             double turned_m[3]);

/* ---- Old names --------------------------------------------------------------------------- */

/* Those before 1.0, which end with 1.0.0; PILEUS_NO_OLD_NAMES leaves them out. docs/migration.md */
#ifndef PILEUS_NO_OLD_NAMES
#define PILEUS_CHECK_FAILED PILEUS_ERROR_CHECK
#define PILEUS_BAD_INPUT PILEUS_ERROR_INPUT
#define PILEUS_LIMIT PILEUS_ERROR_LIMIT
#define PILEUS_IO PILEUS_ERROR_IO
#define PILEUS_POINT PILEUS_LAMP_POINT
#define PILEUS_SPOT PILEUS_LAMP_SPOT
#define PILEUS_DIRECTIONAL PILEUS_LAMP_DIRECTIONAL
#define PILEUS_REPLACE PILEUS_BLEND_REPLACE
#define PILEUS_OVER PILEUS_BLEND_OVER
#define PILEUS_MEDIA PILEUS_BLEND_MEDIA
#define PILEUS_DISTANCE PILEUS_DEPTH_DISTANCE
#define PILEUS_VIEW_Z PILEUS_DEPTH_VIEW_Z
#define PILEUS_BUFFER PILEUS_DEPTH_BUFFER
#define PILEUS_RGBA8_SRGB PILEUS_FORMAT_RGBA8_SRGB
#define PILEUS_RGBA16F PILEUS_FORMAT_RGBA16F
#define PILEUS_RGBA32F PILEUS_FORMAT_RGBA32F
#define pileus_light_type pileus_lamp_type
#define pileus_light pileus_lamp
#define pileus_light_info pileus_progress
#if defined(__GNUC__)
#define PILEUS_OLD(name) __attribute__((deprecated("use " name)))
#else
#define PILEUS_OLD(name)
#endif
PILEUS_OLD("pileus_session_set_lamps")
PILEUS_INLINE pileus_code pileus_session_set_lights(pileus_session* session,
                                                    const pileus_lamp* lamps, uint32_t count,
                                                    pileus_error* error) {
    return pileus_session_set_lamps(session, lamps, count, error);
}
PILEUS_OLD("pileus_session_set_environment")
PILEUS_INLINE pileus_code pileus_session_set_sky(pileus_session* session,
                                                 const pileus_environment* environment,
                                                 pileus_error* error) {
    return pileus_session_set_environment(session, environment, error);
}
PILEUS_OLD("pileus_session_progress")
PILEUS_INLINE pileus_code pileus_session_light(const pileus_session* session,
                                               pileus_progress* progress, pileus_error* error) {
    return pileus_session_progress(session, progress, error);
}
#endif /* PILEUS_NO_OLD_NAMES */

#ifdef __cplusplus
}
#endif

#endif /* PILEUS_H */
