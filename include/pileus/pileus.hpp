// SPDX-License-Identifier: Apache-2.0
// The C++17 interface of pileus, all of it: owners over the functions of pileus.h.
//
// One header without any library, so that it suits any compiler and any build of the library.
// Nothing throws, and neither exceptions nor RTTI are needed; what a host lends must not throw
// either. What may fail returns a Status or a Result, which holds pileus.h's code and message.
//
// - Lengths are metres, angles degrees, radiances linear R G B. x points east, y north, z up; an
//   azimuth counts from north (+y) towards east (+x).
// - Vectors are taken from any type with members x, y, z, and turn into it: GLM's, your own.
//   Matrices are anything whose m[column][row] is a number.
// - Owners move and are not copied; an empty one answers every call with kBadInput. One thread uses
//   a session, or a sky with its session and clouds, at a time; scenes and worlds are read only and
//   may be shared.
// - The namespace is pileus::embed, as the library keeps its own Scene, World and Session in pileus
//   and its kernels in pileus::host: one program, such as a test, may include both.
//
// docs/embedding.md shows how to use all of this; tests/embed/examples/frame_loop.cpp does.
#ifndef PILEUS_HPP
#define PILEUS_HPP

#include <pileus/pileus.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace pileus::embed {

// ---- Results and what a host lends -------------------------------------------------------

enum class Code : std::int32_t {
    kOk = PILEUS_OK,
    kCheckFailed = PILEUS_ERROR_CHECK,  ///< kernels that give other bits than they must
    kBadInput = PILEUS_ERROR_INPUT,     ///< an argument, a scene or a file of it
    kLimit = PILEUS_ERROR_LIMIT,        ///< out of memory, or more than a limit allows
    kIo = PILEUS_ERROR_IO               ///< reading or writing failed half way
};

/// How a call ended: true in an `if` where it worked, else with a line for each fault.
class [[nodiscard]] Status {
public:
    Status() = default;
    Status(Code code, std::string message) : code_(code), message_(std::move(message)) {}

    explicit operator bool() const { return code_ == Code::kOk; }
    Code code() const { return code_; }
    const std::string& message() const { return message_; }

private:
    Code code_ = Code::kOk;
    std::string message_;
};

/// A value, or why there is none. Without one `*result` is an empty T.
template <class T>
class [[nodiscard]] Result {
public:
    Result(T value) : value_(std::move(value)) {}
    Result(Status status) : status_(std::move(status)) {}

    explicit operator bool() const { return bool(status_); }
    const Status& status() const { return status_; }
    Code code() const { return status_.code(); }
    const std::string& message() const { return status_.message(); }

    T& operator*() & { return value_; }
    const T& operator*() const& { return value_; }
    T&& operator*() && { return std::move(value_); }
    T* operator->() { return &value_; }
    const T* operator->() const { return &value_; }

private:
    Status status_;
    T value_{};
};

/// Called with each index in [0, count) by Host::run.
class Body {
public:
    Body(void (*body)(void*, std::uint32_t), void* data) : body_(body), data_(data) {}
    void operator()(std::uint32_t index) const { body_(data_, index); }

private:
    void (*body_)(void*, std::uint32_t);
    void* data_;
};

/// What the library may use. All may be left as it is: all threads, the C++ runtime's memory.
/// Worlds and sessions keep a copy as long as they need it. Functions never come from two threads
/// of one call at once, but for `allocate` and `release`; where `run` is given, they may come from
/// its threads. None of them may throw.
struct Host {
    std::uint32_t threads = 0;       ///< 0: as many as there are processors; at most 1024
    std::string isa;                 ///< "scalar", "avx2", ...; empty: the widest of this machine
    std::uint64_t memory_limit = 0;  ///< bytes by the plan; 0: the default limit
    /// Arrays: at least `bytes` at a multiple of `alignment`, or null. Both or neither.
    std::function<void*(std::size_t bytes, std::size_t alignment)> allocate;
    std::function<void(void* memory)> release;
    /// Calls body(index) once for each index in [0, count), in any order, and returns when all have
    /// returned. Empty: as in pileus.h.
    std::function<void(std::uint32_t count, Body body)> run;
    std::function<void(const char* line)> log;  ///< what is doubtful about a picture
    std::function<void(const char* stage, double share)> progress;  ///< share done, 0 to 1
    std::function<bool()> stop;  ///< asked now and then; true ends a step early
    bool layers = false;         ///< sessions can give their scene's output.layers: Frame::layers
};

namespace detail {

/// A struct of pileus.h, cleared and with its size.
template <class T>
T cleared() {
    T made;
    pileus_init(&made, static_cast<std::uint32_t>(sizeof made));
    return made;
}

/// call(error) as a Status.
template <class Call>
Status status_of(Call call) {
    pileus_error error = cleared<pileus_error>();
    const pileus_code code = call(&error);
    if (code == PILEUS_OK) return {};
    return {static_cast<Code>(code), error.message};
}

/// What call(text, size, needed, error) writes, without its zero.
template <class Call>
Result<std::string> text_of(Call call) {
    std::size_t needed = 0;
    Status status =
        status_of([&](pileus_error* error) { return call(nullptr, 0, &needed, error); });
    if (!status) return status;
    std::string text(needed, '\0');
    status = status_of([&](pileus_error* error) { return call(&text[0], needed, &needed, error); });
    if (!status) return status;
    text.pop_back();
    return text;
}

/// How many, for the C interface; more than it can count is more than it takes.
inline std::uint32_t count_of(std::size_t n) {
    return n < UINT32_MAX ? static_cast<std::uint32_t>(n) : UINT32_MAX;
}

template <class Vector, class Number>
void store(const Vector& from, Number (&to)[3]) {
    to[0] = from.x, to[1] = from.y, to[2] = from.z;
}

template <class Matrix>
void store(const Matrix& from, double (&to)[16]) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            to[4 * column + row] = static_cast<double>(from[column][row]);
}

/// A host that stays where it is, and the functions that lead to its own.
struct Lent {
    Host host;
    pileus_host given = cleared<pileus_host>();

