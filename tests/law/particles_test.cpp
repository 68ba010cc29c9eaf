// SPDX-License-Identifier: Apache-2.0
// Particles by themselves: the octree, walks through it, light and pictures.
// in: made-up particles -> out: depths against sums over all, pictures against closed forms and
// path. docs/particles.md, "The method"; docs/testing.md, label law
#include <algorithm>
#include <cmath>
#include <cstring>

#include "src/io/particles/placed_particles.h"
#include "src/methods/particles/sun_tiles.h"
#include "src/world/particles/particle_tree.h"
#include "tests/io/temp_folder.h"
#include "tests/support/particle_harness.h"
#include "tests/support/render_harness.h"
#include "tests/support/sun_depth_harness.h"

using namespace pileus;
using namespace render_test;
using namespace particle_test;

namespace {

/// Particles in a cube of 100 m, radii over a decade; `turn` begins with another one.
void make(std::uint32_t count, std::uint32_t turn, ParticleSet& set) {
    std::string text = "x y z radius density\n";
    for (std::uint32_t n = 0; n < count; ++n) {
        const std::uint32_t i = (n + turn) % count;
        char row[160];
        (void)std::snprintf(row, sizeof row, "%.9g %.9g %.9g %.9g %.9g\n", 100 * draw(i, 0),
                            100 * draw(i, 1), 100 * draw(i, 2), 1 + 9 * draw(i, 3),
                            0.2 * draw(i, 4));
        text += row;
    }
    REQUIRE(decode_particles("p", ".csv", {text.data(), text.size()}, {}, set));
    REQUIRE(place_particles("p", {}, set));
}

/// From a place on along a direction to the end, over all balls.
double depth_of(const ParticleTree& tree, const float* from, const float* d) {
    double sum = 0, length = 0;
    for (int a = 0; a < 3; ++a) length += double(d[a]) * double(d[a]);
    length = std::sqrt(length);
    for (const ParticleBall& ball : tree.balls.span()) {
        double along = 0, square = 0;
        for (int a = 0; a < 3; ++a) {
            const double p = double(ball.centre[a]) - double(from[a]);
            along += p * double(d[a]) / length;
            square += p * p;
        }
        const double k = double(ball.per_radius);
        const double inner = 1 - (square - along * along) * k * k;
        if (inner <= 0) continue;
        const double end = std::sqrt(inner), begin = std::max(-along * k, -end);
        if (begin < end) sum += double(ball.depth) * integral(inner, begin, end);
    }
    return sum;
}

std::vector<float> depths_by(const KernelTable& table, int threads, const ParticleTree& tree,
                             const std::array<float, 3>& direction,
                             const std::array<float, 3>& offset, float most) {
    Report report;
    const Context context = sun_depth_test::context_of(&table, threads, report);
    std::vector<float> out(tree.balls.size());
    SunTiles tiles;
    REQUIRE(make_sun_tiles(context, tree, tree.balls.span(), direction, tiles));
    REQUIRE(sun_depths(context, tiles, offset, most, out.data()));
    return out;
}

/// Of (depth - sum over all) / sum, the worst.
double worst_of(const std::vector<float>& depths, const ParticleTree& tree,
                const std::array<float, 3>& direction, const std::array<float, 3>& offset) {
    double worst = 0;
    for (std::size_t i = 0; i < depths.size(); ++i) {
        const ParticleBall& b = tree.balls[i];
        float from[3];
        for (std::size_t a = 0; a < 3; ++a) from[a] = b.centre[a] + offset[a] * (1 / b.per_radius);
        const double exact = depth_of(tree, from, direction.data());
        worst = std::max(worst, std::fabs(double(depths[i]) - exact) / exact);
    }
    return worst;
}

double sum_of(const Image& image, const char* channel) {
    double sum = 0;
    for (const float v : image.find(channel)->pixels.span()) sum += double(v);
    return sum;
}

}  // namespace

