// SPDX-License-Identifier: Apache-2.0
// Powers, roots and logarithms in double against libm's.
// in: doubles over the whole range -> out: largest errors in units of 2^-48, pass or fail.
// docs/testing.md, label bits
#include "src/base/powers.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <initializer_list>

using namespace pileus;

namespace {

constexpr double kUnit = 1.0 / 281474976710656.0;  // 2^-48, as stated in powers.h

double relative(double got, double wanted) { return std::fabs(got - wanted) / std::fabs(wanted); }

}  // namespace

TEST_CASE("powers: logarithm, power of two and cube root over all exponents") {
    double log_error = 0, exp_error = 0, root_error = 0;
    for (int e = -1021; e <= 1022; e += 3)
        for (int i = 0; i < 97; ++i) {
            const double x = std::ldexp(1.0 + i / 97.0, e);
            // Near 1 the logarithm is small, and its error counts against itself.
            log_error = std::fmax(log_error, i == 0 && e == 0 ? std::fabs(log2_of(x))
                                                              : relative(log2_of(x), std::log2(x)));
            root_error = std::fmax(root_error, relative(cube_root(x), std::cbrt(x)));
            const double y = e + i / 97.0;
            exp_error = std::fmax(exp_error, relative(exp2_of(y), std::exp2(y)));
        }
    std::printf("errors / 2^-48: log2 %.3f, exp2 %.3f, cube root %.3f\n", log_error / kUnit,
                exp_error / kUnit, root_error / kUnit);
    CHECK(log_error < kUnit);
    CHECK(exp_error < kUnit);
    CHECK(root_error < kUnit);
}

TEST_CASE("powers: exact at powers of two, ends and zero") {
    for (int e = -1022; e <= 1023; ++e) {
        CHECK(power_of_two(e) == std::ldexp(1.0, e));
        CHECK(log2_of(power_of_two(e)) == e);
        CHECK(exp2_of(e) == power_of_two(e));
    }
    CHECK(exp2_of(-1022.5) == 0);
    CHECK(exp2_of(1e300) == power_of_two(1023));
    CHECK(exp2_of(std::nan("")) == 0);
    CHECK(power_of(0, 0.7) == 0);
    CHECK(power_of(0, 0) == 1);
    CHECK(power_of(1, 1e9) == 1);
    CHECK(cube_root(0) == 0);
    CHECK(cube_root(27) == doctest::Approx(3).epsilon(1e-15));
}

TEST_CASE("powers: x^y for colours and distances") {
    double error = 0;
    for (int i = 1; i <= 2000; ++i)
        for (double y : {0.5, 0.7, 1.0, 1.0 / 2.4, 2.4}) {
            const double x = i * 0.0517;
            error = std::fmax(error, relative(power_of(x, y), std::pow(x, y)));
        }
    std::printf("error of x^y / 2^-48: %.3f\n", error / kUnit);
    CHECK(error < kUnit);
}
