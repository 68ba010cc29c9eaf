// SPDX-License-Identifier: Apache-2.0
// The error of a picture that becomes better, read from how far its halves agree.
// in: the picture whenever its light has doubled -> out: its standard error over its mean.
// docs/view.md
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace pileus::view {

/// The mean of 2n samples differs from that of the first n by half of what two independent means of
/// n differ: in the square mean by its own standard error. Blind to errors that every sample has.
class Noise {
public:
    void begin() { units_ = 0, error_ = -1; }
    /// Whether the picture of so many units of light, of `whole` that are to come, should be given
    /// to `add`.
    bool wants(std::uint64_t units, std::uint64_t whole) const {
        return units > 0 && (units_ == 0 ? 2 * units <= whole : units >= 2 * units_);
    }
    /// Four floats a pixel.
    void add(std::uint64_t units, std::vector<float>& picture) {
        if (units_ > 0 && units == 2 * units_ && picture.size() == before_.size()) {
            double difference = 0, sum = 0;
            std::size_t count = 0;
            for (std::size_t i = 0; i < picture.size(); ++i) {
                if (i % 4 == 3) continue;
                const double d = double(picture[i]) - double(before_[i]);
                difference += d * d, sum += double(picture[i]), ++count;
            }
            error_ = sum > 0 ? std::sqrt(difference * double(count)) / sum : -1;
        }
        units_ = units;
        before_.swap(picture);
    }
    bool known() const { return error_ >= 0; }
    double error() const { return error_; }

private:
    std::uint64_t units_ = 0;
    double error_ = -1;
    std::vector<float> before_;
};

}  // namespace pileus::view
