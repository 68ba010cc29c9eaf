// SPDX-License-Identifier: Apache-2.0
// Cells as they are: densities that are constant within voxels, in every method.
// in: small fields of sharp cells -> out: optical depths against sums over cells; pictures against
// trilinear fields of finer cells.
// docs/methods.md 1.
#include <algorithm>
#include <cmath>

#include "src/world/grid/grid.h"
#include "src/world/medium/mix_media.h"
#include "tests/support/host_cells.h"
#include "tests/support/sun_depth_harness.h"

using namespace pileus;

namespace {

/// Densities by a hash, one in three of them 0.
std::vector<float> cells_of(const std::array<int, 3>& size) {
    std::vector<float> out;
    std::uint32_t v = 1;
    for (int i = 0; i < size[0] * size[1] * size[2]; ++i) {
        v = v * 1664525u + 1013904223u;
        out.push_back(v >> 16 & 3 ? float(v >> 20) * 0x1p-12f : 0.0f);
    }
    return out;
}

/// Integral of the density from `o` along `d` through unit-free cells over [0, extent].
double ray_integral(const std::vector<float>& cells, const std::array<int, 3>& size,
                    const Double3& extent, const Double3& o, const Double3& d, bool periodic) {
    double enter = 0, leave = 1e30;
    std::vector<double> cuts;
    for (int a = 0; a < 3; ++a) {
        if (d[a] == 0) {
            if (!(periodic && a < 2) && !(o[a] >= 0 && o[a] <= extent[a])) return 0;
            continue;
        }
        const double one = -o[a] / d[a], other = (extent[a] - o[a]) / d[a];
        if (!(periodic && a < 2)) {
            enter = std::max(enter, std::min(one, other));
            leave = std::min(leave, std::max(one, other));
        }
        const int periods = periodic && a < 2 ? 60 : 0;
        for (int n = -periods * size[std::size_t(a)]; n <= (1 + periods) * size[std::size_t(a)];
             ++n)
            cuts.push_back((n * extent[a] / size[std::size_t(a)] - o[a]) / d[a]);
    }
    cuts.push_back(enter);
    cuts.push_back(leave);
    std::sort(cuts.begin(), cuts.end());
    double sum = 0;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
        if (cuts[i] < enter || cuts[i + 1] > leave) continue;
        const double middle = 0.5 * (cuts[i] + cuts[i + 1]);
        std::size_t at[3];
        for (int a = 0; a < 3; ++a) {
            const int n = size[std::size_t(a)];
            const int whole = int(std::floor((o[a] + middle * d[a]) / extent[a] * n));
            at[a] = std::size_t(((whole % n) + n) % n);
        }
        sum += (cuts[i + 1] - cuts[i]) *
               double(cells[(at[2] * std::size_t(size[1]) + at[1]) * std::size_t(size[0]) + at[0]]);
    }
    return sum;
}

const std::array<int, 3> kSize{5, 4, 3};
const Double3 kExtent{500, 320, 270};
constexpr double kSigma = 0.01;

/// The cells seen by parallel rays from `eye`, their middle the target; no ray lies in a face.
std::string scene_text(const Double3& eye, const char* more) {
    const auto number = [](double v) { return std::to_string(v); };
    return "seed = 5\n[camera]\nposition_m = [" + number(eye[0]) + ", " + number(eye[1]) + ", " +
           number(eye[2]) +
           "]\ntarget_m = [250, 160, 135]\nup = [0.1, 0.37, 0.9]\nprojection = \"orthographic\"\n"
           "height_m = 400\nresolution = [24, 16]\n[sun]\nelevation_deg = 50\nazimuth_deg = 20\n"
           "[[medium]]\ndensity = \"uniform:box\"\nbounds_m = [[0, 0, 0], [500, 320, 270]]\n"
           "resolution = [5, 4, 3]\nextinction_per_m = 0.01\ninterpolation = \"constant\"\n"
           "[collectors]\nphotons = 8000\ngenerations = 2\nsamples = 200\n[photon_grid]\n"
           "photons = 8000\ngenerations = 2\n[path]\nsamples_per_pixel = 4\n[output]\n"
           "layers = [\"optical_depth\", \"transmittance\"]\n" +
           more;
}

