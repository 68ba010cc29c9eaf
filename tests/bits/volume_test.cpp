// SPDX-License-Identifier: Apache-2.0
// Built-in volumes: closed forms of the shapes, structure and stored bits of the cumulus.
// in: parameters -> out: pass or fail.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "kernels_cpu/isa/kernels.h"
#include "kernels_cpu/procedural/noise.h"
#include "src/base/digest.h"
#include "src/scene/rows/density_row.h"
#include "src/world/density/cumulus.h"
#include "src/world/density/shapes.h"

using namespace pileus;

namespace {

Volume cumulus(std::array<int, 3> resolution, std::int64_t seed, int threads = 1) {
    CumulusSettings settings;
    settings.resolution = resolution;
    settings.seed = seed;
    Volume volume;
    REQUIRE(make_cumulus(settings, *kernel_table(nullptr), threads, volume).code == Code::kOk);
    return volume;
}

std::string digest(const Volume& volume) {
    Digest d;
    d.floats(volume.density.span());
    return d.hex();
}

double mean(const Volume& volume) {
    double sum = 0;
    for (float v : volume.density.span()) sum += double(v);
    return sum / double(volume.density.size());
}

float at(const Volume& v, int x, int y, int z) {
    return v.density[std::size_t((z * v.size[1] + y) * v.size[0] + x)];
}

/// Sizes in cells: the largest piece connected through shared faces, and all pieces together.
struct Parts {
    std::size_t largest = 0, all = 0;
};

/// Counts the piece that holds cell `start` and marks it as seen.
std::size_t flood(const Volume& v, std::size_t start, std::vector<char>& seen) {
    const std::size_t nx = std::size_t(v.size[0]), layer = nx * std::size_t(v.size[1]);
    std::vector<std::size_t> open{start};
    std::size_t count = 0;
    seen[start] = 1;
    // The outermost layer is empty, so no neighbour of an occupied cell lies outside.
    while (!open.empty()) {
        const std::size_t i = open.back();
        open.pop_back();
        ++count;
        for (std::size_t j : {i - 1, i + 1, i - nx, i + nx, i - layer, i + layer})
            if (v.density[j] > 0 && !seen[j]) seen[j] = 1, open.push_back(j);
    }
    return count;
}

Parts parts(const Volume& v) {
    Parts p;
    std::vector<char> seen(v.density.size());
    for (std::size_t i = 0; i < seen.size(); ++i) {
        if (v.density[i] <= 0) continue;
        ++p.all;
        if (seen[i]) continue;
        const std::size_t n = flood(v, i, seen);
        if (n > p.largest) p.largest = n;
    }
    return p;
}

}  // namespace

TEST_CASE("a uniform box is one everywhere, by default in one cell") {
    Volume v;
    CHECK(density_row("uniform:box")->outline({}).size == std::array<int, 3>{1, 1, 1});
    REQUIRE(make_box({1, 1, 1}, v).code == Code::kOk);
    CHECK(v.density[0] == 1.0f);
    REQUIRE(make_box({3, 4, 5}, v).code == Code::kOk);
    CHECK(v.density.size() == 60);
    for (float x : v.density.span()) CHECK(x == 1.0f);
}

TEST_CASE("sphere and ellipsoid fill pi/6 of their box") {
    // Midpoint samples 1/(8n) apart miss the closed form by far less than 1e-3 at these sizes.
    const double expected = 3.14159265358979 / 6;
    Volume v;
    CHECK(density_row("uniform:sphere")->outline({}).size == std::array<int, 3>{64, 64, 64});
    REQUIRE(make_ellipsoid({64, 64, 64}, v).code == Code::kOk);
    CHECK(std::fabs(mean(v) - expected) < 1e-4);
    CHECK(at(v, 32, 32, 32) == 1.0f);
    CHECK(at(v, 0, 0, 0) == 0.0f);
    CHECK(at(v, 0, 32, 32) > 0.0f);
    CHECK(at(v, 3, 20, 31) == at(v, 60, 43, 32));
    REQUIRE(make_ellipsoid({40, 17, 23}, v).code == Code::kOk);
    CHECK(std::fabs(mean(v) - expected) < 1e-3);
    for (float x : v.density.span()) CHECK((x >= 0.0f && x <= 1.0f));
}

TEST_CASE("a cumulus refuses boxes that it cannot fill") {
    Volume v;
    CumulusSettings s;
    s.resolution = {8, 8, 8};
    for (double bad : {0.0, -1.0, std::nan(""), 1e300}) {
        s.extent_m = {100, bad, 100};
        CHECK(make_cumulus(s, *kernel_table(nullptr), 1, v).code == Code::kBadInput);
        s.extent_m = {100, 100, bad};
        CHECK(make_cumulus(s, *kernel_table(nullptr), 1, v).code == Code::kBadInput);
    }
}

