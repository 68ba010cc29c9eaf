// SPDX-License-Identifier: Apache-2.0
// Every pair and triple of sizes, pointers and strides of a session's calls, and every number of
// their structs, where they cannot be meant; misuse_worlds_test.cpp has the other calls.
// in: tables of wrong values -> out: one line each, and everything as it was.
// docs/embedding.md
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>

#include "tests/embed/host_harness.h"

using namespace host_test;
using render_test::kSmallCumulus;

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kEndless = std::numeric_limits<double>::infinity();
constexpr std::uint32_t kHuge = 1u << 31, kMax = UINT32_MAX;

/// A small marched cumulus, and what calls of its session are refused with.
struct Refusals {
    Hosted host{kSmallCumulus, {"method.name=\"raymarch\""}};
    pileus_session* s = host.session.get();
    pileus_error* e = &host.out.error;
    std::string before = host.hash();

    void refused(pileus_code code, const char* word) {
        CAPTURE(word);
        CHECK(code == PILEUS_ERROR_INPUT);
        const std::string line = host.out.line();
        CHECK_MESSAGE(line.find(word) != std::string::npos, line);
        CHECK_MESSAGE(line.find("allowed") != std::string::npos, line);
        // A line for each fault.
        for (std::size_t at = line.find('\n'); at != std::string::npos;
             at = line.find('\n', at + 1))
            CHECK_MESSAGE(line.find("allowed", at) != std::string::npos, line);
        host.out.error = cleared<pileus_error>();
    }
    /// No number, and both infinities, in each member of a sound struct.
    template <class Struct, class Set>
    void numbers(const Struct& sound, const char* word, Set set,
                 std::initializer_list<std::function<void(Struct&, double)>> members) {
        host.check(set(sound));
        int at = 0;
        for (const auto& member : members) {
            CAPTURE(at++);
            for (const double wrong : {kNone, kEndless, -kEndless}) {
                Struct given = sound;
                member(given, wrong);
                refused(set(given), word);
            }
        }
    }
    ~Refusals() { CHECK(host.hash() == before); }
};

template <class Struct>
std::function<void(Struct&, double)> member(double Struct::*at) {
    return [at](Struct& s, double v) { s.*at = v; };
}
template <class Struct, class Number, std::size_t N>
std::function<void(Struct&, double)> member(Number (Struct::*at)[N], std::size_t i) {
    return [at, i](Struct& s, double v) { (s.*at)[i] = Number(v); };
}

}  // namespace

TEST_CASE("misuse: sizes of a sky map, none of which is looked at alone") {
    Refusals r;
    const std::vector<float> texels(3 * 4 * 2, 0.5f);
    auto sky = cleared<pileus_environment>();
    sky.present = 1;
    const auto set = [&](std::uint32_t columns, std::uint32_t rows, const float* map) {
        sky.map_size[0] = columns, sky.map_size[1] = rows;
        sky.map = map;
        return pileus_session_set_environment(r.s, &sky, r.e);
    };
    const std::uint32_t sizes[][2] = {{2, 0},
                                      {0, 2},
                                      {1, 0},
                                      {0, 1},
                                      {4, 4},
                                      {2, 4},
                                      {4, 1},
                                      {16386, 8193},
                                      {kHuge, 0},
                                      {0, kHuge},
                                      {kHuge, kHuge / 2},
                                      {kMax - 1, kHuge - 1},
                                      {kHuge, kHuge},
                                      {0, kMax}};
    for (const auto& size : sizes)
        for (const float* map : {texels.data(), static_cast<const float*>(nullptr)}) {
            CAPTURE(size[0]);
            CAPTURE(size[1]);
            r.refused(set(size[0], size[1], map), "sky.map_size: ");
        }
    r.refused(set(4, 2, nullptr), "sky.map: null, and there is none to keep");
    for (const float wrong : {float(kNone), float(kEndless), -1.0f}) {
        std::vector<float> bad = texels;
        bad[13] = wrong;
        r.refused(set(4, 2, bad.data()), "sky.map: pixel 0 1: G");
    }
    for (const double wrong : {kNone, kEndless, -1.0}) {
        sky.map_scale = wrong;
        r.refused(set(4, 2, texels.data()), "sky.map_scale");
    }
    sky.map_scale = 0;
    for (const double wrong : {kNone, kEndless, 361.0}) {
        sky.map_rotation_deg = wrong;
        r.refused(set(4, 2, texels.data()), "sky.map_rotation_deg");
    }
    sky.map_rotation_deg = 0;
    for (int c = 0; c < 3; ++c)
        for (const double wrong : {kNone, kEndless, -1e-30}) {
            auto plain = cleared<pileus_environment>();
            plain.present = 1;
            plain.radiance[c] = float(wrong);
            r.refused(pileus_session_set_environment(r.s, &plain, r.e), "sky.radiance");
        }
}

