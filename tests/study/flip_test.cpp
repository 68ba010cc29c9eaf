// SPDX-License-Identifier: Apache-2.0
// FLIP against closed forms and against what the published code gives.
// in: pictures by formula -> out: values, pass or fail.
// Published values: flip_evaluator 1.7, by the authors of FLIP; docs/compare.md, "FLIP"
#include "lab/compare/flip.h"

#include <cstdio>
#include <initializer_list>
#include <limits>

#include "tests/study/pictures.h"

using namespace pileus;
using test::flat_picture;
using test::make_picture;

namespace {

// The published code works in float: where a filter should give 0 it gives 1e-8, and the root of
// that raises FLIP by up to 5e-5 (measured over ten pictures).
constexpr double kPublishedRounding = 5e-5;

FlipResult measure(const Image& a, const Image& r, const FlipOptions& options) {
    FlipResult result;
    const Status status = flip(a, r, options, result);
    INFO(status.message);
    REQUIRE(status);
    return result;
}

FlipOptions ldr() {
    FlipOptions options;
    options.hdr = false;
    return options;
}

/// CIELAB with Hunt's adjustment, by libm.
void lab(const double (&rgb)[3], double (&out)[3]) {
    const double m[3][3] = {
        {10135552, 8788810, 4435075}, {2613072, 8788810, 887015}, {1425312, 8788810, 70074185}};
    const double over[3] = {24577794, 12288897, 73733382};
    const double white[3] = {0.950428545, 1, 1.088900371};
    double f[3];
    for (int i = 0; i < 3; ++i) {
        double t = 0;
        for (int c = 0; c < 3; ++c) t += m[i][c] / over[i] * rgb[c] / white[i];
        f[i] = t > 216.0 / 24389 ? std::cbrt(t) : t * 841 / 108 + 4.0 / 29;
    }
    out[0] = 116 * f[1] - 16;
    out[1] = out[0] * 5 * (f[0] - f[1]);
    out[2] = out[0] * 2 * (f[1] - f[2]);
}

double distance(const double (&p)[3], const double (&q)[3]) {
    double u[3], v[3];
    lab(p, u);
    lab(q, v);
    return std::pow(std::fabs(u[0] - v[0]) + std::hypot(u[1] - v[1], u[2] - v[2]), 0.7);
}

/// FLIP of two constant pictures: no features, only the law of colours.
double closed_form(const double (&p)[3], const double (&q)[3]) {
    const double most = distance({0, 1, 0}, {0, 0, 1}), d = distance(p, q), knee = 0.4 * most;
    return d < knee ? 0.95 * d / knee : 0.95 + 0.05 * (d - knee) / (most - knee);
}

/// The pictures that the published values belong to.
Image pattern(int n) {
    return make_picture(72, 50, {"R", "G", "B"}, [&](int c, int x, int y) {
        if (c == 0) return ((x * 7 + y * 13 + n * 5) % 31) / 32.0;
        return c == 1 ? ((x * x + 3 * y + n) % 29) / 32.0 : ((x * y + 11 * n) % 37) / 64.0;
    });
}
Image mixed(bool ramp, bool changed) {
    const Image a = pattern(0), b = pattern(1);
    return make_picture(72, 50, {"R", "G", "B"}, [&](int c, int x, int y) {
        const std::size_t i = std::size_t(y * 72 + x), k = std::size_t(c);
        const double v = changed ? 0.75 * double(a.channels[k].pixels[i]) +
                                       0.25 * double(b.channels[k].pixels[i])
                                 : double(a.channels[k].pixels[i]);
        return ramp ? std::ldexp(v, x / 12 - 3) : v;
    });
}
Image edge_at(int place) {
    return make_picture(72, 50, {"R", "G", "B"}, [&](int c, int x, int) {
        const double low[3] = {0.25, 0.375, 0.5}, high[3] = {0.75, 0.625, 0.5};
        return x < place ? low[c] : high[c];
    });
}

/// Mean and three pixels.
struct Published {
    double mean, first, middle, last;
};

void check_published(const FlipResult& got, const Published& wanted) {
    std::printf("FLIP mean %.7f, published %.7f\n", got.mean, wanted.mean);
    CHECK(std::fabs(got.mean - wanted.mean) < kPublishedRounding);
    CHECK(std::fabs(double(got.value[0]) - wanted.first) < kPublishedRounding);
    CHECK(std::fabs(double(got.value[25 * 72 + 36]) - wanted.middle) < kPublishedRounding);
    CHECK(std::fabs(double(got.value[49 * 72 + 71]) - wanted.last) < kPublishedRounding);
}

}  // namespace

TEST_CASE("flip: equal pictures are zero to the bit, at any exposure") {
    const Image a = mixed(true, false);
    for (bool hdr : {false, true}) {
        FlipOptions options;
        options.hdr = hdr;
        const FlipResult result = measure(a, a, options);
        CHECK(result.mean == 0);
        CHECK(result.largest == 0);
    }
}

TEST_CASE("flip: constant colours follow the closed form") {
    const double colours[6][3] = {{0, 0, 0},       {1, 1, 1},         {0, 1, 0},
                                  {0.2, 0.3, 0.4}, {0.21, 0.29, 0.4}, {0.5, 0.5, 0.49}};
    for (const auto& p : colours)
        for (const auto& q : colours) {
            const FlipResult result = measure(flat_picture(30, 20, p[0], p[1], p[2]),
                                              flat_picture(30, 20, q[0], q[1], q[2]), ldr());
            // Colours are stored as floats; in the constant the matrices there and back leave 1e-9,
            // which d^0.7 raises near d = 0.
            CHECK(std::fabs(result.mean - closed_form(p, q)) < 2e-6);
            CHECK(result.largest - double(result.value[0]) < 1e-6);
        }
    const FlipResult most =
        measure(flat_picture(9, 9, 0, 0, 0), flat_picture(9, 9, 1, 1, 1), ldr());
    CHECK(std::fabs(most.mean - 0.9673653) < kPublishedRounding);  // published code
    const FlipResult full =
        measure(flat_picture(9, 9, 0, 1, 0), flat_picture(9, 9, 0, 0, 1), ldr());
    CHECK(std::fabs(full.mean - 1) < 1e-6);
}

