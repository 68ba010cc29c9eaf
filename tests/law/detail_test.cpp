// SPDX-License-Identifier: Apache-2.0
// Detail beyond the grid: what its noise keeps, where it repeats, and what finer grids have of it.
// in: tiles, boxes of few cells -> out: pass or fail; tests/law/detail_picture_test.cpp has
// pictures. docs/detail.md
#include "src/world/medium/detail.h"

#include <algorithm>

#include "kernels_cpu/media/detail.h"
#include "src/world/medium/mix_media.h"
#include "tests/support/render_harness.h"
#include "tests/support/widths.h"

namespace detail_test {

using namespace render_test;

Buffer<float> tile_of(const DetailSettings& settings, int threads = 1,
                      const KernelTable* table = nullptr) {
    Buffer<float> tile;
    REQUIRE(make_detail_tile(settings, host_kernels(table), threads, tile));
    return tile;
}

DetailSettings settings_of(DetailNoise noise, int cells, int octaves = 0) {
    DetailSettings s;
    s.tile_m = 64;
    s.strength = 1;
    s.dense = 1;
    s.noise = noise;
    s.cells = cells;
    s.octaves = octaves;
    return s;
}

/// A box of 64 m with n^3 cells of the same density.
Scene box_scene(int n, const DetailSettings& detail, const char* density = "uniform:box") {
    Scene scene;
    scene.file = "t.toml";
    scene.media.resize(1);
    MediumSettings& m = scene.media[0];
    m.density = density;
    m.box.has_bounds = true;
    m.box.bounds_m = {{{0, 0, 0}, {64, 64, 64}}};
    m.box.resolution = {n, n, n};
    m.optics.extinction_per_m = 0.125;
    m.detail = detail;
    return scene;
}

Medium loaded(const Scene& scene) {
    Medium out;
    Plan plan;
    const Status status = load_media(scene, Limits{}, 1, plan, out);
    REQUIRE_MESSAGE(status, status.message);
    return out;
}

TEST_CASE("detail: a tile has mean 0, nothing below -1, and ends as it begins") {
    for (const DetailNoise noise : {DetailNoise::kPerlin, DetailNoise::kWorley})
        for (const int cells : {16, 64}) {
            CAPTURE(cells);
            const DetailSettings s = settings_of(noise, cells);
            const Buffer<float> tile = tile_of(s);
            const std::size_t n = std::size_t(cells), edge = n + 1;
            double sum = 0, square = 0;
            float least = 0, most = 0;
            std::size_t other = 0;
            for (std::size_t z = 0; z < edge; ++z)
                for (std::size_t y = 0; y < edge; ++y)
                    for (std::size_t x = 0; x < edge; ++x) {
                        const float v = tile[(z * edge + y) * edge + x];
                        if (v != tile[((z % n) * edge + y % n) * edge + x % n]) ++other;
                        if (x == n || y == n || z == n) continue;
                        sum += double(v), square += double(v) * double(v);
                        least = std::min(least, v), most = std::max(most, v);
                    }
            CHECK(other == 0);
            // Each number is rounded once, by 2^-25 at most.
            CHECK(std::fabs(sum / double(n * n * n)) < 0x1p-25);
            CHECK(least >= -1.0f);
            CHECK(least < -0.7f);
            CHECK(most > 0.7f);
            CHECK(square / double(n * n * n) > 0.1);
        }
}

TEST_CASE("detail: a tile does not depend on threads or kernels, but on every key of it") {
    const DetailSettings s = settings_of(DetailNoise::kPerlin, 32);
    const Buffer<float> one = tile_of(s);
    const auto same = [&](const Buffer<float>& b) {
        return b.size() == one.size() && std::equal(one.data(), one.data() + one.size(), b.data());
    };
    CHECK(same(tile_of(s, 3)));
    for (int i = 0; kernel_table_at(i) != nullptr; ++i)
        if (kernel_table_at(i)->device == nullptr) CHECK(same(tile_of(s, 2, kernel_table_at(i))));
    DetailSettings other = s;
    other.seed = 1;
    CHECK_FALSE(same(tile_of(other)));
    CHECK_FALSE(same(tile_of(settings_of(DetailNoise::kWorley, 32))));
    CHECK_FALSE(std::equal(one.data(), one.data() + one.size(),
                           tile_of(settings_of(DetailNoise::kPerlin, 32, 1)).data()));
}

template <int W>
void check_period() {
    using T = F<W>;
    const Buffer<float> tile = tile_of(settings_of(DetailNoise::kPerlin, 16));
    DetailView v{};
    v.tile = tile.data();
    v.cells = 16;
    for (int a = 0; a < 3; ++a) v.period[a] = 64, v.per_metre[a] = 0.25f;
    v.strength = 1;
    const T step = to_float(iota<I<W>>()) * 3.25f;
    for (int i = 0; i < 40; ++i) {
        const float at = 1.5f * float(i);
        const Vec<T> p{step + at, all<T>(at), all<T>(2 * at)};
        const T here = detail_noise(v, p);
        // Powers of two: places a period on are exact.
        for (const float away : {64.0f, -64.0f, 640.0f}) {
            const T there = detail_noise(v, Vec<T>{p.x + away, p.y - away, p.z + 2 * away});
            for (int l = 0; l < W; ++l) REQUIRE(lane(here, l) == lane(there, l));
        }
        for (int l = 0; l < W; ++l) {
            const Vec<float> alone{lane(p.x, l), lane(p.y, l), lane(p.z, l)};
            REQUIRE(lane(here, l) == detail_noise(v, alone));
        }
    }
    // At the points of the tile it is what is stored there; beyond all sense of place a number.
    CHECK(lane(detail_noise(v, Vec<T>{all<T>(4.0f), all<T>(8.0f), all<T>(60.0f)}), 0) ==
          tile[(15 * 17 + 2) * 17 + 1]);
    for (const float far : {1e30f, -1e30f, 3e38f}) {
        const float n = lane(detail_noise(v, Vec<T>{all<T>(far), all<T>(far), all<T>(far)}), 0);
        CHECK((n >= -1.0f && n <= 2.0f));
    }
}

/// Mean of the squares of a tile's numbers, or of how two tiles differ.
double mean_square(const Buffer<float>& a, const Buffer<float>* b = nullptr) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double d = double(a[i]) - (b != nullptr ? double((*b)[i]) : 0.0);
        sum += d * d;
    }
    return sum / double(a.size());
}