TEST_CASE("misuse: numbers of cameras, suns, grounds and places") {
    Refusals r;
    auto camera = cleared<pileus_camera>();
    camera.position_m[0] = 16, camera.position_m[1] = -4000, camera.position_m[2] = 256;
    camera.target_m[2] = 1024;
    camera.fov_deg = 40;
    const auto look = [&](const pileus_camera& c) {
        return pileus_session_set_camera(r.s, &c, r.e);
    };
    using C = pileus_camera;
    r.numbers<C>(camera, "camera.", look,
                 {member(&C::position_m, 0), member(&C::position_m, 1), member(&C::position_m, 2),
                  member(&C::target_m, 0), member(&C::target_m, 1), member(&C::target_m, 2),
                  member(&C::up, 0), member(&C::up, 1), member(&C::up, 2), member(&C::fov_deg),
                  member(&C::height_m), member(&C::near_m), member(&C::far_m)});
    const struct {
        const char* key;
        std::function<void(C&)> spoil;
    } rows[] = {
        {"camera.resolution", [](C& c) { c.width = kHuge; }},
        {"camera.resolution", [](C& c) { c.height = kMax; }},
        {"camera.resolution", [](C& c) { c.width = c.height = kHuge; }},
        {"camera.resolution", [](C& c) { c.width = 32769, c.height = 1; }},
        {"camera.height_m", [](C& c) { c.height_m = -1; }},
        {"camera.near_m", [](C& c) { c.near_m = -1; }},
        {"camera.far_m", [](C& c) { c.far_m = -1; }},
        {"camera.far_m", [](C& c) { c.near_m = 2, c.far_m = 1; }},
        {"camera.far_m", [](C& c) { c.near_m = c.far_m = 1; }},
        {"camera.far_m", [](C& c) { c.height_m = 100, c.near_m = 2, c.far_m = 1; }},
        {"camera.near_m", [](C& c) { c.near_m = 1e16; }},
    };
    for (const auto& row : rows) {
        C given = camera;
        row.spoil(given);
        r.refused(look(given), row.key);
    }
    r.refused(pileus_session_size(r.s, nullptr, nullptr, r.e), "width, height");

    const double view[16] = {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, -1000, -4000, 1};
    const double lens[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, -1, 0, 0, -1, 0};
    for (std::size_t i = 0; i < 16; ++i)
        for (const double wrong : {kNone, kEndless, -kEndless}) {
            double v[16], p[16];
            std::memcpy(v, view, sizeof v), std::memcpy(p, lens, sizeof p);
            v[i] = wrong;
            r.refused(pileus_session_set_matrices(r.s, v, p, PILEUS_CLIP_ZERO, 0, 0, r.e), "view");
            v[i] = view[i], p[i] = wrong;
            r.refused(pileus_session_set_matrices(r.s, v, p, PILEUS_CLIP_ZERO, 0, 0, r.e),
                      "projection");
        }
    r.refused(pileus_session_set_matrices(r.s, view, lens, pileus_clip(7), 0, 0, r.e), "clip: 7");
    r.refused(pileus_session_set_matrices(r.s, view, lens, PILEUS_CLIP_ZERO, 0, kHuge, r.e),
              "camera.resolution");
    r.refused(pileus_session_set_matrices(r.s, view, nullptr, PILEUS_CLIP_ZERO, 0, 0, r.e), "null");

    using S = pileus_sun;
    auto sun = cleared<S>();
    sun.present = 1, sun.azimuth_deg = 120, sun.elevation_deg = 35;
    for (float& v : sun.irradiance) v = 1;
    r.numbers<S>(sun, "sun.", [&](const S& v) { return pileus_session_set_sun(r.s, &v, r.e); },
                 {member(&S::azimuth_deg), member(&S::elevation_deg), member(&S::irradiance, 0),
                  member(&S::irradiance, 1), member(&S::irradiance, 2)});
    using G = pileus_ground;
    auto ground = cleared<G>();
    ground.present = 1, ground.albedo = 0.25;
    r.numbers<G>(ground, "ground.",
                 [&](const G& v) { return pileus_session_set_ground(r.s, &v, r.e); },
                 {member(&G::altitude_m), member(&G::albedo)});
    using P = pileus_placement;
    r.numbers<P>(cleared<P>(), "placement.",
                 [&](const P& v) { return pileus_session_set_placement(r.s, &v, r.e); },
                 {member(&P::offset_m, 0), member(&P::offset_m, 1), member(&P::offset_m, 2),
                  member(&P::yaw_deg)});
    r.refused(pileus_session_set_frame(r.s, INT32_MIN, r.e), "frame: below 0");
    // Numbers of pictures end where their type does.
    r.host.check(pileus_session_set_frame(r.s, INT32_MAX, r.e));
    r.host.hash();
    r.host.check(pileus_session_set_frame(r.s, 0, r.e));
    pileus_orbit(nullptr, view, 1, nullptr);
}

