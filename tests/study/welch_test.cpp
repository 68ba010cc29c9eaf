// SPDX-License-Identifier: Apache-2.0
// Welch tests of blocks: the law of their deviates, biases they must find, files they must refuse.
// in: drawn numbers with fixed seeds, texts -> out: pass or fail.
// docs/crosscheck.md
#include "lab/compare/welch.h"

#include <doctest/doctest.h>

#include <cmath>

#include "kernels_cpu/core/rng.h"
#include "tests/support/student.h"

using namespace pileus;

namespace {

/// Passes of a picture of 64 x 40 whose pixels are about `mean`, exponentially distributed.
BlockSums drawn(std::uint32_t seed, int passes, double mean) {
    BlockSums blocks;
    start_blocks(64, 40, 8, blocks);
    Image image;
    image.width = 64;
    image.height = 40;
    for (const char* name : {"R", "G", "B"}) {
        image.channels.push_back({name, {}});
        REQUIRE(image.channels.back().pixels.resize(64 * 40, "test"));
    }
    for (int p = 0; p < passes; ++p) {
        std::uint32_t c = 0;
        for (Channel& channel : image.channels) {
            for (std::size_t i = 0; i < channel.pixels.size(); ++i) {
                const Words<std::uint32_t> w =
                    threefry(seed, c, std::uint32_t(i), std::uint32_t(p));
                const double share = 1 + double(i % 64) / 64;
                channel.pixels[i] = float(-mean * share * std::log(double(uniform_open(w.a))));
            }
            ++c;
        }
        REQUIRE(add_pass(image, blocks));
    }
    return blocks;
}

WelchResult compared(const BlockSums& a, const BlockSums& b) {
    WelchResult result;
    REQUIRE(compare_welch(a, b, kWelchSignificance, result));
    return result;
}

Status read(const std::string& text) {
    BlockSums blocks;
    return read_blocks("f", {text.data(), text.size()}, blocks);
}

}  // namespace

TEST_CASE("welch: the deviate has the probability of Student's t") {
    // Equal variances and numbers of passes: n - 1 + n - 1 degrees of freedom.
    for (const int n : {6, 9, 16, 40})
        for (const double t : {0.1, 1.0, 2.0, 3.5, 5.0}) {
            const double variance = 4;  // of a pass
            const double mean = t * std::sqrt(2 * variance / n);
            const double spread = variance * (n - 1);
            const BlockSum a{n * mean, n * mean * mean + spread}, b{0, spread};
            const double z = welch_z(n, a, n, b);
            const double exact = 1 - student::inside(t, 2 * n - 2);
            CAPTURE(n);
            CAPTURE(t);
            // Wallace's error of 0.01 in z changes a probability by at most 0.01 (z + 1) of it.
            CHECK(std::fabs(two_sided(z) / exact - 1) < 0.01 * (z + 1));
            CHECK(welch_z(n, b, n, a) == doctest::Approx(-z));
        }
    CHECK(two_sided(0) == 1);
    CHECK(two_sided(1.959963985) == doctest::Approx(0.05).epsilon(1e-6));
}

TEST_CASE("welch: equal means pass, their deviates are normal") {
    const WelchResult r = compared(drawn(1, 16, 1), drawn(2, 20, 1));
    CHECK_FALSE(r.differ);
    CHECK(r.blocks == 40);
    CHECK(r.passes_a == 16);
    CHECK(r.passes_b == 20);
    for (int c = 0; c < 3; ++c) {
        // 40 squares of mean 1 and variance 2: 4.5 standard errors.
        CHECK(std::fabs(r.mean_z_square[c] - 1) < 4.5 * std::sqrt(2.0 / 40));
        CHECK(r.chi_square_p[c] > 1e-6);
        CHECK(std::fabs(r.picture[c].z) < 4.5);
    }
}

TEST_CASE("welch: a bias of one per cent is found, in all or in one block") {
    // 16 passes of 2560 pixels of relative spread about 1: one per cent is 1.4 standard errors of
    // a difference, 400 passes make it 7.2.
    const BlockSums plain = drawn(3, 400, 1);
    CHECK_FALSE(compared(plain, drawn(4, 400, 1)).differ);
    const WelchResult bright = compared(drawn(5, 400, 1.01), plain);
    CHECK(bright.differ);
    for (int c = 0; c < 3; ++c) {
        CHECK(bright.picture[c].z > 4.5);
        CHECK(bright.picture[c].detectable < 0.02);
    }
    CHECK(compared(plain, drawn(5, 400, 1.01)).picture[0].z ==
          doctest::Approx(-bright.picture[0].z));

    // A block of 64 pixels tells a quarter, which the whole picture hides.
    BlockSums spot = drawn(6, 400, 1);
    for (std::size_t c = 0; c < 3; ++c) {
        BlockSum& s = spot.sums[3 * 13 + c];
        s.sum *= 1.25;
        s.square *= 1.25 * 1.25;
    }
    const WelchResult found = compared(spot, plain);
    CHECK(found.differ);
    CHECK(found.rejected == 3);
    CHECK(found.largest_x == 5);
    CHECK(found.largest_y == 1);
}