    explicit Lent(const Host& from) : host(from) {
        given.threads = host.threads;
        given.isa = host.isa.empty() ? nullptr : host.isa.c_str();
        given.memory_limit = host.memory_limit;
        given.user = this;
        given.layers = host.layers ? 1 : 0;
        if (host.allocate)
            given.allocate = [](void* user, std::size_t bytes, std::size_t alignment) {
                return of(user).allocate(bytes, alignment);
            };
        if (host.release)
            given.release = [](void* user, void* memory) { of(user).release(memory); };
        if (host.run)
            given.run = [](void* user, std::uint32_t count, void (*body)(void*, std::uint32_t),
                           void* data) { of(user).run(count, Body(body, data)); };
        if (host.log) given.log = [](void* user, const char* line) { of(user).log(line); };
        if (host.progress)
            given.progress = [](void* user, const char* stage, double share) {
                of(user).progress(stage, share);
            };
        if (host.stop) given.stop = [](void* user) { return of(user).stop() ? 1 : 0; };
    }
    Lent(const Lent&) = delete;
    Lent& operator=(const Lent&) = delete;

private:
    static const Host& of(void* user) { return static_cast<const Lent*>(user)->host; }
};

using SharedLent = std::shared_ptr<const Lent>;

// What frees a handle keeps the hosts that it was made with, and outlives it.
struct FreeScene {
    void operator()(pileus_scene* scene) const { pileus_scene_free(scene); }
};
struct FreeWorld {
    SharedLent host;
    void operator()(pileus_world* world) const { pileus_world_free(world); }
};
struct FreeSession {
    SharedLent host;
    std::vector<SharedLent> lenders;  ///< of its arrays, which a hand-over exchanges with them
    std::shared_ptr<const void> owner = nullptr;  ///< which frees it, where it is another's

    void lent_by(const SharedLent& lender) {
        for (const SharedLent& own : lenders)
            if (own == lender) return;
        lenders.push_back(lender);
    }
    void operator()(pileus_session* session) const {
        if (owner == nullptr) pileus_session_free(session);
    }
};
struct FreeClouds {
    bool lent = false;  ///< a sky's, which frees them
    void operator()(pileus_clouds* clouds) const {
        if (!lent) pileus_clouds_free(clouds);
    }
};
/// A whole sky, with the hosts of all that it was made of, which outlive it.
struct SkyOwner {
    std::vector<SharedLent> lenders;
    pileus_sky* sky = nullptr;

    SkyOwner() = default;
    SkyOwner(const SkyOwner&) = delete;
    SkyOwner& operator=(const SkyOwner&) = delete;
    ~SkyOwner() { pileus_sky_free(sky); }
};

}  // namespace detail

// ---- Values ------------------------------------------------------------------------------

/// Three numbers, from and to any type with members x, y, z.
template <class T>
struct Vector3 {
    T x{}, y{}, z{};

    constexpr Vector3() = default;
    constexpr explicit Vector3(T all) : x(all), y(all), z(all) {}
    template <class A, class B, class C>
    constexpr Vector3(A a, B b, C c)
        : x(static_cast<T>(a)), y(static_cast<T>(b)), z(static_cast<T>(c)) {}
    template <class V, class = decltype(std::declval<const V&>().z)>
    constexpr Vector3(const V& v)
        : x(static_cast<T>(v.x)), y(static_cast<T>(v.y)), z(static_cast<T>(v.z)) {}
    template <class V, class = decltype(std::declval<const V&>().z)>
    constexpr operator V() const {
        V v{};
        v.x = static_cast<decltype(v.x)>(x), v.y = static_cast<decltype(v.y)>(y);
        v.z = static_cast<decltype(v.z)>(z);
        return v;
    }
    friend constexpr bool operator==(const Vector3& a, const Vector3& b) {
        return a.x == b.x && a.y == b.y && a.z == b.z;
    }
    friend constexpr bool operator!=(const Vector3& a, const Vector3& b) { return !(a == b); }
};
/// Two of them.
template <class T>
struct Vector2 {
    T x{}, y{};

    constexpr Vector2() = default;
    constexpr explicit Vector2(T all) : x(all), y(all) {}
    template <class A, class B>
    constexpr Vector2(A a, B b) : x(static_cast<T>(a)), y(static_cast<T>(b)) {}
    template <class V, class = decltype(std::declval<const V&>().y)>
    constexpr Vector2(const V& v) : x(static_cast<T>(v.x)), y(static_cast<T>(v.y)) {}
    template <class V, class = decltype(std::declval<const V&>().y)>
    constexpr operator V() const {
        V v{};
        v.x = static_cast<decltype(v.x)>(x), v.y = static_cast<decltype(v.y)>(y);
        return v;
    }
    friend constexpr bool operator==(const Vector2& a, const Vector2& b) {
        return a.x == b.x && a.y == b.y;
    }
    friend constexpr bool operator!=(const Vector2& a, const Vector2& b) { return !(a == b); }
};
using Vec2 = Vector2<double>;
using Vec3 = Vector3<double>;
using Rgb = Vector3<float>;
using Size3 = Vector3<std::uint32_t>;
using Size2 = Vector2<std::uint32_t>;

/// Sizes before memory.
struct Plan {
    Size3 cells{0};                 ///< of the media's grid
    std::uint64_t peak_bytes = 0;   ///< of a world and one session together, an upper bound
    std::uint64_t world_bytes = 0;  ///< of that the world's own, shared by its sessions
    Vec3 low_m{0}, high_m{0};       ///< corners of the media's box
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
    Size3 size{0};                         ///< 1 to 4096 each
    const float* values = nullptr;         ///< finite, not negative
    const Particles* particles = nullptr;  ///< not null: `size` and `values` do not count
};

/// A perspective or, where height_m > 0, an orthographic camera.
struct Camera {
    Size2 size{0};                    ///< pixels; 0: as before
    Vec3 position_m{0}, target_m{0};  ///< of the eye, and what it looks at
    Vec3 up{0, 0, 1};
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
    Rgb irradiance{1};                           ///< on a plane that faces it, >= 0
    bool present = true;
};

