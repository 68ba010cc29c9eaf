// SPDX-License-Identifier: Apache-2.0
// Finds the channels of two pictures that are to be compared.
// in: images -> out: a PicturePair, and halves of a reference merged into one picture.
// docs/compare.md
#include "lab/compare/metrics_pair.h"

#include <algorithm>

#include "lab/compare/metrics.h"
#include "src/io/images/image_file.h"

namespace pileus {

namespace {

const float* plane(const Image& image, const char* name) {
    const Channel* channel = image.find(name);
    return channel != nullptr ? channel->pixels.data() : nullptr;
}

/// All three error layers or none.
void find_errors(const Image& image, const float* (&errors)[3]) {
    const char* const names[3] = {"error.R", "error.G", "error.B"};
    bool all = true;
    for (int c = 0; c < 3; ++c) {
        errors[c] = plane(image, names[c]);
        all = all && errors[c] != nullptr;
    }
    for (const float*& error : errors) error = all ? error : nullptr;
}

}  // namespace

Status check_same_size(const char* what, const Image& a, const Image& b) {
    if (a.width == b.width && a.height == b.height) return Status::ok();
    return Status::bad_input(std::string(what) + ": sizes: differ, " + std::to_string(a.width) +
                             " x " + std::to_string(a.height) + ", allowed: " +
                             std::to_string(b.width) + " x " + std::to_string(b.height));
}

Status pair_pictures(const Image& a, const Image& reference, double alpha_least,
                     PicturePair& pair) {
    const Channel* rgb[3];
    PILEUS_TRY(check_image(a));
    PILEUS_TRY(check_image(reference));
    PILEUS_TRY(check_same_size("compare", a, reference));
    PILEUS_TRY(color_channels(a, rgb));
    for (int c = 0; c < 3; ++c) pair.a[c] = rgb[c]->pixels.data();
    PILEUS_TRY(color_channels(reference, rgb));
    for (int c = 0; c < 3; ++c) pair.r[c] = rgb[c]->pixels.data();
    pair.width = a.width;
    pair.height = a.height;
    pair.alpha = plane(reference, "A");
    pair.alpha_least = alpha_least;
    find_errors(a, pair.a_error);
    find_errors(reference, pair.r_error);
    return Status::ok();
}

Status smooth_squares(const Image& half1, const Image& half2, PicturePair& pair,
                      SmoothSquares& smooth) {
    constexpr int kReach = 2;
    const Channel* first[3];
    const Channel* second[3];
    PILEUS_TRY(color_channels(half1, first));
    PILEUS_TRY(color_channels(half2, second));
    const std::size_t pixels = pair.pixels();
    PILEUS_TRY(smooth.planes.resize(3 * pixels, "smooth squares of the reference"));
    for (std::size_t c = 0; c < 3; ++c) {
        double* plane = smooth.planes.data() + c * pixels;
        const float *one = first[c]->pixels.data(), *two = second[c]->pixels.data();
        each_counted(pair, [&](std::size_t at, int y) {
            const int x = int(at % std::size_t(pair.width));
            double sum = 0, count = 0;
            for (int v = std::max(y - kReach, 0); v <= std::min(y + kReach, pair.height - 1); ++v)
                for (int u = std::max(x - kReach, 0); u <= std::min(x + kReach, pair.width - 1);
                     ++u) {
                    const std::size_t i = std::size_t(v) * std::size_t(pair.width) + std::size_t(u);
                    if (i == at || !pair.counted(i)) continue;
                    sum += double(one[i]) * double(two[i]);
                    ++count;
                }
            if (!(count > 0)) sum = double(one[at]) * double(two[at]), count = 1;
            plane[at] = std::max(sum / count, 0.0);
        });
        pair.smooth[c] = plane;
    }
    return Status::ok();
}

Status merge_halves(const Image& half1, const Image& half2, Image& reference) {
    PILEUS_TRY(check_image(half1));
    PILEUS_TRY(check_image(half2));
    PILEUS_TRY(check_same_size("halves of the reference", half1, half2));
    reference = Image();
    reference.width = half1.width;
    reference.height = half1.height;
    const Channel* first[3];
    const Channel* second[3];
    PILEUS_TRY(color_channels(half1, first));
    PILEUS_TRY(color_channels(half2, second));
    const bool alpha = half1.find("A") != nullptr && half2.find("A") != nullptr;
    const char* const names[7] = {"R", "G", "B", "error.R", "error.G", "error.B", "A"};
    const std::size_t pixels = first[0]->pixels.size();
    for (int n = 0; n < (alpha ? 7 : 6); ++n) {
        const Channel* one = n < 6 ? first[n % 3] : half1.find("A");
        const Channel* two = n < 6 ? second[n % 3] : half2.find("A");
        reference.channels.emplace_back();
        Channel& made = reference.channels.back();
        made.name = names[n];
        PILEUS_TRY(made.pixels.resize(pixels, "merged halves"));
        for (std::size_t i = 0; i < pixels; ++i) {
            const double x = double(one->pixels[i]), y = double(two->pixels[i]);
            made.pixels[i] = float(n >= 3 && n < 6 ? std::fabs(x - y) / 2 : (x + y) / 2);
        }
    }
    return Status::ok();
}

}  // namespace pileus