TEST_CASE("particles: the octree holds every ball once, in boxes that hold them whole") {
    ParticleSet set, other;
    make(3000, 0, set);
    make(3000, 777, other);
    ParticleTree tree, again;
    REQUIRE(make_particle_tree(set, set.low, 8, 2, tree));
    REQUIRE(make_particle_tree(other, other.low, 8, 1, again));
    REQUIRE(tree.balls.size() == 3000);
    CHECK(std::memcmp(tree.balls.data(), again.balls.data(), tree.balls.bytes()) == 0);
    CHECK(std::memcmp(tree.nodes.data(), again.nodes.data(), tree.nodes.bytes()) == 0);
    std::int32_t next = 0;
    std::size_t outside = 0, large = 0;
    for (std::int32_t at = 0; at < tree.count(); ++at) {
        const ParticleNode& n = tree.nodes[std::size_t(at)];
        const std::int32_t end = tree.nodes[std::size_t(n.skip)].first;
        for (std::int32_t i = n.first; i < end; ++i)
            for (int a = 0; a < 3; ++a) {
                const ParticleBall& b = tree.balls[std::size_t(i)];
                const float radius = 1 / b.per_radius;
                outside += b.centre[a] - radius < n.low[a] || b.centre[a] + radius > n.high[a];
            }
        if (n.skip != at + 1) continue;
        CHECK(n.first == next);
        next = end;
        large += end - n.first > 8;
    }
    CHECK(next == 3000);
    CHECK(outside == 0);
    CHECK(large == 0);
}

TEST_CASE("particles: a million alike in one place are one, none are no tree") {
    ParticleSet set;
    set.count = 1000000;
    REQUIRE(set.position.resize(3 * set.count, "p"));
    REQUIRE(set.radius.resize(set.count, "p"));
    REQUIRE(set.density.resize(set.count, "p"));
    for (std::size_t i = 0; i < set.count; ++i) set.radius[i] = 1, set.density[i] = 1;
    set.low = {-1, -1, -1};
    set.high = {1, 1, 1};
    ParticleTree tree;
    REQUIRE(make_particle_tree(set, set.low, 8, 2, tree));
    CHECK(tree.leaves == 1);
    CHECK(tree.count() == 1);
    REQUIRE(tree.balls.size() == 1);
    CHECK(tree.balls[0].depth == 1e6f);
    // With radii of their own they are one leaf.
    for (std::size_t i = 0; i < set.count; ++i) set.radius[i] = 1 + float(i) * 0x1p-23f;
    REQUIRE(make_particle_tree(set, set.low, 8, 2, tree));
    CHECK(tree.leaves == 1);
    CHECK(tree.balls.size() == set.count);
    // Two of three differ in their way alone: they stay apart.
    set.count = 3;
    set.radius[1] = set.radius[2] = set.radius[0];
    REQUIRE(set.velocity.resize(9, "p"));
    for (std::size_t i = 0; i < 9; ++i) set.velocity[i] = i < 6 ? 1.0f : 2.0f;
    REQUIRE(make_particle_tree(set, set.low, 8, 2, tree));
    REQUIRE(tree.balls.size() == 2);
    CHECK(tree.balls[0].depth == 2);
    CHECK(tree.velocity[5] == 2);
    REQUIRE(make_particle_tree({}, {}, 8, 2, tree));
    CHECK(tree.count() == 0);
}

TEST_CASE("particles: depths by tiles are the sums over all, in every width and thread") {
    ParticleSet set;
    make(2000, 0, set);
    ParticleTree tree;
    REQUIRE(make_particle_tree(set, set.low, 12, 2, tree));
    const std::array<float, 3> offset = {0, 0.25f, 0.5f};
    for (const std::array<float, 3> d : {std::array<float, 3>{0, 0, 1},
                                         {0, 0, -1},
                                         {1, 0, 0},
                                         {0, -1, 0},
                                         {0.6f, 0, 0.8f},
                                         {0.36f, -0.48f, 0.8f},
                                         {1e-7f, 0, 1}}) {
        const std::vector<float> one = depths_by(*kernel_table_at(0), 1, tree, d, offset, 3e38f);
        CHECK(worst_of(one, tree, d, offset) < 1e-5);
        for (int t = 0; const KernelTable* table = kernel_table_at(t); ++t)
            for (const int threads : {1, 3})
                CHECK(depths_by(*table, threads, tree, d, offset, 3e38f) == one);
        // What is deeper than the bound is the bound.
        for (int t = 0; const KernelTable* table = kernel_table_at(t); ++t) {
            const std::vector<float> bound = depths_by(*table, 2, tree, d, offset, 0.5f);
            std::size_t wrong = 0;
            for (std::size_t i = 0; i < one.size(); ++i)
                wrong += bound[i] != std::min(one[i], 0.5f);
            CHECK(wrong == 0);
        }
    }
}