/// A light besides sun and sky; docs/lights.md has the units.
struct Lamp {
    enum class Type {
        kPoint = PILEUS_LAMP_POINT,
        kSpot = PILEUS_LAMP_SPOT,
        kDirectional = PILEUS_LAMP_DIRECTIONAL
    };
    Type type = Type::kPoint;
    Vec3 position_m{0};                          ///< point, spot
    Vec3 direction{0, 0, -1};                    ///< spot: where it shines
    double cone_deg = 40, penumbra_deg = 0;      ///< spot: (0, 360]; up to half of that
    double radius_m = 0;                         ///< point, spot; 0: a point
    std::uint32_t shadow_samples = 0;            ///< up to 64; 0: 8; 1: shadows of a point
    double azimuth_deg = 0, elevation_deg = 45;  ///< directional: where it stands, as the sun
    Rgb light{1};  ///< radiant intensity; directional: irradiance on a plane that faces it
};

/// Of one radiance, or of a picture: latitude-longitude, rows from the zenith, three floats a texel
/// (docs/scene.md, "Sky map"). Copied.
struct Environment {
    Rgb radiance{0};              ///< used without a map; >= 0
    Size2 map_size{0};            ///< columns, rows; columns = 2 rows; 0: no map
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
    std::int64_t stride = 0;  ///< bytes from row to row; 0: tightly packed
    bool bottom_up = false;   ///< the first row in memory is the picture's lowest, as in OpenGL
};

enum class Format : std::uint32_t {
    kRgba8Srgb =
        PILEUS_FORMAT_RGBA8_SRGB,  ///< 4 bytes a pixel, tone curve and sRGB as the program's PNGs
    kRgba16F = PILEUS_FORMAT_RGBA16F,          ///< 4 IEEE halves, linear radiance
    kRgba32F = PILEUS_FORMAT_RGBA32F,          ///< 4 floats, linear radiance
    kBgra8Srgb = PILEUS_FORMAT_BGRA8_SRGB,     ///< as kRgba8Srgb, blue first
    kRgb10A2Srgb = PILEUS_FORMAT_RGB10A2_SRGB  ///< a 32-bit word, red in its lowest 10 bits
};

enum class Blend : std::uint32_t {
    kReplace = PILEUS_BLEND_REPLACE,  ///< the whole picture; alpha: the media's
    kOver = PILEUS_BLEND_OVER,        ///< the media over what the buffer holds
    kMedia = PILEUS_BLEND_MEDIA       ///< the media alone, premultiplied by their alpha
};

/// A channel of the picture, as pileus_layer.
struct Layer {
    std::string name;         ///< "R", "A", "tau", ...: docs/formats.md, "Pictures out"
    float* values = nullptr;  ///< as many as the camera has pixels
    std::int64_t stride = 0;  ///< bytes from row to row; 0: tightly packed
};

/// Buffers of the caller, for one picture.
struct Frame {
    void* colour = nullptr;  ///< first byte of the first row in memory; null: none
    Format format = Format::kRgba8Srgb;
    Blend blend = Blend::kReplace;
    std::int64_t colour_stride = 0;  ///< bytes from row to row; 0: tightly packed
    bool bottom_up = false;    ///< the first row in memory is the picture's lowest; both buffers
    float exposure_stops = 0;  ///< 8 bit only: doubles or halves the light
    float* depth = nullptr;    ///< where half of the light is gone, or the opaque thing; null: none
    Depth depth_kind = Depth::kDistance;
    bool depth_halves = false;  ///< `depth` are IEEE halves, not floats
    std::int64_t depth_stride = 0;
    std::uint64_t* hash = nullptr;  ///< of the whole picture, as the program's; null: none is made
    std::vector<Layer> layers;
};

/// What a step counts.
struct Progress {
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

// ---- Scenes, worlds, sessions ------------------------------------------------------------

/// "major.minor.patch" of the library that is linked, which may differ from this header's.
inline const char* version() { return pileus_version(); }

/// A checked text (docs/scene.md). Its camera, lights and method are where a session begins.
class Scene {
public:
    Scene() = default;

    /// From a file. `overrides`: "key=value" as of the program's --set. Errors: kBadInput, a line
    /// for each fault; kIo.
    static Result<Scene> read(const std::string& path,
                              const std::vector<std::string>& overrides = {}) {
        return made(overrides, [&](const char* const* texts, std::uint32_t count,
                                   pileus_scene** scene, pileus_error* error) {
            return pileus_scene_read(path.c_str(), texts, count, scene, error);
        });
    }

    /// From text; relative paths in it begin at `directory`, or at the current one.
    static Result<Scene> parse(const std::string& text, const std::string& directory = {},
                               const std::vector<std::string>& overrides = {}) {
        return made(overrides, [&](const char* const* texts, std::uint32_t count,
                                   pileus_scene** scene, pileus_error* error) {
            return pileus_scene_parse(text.c_str(), directory.empty() ? nullptr : directory.c_str(),
                                      texts, count, scene, error);
        });
    }

    /// From sizes of files alone: reads no values. Errors: kBadInput; kLimit where a limit forbids
    /// it.
    Result<Plan> plan(const Host& host = {}) const {
        const detail::Lent lent(host);
        auto c = detail::cleared<pileus_plan>();
        Status status = detail::status_of(
            [&](pileus_error* error) { return pileus_plan_scene(get(), &lent.given, &c, error); });
        if (!status) return status;
        Plan plan;
        plan.cells = {c.cells[0], c.cells[1], c.cells[2]};
        plan.peak_bytes = c.peak_bytes;
        plan.world_bytes = c.world_bytes;
        plan.low_m = {c.low_m[0], c.low_m[1], c.low_m[2]};
        plan.high_m = {c.high_m[0], c.high_m[1], c.high_m[2]};
        return plan;
    }

