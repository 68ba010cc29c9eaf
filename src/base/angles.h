// SPDX-License-Identifier: Apache-2.0
// Pi, and sine and cosine of degrees, in double: libm's bits differ between machines.
// in: degrees -> out: within 2^-50, exact at multiples of 90.
// Taylor series after reduction to |angle| <= 45 degrees; only + - * /.
#pragma once

namespace pileus {

constexpr double kPi64 = 3.14159265358979323846, kTwoPi64 = 2 * kPi64;

struct SineCosine {
    double sine, cosine;
};

/// Any |degrees| below 2^31.
inline SineCosine sincos_deg(double degrees) {
    const double quarters = degrees / 90.0;
    const long long q = static_cast<long long>(quarters + (quarters < 0 ? -0.5 : 0.5));
    const double x = (degrees - 90.0 * static_cast<double>(q)) * 0.017453292519943295769;
    double sine = 0, cosine = 0;
    for (int n = 19; n >= 1; n -= 2) sine = 1.0 - x * x / ((n + 1) * (n + 2)) * sine;
    for (int n = 18; n >= 0; n -= 2) cosine = 1.0 - x * x / ((n + 1) * (n + 2)) * cosine;
    sine *= x;
    switch (static_cast<int>(((q % 4) + 4) % 4)) {
        case 0:
            return {sine, cosine};
        case 1:
            return {cosine, -sine};
        case 2:
            return {-sine, -cosine};
        default:
            return {-cosine, sine};
    }
}

}  // namespace pileus
