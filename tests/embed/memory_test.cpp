// SPDX-License-Identifier: Apache-2.0
// Memory that ends at every allocation of a session: a line, and what is asked again goes on.
// in: scenes of every kind, a host whose memory ends once -> out: the hashes of one whose does not.
// docs/embedding.md, "What the library asks of its host"
#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <functional>

#include "tests/embed/settings_rows.h"
#include "tests/support/long_tests.h"

using namespace host_test;
using render_test::kSmallCumulus;

namespace {

constexpr std::uint32_t kWidth = 12, kHeight = 8;

/// Memory that ends once, at allocation number `ends`.
struct Ending {
    std::atomic<long> taken{0}, held{0};
    long ends = -1;

    static void* allocate(void* user, std::size_t bytes, std::size_t alignment) {
        Ending& own = *static_cast<Ending*>(user);
        if (own.taken.fetch_add(1) == own.ends) return nullptr;
        ++own.held;
        return std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
    }
    static void release(void* user, void* memory) {
        if (memory != nullptr) --static_cast<Ending*>(user)->held;
        std::free(memory);
    }
    pileus_host host() {
        auto made = cleared<pileus_host>();
        made.user = this;
        made.allocate = allocate;
        made.release = release;
        made.threads = 1;
        return made;
    }
};

/// A scene with a world of its own memory, which never ends.
struct Stage {
    SceneHandle scene;
    WorldHandle world;

    explicit Stage(SceneHandle made) : scene(std::move(made)) {
        Outcome out;
        pileus_world* w = nullptr;
        const auto host = cleared<pileus_host>();
        const pileus_code code =
            pileus_world_create(scene.get(), &host, nullptr, 0, &w, &out.error);
        REQUIRE_MESSAGE(code == PILEUS_OK, out.line());
        world.reset(w);
    }
};

/// What a host does with a session, call by call.
class Life {
public:
    Life(const Stage& stage, long ends) {
        memory_.ends = ends;
        const pileus_host host = memory_.host();
        pileus_session* made = nullptr;
        const pileus_code code =
            pileus_session_create(stage.world.get(), stage.scene.get(), &host, &made, &out_.error);
        session_.reset(made);
        note(code);
        if (code != PILEUS_OK) {
            // Nothing is left of a session that was not made.
            CHECK(made == nullptr);
            CHECK(memory_.held == 0);
            return;
        }
        live();
    }
    ~Life() {
        session_.reset();
        CHECK(memory_.held == 0);
    }
    Life(const Life&) = delete;

    bool opened() const { return session_ != nullptr; }
    long taken() const { return memory_.taken; }
    int failures() const { return failures_; }
    const std::vector<pileus_code>& codes() const { return codes_; }
    const std::vector<std::uint64_t>& hashes() const { return hashes_; }

private:
    void note(pileus_code code) {
        if (code == PILEUS_OK) return;
        CHECK_FALSE(out_.line().empty());
        if (code != PILEUS_ERROR_LIMIT) return;
        ++failures_;
        CHECK_MESSAGE(out_.line().find("out of memory") != std::string::npos, out_.line());
    }
    /// Calls; where memory ended in it, once more.
    template <class Call>
    void call(Call once) {
        pileus_code code = once(session_.get(), &out_.error);
        note(code);
        if (code == PILEUS_ERROR_LIMIT) code = once(session_.get(), &out_.error);
        codes_.push_back(code);
    }
    void draw(std::uint32_t units, std::uint32_t format, bool deep) {
        const std::size_t pixels = std::size_t(kWidth + 4) * (kHeight + 4);
        std::vector<float> colour(4 * pixels), depth(pixels);
        std::uint64_t hash = 0;
        auto frame = cleared<pileus_frame>();
        frame.colour = colour.data();
        frame.format = format;
        if (deep) frame.depth = depth.data();
        call([&](pileus_session* s, pileus_error* e) {
            return pileus_session_step(s, units, nullptr, e);
        });
        // As a host draws, without a hash, and once more with one.
        call([&](pileus_session* s, pileus_error* e) {
            return pileus_session_render(s, &frame, e);
        });
        frame.hash = &hash;
        call([&](pileus_session* s, pileus_error* e) {
            return pileus_session_render(s, &frame, e);
        });
        hashes_.push_back(hash);
    }
    void live();

