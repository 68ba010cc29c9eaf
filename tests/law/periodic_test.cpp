// SPDX-License-Identifier: Apache-2.0
// Periodic media in every stage: what is read beyond a face is the other side.
// in: small fields, and the same fields laid side by side -> out: equal depths, bounds, masses.
// docs/methods.md 2, "Periodic media".
#include "kernels_cpu/display/march.h"
#include "kernels_cpu/media/walk.h"
#include "src/methods/collectors/photons/source_grid.h"
#include "src/world/grid/grid.h"
#include "tests/support/render_harness.h"
#include "tests/support/trace_harness.h"

using namespace trace_test;

namespace {

constexpr int kX = 9, kY = 6, kZ = 5;  // voxels; blocks of 4 end within a period

float density_of(int x, int y, int z) {
    const auto w = threefry(3u, 4u, std::uint32_t(x % kX + 100 * (y % kY)), std::uint32_t(z));
    return w.a % 5 < 2 ? 0.0f : uniform(w.b);
}

/// The field once, periodic, or `copies` times along x and y, open.
struct Field {
    Grid grid{};
    Buffer<float> density, majorants;
    MediumView view{};

    Field(bool periodic, int copies, int block) {
        const int n[3] = {kX * copies, kY * copies, kZ};
        const float cell[3] = {2, 3, 4};
        for (int a = 0; a < 3; ++a) {
            grid.size[a] = view.size[a] = n[a];
            grid.cell_m[a] = view.cell[a] = cell[a];
            view.extent[a] = cell[a] * float(n[a]);
        }
        grid.periodic = periodic;
        view.periodic = periodic ? 1 : 0;
        view.sigma = 0.1f;
        view.step = 0.25f;
        REQUIRE(density.resize(voxel_count(grid), "density"));
        for (int z = 0; z < n[2]; ++z)
            for (int y = 0; y < n[1]; ++y)
                for (int x = 0; x < n[0]; ++x)
                    density[voxel_index(grid, x, y, z)] = density_of(x, y, z);
        REQUIRE(majorant_grid(density.span(), grid, block, 1, majorants));
        block_counts(grid, block, view.blocks);
        view.block = float(block);
        view.density = density.data();
        view.majorant = majorants.data();
    }
    float depth(const Vec<float>& o, const Vec<float>& d) const {
        return optical_depth(view, Ray<float>{o, d}, I_of<float>(1) == 1);
    }
};

}  // namespace

TEST_CASE("a ray's depth through a periodic field is that through its copies side by side") {
    constexpr int kCopies = 9;
    const Field tiled(false, kCopies, 4);
    for (int block : {1, 4, 16}) {
        const Field field(true, 1, block);
        double worst = 0, least = 1e9;
        for (std::uint32_t i = 0; i < 200; ++i) {
            // From above, from below and from within the middle copy, three periods at the most.
            const auto a = threefry(7u, 8u, i, 0u), b = threefry(7u, 8u, i, 1u);
            const float turn = uniform(a.a), slope = 0.35f + 0.6f * uniform(a.b);
            const SinCos<float> phi = sincos_turns(turn);
            const float side = sqrt_(1 - slope * slope);
            const Vec<float> d{side * phi.cosine, side * phi.sine, i % 2 ? slope : -slope};
            const float z = i % 3 == 0 ? 9.0f : (i % 2 ? -3.0f : 26.0f);
            const Vec<float> o{uniform(b.a) * 18.0f, uniform(b.b) * 18.0f, z};
            const Vec<float> middle{o.x + 4 * 18, o.y + 4 * 18, o.z};
            const double expected = double(tiled.depth(middle, d));
            worst = std::max(worst, std::fabs(double(field.depth(o, d)) - expected));
            // The camera may stand any number of periods away.
            worst = std::max(worst, std::fabs(double(field.depth(middle, d)) - expected));
            least = std::min(least, expected);
        }
        std::printf("periodic against copies, blocks of %d: worst %.2g of %.2g and more\n", block,
                    worst, least);
        // Voxel positions of 80 carry an error of 2^-18, a hundred samples of slope 1 at the most.
        CHECK(worst < 2e-5);
        CHECK(least > 0.1);
    }
}

TEST_CASE("a level ray through a periodic field ends") {
    Field field(true, 1, 4);
    CHECK(field.depth({1, 1, 10}, {1, 0, 0}) * 1.0f > 60);
    // Beyond the box, or where nothing is, there is nothing to meet.
    CHECK(field.depth({1, 1, 21}, {1, 0, 0}) == 0);
    for (float& v : field.density.span()) v = 0;
    REQUIRE(majorant_grid(field.density.span(), field.grid, 4, 1, field.majorants));
    field.view.majorant = field.majorants.data();  // they have moved
    CHECK(field.depth({1, 1, 10}, {0.6f, 0.8f, 0}) == 0);
}

