// SPDX-License-Identifier: Apache-2.0
// Numbers to and from text against std::to_chars and std::from_chars of this system.
// in: numbers of all sizes, texts right and wrong -> out: the same bytes, bits, faults and ends.
// docs/testing.md, label bits
#include "src/base/number_text.h"

#include <doctest/doctest.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <vector>

using namespace pileus;

// Where the C++ library has both.
#ifdef __cpp_lib_to_chars

namespace {

constexpr int kMany = 100'000;

template <class Number>
std::string wanted_text(Number value) {
    char text[64];
    return std::string(text, std::to_chars(text, text + sizeof text, value).ptr);
}

template <class Number>
bool same_bits(Number a, Number b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

/// Value, fault and end of one reading.
template <class Number>
bool reads_alike(const std::string& text) {
    const char *begin = text.data(), *end = begin + text.size();
    Number found = 42, wanted = 42;
    const std::from_chars_result a = number_from(begin, end, found);
    const std::from_chars_result b = std::from_chars(begin, end, wanted);
    return a.ptr == b.ptr && a.ec == b.ec && same_bits(found, wanted);
}

template <class Number>
bool writes_alike(Number value) {
    return number_text(value) == wanted_text(value) && reads_alike<Number>(number_text(value));
}

/// Whether a number, its neighbours and its negative are written and read alike.
template <class Number>
bool alike(Number value) {
    const Number far = std::numeric_limits<Number>::infinity();
    for (const Number v : {value, std::nextafter(value, far), std::nextafter(value, -far)})
        if (!writes_alike(v) || !writes_alike(-v)) return false;
    return true;
}

template <class Number, class Bits>
void check_all_sizes() {
    using Limits = std::numeric_limits<Number>;
    for (const Number v : {Number(0), Limits::max(), Limits::min(), Limits::denorm_min(),
                           Limits::epsilon(), Limits::infinity(), Limits::quiet_NaN()}) {
        CAPTURE(v);
        CHECK(alike(v));
    }
    for (int e = Limits::min_exponent - Limits::digits; e < Limits::max_exponent; ++e) {
        CAPTURE(e);
        CHECK(alike(std::ldexp(Number(1), e)));
    }
    for (int e = Limits::min_exponent10 - 16; e <= Limits::max_exponent10; ++e)
        for (int d = 1; d < 1000; d = d * 3 + 1) {
            Number v = 0;
            const std::string text = std::to_string(d) + "e" + std::to_string(e);
            (void)std::from_chars(text.data(), text.data() + text.size(), v);
            CAPTURE(text);
            CHECK(alike(v));
        }
    std::mt19937_64 random(7);
    int wrong = 0;
    for (int i = 0; i < kMany; ++i) {
        const Bits bits = Bits(random());
        Number any = 0;
        std::memcpy(&any, &bits, sizeof any);
        // Of any size, with few digits, subnormal.
        wrong += !writes_alike(any);
        wrong += !writes_alike(Number(std::int64_t(random()) >> (random() % 63)));
        wrong += !writes_alike(Number(std::int64_t(random() % 1000000)) / 1000);
        wrong += !writes_alike(Number(random() % 1000) * Limits::denorm_min());
    }
    CHECK(wrong == 0);
}

}  // namespace

TEST_CASE("number text: doubles and floats are written and read as the standard says") {
    check_all_sizes<double, std::uint64_t>();
    check_all_sizes<float, std::uint32_t>();
}

TEST_CASE("number text: significant digits as %g writes them") {
    std::mt19937_64 random(8);
    int wrong = 0;
    for (int i = 0; i < kMany; ++i) {
        const std::uint64_t bits = random();
        double value = 0;
        std::memcpy(&value, &bits, sizeof value);
        if (i % 2 != 0) value = double(std::int64_t(bits) >> (bits % 63)) / 8;
        if (i < 4) value = i < 2 ? 0.0 : std::numeric_limits<double>::infinity();
        const int digits = 1 + i % 17;
        char text[64];
        const auto end = std::to_chars(text, text + sizeof text, i % 3 != 0 ? value : -value,
                                       std::chars_format::general, digits);
        wrong += number_text(i % 3 != 0 ? value : -value, digits) != std::string(text, end.ptr);
    }
    CHECK(wrong == 0);
}

TEST_CASE("number text: faults, ends and limits of reading are those of the standard") {
    std::vector<std::string> texts = {"",
                                      " 1",
                                      "+1",
                                      "-+1",
                                      "-",
                                      "-.",
                                      ".",
                                      ".5",
                                      "1.",
                                      "1.e5",
                                      "e5",
                                      "1e",
                                      "1e+",
                                      "1ee",
                                      "1e5.",
                                      "0x10",
                                      "1_0",
                                      "1,5",
                                      "1 x",
                                      "00012",
                                      "inf",
                                      "-inf",
                                      "INFx",
                                      "in",
                                      "infinity",
                                      "Infini",
                                      "nan",
                                      "-nan",
                                      "nan(",
                                      "NAN(ab)",
                                      "1e39",
                                      "1e400",
                                      "-1e400",
                                      "1e-46",
                                      "1e-400",
                                      "-1e-400",
                                      "0e99999",
                                      "-0.0e-9",
                                      "1e99999999999",
                                      "1.7976931348623158e308",
                                      "1.7976931348623159e308",
                                      "3.4028235677973366e38",
                                      "2.4e-324",
                                      "2.5e-324",
                                      "7e-46",
                                      "7.1e-46",
                                      "0.00000000000000000000e5",
                                      "9007199254740993"};
    // A number that lies half way between two, with a digit far behind that decides.
    texts.push_back("9007199254740993." + std::string(800, '0') + "1");
    texts.push_back("0." + std::string(400, '0') + "1");
    texts.push_back("1" + std::string(400, '0') + ".5");
    std::mt19937_64 random(9);
    const std::string letters = "0123456789..--+eEinf ";
    for (int i = 0; i < kMany; ++i) {
        std::string text;
        for (std::uint64_t k = random() % 24; k > 0; --k)
            text += letters[random() % letters.size()];
        texts.push_back(text);
        // Digits enough for every way to round.
        text = std::to_string(random()) + "." + std::to_string(random()) + "e" +
               std::to_string(int(random() % 720) - 360);
        texts.push_back(text);
    }
    for (const std::string& text : texts) {
        const bool same = reads_alike<double>(text) && reads_alike<float>(text);
        if (!same) CAPTURE(text);
        if (!same) CHECK(same);
    }
    for (const std::string text : {"6.5e3", "6e", "inf", "1e999"}) {
        double found = 1, wanted = 1;
        const char *begin = text.data(), *end = begin + text.size();
        const auto a = number_from(begin, end, found, std::chars_format::fixed);
        const auto b = std::from_chars(begin, end, wanted, std::chars_format::fixed);
        CHECK((a.ptr == b.ptr && a.ec == b.ec && same_bits(found, wanted)));
    }
}

#endif
