// SPDX-License-Identifier: Apache-2.0
// Runs that end early: within a pass, a generation, a picture or a ring, and what is left of them.
// in: small scenes, ended at chosen moments -> out: nothing lost, nothing counted twice.
// docs/program.md, "Interrupting" and "Budgets"
#include <memory>

#include "src/methods/path/film_file.h"
#include "tests/io/temp_folder.h"
#include "tests/support/path_harness.h"
#include "tests/support/render_harness.h"

using namespace path_test;
using render_test::kSmallCumulus;
using render_test::Picture;
using render_test::render_one;
using render_test::scene_from;

namespace {

/// Asks for an end at the n-th question.
std::function<bool()> stop_at(int n) {
    auto asked = std::make_shared<int>(0);
    return [asked, n] { return ++*asked >= n; };
}

/// A thin layer seen by so many pixels that a pass takes several launches.
struct Layer {
    Rig rig = make_slab(0.1, 1, 0);
    PathInput in;
    Layer() {
        shine(rig, {0, 0.6f, 0.8f});
        in = path_input(rig, make_flat_view({5e4f, 5e4f, 2}, {0, 0, -1}, 100, 500, 400), 9);
    }
};

bool same_film(const Film& a, const Film& b) {
    bool same = a.samples == b.samples && a.ahead == b.ahead;
    same = same && std::memcmp(&a.tally, &b.tally, sizeof a.tally) == 0;
    for (std::size_t i = 0; i < a.sum.size(); ++i) same = same && a.sum[i] == b.sum[i];
    for (std::size_t i = 0; i < a.square.size(); ++i) same = same && a.square[i] == b.square[i];
    return same;
}

std::vector<std::string> hashes_of(const Scene& scene, const RenderOptions& options) {
    std::vector<std::string> hashes;
    REQUIRE(render(scene, options, [&](int, Image&, Report& report) {
        hashes.push_back(report.hash);
        return Status::ok();
    }));
    return hashes;
}

}  // namespace

TEST_CASE("path: a pass that is ended within keeps what it has, and goes on to the same bits") {
    const test::TempFolder folder;
    const std::string path = folder.path("film.state");
    Layer layer;
    const Film whole = trace_film(layer.in, 3);
    PathInput in = layer.in;
    // A pass is launches of 8 pieces and of 5; each asks before all pieces and before each one.
    in.ended = stop_at(12);
    Film film;
    PathScratch scratch;
    REQUIRE(make_film(in, film));
    REQUIRE(trace_paths(in, 1, scratch, film));
    CHECK(film.samples == 0);
    CHECK(film.ahead > 0);
    CHECK(film.ahead < film.pixels());
    CHECK(film.ahead_samples == 1);
    CHECK(film.tally.paths == std::int64_t(film.ahead));
    CHECK(film_mean(film, 0, 0, std::size_t(film.ahead)) == 0);
    // Through a file, and with other threads, which make other launches.
    REQUIRE(write_path_state(path, 1, film));
    Film resumed;
    PathScratch other;
    in.ended = nullptr;
    in.threads = 2;
    REQUIRE(make_film(in, resumed));
    REQUIRE(read_path_state(path, 1, resumed));
    CHECK(same_film(film, resumed));
    REQUIRE(trace_paths(in, 3, other, resumed));
    CHECK(same_film(whole, resumed));
}

TEST_CASE("path: without an end the same film comes from every question asked") {
    Layer layer;
    PathInput in = layer.in;
    in.ended = [] { return false; };
    CHECK(same_film(trace_film(layer.in, 2), trace_film(in, 2)));
}