    Ending memory_;
    SessionHandle session_;
    Outcome out_;
    int failures_ = 0;
    std::vector<pileus_code> codes_;
    std::vector<std::uint64_t> hashes_;
};

void Life::live() {
    auto light = cleared<pileus_progress>();
    REQUIRE(pileus_session_progress(session_.get(), &light, &out_.error) == PILEUS_OK);
    draw(light.whole, PILEUS_FORMAT_RGBA8_SRGB, false);
    // Another size, place and sun.
    auto camera = cleared<pileus_camera>();
    camera.position_m[0] = 100, camera.position_m[1] = -4000, camera.position_m[2] = 1400;
    camera.target_m[2] = 1000;
    camera.fov_deg = 35;
    camera.width = kWidth + 3, camera.height = kHeight + 1;
    auto sun = cleared<pileus_sun>();
    sun.present = 1;
    sun.azimuth_deg = 100, sun.elevation_deg = 40;
    for (float& c : sun.irradiance) c = 1;
    call([&](pileus_session* s, pileus_error* e) {
        return pileus_session_set_camera(s, &camera, e);
    });
    call([&](pileus_session* s, pileus_error* e) { return pileus_session_set_sun(s, &sun, e); });
    call([&](pileus_session* s, pileus_error* e) { return pileus_session_set_frame(s, 1, e); });
    draw(light.whole, PILEUS_FORMAT_RGBA32F, true);
    // Opaque things in front, a sky of a picture, lamps; then the media elsewhere.
    const std::vector<float> metres(std::size_t(kWidth + 3) * (kHeight + 1), 4100.0f);
    auto depth = cleared<pileus_depth_image>();
    depth.values = metres.data();
    call(
        [&](pileus_session* s, pileus_error* e) { return pileus_session_set_depth(s, &depth, e); });
    std::vector<float> texels(8 * 4 * 3, 0.5f);
    texels[20] = 4;
    auto sky = cleared<pileus_environment>();
    sky.present = 1;
    sky.map_size[0] = 8, sky.map_size[1] = 4;
    sky.map = texels.data();
    call([&](pileus_session* s, pileus_error* e) {
        return pileus_session_set_environment(s, &sky, e);
    });
    pileus_lamp lamps[2] = {cleared<pileus_lamp>(), cleared<pileus_lamp>()};
    for (pileus_lamp& lamp : lamps) {
        for (float& c : lamp.light) c = 1e6f;
        lamp.position_m[1] = -900, lamp.position_m[2] = 1600;
    }
    lamps[1].type = PILEUS_LAMP_DIRECTIONAL;
    for (float& c : lamps[1].light) c = 1;
    lamps[1].elevation_deg = 50;
    call([&](pileus_session* s, pileus_error* e) {
        return pileus_session_set_lamps(s, lamps, 2, e);
    });
    draw(light.whole, PILEUS_FORMAT_RGBA8_SRGB, false);
    sky.map_size[0] = sky.map_size[1] = 0;
    sky.radiance[1] = 0.5f;
    auto placement = cleared<pileus_placement>();
    placement.offset_m[0] = 64;
    placement.yaw_deg = 20;
    auto work = cleared<pileus_work>();
    work.scale = 2;
    call([&](pileus_session* s, pileus_error* e) {
        return pileus_session_set_environment(s, &sky, e);
    });
    call([&](pileus_session* s, pileus_error* e) {
        return pileus_session_set_placement(s, &placement, e);
    });
    call([&](pileus_session* s, pileus_error* e) { return pileus_session_set_work(s, &work, e); });
    draw(light.whole, PILEUS_FORMAT_RGBA16F, false);
}

/// Has memory end at `most` allocations of a session, a sixtieth of them in the plain form,
/// from the one of number `first` on; at every one in the long form.
void sweep(const Stage& stage, long most, long first) {
    const Life whole(stage, -1);
    REQUIRE(whole.opened());
    CHECK(whole.failures() == 0);
    const long step = pileus::long_tests()
                          ? 1
                          : std::max(1L, long(pileus::row_stride(60)) * whole.taken() / most);
    for (long ends = first % step; ends < whole.taken(); ends += step) {
        CAPTURE(ends);
        const Life life(stage, ends);
        CHECK(life.failures() == 1);
        if (!life.opened()) continue;
        CHECK(life.codes() == whole.codes());
        CHECK(life.hashes() == whole.hashes());
    }
}

/// A scene of the test, by what it adds to the small cumulus or puts in its place.
struct Row {
    const char* text;
    Overrides overrides;
    long most = 1000;  ///< allocations that end; a step between them where there are more
};

constexpr const char* kSpheres = R"(
[camera]
position_m = [0, -1500, 700]
target_m = [0, 0, 800]
[sun]
azimuth_deg = 120
elevation_deg = 30
[sky]
radiance = [0.05, 0.07, 0.11]
[ground]
[[medium]]
density = "assets/scenes/golden/data/puff.csv"
phase = { type = "henyey-greenstein", g = 0.8 }
)";

