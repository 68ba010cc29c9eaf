// SPDX-License-Identifier: Apache-2.0
// Sunlight on nodes around the camera: near what each sample's own march gives, and of no past.
// in: pictures by nodes and by marches, animations and stills -> out: pass or fail.
#include <cmath>
#include <cstdlib>

#include "tests/support/render_harness.h"

using namespace render_test;

namespace {

std::string scene_text(double x) {
    unsetenv("HOME"), unsetenv("PILEUS_CACHE_DIR"), unsetenv("XDG_CACHE_HOME");
    return "camera = { position_m = [" + std::to_string(x) +
           ", 0, 200], target_m = [300, 3000, 1400], fov_deg = 50, resolution = [64, 36] }\n" + R"(
sun = { azimuth_deg = 60, elevation_deg = 30 }
sky = { radiance = [0.1, 0.2, 0.4] }
method = { name = "raymarch" }
[raymarch]
steps = 256
light_steps = 4
light_first_step_m = 60
light_growth = 2
light_refresh = 4
[[medium]]
density = "procedural:sky"
resolution = [16, 16, 4]
extinction_per_m = 0.02
phase = { type = "henyey-greenstein", g = 0.5 }
sky = { size = 32, perlin_m = 4096, worley_m = 1500, coverage = 0.5, base_m = 1000, top_m = 2000, planet_radius_m = 6.371e6 }
)";
}

}  // namespace

TEST_CASE("nodes give nearly the light of every sample's own march") {
    const auto fast = pixels_of(render_one(scene_from(scene_text(0))));
    const auto whole = pixels_of(render_one(scene_from(scene_text(0), {"raymarch.light=march"})));
    double square = 0, all = 0, mean = 0, off = 0;
    for (std::size_t i = 0; i < fast.size(); ++i) {
        const double a = double(fast[i]), b = double(whole[i]);
        square += (a - b) * (a - b), all += b * b, mean += b, off += a - b;
    }
    MESSAGE("relative square " << square / all << ", bias " << off / mean);
    CHECK(square > 0);  // they are two ways
    // Measured with room: nodes are 16 m apart near the camera, the smallest lumps 140 m wide.
    CHECK(square < 0.005 * all);
    CHECK(std::fabs(off) < 0.03 * mean);
}

TEST_CASE("a frame has the bits of a run that begins with it, whatever was seen before") {
    // The camera turns, so that nodes come into view and leave it; the sun rises in slices.
    const std::string text = scene_text(0) +
                             "[animation]\nframes = 4\ncamera_orbit_deg = [0, 90]\n"
                             "sun_elevation_deg = [30, 30.3]\n";
    RenderOptions all, last;
    all.last_frame = last.first_frame = last.last_frame = 3;
    for (const char* refresh : {"raymarch.light_refresh=1", "raymarch.light_refresh=4"})
        for (const int threads : {1, 3}) {
            all.threads = threads;
            const Scene scene = scene_from(text, {refresh});
            CHECK(pixels_of(render_one(scene, all)) == pixels_of(render_one(scene, last)));
        }
}
