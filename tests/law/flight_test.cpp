// SPDX-License-Identifier: Apache-2.0
// Flights along the axes: from faces of voxels, blocks and the grid, with zeros of either sign.
// in: small grids of blocks -> out: every block on the way holds the place, and the way ends.
// docs/path.md, "Flight"
#include "kernels_cpu/media/flight.h"

#include <doctest/doctest.h>

#include <limits>

#include "src/methods/path/path_blocks.h"

namespace {

using namespace pileus;

constexpr float kBlock = 4;

/// 11 x 8 x 14 voxels of even density, or with empty blocks that are leapt over.
struct Field {
    Buffer<float> blocks;
    TrackGrid grid{};

    Field(bool periodic, bool sparse) {
        const std::int32_t counts[3] = {3, 2, 4}, size[3] = {11, 8, 14};
        Buffer<float> majorants;
        REQUIRE(majorants.resize(24, "test"));
        for (std::size_t i = 0; i < majorants.size(); ++i)
            majorants[i] = sparse && i % 8 != 3 ? 0.0f : 1.0f;
        REQUIRE(path_blocks(majorants.span(), counts, 1, blocks));
        const float cell[3] = {20, 35, 10};
        for (int a = 0; a < 3; ++a) {
            grid.size[a] = size[a];
            grid.cell[a] = cell[a];
            grid.blocks[a] = counts[a];
        }
        grid.block = kBlock;
        grid.sigma = 1e-6f;
        grid.periodic = periodic ? 1 : 0;
        grid.majorant = blocks.data();
    }

    /// Whether the block of the grid with its ring holds `p` along an axis.
    bool holds(std::int32_t block, int axis, float p) const {
        const std::int32_t nx = grid.blocks[0] + 2, ny = grid.blocks[1] + 2;
        const std::int32_t i[3] = {block % nx - 1, block / nx % ny - 1, block / (nx * ny) - 1};
        return p >= float(i[axis]) * kBlock && p <= float(i[axis] + 1) * kBlock;
    }
};

/// Steps until the way is out; `most` where it has not ended by then.
int fly(const Field& f, const Vec<float>& from, const Vec<float>& d, int axis, int most) {
    Flight<1> s{};
    s.cut = 3e38f;
    s.tau = std::numeric_limits<float>::max();
    aim_flight<1>(s, f.grid, true, d);
    begin_flight<1>(s, f.grid, true, from);
    for (int step = 0; step < most; ++step) {
        if (s.bound >= 0.0f) {
            const Vec<float> p = place_of<1>(s);
            const float at[3] = {p.x, p.y, p.z};
            // Along its own axis a place is as exact as rounding leaves it.
            for (int a = 0; a < 3; ++a)
                if (a != axis && !f.holds(s.block, a, at[a])) FAIL("a bound of another block");
        }
        const Step<1> m = step_flight<1>(s, f.grid, true);
        CHECK_FALSE(m.lost);
        if (m.out) return step + 1;
    }
    return most;
}

/// Calls use(place, direction, axis) for all places on faces and ways along axes.
template <class Use>
void for_axes(const Field& f, Use use) {
    const auto place = [&](int axis, int i) {
        const float n = float(f.grid.size[axis]);
        return i == 0 ? 0.0f : i == 1 ? kBlock : i == 2 ? 2.5f : i == 3 ? n - 1 : n;
    };
    for (int axis = 0; axis < 3; ++axis)
        for (int signs = 0; signs < 8; ++signs) {
            float d[3];
            for (int a = 0; a < 3; ++a) {
                const float sign = (signs >> a & 1) != 0 ? -1.0f : 1.0f;
                d[a] = a == axis ? sign : sign * 0.0f;
            }
            for (int i = 0; i < 125; ++i)
                use(Vec<float>{place(0, i % 5), place(1, i / 5 % 5), place(2, i / 25)},
                    Vec<float>{d[0], d[1], d[2]}, axis);
        }
}

}  // namespace

TEST_CASE("a flight along an axis keeps to its row of blocks, and ends") {
    for (bool sparse : {false, true}) {
        const Field f(false, sparse);
        for_axes(f, [&](const Vec<float>& from, const Vec<float>& d, int axis) {
            // Its own blocks, and one more where it begins on a face.
            CHECK(fly(f, from, d, axis, 100) <= f.grid.blocks[axis] + 3);
        });
    }
}

TEST_CASE("a vertical flight through a periodic grid does not know its sides") {
    for (bool sparse : {false, true}) {
        const Field f(true, sparse);
        for_axes(f, [&](const Vec<float>& from, const Vec<float>& d, int axis) {
            if (axis == 2) CHECK(fly(f, from, d, axis, 100) <= f.grid.blocks[2] + 5);
        });
    }
}

TEST_CASE("a level flight through a periodic grid leaves it after as many periods as it can") {
    const Field f(true, true);
    const int most = 40 * most_wraps(f.grid);
    for (float sign : {1.0f, -1.0f}) {
        CHECK(fly(f, {0, 0, 7}, {sign, -0.0f, -0.0f}, 0, most) < most);
        CHECK(fly(f, {11, 8, 7}, {-0.0f, sign, 0.0f}, 1, most) < most);
    }
}

TEST_CASE("a flight that wraps without end is given up, and one without numbers ends") {
    const Field f(true, false);
    Flight<1> s{};
    s.cut = 3e38f;
    s.tau = std::numeric_limits<float>::max();
    aim_flight<1>(s, f.grid, true, {1, 0, 0});
    begin_flight<1>(s, f.grid, true, {5, 4, 7});
    s.wraps = most_wraps(f.grid);
    bool lost = false, out = false;
    for (int step = 0; step < 20 && !out; ++step) {
        const Step<1> m = step_flight<1>(s, f.grid, true);
        lost = m.lost, out = m.out;
    }
    CHECK(lost);
    CHECK(out);
    const Field open(false, false);
    const float none = std::numeric_limits<float>::quiet_NaN();
    aim_flight<1>(s, open.grid, true, {none, none, none});
    begin_flight<1>(s, open.grid, true, {5, 4, 7});
    out = false;
    for (int step = 0; step < 20 && !out; ++step) out = step_flight<1>(s, open.grid, true).out;
    CHECK(out);
}
