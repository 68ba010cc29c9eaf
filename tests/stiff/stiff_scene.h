// SPDX-License-Identifier: Apache-2.0
// A small cloud under sun and sky, and what every picture of it must obey however it is bent.
// in: overrides of a scene -> out: pictures whose numbers are all finite and not negative.
// docs/testing.md, "Extreme cases"
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/support/render_harness.h"

namespace stiff_test {

using namespace render_test;

constexpr const char* kText = R"(
seed = 3
[camera]
position_m = [0, -3000, 1100]
target_m = [0, 0, 1100]
fov_deg = 40
resolution = [24, 16]
[sun]
azimuth_deg = 120
elevation_deg = 35
[sky]
radiance = [0.05, 0.07, 0.11]
[[medium]]
density = "procedural:cumulus"
bounds_m = [[-800, -800, 600], [800, 800, 1700]]
resolution = [20, 20, 14]
extinction_per_m = 0.02
albedo = 0.99
phase = { type = "henyey-greenstein", g = 0.85 }
[photon_grid]
photons = 12_000
generations = 4
[collectors]
photons = 8_000
generations = 4
samples = 500
)";

using Keys = std::vector<std::string>;

/// kText with changes, "key=value" each.
inline Scene bent_scene(const Keys& overrides) { return scene_from(kText, overrides); }

/// Every number of every channel is finite (depth may be infinite) and none is negative; A <= 1.
inline void check_sound(const Picture& p) {
    std::size_t wrong = 0;
    for (const Channel& c : p.image.channels)
        for (float v : c.pixels.span()) {
            const bool endless = c.name == "Z" && std::isinf(v);
            wrong += !(v >= 0.0f) || (!endless && !std::isfinite(v)) || (c.name == "A" && v > 1.0f);
        }
    CHECK(wrong == 0);
}

/// On one thread, which small pictures are fastest with; threads are the label `identity`'s.
inline RenderOptions one_thread() {
    RenderOptions options;
    options.threads = 1;
    // Stiff media are thicker than what is let through by default.
    options.limits[LimitId::kScatterings] = limit_row(LimitId::kScatterings).most;
    return options;
}

inline Picture render_sound(const Scene& scene, const RenderOptions& options = one_thread()) {
    Picture p = render_one(scene, options);
    check_sound(p);
    return p;
}

/// Largest difference of two pictures of one size over all R G B A, over the first one's largest.
inline double worst_difference(const Picture& a, const Picture& b) {
    double worst = 0, largest = 1e-300;
    for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t i = 0; i < a.image.channels[c].pixels.size(); ++i) {
            const double x = double(a.image.channels[c].pixels[i]);
            largest = std::max(largest, std::fabs(x));
            worst = std::max(worst, std::fabs(double(b.image.channels[c].pixels[i]) - x));
        }
    return worst / largest;
}

inline double mean_of(const Picture& p, const char* channel) {
    const Channel* c = p.image.find(channel);
    REQUIRE(c != nullptr);
    double sum = 0;
    for (float v : c->pixels.span()) sum += double(v);
    return sum / double(c->pixels.size());
}

inline double largest_of(const Picture& p, const char* channel) {
    const Channel* c = p.image.find(channel);
    REQUIRE(c != nullptr);
    double most = 0;
    for (float v : c->pixels.span()) most = std::max(most, double(v));
    return most;
}

/// Both displays, by name.
constexpr const char* kDisplays[] = {"march", "billboards"};
inline std::string display_key(const char* name) {
    return std::string("collectors.display=") + name;
}

inline bool left_out(const Picture& p, const char* what) {
    for (const LeftOut& l : p.report.plan.left_out)
        if (l.what == what) return true;
    return false;
}

}  // namespace stiff_test