TEST_CASE("noises stay in their ranges and agree at every width") {
    float low = 1, high = -1, sum = 0;
    for (int i = 0; i < 4096; ++i) {
        const float x = float(i) * 0.37f - 700.0f, y = float(i % 64) * 0.91f,
                    z = float(i) * -0.053f;
        const float g = gradient_noise<float>(x, y, z, 5u), b = billow<float>(x, y, z, 5u);
        CHECK((g > -1.5f && g < 1.5f && b >= 0.0f && b <= 1.0f));
        using V = F<8>;
        const V vx = iota<I<8>>() == 3 ? all<V>(x) : all<V>(0.5f);
        CHECK(gradient_noise<V>(vx, all<V>(y), all<V>(z), 5u)[3] == g);
        CHECK(billow<V>(vx, all<V>(y), all<V>(z), 5u)[3] == b);
        low = g < low ? g : low, high = g > high ? g : high, sum += g;
    }
    // Noise that got stuck would fail here: mean 0 within 5 sigma of 4096 samples (sigma ~ 0.2).
    CHECK((low < -0.4f && high > 0.4f && std::fabs(sum / 4096.0f) < 0.02f));
}

TEST_CASE("cumulus: range, empty border, one piece, for several seeds and shapes of box") {
    for (std::int64_t seed : {0, 1, 2, 3, 4, 5, -1}) {
        const Volume v = cumulus({64, 64, 44}, seed);
        float most = 0;
        bool finite = true, border = true;
        for (int z = 0; z < 44; ++z)
            for (int y = 0; y < 64; ++y)
                for (int x = 0; x < 64; ++x) {
                    const float d = at(v, x, y, z);
                    finite = finite && d >= 0.0f && d <= 1.0f;
                    most = d > most ? d : most;
                    const bool rim = x == 0 || y == 0 || z == 0 || x == 63 || y == 63 || z == 43;
                    border = border && (!rim || d == 0.0f);
                }
        CHECK(finite);
        CHECK(border);
        CHECK(most > 0.9f);
        // A few faint single cells may come loose at the rim; debris would be more.
        const Parts p = parts(v);
        CHECK(double(p.largest) > 0.999 * double(p.all));
        CHECK(double(p.all) > 0.08 * double(v.density.size()));
    }
}

TEST_CASE("cumulus: the base is flat and lighter than the top") {
    for (std::int64_t seed : {0, 1, 2, 3}) {
        const Volume v = cumulus({64, 64, 44}, seed);
        double sum = 0, squares = 0, columns = 0, low = 0, high = 0, lows = 0, highs = 0;
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) {
                int first = 0;
                while (first < 44 && at(v, x, y, first) < 0.1f) ++first;
                for (int z = 0; z < 44; ++z) {
                    const double d = double(at(v, x, y, z));
                    if (z < 11 && d > 0.1) low += d, lows += 1;
                    if (z > 30 && d > 0.1) high += d, highs += 1;
                }
                // Leave out columns that only meet an overhang: higher than a quarter of the box.
                if (first > 11) continue;
                sum += first, squares += first * first, columns += 1;
            }
        const double middle = sum / columns,
                     spread = std::sqrt(squares / columns - middle * middle);
        CHECK(columns > 400);
        // Undulation is one percent of the height; the rounded rim adds a cell or two.
        CHECK(spread < 1.5);
        CHECK(low / lows < 0.75 * high / highs);
    }
}

TEST_CASE("cumulus: seeds give different clouds") {
    const Volume a = cumulus({48, 48, 32}, 1), b = cumulus({48, 48, 32}, 2);
    std::size_t either = 0, differ = 0;
    for (std::size_t i = 0; i < a.density.size(); ++i) {
        const bool in_a = a.density[i] > 0, in_b = b.density[i] > 0;
        either += in_a || in_b;
        differ += in_a != in_b || std::fabs(a.density[i] - b.density[i]) > 0.1f;
    }
    CHECK(double(differ) > 0.3 * double(either));
}

TEST_CASE("cumulus: same bits for any number of threads, on any machine") {
    const std::string one = digest(cumulus({48, 48, 32}, 7, 1));
    CHECK(digest(cumulus({48, 48, 32}, 7, 2)) == one);
    CHECK(digest(cumulus({48, 48, 32}, 7, 3)) == one);
    CHECK(digest(cumulus({48, 48, 32}, 7, 0)) == one);
    CHECK(one == "da9daa80743c2d60");
}

TEST_CASE("cumulus: odd and tiny grids and boxes of any proportion work") {
    for (auto n : {std::array<int, 3>{3, 3, 3}, {5, 70, 9}, {33, 17, 50}}) {
        CumulusSettings s;
        s.resolution = n;
        s.extent_m = {3000, 700, 900};
        Volume v;
        REQUIRE(make_cumulus(s, *kernel_table(nullptr), 2, v).code == Code::kOk);
        CHECK(v.size == n);
        for (float d : v.density.span()) REQUIRE((d >= 0.0f && d <= 1.0f));
    }
}

TEST_CASE("cumulus: every instruction set fills the same bits") {
    CumulusSettings settings;
    for (const std::array<int, 3>& size :
         {std::array<int, 3>{3, 3, 3}, {4, 40, 5}, {37, 29, 21}, {64, 65, 66}}) {
        settings.resolution = size;
        std::string first;
        for (int i = 0; kernel_table_at(i) != nullptr; ++i) {
            const KernelTable& table = *kernel_table_at(i);
            Volume volume;
            REQUIRE(make_cumulus(settings, table, 2, volume));
            if (first.empty()) first = digest(volume);
            CAPTURE(table.name);
            CHECK(digest(volume) == first);
        }
        CHECK(!first.empty());
    }
}
