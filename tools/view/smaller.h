// SPDX-License-Identifier: Apache-2.0
// The last steps of quality: pictures of a half or a quarter of the window's width and height.
// in: how long frames took -> out: 1, 2 or 4; pictures enlarged to the window's size.
// docs/view.md
#pragma once
#include <cstdint>
#include <vector>

namespace pileus::view {

/// Chooses by frames alone in which things move. The governor has some frames to do with less work;
/// what is still too slow is drawn smaller, until that takes far less time than there is.
class Smaller {
public:
    /// `frame_s`: what the frame before took; 0: unknown. `level`: the governor's.
    int choose(double frame_s, double target_s, std::uint32_t level) {
        if (!(frame_s > 0)) return by_;
        const double times = frame_s / target_s;
        // Sooner where no less work would do.
        slow_ = by_ == kMax || times < 1.05 ? slow_ / 2 : slow_ + (times < 4 ? 1 : kPatience / 4);
        quick_ = by_ > 1 && level == 0 && times < 0.2 ? quick_ + 1 : 0;
        if (slow_ < kPatience && quick_ < kPatience) return by_;
        by_ = slow_ < kPatience ? by_ / 2 : by_ * 2;
        slow_ = quick_ = 0;
        return by_;
    }

private:
    static constexpr int kPatience = 20, kMax = 4;
    int by_ = 1, slow_ = 0, quick_ = 0;
};

/// Four bytes a pixel; linear between the middles of the small picture's pixels.
void enlarge(const std::vector<std::uint8_t>& small, int small_width, int small_height, int width,
             int height, std::vector<std::uint8_t>& large);

}  // namespace pileus::view
