// SPDX-License-Identifier: Apache-2.0
// The sun's optical depth at the edge of what a scene may hold.
// in: dark, empty, thin, flat grids; suns in planes of faces -> out: numbers, none of them missing.
// docs/buffer.md; docs/testing.md
#include "tests/support/sun_depth_harness.h"

using namespace sun_depth_test;

namespace {

void check_numbers(const Rig& rig, const std::array<float, 3>& sun) {
    for (float tau : depths(rig, sun)) {
        CHECK(tau >= 0.0f);
        CHECK(tau <= 1e30f);
    }
}

}  // namespace

TEST_CASE("Darkness beyond floats stays a number") {
    for (double sigma : {1e6, 1e30, 1e38})
        for (const auto& sun :
             {std::array<float, 3>{0.1f, 0.2f, 0.9f}, std::array<float, 3>{1, 1e-3f, -1e-6f}}) {
            Rig rig = random_box({40, 8, 9}, {4e4, 8e3, 9e3}, sigma);
            check_numbers(rig, sun);
            rig.medium.grid.periodic = true;
            if (sun[2] > 0.1f) check_numbers(rig, sun);
        }
}

TEST_CASE("An empty grid has no depth at all") {
    Rig rig = random_box({17, 5, 6}, {17, 5, 6}, 1e6);
    for (float& v : rig.medium.volume.density.span()) v = 0.0f;
    for (const auto& sun :
         {std::array<float, 3>{0.1f, 0.2f, 0.9f}, std::array<float, 3>{-1, 0.5f, 0.1f}})
        for (float tau : depths(rig, sun)) CHECK(tau == 0.0f);
}

TEST_CASE("Grids of one row, one column, one voxel") {
    for (const auto& size : {std::array<int, 3>{1, 1, 1}, std::array<int, 3>{1, 40, 1},
                             std::array<int, 3>{70, 1, 1}, std::array<int, 3>{1, 1, 33},
                             std::array<int, 3>{65, 17, 1}, std::array<int, 3>{1, 17, 9}}) {
        Rig rig = random_box(size, {70, 70, 70}, 0.1);
        for (float& v : rig.medium.volume.density.span()) v = 1.0f;
        for (int axis = 0; axis < 3; ++axis) {
            std::array<float, 3> sun{};
            sun[std::size_t(axis)] = 1;
            const std::vector<float> ours = depths(rig, sun);
            for_nodes(rig.medium.grid, [&](const std::array<int, 3>& at, std::size_t node) {
                CHECK(double(ours[node]) ==
                      doctest::Approx(ray_depth(rig.medium, at, sun)).epsilon(1e-5));
            });
        }
        check_numbers(rig, {0.5f, 0.5f, 0.5f});
        rig.medium.grid.periodic = true;
        check_numbers(rig, {0.5f, -0.5f, 0.5f});
    }
}

TEST_CASE("A sun in the plane of a face, and just beside it") {
    Rig rig = random_box({24, 20, 18}, {24, 20, 18}, 0.3);
    const std::vector<float> in = depths(rig, {0.8f, 0.6f, 0.0f});
    const std::vector<float> minus = depths(rig, {0.8f, 0.6f, -0.0f});
    CHECK(in == minus);
    const std::vector<float> beside = depths(rig, {0.8f, 0.6f, 1e-7f});
    for (std::size_t i = 0; i < in.size(); ++i)
        CHECK(beside[i] == doctest::Approx(in[i]).epsilon(1e-4));
}

TEST_CASE("Voxels a thousand times as long as high") {
    Rig rig = random_box({20, 20, 40}, {20000, 20000, 40}, 0.01);
    for (float& v : rig.medium.volume.density.span()) v = 1.0f;
    // Almost level: still z that slices follow one another along.
    for (const auto& sun :
         {std::array<float, 3>{1, 0.2f, 0.01f}, std::array<float, 3>{0.1f, 0.2f, 1}}) {
        CHECK(slice_axis(rig.medium.grid, sun) == 2);
        const std::vector<float> ours = depths(rig, sun);
        int checked = 0;
        for_nodes(rig.medium.grid, [&](const std::array<int, 3>& at, std::size_t node) {
            if (!knows_no_side(rig.medium.grid, at, sun)) return;
            ++checked;
            CHECK(double(ours[node]) ==
                  doctest::Approx(ray_depth(rig.medium, at, sun)).epsilon(1e-5));
        });
        CHECK(checked > 1000);
    }
}

TEST_CASE("A level sun over a periodic layer gets rays") {
    Rig rig = random_box({6, 6, 4}, {6, 6, 4}, 0.1);
    rig.medium.grid.periodic = true;
    Report report;
    Majorants majorants;
    bound(rig, majorants);
    SunDepth depth;
    for (float up : {0.0f, 1e-4f}) {
        REQUIRE(make_sun_depth(context_of(kernel_table(nullptr), 1, report), rig.medium, majorants,
                               {1, 0, up}, SunDepthKind::kSwept, depth));
        CHECK(!depth.swept);
        for (float tau : depth.optical_depth.span()) CHECK(tau >= 0.0f);
    }
}
