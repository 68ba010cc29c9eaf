// SPDX-License-Identifier: Apache-2.0
// Slices of the photon grid's raw numbers, and photons until an error is reached.
// in: small scenes by photon-grid -> out: what the ledger says, bits, faults.
// docs/photon-grid.md, "Slices", "Frames and budgets".
#include <doctest/doctest.h>

#include <cmath>

#include "lab/views/view_list.h"
#include "tests/support/render_harness.h"

namespace grid_views_test {

using namespace render_test;

/// A box of 100 m that absorbs half of what it meets, the sun overhead, nothing else.
constexpr const char* kAbsorber = R"(
seed = 2
[camera]
position_m = [0, -500, 50]
target_m = [0, 0, 50]
fov_deg = 20
resolution = [64, 48]
[sun]
elevation_deg = 90
irradiance = [2, 2, 2]
[[medium]]
density = "uniform:box"
bounds_m = [[-50, -50, 0], [50, 50, 100]]
resolution = [10, 10, 10]
extinction_per_m = 0.02
albedo = 0.5
[method]
name = "photon-grid"
[photon_grid]
photons = 200_000
generations = 10
cells = [5, 5, 4]
first_order_split = false
)";

/// A view has counters of its own: render_one asks for a picture's.
Picture slices(const char* view, const std::vector<std::string>& more = {}) {
    RenderOptions options;
    options.show = view;
    options.find_view = find_view;
    Picture p;
    const Status status =
        render(scene_from(kAbsorber, more), options, [&](int, Image& image, Report& report) {
            p.report = report;
            p.image = std::move(image);
            return Status::ok();
        });
    REQUIRE_MESSAGE(status, status.message);
    return p;
}

TEST_CASE("slices: the flux of all cells absorbs what the ledger says") {
    for (const char* closure : {"sh", "published", "mean"}) {
        CAPTURE(closure);
        const Picture p = slices("flux-slices", {std::string("photon_grid.closure=") + closure});
        const Channel* value = p.image.find("value");
        const Channel* alpha = p.image.find("A");
        REQUIRE(value != nullptr);
        REQUIRE(alpha != nullptr);
        const std::uint64_t zoom = p.counter("pixels_per_cell");
        REQUIRE(zoom > 0);
        double sum = 0;
        for (std::size_t i = 0; i < value->pixels.size(); ++i)
            sum += double(value->pixels[i] * alpha->pixels[i]);
        sum /= double(zoom * zoom);
        // W = flux * absorption * volume of a cell; all that arrives is 2 W/m2 on 100 m by 100 m.
        const double absorbed = sum * 0.02 * 0.5 * (20.0 * 20.0 * 25.0) / (2.0 * 100.0 * 100.0);
        REQUIRE(p.report.photons.energy.size() == 1);
        const EnergyRow& row = p.report.photons.energy[0];
        // Two estimates of the same photons, 200 000 of them: 4.5 standard errors of the ledger's,
        // and as much for the flux, whose own is no larger.
        const double error = std::sqrt(0.25 / 200'000);
        CHECK(std::fabs(absorbed - row.absorbed / row.emitted) < 9 * error);
    }
}

TEST_CASE("slices: mean cosines lie within -1 and 1, and fall from the lit side on") {
    const Picture p = slices("anisotropy-slices");
    const Channel* value = p.image.find("value");
    REQUIRE(value != nullptr);
    for (const float v : value->pixels.span()) {
        CHECK(v <= 1.0f);
        CHECK(v >= -1.0f);
    }
    // Unscattered light is among it: more forward than back everywhere.
    CHECK(value->pixels[0] > 0.2f);
    const Picture bent = slices("anisotropy-slices", {"photon_grid.closure=published"});
    CHECK(double(bent.image.find("value")->pixels[0]) ==
          doctest::Approx(double(value->pixels[0])).epsilon(0.05));
}

TEST_CASE("slices: towards a camera there is neither flux nor direction") {
    RenderOptions options;
    options.show = "flux-slices";
    options.find_view = find_view;
    Report report;
    const Status status = render(scene_from(kAbsorber, {"photon_grid.closure=camera"}), options,
                                 [](int, Image&, Report&) { return Status::ok(); });
    CHECK(!status);
    CHECK(status.message.find("photon_grid.closure: \"camera\" keeps neither flux") !=
          std::string::npos);
}

TEST_CASE("budget error: photons double until it is reached, and are those of that number") {
    const std::vector<std::string> keys = {"output.layers=[\"radiance\",\"alpha\",\"error\"]",
                                           "photon_grid.photons=1_000"};
    RenderOptions options;
    options.budget.error = 0.04;
    const Picture p = render_one(scene_from(kAbsorber, keys), options);
    CHECK(p.report.errors.mean_relative <= 0.04);
    CHECK(p.report.photons.generations > 10);
    CHECK(p.report.photons.generations % 10 == 0);
    // Half as many were not enough.
    RenderOptions fewer;
    fewer.budget.error = p.report.errors.mean_relative * 1.2;
    CHECK(render_one(scene_from(kAbsorber, keys), fewer).report.photons.generations <=
          p.report.photons.generations);
    const Picture again = render_one(scene_from(kAbsorber, keys), options);
    CHECK(again.report.hash == p.report.hash);
}

TEST_CASE("budget error: needs the layer that it looks at, and a still") {
    RenderOptions options;
    options.budget.error = 0.1;
    const auto fault = [&](const std::vector<std::string>& keys) {
        return render(scene_from(kAbsorber, keys), options,
                      [](int, Image&, Report&) { return Status::ok(); })
            .message;
    };
    CHECK(fault({}).find("--budget error: method photon-grid knows") == 0);
    CHECK(fault({"output.layers=[\"radiance\",\"alpha\",\"error\"]", "animation.frames=2"})
              .find("--budget error: not for an animation") == 0);
}

}  // namespace grid_views_test
