// SPDX-License-Identifier: Apache-2.0
// Sizes, strides and numbers of worlds, comparisons, hosts and skies of clouds that cannot be
// meant. in: tables of wrong values -> out: one line each, and everything as it was.
// docs/embedding.md
#include <cstdint>
#include <functional>
#include <limits>

#include "tests/embed/clouds_harness.h"

using namespace clouds_test;

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kEndless = std::numeric_limits<double>::infinity();
constexpr std::uint32_t kHuge = 1u << 31, kMax = UINT32_MAX;

template <class Struct>
std::function<void(Struct&, double)> number(double Struct::*at) {
    return [at](Struct& s, double v) { s.*at = v; };
}
template <class Struct, std::size_t N>
std::function<void(Struct&, double)> number(double (Struct::*at)[N], std::size_t i) {
    return [at, i](Struct& s, double v) { (s.*at)[i] = v; };
}

}  // namespace

TEST_CASE("misuse: densities and particles of a world") {
    const SceneHandle scene = scene_of(
        "[camera]\nposition_m = [0, -9, 0]\ntarget_m = [0, 0, 0]\n[method]\nname = \"raymarch\"\n"
        "[[medium]]\ndensity = \"uniform:box\"\nbounds_m = [[0, 0, 0], [1, 1, 1]]\n"
        "extinction_per_m = 1\n"
        "[[medium]]\ndensity = \"host.ply\"\n",
        {});
    Outcome out;
    const auto refused = [&](const std::vector<pileus_density>& given, std::uint32_t count,
                             const char* word) {
        CAPTURE(word);
        pileus_world* world = nullptr;
        CHECK(pileus_world_create(scene.get(), nullptr, given.data(), count, &world, &out.error) ==
              PILEUS_ERROR_INPUT);
        CHECK(world == nullptr);
        CHECK_MESSAGE(out.line().find(word) != std::string::npos, out.line());
    };
    std::vector<float> cells(8, 1.0f);
    auto sound = cleared<pileus_density>();
    for (std::uint32_t& n : sound.size) n = 2;
    sound.values = cells.data();
    for (int axis = 0; axis < 3; ++axis)
        for (const std::uint32_t wrong : {0u, 4097u, kHuge, kMax}) {
            pileus_density given = sound;
            given.size[axis] = wrong;
            refused({given}, 1, "densities[0]: size: ");
            // All of them at once: their product has more than 64 bits.
            for (std::uint32_t& n : given.size) n = wrong;
            refused({given}, 1, "densities[0]: size: ");
        }
    for (const float wrong : {float(kNone), float(kEndless), -1.0f}) {
        cells[7] = wrong;
        refused({sound}, 1, "densities[0]: cell 7: ");
    }
    cells[7] = 1;
    pileus_density given = sound;
    given.values = nullptr;
    refused({given}, 1, "densities[0]: values: null");
    given = sound;
    for (const std::uint32_t medium : {2u, kHuge, kMax}) {
        given.medium = medium;
        refused({given}, 1, "densities[0]: no medium");
    }
    refused({sound, sound}, 2, "densities[1]: medium 0 a second time");
    refused({sound}, 3, "density_count: 3, allowed: 0 to 2");
    refused({sound}, kMax, "density_count: ");
    refused({}, 1, "densities: null");
    for (const std::uint32_t size :
         {0u, 3u, std::uint32_t(sizeof given), marked(sizeof given + 8), kMax}) {
        given = sound;
        given.struct_size = size;
        refused({sound, given}, 2, "densities[1]: not initialised");
    }

    const std::vector<float> numbers(64, 1.0f);
    const std::vector<std::uint64_t> ids(16, 1);
    using P = pileus_particles;
    auto cloud = cleared<P>();
    cloud.count = 2;
    cloud.position = cloud.velocity = cloud.colour = cloud.emission = numbers.data();
    cloud.radius = cloud.density = numbers.data();
    cloud.id = ids.data();
    cloud.position_stride = cloud.velocity_stride = cloud.colour_stride = cloud.emission_stride =
        12;
    cloud.radius_stride = cloud.density_stride = 4, cloud.id_stride = 8;
    const auto wrong = [&](const P& particles, const char* word) {
        auto own = cleared<pileus_density>();
        own.medium = 1;
        own.particles = &particles;
        refused({own}, 1, word);
    };
    for (const auto stride :
         {&P::position_stride, &P::radius_stride, &P::density_stride, &P::id_stride,
          &P::velocity_stride, &P::colour_stride, &P::emission_stride})
        for (const std::uint32_t bytes : {0u, 1u, 3u}) {
            P own = cloud;
            own.*stride = bytes;
            wrong(own, "_stride: ");
        }
    for (const std::uint64_t count : {std::uint64_t{1} << 62, std::uint64_t{1} << 63, UINT64_MAX}) {
        P own = cloud;
        own.count = count;
        wrong(own, "densities[0]: count: ");
    }
    P own = cloud;
    own.position = nullptr;
    wrong(own, "densities[0]: position: null");
    own = cloud;
    own.radius = nullptr;
    wrong(own, "radius: missing");
    own = cloud;
    own.struct_size = 0;
    wrong(own, "particles: null or not initialised");
}