/// Where the ray of a pixel begins, by the camera's definition.
Double3 pixel_origin(const Double3& eye, int x, int y, Double3& forward) {
    const Double3 target{250, 160, 135}, up{0.1, 0.37, 0.9};
    const auto cross = [](const Double3& a, const Double3& b) {
        return Double3{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                       a[0] * b[1] - a[1] * b[0]};
    };
    const auto unit = [](Double3 v) {
        const double n = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        return Double3{v[0] / n, v[1] / n, v[2] / n};
    };
    forward = unit(target - eye);
    const Double3 right = unit(cross(forward, up)), above = cross(right, forward);
    const double u = ((x + 0.5) / 24 * 2 - 1) * 300, v = (1 - (y + 0.5) / 16 * 2) * 200;
    Double3 o;
    for (int a = 0; a < 3; ++a) o[a] = eye[a] + right[a] * u + above[a] * v;
    return o;
}

}  // namespace

TEST_CASE("constant cells: every method's optical depth is the sum over cells") {
    const std::vector<float> cells = cells_of(kSize);
    const Double3 eyes[] = {
        {-900, 160, 135}, {250, 1900, 135}, {250, 160, 3000}, {-700, -800, 900}};
    for (const char* method : {"collectors", "path", "raymarch", "optical-depth", "photon-grid"})
        for (const Double3& eye : eyes) {
            CAPTURE(method);
            CAPTURE(eye[0]);
            Scene scene = render_test::scene_from(scene_text(eye, ""),
                                                  {std::string("method.name=") + method});
            const render_test::Picture picture = render_test::render_cells(scene, cells);
            double largest = 0, mean = 0;
            for (int y = 0; y < 16; ++y)
                for (int x = 0; x < 24; ++x) {
                    Double3 d;
                    const Double3 o = pixel_origin(eye, x, y, d);
                    const double exact = kSigma * ray_integral(cells, kSize, kExtent, o, d, false);
                    // Rays end below a transmittance of 1e-4. At a corner a cell may get 2^-9 of a
                    // step from another: 0.16 m of 0.01 per m.
                    if (exact > 8) continue;
                    const double most = 1.8e-3;
                    CHECK(std::fabs(double(picture.at("tau", x, y)) - exact) < most);
                    CHECK(double(picture.at("T", x, y)) ==
                          doctest::Approx(std::exp(-exact)).epsilon(most));
                    mean += std::fabs(double(picture.at("tau", x, y)) - exact) / (24 * 16);
                    largest = std::max(largest, exact);
                }
            CHECK(largest > 1);
            // All but corners is rounding: of places of 1e-4 m, of 0.01 per m.
            CHECK(mean < 2e-5);
        }
}

TEST_CASE("constant cells: two cells in a row let through exp(-tau) of each") {
    const std::vector<float> cells{1, 0.125f};
    for (const char* method : {"collectors", "path", "raymarch", "optical-depth", "photon-grid"}) {
        CAPTURE(method);
        Scene scene = render_test::scene_from(
            scene_text({-900, 160, 135}, ""),
            {std::string("method.name=") + method, "medium.0.resolution=[2,1,1]"});
        const render_test::Picture picture = render_test::render_cells(scene, cells);
        CHECK(double(picture.at("tau", 12, 8)) == doctest::Approx(2.8125).epsilon(2e-6));
        CHECK(double(picture.at("A", 12, 8)) ==
              doctest::Approx(1 - std::exp(-2.8125)).epsilon(2e-6));
    }
}

TEST_CASE("constant cells: few steps or many, raymarch's optical depth is exact") {
    const std::vector<float> cells = cells_of(kSize);
    const Double3 eye{-700, -800, 900};
    for (const char* steps : {"raymarch.steps=3", "raymarch.steps=100"})
        for (const char* spacing : {"raymarch.spacing=uniform", "raymarch.spacing=geometric"}) {
            CAPTURE(steps);
            Scene scene = render_test::scene_from(
                scene_text(eye, ""),
                {"method.name=raymarch", steps, spacing, "raymarch.light=march"});
            const render_test::Picture picture = render_test::render_cells(scene, cells);
            for (int y = 0; y < 16; ++y)
                for (int x = 0; x < 24; ++x) {
                    Double3 d;
                    const Double3 o = pixel_origin(eye, x, y, d);
                    const double exact = kSigma * ray_integral(cells, kSize, kExtent, o, d, false);
                    if (exact > 8) continue;
                    // Of a step of a third of the ray least_way is 0.4 m.
                    CHECK(std::fabs(double(picture.at("tau", x, y)) - exact) < 4e-3 + 2e-4 * exact);
                }
        }
}

