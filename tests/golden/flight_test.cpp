// SPDX-License-Identifier: Apache-2.0
// Stored digests of flights: what a host shows frame by frame, camera and sun moving.
// in: a small cumulus, a host's frames -> out: digests of all pixels so far, at four frames.
// What changes a digest is a change of pictures: say why in the commit that stores the new ones.
#include <vector>

#include "src/base/angles.h"
#include "src/base/digest.h"
#include "src/session/session.h"
#include "tests/support/render_harness.h"

using namespace render_test;

namespace {

const char* const kFlightText = R"(
seed = 5
[camera]
position_m = [0, -2500, 520]
target_m = [0, 0, 820]
fov_deg = 42
resolution = [96, 54]
[sun]
azimuth_deg = 65
elevation_deg = 38
irradiance = [1, 1, 1]
[sky]
radiance = [0.025, 0.045, 0.085]
[ground]
altitude_m = 0
albedo = 0.2
[[medium]]
density = "procedural:cumulus"
bounds_m = [[-800, -800, 600], [800, 800, 1700]]
resolution = [40, 40, 28]
extinction_per_m = 0.05
albedo = 1.0
phase = { type = "henyey-greenstein", g = 0.85 }
)";

constexpr int kFrames = 300, kMarks = 4;
constexpr int kMarked[kMarks] = {1, 50, 150, 300};

/// The digest of all pixels of frames 1 to each mark.
std::vector<std::string> fly(const std::string& method, int threads) {
    const Scene scene = scene_from(std::string(kFlightText) + method);
    RenderOptions options;
    options.threads = threads;
    Session session;
    REQUIRE(session.open(scene, options, true, nullptr));
    const std::size_t bytes = std::size_t(4) * 96 * 54;
    std::vector<unsigned char> colour(bytes);
    FrameTarget target;
    target.has_colour = true;
    target.colour.rows = {colour.data(), 4 * 96, false};
    std::vector<std::string> marks;
    Digest digest;
    for (int f = 0; f <= kFrames; ++f) {
        // The camera circles, and turns back half-way; the sun rises, stands, and sets again.
        const double orbit = 0.5 * (f <= 150 ? f : 300 - f);
        const double rise = 0.1 * (f <= 100 ? f : f <= 200 ? 100 : 300 - f);
        Camera camera = scene.camera;
        const auto turn = sincos_deg(orbit);
        const Double3 from = scene.camera.position_m;
        camera.position_m = {from.x * turn.cosine - from.y * turn.sine,
                             from.x * turn.sine + from.y * turn.cosine, from.z};
        REQUIRE(session.set_camera(camera));
        Sun sun = scene.sun;
        sun.elevation_deg += rise;
        REQUIRE(session.set_sun(sun));
        REQUIRE(session.set_frame(f));
        std::uint64_t done = 0;
        REQUIRE(session.step(f == 0 ? session.light().whole : 1, done));
        REQUIRE(session.render(target));
        if (f == 0) continue;
        for (const unsigned char v : colour) digest.u32(v);
        for (const int mark : kMarked)
            if (mark == f) marks.push_back(digest.hex());
    }
    return marks;
}

struct Flight {
    std::string name, method;
    int threads;
    std::string digests[kMarks];
};

const Flight kFlights[] = {
    {"collectors, few pixels, sunlight in slices",
     "[method]\nname = \"collectors\"\n"
     "[collectors]\nphotons = 100_000\ngenerations = 20\nbands = 3\nsamples = 3_000\n"
     "scale = 4\nlight_refresh = 8\n",
     1,
     {"fc9df4691afd3f39", "71c8bc869911c40c", "b36d8158e1b9f053", "916714975650e186"}},
    {"billboards",
     "[method]\nname = \"collectors\"\n"
     "[collectors]\nphotons = 100_000\ngenerations = 20\nbands = 3\nsamples = 3_000\n"
     "display = \"billboards\"\nlight_refresh = 8\n",
     2,
     {"6e74460adad806d9", "ebd0b92404d88fcc", "53cd955a66eb3b09", "04a2c79dbfd80b5d"}},
    {"octaves by temporal reprojection",
     "[method]\nname = \"raymarch\"\n"
     "[raymarch]\nscattering = \"octaves\"\nsteps = 48\ntemporal = 4\nlight_refresh = 8\n",
     3,
     {"207acb92825d7207", "ae401d8eddff4ea5", "77da60d5c9799b37", "c7992a6655cd2975"}}};

}  // namespace

TEST_CASE("golden: flights of 300 frames, camera and sun moving") {
    for (const Flight& flight : kFlights) {
        CAPTURE(flight.name);
        const std::vector<std::string> got = fly(flight.method, flight.threads);
        REQUIRE(got.size() == kMarks);
        for (int m = 0; m < kMarks; ++m) {
            CAPTURE(kMarked[m]);
            CHECK(got[std::size_t(m)] == flight.digests[m]);
        }
    }
}
