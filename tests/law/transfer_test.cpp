// SPDX-License-Identifier: Apache-2.0
// Transfer functions: values of a field become extinction and colour, in every method.
// in: fields of a few cells, rows -> out: pass or fail.
// docs/scene.md, "A transfer function".
#include "src/scene/media/transfer.h"

#include <cmath>
#include <limits>

#include "src/world/medium/mix_media.h"
#include "tests/support/host_cells.h"

using namespace pileus;

namespace {

const Float3 kWhite{1, 1, 1}, kRed{1, 0.5f, 0.25f};

/// A box of 8 x 1 x 1 cells with the values of `field`.
Scene field_scene(const std::vector<float>& field, const std::vector<TransferRow>& rows) {
    Scene scene;
    scene.file = "t.toml";
    scene.media.resize(1);
    MediumSettings& m = scene.media[0];
    m.density = "uniform:box";
    m.box.has_bounds = true;
    m.box.bounds_m = {{{0, 0, 0}, {8, 1, 1}}};
    m.box.resolution = {int(field.size()), 1, 1};
    m.optics.transfer = rows;
    return scene;
}

Medium loaded(const Scene& scene, const std::vector<float>& field, Plan& plan) {
    Medium out;
    const Status status =
        load_media(scene, Limits{}, 1, plan, out, nullptr, render_test::host_cells(scene, field));
    REQUIRE_MESSAGE(status, status.message);
    return out;
}

/// Extinction of a voxel in all, and of one medium of it.
double extinction(const Medium& m, std::size_t voxel) {
    return double(m.sigma) * double(m.volume.density[voxel]);
}
double part(const Medium& m, std::size_t medium, std::size_t voxel) {
    const std::size_t voxels = m.volume.density.size();
    if (medium > 0) return double(m.sigma) * double(m.parts[(medium - 1) * voxels + voxel]);
    double rest = extinction(m, voxel);
    for (std::size_t i = 1; i < std::size_t(m.count); ++i) rest -= part(m, i, voxel);
    return rest;
}

}  // namespace

TEST_CASE("transfer: extinction at the rows, between them, and beyond both ends") {
    const std::vector<TransferRow> rows{
        {-2, 0.5, kWhite}, {0, 0, kWhite}, {1, 4, kRed}, {1.5, 1, kRed}};
    const double at[][2] = {{-9, 0.5}, {-2, 0.5},   {-1, 0.25}, {0, 0},  {0.25, 1},
                            {1, 4},    {1.25, 2.5}, {1.5, 1},   {99, 1}, {1e30, 1}};
    for (const auto& row : at) CHECK(transfer_extinction(rows, row[0]) == row[1]);
    CHECK(transfer_colours(rows) == std::vector<Float3>{kWhite, kRed});
    // A row without extinction has no colour of its own.
    CHECK(transfer_colours({{0, 0, kRed}, {1, 1, kWhite}}) == std::vector<Float3>{kWhite});
    CHECK(transfer_colours({{0, 0, kRed}, {1, 0, kWhite}}).size() == 1);
}

TEST_CASE("transfer: each colour is a medium with its rows' hat functions, which add up") {
    const float none = std::numeric_limits<float>::quiet_NaN();
    const std::vector<float> field{-3, 0, 0.25f, 0.5f, 1, 2, 7, none};
    const std::vector<TransferRow> rows{{0, 0.25, kWhite}, {1, 1, kRed}, {3, 0.5, kWhite}};
    Plan plan;
    const Medium m = loaded(field_scene(field, rows), field, plan);
    REQUIRE(m.count == 2);
    CHECK(m.channels == 3);
    CHECK(m.optics[0].albedo[2] == 1.0f);
    CHECK(m.optics[1].albedo[2] == 0.25f);
    for (std::size_t v = 0; v < field.size(); ++v) {
        CAPTURE(field[v]);
        const bool there = field[v] == field[v];
        const double all = there ? transfer_extinction(rows, double(field[v])) : 0;
        const double x = double(field[v]);
        const double hat = !(x > 0) ? 0 : x < 1 ? x : x < 3 ? (3 - x) / 2 : 0;
        // Two roundings to floats.
        CHECK(extinction(m, v) == doctest::Approx(all).epsilon(2e-7));
        CHECK(part(m, 1, v) == doctest::Approx(hat).epsilon(2e-7));
    }
    REQUIRE(plan.needed.size() == 2);
    CHECK(plan.needed[0] ==
          "medium 0 by a transfer function of 3 values in 2 colours, a medium each");
}

TEST_CASE("transfer: the outline counts what loading may hold") {
    const std::vector<float> field{1, 1, 1, 1};
    const std::vector<TransferRow> rows{{0, 1, kRed}, {1, 2, kWhite}, {2, 1, kRed}, {3, 0, kWhite}};
    const Scene scene = field_scene(field, rows);
    CHECK(media_by_colour(scene) == 2);
    Medium outline;
    MediumSource source;
    Plan plan;
    REQUIRE(outline_media(scene, Limits{}, 1, plan, outline, source,
                          render_test::host_cells(scene, field)));
    CHECK(outline.count == 2);
    CHECK(outline.sigma == 2.0f);
    CHECK(source.apart_voxels == 8);
    CHECK(source.mean_density < 0);
    // No value shows the first colour: one medium is left.
    Plan after;
    const Medium m = loaded(scene, field, after);
    CHECK(m.count == 1);
    CHECK(m.optics[0].albedo[1] == 1.0f);
    CHECK(after.left_out.size() == 2);  // the colour, and mixing
}

