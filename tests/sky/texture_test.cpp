// SPDX-License-Identifier: Apache-2.0
// Noise textures: reads against the bytes, periods, levels' variances, bounds that hold.
// in: a small volume -> out: pass or fail.
#include <cmath>

#include "kernels_cpu/procedural/sky_field.h"
#include "tests/sky/sky_rig.h"
#include "tests/support/widths.h"

using namespace sky_test;

namespace {

struct Texture {
    Buffer<std::uint8_t> texels;
    NoiseTexture texture;
    NoiseView view;
    explicit Texture(int size = 32) {
        const NoiseParams p{kNoisePerlin, size, 4, most_octaves(size, 4), 0.5f, 11u};
        REQUIRE(make_noise(p, *kernel_table(nullptr), 2, texels));
        REQUIRE(pack_noise(texels, size, 2, texture));
        view = texture.view();
        view.per_m = 1.0f / 1024, view.share = 1;
        for (int l = 0; l <= view.last; ++l) view.lost[l] = float(texture.lost[l]);
    }
    double at(int x, int y, int z) const {
        const int n = texture.size, m = n - 1;
        return texels[std::size_t(((z & m) * n + (y & m)) * n + (x & m))];
    }
    /// Trilinear between the middles of texels, in double.
    double read(double u, double v, double w) const {
        const double n = texture.size, c[3] = {u * n - 0.5, v * n - 0.5, w * n - 0.5};
        double sum = 0;
        for (int corner = 0; corner < 8; ++corner) {
            double weight = 1;
            int i[3];
            for (int a = 0; a < 3; ++a) {
                const double low = std::floor(c[a]), f = c[a] - low;
                i[a] = int(low) + (corner >> a & 1);
                weight *= (corner >> a & 1) != 0 ? f : 1 - f;
            }
            sum += weight * at(i[0], i[1], i[2]);
        }
        return sum;
    }
};

Vec<float> place(Numbers& r, double reach) {
    return {r.in(-reach, reach), r.in(-reach, reach), r.in(-reach, reach)};
}

template <int W>
void check_width() {
    const Rig rig(small_sky());
    Numbers r;
    float in[4][W], d[3][W];
    for (int i = 0; i < 200; ++i) {
        for (int l = 0; l < W; ++l) {
            for (int a = 0; a < 2; ++a) in[a][l] = r.in(-9000, 9000);
            in[2][l] = r.in(800, 2700), in[3][l] = r.in(0, 1200);
            for (int a = 0; a < 3; ++a) d[a][l] = r.in(-1, 1);
        }
        using T = F<W>;
        const Vec<T> p{from_array<T>(in[0]), from_array<T>(in[1]), from_array<T>(in[2])};
        const Vec<T> way{from_array<T>(d[0]), from_array<T>(d[1]), from_array<T>(d[2])};
        const T width = from_array<T>(in[3]);
        const T density = sky_density(rig.params(), p, width);
        const NoiseBound<T> ahead = sky_ahead(rig.params(), p, way, width);
        for (int l = 0; l < W; ++l) {
            const Vec<float> one{in[0][l], in[1][l], in[2][l]}, one_way{d[0][l], d[1][l], d[2][l]};
            CHECK(lane(density, l) == sky_density(rig.params(), one, in[3][l]));
            const NoiseBound<float> alone = sky_ahead(rig.params(), one, one_way, in[3][l]);
            CHECK(lane(ahead.bound, l) == alone.bound);
            CHECK(lane(ahead.rest, l) == alone.rest);
        }
    }
}

}  // namespace

TEST_CASE("a read is the trilinear mean of the bytes, everywhere and around the ends") {
    const Texture t;
    Numbers r;
    for (int i = 0; i < 3000; ++i) {
        const Vec<float> p = place(r, 4096);
        const double wanted = t.read(double(p.x) / 1024, double(p.y) / 1024, double(p.z) / 1024);
        // A place has 2^-17 of a texel after it was reduced, neighbours differ by less than 100.
        CHECK(std::fabs(double(read_noise(t.view, p, 0.0f).value) - wanted) < 0.01);
    }
}

TEST_CASE("the noise comes back after a tile, bit for bit") {
    const Texture t;
    Numbers r;
    for (int i = 0; i < 500; ++i) {
        // Multiples of 1/16 keep the sum with a tile exact.
        const auto coarse = [&] { return std::floor(r.in(0, 16384)) / 16; };
        const Vec<float> p{coarse(), coarse(), coarse()};
        const Vec<float> q{p.x + 1024, p.y - 2048, p.z + 3072};
        for (float width : {0.0f, 40.0f, 90.0f, 5000.0f})
            CHECK(read_noise(t.view, p, width).value == read_noise(t.view, q, width).value);
    }
}

TEST_CASE("what a level has lost is what its reads vary less") {
    const Texture t;
    Numbers r;
    const int count = 60000;
    double square[6] = {}, mean[6] = {};
    for (int i = 0; i < count; ++i) {
        const Vec<float> p = place(r, 1024);
        for (int l = 0; l <= t.view.last; ++l) {
            const double v = double(read_noise(t.view, p, 32.0f * float(1 << l)).value);
            mean[l] += v / count, square[l] += v * v / count;
        }
    }
    const double finest = square[0] - mean[0] * mean[0];
    for (int l = 1; l <= t.view.last; ++l) {
        const double lost = finest - (square[l] - mean[l] * mean[l]);
        CHECK(read_noise(t.view, {1, 2, 3}, 32.0f * float(1 << l)).lost == t.view.lost[l]);
        // 60000 places of a field with 4^3 lumps: five deviations of a variance are 3 % of it; the
        // corners' symmetry holds on average only, 2 % more.
        CHECK(std::fabs(lost - t.texture.lost[l]) < 0.05 * finest);
    }
    CHECK(t.texture.lost[t.view.last] > 0.95 * finest);
}

TEST_CASE("levels join without a step") {
    const Texture t;
    Numbers r;
    for (int i = 0; i < 200; ++i) {
        const Vec<float> p = place(r, 1024);
        for (float edge : {32.0f, 64.0f, 128.0f, 1024.0f}) {
            const auto below = read_noise(t.view, p, edge * 0.99999f);
            const auto above = read_noise(t.view, p, edge);
            // Over a change of 1e-5 the blend moves by 2e-5 of a difference below 255.
            CHECK(std::fabs(below.value - above.value) < 0.02f);
            CHECK(std::fabs(below.lost - above.lost) < 0.02f * t.view.lost[5] / 100);
        }
    }
}

TEST_CASE("bounds hold until their rest ends") {
    const Texture t;
    Numbers r;
    for (int i = 0; i < 2000; ++i) {
        const Vec<float> p = place(r, 3000);
        const Vec<float> d = normalized(place(r, 1));
        const float width = i % 4 == 0 ? 0.0f : r.in(0, 300);
        const NoiseBound<float> ahead = noise_ahead(t.view, p, d, width * 1.25f, i % 3);
        CHECK(ahead.rest >= 0);
        CHECK(ahead.rest <= 1024 * 1.75f);  // a block's diagonal at most
        for (int s = 0; s <= 8; ++s) {
            const float along = ahead.rest * float(s) / 8 * 0.9999f;
            const Vec<float> q{p.x + d.x * along, p.y + d.y * along, p.z + d.z * along};
            CHECK(read_noise(t.view, q, width).value <= ahead.bound * 1.00001f);
        }
    }
}

TEST_CASE("skies are the same bits at every width") { PILEUS_EACH_WIDTH(check_width); }
