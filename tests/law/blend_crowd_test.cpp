// SPDX-License-Identifier: Apache-2.0
// The blender of billboards on many spheres: against a brute-force double loop, and itself.
// in: hundreds of spheres around a camera -> out: pixels, digests.
// docs/methods.md 3, each image frame, step 5.
#include <algorithm>
#include <cmath>

#include "tests/support/blend_harness.h"

using namespace blend_harness;

namespace {

struct Brute {
    double transmittance = 1, colour = 0;
    bool near_rim = false;
};

/// All spheres through one pixel in double precision, without rectangles, tiles or early stop.
Brute brute(const Spheres& s, const CameraParams& c, int px, int py) {
    const double sx = ((px + 0.5) * 2 / c.width - 1) * double(c.half_width);
    const double sz = (1 - (py + 0.5) * 2 / c.height) * double(c.half_height);
    const double norm = std::sqrt(sx * sx + 1 + sz * sz);
    const double dx = sx / norm, dy = 1 / norm, dz = sz / norm;
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < s.x.size(); ++i)
        order.push_back({std::hypot(double(s.x[i]), double(s.y[i]), double(s.z[i])), i});
    std::sort(order.begin(), order.end());
    Brute b;
    for (const auto& [distance, i] : order) {
        const double t = s.x[i] * dx + s.y[i] * dy + s.z[i] * dz;
        const double r2 = double(s.radius[i]) * double(s.radius[i]);
        const double d2 = distance * distance - t * t;
        if (std::fabs(d2 / r2 - 1) < 0.01) b.near_rim = true;
        if (d2 >= r2) continue;
        const double h = std::sqrt(r2 - d2);
        const double chord = std::max(t + h, 0.0) - std::max(t - h, 0.0);
        const double left = std::exp(-double(s.extinction[i]) * chord);
        b.colour += b.transmittance * (1 - left) * double(s.colour[i]);
        b.transmittance *= left;
    }
    return b;
}

}  // namespace

TEST_CASE("blend: every pixel agrees with a brute-force loop in double") {
    // q = 1 - rho^2 is rounded four times, 2^-22 in all: well inside the rim that moves half a
    // chord by 2^-22 / (2 * 0.1) of the radius, which 24 m of 0.08/m make 1e-6 of optical depth per
    // sphere. At the rim itself the chord's slope is infinite: sqrt(2^-22) * 24 * 0.08 = 1e-3. A
    // few spheres overlap: five times the one, three times the other, which half of the pixels'
    // spread of optical depths keeps far from reaching.
    const CameraParams camera = look_north(160, 90);
    const Spheres s = many(300, 1);
    BillboardImage out;
    REQUIRE(bool(s.render(camera, out)));
    double worst = 0, worst_rim = 0, covered = 0;
    for (int y = 0; y < 90; ++y)
        for (int x = 0; x < 160; ++x) {
            const std::size_t i = std::size_t(y) * 160 + std::size_t(x);
            const Brute b = brute(s, camera, x, y);
            const double error = std::max(std::fabs(double(out.transmittance[i]) - b.transmittance),
                                          std::fabs(double(out.colour[i]) - b.colour));
            (b.near_rim ? worst_rim : worst) = std::max(b.near_rim ? worst_rim : worst, error);
            covered += b.transmittance < 0.99;
        }
    MESSAGE("largest errors: ", worst, ", at rims ", worst_rim, "; covered ", covered / 14400);
    CHECK(covered > 0.3 * 14400);
    CHECK(covered < 14400);
    CHECK(worst < 5e-6);
    CHECK(worst_rim < 3e-3);
}

TEST_CASE("blend: a sphere that comes close keeps its look where the ellipse ends") {
    // Nearer than 1.001 radii, or far aside, rays are met one by one. Both ways round distances of
    // 10 m and q to 2^-22: a hundredth off the rim 2^-22 / (2 * 0.1) of 20 m * 0.05/m, 1.2e-6, and
    // the ellipse's q has up to T^2 / (z^2 - r^2) = 64 times the digits to lose.
    const CameraParams camera = look_north(33, 21);
    for (const float side : {0.0f, 3.0f, -6.0f})
        for (const float ahead : {10.0099f, 10.0101f, 10.5f, 11.0f}) {
            BillboardImage out;
            Spheres s;
            s.add(side, ahead, 2, 10, 0.05f, 1);
            REQUIRE(bool(s.render(camera, out)));
            double worst = 0, covered = 0;
            for (std::size_t i = 0; i < out.transmittance.size(); ++i) {
                const Brute b = brute(s, camera, int(i % 33), int(i / 33));
                covered += b.transmittance < 0.9;
                if (!b.near_rim)
                    worst =
                        std::max(worst, std::fabs(double(out.transmittance[i]) - b.transmittance));
            }
            CAPTURE(side);
            CAPTURE(ahead);
            CHECK(covered > 100);
            CHECK(worst < 64 * 1.2e-6);
        }
}

