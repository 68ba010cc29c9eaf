// SPDX-License-Identifier: Apache-2.0
// Camera paths: the same film from every instruction set, number of threads and way of asking.
// in: one scene of everything, traced in many ways -> out: equal bits; nothing is stored.
// docs/path.md: samples belong to (seed, pixel, number) and are added up in their order.
#include "src/base/digest.h"
#include "tests/support/path_harness.h"
#include "tests/support/sky_images.h"

namespace {

using namespace path_test;

/// Two coloured media of different phases over a grey ground.
Rig make_everything() {
    Rig rig = make_rig({12, 10, 8}, {120, 100, 80}, 0.08);
    Medium& m = rig.medium;
    m.count = 2;
    m.channels = 3;
    REQUIRE(m.parts.resize(voxel_count(m.grid), "parts"));
    std::size_t v = 0;
    for (int z = 0; z < 8; ++z)
        for (int y = 0; y < 10; ++y)
            for (int x = 0; x < 12; ++x, ++v) {
                m.volume.density[v] = float((x * 7 + y * 5 + z * 3) % 11) / 10;
                m.parts[v] = m.volume.density[v] * float((x + y + z) % 3) * 0.5f;
            }
    m.optics[0] = {{0.99f, 0.9f, 0.8f}, 0.99f, {kPhaseHg, 0.8f, 0, 1}};
    m.optics[1] = {{0.7f, 0.95f, 1}, 1, {kPhaseTwoLobe, 0.5f, -0.3f, 0.75f}};
    set_majorants(rig, 2);
    shine(rig, {0.48f, 0.36f, 0.8f});
    set_ground(rig, -10, 0.6);
    return rig;
}

std::string digest_of(const Film& film) {
    Digest d;
    d.doubles(film.sum.span());
    d.doubles(film.square.span());
    std::int64_t words[sizeof film.tally / 8];
    std::memcpy(words, &film.tally, sizeof film.tally);
    d.integers({words, sizeof film.tally / 8});
    return d.hex();
}

std::string film_digest(const PathInput& in, std::initializer_list<std::uint64_t> pieces) {
    Film film;
    PathScratch scratch;
    REQUIRE(make_film(in, film));
    for (std::uint64_t samples : pieces) REQUIRE(trace_paths(in, samples, scratch, film));
    CHECK(film.tally.scatterings > 1000);
    CHECK(film.tally.bounces > 100);
    CHECK(film.tally.nan == 0);
    return digest_of(film);
}

/// `once`, from every instruction set, by other threads and pieces.
void check_one_film(PathInput in, const std::string& once) {
    for (int i = 0; const KernelTable* kernels = kernel_table_at(i); ++i) {
        in.kernels = kernels;
        INFO(kernels->name);
        CHECK(film_digest(in, {37}) == once);
        in.threads = 3;
        CHECK(film_digest(in, {1, 20, 16}) == once);
        in.threads = 1;
    }
}

TEST_CASE("one film from every instruction set, thread count and order of asking") {
    Rig rig = make_everything();
    const SkyMap map =
        sky_test::sky_map_of(sky_test::rough_sky(8, 5, true), true, rig.medium.extent_m, 20);
    for (bool mapped : {false, true}) {
        set_sky(rig, mapped ? 0 : 0.3);
        rig.lighting.map = mapped ? map.view : SkyMapView{};
        PathInput in = path_input(rig, make_view({-40, -60, 30}, {0.6f, 0.8f, 0}, 24, 16), 11);
        in.parts = mapped;
        check_one_film(in, film_digest(in, {37}));
    }
}

TEST_CASE("a brief film keeps the whole light and the media's, to the bit, and no more") {
    Rig rig = make_everything();
    for (bool parts : {false, true}) {
        PathInput in = path_input(rig, make_view({-40, -60, 30}, {0.6f, 0.8f, 0}, 24, 16), 11);
        in.parts = parts;
        Film whole, brief;
        PathScratch scratch, other;
        REQUIRE(make_film(in, whole));
        REQUIRE(trace_paths(in, 5, scratch, whole));
        in.brief = true;
        REQUIRE(make_film(in, brief));
        REQUIRE(trace_paths(in, 5, other, brief));
        CHECK(brief.sum.size() == (parts ? 6 : 3) * brief.pixels());
        CHECK(brief.square.empty());
        std::size_t differ = 0, shared = 0;
        for (int part : {int(kPathTotal), parts ? int(kPathCloud) : int(kPathTotal)})
            for (int c = 0; c < 3; ++c)
                for (std::size_t i = 0; i < whole.pixels(); ++i) {
                    differ += film_mean(whole, part, c, i) != film_mean(brief, part, c, i);
                    shared += film_mean(whole, part, c, i) > 0;
                }
        CHECK(differ == 0);
        CHECK(shared > whole.pixels());
        CHECK(film_error(whole, 1, whole.pixels() / 2) > 0);
        CHECK(film_error(brief, 1, whole.pixels() / 2) == 0);
    }
}

TEST_CASE("one film of guided paths and of the sun's disc from every instruction set") {
    Rig rig = make_everything();
    rig.medium.optics[0].phase = {kPhaseHg, 0.97f, 0, 1};
    const SkyMap map =
        sky_test::sky_map_of(sky_test::rough_sky(8, 5, true), true, rig.medium.extent_m, 20);
    rig.lighting.map = map.view;
    PathInput in = path_input(rig, make_view({-40, -60, 30}, {0.6f, 0.8f, 0}, 24, 16), 11);
    std::vector<std::string> films;
    for (double radius : {0.0, 3.0})
        for (bool guide : {true, false}) {
            in.rules.guide = guide;
            in.rules.sun_radius_deg = radius;
            const std::string once = film_digest(in, {37});
            for (const std::string& other : films) CHECK(once != other);
            films.push_back(once);
            check_one_film(in, once);
        }
}

TEST_CASE("where no phase function is peaked a guide changes no bit") {
    Rig rig = make_everything();
    PathInput in = path_input(rig, make_view({-40, -60, 30}, {0.6f, 0.8f, 0}, 24, 16), 11);
    const std::string once = film_digest(in, {37});
    in.rules.guide = false;
    CHECK(film_digest(in, {37}) == once);
}

TEST_CASE("the scratch's size and the film's parts change nothing") {
    Rig rig = make_everything();
    PathInput in = path_input(rig, make_view({60, 50, 40}, {0.6f, 0.8f, 0}, 5, 3), 11);
    Film small, large;
    PathScratch narrow, wide;
    REQUIRE(make_film(in, small));
    REQUIRE(prepare_path(in, narrow));
    // Bands of two pixels and of one, runs of seven samples and of twenty.
    narrow.capacity = 20;
    REQUIRE(trace_paths(in, 7, narrow, small));
    REQUIRE(trace_paths(in, 33, narrow, small));
    in.parts = true;
    REQUIRE(make_film(in, large));
    REQUIRE(trace_paths(in, 40, wide, large));
    for (std::size_t i = 0; i < small.sum.size(); ++i) CHECK(small.sum[i] == large.sum[i]);
    for (std::size_t i = 0; i < small.square.size(); ++i) CHECK(small.square[i] == large.square[i]);
}

TEST_CASE("seeds, pixels and numbers have random numbers of their own") {
    Rig rig = make_everything();
    PathInput in = path_input(rig, make_view({60, 50, 40}, {0.6f, 0.8f, 0}, 4, 4), 1);
    const std::string one = film_digest(in, {100});
    in.seed = 2;
    CHECK(film_digest(in, {100}) != one);

    // A film's second sample is not its first, and no two pixels share theirs.
    in.camera = make_view({60, 50, 40}, {0.6f, 0.8f, 0}, 2, 1);
    in.camera.half_width = in.camera.half_height = 0;
    const Film first = trace_film(in, 1), both = trace_film(in, 2);
    CHECK(first.sum[0] != first.sum[1]);
    CHECK(both.sum[0] - first.sum[0] != first.sum[0]);
}

}  // namespace