TEST_CASE("constant cells: paths find the transmittance of the cells") {
    // Absorption alone before a bright sky: a pixel's light is the share that comes through.
    const std::vector<float> cells = cells_of(kSize);
    const Double3 eye{-700, -800, 900};
    for (const char* boundary : {"open", "periodic"}) {
        CAPTURE(boundary);
        Scene scene = render_test::scene_from(
            scene_text(eye, "[sky]\nradiance = 1\n"),
            {"method.name=path", "medium.0.albedo=0", "path.samples_per_pixel=4096",
             "path.pixel=centre", std::string("medium.0.boundary=") + boundary, "sun.irradiance=0",
             "output.layers=[\"error\"]"});
        const render_test::Picture picture = render_test::render_cells(scene, cells);
        double sum = 0, square = 0;
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 24; ++x) {
                Double3 d;
                const Double3 o = pixel_origin(eye, x, y, d);
                const double exact = std::exp(-kSigma * ray_integral(cells, kSize, kExtent, o, d,
                                                                     scene.media[0].box.periodic));
                sum += double(picture.at("R", x, y)) - exact;
                // Of a share p of 4096 draws.
                square += exact * (1 - exact) / 4096;
            }
        // 4.5 standard errors: 7e-6 of right programs fail.
        CHECK(std::fabs(sum) < 4.5 * std::sqrt(square));
    }
}

TEST_CASE("constant cells: a picture is that of a trilinear field of eight times finer cells") {
    // A checkerboard; ramps of an eighth of a cell are left of its faces.
    const std::array<int, 3> coarse{4, 4, 2}, fine{32, 32, 16};
    std::vector<float> cells, ramps(32 * 32 * 16);
    for (int i = 0; i < 32; ++i) cells.push_back((i + i / 4 + i / 16) % 2 == 0 ? 1.0f : 0.1f);
    for (std::size_t z = 0; z < 16; ++z)
        for (std::size_t y = 0; y < 32; ++y)
            for (std::size_t x = 0; x < 32; ++x)
                ramps[(z * 32 + y) * 32 + x] = cells[(z / 8 * 4 + y / 8) * 4 + x / 8];
    const auto mean = [&](const std::vector<float>& values, const std::array<int, 3>& size,
                          const char* interpolation, const char* method, double& error) {
        Scene scene = render_test::scene_from(
            scene_text({-700, -800, 900}, ""),
            {std::string("method.name=") + method, "path.samples_per_pixel=256",
             std::string("medium.0.interpolation=") + interpolation, "output.layers=[\"error\"]"});
        scene.media[0].box.resolution = size;
        const render_test::Picture picture = render_test::render_cells(scene, values);
        double sum = 0, square = 0;
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 24; ++x) {
                sum += double(picture.at("R", x, y));
                const double e = double(picture.at("error.R", x, y));
                square += e * e;
            }
        error = std::sqrt(square) / sum;
        return sum;
    };
    double ours_error = 0, theirs_error = 0, smooth_error = 0;
    const double ours = mean(cells, coarse, "constant", "path", ours_error);
    const double theirs = mean(ramps, fine, "linear", "path", theirs_error);
    const double z = (ours / theirs - 1) / std::hypot(ours_error, theirs_error);
    MESSAGE("checkerboard: constant over 8 x finer linear cells ", ours / theirs, ", z ", z);
    // What the ramps change is below the noise: 0.1 of the optical depth over an eighth of a cell.
    CHECK(std::fabs(z) < 4.5);
    // The same cells read linearly are another cloud, which this tells apart.
    const double smooth = mean(cells, coarse, "linear", "path", smooth_error);
    CHECK(std::fabs(smooth / theirs - 1) > 4.5 * std::hypot(smooth_error, theirs_error));
}

TEST_CASE("constant cells: densities, masses and means of the preparation") {
    Grid grid{{5, 4, 3}, {2, 3, 4}};
    grid.constant = true;
    const std::vector<float> cells = cells_of(kSize);
    const Span<const float> span{cells.data(), cells.size()};
    const float at[][3] = {{0, 0, 0}, {0.99f, 3.99f, 2.99f}, {5, 4, 3}, {1, 2.5f, 1.01f}};
    const std::size_t voxel[] = {0, 55, 59, 31};
    for (std::size_t i = 0; i < 4; ++i) CHECK(density_at(span, grid, at[i]) == cells[voxel[i]]);
    std::vector<double> masses(cells.size());
    voxel_masses(span, grid, 2, {masses.data(), masses.size()});
    for (std::size_t i = 0; i < cells.size(); ++i) CHECK(masses[i] == 24 * double(cells[i]));
    // A cell of 1.5 over cells of 1: of two and a half of them.
    const RowWeights w = row_weights({0, 1.5, 2}, {0, 1, 3}, true);
    CHECK(w.weight == std::vector<double>{1 / 1.5, 0.5 / 1.5, 0.5 / 1.5, 1 / 1.5});
    CHECK(w.begin == std::vector<int>{0, 1});
}