    /// Sets a key as "key=value" of `overrides` does: set("medium.0.albedo", "0.9"). kBadInput, and
    /// the scene is as it was.
    Status set(const std::string& key, const std::string& value) {
        return detail::status_of([&](pileus_error* error) {
            return pileus_scene_set(get(), key.c_str(), value.c_str(), error);
        });
    }
    Status set(const std::string& key, double value) {
        return detail::status_of([&](pileus_error* error) {
            return pileus_scene_set_numbers(get(), key.c_str(), &value, 1, error);
        });
    }
    Status set(const std::string& key, const Vec3& value) {
        const double numbers[3] = {value.x, value.y, value.z};
        return detail::status_of([&](pileus_error* error) {
            return pileus_scene_set_numbers(get(), key.c_str(), numbers, 3, error);
        });
    }
    /// TOML that reads as the same scene.
    Result<std::string> dump() const {
        return detail::text_of(
            [&](char* text, std::size_t size, std::size_t* needed, pileus_error* error) {
                return pileus_scene_dump(get(), text, size, needed, error);
            });
    }

    explicit operator bool() const { return bool(handle_); }
    pileus_scene* get() const { return handle_.get(); }  ///< for pileus.h; stays owned

private:
    template <class Make>
    static Result<Scene> made(const std::vector<std::string>& overrides, Make make) {
        std::vector<const char*> texts;
        for (const std::string& text : overrides) texts.push_back(text.c_str());
        pileus_scene* handle = nullptr;
        Status status = detail::status_of([&](pileus_error* error) {
            return make(texts.data(), detail::count_of(texts.size()), &handle, error);
        });
        if (!status) return status;
        Scene scene;
        scene.handle_.reset(handle);
        return scene;
    }

    std::unique_ptr<pileus_scene, detail::FreeScene> handle_;
};

/// What of a scene depends on neither camera, light nor method: made once, then read only. Sessions
/// keep alive what they need of it.
class World {
public:
    World() = default;

    /// Loads or makes media and solids; the scene may go afterwards. Errors: kBadInput, kLimit,
    /// kIo.
    static Result<World> create(const Scene& scene, const Host& host = {},
                                const std::vector<Density>& densities = {}) {
        auto lent = std::make_shared<const detail::Lent>(host);
        std::vector<pileus_density> given;
        std::vector<pileus_particles> particles;
        particles.reserve(densities.size());
        for (const Density& density : densities) {
            given.push_back(detail::cleared<pileus_density>());
            given.back().medium = density.medium;
            detail::store(density.size, given.back().size);
            given.back().values = density.values;
            if (const Particles* p = density.particles) {
                particles.push_back(detail::cleared<pileus_particles>());
                pileus_particles& own = particles.back();
                own.count = p->count;
                own.position = p->position, own.position_stride = p->position_stride;
                own.radius = p->radius, own.radius_stride = p->radius_stride;
                own.density = p->density, own.density_stride = p->density_stride;
                own.id = p->id, own.id_stride = p->id_stride;
                own.velocity = p->velocity, own.velocity_stride = p->velocity_stride;
                own.colour = p->colour, own.colour_stride = p->colour_stride;
                own.emission = p->emission, own.emission_stride = p->emission_stride;
                given.back().particles = &own;
            }
        }
        pileus_world* handle = nullptr;
        Status status = detail::status_of([&](pileus_error* error) {
            return pileus_world_create(scene.get(), &lent->given, given.data(),
                                       detail::count_of(given.size()), &handle, error);
        });
        if (!status) return status;
        World world;
        world.handle_ = {handle, detail::FreeWorld{std::move(lent)}};
        return world;
    }

    explicit operator bool() const { return bool(handle_); }
    pileus_world* get() const { return handle_.get(); }  ///< for pileus.h; stays owned

private:
    friend class Session;
    friend class Clouds;
    friend class Sky;
    std::unique_ptr<pileus_world, detail::FreeWorld> handle_;
};

namespace detail {

/// Its layers lie in `layers`.
inline pileus_frame frame_of(const Frame& frame, std::vector<pileus_layer>& layers) {
    auto c = cleared<pileus_frame>();
    for (const Layer& layer : frame.layers) {
        layers.push_back(cleared<pileus_layer>());
        layers.back().name = layer.name.c_str();
        layers.back().values = layer.values;
        layers.back().stride = layer.stride;
    }
    c.layers = layers.data();
    c.layer_count = count_of(layers.size());
    c.colour = frame.colour;
    c.colour_stride = frame.colour_stride;
    c.format = static_cast<std::uint32_t>(frame.format);
    c.blend = static_cast<std::uint32_t>(frame.blend);
    c.bottom_up = frame.bottom_up ? 1 : 0;
    c.exposure_stops = frame.exposure_stops;
    c.depth = frame.depth;
    c.depth_stride = frame.depth_stride;
    c.depth_kind = static_cast<std::uint32_t>(frame.depth_kind);
    c.depth_format = frame.depth_halves ? PILEUS_DEPTH_R16F : PILEUS_DEPTH_R32F;
    c.hash = frame.hash;
    return c;
}

inline pileus_depth_image depth_of(const DepthImage& depth) {
    auto c = cleared<pileus_depth_image>();
    c.kind = static_cast<std::uint32_t>(depth.kind);
    c.values = depth.values;
    c.stride = depth.stride;
    c.bottom_up = depth.bottom_up ? 1 : 0;
    return c;
}

}  // namespace detail

/// One camera, one light and one method over a world. What is refused changes nothing.
class Session {
public:
    Session() = default;

    /// Prepares the scene's method over a world made from the same scene, or one with the same
    /// media. Errors: kBadInput, kLimit, kIo.
    static Result<Session> create(const World& world, const Scene& scene, const Host& host = {}) {
        auto lent = std::make_shared<const detail::Lent>(host);
        pileus_session* handle = nullptr;
        Status status = detail::status_of([&](pileus_error* error) {
            return pileus_session_create(world.get(), scene.get(), &lent->given, &handle, error);
        });
        if (!status) return status;
        Session session;
        session.handle_ = {handle, {lent, {lent, world.handle_.get_deleter().host}}};
        return session;
    }