TEST_CASE("photons: a generation that is ended within counts as the part that was shot") {
    Rig rig = make_slab(1, 1, 0);
    add_light(rig, beam_light(rig.medium, {0, 0, -1}));
    rig.lighting.lights[0].photons = 100'000;  // 25 pieces
    TraceInput in = input_of(rig, 3);
    in.ended = stop_at(9);
    TraceScratch scratch;
    PhotonSlot slot;
    std::vector<TraceTally> tallies(1);
    REQUIRE(prepare_trace(in, scratch));
    REQUIRE(slot.sums.resize(slot_stride(in), "test"));
    REQUIRE(trace_generation(in, 0, scratch, slot, tallies));
    CHECK(slot.generations == 0);
    REQUIRE(slot.parts.size() == 1);
    CHECK(tallies[0].photons == 7 * 4096);
    CHECK(slot.generations_of(0) == 7 * 4096 / 100'000.0);
}

TEST_CASE("raymarch: interrupted within a picture there is none") {
    for (int questions : {1, 2, 3}) {
        RenderOptions options;
        options.interrupted = stop_at(questions);
        options.threads = 1;
        const Status status =
            render(scene_from(kSmallCumulus, {"method.name=raymarch", "output.layers=[]"}), options,
                   [](int, Image&, Report&) {
                       FAIL("a picture that was not whole");
                       return Status::ok();
                   });
        CHECK(status.code == Code::kCheckFailed);
        CHECK(status.message.find("interrupted before the picture was whole") == 0);
    }
}

TEST_CASE("what may be lost is held, from the first light to the files") {
    for (const char* method : {"path", "collectors", "photon-grid", "raymarch"}) {
        RenderOptions options;
        bool held = false, traced = false;
        options.holding = [&](bool hold) { held = hold; };
        options.interrupted = [&] {
            traced = true;
            CHECK(held == (std::string(method) != "raymarch"));
            return false;
        };
        const Scene scene = scene_from(
            kSmallCumulus,
            {std::string("method.name=") + method, "output.layers=[]", "path.samples_per_pixel=2"});
        REQUIRE(render(scene, options, [&](int, Image&, Report&) {
            CHECK(held);
            return Status::ok();
        }));
        CHECK(traced);
        CHECK_FALSE(held);
    }
}

TEST_CASE("collectors: a ring ends with the time, and grows from frame to frame") {
    const Scene scene = scene_from(kSmallCumulus, {"animation.frames=8", "output.layers=[]"});
    for (int first : {0, 3}) {
        RenderOptions options;
        options.first_frame = first;
        options.last_frame = first + 3;
        options.budget.seconds = 1e-9;
        std::uint64_t held = 0;
        std::vector<double> light;
        REQUIRE(render(scene, options, [&](int, Image& image, Report& report) {
            CHECK(report.photons.ring_generations == ++held);
            CHECK(report.photons.ring_whole == 4);
            CHECK(report.photons.traced == held * 3000);
            double sum = 0;
            for (float v : image.find("G")->pixels.span()) sum += double(v);
            light.push_back(sum);
            return Status::ok();
        }));
        // All of the ring's light is in each picture, whatever its length: noise alone differs.
        REQUIRE(light.size() == 4);
        for (double sum : light) CHECK(std::fabs(sum / light[3] - 1) < 0.05);
        options.budget.seconds = 0;
        REQUIRE(render(scene, options, [&](int, Image&, Report& report) {
            CHECK(report.photons.ring_generations == 4);
            return Status::ok();
        }));
    }
}

TEST_CASE("photons: so many generations are the bits of the time that chose them") {
    struct Case {
        const char* method;
        std::vector<std::string> more;
    };
    for (const Case& c : {Case{"collectors", {}}, Case{"collectors", {"output.layers=[error]"}},
                          Case{"collectors", {"animation.frames=9"}}, Case{"photon-grid", {}},
                          Case{"photon-grid", {"animation.frames=9"}},
                          Case{"photon-grid", {"animation.frames=9", "photon_grid.ring=true"}}}) {
        CAPTURE(c.method);
        std::vector<std::string> keys = c.more;
        keys.push_back(std::string("method.name=") + c.method);
        const Scene scene = scene_from(kSmallCumulus, keys);
        RenderOptions options;
        options.last_frame = scene.animation.present ? 2 : 0;
        const std::vector<std::string> whole = hashes_of(scene, options);
        options.budget.seconds = 1e-9;
        const std::vector<std::string> short_of = hashes_of(scene, options);
        options.budget.seconds = 0;
        options.budget.generations = 1;
        CHECK(hashes_of(scene, options) == short_of);
        CHECK(short_of[0] != whole[0]);
        // More than a ring, or the scene's sum, holds: a grid's sum alone may have more.
        options.budget.generations = 6;
        const bool sum = std::string(c.method) == "photon-grid" && c.more.size() < 2;
        CHECK((hashes_of(scene, options) == whole) != sum);
        options.budget.generations = 4;
        CHECK(hashes_of(scene, options) == whole);
    }
}

TEST_CASE("collectors: a ring fills once from 0 to 1") {
    RenderOptions options;
    std::vector<double> shares;
    options.progress = [&](const char* stage, double share) {
        if (std::string(stage) == "photons") shares.push_back(share);
    };
    REQUIRE(render(scene_from(kSmallCumulus, {"animation.frames=2"}), options,
                   [](int, Image&, Report&) { return Status::ok(); }));
    // The first frame's ring of four generations.
    REQUIRE(shares.size() >= 5);
    for (int i = 0; i < 5; ++i) CHECK(shares[std::size_t(i)] == i * 0.25);
}
