// SPDX-License-Identifier: Apache-2.0
// Optics of media that a live session takes from another scene: as a session of a new world of it.
// in: every method, kinds of media -> out: hashes against new worlds'; refusals.
// docs/embedding.md, "What may change"
#include "tests/embed/settings_rows.h"
#include "tests/io/temp_folder.h"

using namespace host_test;
using render_test::kSmallCumulus;
using settings_test::kParticles;
using settings_test::kSkyInPlace;

namespace {

const Overrides kMethods[] = {
    {"method.name=raymarch", "raymarch.steps=24"},
    {"method.name=raymarch", "raymarch.steps=24", "raymarch.temporal=4"},
    {"method.name=optical-depth"},
    {"method.name=collectors", "collectors.photons=2000"},
    {"method.name=collectors", "collectors.photons=2000", "collectors.display=billboards"},
    {"method.name=photon-grid", "photon_grid.photons=2000", "photon_grid.ring=true"},
    {"method.name=path", "path.samples_per_pixel=2"},
};

/// Thinner, darker, more forward; emission and another kind of phase function; none at all.
const Overrides kOptics[] = {
    {"medium.0.extinction_per_m=0.003", "medium.0.albedo=[0.8, 0.85, 0.9]",
     "medium.0.phase={type=\"henyey-greenstein\", g=0.3}"},
    {"medium.0.extinction_per_m=0.1", "medium.0.phase={type=\"isotropic\"}"},
    {"medium.0.extinction_per_m=0"},
};

Overrides joined(Overrides a, const Overrides& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

pileus_code set_media(Hosted& host, const std::string& text, const Overrides& overrides) {
    const SceneHandle scene = scene_of(text, overrides);
    return pileus_session_set_media(host.session.get(), scene.get(), &host.out.error);
}

/// Camera and sun of a host, and all light.
std::string lit_hash(Hosted& host) {
    host.aim({300, -3500, 500}, {0, 0, 1000}, 35, 20, 12);
    host.sun(200, 50, 2);
    host.step(host.whole());
    return host.hash();
}

}  // namespace

TEST_CASE("media: other optics give the bits of a new world, in every method, and back") {
    for (const Overrides& method : kMethods) {
        CAPTURE(method[0]);
        CAPTURE(method.back());
        Hosted live(kSmallCumulus, method);
        REQUIRE_MESSAGE(live.code == PILEUS_OK, live.out.line());
        const std::string first = lit_hash(live);
        for (const Overrides& optics : kOptics) {
            CAPTURE(optics[0]);
            Hosted fresh(kSmallCumulus, joined(method, optics));
            const pileus_code code = set_media(live, kSmallCumulus, joined(method, optics));
            if (fresh.code != PILEUS_OK) {
                CHECK(code == fresh.code);
                continue;
            }
            REQUIRE_MESSAGE(code == PILEUS_OK, live.out.line());
            // Camera and sun are still those that the host set.
            live.step(live.whole());
            const std::string changed = live.hash();
            CHECK(changed == lit_hash(fresh));
            CHECK(changed != first);
        }
        REQUIRE(set_media(live, kSmallCumulus, method) == PILEUS_OK);
        live.step(live.whole());
        CHECK(live.hash() == first);
    }
}

TEST_CASE("media: of a world from a host's memory, whose arrays are gone") {
    const std::string text =
        std::string(kSmallCumulus)
            .replace(std::string(kSmallCumulus).find("procedural:cumulus"), 18, "uniform:box");
    const Overrides method{"method.name=raymarch", "raymarch.steps=24"};
    const auto open = [&](const Overrides& overrides) {
        std::vector<float> cells(8 * 8 * 8);
        for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = 0.1f * float(i % 11);
        auto density = cleared<pileus_density>();
        for (std::uint32_t& n : density.size) n = 8;
        density.values = cells.data();
        Hosted host(text, overrides);
        pileus_world* world = nullptr;
        host.check(
            pileus_world_create(host.scene.get(), nullptr, &density, 1, &world, &host.out.error));
        host.world.reset(world);
        host.open(nullptr);
        REQUIRE_MESSAGE(host.code == PILEUS_OK, host.out.line());
        return host;
    };
    Hosted live = open(method);
    const std::string first = lit_hash(live);
    for (const Overrides& optics : kOptics) {
        REQUIRE_MESSAGE(set_media(live, text, joined(method, optics)) == PILEUS_OK,
                        live.out.line());
        Hosted fresh = open(joined(method, optics));
        CHECK(live.hash() == lit_hash(fresh));
    }
    REQUIRE(set_media(live, text, method) == PILEUS_OK);
    CHECK(live.hash() == first);
}

TEST_CASE("media: several on one grid, a sky in place, particles") {
    const std::string second = std::string(kSmallCumulus) + R"(
[[medium]]
density = "uniform:box"
bounds_m = [[-768, -768, 512], [768, 768, 1536]]
resolution = [2, 2, 2]
extinction_per_m = 0.0005
)";
    struct Row {
        std::string text;
        Overrides method;
    };
    const Row rows[] = {
        {second, {"method.name=raymarch", "raymarch.steps=24"}},
        {second, {"method.name=path", "path.samples_per_pixel=2"}},
        {kSkyInPlace, {"method.name=raymarch", "raymarch.steps=24", "camera.resolution=[20, 12]"}},
        {kParticles, {"method.name=particles"}},
    };
    for (const Row& row : rows) {
        CAPTURE(row.method[0]);
        Hosted live(row.text, row.method);
        REQUIRE_MESSAGE(live.code == PILEUS_OK, live.out.line());
        live.step(live.whole());
        const std::string first = live.hash();
        const Overrides other =
            joined(row.method, {"medium.0.extinction_per_m=0.02", "medium.0.albedo=0.7"});
        REQUIRE_MESSAGE(set_media(live, row.text, other) == PILEUS_OK, live.out.line());
        Hosted fresh(row.text, other);
        REQUIRE_MESSAGE(fresh.code == PILEUS_OK, fresh.out.line());
        live.step(live.whole());
        fresh.step(fresh.whole());
        CHECK(live.hash() == fresh.hash());
        CHECK(live.hash() != first);
    }
}

