// SPDX-License-Identifier: Apache-2.0
// See noise_volume.h. Levels are means of 2 x 2 x 2 texels; all sums are of integers.
// in: bytes -> out: words, maxima, variances.
#include "platform/threads.h"
#include "src/world/density/noise_volume.h"

namespace pileus {
namespace {

/// A level's bytes; coordinates wrap around.
struct Level {
    const std::uint8_t* texels;
    int size;
    std::uint8_t at(int x, int y, int z) const {
        const int mask = size - 1;
        const std::size_t row = std::size_t((z & mask) * size + (y & mask));
        return texels[row * std::size_t(size) + std::size_t(x & mask)];
    }
};

/// Bytes of all levels below level 0, one after the other.
std::uint64_t coarse_bytes(std::uint64_t size) {
    std::uint64_t bytes = 0;
    for (std::uint64_t m = size / 2; m >= 1; m /= 2) bytes += m * m * m;
    return bytes;
}

void halve(const Level& from, std::uint8_t* to, int threads) {
    const int m = from.size / 2;
    parallel_for(threads, m, [&](std::int64_t slice, int) {
        const int z = int(slice);
        std::uint8_t* out = to + std::size_t(slice) * std::size_t(m) * std::size_t(m);
        for (int y = 0; y < m; ++y)
            for (int x = 0; x < m; ++x) {
                int sum = 4;
                for (int c = 0; c < 8; ++c)
                    sum += from.at(2 * x + (c & 1), 2 * y + (c >> 1 & 1), 2 * z + (c >> 2));
                *out++ = std::uint8_t(sum / 8);
            }
    });
}

void pack_level(const Level& level, std::int32_t* words, int threads) {
    const int m = level.size;
    parallel_for(threads, m, [&](std::int64_t slice, int) {
        const int z = int(slice);
        std::int32_t* out = words + std::size_t(slice) * std::size_t(m) * std::size_t(m);
        for (int y = 0; y < m; ++y) {
            std::uint32_t left = level.at(0, y, z) | std::uint32_t(level.at(0, y + 1, z)) << 16;
            for (int x = 0; x < m; ++x) {
                const std::uint32_t right =
                    level.at(x + 1, y, z) | std::uint32_t(level.at(x + 1, y + 1, z)) << 16;
                *out++ = std::int32_t(left | right << 8);
                left = right;
            }
        }
    });
}

/// Mean square of the trilinear field through the texels, less the square of its mean. Along an
/// axis the mean of ((1-t) a + t b)^2 over t is (2 a^2 + 2 a b + 2 b^2) / 6: of the products with
/// the neighbours, 2/3 with itself and 1/3 with the next.
double level_variance(const Level& level, int threads) {
    const int m = level.size;
    Buffer<std::uint64_t> sums;
    if (!sums.resize(std::uint64_t(m) * 9, "noise sums")) return 0;
    parallel_for(threads, m, [&](std::int64_t slice, int) {
        std::uint64_t* own = sums.data() + slice * 9;
        const int z = int(slice);
        for (int y = 0; y < m; ++y)
            for (int x = 0; x < m; ++x) {
                const std::uint32_t here = level.at(x, y, z);
                own[8] += here;
                for (int c = 0; c < 8; ++c)
                    own[c] += here * level.at(x + (c & 1), y + (c >> 1 & 1), z + (c >> 2));
            }
    });
    const double count = double(m) * double(m) * double(m);
    double square = 0, mean = 0;
    for (int c = 0; c < 9; ++c) {
        std::uint64_t sum = 0;
        for (int z = 0; z < m; ++z) sum += sums[std::size_t(z) * 9 + std::size_t(c)];
        if (c == 8) {
            mean = double(sum) / count;
            continue;
        }
        const int beside = (c & 1) + (c >> 1 & 1) + (c >> 2);
        double weight = 8.0 / 27.0;
        for (int i = 0; i < beside; ++i) weight *= 0.5;
        square += weight * double(sum) / count;
    }
    return square - mean * mean;
}

int largest_in(const Level& level, const int (&low)[3], const int (&high)[3]) {
    int most = 0;
    for (int z = low[2]; z <= high[2]; ++z)
        for (int y = low[1]; y <= high[1]; ++y)
            for (int x = low[0]; x <= high[0]; ++x) {
                const int value = level.at(x, y, z);
                most = value > most ? value : most;
            }
    return most;
}

/// Maxima over all texels that reading within a block touches, of the level, of the next, and of
/// all finer ones, whose blocks are there already.
void set_largest(const Level& level, const Level& next, bool finer, std::uint8_t* out,
                 int threads) {
    const int blocks = noise_blocks(level.size), edge = level.size / blocks;
    const std::int64_t start = noise_level_start(blocks);
    parallel_for(threads, blocks, [&](std::int64_t slice, int) {
        for (int y = 0; y < blocks; ++y)
            for (int x = 0; x < blocks; ++x) {
                const int block[3] = {x, y, int(slice)};
                int low[3], high[3], low_next[3], high_next[3];
                for (int a = 0; a < 3; ++a) {
                    low[a] = block[a] * edge - 1, high[a] = (block[a] + 1) * edge;
                    low_next[a] = block[a] * edge / 2 - 1, high_next[a] = (block[a] + 1) * edge / 2;
                }
                const int here = largest_in(level, low, high);
                const int coarse = largest_in(next, low_next, high_next);
                int most = here > coarse ? here : coarse;
                for (int c = 0; c < 8 && finer; ++c) {
                    const std::int64_t n = 2 * blocks, fx = 2 * x + (c & 1);
                    const std::int64_t fy = 2 * y + (c >> 1 & 1), fz = 2 * slice + (c >> 2);
                    const int below = out[noise_level_start(n) + (fz * n + fy) * n + fx];
                    most = below > most ? below : most;
                }
                out[start + (slice * blocks + y) * blocks + x] = std::uint8_t(most);
            }
    });
}

}  // namespace

NoiseView NoiseTexture::view() const {
    NoiseView v{};
    v.words = words.data(), v.largest = largest.data();
    v.size = size;
    while (size >> v.last > 1) ++v.last;
    return v;
}

std::uint64_t noise_texture_bytes(std::uint64_t size) {
    const std::int64_t blocks = noise_blocks(std::int32_t(size));
    return 4 * std::uint64_t(noise_words(std::int64_t(size))) + std::uint64_t(noise_words(blocks));
}

std::uint64_t noise_packing_bytes(std::uint64_t size) {
    return size * size * size + coarse_bytes(size) + 9 * 8 * size;
}

Status pack_noise(const Buffer<std::uint8_t>& texels, int size, int threads, NoiseTexture& out) {
    Buffer<std::uint8_t> coarse;
    PILEUS_TRY(coarse.resize(coarse_bytes(std::uint64_t(size)), "levels of a noise volume"));
    PILEUS_TRY(out.words.resize(std::uint64_t(noise_words(size)), "noise texture"));
    const int blocks = noise_blocks(size);
    const std::uint64_t largest_words = std::uint64_t(noise_words(blocks) + 3) / 4;
    Buffer<std::uint8_t> largest;
    PILEUS_TRY(largest.resize(4 * largest_words, "noise maxima"));
    PILEUS_TRY(out.largest.resize(largest_words, "noise texture's maxima"));
    out.size = size;
    Level level{texels.data(), size};
    std::uint8_t* to = coarse.data();
    double finest = 0;
    for (int l = 0; level.size >= 1; ++l) {
        Level next{to, level.size / 2};
        if (next.size > 0) halve(level, to, threads);
        const double variance = level_variance(level, threads);
        if (l == 0) finest = variance;
        out.lost[l] = variance < finest ? finest - variance : 0;
        pack_level(level, out.words.data() + noise_level_start(level.size), threads);
        // Smaller levels share one block, whose largest value bounds their means.
        if (level.size >= kNoiseBlock) set_largest(level, next, l > 0, largest.data(), threads);
        if (next.size == 0) break;
        to += std::size_t(next.size) * std::size_t(next.size) * std::size_t(next.size);
        level = next;
    }
    out.most = largest[0];  // of the one block of the coarsest levels
    // By value, not by the machine's order of bytes.
    for (std::size_t w = 0; w < out.largest.size(); ++w) {
        std::uint32_t word = 0;
        for (std::size_t i = 0; i < 4; ++i) word |= std::uint32_t(largest[4 * w + i]) << (8 * i);
        out.largest[w] = std::int32_t(word);
    }
    return Status::ok();
}

}  // namespace pileus