TEST_CASE("misuse: two pictures to compare, what a host lends, and clouds") {
    Outcome out;
    const std::vector<float> values(64, 1.0f);
    using P = pileus_picture;
    auto sound = cleared<P>();
    sound.width = sound.height = 4, sound.channels = 3, sound.values = values.data();
    auto figures = cleared<pileus_figures>();
    const auto refused = [&](pileus_code code, const char* word) {
        CAPTURE(word);
        CHECK(code == PILEUS_ERROR_INPUT);
        CHECK_MESSAGE(out.line().find(word) != std::string::npos, out.line());
    };
    const struct {
        const char* word;
        std::function<void(P&)> spoil;
    } rows[] = {
        {"size: 0", [](P& p) { p.width = 0; }},
        {"size: 0", [](P& p) { p.height = 0; }},
        {"size: ", [](P& p) { p.width = kHuge; }},
        {"size: ", [](P& p) { p.height = kMax; }},
        {"size: ", [](P& p) { p.width = p.height = kHuge; }},
        {"channels: 0", [](P& p) { p.channels = 0; }},
        {"channels: 2", [](P& p) { p.channels = 2; }},
        {"channels: ", [](P& p) { p.channels = kHuge; }},
        {"values: null", [](P& p) { p.values = nullptr; }},
        {"stride: ", [](P& p) { p.stride = 1; }},
        {"stride: ", [](P& p) { p.stride = -48; }},
        {"stride: ", [](P& p) { p.stride = INT64_MAX; }},
        {"not initialised", [](P& p) { p.struct_size = 0; }},
    };
    for (const auto& row : rows) {
        P given = sound;
        row.spoil(given);
        for (const bool first : {true, false})
            refused(pileus_compare(first ? &given : &sound, first ? &sound : &given, -1, 0, nullptr,
                                   &figures, &out.error),
                    row.word);
    }
    for (const double wrong : {kNone, kEndless, 1.5})
        refused(pileus_compare(&sound, &sound, wrong, 0, nullptr, &figures, &out.error),
                "alpha_least: ");

    const SceneHandle scene = scene_of(kSmallCumulus, {"method.name=raymarch"});
    auto plan = cleared<pileus_plan>();
    auto host = cleared<pileus_host>();
    for (const std::uint32_t threads : {1025u, kHuge, kMax}) {
        host.threads = threads;
        refused(pileus_plan_scene(scene.get(), &host, &plan, &out.error), "host.threads: ");
    }
    host.threads = 1;
    host.release = [](void*, void*) {};
    refused(pileus_plan_scene(scene.get(), &host, &plan, &out.error), "host: allocate and release");
    pileus_scene* made = nullptr;
    refused(pileus_scene_parse("", nullptr, nullptr, kMax, &made, &out.error), "overrides: null");
    const char* const texts[2] = {"seed=1", nullptr};
    refused(pileus_scene_parse("", nullptr, texts, 2, &made, &out.error), "overrides[1]: null");

    CloudySky sky({at(0, 0, 0)});
    const std::uint64_t before = sky.draw().hash;
    pileus_clouds* const clouds = sky.clouds.get();
    std::vector<pileus_cloud> two(2, at(0, 0, 0));
    const auto place = [&](std::uint32_t count) {
        return pileus_clouds_place(clouds, two.data(), count, &out.error);
    };
    for (const std::uint32_t size :
         {0u, 3u, std::uint32_t(sizeof two[0]), marked(sizeof two[0] - 8), kMax}) {
        two[1].struct_size = size;
        refused(place(2), "places[1]: not initialised");
    }
    two[1] = at(0, 0, 0);
    refused(place(kMax), "count: ");
    two[1].kind = kMax;
    refused(place(2), "places[1].kind: ");
    using C = pileus_cloud;
    for (const auto& spoil : {number(&C::offset_m, 0), number(&C::offset_m, 1),
                              number(&C::offset_m, 2), number(&C::yaw_deg), number(&C::scale)})
        for (const double wrong : {kNone, kEndless, -kEndless}) {
            two[1] = at(0, 0, 0);
            spoil(two[1], wrong);
            refused(place(2), "places[1].");
        }
    using D = pileus_cloud_detail;
    for (const auto at : {&D::error_px, &D::near_px, &D::sharpness, &D::sun_deg})
        for (const double wrong : {kNone, kEndless, -kEndless, -1.0}) {
            auto detail = cleared<D>();
            detail.*at = wrong;
            refused(pileus_clouds_set_detail(clouds, &detail, &out.error), "detail.");
        }
    for (const auto at : {&D::near_scale, &D::blend_frames})
        for (const std::uint32_t wrong : {kHuge, kMax}) {
            auto detail = cleared<D>();
            detail.*at = wrong;
            refused(pileus_clouds_set_detail(clouds, &detail, &out.error), "detail.");
        }
    CHECK(sky.draw().hash == before);
}
