// SPDX-License-Identifier: Apache-2.0
// See samples.h.
// in: a weight per voxel -> out: points distributed as that weight, with the density there.
// Elek 2011, section 5.2. Counter of the random numbers: (sample, draw).
#include "src/methods/collectors/prepare/samples.h"

#include <algorithm>

#include "kernels_cpu/core/rng.h"
#include "platform/threads.h"
#include "src/methods/collectors/prepare/field_stats.h"
#include "src/world/grid/grid.h"

namespace pileus {
namespace {

constexpr std::uint32_t kChunk = 256;

/// Centre of one of 2048 equal parts of a voxel: exact in float up to 4096 voxels, never on a face.
float within(std::uint32_t word) { return float((word >> 21) * 2u + 1u) * 0x1p-12f; }

Sample make_sample(Span<const float> density, const Grid& grid, const int voxel[3],
                   const std::uint32_t words[3]) {
    Sample s{};
    for (int a = 0; a < 3; ++a) s.x[a] = float(voxel[a]) + within(words[a]);
    s.density = density_at(density, grid, s.x);
    return s;
}

/// Runs work(first, last) for chunks of samples, last excluded.
template <class Function>
void for_each_chunk(int threads, std::uint32_t count, Function&& work) {
    parallel_for(threads, (std::int64_t(count) + kChunk - 1) / kChunk, [&](std::int64_t c, int) {
        const std::uint64_t begin = std::uint64_t(c) * kChunk;
        const std::uint64_t end = std::min<std::uint64_t>(begin + kChunk, count);
        work(std::uint32_t(begin), std::uint32_t(end));
    });
}

/// Sums of whole rows, cumulated: start[r] is the sum of all rows before r.
Status cumulate_rows(Span<const float> field, const Grid& grid, int threads,
                     Buffer<double>& start) {
    const std::size_t nx = std::size_t(grid.size[0]), rows = voxel_count(grid) / nx;
    const std::size_t per_slice = std::size_t(grid.size[1]);
    PILEUS_TRY(allocate(arrays::row_sums(grid), start));
    parallel_for(threads, grid.size[2], [&](std::int64_t k, int) {
        const std::size_t begin = std::size_t(k) * per_slice, end = begin + per_slice;
        for (std::size_t r = begin; r < end; r += kAbreast)
            sums_abreast(field.data + r * nx, nx, nx, int(std::min<std::size_t>(kAbreast, end - r)),
                         start.data() + r + 1);
    });
    for (std::size_t r = 0; r < rows; ++r) start[r + 1] += start[r];
    return Status::ok();
}

/// Finds the voxels in which the cumulative sum passes targets, none below the one before it.
class Inverse {
public:
    Inverse(Span<const float> field, const Grid& grid, Span<const double> start)
        : field_(field), start_(start), nx_(std::size_t(grid.size[0])) {}

    std::size_t find(double target) {
        // Find the last row that begins at or before the target; rounding at the very end may pass
        // beyond the last row that holds anything.
        if (!begun_ || target >= start_[row_ + 1]) {
            const double* from = start_.begin() + row_;
            const double* above = std::upper_bound(from, start_.end(), target);
            std::size_t row = std::size_t(above - start_.begin()) - 1;
            row = std::min(row, start_.size - 2);
            while (start_[row + 1] == start_[row]) --row;
            if (!begun_ || row != row_) enter(row);
        }
        // Walk on along the row; keep the last voxel of positive weight for the same reason.
        while (!(target < sum_) && next_ < (row_ + 1) * nx_) {
            const float weight = field_[next_++];
            if (!(weight > 0.0f)) continue;
            found_ = next_ - 1;
            sum_ += double(weight);
        }
        return found_;
    }

private:
    void enter(std::size_t row) {
        begun_ = true;
        row_ = row;
        sum_ = start_[row];
        found_ = next_ = row * nx_;
    }

