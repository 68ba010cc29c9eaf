// SPDX-License-Identifier: Apache-2.0
// Tone mapping: exact sRGB codes, a monotone curve, bounds, exposure in stops.
// in: radiances over the whole range of floats -> out: pass or fail.
// docs/testing.md, label io
#include <cmath>
#include <vector>

#include "src/io/images/srgb.h"
#include "tests/io/test_image.h"

using namespace pileus;

namespace {

std::uint32_t grey_code(float radiance, float gain) {
    const Rgb<float> c = tone_curve(Rgb<float>{radiance, radiance, radiance}, gain);
    CHECK((c.r == c.g && c.g == c.b));
    return srgb_code(c.r);
}

double encode(double v) {
    return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

}  // namespace

TEST_CASE("tone: codes by look-up are those by search, for every float that may differ") {
    const SrgbCodes code;
    const auto same = [&](float v) { CHECK(code(v) == srgb_code(v)); };
    // Either way goes up and only at thresholds and at the ends of bins, if it is right there.
    for (const float threshold : kSrgbThresholds)
        for (const float v :
             {std::nextafter(threshold, 0.0f), threshold, std::nextafter(threshold, 2.0f)})
            same(v);
    for (std::uint32_t bits = 0; bits < 0xffff0000u; bits += 0x10000u)
        for (const std::uint32_t at : {bits, bits + 1, bits + 0xffffu}) {
            float v;
            std::memcpy(&v, &at, sizeof v);
            if (code(v) != srgb_code(v)) FAIL_CHECK("differs at ", double(v));
        }
    same(std::nanf(""));
}

TEST_CASE("tone: every sRGB threshold is the smallest float of its code") {
    for (int k = 1; k <= 255; ++k) {
        const double e = (k - 0.5) / 255;
        const double exact = e <= 0.04045 ? e / 12.92 : std::pow((e + 0.055) / 1.055, 2.4);
        const float at = kSrgbThresholds[k - 1];
        CHECK(double(at) >= exact);
        CHECK(double(std::nextafter(at, 0.0f)) < exact);
        CHECK(srgb_code(at) == std::uint32_t(k));
        CHECK(srgb_code(std::nextafter(at, 0.0f)) == std::uint32_t(k - 1));
    }
    // Between thresholds the code is the rounded forward curve.
    for (int i = 0; i <= 10000; ++i) {
        const float v = float(i) / 10000;
        CHECK(srgb_code(v) == std::uint32_t(std::floor(255 * encode(double(v)) + 0.5)));
    }
}

TEST_CASE("tone: anything at all stays within 8 bits") {
    const float inf = std::numeric_limits<float>::infinity();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const float stops : {0.0f, -60.0f, 60.0f, 1e9f, -1e9f, nan}) {
        const float gain = exposure_gain(stops);
        CHECK(gain > 0.0f);
        CHECK(gain < inf);
        for (const float dark : {0.0f, -0.0f, -1.0f, -1e38f, -inf, nan})
            CHECK(grey_code(dark, gain) == 0);
        CHECK(grey_code(inf, gain) == 255);
    }
    const float gain = exposure_gain(0);
    CHECK(grey_code(1e-12f, gain) == 0);
    CHECK(grey_code(1e9f, gain) == 255);
    CHECK(grey_code(3e38f, gain) == 255);
    CHECK(srgb_code(nan) == 0);
    const Rgb<float> mixed = tone_curve(Rgb<float>{nan, inf, -inf}, gain);
    CHECK(srgb_code(mixed.r) <= 255);
    CHECK(srgb_code(mixed.g) == 255);
}

TEST_CASE("tone: greys never get darker, tested on neighbouring floats around every step") {
    const float gain = exposure_gain(0);
    std::uint32_t steps = 0;
    float last = 0;
    for (std::uint32_t code = 1; code <= 255; ++code) {
        // Find one place where the code is reached, by halving the bits of the float.
        std::uint32_t low = 0, high = 0x7f800000;
        while (high - low > 1) {
            const std::uint32_t middle = low + (high - low) / 2;
            (grey_code(reinterpret<float>(middle), gain) >= code ? high : low) = middle;
        }
        std::uint32_t before = 0;
        for (std::uint32_t bits = high - 500; bits < high + 500; ++bits) {
            const std::uint32_t now = grey_code(reinterpret<float>(bits), gain);
            if (now < before) FAIL("darker at bits ", bits);
            steps += now > before && bits > high - 500 ? 1 : 0;
            before = now;
        }
        CHECK(reinterpret<float>(high) > last);
        last = reinterpret<float>(high);
    }
    CHECK(steps == 255);
}