TEST_CASE("misuse: lights one by one, and as an array") {
    Refusals r;
    using L = pileus_lamp;
    const auto set = [&](const L& light) { return pileus_session_set_lamps(r.s, &light, 1, r.e); };
    const auto all_off = [&] { r.host.check(pileus_session_set_lamps(r.s, nullptr, 0, r.e)); };
    auto light = cleared<L>();
    light.type = PILEUS_LAMP_SPOT;
    light.position_m[2] = 3000, light.direction[2] = -1, light.cone_deg = 40,
    light.penumbra_deg = 5;
    light.radius_m = 1;
    for (float& v : light.light) v = 1;
    r.numbers<L>(light, "light.", set,
                 {member(&L::position_m, 0), member(&L::position_m, 1), member(&L::position_m, 2),
                  member(&L::direction, 0), member(&L::direction, 1), member(&L::direction, 2),
                  member(&L::cone_deg), member(&L::penumbra_deg), member(&L::radius_m),
                  member(&L::light, 0), member(&L::light, 1), member(&L::light, 2)});
    light.type = PILEUS_LAMP_DIRECTIONAL;
    r.numbers<L>(light, "light.", set,
                 {member(&L::azimuth_deg), member(&L::elevation_deg), member(&L::light, 0),
                  member(&L::light, 1), member(&L::light, 2)});
    light.type = kHuge;
    r.refused(set(light), "light.type: ");
    light.type = PILEUS_LAMP_POINT;
    light.shadow_samples = kMax;
    r.refused(set(light), "light.shadow_samples: ");
    light.shadow_samples = 0;
    std::vector<L> three(3, light);
    r.refused(pileus_session_set_lamps(r.s, nullptr, 3, r.e), "lights: null");
    r.refused(pileus_session_set_lamps(r.s, three.data(), kMax, r.e), "lights: ");
    for (const std::uint32_t size :
         {0u, 3u, std::uint32_t(sizeof(L)), marked(sizeof(L) - 8), kHuge, kMax}) {
        three[2].struct_size = size;
        r.refused(pileus_session_set_lamps(r.s, three.data(), 3, r.e),
                  "lights[2]: not initialised");
    }
    all_off();
}

