// SPDX-License-Identifier: Apache-2.0
// The blender of billboards against closed forms, a brute-force double loop, and itself.
// in: few spheres seen by a small camera -> out: transmittance, colour and half depth.
// docs/methods.md 3, each image frame, step 5.
#include "kernels_cpu/blend.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "kernels_cpu/rng.h"
#include "src/base/digest.h"
#include "src/stages/composite_billboards.h"

using namespace pileus;

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

template <int W>
void blend(const BlendParams& p, const BlendBuffers& b, std::uint32_t begin, std::uint32_t end) {
    blend_tile<W>(p, b, begin, end);
}

/// Spheres by value; every channel of a sphere has its own colour.
struct Spheres {
    explicit Spheres(int channel_count = 1) : channels(channel_count) {}
    int channels;
    std::vector<float> x, y, z, radius, extinction, colour;  // colour [sphere][channel]

    void add(float cx, float cy, float cz, float r, float sigma, float c) {
        x.push_back(cx), y.push_back(cy), z.push_back(cz);
        radius.push_back(r), extinction.push_back(sigma);
        for (int k = 0; k < channels; ++k) colour.push_back(c * float(k + 1));
    }
    Status render(const CameraParams& camera, BillboardImage& out, const float* opaque = nullptr,
                  BlendFunction kernel = blend<4>, int threads = 1,
                  const BillboardTiling& tiling = {}) const {
        std::vector<float> planes(colour.size());
        for (std::size_t i = 0; i < x.size(); ++i)
            for (std::size_t k = 0; k < std::size_t(channels); ++k)
                planes[k * x.size() + i] = colour[i * std::size_t(channels) + k];
        const BillboardScene scene{x.data(),
                                   y.data(),
                                   z.data(),
                                   radius.data(),
                                   extinction.data(),
                                   planes.data(),
                                   std::uint32_t(x.size()),
                                   channels,
                                   opaque};
        return composite_billboards(scene, camera, threads, kernel, out, tiling);
    }
};

/// Looks along +y with z up; the image plane at distance 1 is 2 high (or `height` metres high).
CameraParams look_north(int width, int height) {
    CameraParams c{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}, 0, 1, width, height, 0};
    c.half_width = float(width) / float(height);
    return c;
}
CameraParams look_flat(int width, int height, float half_height) {
    CameraParams c = look_north(width, height);
    c.orthographic = 1;
    c.half_width *= half_height;
    c.half_height = half_height;
    return c;
}

struct Pixel {
    double transmittance, colour, half_depth;
};

/// One pixel looking along +y.
Pixel through(const Spheres& spheres, float opaque = kInfinity,
              const CameraParams& camera = look_north(1, 1)) {
    BillboardImage out;
    REQUIRE(bool(spheres.render(camera, out, &opaque)));
    return {out.transmittance[0], out.colour[0], out.half_depth[0]};
}

/// A random number in [low, high) of sphere i.
float number(std::uint32_t i, std::uint32_t draw, float low, float high) {
    return low + (high - low) * uniform(threefry(5u, 77u, i, draw).a);
}

/// Overlapping spheres around a place 60 m north; some beside, behind and around the camera.
Spheres many(std::uint32_t count, int channels) {
    Spheres s(channels);
    for (std::uint32_t i = 0; i < count; ++i)
        s.add(number(i, 0, -60, 60), number(i, 1, -5, 110), number(i, 2, -50, 50),
              number(i, 3, 0.5f, 12), number(i, 4, 0, 0.08f), number(i, 5, 0, 1));
    return s;
}

std::uint64_t digest(const BillboardImage& image) {
    Digest d;
    d.floats(image.transmittance.span());
    d.floats(image.colour.span());
    d.floats(image.half_depth.span());
    return d.value();
}

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

TEST_CASE("blend: one sphere through its centre and beside it") {
    Spheres s;
    s.add(0, 100, 0, 10, 0.05f, 3);
    Pixel p = through(s);
    CHECK(p.transmittance == doctest::Approx(std::exp(-1.0)).epsilon(2e-7));  // two roundings
    CHECK(p.colour == doctest::Approx(3 * (1 - std::exp(-1.0))).epsilon(4e-7));

    // Half of the light is lost after ln 2 / extinction; the sphere begins at 90 m.
    CHECK(p.half_depth == doctest::Approx(90 + std::log(2.0) / 0.05).epsilon(2e-7));

    // A triangle 6, 8, 10 leaves half a chord of 8; the squares are exact in float.
    s.x[0] = 6;
    p = through(s);
    CHECK(p.transmittance == doctest::Approx(std::exp(-0.8)).epsilon(2e-7));
    s.x[0] = 10.5f;
    CHECK(through(s).transmittance == 1.0);
    CHECK(through(s).half_depth == double(kInfinity));
}

