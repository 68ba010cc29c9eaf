// SPDX-License-Identifier: Apache-2.0
// Particles as billboards, with a lens and a shutter.
// in: made-up particles -> out: depths against sums over all; blurred pictures against the mean of
// many sharp ones. docs/particles.md, "Billboards"; docs/testing.md, label law
#include <cmath>

#include "tests/io/temp_folder.h"
#include "tests/support/particle_harness.h"
#include "tests/support/render_harness.h"

using namespace pileus;
using namespace render_test;
using namespace particle_test;

namespace {

struct Puff {
    double at[3], speed[3], radius, density;
};

/// In a cube of 80 m about (0, 0, 50), radii over a decade; `thin` ones do not hide each other.
std::vector<Puff> puffs(std::uint32_t count, bool thin) {
    std::vector<Puff> made(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        Puff& p = made[i];
        for (std::uint32_t a = 0; a < 3; ++a) {
            p.at[a] = 80 * draw(i, a) - 40 + (a == 2 ? 50 : 0);
            p.speed[a] = 40 * draw(i, 5 + a) - 20;
        }
        p.radius = 1 + 9 * draw(i, 3);
        p.density = (thin ? 0.02 : 1) * (0.2 + draw(i, 4)) / p.radius;
    }
    return made;
}

std::string table_of(const std::vector<Puff>& all) {
    std::string text = "x y z vx vy vz radius density\n";
    for (const Puff& p : all) {
        char row[240];
        (void)std::snprintf(row, sizeof row, "%.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g\n", p.at[0],
                            p.at[1], p.at[2], p.speed[0], p.speed[1], p.speed[2], p.radius,
                            p.density);
        text += row;
    }
    return text;
}

Picture show(const std::vector<Puff>& all, std::vector<std::string> overrides,
             const RenderOptions& options = {}, bool parallel = false) {
    const test::TempFolder folder;
    folder.put("p.csv", table_of(all));
    overrides.push_back("camera.resolution = [40, 40]");
    std::string text = kText;
    if (parallel)
        text.replace(text.find("fov_deg = 30"), 12,
                     "projection = \"orthographic\"\nheight_m = 120");
    Scene scene = scene_from(text, overrides);
    scene.directory = folder.path("");
    return render_one(scene, options);
}

const std::string kBoards = "particles.display = \"billboards\"";

std::vector<double> plane_of(const Picture& picture, const char* channel) {
    std::vector<double> out;
    for (const float v : picture.image.find(channel)->pixels.span()) out.push_back(double(v));
    return out;
}
double sum_of(const std::vector<double>& plane) {
    double sum = 0;
    for (const double v : plane) sum += v;
    return sum;
}
/// Squared differences over squares.
double relative(const std::vector<double>& a, const std::vector<double>& truth) {
    double error = 0, square = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        error += (a[i] - truth[i]) * (a[i] - truth[i]);
        square += truth[i] * truth[i];
    }
    return error / square;
}

constexpr int kSharp = 256;

/// Radical inverse of i in base 2 or 3.
double spread(int i, int base) {
    double value = 0, part = 1;
    for (; i > 0; i /= base) value += (part /= base) * (i % base);
    return value;
}

/// The mean of sharp pictures, each with particles moved by move(picture, puff).
template <class Move>
void mean_of(const std::vector<Puff>& all, const std::vector<std::string>& overrides, Move move,
             std::vector<double>& colour, std::vector<double>& depth) {
    for (int n = 0; n < kSharp; ++n) {
        std::vector<Puff> moved = all;
        for (Puff& p : moved) move(n, p);
        const Picture sharp = show(moved, overrides);
        const std::vector<double> g = plane_of(sharp, "G"), tau = plane_of(sharp, "tau");
        colour.resize(g.size()), depth.resize(tau.size());
        for (std::size_t i = 0; i < g.size(); ++i) {
            colour[i] += g[i] / kSharp;
            depth[i] += tau[i] / kSharp;
        }
    }
}

}  // namespace

TEST_CASE("billboards: depths are those of a march, colours near it") {
    const std::vector<Puff> all = puffs(300, false);
    for (const bool parallel : {false, true}) {
        std::vector<std::string> own = {"particles.scattering = \"octaves\"", "sky.radiance = 0.1"};
        const Picture marched = show(all, own, {}, parallel);
        own.push_back(kBoards);
        const Picture boards = show(all, own, {}, parallel);
        const std::vector<double> a = plane_of(boards, "tau"), b = plane_of(marched, "tau");
        double worst = 0;
        for (std::size_t i = 0; i < a.size(); ++i)
            worst = std::max(worst, std::fabs(a[i] - b[i]) / (b[i] + 1e-3));
        // Both round places 400 m away to floats.
        CHECK(worst < 1e-3);
        // One colour a particle and one order for all of it: measured 0.0002 and 0.0004.
        CHECK(relative(plane_of(boards, "G"), plane_of(marched, "G")) < 0.002);
        CHECK(relative(plane_of(boards, "A"), plane_of(marched, "A")) < 1e-6);
    }
}

TEST_CASE("billboards: every width, thread and order of the file, the same picture") {
    std::vector<Puff> all = puffs(300, false), turned;
    for (std::size_t i = 0; i < all.size(); ++i) turned.push_back(all[(7 * i + 5) % all.size()]);
    for (const auto& blur : std::vector<std::vector<std::string>>{
             {},
             {"camera.shutter_s = 0.5"},
             {"camera.shutter_s = 0.5", "camera.aperture_radius_m = 4"},
             {"particles.falloff = 1", "particles.display_scale = 1.5"}}) {
        std::vector<std::string> own = blur;
        own.push_back(kBoards);
        const std::string hash = show(all, own).report.hash;
        CHECK(show(turned, own).report.hash == hash);
        for (int t = 0; const KernelTable* table = kernel_table_at(t); ++t) {
            RenderOptions options;
            options.isa = table->name;
            options.threads = 1 + t;
            CHECK(show(all, own, options).report.hash == hash);
        }
    }
}