    Status set_camera(const Camera& camera) {
        auto c = detail::cleared<pileus_camera>();
        c.width = camera.size.x;
        c.height = camera.size.y;
        detail::store(camera.position_m, c.position_m);
        detail::store(camera.target_m, c.target_m);
        detail::store(camera.up, c.up);
        c.fov_deg = camera.fov_deg;
        c.height_m = camera.height_m;
        c.near_m = camera.near_m;
        c.far_m = camera.far_m;
        return call(pileus_session_set_camera, &c);
    }

    /// By matrices of any precision, such as those of glm::lookAt and glm::perspective: world to
    /// view (turns and shifts alone; the view looks along -z, y up), and view to clip (perspective
    /// or orthographic, may be off-centre). `size`: pixels, 0: as before. Errors: kBadInput.
    template <class View, class Projection>
    Status set_camera(const View& view, const Projection& projection, Clip clip = Clip::kMinusOne,
                      Size2 size = {}) {
        double v[16], p[16];
        detail::store(view, v);
        detail::store(projection, p);
        return detail::status_of([&](pileus_error* error) {
            return pileus_session_set_matrices(get(), v, p, static_cast<pileus_clip>(clip), size.x,
                                               size.y, error);
        });
    }

    Status set_sun(const Sun& sun) {
        auto c = detail::cleared<pileus_sun>();
        c.present = sun.present ? 1 : 0;
        c.azimuth_deg = sun.azimuth_deg;
        c.elevation_deg = sun.elevation_deg;
        detail::store(sun.irradiance, c.irradiance);
        return call(pileus_session_set_sun, &c);
    }

    Status set_environment(const Environment& sky) {
        auto c = detail::cleared<pileus_environment>();
        c.present = sky.present ? 1 : 0;
        detail::store(sky.radiance, c.radiance);
        c.map_size[0] = sky.map_size.x;
        c.map_size[1] = sky.map_size.y;
        c.map = sky.map;
        c.map_scale = sky.map_scale;
        c.map_rotation_deg = sky.map_rotation_deg;
        return call(pileus_session_set_environment, &c);
    }

    Status set_ground(const Ground& ground) {
        auto c = detail::cleared<pileus_ground>();
        c.present = ground.present ? 1 : 0;
        c.altitude_m = ground.altitude_m;
        c.albedo = ground.albedo;
        return call(pileus_session_set_ground, &c);
    }

    /// In place of all lights that the session had, the scene's included. kBadInput: more than 64,
    /// or what the scene's method has no lights for.
    Status set_lamps(const std::vector<Lamp>& lamps) {
        std::vector<pileus_lamp> given;
        for (const Lamp& light : lamps) {
            given.push_back(detail::cleared<pileus_lamp>());
            pileus_lamp& c = given.back();
            c.type = static_cast<std::uint32_t>(light.type);
            detail::store(light.position_m, c.position_m);
            detail::store(light.direction, c.direction);
            c.cone_deg = light.cone_deg, c.penumbra_deg = light.penumbra_deg;
            c.radius_m = light.radius_m, c.shadow_samples = light.shadow_samples;
            c.azimuth_deg = light.azimuth_deg, c.elevation_deg = light.elevation_deg;
            detail::store(light.light, c.light);
        }
        return detail::status_of([&](pileus_error* error) {
            return pileus_session_set_lamps(get(), given.data(), detail::count_of(given.size()),
                                            error);
        });
    }

#ifndef PILEUS_NO_OLD_NAMES
    [[deprecated("use set_lamps")]] Status set_lights(const std::vector<Lamp>& lamps) {
        return set_lamps(lamps);
    }
    [[deprecated("use set_environment")]] Status set_sky(const Environment& environment) {
        return set_environment(environment);
    }
    [[deprecated("use progress")]] Result<Progress> light() const { return progress(); }
#endif

    /// Moves all media: turned about the z axis through the world's origin (counter-clockwise seen
    /// from above), then shifted. kBadInput in a world with solids.
    Status set_placement(const Vec3& offset_m, double yaw_deg = 0) {
        auto c = detail::cleared<pileus_placement>();
        detail::store(offset_m, c.offset_m);
        c.yaw_deg = yaw_deg;
        return call(pileus_session_set_placement, &c);
    }

    /// Copies the depths for the camera as it is set now; they stay until they are set again.
    Status set_depth(const DepthImage& depth) {
        const pileus_depth_image c = detail::depth_of(depth);
        return call(pileus_session_set_depth, &c);
    }

    /// Number of the picture, from 0 on, which jitter and the noise of paths go by.
    Status set_frame(std::int32_t number) {
        return detail::status_of(
            [&](pileus_error* error) { return pileus_session_set_frame(get(), number, error); });
    }

    /// For the steps and pictures from now on. kBadInput: what the session's method has not.
    Status set_work(const Work& work) {
        auto c = detail::cleared<pileus_work>();
        c.scale = work.scale, c.temporal = work.temporal, c.steps = work.steps;
        c.light_refresh = work.light_refresh, c.photons = work.photons;
        return call(pileus_session_set_work, &c);
    }

    /// The next frame's work by how long the last one took, 0 before the first; `governor`
    /// begins as pileus_governor_default(). kBadInput: a time out of range.
    Result<Work> govern(pileus_governor& governor, double frame_s) const {
        auto c = detail::cleared<pileus_work>();
        Status status = detail::status_of([&](pileus_error* error) {
            return pileus_session_govern(get(), &governor, frame_s, &c, error);
        });
        if (!status) return status;
        return Work{c.scale, c.temporal, c.steps, c.light_refresh, c.photons};
    }

    Result<Progress> progress() const {
        auto c = detail::cleared<pileus_progress>();
        Status status = call(pileus_session_progress, &c);
        if (!status) return status;
        return Progress{c.whole, c.unit_photons, c.units, c.unit};
    }