TEST_CASE("periodic majorants bound what is read, and no more than its copies' do") {
    const Field tiled(false, 3, 3);
    for (int block : {1, 3}) {
        const Field field(true, 1, block);
        const Field around(false, 3, block);
        for (int z = 0; z < field.view.blocks[2]; ++z)
            for (int y = 0; y < field.view.blocks[1]; ++y)
                for (int x = 0; x < field.view.blocks[0]; ++x) {
                    const auto at = [&](const Field& f, int i, int j) {
                        return f.majorants[std::size_t(
                            (z * f.view.blocks[1] + j) * f.view.blocks[0] + i)];
                    };
                    // Both sizes are whole blocks: the middle copy's blocks are the period's.
                    CHECK(at(field, x, y) == at(around, x + kX / block, y + kY / block));
                }
    }
}

TEST_CASE("voxel masses of a periodic field are those of its middle copy, and keep its sum") {
    const Field field(true, 1, 1), around(false, 3, 1);
    Buffer<double> own, all;
    REQUIRE(own.resize(voxel_count(field.grid), "masses"));
    REQUIRE(all.resize(voxel_count(around.grid), "masses"));
    voxel_masses(field.density.span(), field.grid, 1, own.span());
    voxel_masses(around.density.span(), around.grid, 1, all.span());
    for (int z = 0; z < kZ; ++z)
        for (int y = 0; y < kY; ++y)
            for (int x = 0; x < kX; ++x)
                CHECK(own[voxel_index(field.grid, x, y, z)] ==
                      all[voxel_index(around.grid, x + kX, y + kY, z)]);
    for (float x : {0.1f, 0.49f, 8.51f, 8.99f}) {
        const float here[3] = {x, 5.8f, 2.2f}, there[3] = {x + kX, 5.8f + kY, 2.2f};
        CHECK(density_at(field.density.span(), field.grid, here) ==
              doctest::Approx(density_at(around.density.span(), around.grid, there)).epsilon(1e-5));
    }
}

TEST_CASE("one-voxel look-ups of a periodic field have the trilinear mean") {
    const Field field(true, 1, 1);
    TrackGrid k{};
    for (int a = 0; a < 3; ++a) k.size[a] = field.grid.size[a];
    k.periodic = 1;
    for (const Vec<float>& p : {Vec<float>{0.1f, 3.3f, 2.2f}, Vec<float>{8.9f, 5.9f, 0.2f},
                                Vec<float>{4.4f, 0, 4.9f}, Vec<float>{9, 6, 1}}) {
        const double expected =
            double(interpolate(field.view.density, corners(p, field.view.size, true)));
        check_mean(
            "periodic look-up at x " + std::to_string(p.x).substr(0, 3), expected,
            [&](int multiple, std::uint64_t seed) {
                const int n = 400000 * multiple;
                double sum = 0, square = 0;
                for (int i = 0; i < n; ++i) {
                    const auto w = threefry(std::uint32_t(seed), 5u, std::uint32_t(i), 0u);
                    const double v = double(field.density[std::size_t(corner_voxel(p, w.a, k))]);
                    sum += v;
                    square += v * v;
                }
                const double mean = sum / n;
                return Mean{mean,
                            std::sqrt(std::max(square / n - mean * mean, 0.0) / (n - 1)) + 1e-9};
            });
    }
}

TEST_CASE("splatting over a period's faces repeats what lies on the other side") {
    // One collector at a corner of the period lights the nodes at all four corners alike.
    Collector ball{};
    ball.centre[2] = 8;
    ball.radius = 3;
    ball.mass = 1;
    Buffer<float> source;
    const float colour = 2;
    NodeGrid nodes{{8, 8, 8}, {0.5f, 0.5f, 0.5f}};
    SplatOptions options;
    options.periodic = true;
    options.prior_mass = 0.1f;
    REQUIRE(splat_colours({&ball, 1}, {&colour, 1}, 1, nodes, options, 1, source));
    const auto at = [&](int x, int y, int z) {
        return source[2 * std::size_t((z * 8 + y) * 8 + x)];
    };
    for (int z = 0; z < 8; ++z)
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j) {
                CHECK(at(i, j, z) == doctest::Approx(at(7 - i, j, z)).epsilon(1e-6));
                CHECK(at(i, j, z) == doctest::Approx(at(i, 7 - j, z)).epsilon(1e-6));
            }
    CHECK(at(0, 0, 4) > 1.0f);
}

