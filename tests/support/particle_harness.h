// SPDX-License-Identifier: Apache-2.0
// What tests of particles share: made-up numbers, a closed form, a scene over a file of them.
// in: indices, places -> out: numbers, text. docs/particles.md
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "tests/io/temp_folder.h"
#include "tests/support/render_harness.h"

namespace particle_test {

inline double draw(std::uint32_t i, std::uint32_t k) {
    std::uint32_t v = (i * 16 + k) * 2654435761u;
    v ^= v >> 15;
    v *= 2246822519u;
    v ^= v >> 13;
    return double(v >> 8) / 0x1p24;
}

/// Of (inner - s^2)^2 from s0 to s1.
inline double integral(double inner, double s0, double s1) {
    const auto part = [&](double s) {
        return s * (inner * inner - 2.0 / 3 * inner * s * s + s * s * s * s / 5);
    };
    return part(s1) - part(s0);
}

const char* const kText = R"(
[camera]
position_m = [0, -400, 50]
target_m = [0, 0, 50]
fov_deg = 30
resolution = [24, 24]
[sun]
azimuth_deg = 110
elevation_deg = 25
[[medium]]
density = "p.csv"
phase = { type = "henyey-greenstein", g = 0.5 }
albedo = 0.9
[method]
name = "particles"
[particles]
scattering = "single"
[output]
layers = ["radiance", "alpha", "depth", "optical_depth"]
)";

/// A scene over a file of particles.
class Field {
public:
    explicit Field(const std::string& rows) {
        folder_.put("p.csv", "x y z radius density\n" + rows);
    }
    render_test::Picture render(const std::vector<std::string>& overrides) const {
        pileus::Scene scene = render_test::scene_from(kText, overrides);
        scene.directory = folder_.path("");
        return render_test::render_one(scene);
    }

private:
    pileus::test::TempFolder folder_;
};

}  // namespace particle_test
