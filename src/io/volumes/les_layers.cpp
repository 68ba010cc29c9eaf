// SPDX-License-Identifier: Apache-2.0
// Equal layers for a grid whose levels stand at heights of their own.
// in: heights of cell centres -> out: see les_layers.h.
// docs/formats.md
#include "src/io/volumes/les_layers.h"

namespace pileus {

namespace {

/// The even ladder that fits the levels best: its middle and its step.
struct Ladder {
    double middle = 0, step = 0;
};

Ladder fit_ladder(const std::vector<double>& levels) {
    const double n = double(levels.size());
    double sum = 0, moment = 0, spread = 0;
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const double place = double(i) - (n - 1) / 2;
        sum += levels[i];
        moment += place * levels[i];
        spread += place * place;
    }
    return {sum / n, moment / spread};
}

bool is_even(const std::vector<double>& levels, const Ladder& ladder) {
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const double place = double(i) - (double(levels.size()) - 1) / 2;
        const double off = levels[i] - ladder.middle - place * ladder.step;
        if (off > kEvenLevels * ladder.step || off < -kEvenLevels * ladder.step) return false;
    }
    return true;
}

/// How many layers of the thinnest one's height fill the stack, rounded up but for rounding errors.
int count_layers(const std::vector<double>& faces) {
    constexpr double kSlack = 1e-6, kMax = 1 << 30;
    double thinnest = faces[1] - faces[0];
    for (std::size_t i = 1; i + 1 < faces.size(); ++i)
        if (faces[i + 1] - faces[i] < thinnest) thinnest = faces[i + 1] - faces[i];
    const double count = (faces.back() - faces.front()) / thinnest - kSlack;
    if (!(count < kMax)) return 1 << 30;
    const int whole = int(count);
    return double(whole) < count ? whole + 1 : whole;
}

}  // namespace

LayerStack stack_of_levels(const std::vector<double>& levels) {
    const std::size_t n = levels.size();
    LayerStack stack;
    stack.faces_m.resize(n + 1);
    const Ladder ladder = fit_ladder(levels);
    stack.even = is_even(levels, ladder);
    if (stack.even) {
        for (std::size_t i = 0; i <= n; ++i)
            stack.faces_m[i] = ladder.middle + (double(i) - double(n) / 2) * ladder.step;
        stack.layers = int(n);
        return stack;
    }

    // A level speaks for the heights that are nearer to it than to any other.
    for (std::size_t i = 1; i < n; ++i) stack.faces_m[i] = (levels[i - 1] + levels[i]) / 2;
    stack.faces_m[0] = levels[0] - (levels[1] - levels[0]) / 2;
    stack.faces_m[n] = levels[n - 1] + (levels[n - 1] - levels[n - 2]) / 2;
    stack.layers = count_layers(stack.faces_m);
    return stack;
}

Status lay_on_even_layers(const LayerStack& stack, Volume& volume) {
    const std::size_t plane = std::size_t(volume.size[0]) * std::size_t(volume.size[1]);
    const std::vector<double>& faces = stack.faces_m;
    const double step = stack.step_m();
    Buffer<float> laid;
    PILEUS_TRY(laid.resize(std::uint64_t(plane) * std::uint64_t(stack.layers), "equal layers"));

    std::size_t first = 0;
    for (int k = 0; k < stack.layers; ++k) {
        const double low = faces.front() + k * step;
        const double high = k + 1 < stack.layers ? low + step : faces.back();
        while (first + 2 < faces.size() && faces[first + 1] <= low) ++first;
        const Span<float> to = laid.span().part(std::size_t(k) * plane, plane);
        for (std::size_t cell = 0; cell < plane; ++cell) {
            // Add in doubles, from below: value times the thickness that both layers share.
            double sum = 0;
            for (std::size_t j = first; j + 1 < faces.size() && faces[j] < high; ++j) {
                const double from = faces[j] > low ? faces[j] : low;
                const double until = faces[j + 1] < high ? faces[j + 1] : high;
                if (until > from)
                    sum += (until - from) * double(volume.density.at(j * plane + cell));
            }
            to[cell] = float(sum / step);
        }
    }
    volume.density.swap(laid);
    volume.size[2] = stack.layers;
    return Status::ok();
}

}  // namespace pileus