TEST_CASE("blend: alpha of a crowded picture is exact to 1e-3, and light after the cut is lost") {
    // The figure that the blender is measured by; the cut of 1e-4 is its largest error.
    const CameraParams camera = look_north(96, 54);
    Spheres s;
    for (std::uint32_t i = 0; i < 600; ++i)
        s.add(number(i, 0, -70, 70), number(i, 1, 60, 120), number(i, 2, -40, 40),
              number(i, 3, 2, 6), number(i, 4, 0.1f, 0.6f), 1);
    BillboardImage out;
    REQUIRE(bool(s.render(camera, out)));
    double worst = 0, opaque = 0;
    for (int y = 0; y < 54; ++y)
        for (int x = 0; x < 96; ++x) {
            const Brute b = brute(s, camera, x, y);
            const float t = out.transmittance[std::size_t(y * 96 + x)];
            worst = std::max(worst, std::fabs(double(t) - b.transmittance));
            opaque += t < kBlendCut;
        }
    MESSAGE("largest error of alpha ", worst, ", below the cut ", opaque);
    CHECK(opaque > 10);
    CHECK(worst < 1e-3);
}

TEST_CASE("blend: a sphere in the corner of a wide view lands on its own pixels") {
    // At 45 degrees to the side a sphere of 10 m at 100 m spans slopes tan(45 deg -+ asin 0.1).
    const CameraParams camera = look_north(401, 201);
    Spheres s;
    const float c = 100 * std::sqrt(0.5f);
    s.add(c, c, 0, 10, 1e6f, 1);
    BillboardImage out;
    REQUIRE(bool(s.render(camera, out)));
    const double angle = std::asin(0.1), quarter = std::atan(1.0);
    for (int x = 0; x < 401; ++x) {
        const double slope = ((x + 0.5) * 2 / 401 - 1) * double(camera.half_width);
        const bool inside = slope > std::tan(quarter - angle) && slope < std::tan(quarter + angle);
        CHECK(out.transmittance[std::size_t(100 * 401 + x)] == (inside ? 0.0f : 1.0f));
    }
}

TEST_CASE("blend: the same bits at every width, tile size and number of threads") {
    const BlendFunction widths[] = {blend<1>, blend<4>, blend<8>, blend<16>};
    const BillboardTiling tilings[] = {{256, 0}, {256, 32}, {7, 3}, {64, 1}, {1000, 1000}};
    for (const CameraParams& camera : {look_north(131, 77), look_flat(131, 77, 40)})
        for (int channels : {1, 3, 51}) {
            const Spheres s = many(400, channels);
            std::vector<float> opaque(131 * 77);
            for (std::uint32_t i = 0; i < opaque.size(); ++i)
                opaque[i] = i % 3 == 0 ? kInfinity : number(i, 9, 1, 150);
            for (const float* solid :
                 {static_cast<const float*>(nullptr), static_cast<const float*>(opaque.data())}) {
                BillboardImage out;
                REQUIRE(bool(s.render(camera, out, solid, blend<1>, 1, {131, 77})));
                const std::uint64_t expected = digest(out);
                for (BlendFunction width : widths)
                    for (const BillboardTiling& tiling : tilings)
                        for (int threads : {1, 3}) {
                            REQUIRE(bool(s.render(camera, out, solid, width, threads, tiling)));
                            CHECK(digest(out) == expected);
                        }
            }
        }
}

TEST_CASE("blend: numbers out of range are named") {
    BillboardImage out;
    const auto message = [&](auto&& change) {
        Spheres s;
        s.add(0, 100, 0, 10, 0.05f, 1);
        s.add(0, 100, 0, 10, 0.05f, 1);
        change(s);
        const Status status = s.render(look_north(4, 4), out);
        CHECK(status.code == Code::kBadInput);
        return status.message;
    };
    CHECK(message([](Spheres& s) { s.radius[1] = -1; }).find("billboard 1: radius") == 0);
    CHECK(message([](Spheres& s) { s.x[0] = kInfinity; }).find("billboard 0: x") == 0);
    CHECK(message([](Spheres& s) { s.extinction[1] = -0.5f; }).find("billboard 1: ext") == 0);
    CHECK(message([](Spheres& s) { s.colour[1] = kInfinity; }).find("billboard 1: col") == 0);

    // A camera without a direction, as a zero-length vector gives when normalised.
    CameraParams nowhere = look_north(4, 4);
    nowhere.forward[1] = std::numeric_limits<float>::quiet_NaN();
    const Status lost = Spheres().render(nowhere, out);
    CHECK(lost.code == Code::kBadInput);
    CHECK(lost.message.find("camera: direction") == 0);

    // One channel more than the kernel holds.
    Spheres wide(kMaxBlendChannels + 1);
    wide.add(0, 100, 0, 10, 0.05f, 1);
    const Status status = wide.render(look_north(4, 4), out);
    CHECK(status.code == Code::kBadInput);
    CHECK(status.message.find("billboards: channels: 52") == 0);
}