    /// Traces so many units of light for what is set now; never counts time. `done`, where not
    /// null: how many, fewer where Host::stop ended it, which is no fault.
    Status step(std::uint32_t units, std::uint32_t* done = nullptr) {
        return detail::status_of(
            [&](pileus_error* error) { return pileus_session_step(get(), units, done, error); });
    }

    /// Optics of the media of another scene, as pileus_session_set_media.
    Status set_media(const Scene& scene) { return call(pileus_session_set_media, scene.get()); }

    /// Draws what the session holds now. Light is not traced: see step.
    Status render(const Frame& frame) {
        std::vector<pileus_layer> layers;
        const pileus_frame c = detail::frame_of(frame, layers);
        return call(pileus_session_render, &c);
    }

    /// Draws the world and the light of `next` from the next picture on, and lets the last one fade
    /// over `frames`; `next` has the state that this session had, to be used again or freed.
    /// Errors: kBadInput, kLimit; both are as they were.
    Status hand_over(Session& next, std::uint32_t frames) {
        Status status = detail::status_of([&](pileus_error* error) {
            return pileus_session_hand_over(get(), next.get(), frames, error);
        });
        if (!status) return status;
        detail::FreeSession &own = handle_.get_deleter(), &other = next.handle_.get_deleter();
        own.lenders.swap(other.lenders);
        own.lent_by(own.host);
        other.lent_by(other.host);
        return status;
    }

    Result<Stats> stats() const {
        auto c = detail::cleared<pileus_stats>();
        Status status = call(pileus_session_stats, &c);
        if (!status) return status;
        return Stats{c.prepared,  c.pictures, c.units,   c.shared_bytes,
                     c.own_bytes, c.render_s, c.stages_s};
    }

    /// As the program writes it (docs/report.md), JSON.
    Result<std::string> report() const {
        return detail::text_of(
            [&](char* text, std::size_t size, std::size_t* needed, pileus_error* error) {
                return pileus_session_report(get(), text, size, needed, error);
            });
    }

    /// Ends the step or the marched picture that runs, or else the next one. From any thread.
    void cancel() { pileus_session_cancel(get()); }

    explicit operator bool() const { return bool(handle_); }
    pileus_session* get() const { return handle_.get(); }  ///< for pileus.h; stays owned

private:
    friend class Sky;
    template <class Function, class Given>
    Status call(Function function, Given* given) const {
        return detail::status_of(
            [&](pileus_error* error) { return function(get(), given, error); });
    }

    std::unique_ptr<pileus_session, detail::FreeSession> handle_;
};

// ---- Skies of many clouds ----------------------------------------------------------------

/// Where a cloud stands: turned about the z axis through its kind's origin (counter-clockwise seen
/// from above), made larger, then shifted.
struct Cloud {
    std::uint32_t kind = 0;
    Vec3 offset_m{0};     ///< each within 1e7
    double yaw_deg = 0;   ///< -360 to 360; clouds of one kind and turn share their light
    double scale = 1;     ///< 0.01 to 100; the optical thickness stays as it is
    double presence = 1;  ///< above 0 to 1, 0: 1; factor on its alpha and light
};

/// How exact far clouds are. 0: what is in brackets.
struct CloudDetail {
    bool off = false;              ///< every cloud is marched whole in every picture
    double error_px = 0;           ///< that parts of a far cloud may be off, 0.001 to 16 [0.5]
    double near_px = 0;            ///< clouds of that size are marched in every picture [256]
    std::uint32_t near_scale = 0;  ///< of those one pixel of so many along x and y: 1, 2, 4 [2]
    std::uint32_t blend_frames =
        0;                 ///< over which one impostor cross-fades to the next, to 1000 [8]
    double sharpness = 0;  ///< texels of a far cloud for a pixel, 0.25 to 4 [1]
    std::uint64_t frame_pixels = 0;  ///< of far clouds that one picture may draw anew [60000]
    double sun_deg = 0;              ///< that the sun may move before clouds are lit anew [0.5]
};

/// Of the last picture.
struct CloudStats {
    std::uint32_t clouds = 0, visible = 0;  ///< in all; of them in the picture
    std::uint32_t marched = 0;              ///< drawn anew for this picture
    std::uint32_t captured = 0;             ///< far clouds whose picture was drawn anew
    std::uint32_t lit = 0;                  ///< kinds in a turn that were lit
    std::uint64_t marched_pixels = 0, captured_pixels = 0;
    double worst_px = 0;  ///< largest error of a far cloud's picture, in pixels
};

/// Clouds in a sky, which keep the session of the sky: its camera, sun, air, ground, depths and
/// frame number are those of the pictures, and are set in it.
class Clouds {
public:
    Clouds() = default;
    Clouds(Clouds&&) = default;
    /// What was owned goes before its sky does.
    Clouds& operator=(Clouds&& from) noexcept {
        handle_ = std::move(from.handle_);
        lenders_ = std::move(from.lenders_);
        sky_ = std::move(from.sky_);
        return *this;
    }

    /// None at first; takes the sky where it succeeds. kBadInput: a session with media.
    static Result<Clouds> create(Session&& sky) {
        pileus_clouds* handle = nullptr;
        Status status = detail::status_of(
            [&](pileus_error* error) { return pileus_clouds_create(sky.get(), &handle, error); });
        if (!status) return status;
        Clouds clouds;
        clouds.handle_.reset(handle);
        clouds.lenders_ = std::make_shared<std::vector<detail::SharedLent>>();
        clouds.sky_ = std::move(sky);
        return clouds;
    }

    /// A kind of cloud, and its number, from 0 on: media in boxes, with a method of sessions. World
    /// and scene may go afterwards. Errors: kBadInput, kLimit.
    Result<std::uint32_t> add_kind(const World& world, const Scene& scene) {
        std::uint32_t kind = 0;
        Status status = detail::status_of([&](pileus_error* error) {
            return pileus_clouds_add_kind(get(), world.get(), scene.get(), &kind, error);
        });
        if (!status) return status;
        lenders_->push_back(world.handle_.get_deleter().host);
        return kind;
    }

