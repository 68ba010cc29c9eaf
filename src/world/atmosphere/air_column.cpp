// SPDX-License-Identifier: Apache-2.0
// See air_column.h.
#include "src/world/atmosphere/air_column.h"

#include "kernels_cpu/core/math.h"
#include "src/base/angles.h"

namespace pileus {
namespace {

constexpr double kHalfPi = kPi64 / 2;

double root(double v) { return v > 0 ? __builtin_sqrt(v) : 0; }
double above(double v) { return v > 0 ? v : 0; }

/// e^(x^2) erfc(x) for x >= 0. Relative error below 2e-7 (Press et al. 1992, 6.2).
double scaled_erfc(double x) {
    constexpr double kTerms[] = {0.17087277,  -0.82215223, 1.48851587, -1.13520398, 0.27886807,
                                 -0.18628806, 0.09678418,  0.37409196, 1.00002368,  -1.26551223};
    const double t = 1 / (1 + 0.5 * x);
    double sum = 0;
    for (const double term : kTerms) sum = sum * t + term;
    return t * double(exp_(float(sum)));
}

/// Of a density e^-(h / scale), outward, cosine >= 0. In w = h / r + h^2 / (2 r^2) the way is
/// r dw / sqrt(cosine^2 + 2 w): with h = r w that is Chapman's function as an error function. What
/// h = r (w - w^2 / 2 + ...) adds is 1/X of it straight up, 3/8 of that along the level, and within
/// 6e-5 of the line between in 1 / (1 + 1.2 x).
double thinning_column(double r, double cosine, double scale) {
    const double X = r / scale, x = cosine * root(0.5 * X);
    const double ground = double(exp_(float((kEarthRadiusKm - r) / scale)));
    const double bend = 1 + (1 - 0.625 / (1 + 1.2 * x)) / X;
    return ground * scale * root(kHalfPi * X) * scaled_erfc(x) * bend;
}

/// Between two spheres, from `along` on outward, `square` the least distance's square. The density
/// is linear in the distance from the earth's middle, which three nodes of Gauss follow to 1e-7.
double shell_column(double square, double along, double low, double high) {
    const double begin = root(low * low - square), end = root(high * high - square);
    const double from = begin > along ? begin : along;
    if (!(end > from)) return 0;
    const double middle = 0.5 * (from + end), half = 0.5 * (end - from);
    const auto density = [&](double t) {
        const double height = root(square + t * t) - kEarthRadiusKm - double(kOzoneHeightKm);
        return above(1 - (height < 0 ? -height : height) / double(kOzoneHalfKm));
    };
    constexpr double kNode = 0.77459666924148337704;
    return half / 9 *
           (8 * density(middle) +
            5 * (density(middle - kNode * half) + density(middle + kNode * half)));
}

/// Outward from a place `along` past the nearest one to the earth's middle, along >= 0.
AirColumn outward_column(double square, double along) {
    const double r = root(square + along * along), cosine = r > 0 ? along / r : 1;
    const double low = kEarthRadiusKm + double(kOzoneHeightKm - kOzoneHalfKm);
    const double middle = kEarthRadiusKm + double(kOzoneHeightKm);
    const double high = middle + double(kOzoneHalfKm);
    return {thinning_column(r, cosine, double(kAirScaleKm)),
            thinning_column(r, cosine, double(kHazeScaleKm)),
            shell_column(square, along, low, middle) + shell_column(square, along, middle, high)};
}

AirColumn outward_at(double square, double at) { return outward_column(square, at < 0 ? -at : at); }

/// Both sides of the nearest place, less what lies beyond either end.
AirColumn across(double square, const AirColumn& before, const AirColumn& behind) {
    const AirColumn half = outward_column(square, 0);
    return {above(2 * half.air - before.air - behind.air),
            above(2 * half.haze - before.haze - behind.haze),
            above(2 * half.ozone - before.ozone - behind.ozone)};
}

}  // namespace

AirColumn column_to_space(double r, double cosine) {
    const double square = r * r * above(1 - cosine * cosine), along = r * cosine;
    const AirColumn outward = outward_at(square, along);
    return along < 0 ? across(square, outward, {0, 0, 0}) : outward;
}

AirWalk::AirWalk(double r, double cosine, double from)
    : square_(r * r * above(1 - cosine * cosine)),
      level_(r * cosine),
      at_(level_ + from),
      outward_(outward_at(square_, at_)) {}

AirColumn AirWalk::to(double end) {
    const double at = level_ + end;
    const AirColumn next = outward_at(square_, at);
    AirColumn own;
    if (at_ < 0 && at > 0) {
        own = across(square_, outward_, next);
    } else {
        const double sign = at_ < 0 ? -1 : 1;
        own = {above(sign * (outward_.air - next.air)), above(sign * (outward_.haze - next.haze)),
               above(sign * (outward_.ozone - next.ozone))};
    }
    at_ = at;
    outward_ = next;
    return own;
}

AirPiece piece_of(const Air& air, const AirColumn& column) {
    AirPiece piece;
    for (int c = 0; c < 3; ++c) {
        const float by_air = air.rayleigh[c] * float(column.air);
        const float by_haze = air.haze[c] * float(column.haze);
        const float depth =
            by_air + air.haze_all[c] * float(column.haze) + air.ozone[c] * float(column.ozone);
        const float seen = depth > 1e-12f ? one_minus_exp(depth) / depth : 1;
        piece.depth[c] = depth;
        piece.by_air[c] = seen * by_air;
        piece.by_haze[c] = seen * by_haze;
        piece.left[c] = exp_(-depth);
    }
    return piece;
}

}  // namespace pileus