constexpr const char* kAir = R"(
[camera]
position_m = [16, -4000, 1400]
target_m = [0, 0, 1024]
[sun]
azimuth_deg = 120
elevation_deg = 35
[atmosphere]
turbidity = 4
[ground]
[[medium]]
density = "uniform:sphere"
bounds_m = [[-512, -512, 512], [512, 512, 1536]]
resolution = [8, 8, 8]
extinction_per_m = 0.02
)";

constexpr const char* kLamp = R"(
[[light]]
type = "point"
position_m = [100, -250, 900]
intensity = [6e4, 4e4, 2e4]
radius_m = 60
)";

const Row kRows[] = {
    {"", {"method.name=collectors", "medium.0.phase={type=\"henyey-greenstein\",g=0.9}"}},
    {"", {"method.name=collectors", "collectors.display=billboards"}},
    {"", {"method.name=collectors", "collectors.temporal=2", "medium.0.albedo=1"}},
    {"", {"method.name=collectors", "collectors.scale=2", "collectors.node_filter=guided"}},
    {"", {"method.name=collectors", "medium.0.emission=0.1"}},
    {kLamp, {"method.name=collectors"}},
    {"", {"method.name=raymarch", "raymarch.jitter=blue-noise"}},
    {"", {"method.name=raymarch", "raymarch.temporal=4", "raymarch.scattering=octaves"}},
    {kLamp, {"method.name=raymarch", "raymarch.scale=4"}},
    {settings_test::kSkyInPlace, {"method.name=raymarch", "sun.azimuth_deg=60"}, 8},
    {kAir, {"method.name=raymarch"}, 15},
    {"", {"method.name=optical-depth"}},
    {"",
     {"method.name=optical-depth", "optical_depth.max_extinction_per_m=0.01",
      "optical_depth.resolution=[10,10,6]"}},
    {"", {"method.name=photon-grid"}},
    {"", {"method.name=photon-grid", "photon_grid.ring=true", "photon_grid.scale=2"}},
    {kLamp, {"method.name=photon-grid"}},
    {"", {"method.name=path"}},
    {"", {"method.name=path", "filter.kind=regression"}},
    {kLamp, {"method.name=path", "path.guide=true"}},
    {kSpheres, {"method.name=particles"}, 30},
    {kSpheres, {"method.name=particles", "particles.display=billboards"}, 60},
    {kSpheres, {"method.name=particles", "particles.light=linear"}, 60},
};

SceneHandle scene_in(const Row& row) {
    const bool whole = std::string(row.text).find("[camera]") != std::string::npos;
    Overrides all = {
        "camera.resolution=[12,8]", "collectors.photons=100",    "collectors.generations=2",
        "photon_grid.photons=100",  "photon_grid.generations=2", "path.samples_per_pixel=1",
        "collectors.samples=100",   "raymarch.steps=12",         "output.layers=[\"radiance\"]"};
    if (!whole) {
        all.push_back("medium.0.resolution=[8,8,6]");
        all.push_back("medium.0.phase={type=\"isotropic\"}");
    }
    all.insert(all.end(), row.overrides.begin(), row.overrides.end());
    return scene_of(whole ? row.text : std::string(kSmallCumulus) + row.text, all);
}

}  // namespace

TEST_CASE("memory: a session goes on where it ended once, at every place") {
    // Rows begin at different ones, for what they share comes first.
    long first = 0;
    for (const Row& row : kRows) {
        CAPTURE(row.overrides.front() + " " + row.overrides.back());
        const Stage stage(scene_in(row));
        sweep(stage, row.most, 7 * first++);
    }
}