TEST_CASE("flip: LDR pictures as the published code sees them") {
    check_published(measure(mixed(false, true), mixed(false, false), ldr()),
                    {0.08966964848, 0.16946557164, 0.06823259592, 0.12717586756});
    check_published(measure(edge_at(39), edge_at(36), ldr()), {0.06587754897, 0, 0.59433639050, 0});
}

TEST_CASE("flip: HDR pictures as the published code sees them, three tone curves") {
    const Published wanted[3] = {{0.16060613708, 0.11557926238, 0.21120679379, 0.37463915348},
                                 {0.15739651193, 0.18491393328, 0.21139605343, 0.34862178564},
                                 {0.12626250560, 0.28279948235, 0.13041503727, 0.16566188633}};
    const double start[3] = {-0.70114398, -0.13931602, 0.71805954};
    const double stop[3] = {2.99783850, 3.55966640, 4.41704226};
    for (int i = 0; i < 3; ++i) {
        FlipOptions options;
        options.tone = i == 0 ? FlipTone::kAces : i == 1 ? FlipTone::kHable : FlipTone::kReinhard;
        const FlipResult result = measure(mixed(true, true), mixed(true, false), options);
        check_published(result, wanted[i]);
        CHECK(result.exposures == 4);
        CHECK(std::fabs(result.start - start[i]) < 1e-6);  // float's log2
        CHECK(std::fabs(result.stop - stop[i]) < 1e-6);
    }
}

TEST_CASE("flip: a mirrored and a turned pair give the same mean") {
    const Image a = mixed(false, true), r = mixed(false, false);
    const auto mirror = [](const Image& image) {
        return make_picture(72, 50, {"R", "G", "B"}, [&](int c, int x, int y) {
            return image.channels[std::size_t(c)].pixels[std::size_t(y * 72 + 71 - x)];
        });
    };
    const auto turn = [](const Image& image) {
        return make_picture(50, 72, {"R", "G", "B"}, [&](int c, int x, int y) {
            return image.channels[std::size_t(c)].pixels[std::size_t(x * 72 + y)];
        });
    };
    const double mean = measure(a, r, ldr()).mean;
    // Only the order of sums changes: float values, 3600 of them.
    CHECK(std::fabs(measure(mirror(a), mirror(r), ldr()).mean - mean) < 1e-7);
    CHECK(std::fabs(measure(turn(a), turn(r), ldr()).mean - mean) < 1e-7);
    CHECK(std::fabs(measure(r, a, ldr()).mean - mean) < 1e-12);
}

TEST_CASE("flip: the same bits from any number of threads") {
    const auto big = [](double gain) {
        return make_picture(33, 200, {"R", "G", "B"}, [&](int c, int x, int y) {
            return gain * (1 + (x * 7 + y * 3 + c) % 11);
        });
    };
    FlipOptions one;
    one.threads = 1;
    FlipOptions many;
    many.threads = 5;
    const FlipResult p = measure(big(0.1), big(0.13), one), q = measure(big(0.1), big(0.13), many);
    CHECK(std::memcmp(p.value.data(), q.value.data(), p.value.bytes()) == 0);
    CHECK(p.mean == q.mean);
}

TEST_CASE("flip: dark, black and broken pictures end in a value") {
    const Image black = flat_picture(5, 3, 0, 0, 0), grey = flat_picture(5, 3, 0.1, 0.1, 0.1);
    CHECK(measure(black, black, {}).mean == 0);
    CHECK(measure(grey, black, {}).mean > 0.9);
    CHECK(measure(flat_picture(1, 1, 1, 2, 3), flat_picture(1, 1, 1, 2, 3), {}).exposures == 2);
    // A median of 0 counts as 2^-23: published, 23 exposures from log2(2.1189) stops.
    const Image dark = make_picture(40, 40, {"Y"}, [](int, int, int y) { return y < 10 ? 1 : 0; });
    const Image more =
        make_picture(40, 40, {"Y"}, [](int, int, int y) { return y < 10 ? double(1.1f) : 0; });
    const FlipResult result = measure(more, dark, {});
    CHECK(result.exposures == 23);
    CHECK(std::fabs(result.start - 1.08329725) < 1e-6);
    Image broken = flat_picture(5, 3, 1, 1, 1);
    broken.channels[0].pixels[3] = std::numeric_limits<float>::quiet_NaN();
    broken.channels[1].pixels[4] = std::numeric_limits<float>::infinity();
    broken.channels[2].pixels[5] = -3;
    const FlipResult mended = measure(broken, flat_picture(5, 3, 1, 1, 1), {});
    CHECK(mended.not_finite == 2);
    CHECK(std::isfinite(mended.mean));
    CHECK(mended.largest <= 1);
}

TEST_CASE("flip: faults") {
    FlipResult result;
    FlipOptions options;
    CHECK(flip(flat_picture(2, 3, 0, 0, 0), flat_picture(3, 2, 0, 0, 0), options, result).code ==
          Code::kBadInput);
    options.pixels_per_degree = 0;
    CHECK(flip(flat_picture(2, 2, 0, 0, 0), flat_picture(2, 2, 0, 0, 0), options, result).code ==
          Code::kBadInput);
}
