// SPDX-License-Identifier: Apache-2.0
// What a pixel sees of particles.
// in: made-up particles, cameras inside and outside -> out: depths against sums over all.
// docs/particles.md, "Display"
#include <cmath>

#include "tests/io/temp_folder.h"
#include "tests/support/particle_harness.h"
#include "tests/support/render_harness.h"

using namespace pileus;
using namespace render_test;
using namespace particle_test;

TEST_CASE("particles: a pixel's depth is the sum over all on its ray, from inside and outside") {
    constexpr int kAcross = 13, kDown = 9;
    struct Own {
        double at[3], radius, density;
    };
    std::vector<Own> all;
    std::string rows;
    for (std::uint32_t i = 0; i < 400; ++i) {
        // Whole quarters, which text and floats hold; some large, some smaller than a pixel.
        const auto quarters = [&](std::uint32_t k, double most) {
            return double(int(4 * most * draw(i, k))) / 4;
        };
        const double radius = i % 50 == 0 ? 30 : 0.25 + quarters(3, i % 3 == 0 ? 1 : 9);
        all.push_back({{quarters(0, 80) - 40, quarters(1, 80) - 40, quarters(2, 100)},
                       radius,
                       (1 + quarters(4, 8)) / 64});
        char row[160];
        (void)std::snprintf(row, sizeof row, "%.9g %.9g %.9g %.9g %.9g\n", all[i].at[0],
                            all[i].at[1], all[i].at[2], all[i].radius, all[i].density);
        rows += row;
    }
    const double half = 0.26794919243112270647;  // tan 15 degrees
    for (const double away : {-400.0, -60.0, 0.0}) {
        for (const bool parallel : {false, true}) {
            CAPTURE(away);
            CAPTURE(parallel);
            const std::vector<std::string> common = {
                "camera.resolution = [13, 9]",
                "camera.position_m = [3, " + std::to_string(away) + ", 50]",
                "camera.target_m = [3, 500, 50]"};
            std::vector<std::string> own = common;
            if (!parallel) own.push_back("camera.fov_deg = 30");
            std::string text = kText;
            if (parallel)
                text.replace(text.find("fov_deg = 30"), 12,
                             "projection = \"orthographic\"\nheight_m = 90");
            const test::TempFolder folder;
            folder.put("p.csv", "x y z radius density\n" + rows);
            Scene scene = scene_from(text, own);
            scene.directory = folder.path("");
            const Picture picture = render_one(scene);
            const Channel* tau = picture.image.find("tau");
            REQUIRE(tau != nullptr);
            double worst = 0;
            for (int y = 0; y < kDown; ++y)
                for (int x = 0; x < kAcross; ++x) {
                    const double h = parallel ? 45 : half;
                    const double sx = ((x + 0.5) * 2 / kAcross - 1) * h * kAcross / kDown;
                    const double sy = (1 - (y + 0.5) * 2 / kDown) * h;
                    // It looks along y: right is x, up is z.
                    double from[3] = {3, away, 50}, d[3] = {0, 1, 0};
                    (parallel ? from : d)[0] += sx;
                    (parallel ? from : d)[2] += sy;
                    const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
                    double sum = 0;
                    for (const Own& ball : all) {
                        double along = 0, square = 0;
                        for (int a = 0; a < 3; ++a) {
                            const double p = ball.at[a] - from[a];
                            along += p * d[a] / length, square += p * p;
                        }
                        const double inner =
                            1 - (square - along * along) / ball.radius / ball.radius;
                        if (inner <= 0) continue;
                        const double end = std::sqrt(inner);
                        const double begin = std::max(-along / ball.radius, -end);
                        if (begin < end)
                            sum += ball.density * ball.radius * integral(inner, begin, end);
                    }
                    const double seen = double(tau->pixels[std::size_t(y * kAcross + x)]);
                    worst = std::max(worst, std::fabs(seen - sum) / (sum + 1e-3));
                }
            // Rounding of rays to floats 400 m away: 2e-5 m of a radius of 0.25 m.
            CHECK(worst < 1e-3);
        }
    }
}