TEST_CASE("particles: a share that casts shadows keeps the mean depth, whatever the file's order") {
    ParticleSet set, turned;
    make(4000, 0, set);
    make(4000, 777, turned);
    ParticleTree tree, other;
    REQUIRE(make_particle_tree(set, set.low, 12, 2, tree));
    REQUIRE(make_particle_tree(turned, turned.low, 12, 2, other));
    Buffer<ParticleBall> chosen, again;
    REQUIRE(choose_occluders(tree, 0.25, chosen));
    REQUIRE(choose_occluders(other, 0.25, again));
    REQUIRE(chosen.size() == again.size());
    CHECK(std::memcmp(chosen.data(), again.data(), chosen.size() * sizeof chosen[0]) == 0);
    // 1000 are expected, with a standard deviation of 27.
    CHECK(std::fabs(double(chosen.size()) - 1000) < 4 * 27);
    Report report;
    const Context context = sun_depth_test::context_of(kernel_table_at(0), 2, report);
    double sum[2] = {0, 0};
    for (const bool all : {false, true}) {
        SunTiles tiles;
        const Span<const ParticleBall> casts = all ? Span<const ParticleBall>(tree.balls.span())
                                                   : Span<const ParticleBall>(chosen.span());
        REQUIRE(make_sun_tiles(context, tree, casts, {0.6f, 0, 0.8f}, tiles));
        std::vector<float> depth(tree.balls.size());
        REQUIRE(sun_depths(context, tiles, {0, 0, 0}, 3e38f, depth.data()));
        for (const float v : depth) sum[all ? 1 : 0] += double(v);
    }
    // Depth goes with radius^3 density of those chosen: 1.6 % of it is one standard deviation of
    // the number, 5 % with its spread.
    CHECK(std::fabs(sum[0] / sum[1] - 1) < 0.15);
    // None: no shadow, no fault.
    REQUIRE(choose_occluders(tree, 1e-9, chosen));
    SunTiles none;
    REQUIRE(make_sun_tiles(context, tree, chosen.span(), {0, 0, 1}, none));
    std::vector<float> depth(tree.balls.size(), 1.0f);
    REQUIRE(sun_depths(context, none, {0, 0, 0}, 3e38f, depth.data()));
    CHECK(*std::max_element(depth.begin(), depth.end()) == 0);
}

TEST_CASE("particles: those with numbers that cast shadows stay the same while all move") {
    std::vector<std::uint64_t> before;
    for (const float shift : {0.0f, 0.37f}) {
        ParticleSet set;
        make(1000, 0, set);
        REQUIRE(set.id.resize(set.count, "numbers"));
        for (std::size_t i = 0; i < set.count; ++i) {
            set.id[i] = 5 * i;
            set.position[3 * i] += shift * float(i % 7);
        }
        ParticleTree tree;
        REQUIRE(make_particle_tree(set, set.low, 12, 2, tree));
        Buffer<ParticleBall> chosen;
        REQUIRE(choose_occluders(tree, 0.25, chosen));
        std::vector<std::uint64_t> ids;
        // Balls keep their order, and those chosen are told by their places.
        for (std::size_t i = 0, c = 0; i < tree.balls.size() && c < chosen.size(); ++i)
            if (std::memcmp(chosen[c].centre, tree.balls[i].centre, sizeof chosen[c].centre) == 0)
                ids.push_back(tree.id[i]), ++c;
        CHECK(ids.size() == chosen.size());
        std::sort(ids.begin(), ids.end());
        CHECK((before.empty() || ids == before));
        before = ids;
    }
    // 250 are expected, with a standard deviation of 14.
    CHECK(std::fabs(double(before.size()) - 250) < 4 * 14);
}

