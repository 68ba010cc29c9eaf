// SPDX-License-Identifier: Apache-2.0
// Powers, cube roots and logarithms in double: libm's bits differ between machines.
// in: doubles -> out: within 2^-48 of the value; only + - * / and exact scaling.
// Series of atanh and exp after reduction; Newton's iteration for the cube root.
#pragma once
#include <cstdint>
#include <cstring>

namespace pileus {

/// Mantissa in [sqrt(1/2), sqrt(2)) and exponent of a positive normal double.
inline double split_double(double x, int& exponent) {
    std::uint64_t bits;
    std::memcpy(&bits, &x, 8);
    const std::uint64_t root_half = 0x3fe6a09e667f3bcdull;
    const std::uint64_t offset = bits - root_half;
    exponent = static_cast<int>(static_cast<std::int64_t>(offset) >> 52);
    bits -= static_cast<std::uint64_t>(static_cast<std::int64_t>(exponent)) << 52;
    std::memcpy(&x, &bits, 8);
    return x;
}

/// 2^n; n in [-1022, 1023].
inline double power_of_two(int n) {
    const std::uint64_t bits = static_cast<std::uint64_t>(n + 1023) << 52;
    double x;
    std::memcpy(&x, &bits, 8);
    return x;
}

/// Base 2 logarithm of a positive normal double; exact at powers of two.
inline double log2_of(double x) {
    int exponent = 0;
    const double m = split_double(x, exponent);
    const double s = (m - 1) / (m + 1), s2 = s * s;
    double sum = 0;
    for (int n = 23; n >= 1; n -= 2) sum = sum * s2 + 1.0 / n;
    return exponent + sum * s * 2.8853900817779268147;
}

/// 2^x; 0 below -1022, held to 2^1023 above.
inline double exp2_of(double x) {
    if (!(x >= -1022)) return 0;
    if (x > 1023) x = 1023;
    const int n = static_cast<int>(x + (x < 0 ? -0.5 : 0.5));
    const double r = (x - n) * 0.69314718055994530942;
    double sum = 1;
    for (int k = 15; k >= 1; --k) sum = 1 + sum * r / k;
    return sum * power_of_two(n);
}

/// x^y for x >= 0; 0^y is 0 for y > 0, else 1.
inline double power_of(double x, double y) {
    if (!(x > 2.3e-308)) return y > 0 ? 0 : 1;
    return exp2_of(y * log2_of(x));
}

/// Cube root of a positive normal number, relative error below 4e-16; 0 for 0 and below.
inline double cube_root(double x) {
    if (!(x > 0)) return 0.0;
    // Take a third of the exponent for a start within a few per cent, then Newton's iteration.
    std::uint64_t bits;
    std::memcpy(&bits, &x, sizeof bits);
    bits = bits / 3 + 0x2a9f7893782da1ceull;
    double y;
    std::memcpy(&y, &bits, sizeof y);
    for (int i = 0; i < 5; ++i) y = y - (y - x / (y * y)) / 3.0;
    return y;
}

}  // namespace pileus