TEST_CASE("misuse: rows of pictures and depths, and what is drawn into them") {
    Refusals r;
    std::vector<float> pixels(24 * 14 * 4);
    const std::int64_t strides[] = {-1,        1,         24 * 4 - 1,         -24 * 4,
                                    INT64_MIN, INT64_MAX, INT64_MAX / 14 + 1, INT64_MAX - 15};
    for (const std::int64_t stride : strides) {
        CAPTURE(stride);
        auto depth = cleared<pileus_depth_image>();
        depth.values = pixels.data(), depth.stride = stride;
        r.refused(pileus_session_set_depth(r.s, &depth, r.e), "depth.stride: ");
        for (const std::uint32_t format :
             {PILEUS_FORMAT_RGBA8_SRGB, PILEUS_FORMAT_RGBA16F, PILEUS_FORMAT_RGBA32F}) {
            auto frame = cleared<pileus_frame>();
            frame.colour = pixels.data(), frame.colour_stride = stride, frame.format = format;
            r.refused(pileus_session_render(r.s, &frame, r.e), "frame.colour.stride: ");
        }
        auto frame = cleared<pileus_frame>();
        frame.depth = pixels.data(), frame.depth_stride = stride;
        r.refused(pileus_session_render(r.s, &frame, r.e), "frame.depth.stride: ");
    }
    auto frame = cleared<pileus_frame>();
    frame.colour = pixels.data();
    for (const float wrong : {float(kNone), float(kEndless), -float(kEndless), 101.0f, -101.0f}) {
        frame.exposure_stops = wrong;
        r.refused(pileus_session_render(r.s, &frame, r.e), "frame.exposure_stops: ");
    }
    frame.exposure_stops = 0;
    for (const auto wrong : {&pileus_frame::format, &pileus_frame::blend, &pileus_frame::depth_kind,
                             &pileus_frame::depth_format})
        for (const std::uint32_t value : {5u, kHuge, kMax}) {
            pileus_frame given = frame;
            given.*wrong = value;
            r.refused(pileus_session_render(r.s, &given, r.e), "frame.");
        }
    char text[8];
    std::size_t needed = 0;
    r.refused(pileus_session_report(r.s, nullptr, 8, &needed, r.e), "text: null");
    CHECK(pileus_session_report(r.s, text, sizeof text, nullptr, r.e) == PILEUS_ERROR_LIMIT);
}

TEST_CASE("misuse: work, costs and the governor's own numbers") {
    Refusals r;
    using W = pileus_work;
    for (const auto at : {&W::scale, &W::temporal, &W::steps, &W::light_refresh})
        for (const std::uint32_t wrong : {65u * 1024, (1u << 30) + 1, kHuge, kMax}) {
            auto work = cleared<W>();
            work.*at = wrong;
            r.refused(pileus_session_set_work(r.s, &work, r.e), ": ");
            auto most = cleared<pileus_units>();
            CHECK(pileus_session_most_units(r.s, &work, &most, r.e) != PILEUS_ERROR_LIMIT);
        }
    for (const std::uint64_t wrong : {std::uint64_t{1}, std::uint64_t{1} << 63, UINT64_MAX}) {
        auto work = cleared<W>();
        work.photons = wrong;
        r.refused(pileus_session_set_work(r.s, &work, r.e), "work.photons: ");
    }
    using C = pileus_costs;
    auto costs = cleared<C>();
    auto work = cleared<W>();
    r.numbers<C>(costs,
                 "costs: ", [&](const C& c) { return pileus_session_fit(r.s, &c, 1, &work, r.e); },
                 {member(&C::fixed), member(&C::pixel), member(&C::ray), member(&C::sample),
                  member(&C::photon)});
    for (const double wrong : {kNone, kEndless, -1.0}) {
        r.refused(pileus_session_fit(r.s, &costs, wrong, &work, r.e), "most: ");
        auto governor = cleared<pileus_governor>();
        governor.target_s = wrong;
        r.refused(pileus_session_govern(r.s, &governor, 0, &work, r.e), "governor.target_s: ");
        governor.target_s = 0.04;
        r.refused(pileus_session_govern(r.s, &governor, wrong, &work, r.e), "frame_s: ");
    }
    auto governor = cleared<pileus_governor>();
    governor.target_s = 0.04;
    governor.level = kMax;
    for (std::uint32_t& v : governor.own_counts) v = kMax;
    r.host.check(pileus_session_govern(r.s, &governor, 1, &work, r.e));
    for (std::size_t i = 0; i < 16; ++i) {
        pileus_governor given = governor;
        given.own_times[i] = i % 2 == 0 ? kNone : -1;
        r.refused(pileus_session_govern(r.s, &given, 1, &work, r.e), "governor.own_times: ");
    }
}

TEST_CASE("misuse: a struct that ends within a pointer has nothing of it") {
    Refusals r;
    std::vector<float> depths(24 * 14, -7.0f);
    const std::vector<float> before = depths;
    for (const std::size_t cut : {1, 4, 7}) {
        auto frame = cleared<pileus_frame>();
        frame.depth = depths.data();
        frame.struct_size = marked(offsetof(pileus_frame, depth) + cut);
        CHECK(pileus_session_render(r.s, &frame, r.e) == PILEUS_OK);
        CHECK(depths == before);
    }
}