namespace {

const char* const kPeriodicText = R"(
seed = 4
[camera]
position_m = [16, -300, 1400]
target_m = [0, 0, 1024]
fov_deg = 50
resolution = [32, 18]
[sun]
azimuth_deg = 120
elevation_deg = 35
[sky]
radiance = [0.0625, 0.125, 0.25]
[ground]
altitude_m = 0
albedo = 0.25
[[medium]]
density = "procedural:cumulus"
bounds_m = [[-512, -512, 512], [512, 512, 1280]]
resolution = [24, 24, 16]
extinction_per_m = 0.03125
albedo = [0.9, 0.99, 1.0]
phase = { type = "henyey-greenstein", g = 0.85 }
boundary = "periodic"
[collectors]
photons = 12_000
generations = 4
samples = 1_000
[output]
layers = ["radiance", "alpha", "depth", "error"]
)";

double mean_difference(const render_test::Picture& a, const render_test::Picture& b) {
    double sum = 0;
    for (int y = 0; y < a.image.height; ++y)
        for (int x = 0; x < a.image.width; ++x)
            for (const char* c : {"R", "A"})
                sum += std::fabs(double(a.at(c, x, y)) - double(b.at(c, x, y)));
    return sum / (2 * a.image.width * a.image.height);
}

}  // namespace

TEST_CASE("a camera moved by whole periods sees the same picture") {
    using namespace render_test;
    const Picture here = render_one(scene_from(kPeriodicText));
    const Picture there =
        render_one(scene_from(kPeriodicText, {"camera.position_m=[-2032,1748,1400]",
                                              "camera.target_m=[-2048,2048,1024]"}));
    const Picture turned =
        render_one(scene_from(kPeriodicText, {"camera.position_m=[20,-290,1400]"}));
    // Rounding of positions a period away moves samples by 2^-13 m, past thin edges of cloud.
    CHECK(mean_difference(here, there) < 1e-4);
    CHECK(mean_difference(here, turned) > 1e-3);
    // Nothing but what enters at top and bottom leaves there.
    for (const EnergyRow& row : here.report.photons.energy) CHECK(row.sides == 0);
}

TEST_CASE("harmonics of the collectors give the colours towards a camera") {
    // Parallel rays have one direction for all collectors: both displays must show one picture.
    using namespace render_test;
    const std::string photons = "collectors.photons=80000";
    const std::string narrow = "camera.fov_deg=0.05", far = "camera.position_m=[0,-300000,300000]";
    const Picture perspective =
        render_one(scene_from(kPeriodicText, {narrow, far, photons, "camera.target_m=[0,0,1024]"}));
    const std::string no_fov =
        std::string(kPeriodicText)
            .replace(std::string(kPeriodicText).find("fov_deg = 50"), 12, "height_m = 370");
    const Picture parallel =
        render_one(scene_from(no_fov, {"camera.projection=orthographic", far, photons,
                                       "camera.target_m=[0,0,1024]", "collectors.axis_degrees=0"}));
    double a = 0, b = 0;
    for (int y = 0; y < 18; ++y)
        for (int x = 0; x < 32; ++x) {
            a += double(perspective.at("R", x, y));
            b += double(parallel.at("R", x, y));
        }
    // The nodes of harmonics are coarser, and clamped colours are not taken out of them: by six
    // seeds 0.3 % with 80 000 photons, 0.05 % with four times as many, 2 to 4 % with 12 000.
    CHECK(a == doctest::Approx(b).epsilon(0.01));
}

TEST_CASE("media of other periods, and displays of one camera, are refused in a line") {
    using namespace render_test;
    const auto line_of = [](const std::vector<std::string>& overrides) {
        Scene scene;
        const Status read = read_scene_text(kPeriodicText, "test.toml", "", overrides, scene);
        if (!read) return read.message;
        Report report;
        return plan_scene(scene, {}, false, report).message;
    };
    CHECK(line_of({}).empty());
    CHECK(line_of({"collectors.display=billboards"}).find("not for periodic media") !=
          std::string::npos);
    CHECK(line_of({"collectors.closure=lobe"}).find("not for periodic media") != std::string::npos);
    const std::string more =
        std::string(kPeriodicText) +
        "[[medium]]\ndensity = \"uniform:box\"\nbounds_m = [[-512, -512, 0], [512, 512, 512]]\n"
        "extinction_per_m = 1e-3\nphase = { type = \"rayleigh\" }\n";
    const auto second = [&](const std::string& rest, const std::vector<std::string>& overrides) {
        Scene scene;
        REQUIRE(read_scene_text(more + rest, "test.toml", "", overrides, scene));
        Report report;
        return plan_scene(scene, {}, false, report).message;
    };
    CHECK(second("boundary = \"periodic\"\n", {}).empty());
    CHECK(second("", {}).find("medium.1.boundary: differs, \"open\"") != std::string::npos);
    CHECK(second("boundary = \"periodic\"\n", {"medium.1.bounds_m=[[-512,-500,0],[512,512,512]]"})
              .find("another period along y, -500 to 512") != std::string::npos);
}