TEST_CASE("media: what cannot be is refused in a line and changes nothing") {
    Hosted live(kSmallCumulus, {"method.name=raymarch", "raymarch.steps=24"});
    const std::string first = live.hash();
    const auto refused = [&](pileus_code code, const char* line) {
        CHECK(code == PILEUS_ERROR_INPUT);
        CHECK_MESSAGE(live.out.line().find(line) == 0, live.out.line());
        CHECK(live.hash() == first);
    };
    refused(pileus_session_set_media(live.session.get(), nullptr, &live.out.error), "scene: null");
    CHECK(pileus_session_set_media(nullptr, live.scene.get(), nullptr) == PILEUS_ERROR_INPUT);
    refused(set_media(live, "[camera]\nposition_m = [0, 0, 0]\ntarget_m = [0, 1, 0]", {}),
            "media: the scene has 0, the session 1");
    // The same optics: nothing is made again.
    const std::uint32_t prepared = live.stats().prepared;
    CHECK(set_media(live, kSmallCumulus, {}) == PILEUS_OK);
    CHECK(live.stats().prepared == prepared);
    CHECK(live.hash() == first);
}

TEST_CASE("media: of a session whose host turned them, lit from any side") {
    const Overrides method{"method.name=raymarch", "raymarch.steps=24"};
    const auto turned = [&](Hosted& host) {
        host.sun(300, 40);
        auto place = cleared<pileus_placement>();
        place.yaw_deg = 90;
        host.check(pileus_session_set_placement(host.session.get(), &place, &host.out.error));
        return host.hash();
    };
    Hosted live(kSmallCumulus, method), fresh(kSmallCumulus, joined(method, kOptics[0]));
    const std::string first = turned(live);
    REQUIRE_MESSAGE(set_media(live, kSmallCumulus, joined(method, kOptics[0])) == PILEUS_OK,
                    live.out.line());
    const std::string changed = live.hash();
    CHECK(changed == turned(fresh));
    CHECK(changed != first);
}

TEST_CASE("media: a phase function's file lies beside its own scene") {
    const pileus::test::TempFolder here, there;
    here.put("p.txt", "0 1\n90 1\n180 1\n");
    there.put("p.txt", "0 9\n20 1\n180 0.2\n");
    const Overrides sets{"method.name=raymarch", "raymarch.steps=24",
                         "medium.0.phase={type=\"table\", file=\"p.txt\"}"};
    const auto open = [&](const std::string& folder) {
        std::vector<const char*> texts;
        for (const std::string& o : sets) texts.push_back(o.c_str());
        pileus_scene* scene = nullptr;
        Outcome out;
        REQUIRE_MESSAGE(
            pileus_scene_parse(kSmallCumulus, folder.c_str(), texts.data(),
                               std::uint32_t(texts.size()), &scene, &out.error) == PILEUS_OK,
            out.line());
        return SceneHandle(scene);
    };
    const SceneHandle one = open(here.path("")), other = open(there.path(""));
    const auto session_of = [](const SceneHandle& scene, Hosted& host) {
        pileus_world* world = nullptr;
        host.check(pileus_world_create(scene.get(), nullptr, nullptr, 0, &world, &host.out.error));
        host.session.reset();
        host.world.reset(world);
        pileus_session* session = nullptr;
        host.check(pileus_session_create(world, scene.get(), nullptr, &session, &host.out.error));
        host.session.reset(session);
        return host.hash();
    };
    Hosted live(kSmallCumulus, {"method.name=raymarch"}),
        fresh(kSmallCumulus, {"method.name=raymarch"});
    const std::string first = session_of(one, live), wanted = session_of(other, fresh);
    CHECK(first != wanted);
    live.check(pileus_session_set_media(live.session.get(), other.get(), &live.out.error));
    CHECK(live.hash() == wanted);
}