TEST_CASE("welch: blocks that cannot differ are no tests") {
    // Half of the blocks become a background of 0.5 without noise, one of them apart by 1e-9.
    BlockSums a = drawn(7, 16, 1), b = drawn(8, 16, 1);
    const WelchResult whole = compared(a, b);
    CHECK(whole.tested == 120);
    for (std::size_t i = 20; i < 40; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            for (BlockSums* blocks : {&a, &b}) {
                const double v = i == 20 && blocks == &b ? 0.5 + 1e-9 : 0.5;
                blocks->sums[3 * i + c] = {16 * v, 16 * v * v};
            }
    const WelchResult half = compared(a, b);
    CHECK(half.tested == 60);
    for (int c = 0; c < 3; ++c) {
        // 20 squares of mean 1 and variance 2: 4.5 standard errors; with the idle ones it was half.
        CHECK(std::fabs(half.mean_z_square[c] - 1) < 4.5 * std::sqrt(2.0 / 20));
    }
    CHECK_FALSE(half.differ);
    // Without noise, and apart by more than rounding, they are tests, and differ.
    for (std::size_t c = 0; c < 3; ++c) b.sums[3 * 30 + c] = {16 * 0.501, 16 * 0.501 * 0.501};
    const WelchResult apart = compared(a, b);
    CHECK(apart.tested == 63);
    CHECK(apart.differ);
    // Nothing at all to test is no difference.
    for (std::size_t i = 0; i <= 40; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            a.sums[3 * i + c] = b.sums[3 * i + c] = {16 * 0.5, 16 * 0.25};
    const WelchResult nothing = compared(a, b);
    CHECK(nothing.tested == 0);
    CHECK_FALSE(nothing.differ);
}

TEST_CASE("welch: without noise a millionth passes as rounding, a thousandth does not") {
    BlockSums a = drawn(1, 2, 1);
    for (std::size_t i = 0; i < a.sums.size(); ++i) a.sums[i] = {2, 2};
    BlockSums b = a;
    for (BlockSum& s : b.sums) s = {2 * (1 + 1e-6), 2 * (1 + 2e-6)};
    CHECK_FALSE(compared(a, b).differ);
    for (BlockSum& s : b.sums) s = {2 * 1.001, 2 * 1.001 * 1.001};
    CHECK(compared(a, b).differ);
    for (BlockSum& s : a.sums) s = {0, 0};
    CHECK_FALSE(compared(a, a).differ);
}

TEST_CASE("blocks: a text keeps every number; smaller blocks at the edge") {
    BlockSums blocks;
    start_blocks(10, 7, 4, blocks);
    CHECK(blocks.columns() == 3);
    CHECK(blocks.rows() == 2);
    CHECK(blocks.blocks() == 7);
    const BlockSums a = drawn(9, 3, 0.1);
    BlockSums b;
    const std::string text = blocks_text(a);
    REQUIRE(read_blocks("f", {text.data(), text.size()}, b));
    CHECK(b.passes == a.passes);
    REQUIRE(b.sums.size() == a.sums.size());
    for (std::size_t i = 0; i < a.sums.size(); ++i) {
        CHECK(b.sums[i].sum == a.sums[i].sum);
        CHECK(b.sums[i].square == a.sums[i].square);
    }
    // The whole picture is the mean of equal blocks.
    double sum = 0;
    for (std::size_t i = 0; i + 1 < a.blocks(); ++i) sum += a.sums[3 * i].sum;
    CHECK(a.sums[3 * (a.blocks() - 1)].sum ==
          doctest::Approx(sum / double(a.blocks() - 1)).epsilon(1e-12));
    Image image;
    image.width = 3;
    CHECK(add_pass(image, blocks).code == Code::kBadInput);
}

TEST_CASE("blocks: every fault has its line") {
    const std::string head = "pileus-blocks 1\npicture 2 1 side 2\n";
    const std::string row = "4 2 1 2 1 2 1\n";
    CHECK(read("# remark\n" + head + row + "# more\n" + row));
    const auto refused = [](const std::string& text, const char* words) {
        const Status status = read(text);
        CHECK(status.code == Code::kBadInput);
        CHECK_MESSAGE(status.message.find(words) != std::string::npos, status.message);
        CHECK(status.message.find('\n') == std::string::npos);
    };
    refused("", "f:1: file: ends early");
    refused("blocks 1", "f:1: word: \"blocks\", allowed: \"pileus-blocks\"");
    refused("pileus-blocks 2", "f:1: version: \"2\"");
    refused("pileus-blocks 1\npicture 0 4 side 1\n", "f:2: width: \"0\"");
    refused("pileus-blocks 1\npicture 16384 16384 side 1\n", "too short for 268435457 blocks");
    refused(head + row, "f:4: passes: the file ends before it");
    refused(head + row + "4 2 1 2 1 2\n", "f:5: sum of squares: the file ends before it");
    refused(head + row + row + "1\n", "f:5: file: goes on after its last block");
    refused(head + "4 nan 1 2 1 2 1\n" + row, "f:3: sum: \"nan\"");
    refused(head + "4 2 inf 2 1 2 1\n" + row, "f:3: sum of squares: \"inf\"");
    refused(head + "4 2 1e400 2 1 2 1\n" + row, "f:3: sum of squares: \"1e400\"");
    refused(head + "1 2 4 2 4 2 4\n" + row, "f:3: passes: \"1\", allowed: a number in [2");
    refused(head + "4 2 0.9 2 1 2 1\n" + row, "f:3: sum of squares: too small for its sum");
    refused(head + "4 2x 1 2 1 2 1\n" + row, "f:3: sum: \"2x\"");
    BlockSums a, b;
    start_blocks(4, 4, 2, a);
    start_blocks(4, 4, 4, b);
    WelchResult result;
    CHECK(compare_welch(a, b, 1e-3, result).code == Code::kBadInput);
}