TEST_CASE("particles: depths by tiles where some balls hold all, and where all lie in one place") {
    // Radii over three decades, so that a few balls touch every tile.
    ParticleSet set;
    make(3000, 0, set);
    for (std::size_t i = 0; i < set.count; ++i)
        set.radius[i] = i % 100 == 0 ? 200.0f : 0.2f + 0.1f * float(i % 7);
    ParticleTree tree;
    for (int a = 0; a < 3; ++a) set.low[a] -= 300, set.high[a] += 300;
    REQUIRE(make_particle_tree(set, set.low, 12, 2, tree));
    const std::array<float, 3> d = {0.48f, 0.6f, 0.64f}, none{};
    CHECK(worst_of(depths_by(*kernel_table_at(0), 2, tree, d, none, 3e38f), tree, d, none) < 1e-5);
    // More than are at hand at once; the closed form of the sum: 8/15 of each.
    const std::size_t many = 20000;
    ParticleSet same;
    same.count = many;
    REQUIRE(same.position.resize(3 * many, "p"));
    REQUIRE(same.radius.resize(many, "p"));
    REQUIRE(same.density.resize(many, "p"));
    for (std::size_t i = 0; i < many; ++i) same.density[i] = 0.5f;
    double radii = 0;
    for (std::size_t i = 0; i < many; ++i)
        radii += double(same.radius[i] = 2 + float(i) * 0x1p-20f);
    same.low = {-2, -2, -2};
    same.high = {2, 2, 2};
    REQUIRE(make_particle_tree(same, same.low, 12, 2, tree));
    const std::vector<float> depths = depths_by(*kernel_table_at(0), 2, tree, d, none, 3e38f);
    std::size_t wrong = 0;
    // Twenty thousand roundings of a float that grows.
    for (const float depth : depths)
        wrong += std::fabs(double(depth) / (8.0 / 15 * 0.5 * radii) - 1) > 1e-3;
    CHECK(wrong == 0);
}

TEST_CASE("particles: a ray through a ball sees 16/15 of its depth, and no more behind it") {
    const Field field("0 0 50 40 0.01\n");
    const std::vector<std::string> straight = {"camera.resolution = [1, 1]"};
    for (const char* light : {"centre", "linear", "exact"})
        for (const int bins : {1, 2, 256}) {
            CAPTURE(light);
            CAPTURE(bins);
            const Picture p = field.render({"camera.resolution = [1, 1]",
                                            "particles.light = \"" + std::string(light) + "\"",
                                            "particles.bins = " + std::to_string(bins)});
            const double tau = 16.0 / 15 * 0.4;
            // Rounding of the sum of bins.
            CHECK(double(p.image.find("tau")->pixels[0]) == doctest::Approx(tau).epsilon(1e-5));
            CHECK(double(p.image.find("A")->pixels[0]) ==
                  doctest::Approx(1 - std::exp(-tau)).epsilon(1e-5));
        }
    // From the middle of the ball: half of it.
    const Picture inside =
        field.render({"camera.resolution = [1, 1]", "camera.position_m = [0, 0, 50]",
                      "camera.target_m = [0, 1, 50]"});
    CHECK(double(inside.image.find("tau")->pixels[0]) ==
          doctest::Approx(8.0 / 15 * 0.4).epsilon(1e-5));
}