TEST_CASE("detail: with age its lumps become others, as strong at every age, without a jump") {
    for (const DetailNoise noise : {DetailNoise::kPerlin, DetailNoise::kWorley}) {
        DetailSettings s = settings_of(noise, 32);
        const Buffer<float> young = tile_of(s);
        const double strength = mean_square(young);
        Buffer<float> before = tile_of(s);
        const int steps = 64;
        for (int i = 1; i <= 2 * steps; ++i) {
            CAPTURE(i);
            s.age = double(i) / steps;
            Buffer<float> now = tile_of(s, i % 3 + 1);
            double sum = 0;
            for (std::size_t z = 0; z < 32; ++z)
                for (std::size_t y = 0; y < 32; ++y)
                    for (std::size_t x = 0; x < 32; ++x) sum += double(now[(z * 33 + y) * 33 + x]);
            CHECK(std::fabs(sum / (32.0 * 32 * 32)) < 0x1p-25);
            CHECK(*std::min_element(now.data(), now.data() + now.size()) >= -1.0f);
            // Two noises are independent but for chance: few lumps lie in a tile.
            CHECK(mean_square(now) > 0.7 * strength);
            CHECK(mean_square(now) < 1.4 * strength);
            // Weights change by 1.5 a life at the most, their root's square by as much again.
            CHECK(mean_square(now, &before) < 16.0 * strength / (steps * steps));
            // Half way in between it is as far from the first as from the second.
            if (i == steps) CHECK(mean_square(now, &young) > 1.5 * strength);
            before.swap(now);
        }
        DetailSettings late = s;
        late.age = 1e6;
        const Buffer<float> last = tile_of(late);
        CHECK(mean_square(last) > 0.7 * strength);
        CHECK(mean_square(last, &young) > strength);
    }
}

TEST_CASE("detail: noise repeats after its period, the same at every width") {
    PILEUS_EACH_WIDTH(check_period);
}

TEST_CASE("detail: whole tiles keep the mean of a uniform medium") {
    for (const DetailNoise noise : {DetailNoise::kPerlin, DetailNoise::kWorley})
        for (const double dense : {0.0, 0.5, 1.0}) {
            DetailSettings s = settings_of(noise, 16);
            s.dense = dense;
            s.refine = 8;  // 32^3 cells, two for each of the tile: their middles mean its numbers
            const Medium m = loaded(box_scene(4, s));
            CHECK(m.volume.size == std::array<int, 3>{32, 32, 32});
            CHECK_FALSE(m.detail.present());
            // Each of the values is rounded a few times, in units of 2^-24.
            CHECK(mean_density(m) == doctest::Approx(1).epsilon(0x1p-22));
            const auto range = std::minmax_element(m.volume.density.data(),
                                                   m.volume.density.data() + 32 * 32 * 32);
            CHECK(*range.first >= 0);
            // Without strength at the largest density, which all have, nothing changes.
            if (dense > 0) CHECK(*range.second - *range.first > 0.5 * dense);
            if (!(dense > 0)) CHECK(*range.first == doctest::Approx(1).epsilon(1e-6));
            CHECK(m.density_max == *range.second);
        }
}

