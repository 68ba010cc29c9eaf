// SPDX-License-Identifier: Apache-2.0
// Whether the error bars of pictures cover the mean of many pictures as often as they should.
// in: means and standard errors of each pixel under many seeds -> out: share of intervals that
// cover. docs/testing.md; Student's t: tests/support/student.h
#pragma once
#include <cmath>
#include <cstddef>
#include <vector>

#include "tests/support/student.h"

namespace coverage {

/// One picture's means and standard errors, pixel by pixel.
struct Sample {
    std::vector<double> mean, error;
};

struct Result {
    double covered = 0;      ///< share of all intervals of 95 % that hold the long-run mean
    double ratio = 0;        ///< root of (mean reported variance / variance between seeds)
    double effective = 0;    ///< independent pixels, from the spread of coverage between seeds
    std::size_t pixels = 0;  ///< that count
};

/// The pixels where every seed has an error. The mean over the seeds stands for the truth: its own
/// share in each difference is taken off, a factor 1 - 1/seeds of the variance.
inline Result judge(const std::vector<Sample>& seeds, int freedom) {
    const double count = double(seeds.size());
    const double half = student::quantile_95(freedom) * std::sqrt(1 - 1 / count);
    Result out;
    double between = 0, said = 0;
    std::vector<double> hits(seeds.size(), 0.0);
    for (std::size_t i = 0; i < seeds[0].mean.size(); ++i) {
        double mean = 0, variance = 0;
        bool counts = true;
        for (const Sample& s : seeds) mean += s.mean[i] / count, counts &= s.error[i] > 0;
        if (!counts) continue;
        out.pixels += 1;
        for (std::size_t k = 0; k < seeds.size(); ++k) {
            const double off = seeds[k].mean[i] - mean, error = seeds[k].error[i];
            variance += off * off / (count - 1);
            said += error * error / count;
            if (std::fabs(off) <= half * error) hits[k] += 1;
        }
        between += variance;
    }
    const double pixels = double(out.pixels);
    for (double h : hits) out.covered += h / (pixels * count);
    double spread = 0;
    for (double h : hits) spread += (h / pixels - out.covered) * (h / pixels - out.covered);
    out.effective = out.covered * (1 - out.covered) * (count - 1) / std::fmax(spread, 1e-30);
    out.ratio = std::sqrt(said / between);
    return out;
}

}  // namespace coverage