    /// All clouds, up to 1000, in place of those that there were. One that has the number and the
    /// place that it had keeps its pictures. Errors: kBadInput, and all are as they were.
    Status place(const std::vector<Cloud>& clouds) {
        std::vector<pileus_cloud> given;
        for (const Cloud& cloud : clouds) {
            given.push_back(detail::cleared<pileus_cloud>());
            pileus_cloud& c = given.back();
            c.kind = cloud.kind;
            detail::store(cloud.offset_m, c.offset_m);
            c.yaw_deg = cloud.yaw_deg;
            c.scale = cloud.scale;
            c.presence = cloud.presence;
        }
        return detail::status_of([&](pileus_error* error) {
            return pileus_clouds_place(get(), given.data(), detail::count_of(given.size()), error);
        });
    }

    Status set_detail(const CloudDetail& d) {
        auto c = detail::cleared<pileus_cloud_detail>();
        c.off = d.off ? 1 : 0;
        c.error_px = d.error_px, c.near_px = d.near_px, c.near_scale = d.near_scale;
        c.blend_frames = d.blend_frames, c.sharpness = d.sharpness;
        c.frame_pixels = d.frame_pixels, c.sun_deg = d.sun_deg;
        return detail::status_of(
            [&](pileus_error* error) { return pileus_clouds_set_detail(get(), &c, error); });
    }

    /// Draws sky, ground and clouds for what the sky is set to now, as Session::render does.
    Status render(const Frame& frame) {
        std::vector<pileus_layer> layers;
        const pileus_frame c = detail::frame_of(frame, layers);
        return detail::status_of(
            [&](pileus_error* error) { return pileus_clouds_render(get(), &c, error); });
    }

    Result<CloudStats> stats() const {
        auto c = detail::cleared<pileus_cloud_stats>();
        Status status = detail::status_of(
            [&](pileus_error* error) { return pileus_clouds_stats(get(), &c, error); });
        if (!status) return status;
        return CloudStats{c.clouds, c.visible,        c.marched,         c.captured,
                          c.lit,    c.marched_pixels, c.captured_pixels, c.worst_px};
    }

    Session& sky() { return sky_; }

    explicit operator bool() const { return bool(handle_); }
    pileus_clouds* get() const { return handle_.get(); }  ///< for pileus.h; stays owned

private:
    friend class Sky;
    Session sky_;  ///< outlives the handle, as do the hosts of kinds
    std::shared_ptr<std::vector<detail::SharedLent>> lenders_;
    std::unique_ptr<pileus_clouds, detail::FreeClouds> handle_;
};

// ---- The whole sky -----------------------------------------------------------------------

/// What a sky does at a place; light without the host's own things.
struct SkyLight {
    Vec3 position_m{0};
    float sun_share = 0;  ///< of sunlight that clouds let through; 0: a sun below the horizon
    Rgb sun{0};           ///< irradiance on a plane that faces the sun, through air and clouds
    Rgb level{0};         ///< irradiance of the sky on level ground
    double extinction_per_m = 0;  ///< of clouds there; visibility 3.912 / extinction, m
    /// Irradiance over pi, by channel, of sky and ground on a plane of normal (x, y, z): the sum of
    /// these times 1, x, y, z, xy, yz, zx, xx - yy, 3 zz - 1.
    float around[3][9] = {};
};

enum class ShadowFormat : std::uint32_t {
    kR8 = PILEUS_SHADOW_R8,        ///< a byte, 255: all of the sun
    kRgba8 = PILEUS_SHADOW_RGBA8,  ///< the byte three times, and 255
    kR16F = PILEUS_SHADOW_R16F,    ///< an IEEE half, 0 to 1
    kR32F = PILEUS_SHADOW_R32F     ///< a float, 0 to 1
};

/// A map of the sunlight that clouds let through, in memory of the caller. Texels run from west to
/// east, rows from the north to the south.
struct ShadowMap {
    Size2 size{0};  ///< texels, 1 to 16384 each
    ShadowFormat format = ShadowFormat::kR8;
    Vec2 low_m{0}, size_m{0};        ///< south-west corner; extents
    double altitude_m = 0;           ///< of all texels, where `heights` is null
    const float* heights = nullptr;  ///< altitude of each, tightly packed, rows as in memory
    void* texels = nullptr;
    std::int64_t stride = 0;                ///< bytes from row to row; 0: tightly packed
    bool bottom_up = false;                 ///< the first row in memory is the southern one
    std::uint32_t first_row = 0, rows = 0;  ///< of memory to write; rows 0: all from first_row on
};

/// What air and haze do on a way.
struct AirWay {
    Rgb left{0};   ///< share of R, G, B that is left of what lies behind
    Rgb light{0};  ///< that is added
};

/// All that is above a host's ground in one picture, over what the host has drawn.
/// docs/whole-sky.md
class Sky {
public:
    Sky() = default;
    Sky(Sky&&) = default;
    Sky& operator=(Sky&&) = default;

    /// From a scene without media: its [atmosphere] or sky, its [clouds], its [weather]. Errors:
    /// kBadInput, kLimit, kIo, those of the scene's files as well.
    static Result<Sky> create(const Scene& scene, const Host& host = {}) {
        auto owner = std::make_shared<detail::SkyOwner>();
        owner->lenders.push_back(std::make_shared<const detail::Lent>(host));
        Status status = detail::status_of([&](pileus_error* error) {
            return pileus_sky_create(scene.get(), &owner->lenders[0]->given, &owner->sky, error);
        });
        if (!status) return status;
        Sky sky;
        sky.owner_ = std::move(owner);
        return sky;
    }

    /// Where camera, sun, environment, ground and frame number are set. It stays the sky's, and
    /// keeps it, wherever the owner moves. Drawn by itself it is without clouds.
    Session session() const {
        Session session;
        session.handle_ = {pileus_sky_session(get()), {{}, {}, owner_}};
        return session;
    }