TEST_CASE("detail: laid on a cumulus it keeps the mean, and none of it lies in empty air") {
    DetailSettings none, s = settings_of(DetailNoise::kPerlin, 32);
    s.tile_m = 16;
    s.dense = 0.25;
    s.refine = 4;
    Scene scene = box_scene(16, none, "procedural:cumulus");
    const Medium coarse = loaded(scene);
    scene.media[0].detail = s;
    const Medium fine = loaded(scene);
    // 64 tiles: noise and cloud do not know of one another; a share of their parts is left over.
    CHECK(mean_density(fine) == doctest::Approx(mean_density(coarse)).epsilon(0.005));
    std::size_t filled = 0;
    for (int z = 0; z < 64; ++z)
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) {
                const Vec<float> p{(float(x) + 0.5f) / 4, (float(y) + 0.5f) / 4,
                                   (float(z) + 0.5f) / 4};
                const float without =
                    interpolate(coarse.volume.density.data(), corners(p, coarse.grid.size));
                const float now = fine.volume.density[voxel_index(fine.grid, x, y, z)];
                REQUIRE(now >= 0);
                REQUIRE(now <= 2.5f * without);
                if (now > 0) ++filled;
            }
    CHECK(filled > 1000);
}

TEST_CASE("detail: one cell, tiles shorter than a cell and longer than the medium") {
    for (const double tile_m : {2.0, 64.0, 1e5, 1e9})
        for (const int refine : {0, 3}) {
            CAPTURE(tile_m);
            DetailSettings s = settings_of(DetailNoise::kWorley, 16);
            s.tile_m = tile_m;
            s.refine = refine;
            const Medium m = loaded(box_scene(1, s));
            CHECK(m.detail.present() == (refine == 0));
            CHECK(m.grid.size[0] == (refine == 0 ? 1 : 3));
            CHECK(march_step(m) > 0);
            for (const float d : m.volume.density.span()) CHECK((d >= 0 && d <= 2.5f));
        }
    // Whole periods fill a medium that repeats.
    DetailSettings s = settings_of(DetailNoise::kPerlin, 16);
    s.tile_m = 20;
    Scene scene = box_scene(4, s);
    scene.media[0].box.periodic = true;
    const Medium m = loaded(scene);
    CHECK(m.detail.view.period[0] == float(64.0 / 3));
    CHECK(m.detail.view.period[1] == float(64.0 / 3));
    CHECK(m.detail.view.period[2] == 20.0f);
    s.tile_m = 500;
    scene.media[0].detail = s;
    CHECK(loaded(scene).detail.view.period[0] == 64.0f);
    // More tiles than floats can tell apart.
    s.tile_m = 0.0009;
    scene.media[0].detail = s;
    Medium out;
    Plan plan;
    const Status status = load_media(scene, Limits{}, 1, plan, out);
    CHECK(status.message ==
          "t.toml: medium.0.detail.tile_m: too short for a box of 64 m, 9e-04, allowed: at least "
          "1/65536 of it");
}

TEST_CASE("detail: two media have theirs on a grid, each its own") {
    DetailSettings s = settings_of(DetailNoise::kPerlin, 16);
    s.refine = 8;
    Scene scene = box_scene(4, s);
    scene.media.push_back(scene.media[0]);
    scene.media[1].detail.seed = 5;
    const Medium m = loaded(scene);
    CHECK(m.count == 2);
    CHECK(m.grid.size[0] == 32);
    CHECK(double(m.sigma) * mean_density(m) == doctest::Approx(0.25).epsilon(1e-5));
}

TEST_CASE("detail: finer grids count against the limits before they are made") {
    DetailSettings s = settings_of(DetailNoise::kPerlin, 16);
    s.refine = 16;
    Scene scene = box_scene(300, s);
    Medium out;
    MediumSource source;
    Plan plan;
    const Status status = outline_media(scene, Limits{}, 1, plan, out, source);
    CHECK(status.code == Code::kLimit);
}

}  // namespace detail_test
