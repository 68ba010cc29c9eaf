// SPDX-License-Identifier: Apache-2.0
// See white_balance.h.
// in: kelvins -> out: matrices. IEC 61966-2-1 (sRGB); Kang, Moon, Hong, Lee, Cho and Kim 2002,
// J. Korean Phys. Soc. 41; CIE 15:2004 (daylight); Lam 1985 (Bradford).
#include "src/io/images/develop/white_balance.h"

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace pileus {
namespace {

/// X Y Z of a colour of luminance 1.
glm::dvec3 tristimulus(double x, double y) { return {x / y, 1, (1 - x - y) / y}; }

/// Columns: X Y Z of the primaries, scaled so that their sum is D65.
glm::dmat3 srgb_to_xyz() {
    const glm::dmat3 primaries(tristimulus(0.64, 0.33), tristimulus(0.30, 0.60),
                               tristimulus(0.15, 0.06));
    const glm::dvec3 share = glm::inverse(primaries) * tristimulus(0.3127, 0.3290);
    return {primaries[0] * share.x, primaries[1] * share.y, primaries[2] * share.z};
}

std::array<double, 2> black_body_place(double k) {
    const double u = 1 / k;
    const double x = k < 4000 ? ((-0.2661239e9 * u - 0.2343589e6) * u + 0.8776956e3) * u + 0.179910
                              : ((-3.0258469e9 * u + 2.1070379e6) * u + 0.2226347e3) * u + 0.240390;
    if (k < 2222) return {x, ((-1.1063814 * x - 1.34811020) * x + 2.18555832) * x - 0.20219683};
    if (k < 4000) return {x, ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867};
    return {x, ((3.0817580 * x - 5.87338670) * x + 3.75112997) * x - 0.37001483};
}

std::array<double, 2> daylight_place(double k) {
    const double u = 1 / k;
    const double x = k < 7000 ? ((-4.6070e9 * u + 2.9678e6) * u + 0.09911e3) * u + 0.244063
                              : ((-2.0064e9 * u + 1.9018e6) * u + 0.24748e3) * u + 0.237040;
    return {x, (-3 * x + 2.870) * x - 0.275};
}

}  // namespace

std::array<double, 2> white_place(double kelvin) {
    constexpr double kBody = 4000, kDay = 5000;
    if (kelvin >= kDay) return daylight_place(kelvin);
    const std::array<double, 2> body = black_body_place(kelvin);
    if (kelvin <= kBody) return body;
    const std::array<double, 2> day = daylight_place(kelvin);
    const double share = (1 / kBody - 1 / kelvin) / (1 / kBody - 1 / kDay);
    return {body[0] + share * (day[0] - body[0]), body[1] + share * (day[1] - body[1])};
}

ColorMatrix white_matrix(double kelvin) {
    const glm::dmat3 cones(0.8951, -0.7502, 0.0389, 0.2664, 1.7135, -0.0685, -0.1614, 0.0367,
                           1.0296);
    const std::array<double, 2> place = white_place(kelvin);
    const glm::dvec3 from = cones * tristimulus(place[0], place[1]),
                     to = cones * tristimulus(0.3127, 0.3290), gain = to / from;
    const glm::dmat3 into = cones * srgb_to_xyz(),
                     scaled(into[0] * gain, into[1] * gain, into[2] * gain),
                     all = glm::inverse(into) * scaled;
    ColorMatrix rows{};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) rows[std::size_t(i)][std::size_t(j)] = all[j][i];
    return rows;
}

}  // namespace pileus