TEST_CASE("constant cells: rays to the sun are exact, the sweep is along axes and near the top") {
    // Rays ask for unit directions.
    std::array<float, 3> suns[] = {{0.3f, 0.2f, 0.9f}, {0.2f, 0.9f, -0.4f}, {1, 0, 0},
                                   {0, 0, 1},          {0.6f, 0.6f, 0.6f},  {-0.9f, 0.1f, -0.2f}};
    for (auto& sun : suns) {
        const float length = std::sqrt(sun[0] * sun[0] + sun[1] * sun[1] + sun[2] * sun[2]);
        for (float& d : sun) d /= length;
    }
    for (const bool periodic : {false, true})
        for (const auto& sun : suns) {
            if (periodic && !(std::fabs(sun[2]) > 0.1f)) continue;
            sun_depth_test::Rig rig = sun_depth_test::random_box({12, 13, 11}, {12, 26, 5.5}, 0.5);
            rig.medium.grid.constant = true;
            rig.medium.grid.periodic = periodic;
            const std::vector<float> cells(rig.medium.volume.density.span().begin(),
                                           rig.medium.volume.density.span().end());
            const std::vector<float> rays =
                sun_depth_test::depths(rig, sun, kernel_table(nullptr), 1, SunDepthKind::kExact);
            const std::vector<float> swept = sun_depth_test::depths(rig, sun);
            const int axis = periodic ? 2 : sun_depth_test::slice_axis(rig.medium.grid, sun);
            const float length = std::sqrt(sun[0] * sun[0] + sun[1] * sun[1] + sun[2] * sun[2]);
            sun_depth_test::for_nodes(rig.medium.grid, [&](const std::array<int, 3>& at,
                                                           std::size_t node) {
                Double3 o, d;
                const Double3 extent{12, 26, 5.5};
                for (int a = 0; a < 3; ++a) {
                    o[a] = (at[std::size_t(a)] + 0.5) * extent[a] / rig.medium.grid.size[a];
                    d[a] = double(sun[std::size_t(a)]) / double(length);
                }
                const double exact =
                    0.5 * ray_integral(cells, {12, 13, 11}, extent, o, d, periodic);
                CHECK(double(rays[node]) == doctest::Approx(exact).epsilon(1e-3));
                const int n = rig.medium.grid.size[axis];
                const bool top = at[std::size_t(axis)] == (sun[std::size_t(axis)] > 0 ? n - 1 : 0);
                const bool straight = std::fabs(sun[std::size_t(axis)]) == 1;
                if (top || straight)
                    CHECK(double(swept[node]) == doctest::Approx(exact).epsilon(1e-5));
            });
        }
}

TEST_CASE("constant cells: media of one scene agree, and keep what they hold on another grid") {
    const std::vector<float> cells = cells_of(kSize);
    Scene scene;
    scene.file = "t.toml";
    scene.media.resize(2);
    for (std::size_t i = 0; i < 2; ++i) {
        MediumSettings& m = scene.media[i];
        m.density = "uniform:box";
        m.box.has_bounds = true;
        m.box.bounds_m = {{{0, 0, 0}, {5, 4, 3}}};
        if (i == 1) m.box.bounds_m = {{{0.3, -1, 0}, {2.9, 5, 6}}};
        m.box.resolution = kSize;
        m.optics.extinction_per_m = 0.5;
        m.box.constant = true;
    }
    Plan plan;
    Medium mixed;
    REQUIRE(load_media(scene, Limits{}, 2, plan, mixed, nullptr,
                       render_test::host_cells(scene, cells)));
    CHECK(mixed.grid.constant);
    double sum = 0, held = 0;
    for (const float v : mixed.volume.density.span()) sum += double(v);
    for (const float v : cells) held += double(v);
    const double cell = mixed.extent_m[0] * mixed.extent_m[1] * mixed.extent_m[2] /
                        double(mixed.volume.density.size());
    CHECK(sum * cell == doctest::Approx(held * (1 + 2.6 * 6 * 6 / 60)).epsilon(1e-6));
    scene.media[1].box.constant = false;
    Medium outline;
    MediumSource source;
    const Status status = outline_media(scene, Limits{}, 1, plan, outline, source,
                                        render_test::host_cells(scene, cells));
    CHECK(status.message ==
          "t.toml: medium.1.interpolation: differs, \"linear\", allowed: what medium.0 has");
}