TEST_CASE("transfer: two equal rows are a plain uniform medium, to the bit") {
    const std::vector<float> field{0.1f, 0.7f, 3, -2, 0, 1, 0.9f, 5};
    const std::vector<float> ones(8, 1.0f);
    Plan plan;
    const Medium shown =
        loaded(field_scene(field, {{0, 0.03, kRed}, {1, 0.03, kRed}}), field, plan);
    Scene plain = field_scene(ones, {});
    plain.media[0].optics.extinction_per_m = 0.03;
    plain.media[0].optics.albedo = kRed;
    const Medium uniform = loaded(plain, ones, plan);
    CHECK(shown.count == 1);
    CHECK(shown.sigma == uniform.sigma);
    CHECK(shown.density_max == uniform.density_max);
    CHECK(shown.channels == uniform.channels);
    for (std::size_t v = 0; v < 8; ++v) CHECK(shown.volume.density[v] == 1.0f);
    for (std::size_t c = 0; c < 3; ++c)
        CHECK(shown.optics[0].albedo[c] == uniform.optics[0].albedo[c]);
}

TEST_CASE("transfer: a table of a phase function stays with a colour that is there") {
    const std::vector<float> field{1, 1, 1, 1};
    Scene scene = field_scene(field, {{0, 1, kRed}, {1, 2, kWhite}, {2, 0, kWhite}});
    scene.media[0].optics.phase.type = "cloud";
    scene.media[0].optics.phase.numbers["effective_radius_um"] = 10;
    Plan plan;
    const Medium m = loaded(scene, field, plan);
    REQUIRE(m.phases.size() == 1);
    CHECK(m.optics[0].phase.table == m.phases[0].table.data());
}

TEST_CASE("transfer: every method shows it as thick as it is") {
    // Seen along y through 1 m: value 1 in the left half, 0.5 in the right; one cell lies between.
    const std::vector<float> field{1, 1, 1, 1, 0.5f, 0.5f, 0.5f, 0.5f};
    const std::string text =
        "seed = 3\n[camera]\nposition_m = [4, -100, 0.5]\ntarget_m = [4, 0, 0.5]\n"
        "projection = \"orthographic\"\nheight_m = 1\nresolution = [64, 8]\n"
        "[sun]\nelevation_deg = 90\n[sky]\nradiance = 0.5\n[[medium]]\ndensity = \"uniform:box\"\n"
        "bounds_m = [[0, 0, 0], [8, 1, 1]]\nresolution = [8, 1, 1]\n"
        "transfer = [{ value = 0, extinction_per_m = 0 },\n"
        "{ value = 0.5, extinction_per_m = 0.5, albedo = [0.25, 0.5, 1] },\n"
        "{ value = 1, extinction_per_m = 2, albedo = [1, 0.5, 0.25] }]\n"
        "[collectors]\nphotons = 20000\ngenerations = 2\nsamples = 200\n"
        "[photon_grid]\nphotons = 20000\ngenerations = 2\n[path]\nsamples_per_pixel = 16\n"
        "[output]\nlayers = [\"cloud\"]\n";
    for (const char* method : {"collectors", "path", "raymarch", "optical-depth", "photon-grid"}) {
        CAPTURE(method);
        const Scene scene = render_test::scene_from(text, {std::string("method.name=") + method});
        const render_test::Picture picture = render_test::render_cells(scene, field);
        // A step of a march meets the ends of the box to a few parts in 10^4 of its depth.
        CHECK(picture.at("A", 8, 4) == doctest::Approx(1 - std::exp(-2.0)).epsilon(2e-3));
        CHECK(picture.at("A", 56, 4) == doctest::Approx(1 - std::exp(-0.5)).epsilon(2e-3));
        // Each half has the colour of its row.
        double red[2] = {}, blue[2] = {};
        for (int x = 0; x < 24; ++x)
            for (int y = 0; y < 8; ++y)
                for (int half = 0; half < 2; ++half) {
                    red[half] += double(picture.at("cloud.R", x + 40 * half, y));
                    blue[half] += double(picture.at("cloud.B", x + 40 * half, y));
                }
        CHECK(red[0] > 1.5 * blue[0]);
        CHECK(blue[1] > 1.5 * red[1]);
    }
}

TEST_CASE("transfer: more colours than media are refused") {
    std::string rows;
    for (int i = 0; i < 9; ++i)
        rows += std::string(i > 0 ? ", " : "") + "{ value = " + std::to_string(i) +
                ", extinction_per_m = 1, albedo = 0." + std::to_string(i + 1) + " }";
    const Scene scene = render_test::scene_from(
        "[camera]\nposition_m = [0, -9, 5]\ntarget_m = [0, 0, 5]\n[[medium]]\n"
        "density = \"uniform:box\"\nbounds_m = [[0, 0, 0], [1, 1, 1]]\ntransfer = [" +
        rows + "]\n");
    const Status status = render(scene, {}, [](int, Image&, Report&) { return Status::ok(); });
    CHECK(status.code == Code::kLimit);
    CHECK(status.message ==
          "test.toml: limits.media: needs 9, allowed: at most 8 (no switch raises it)");
}