TEST_CASE("blend: far away the distance from the axis does not cancel") {
    // At 16384 m a difference of squares would be wrong by 16 m^2, more than the radius's square.
    Spheres s;
    s.add(0.75f, 16384, 0, 1.25f, 0.5f, 1);
    CHECK(through(s).transmittance == doctest::Approx(std::exp(-1.0)).epsilon(2e-7));
}

TEST_CASE("blend: the nearer sphere covers the farther, ties go by index") {
    Spheres s;
    s.add(0, 130, 0, 10, 0.03f, 8);
    s.add(0, 100, 0, 10, 0.05f, 1);
    const double a = 1 - std::exp(-1.0), b = 1 - std::exp(-0.6);
    CHECK(through(s).colour == doctest::Approx(a + (1 - a) * b * 8).epsilon(4e-7));
    s.y[0] = 100;
    CHECK(through(s).colour == doctest::Approx(b * 8 + (1 - b) * a).epsilon(4e-7));
    s.x[0] = 6, s.x[1] = -6;
    const double c = 1 - std::exp(-0.8), d = 1 - std::exp(-0.48);
    CHECK(through(s).colour == doctest::Approx(d * 8 + (1 - d) * c).epsilon(4e-7));
}

TEST_CASE("blend: a solid cuts the chord") {
    Spheres s;
    s.add(0, 100, 0, 10, 0.05f, 1);
    CHECK(through(s, 80).transmittance == 1.0);
    CHECK(through(s, 100).transmittance == doctest::Approx(std::exp(-0.5)).epsilon(2e-7));
    CHECK(through(s, 95).transmittance == doctest::Approx(std::exp(-0.25)).epsilon(2e-7));
    CHECK(through(s, 120).transmittance == through(s).transmittance);
    CHECK(through(s, 100).half_depth == double(kInfinity));
    CHECK(through(s, 0).transmittance == 1.0);
}

TEST_CASE("blend: a camera inside sees what lies ahead, and nothing behind it counts") {
    Spheres s;
    s.add(0, 5, 0, 10, 0.1f, 1);
    CHECK(through(s).transmittance == doctest::Approx(std::exp(-1.5)).epsilon(2e-7));
    CHECK(through(s).half_depth == doctest::Approx(std::log(2.0) / 0.1).epsilon(4e-7));
    s.y[0] = -5;
    CHECK(through(s).transmittance == doctest::Approx(std::exp(-0.5)).epsilon(2e-7));
    s.y[0] = -10;
    CHECK(through(s).transmittance == 1.0);
    s.y[0] = -100;
    CHECK(through(s).transmittance == 1.0);
    CHECK(through(s).colour == 0.0);
}

TEST_CASE("blend: orthographic rays are parallel, depth is along the view") {
    Spheres s;
    s.add(6, 100, 8, 12.5f, 0.04f, 2);  // 10 m off the axis: half a chord of 7.5
    const Pixel p = through(s, kInfinity, look_flat(1, 1, 30));
    CHECK(p.transmittance == doctest::Approx(std::exp(-0.6)).epsilon(2e-7));
    CHECK(p.colour == doctest::Approx(2 * (1 - std::exp(-0.6))).epsilon(4e-7));

    // The farther along the view lies behind, though its centre is nearer to the camera.
    s.add(0, 101, 0, 10, 0.05f, 1);
    const double a = 1 - std::exp(-0.6), b = 1 - std::exp(-1.0);
    CHECK(through(s, kInfinity, look_flat(1, 1, 30)).colour ==
          doctest::Approx(a * 2 + (1 - a) * b).epsilon(4e-7));
    s.y[0] = 0;
    s.y[1] = -50;
    CHECK(through(s, kInfinity, look_flat(1, 1, 30)).transmittance ==
          doctest::Approx(std::exp(-0.3)).epsilon(2e-7));
}

TEST_CASE("blend: no spheres leave an empty image") {
    BillboardImage out;
    REQUIRE(bool(Spheres(3).render(look_north(37, 5), out)));
    CHECK(out.transmittance.size() == 37 * 5);
    CHECK(out.colour.size() == 3 * 37 * 5);
    for (float t : out.transmittance.span()) CHECK(t == 1.0f);
    for (float c : out.colour.span()) CHECK(c == 0.0f);
    for (float z : out.half_depth.span()) CHECK(z == kInfinity);
}

