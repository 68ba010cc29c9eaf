// SPDX-License-Identifier: Apache-2.0
// See noise_volume.h. Mean and deviation are sums of integers, so that any order gives them.
// in: NoiseParams -> out: bytes.
#include "src/world/density/noise_volume.h"

#include <cmath>

#include "platform/threads.h"

namespace pileus {
namespace {

constexpr std::int64_t kPieces = 64;  // of the texels, each summed on its own
constexpr double kQuanta = 0x1p20;    // values are below 8: their squares fit 46 bits
constexpr double kDeviations = 7;     // standard deviations from 0 to 255

struct Sums {
    std::int64_t one = 0, square = 0;  // of values and of squares, in quanta and quanta^2 / 2^20
};

Sums add_up(Span<const float> values) {
    Sums sums;
    for (const float value : values) {
        const std::int64_t quanta = std::int64_t(double(value) * kQuanta);
        sums.one += quanta;
        sums.square += quanta * quanta >> 20;
    }
    return sums;
}

std::uint8_t byte_of(float value, double mean, double per_value) {
    const double v = 127.5 + (double(value) - mean) * per_value;
    return std::uint8_t(v < 0 ? 0 : v > 255 ? 255 : v + 0.5);
}

}  // namespace

int most_octaves(int size, int cells) {
    int octaves = 1;
    while (cells * kTexelsPerCell * 2 <= size) cells *= 2, ++octaves;
    return octaves;
}

Status make_noise(const NoiseParams& params, const KernelTable& kernels, int threads,
                  Buffer<std::uint8_t>& texels) {
    const std::uint64_t size = std::uint64_t(params.size), count = size * size * size;
    Buffer<float> values;
    PILEUS_TRY(texels.resize(count, "noise volume"));
    PILEUS_TRY(values.resize(count, "noise volume, unscaled"));
    const std::int64_t rows = std::int64_t(size * size);
    parallel_for(threads, rows / params.size, [&](std::int64_t slice, int) {
        kernels.noise_rows(params, values.data(), std::uint32_t(slice * params.size),
                           std::uint32_t((slice + 1) * params.size));
    });
    Sums parts[kPieces];
    const std::size_t piece_texels = std::size_t(count) / kPieces;
    parallel_for(threads, kPieces, [&](std::int64_t i, int) {
        parts[i] = add_up({values.data() + std::size_t(i) * piece_texels, piece_texels});
    });
    Sums all;
    for (const Sums& part : parts) all.one += part.one, all.square += part.square;
    const double mean = double(all.one) / double(count) / kQuanta;
    const double variance = double(all.square) / double(count) / kQuanta - mean * mean;
    // A volume without variation cannot come from noise; should it, it is flat.
    const double per_value = variance > 1e-12 ? 255 / (kDeviations * std::sqrt(variance)) : 0;
    parallel_for(threads, kPieces, [&](std::int64_t i, int) {
        const std::size_t begin = std::size_t(i) * piece_texels;
        for (std::size_t t = begin; t < begin + piece_texels; ++t)
            texels[t] = byte_of(values[t], mean, per_value);
    });
    return Status::ok();
}

}  // namespace pileus
