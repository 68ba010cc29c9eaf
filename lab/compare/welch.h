// SPDX-License-Identifier: Apache-2.0
// Whether two programs paint the same mean, however their arithmetic and random numbers differ.
// in: blocks of either -> out: a test per block and channel, and for the whole picture.
// Welch 1947; Holm 1979; docs/crosscheck.md, "Welch tests".
#pragma once
#include "lab/compare/blocks.h"

namespace pileus {

/// Chance of calling equal means different: 6.8e-6 is two-sided 4.5 standard errors.
constexpr double kWelchSignificance = 6.8e-6;

struct WelchPicture {
    double mean_a = 0, mean_b = 0, z = 0, p = 1;
    double detectable = 0;  ///< relative bias that is found in 99.9 % of cases
};

struct WelchResult {
    std::size_t blocks = 0;  ///< the whole picture left out
    std::size_t tested = 0;  ///< blocks and channels that could differ; the others are no tests
    double passes_a = 0, passes_b = 0;  ///< least of any block
    double significance = kWelchSignificance;
    WelchPicture picture[3];                                ///< R G B
    double largest_z = 0;                                   ///< of blocks, by size
    int largest_x = 0, largest_y = 0, largest_channel = 0;  ///< its block, counted from 0
    double smallest_p = 1, adjusted_p = 1;  ///< of blocks; by Holm, all tests together
    std::size_t rejected = 0;               ///< blocks and channels, by Holm
    double mean_z_square[3] = {1, 1, 1};    ///< of those tested; 1 where the errors explain all
    double chi_square_p[3] = {1, 1, 1};     ///< that it is so large; assumes blocks independent
    double above_2 = 0, above_3 = 0;        ///< shares of |z|; normal: 0.0455 and 0.0027
    double detectable_block = 0;            ///< median over blocks and channels, relative
    bool differ = false;
};

/// Welch's t of two means as a normal deviate of the same probability (Wallace 1959, within 0.01
/// from 9 degrees of freedom up). Differences below a millionth of the mean count as rounding.
double welch_z(double passes_a, const BlockSum& a, double passes_b, const BlockSum& b);

/// Whether no sample of either can show a difference: both have one value in all passes, but for
/// rounding, and the same one. A test of it would only count among those that find nothing.
bool cannot_differ(double passes_a, const BlockSum& a, double passes_b, const BlockSum& b);

/// Two-sided probability of a normal deviate.
double two_sided(double z);

/// kBadInput: blocks of different sizes. Half of `significance` goes to the three channels of the
/// whole picture, half to all blocks; a difference is what Holm rejects in either.
Status compare_welch(const BlockSums& a, const BlockSums& b, double significance,
                     WelchResult& result);

/// Lines for people; `a` and `b` name the files.
std::string welch_lines(const std::string& a, const std::string& b, const WelchResult& result);
std::string welch_json(const std::string& a, const std::string& b, const WelchResult& result);

}  // namespace pileus
