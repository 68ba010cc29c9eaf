// SPDX-License-Identifier: Apache-2.0
// Noise volumes: no seam, stated mean and deviation, the same bytes at every width and anywhere.
// in: parameters -> out: pass or fail.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "kernels_cpu/isa/kernels.h"
#include "kernels_cpu/procedural/sky_noise.h"
#include "src/base/digest.h"
#include "src/world/density/noise_volume.h"
#include "tests/support/widths.h"

using namespace pileus;

namespace {

const KernelTable& kernels() { return *kernel_table(nullptr); }

NoiseParams small(std::int32_t kind) { return {kind, 32, 4, 2, 0.5f, 7u}; }

Buffer<std::uint8_t> made(const NoiseParams& params, int threads = 2) {
    Buffer<std::uint8_t> texels;
    REQUIRE(make_noise(params, kernels(), threads, texels));
    return texels;
}

std::string digest(const Buffer<std::uint8_t>& texels) {
    Digest d;
    d.bytes(texels.data(), texels.size());
    return d.hex();
}

template <int W>
void check_rows() {
    for (std::int32_t kind : {kNoisePerlin, kNoiseWorley}) {
        const NoiseParams p = small(kind);
        std::vector<float> one(32 * 32 * 2), many(one.size());
        noise_rows<1>(p, {one.data()}, 0, 64);
        noise_rows<W>(p, {many.data()}, 0, 64);
        CHECK(one == many);
    }
}

/// Mean |difference| of neighbours along an axis, between planes `at` and the next.
double step(const Buffer<std::uint8_t>& v, int size, int axis, int at) {
    double sum = 0;
    for (int j = 0; j < size; ++j)
        for (int i = 0; i < size; ++i) {
            const auto texel = [&](int along) {
                int c[3] = {i, j, i};
                c[axis] = along & (size - 1), c[(axis + 1) % 3] = i, c[(axis + 2) % 3] = j;
                return int(v[std::size_t((c[2] * size + c[1]) * size + c[0])]);
            };
            sum += std::abs(texel(at + 1) - texel(at));
        }
    return sum / (size * size);
}

}  // namespace

TEST_CASE("rows of noise are the same bits at every width") { PILEUS_EACH_WIDTH(check_rows); }

TEST_CASE("octaves end at four texels per lump") {
    CHECK(most_octaves(128, 4) == 4);  // 4, 8, 16, 32 lumps
    CHECK(most_octaves(16, 4) == 1);
    CHECK(most_octaves(512, 1) == 8);
    CHECK(most_octaves(16, 8) == 1);
}

TEST_CASE("a volume has its mean, its deviation and no seam") {
    for (std::int32_t kind : {kNoisePerlin, kNoiseWorley}) {
        const int size = 32;
        const Buffer<std::uint8_t> v = made(small(kind));
        double one = 0, square = 0;
        for (std::uint8_t t : v.span()) one += t, square += double(t) * t;
        const double mean = one / double(v.size());
        // Rounding to bytes moves the mean by less than 0.5; what is cut off at 0 and 255 moves it
        // and the deviation by less than 2 % of a deviation.
        CHECK(mean == doctest::Approx(127.5).epsilon(0.01));
        CHECK(std::sqrt(square / double(v.size()) - mean * mean) ==
              doctest::Approx(255.0 / 7).epsilon(0.02));
        for (int axis = 0; axis < 3; ++axis) {
            double least = 1e9, most = 0;
            for (int at = 0; at < size - 1; ++at) {
                const double inner = step(v, size, axis, at);
                least = std::fmin(least, inner), most = std::fmax(most, inner);
            }
            // The step around the end is one like the others; a cut would be ten times as large.
            const double seam = step(v, size, axis, size - 1);
            CHECK(seam >= 0.8 * least);
            CHECK(seam <= 1.2 * most);
        }
    }
}

TEST_CASE("a volume's bytes are stored here; threads do not change them") {
    CHECK(digest(made(small(kNoisePerlin), 1)) == digest(made(small(kNoisePerlin), 3)));
    CHECK(digest(made(small(kNoisePerlin))) == "96f55153443534a6");
    CHECK(digest(made(small(kNoiseWorley))) == "b1f5c0dd89975b40");
    NoiseParams other = small(kNoisePerlin);
    other.seed += 1;
    CHECK(digest(made(other)) != digest(made(small(kNoisePerlin))));
}