TEST_CASE("particles: light scattered once is path's, in a ball as large as its grid is fine") {
    // Of the grid remains its cell mean: (cell / radius)^2 / 4 = 1.5e-4.
    const Field field("0 0 50 40 0.03\n-20 10 60 25 0.05\n");
    const Picture path = field.render({"method.name = \"path\"", "path.max_depth = 1",
                                       "path.samples_per_pixel = 2048", "path.pixel = \"centre\"",
                                       "medium.0.resolution = [80, 80, 80]",
                                       "output.layers = [\"radiance\", \"alpha\", \"error\"]"});
    double square = 0;
    for (const float v : path.image.find("error.G")->pixels.span()) square += double(v) * double(v);
    const double sum = sum_of(path.image, "G"), noise = std::sqrt(square) / sum;
    CHECK(noise < 0.005);
    const Picture exact = field.render({});
    MESSAGE("over path: exact ", sum_of(exact.image, "G") / sum - 1, ", noise ", noise);
    CHECK(std::fabs(sum_of(exact.image, "G") / sum - 1) < 4.5 * noise + 1e-3);
    // A line instead of a curve within each ball: +0.4 % by its own quadrature, beside the noise.
    const Picture linear = field.render({"particles.light = \"linear\""});
    MESSAGE("over path: linear ", sum_of(linear.image, "G") / sum - 1);
    CHECK(std::fabs(sum_of(linear.image, "G") / sum - 1) < 0.01 + 4.5 * noise);
}

TEST_CASE("particles: every width, thread and order of the file, the same picture") {
    std::string rows[2];
    for (std::uint32_t n = 0; n < 300; ++n)
        for (int k = 0; k < 2; ++k) {
            const std::uint32_t i = k == 0 ? n : (n * 7 + 5) % 300;
            rows[k] +=
                std::to_string(80 * draw(i, 0) - 40) + " " + std::to_string(80 * draw(i, 1) - 40) +
                " " + std::to_string(100 * draw(i, 2)) + " " + std::to_string(3 + 10 * draw(i, 3)) +
                " " + std::to_string(0.1 * draw(i, 4)) + "\n";
        }
    const Field field(rows[0]), turned(rows[1]);
    for (const char* light : {"linear", "exact"}) {
        const std::vector<std::string> kind = {"particles.light = \"" + std::string(light) + "\"",
                                               "particles.scattering = \"octaves\"",
                                               "sky.radiance = 0.1"};
        const std::string hash = field.render(kind).report.hash;
        CHECK(turned.render(kind).report.hash == hash);
        Scene scene = scene_from(kText, kind);
        for (int t = 0; const KernelTable* table = kernel_table_at(t); ++t) {
            RenderOptions options;
            options.isa = table->name;
            options.threads = 1 + t;
            const test::TempFolder folder;
            folder.put("p.csv", "x y z radius density\n" + rows[0]);
            scene.directory = folder.path("");
            CHECK(render_one(scene, options).report.hash == hash);
        }
    }
}

TEST_CASE("particles: none, far ones, suns and views along the axes are finite and lawful") {
    const Field none("");
    CHECK(sum_of(none.render({}).image, "A") == 0);
    const Field two("0 0 50 30 1e9\n0 0 50 30 1e-9\n"),
        far("10000000 0 50 1 1\n10000002 0 50 1 1\n");
    const Picture seen = far.render(
        {"camera.position_m = [10000000, -9, 50]", "camera.target_m = [10000000, 0, 50]"});
    CHECK(sum_of(seen.image, "A") > 1);
    for (const char* sun : {"0", "90", "-90"})
        for (const char* azimuth : {"0", "90", "180"})
            for (const char* place : {"[0, -400, 50]", "[400, 0, 50]", "[0, 0, 50]"}) {
                CAPTURE(sun);
                CAPTURE(azimuth);
                CAPTURE(place);
                const Picture p = two.render(
                    {"sun.elevation_deg = " + std::string(sun),
                     "sun.azimuth_deg = " + std::string(azimuth),
                     "camera.position_m = " + std::string(place), "camera.target_m = [0, 0, 51]",
                     "camera.up = [0, 1, 0.1]", "camera.resolution = [8, 8]"});
                std::size_t wrong = 0;
                for (const char* channel : {"R", "A"})
                    for (const float v : p.image.find(channel)->pixels.span())
                        wrong += !(v >= 0 && v < 10);
                CHECK(wrong == 0);
            }
}