TEST_CASE("billboards: motion blur is the mean of sharp pictures where particles are thin") {
    const std::vector<Puff> all = puffs(60, true);
    std::vector<double> colour, depth;
    mean_of(
        all, {kBoards},
        [](int n, Puff& p) {
            for (int a = 0; a < 3; ++a) p.at[a] += p.speed[a] * ((n + 0.5) / kSharp - 0.5);
        },
        colour, depth);
    const Picture blurred = show(all, {kBoards, "camera.shutter_s = 1"});
    // The mean depth is exact: measured 2e-11.
    CHECK(relative(plane_of(blurred, "tau"), depth) < 1e-9);
    CHECK(std::fabs(sum_of(plane_of(blurred, "tau")) / sum_of(depth) - 1) < 1e-3);
    // Sharp ones are lit where they are, and order matters a little: measured 3e-5.
    CHECK(relative(plane_of(blurred, "G"), colour) < 1e-3);
    // Curved by a lens too small to matter, it is summed at five places.
    const Picture curved =
        show(all, {kBoards, "camera.shutter_s = 1", "camera.aperture_radius_m = 1e-6"});
    CHECK(relative(plane_of(curved, "tau"), depth) < 1e-6);
}

TEST_CASE("billboards: a lens blurs as the mean over its places where particles are thin") {
    const std::vector<Puff> all = puffs(60, true);
    constexpr double kRadius = 30, kFocus = 420;
    std::vector<double> colour, depth;
    mean_of(
        all, {kBoards},
        [](int n, Puff& p) {
            // The camera looks along y from -400; its right is x, its up is z.
            const double r = kRadius * std::sqrt((n + 0.5) / kSharp),
                         turn = 2 * M_PI * spread(n, 2);
            const double out = (p.at[1] + 400) / kFocus - 1;
            p.at[0] += r * std::cos(turn) * out;
            p.at[2] += r * std::sin(turn) * out;
        },
        colour, depth);
    const Picture blurred =
        show(all, {kBoards, "camera.aperture_radius_m = 30", "camera.focus_distance_m = 420"});
    const Picture sharp = show(all, {kBoards});
    // A bell in place of a disc that is spread over a bell: measured 0.0004.
    CHECK(relative(plane_of(blurred, "tau"), depth) < 0.002);
    CHECK(relative(plane_of(blurred, "G"), colour) < 0.002);
    CHECK(relative(plane_of(sharp, "G"), colour) > 0.05);
    CHECK(std::fabs(sum_of(plane_of(blurred, "tau")) / sum_of(depth) - 1) < 0.005);
}

TEST_CASE("billboards: shown size and falloff keep depth times area") {
    std::vector<Puff> one = puffs(1, true);
    one[0] = {{0, 0, 50}, {0, 0, 0}, 12, 0.01};
    const double sum = sum_of(plane_of(show(one, {kBoards}), "tau"));
    for (const char* other : {"particles.display_scale = 2", "particles.display_scale = 0.5",
                              "particles.falloff = 1", "particles.falloff = 6"}) {
        CAPTURE(other);
        // Sums over pixels of 5 m: 2 % for the narrowest outlines.
        CHECK(std::fabs(sum_of(plane_of(show(one, {kBoards, other}), "tau")) / sum - 1) < 0.03);
    }
}

TEST_CASE("billboards: corners are finite") {
    std::vector<Puff> all = puffs(40, false);
    all[0] = {{0, -400, 50}, {1e6, 1e6, 1e6}, 30, 1e9};
    all[1] = {{0, -402, 50}, {0, 300, 0}, 1, 1};
    all[2] = {{0, 50, 50}, {0, -1e9, 0}, 1e-3, 1e-12};
    for (const char* more :
         {"camera.shutter_s = 1", "camera.aperture_radius_m = 1e6", "camera.fov_deg = 179",
          "camera.focus_distance_m = 1e-6", "particles.falloff = 0", "particles.stop_below = 1",
          "sun.elevation_deg = 90", "sun.elevation_deg = -90"})
        for (const char* lens : {"camera.aperture_radius_m = 0", "camera.aperture_radius_m = 9"}) {
            CAPTURE(more);
            const Picture p = show(all, {kBoards, lens, "camera.target_m = [0, 0, 50]", more});
            std::size_t wrong = 0;
            for (const char* channel : {"R", "A"})
                for (const double v : plane_of(p, channel)) wrong += v >= 0 && v < 100 ? 0 : 1;
            CHECK(wrong == 0);
        }
}

TEST_CASE("billboards: a lens and a shutter are for them alone") {
    Scene scene;
    const auto line = [&](const std::vector<std::string>& overrides) {
        return std::string(read_scene_text(kText, "t.toml", "", overrides, scene).message);
    };
    CHECK(line({"camera.shutter_s = 1"}).find("camera.shutter_s: for billboards of particles") !=
          std::string::npos);
    CHECK(line({"camera.aperture_radius_m = 1", "method.name = \"path\""})
              .find("camera.aperture_radius_m: for billboards") != std::string::npos);
    CHECK(line({kBoards, "particles.light = \"exact\""}).find("for bins of a march alone") !=
          std::string::npos);
    CHECK(line({kBoards, "camera.aperture_radius_m = 1", "camera.projection = \"orthographic\""})
              .find("a lens needs perspective") != std::string::npos);
}