TEST_CASE("blend: 100000 thin layers in one place are one thick layer") {
    // Each layer rounds T by at most 2^-25 T, in no preferred direction: a random walk of
    // sqrt(1e5) 2^-25 = 1e-5; five times that is allowed. The light is the rest to rounding.
    Spheres s;
    for (int i = 0; i < 100000; ++i) s.add(0, 100, 0, 10, 2e-6f, 1);
    const Pixel p = through(s);
    CHECK(p.transmittance == doctest::Approx(std::exp(-4.0)).epsilon(5e-5));
    CHECK(p.colour == doctest::Approx(1 - std::exp(-4.0)).epsilon(5e-5));
}

TEST_CASE("blend: opaque and nearly empty spheres") {
    Spheres s;
    s.add(0, 100, 0, 10, 1e6f, 4);
    CHECK(through(s).transmittance == 0.0);
    CHECK(through(s).colour == 4.0);
    CHECK(through(s).half_depth == doctest::Approx(90).epsilon(1e-7));

    // The taken share keeps its relative accuracy where 1 - T has lost its digits.
    s.extinction[0] = 1e-6f;
    CHECK(through(s).colour == doctest::Approx(4 * -std::expm1(-2e-5)).epsilon(3e-7));
    s.extinction[0] = 1e-12f;
    CHECK(through(s).colour == doctest::Approx(4 * -std::expm1(-2e-11)).epsilon(3e-7));
    s.extinction[0] = 0;
    CHECK(through(s).colour == 0.0);
}

TEST_CASE("blend: what a layer takes and leaves is right to 2^-22 at every depth") {
    double worst_taken = 0, worst_after = 0;
    for (int i = 0; i <= 87 * 1024; ++i) {
        const float depth = float(i) / 1024.0f;
        const Attenuated<float> a = attenuate(1.0f, depth);
        const double taken = -std::expm1(-double(depth)), after = std::exp(-double(depth));
        if (i > 0) worst_taken = std::max(worst_taken, std::fabs(double(a.taken) / taken - 1));
        worst_after = std::max(worst_after, std::fabs(double(a.after) / after - 1));
    }
    MESSAGE("largest relative errors: taken ", worst_taken, ", after ", worst_after);
    CHECK(worst_taken <= 0x1p-22);
    CHECK(worst_after <= 0x1p-22);
    CHECK(attenuate(1.0f, 88.0f).after == 0.0f);
    CHECK(attenuate(1.0f, kInfinity).after == 0.0f);
    CHECK(attenuate(1.0f, kInfinity).taken == 1.0f);
}

TEST_CASE(
    "blend: the shares of thinner layers are right to 2^-22, and never leave less than none") {
    // What is left is before - taken, whose error is that of the share and one rounding of 1.
    double worst_taken = 0, worst_after = 0;
    for (int doublings = 0; doublings <= kMostDoublings; ++doublings)
        for (int i = 1; i <= 4096; ++i) {
            const float part = kThinLayer * float(i) / 4096.0f;
            const double depth = std::ldexp(double(part), doublings);
            const Attenuated<float> a = take_layer(1.0f, part, doublings);
            const double taken = -std::expm1(-depth);
            worst_taken = std::max(worst_taken, std::fabs(double(a.taken) / taken - 1));
            worst_after = std::max(worst_after, std::fabs(double(a.after) - std::exp(-depth)));
            if (a.after < 0.0f || a.after > 1.0f) CHECK(a.after == 0.5f);
        }
    MESSAGE("largest errors: share, relative ", worst_taken, ", left ", worst_after);
    CHECK(worst_taken <= 0x1p-22);
    CHECK(worst_after <= 0x1p-22);
    CHECK(take_layer(0.25f, 0.0f, 3).taken == 0.0f);
    CHECK(take_layer(0.25f, 0.0f, 3).after == 0.25f);
}

TEST_CASE("blend: a pixel below the cut takes no more light") {
    Spheres s;
    s.add(0, 100, 0, 10, 0.5f, 1);  // leaves e^-10 = 4.5e-5, under the cut of 1e-4
    const double colour = through(s).colour;
    s.add(0, 150, 0, 10, 0.5f, 1e6f);
    CHECK(through(s).colour == colour);
    s.extinction[0] = 0.45f;  // leaves e^-9 = 1.2e-4, above it
    CHECK(through(s).colour > 100.0);
}

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