TEST_CASE("tone: every channel of a colour grows with the exposure") {
    const Rgb<float> colours[] = {{1, 0.5f, 0.2f}, {0.05f, 0.07f, 0.11f}, {1, 0, 0}, {0, 0, 1}};
    for (const Rgb<float>& colour : colours) {
        std::uint32_t before[3] = {0, 0, 0};
        for (float stops = -20; stops <= 20; stops += 0.03125f) {
            const Rgb<float> c = tone_curve(colour, exposure_gain(stops));
            const std::uint32_t now[3] = {srgb_code(c.r), srgb_code(c.g), srgb_code(c.b)};
            for (int i = 0; i < 3; ++i) {
                CHECK(now[i] >= before[i]);
                before[i] = now[i];
            }
        }
        CHECK(before[0] == 255);  // the brightest rolls to white, whatever its colour
        CHECK(before[1] == 255);
        CHECK(before[2] == 255);
    }
}

TEST_CASE("tone: the curve is Narkowicz' curve") {
    for (double x = 1e-6; x < 1e5; x *= 1.1) {
        const double exact = x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
        // Constants rounded to 6 digits: a few units of the sixth digit are allowed.
        CHECK(std::fabs(double(filmic_curve(float(x))) / exact - 1) < 1e-5);
    }
}

TEST_CASE("tone: a stop doubles, exactly where it is whole") {
    CHECK(exposure_gain(0) == 3.5f);
    CHECK(exposure_gain(3) == 28.0f);
    CHECK(exposure_gain(-60) == 3.5f * 0x1p-60f);
    // exp_ is good to 1 ulp, its argument to 2^-24: 3e-7 in all.
    for (float stops = -5; stops < 5; stops += 0.37f)
        CHECK(std::fabs(double(exposure_gain(stops)) / (3.5 * std::exp2(double(stops))) - 1) <
              3e-7);
}

TEST_CASE("tone: the default exposure looks like a daylight photograph") {
    const float gain = exposure_gain(0);
    const auto within = [](std::uint32_t code, std::uint32_t low, std::uint32_t high) {
        return code >= low && code <= high;
    };
    // White paper in the sun, the bright side of a cloud, its base: an artistic choice, held here.
    CHECK(within(grey_code(0.3183f, gain), 228, 240));
    CHECK(within(grey_code(0.5f, gain), 238, 248));
    CHECK(within(grey_code(0.1f, gain), 178, 194));
    const Rgb<float> sky = tone_curve(Rgb<float>{0.05f, 0.07f, 0.11f}, gain);
    CHECK(within(srgb_code(sky.r), 130, 148));
    CHECK(within(srgb_code(sky.b), 184, 200));
}

TEST_CASE("tone: eight lanes give the bits of one") {
    const float values[8] = {0.0f, 1e-12f, 0.05f, 0.11f, 0.5f, 3.0f, 1e9f, -1.0f};
    Rgb<F<8>> wide{};
    for (int i = 0; i < 8; ++i) {
        wide.r[i] = values[i];
        wide.g[i] = values[(i + 3) % 8];
        wide.b[i] = values[(i + 5) % 8];
    }
    const Rgb<F<8>> mapped = tone_curve(wide, exposure_gain(0.3f));
    for (int i = 0; i < 8; ++i) {
        const Rgb<float> one =
            tone_curve(Rgb<float>{wide.r[i], wide.g[i], wide.b[i]}, exposure_gain(0.3f));
        CHECK(mapped.r[i] == one.r);
        CHECK(mapped.g[i] == one.g);
        CHECK(mapped.b[i] == one.b);
    }
}