    /// For kinds, places and detail; they stay the sky's likewise.
    Clouds clouds() const {
        Clouds clouds;
        if (owner_ == nullptr) return clouds;
        clouds.sky_ = session();
        clouds.lenders_ = {owner_, &owner_->lenders};
        clouds.handle_ = {pileus_sky_clouds(get()), {true}};
        return clouds;
    }

    /// One more sheet of clouds, up to 8, that stays where its scene has it. World and scene may go
    /// afterwards. Errors: kBadInput, kLimit.
    Status add_layer(const World& world, const Scene& scene) {
        Status status = detail::status_of([&](pileus_error* error) {
            return pileus_sky_add_layer(get(), world.get(), scene.get(), error);
        });
        if (status) owner_->lenders.push_back(world.handle_.get_deleter().host);
        return status;
    }

    /// Clouds, haze, fog and rain of a report in place of all clouds and layers there are; `seed`:
    /// other clouds of the same report. kBadInput: one that cannot be read, and all is as it was.
    Status set_weather(const std::string& metar, std::uint32_t seed = 0, double elevation_m = 0) {
        return detail::status_of([&](pileus_error* error) {
            return pileus_sky_set_weather(get(), metar.c_str(), seed, elevation_m, error);
        });
    }

    /// Places the sun so many hours after the scene's date and time, which it must have.
    Status set_time(double hours) {
        return detail::status_of(
            [&](pileus_error* error) { return pileus_sky_set_time(get(), hours, error); });
    }

    /// Where all clouds and layers are beside their places, within 1e7 m. Nothing is made again.
    Status move(const Vec3& offset_m) {
        double to[3];
        detail::store(offset_m, to);
        return detail::status_of(
            [&](pileus_error* error) { return pileus_sky_move(get(), to, error); });
    }

    /// Draws all of it: Blend::kOver over what the host has drawn, kMedia to be laid over it later.
    /// Depths are those that were set last.
    Status render(const Frame& frame) { return draw(frame, nullptr); }
    /// The same with what the host has drawn, of the camera as it is set.
    Status render(const Frame& frame, const DepthImage& depth) {
        const pileus_depth_image c = detail::depth_of(depth);
        return draw(frame, &c);
    }

    /// By the light and shadows of the last picture, in the order of `places_m`.
    Result<std::vector<SkyLight>> light_at(const std::vector<Vec3>& places_m) {
        std::vector<pileus_sky_light> found;
        for (const Vec3& place : places_m) {
            found.push_back(detail::cleared<pileus_sky_light>());
            detail::store(place, found.back().position_m);
        }
        Status status = detail::status_of([&](pileus_error* error) {
            return pileus_sky_light_at(get(), found.data(), detail::count_of(found.size()), error);
        });
        if (!status) return status;
        std::vector<SkyLight> lights;
        for (const pileus_sky_light& c : found) {
            SkyLight light;
            light.position_m = {c.position_m[0], c.position_m[1], c.position_m[2]};
            light.sun_share = c.sun_share;
            light.sun = {c.sun[0], c.sun[1], c.sun[2]};
            light.level = {c.level[0], c.level[1], c.level[2]};
            light.extinction_per_m = c.extinction_per_m;
            for (int channel = 0; channel < 3; ++channel)
                for (int k = 0; k < 9; ++k) light.around[channel][k] = c.around[channel][k];
            lights.push_back(light);
        }
        return lights;
    }

    /// Writes rows of the map, by the light and shadows of the last picture; a few rows a frame
    /// refresh it in slices.
    Status shadow(const ShadowMap& map) {
        auto c = detail::cleared<pileus_shadow_map>();
        c.width = map.size.x, c.height = map.size.y;
        c.format = static_cast<std::uint32_t>(map.format);
        c.low_m[0] = map.low_m.x, c.low_m[1] = map.low_m.y;
        c.size_m[0] = map.size_m.x, c.size_m[1] = map.size_m.y;
        c.altitude_m = map.altitude_m;
        c.heights = map.heights;
        c.texels = map.texels;
        c.stride = map.stride;
        c.bottom_up = map.bottom_up ? 1 : 0;
        c.first_row = map.first_row, c.rows = map.rows;
        return detail::status_of(
            [&](pileus_error* error) { return pileus_sky_shadow(get(), &c, error); });
    }

    /// Between the camera and something `metres` away; infinity: the sky there.
    Result<AirWay> air(const Vec3& direction, double metres) {
        double to[3];
        float left[3], light[3];
        detail::store(direction, to);
        Status status = detail::status_of([&](pileus_error* error) {
            return pileus_sky_air(get(), to, metres, left, light, error);
        });
        if (!status) return status;
        return AirWay{{left[0], left[1], left[2]}, {light[0], light[1], light[2]}};
    }

    explicit operator bool() const { return bool(owner_); }
    pileus_sky* get() const { return owner_ ? owner_->sky : nullptr; }  ///< for pileus.h

private:
    Status draw(const Frame& frame, const pileus_depth_image* depth) {
        std::vector<pileus_layer> layers;
        const pileus_frame c = detail::frame_of(frame, layers);
        return detail::status_of(
            [&](pileus_error* error) { return pileus_sky_render(get(), depth, &c, error); });
    }

    std::shared_ptr<detail::SkyOwner> owner_;  ///< with it those of its session and clouds
};

/// `position_m` turned about the vertical axis through `target_m`, counter-clockwise seen from
/// above, by the bits of the program's animation.camera_orbit_deg.
inline Vec3 orbit(const Vec3& position_m, const Vec3& target_m, double degrees) {
    double from[3], about[3], to[3];
    detail::store(position_m, from);
    detail::store(target_m, about);
    pileus_orbit(from, about, degrees, to);
    return {to[0], to[1], to[2]};
}

// ---- Old names, gone in 1.0.0: docs/migration.md -----------------------------------------

#ifndef PILEUS_NO_OLD_NAMES
using SceneLight [[deprecated("use Lamp")]] = Lamp;
using Light [[deprecated("use Progress")]] = Progress;
#endif

}  // namespace pileus::embed

#endif  // PILEUS_HPP
