// SPDX-License-Identifier: Apache-2.0
// Lit sessions over a small cumulus, and over that of a later time, which hand over to one another.
// in: overrides of a scene -> out: pictures.
// docs/living.md
#pragma once
#include <cmath>

#include "tests/embed/host_harness.h"

namespace host_test {

constexpr double kPosition[3] = {16, -4000, 256}, kTarget[3] = {0, 0, 1024};
constexpr std::uint32_t kWidth = 24, kHeight = 14;
/// A float's rounding of one weighted sum of radiances below 4.
constexpr double kRounding = 1e-6;

inline Overrides with(const std::string& method, const Overrides& more = {}) {
    Overrides all{"method.name=\"" + method + "\"",
                  "path.samples_per_pixel=2",
                  "collectors.generations=4",
                  "photon_grid.generations=4",
                  "raymarch.steps=40",
                  "output.layers=[\"radiance\",\"alpha\"]"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

/// The density of a later time.
inline Overrides later(Overrides way) {
    way.push_back("seed=11");
    way.push_back("medium.0.shape_seed=5");
    return way;
}

using Pixels = std::vector<float>;

struct Living : Hosted {
    explicit Living(const Overrides& way, const pileus_host* host = nullptr)
        : Hosted(render_test::kSmallCumulus, way, host) {
        REQUIRE_MESSAGE(code == PILEUS_OK, out.line());
        step(whole());
    }
    void orbit(double degrees) {
        double position[3];
        pileus_orbit(kPosition, kTarget, degrees, position);
        aim(position, kTarget, 40, kWidth, kHeight);
    }
    /// Eye and target to the east.
    void shift(double metres, std::uint32_t width, std::uint32_t height) {
        const double position[3] = {kPosition[0] + metres, kPosition[1], kPosition[2]};
        const double target[3] = {kTarget[0] + metres, kTarget[1], kTarget[2]};
        aim(position, target, 40, width, height);
    }
    Pixels pixels() {
        std::uint32_t width = 0, height = 0;
        check(pileus_session_size(session.get(), &width, &height, &out.error));
        Pixels made(std::size_t(width) * height * 4);
        auto frame = cleared<pileus_frame>();
        frame.colour = made.data();
        frame.format = PILEUS_FORMAT_RGBA32F;
        check(pileus_session_render(session.get(), &frame, &out.error));
        return made;
    }
    std::vector<unsigned char> bytes() {
        std::vector<unsigned char> made(std::size_t(kWidth) * kHeight * 4);
        auto frame = cleared<pileus_frame>();
        frame.colour = made.data();
        check(pileus_session_render(session.get(), &frame, &out.error));
        return made;
    }
    void hand_over(Living& next, std::uint32_t frames) {
        check(pileus_session_hand_over(session.get(), next.session.get(), frames, &out.error));
    }
    /// The line of a hand-over that is refused.
    std::string refused(pileus_session* next, std::uint32_t frames = 4) {
        const pileus_code got = pileus_session_hand_over(session.get(), next, frames, &out.error);
        CHECK(got == PILEUS_ERROR_INPUT);
        return out.line();
    }
};

/// The largest difference of two pictures.
inline double largest(const Pixels& a, const Pixels& b) {
    REQUIRE(a.size() == b.size());
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        most = std::fmax(most, std::fabs(double(a[i]) - double(b[i])));
    return most;
}

}  // namespace host_test
