// SPDX-License-Identifier: Apache-2.0
// Where method particles finds the sun's light: at each bin of a ray, or at places in particles.
// in: made-up particles -> out: pictures against each other, refusals. docs/particles.md, "Light"
#include <cmath>

#include "tests/support/particle_harness.h"
#include "tests/support/render_harness.h"

using namespace pileus;
using namespace render_test;
using namespace particle_test;

TEST_CASE("particles: light is a walk from each bin where nothing else is asked") {
    const Field field("0 0 50 40 0.03\n-20 10 60 25 0.05\n");
    const auto hash = [&](const std::vector<std::string>& keys) {
        return field.render(keys).report.hash;
    };
    const std::string exact = "particles.light = \"exact\"",
                      linear = "particles.light = \"linear\"";
    CHECK(hash({}) == hash({exact}));
    // What lights places in particles has none.
    for (const char* key : {"particles.display = \"billboards\"", "particles.light_bias = 0.5",
                            "particles.occluders = 0.5"}) {
        CAPTURE(key);
        CHECK(hash({key}) == hash({key, linear}));
        Scene scene;
        const Status refused = read_scene_text(kText, "t.toml", "", {key, exact}, scene);
        CHECK(std::string(refused.message).find("particles.light: ") != std::string::npos);
    }
}

TEST_CASE("particles: light that is linear in a particle errs by what docs/particles.md says") {
    // Rows of the page's table: depth on a ray through a particle's middle, rms error over the
    // mean. Its clouds have 2000 particles; a third more is left for this one of 300.
    constexpr double kRows[][2] = {{0.03, 0.0064}, {0.1, 0.020}, {0.3, 0.065}, {1, 0.20}};
    for (const auto& row : kRows) {
        std::string balls;
        for (std::uint32_t i = 0; i < 300; ++i) {
            const double radius = 7 + 6 * draw(i, 3);
            balls += std::to_string(60 * draw(i, 0) - 30) + " " +
                     std::to_string(60 * draw(i, 1) - 30) + " " +
                     std::to_string(60 * draw(i, 2) + 20) + " " + std::to_string(radius) + " " +
                     std::to_string(row[0] / (16.0 / 15 * radius)) + "\n";
        }
        const Field field(balls);
        const Picture exact = field.render({}),
                      linear = field.render({"particles.light = \"linear\""});
        double square = 0, sum = 0, count = 0;
        for (int y = 0; y < exact.image.height; ++y)
            for (int x = 0; x < exact.image.width; ++x) {
                if (exact.at("A", x, y) < 0.02f) continue;
                const double a = double(exact.at("G", x, y)), b = double(linear.at("G", x, y));
                square += (a - b) * (a - b), sum += a, count += 1;
            }
        const double error = std::sqrt(square / count) / (sum / count);
        MESSAGE("depth ", row[0], ": ", error);
        CHECK(error < 4.0 / 3 * row[1]);
    }
}
