// SPDX-License-Identifier: Apache-2.0
// The sun's light that stays in its beam: its tables, and pictures of peaked phase functions by it.
// in: phase functions, small scenes -> out: shares of light, biases, the ledger as it was.
// docs/methods.md 3, repair 6.
#include "src/world/light/beam.h"

#include <doctest/doctest.h>

#include <cmath>

#include "lab/mie/mie.h"
#include "tests/support/render_harness.h"

namespace beam_test {

using namespace render_test;
using Keys = std::vector<std::string>;

Medium medium_of(const PhaseParams& phase, float albedo) {
    Medium m;
    m.optics[0].phase = phase;
    for (float& a : m.optics[0].albedo) a = albedo;
    return m;
}

PhaseParams hg(float g) {
    PhaseParams p;
    p.g1 = g;
    return p;
}

/// The integral over all directions of one depth's column, by the trapezoid rule over the nodes.
double over_sphere(const Beam& beam, int depth) {
    const auto turn = [](int node) {
        const double at = double(node) / kBeamAngles, near = at < 0.5 ? at : 1 - at;
        return at < 0.5 ? 4 * near * near : 2 - 4 * near * near;
    };
    double sum = 0;
    for (int i = 0; i < kBeamAngles; ++i)
        sum += (turn(i + 1) - turn(i)) * 0.5 *
               double(beam.tables[std::size_t(i * (kBeamDepths + 1) + depth)] +
                      beam.tables[std::size_t((i + 1) * (kBeamDepths + 1) + depth)]);
    return sum * 2 * 3.14159265358979323846;
}

TEST_CASE("beam: all of what scatters within the peak is in the tables, for each depth") {
    for (const double g : {0.5, 0.85, 0.95})
        for (const double albedo : {1.0, 0.7}) {
            CAPTURE(g);
            CAPTURE(albedo);
            Beam beam;
            REQUIRE(make_beam(medium_of(hg(float(g)), float(albedo)), turn_of_deg(20), false,
                              BeamTurns::kAll, 2, Stage::kShadow, beam));
            CHECK(beam.sets == 1);
            CHECK(beam.shares[0] > 0.05);
            CHECK(beam.shares[0] < 1);
            CHECK(double(beam.rest[0]) ==
                  doctest::Approx(1 - albedo * beam.shares[0]).epsilon(1e-6));
            for (const int depth : {0, 1, 4, 16, 28}) {
                CAPTURE(depth);
                const double tau = 4 * (depth / 32.0) / (1 - depth / 32.0);
                // Of degree 0 alone: what has been scattered within the peak once or more. The
                // trapezoid errs by the curvature between nodes, 1e-3 where the peak is a few wide.
                CHECK(over_sphere(beam, depth) ==
                      doctest::Approx(1 - std::exp(-tau * albedo * beam.shares[0])).epsilon(2e-3));
            }
        }
}

TEST_CASE("beam: light from a point is as much, and its angles have a third of the variance") {
    Beam beam;
    REQUIRE(make_beam(medium_of(hg(0.97f), 1e-3f), turn_of_deg(60), true, BeamTurns::kAll, 2,
                      Stage::kShadow, beam));
    const auto turns = [&](int kind) {
        double sum = 0, light = 0, last = 0, before = 0;
        for (int i = 0; i <= kBeamAngles; ++i) {
            const double at = double(i) / kBeamAngles, near = at < 0.5 ? at : 1 - at;
            const double turn = at < 0.5 ? 4 * near * near : 2 - 4 * near * near;
            const double q =
                double(beam.tables[std::size_t(kind * kBeamNumbers + i * (kBeamDepths + 1) + 1)]);
            light += 0.5 * (q + before) * (turn - last);
            sum += 0.5 * (q * turn + before * last) * (turn - last);
            last = turn, before = q;
        }
        return std::pair<double, double>(light, sum / light);
    };
    const auto parallel = turns(0), point = turns(1);
    CHECK(point.first == doctest::Approx(parallel.first).epsilon(2e-3));
    // Of the mean 1 - cos of two turns, 0.03 is the last's own: the rest is the kept one's, and a
    // third of that. The trapezoid errs by a thousandth of the whole.
    const double own = 0.03;
    CHECK((point.second - own) / (parallel.second - own) == doctest::Approx(1.0 / 3).epsilon(0.03));
}

TEST_CASE("beam: peaks narrower than its degrees are spread, and light neither made nor lost") {
    for (const double g : {0.99, 0.997, 0.9999, 0.9999999, 1.0}) {
        CAPTURE(g);
        Beam beam;
        REQUIRE(make_beam(medium_of(hg(float(g)), 0.9f), turn_of_deg(20), false, BeamTurns::kAll, 2,
                          Stage::kShadow, beam));
        CHECK(beam.shares[0] <= 1 + 1e-6);
        CHECK(beam.shares[0] > 0.95);
        for (const int depth : {1, 4, 16, 28}) {
            CAPTURE(depth);
            const double tau = 4 * (depth / 32.0) / (1 - depth / 32.0);
            // Spread by 0.3 degrees where nodes are 0.16 apart: the trapezoid is 5 % too large.
            CHECK(over_sphere(beam, depth) ==
                  doctest::Approx(1 - std::exp(-tau * 0.9 * beam.shares[0])).epsilon(0.06));
            // Far from the peak k turns send about k times what one does.
            for (int node = 200; node <= kBeamAngles; node += 40) {
                const double at = double(node) / kBeamAngles, near = at < 0.5 ? at : 1 - at;
                const double turn = at < 0.5 ? 4 * near * near : 2 - 4 * near * near;
                const double value =
                    double(beam.tables[std::size_t(node * (kBeamDepths + 1) + depth)]);
                CHECK(value <
                      3 * (1 + tau) * double(phase_density(hg(float(g)), float(turn))) + 2e-5);
            }
        }
    }
}

TEST_CASE("beam: one scattering within the peak is the phase function spread by its peak") {
    // Of HG with a window of almost all directions: HG of g spread by HG of g is HG of g squared.
    Beam beam;
    REQUIRE(make_beam(medium_of(hg(0.6f), 1e-3f), turn_of_deg(89.9), false, BeamTurns::kAll, 1,
                      Stage::kShadow, beam));
    // Thin: tau w f is 4e-5, so that Q is tau w times the spread function, to 1e-4.
    const int depth = 1;
    const double tau = 4 * (1 / 32.0) / (1 - 1 / 32.0);
    // The window e^-x leaves out what turns far: compare its share, and that the order falls.
    const double forward = double(beam.tables[std::size_t(depth)]) / (tau * 1e-3);
    const double back =
        double(beam.tables[std::size_t(kBeamAngles * (kBeamDepths + 1) + depth)]) / (tau * 1e-3);
    CHECK(forward < double(phase_density(hg(0.36f), 0.0f)));
    CHECK(forward > 0.5 * double(phase_density(hg(0.36f), 0.0f)));
    CHECK(back > 0);
    CHECK(back < double(phase_density(hg(0.36f), 2.0f)));
}

/// A cloud of droplets of 10 um, seen 145 degrees from straight on: at the cloudbow.
const Keys kBow = {"sun.azimuth_deg=161", "sun.elevation_deg=30", "sky.radiance=[0,0,0]",
                   "camera.position_m=[0,-4000,900]", "camera.target_m=[0,0,900]"};
const std::string kHg = "{ type = \"henyey-greenstein\", g = 0.85 }";
const std::string kCloud = "{ type = \"cloud\", effective_radius_um = 10 }";

Report verified(const Keys& more) {
    Keys all = {"camera.resolution=[96, 54]", "output.layers=[\"radiance\",\"alpha\"]"};
    all.insert(all.end(), kBow.begin(), kBow.end());
    all.insert(all.end(), more.begin(), more.end());
    RenderOptions options;
    options.verify = 1500;
    std::string text = kSmallCumulus;
    text.replace(text.find(kHg), kHg.size(), kCloud);
    return render_one(scene_from(text, all), options).report;
}

TEST_CASE("beam: droplets near the cloudbow, with and without the beam's peak") {
    const Report with = verified({"collectors.photons=1000000"});
    const Report without = verified({"collectors.photons=1000000", "collectors.peak_deg=0"});
    // One fixed seed at 4.5 standard errors, and the 5 % that the bands leave.
    CHECK(std::fabs(with.verify.bias) < 0.05 + 4.5 * with.verify.standard_error);
    // 15 % too dark without: the bands do not hold what the peak sends on.
    CHECK(without.verify.bias < with.verify.bias - 0.08);
    const Report cells = verified({"method.name=photon-grid", "photon_grid.photons=1000000"});
    CHECK(std::fabs(cells.verify.bias) < 0.05 + 4.5 * cells.verify.standard_error);
}

TEST_CASE("beam: photons fly as without it") {
    for (const char* method : {"collectors", "photon-grid"}) {
        CAPTURE(method);
        const std::string name = std::string("method.name=") + method;
        const Report a = render_one(scene_from(kSmallCumulus, {name}), {}).report;
        const Report b = render_one(scene_from(kSmallCumulus, {name, "collectors.peak_deg=0",
                                                               "photon_grid.peak_deg=0"}),
                                    {})
                             .report;
        CHECK(a.hash != b.hash);
        CHECK(a.events.scatterings == b.events.scatterings);
        CHECK(a.events.tentative == b.events.tentative);
        REQUIRE(a.photons.energy.size() == b.photons.energy.size());
        for (std::size_t i = 0; i < a.photons.energy.size(); ++i) {
            CHECK(a.photons.energy[i].top == b.photons.energy[i].top);
            CHECK(a.photons.energy[i].sides == b.photons.energy[i].sides);
            CHECK(a.photons.energy[i].absorbed == b.photons.energy[i].absorbed);
        }
    }
}

}  // namespace beam_test
