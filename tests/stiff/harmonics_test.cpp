// SPDX-License-Identifier: Apache-2.0
// Spherical harmonics where they are weakest: light from one direction, narrow lobes, rotations.
// in: deltas and HG lobes in 1 to 8 bands -> out: how far below zero they ring, and what is exact.
// docs/testing.md S74-S77; Sloan 2008, "Stupid spherical harmonics tricks", for the window.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "kernels_cpu/core/sh.h"
#include "kernels_cpu/media/phase.h"
#include "tests/stiff/stiff_scene.h"
#include "tests/support/quadrature.h"

using namespace stiff_test;

namespace {

constexpr double kPiDouble = 3.14159265358979324;

/// Sum over bands of (2l+1)/4pi f_l P_l(x): what a lobe of moments f_l becomes in `bands` bands.
template <class Moment>
double lobe(int bands, double x, Moment moment) {
    double sum = 0;
    for (int l = 0; l < bands; ++l)
        sum += (2 * l + 1) / (4 * kPiDouble) * moment(l) * legendre(l, x);
    return sum;
}

struct Ends {
    double least = 1e300, most = -1e300, negative = 0, whole = 0;
};
template <class Moment>
Ends ends_of(int bands, Moment moment) {
    Ends e;
    constexpr int kSteps = 20000;
    for (int i = 0; i < kSteps; ++i) {
        const double x = (i + 0.5) * 2 / kSteps - 1, v = lobe(bands, x, moment);
        e.least = std::min(e.least, v);
        e.most = std::max(e.most, v);
        (v < 0 ? e.negative : e.whole) += std::fabs(v) * 2 / kSteps * 2 * kPiDouble;
    }
    return e;
}

double sinc_window(int l, int bands) {
    const double x = kPiDouble * l / bands;
    return l == 0 ? 1 : std::sin(x) / x;
}

}  // namespace

TEST_CASE(
    "S74: light from one direction: band 0 is exact, ringing is known and the window ends it") {
    // Published least values over the peak of a delta in 2, 3, 4, 5 and 8 bands.
    const double published[][2] = {{2, -0.5}, {3, -0.2}, {4, -0.25}, {5, -0.15}, {8, -0.14}};
    for (const auto& row : published) {
        const int bands = int(row[0]);
        const Ends raw = ends_of(bands, [](int) { return 1.0; });
        const Ends soft = ends_of(bands, [&](int l) { return sinc_window(l, bands); });
        std::printf(
            "delta in %d bands: least/peak %.4f, windowed %.4f; negative share %.4f, "
            "windowed %.4f\n",
            bands, raw.least / raw.most, soft.least / soft.most, raw.negative / raw.whole,
            soft.negative / soft.whole);
        CHECK(raw.whole - raw.negative == doctest::Approx(1).epsilon(1e-6));
        CHECK(raw.least / raw.most == doctest::Approx(row[1]).epsilon(0.05));
        CHECK(soft.whole - soft.negative == doctest::Approx(1).epsilon(1e-6));
        CHECK(soft.least / soft.most > raw.least / raw.most);
    }
}

TEST_CASE("S74: pictures are never negative, with and without the window; what is cut is counted") {
    for (const char* display : kDisplays)
        for (const char* window : {"false", "true"})
            for (const char* bands : {"1", "2", "3", "4", "5", "8"}) {
                const Picture p = render_sound(bent_scene(
                    {display_key(display), std::string("collectors.window=") + window,
                     std::string("collectors.bands=") + bands,
                     // One band alone cannot dip; degrees about the sun's axis can.
                     std::string("collectors.axis_degrees=") + (*bands == '1' ? "0" : "8"),
                     "collectors.first_order_split=false", "sky.radiance=0"}));
                const std::uint64_t cut = p.counter("clamped_negative");
                std::printf("%s, %s bands, window %s: %llu of %llu colours cut at zero\n", display,
                            bands, window, static_cast<unsigned long long>(cut),
                            static_cast<unsigned long long>(3 * p.report.prepared.collectors));
                CHECK(cut <= 3 * p.report.prepared.collectors);
                if (std::string(bands) == "1") CHECK(cut == 0);
            }
}

TEST_CASE("S75: an HG lobe of g 0.85 cut to few bands rings as published") {
    // 4 pi times the least value; the peak of the lobe itself is 82.
    const double published[][2] = {{3, -1.1}, {5, -1.5}, {8, -2.3}, {12, -1.8}};
    for (const auto& row : published) {
        const Ends e = ends_of(int(row[0]), [](int l) { return std::pow(0.85, l); });
        std::printf("HG 0.85 in %g bands: 4 pi least %.3f\n", row[0], 4 * kPiDouble * e.least);
        CHECK(4 * kPiDouble * e.least == doctest::Approx(row[1]).epsilon(0.06));
        CHECK(e.whole - e.negative == doctest::Approx(1).epsilon(1e-6));
    }
    // The moments used are those of the density that is drawn from.
    for (int l = 0; l < 8; ++l)
        CHECK(double(phase_moment({kPhaseHg, 0.85f, 0, 1}, l)) ==
              doctest::Approx(std::pow(0.85, l)).epsilon(1e-6));
}

TEST_CASE("S76: energy of each band is the same in every direction, poles included") {
    // Nothing here rotates coefficients: a turned light is projected anew. What a rotation would
    // have to keep is the energy per band, and the value towards a direction turned along.
    const Vec<float> directions[] = {{0, 0, 1},       {0, 0, -1},           {1, 0, 0},
                                     {0, -1, 0},      {1e-20f, 0, 1},       {1e-4f, 1e-4f, 1},
                                     {0.6f, 0, 0.8f}, {0.48f, 0.6f, 0.64f}, {-0.0f, 0.0f, -1}};
    double worst = 0;
    for (const Vec<float>& d : directions) {
        float y[64];
        sh_eval<8>(d.x, d.y, d.z, y);
        for (int l = 0; l < 8; ++l) {
            double energy = 0;
            for (int m = -l; m <= l; ++m)
                energy += double(y[l * (l + 1) + m]) * double(y[l * (l + 1) + m]);
            worst = std::max(worst, std::fabs(energy * 4 * kPiDouble / (2 * l + 1) - 1));
        }
    }
    std::printf("energy per band: worst relative error %.2g\n", worst);
    CHECK(worst <= 2e-6);
}

TEST_CASE("S77: 1 and 8 bands work, others are refused; a constant field has band 0 only") {
    for (const char* bands : {"0", "9", "-1", "1000000000000", "2.5", "nan"}) {
        Scene scene;
        const Status status =
            read_scene_text(kText, "s.toml", "", {std::string("collectors.bands=") + bands}, scene);
        CHECK(status.code == Code::kBadInput);
        CHECK(status.message.find("collectors.bands") != std::string::npos);
    }
    const Quadrature q = gauss_legendre(12);
    double sums[64] = {};
    for (std::size_t n = 0; n < q.node.size(); ++n)
        for (int k = 0; k < 16; ++k) {
            const double phi = 2 * kPiDouble * (k + 0.25) / 16, z = q.node[n],
                         r = std::sqrt(1 - z * z);
            float y[64];
            sh_eval<8>(float(r * std::cos(phi)), float(r * std::sin(phi)), float(z), y);
            for (int i = 0; i < 64; ++i) sums[i] += q.weight[n] * 2 * kPiDouble / 16 * double(y[i]);
        }
    CHECK(sums[0] == doctest::Approx(std::sqrt(4 * kPiDouble)).epsilon(1e-6));
    for (int i = 1; i < 64; ++i) CHECK(std::fabs(sums[i]) <= 2e-6);
}