    Span<const float> field_;
    Span<const double> start_;
    std::size_t nx_;
    bool begun_ = false;
    std::size_t row_ = 0, next_ = 0, found_ = 0;
    double sum_ = 0;
};

}  // namespace

Status sample_stratified(Span<const float> field, const FieldStats& stats,
                         Span<const float> density, const Grid& grid, const SampleOptions& options,
                         int threads, SampleSet& out) {
    assert(field.size == voxel_count(grid) && density.size == field.size);
    out = SampleSet{};
    if (!(stats.sum > 0) || options.count == 0) return Status::ok();
    Buffer<double> start;
    PILEUS_TRY(cumulate_rows(field, grid, threads, start));
    PILEUS_TRY(allocate(arrays::samples(options.count), out.samples));
    out.tries = options.count;
    const Key key = make_key(options.seed, options.stream, options.high);
    const double total = start[start.size() - 1], share = total / double(options.count);
    const std::size_t nx = std::size_t(grid.size[0]), ny = std::size_t(grid.size[1]);
    for_each_chunk(threads, options.count, [&](std::uint32_t first, std::uint32_t last) {
        Inverse inverse(field, grid, start.span());
        for (std::uint32_t s = first; s < last; ++s) {
            const Words<std::uint32_t> u = threefry(key.k0, key.k1, s, std::uint32_t{0});
            const Words<std::uint32_t> v = threefry(key.k0, key.k1, s, std::uint32_t{1});
            const std::size_t found = inverse.find((double(s) + double(u.a) * 0x1p-32) * share);
            const int voxel[3] = {int(found % nx), int(found / nx % ny), int(found / nx / ny)};
            const std::uint32_t words[3] = {u.b, v.a, v.b};
            out.samples[s] = make_sample(density, grid, voxel, words);
        }
    });
    return Status::ok();
}

Status sample_rejection(Span<const float> field, const FieldStats& stats, Span<const float> density,
                        const Grid& grid, const SampleOptions& options, int threads,
                        SampleSet& out) {
    assert(field.size == voxel_count(grid) && density.size == field.size);
    out = SampleSet{};
    if (!(stats.max > 0.0f) || options.count == 0) return Status::ok();
    Buffer<Sample> found;
    Buffer<std::uint32_t> tries;
    PILEUS_TRY(allocate(arrays::drawn_samples(options.count), found));
    PILEUS_TRY(allocate(arrays::sample_tries(options.count), tries));
    const Key key = make_key(options.seed, options.stream, options.high);
    const std::uint32_t limit = std::min<std::uint32_t>(options.max_tries, 0x7fffffff);
    const auto draw = [&](std::uint32_t s) {
        for (std::uint32_t t = 0; t < limit; ++t) {
            const Words<std::uint32_t> u = threefry(key.k0, key.k1, s, 2u * t);
            const Words<std::uint32_t> v = threefry(key.k0, key.k1, s, 2u * t + 1u);
            // Split each product into a voxel (whole part) and a place within it (fraction).
            const std::uint32_t draws[3] = {u.a, u.b, v.a};
            int voxel[3];
            std::uint32_t words[3];
            for (int a = 0; a < 3; ++a) {
                const std::uint64_t p = std::uint64_t(draws[a]) * std::uint64_t(grid.size[a]);
                voxel[a] = int(p >> 32);
                words[a] = std::uint32_t(p);
            }
            const float weight = field[voxel_index(grid, voxel[0], voxel[1], voxel[2])];
            tries[s] = t + 1;
            if (!(double(v.b) * 0x1p-32 * double(stats.max) < double(weight))) continue;
            found[s] = make_sample(density, grid, voxel, words);
            return;
        }
        found[s].density = -1.0f;
    };
    for_each_chunk(threads, options.count, [&](std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t s = first; s < last; ++s) draw(s);
    });
    // Close the gaps that given-up samples leave, in the order of the samples.
    std::uint32_t kept = 0;
    for (std::uint32_t s = 0; s < options.count; ++s) {
        out.tries += tries[s];
        if (found[s].density >= 0.0f) found[kept++] = found[s];
    }
    out.given_up = options.count - kept;
    PILEUS_TRY(allocate(arrays::samples(kept), out.samples));
    std::copy(found.data(), found.data() + kept, out.samples.data());
    return Status::ok();
}

}  // namespace pileus
