// SPDX-License-Identifier: Apache-2.0
// Tables of phase functions, and HG with Draine: samples, densities and moments.
// in: kernels_cpu/media/phase.h, tables of all kinds -> out: largest errors against long double.
// docs/phase.md; docs/testing.md S7, S9.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "kernels_cpu/core/rng.h"
#include "src/base/digest.h"
#include "src/base/exponential.h"
#include "src/world/phase/medium_phase.h"
#include "tests/support/phase_reference.h"
#include "tests/support/quadrature.h"
#include "tests/support/widths.h"

using namespace pileus;

namespace {

using List = std::vector<std::pair<double, double>>;

struct Named {
    std::string name;
    List list;
};

/// Tables that are gentle, steep, gapped, of two lines, of spikes, and closer than floats can tell.
std::vector<Named> every_table() {
    List steep, dense;
    for (int i = 0; i <= 900; ++i) steep.push_back({0.2 * i, exponential(-0.1 * i)});
    for (int i = 0; i <= 20000; ++i) dense.push_back({0.009 * i, 1.0 + (i % 7)});
    return {
        {"isotropic", {{0, 1}, {180, 1}}},
        {"two lines", {{0, 1}, {180, 0}}},
        {"gaps", {{0, 0}, {30, 0}, {31, 5}, {32, 0}, {90, 0}, {91, 1}, {120, 0}, {180, 0}}},
        {"spike in front", {{0, 1e8}, {0.01, 1}, {180, 1}}},
        {"spike at the side", {{0, 1}, {59.999, 1}, {60, 1e8}, {60.001, 1}, {180, 1}}},
        {"spike behind", {{0, 1}, {179.99, 1}, {180, 1e8}}},
        {"light behind alone", {{0, 0}, {179.5, 0}, {180, 1}}},
        {"tiny steps", {{0, 1}, {1e-9, 2}, {1e-6, 1}, {179.9999, 1}, {179.99999, 3}, {180, 1}}},
        {"light over 39 powers of ten", steep},
        {"20001 lines", dense},
    };
}

/// Draws of uniform_open: the 64 smallest, the 64 largest, and 4096 between.
std::vector<float> some_draws() {
    std::vector<float> list;
    for (std::uint32_t k = 0; k < 64; ++k) {
        list.push_back(uniform_open(k << 9));
        list.push_back(uniform_open(~(k << 9)));
    }
    for (std::uint32_t k = 0; k < 4096; ++k) list.push_back(uniform_open(k * 0x100000u + 0x8ff00u));
    return list;
}

/// The angle of a turn: the sine tells the smaller of 1 - cos and 1 + cos.
Angle angle_of(const Turn<float>& turn) {
    const Real x = Real(turn.one_minus_cos), s = Real(turn.sine);
    return x <= 1 ? from_minus(x) : from_plus(s * s / x);
}

/// What rounding of 1 - cos does near an angle: largest density and slope of the cells around.
struct Around {
    double density = 0, slope = 0;
};
Around around(const PhaseParams& p, const Angle& a) {
    Around r;
    if (p.type != kPhaseTable) return r;
    const PhaseTable& t = *p.table;
    const std::int32_t cell = std::int32_t(table_place(t, a).cell);
    for (std::int32_t i = std::max(cell - 1, 0); i <= std::min(cell + 1, t.cells - 1); ++i) {
        const double first = double(t.density[i]), last = double(t.density[i + 1]);
        r.density = std::max({r.density, first, last});
        r.slope = std::max(r.slope, std::fabs(last - first) / double(t.width[i]));
    }
    return r;
}

/// The share of light before a drawn angle must be the draw, within `share_error` and what three
/// roundings of the angle's distance to its pole make of it. The density must be the reference's,
/// within 1e-6 and what two roundings of 1 - cos make of it.
void check_draws(const std::string& name, const PhaseParams& p, double share_error) {
    double share = 0;
    std::int64_t outside = 0, wrong = 0, above = 0;
    for (const float u : some_draws()) {
        const Turn<float> turn = phase_sample(p, u);
        const double x = double(turn.one_minus_cos);
        outside += !(x >= 0 && x <= 2 && turn.sine >= 0 && turn.sine <= 1);
        const Angle drawn = angle_of(turn);
        const double pole = double(std::min(drawn.minus, drawn.plus));
        const double moved = 2 * double(kPiReal) * around(p, drawn).density * 3 * 0x1p-24 * pole;
        const double off = std::fabs(double(phase_share(p, drawn) - Real(u)));
        share = std::max(share, off - moved);

        const Angle seen = from_minus(Real(turn.one_minus_cos));
        const double exact = double(phase_density_reference(p, seen));
        const double rounding = around(p, seen).slope * 0x1p-22 * std::min(x, 1.0);
        above += phase_density(p, turn.one_minus_cos) > phase_peak(p);
        wrong += !(std::fabs(double(phase_density(p, turn.one_minus_cos)) - exact) <=
                   1e-6 * exact + rounding);
    }
    std::printf("%-28s share before a draw within %.3g\n", name.c_str(), share);
    CHECK_MESSAGE(outside == 0, name);
    CHECK_MESSAGE(wrong == 0, name);
    CHECK_MESSAGE(above == 0, name);
    CHECK_MESSAGE(share <= share_error, name);
}

template <int W>
std::uint64_t digest_of_phases() {
    PhaseStore cloud, spike;
    REQUIRE(make_cloud_phase(9.3, cloud));
    const PhaseParams phases[] = {
        hg_draine(5), hg_draine(20), hg_draine(50), cloud.params(),
        phase_table({{0, 1}, {59.999, 1}, {60, 1e8}, {60.001, 1}, {180, 2}}, spike)};
    Digest digest;
    for (const PhaseParams& p : phases) {
        for (std::uint32_t i = 0; i < 1024; i += W) {
            const auto w = threefry(2u, 3u, iota<U<W>>() + i, all<U<W>>(0u));
            const Turn<F<W>> turn = phase_sample(p, uniform_open(w.a));
            const F<W> density = phase_density(p, uniform(w.b) * 2.0f);
            const F<W> again = phase_density(p, turn.one_minus_cos);
            for (int k = 0; k < W; ++k) {
                digest.f32(lane(turn.one_minus_cos, k));
                digest.f32(lane(turn.sine, k));
                digest.f32(lane(density, k));
                digest.f32(lane(again, k));
            }
        }
        for (int l = 0; l < kPhaseMoments; ++l) digest.f32(phase_moment(p, l));
    }
    return digest.value();
}

template <int W>
void check_digest() {
    CHECK(digest_of_phases<W>() == 0x8068d10b8dbc32b1ull);
}

}  // namespace

TEST_CASE(
    "tables: a draw leaves its own share of the light before it; the density is the table's") {
    for (const Named& t : every_table()) {
        PhaseStore store;
        const PhaseParams p = phase_table(t.list, store);
        // The place in a cell is rounded three times, 2^-24 each, and its share grows twice as fast
        // at most; a draw's step is 1.2e-7.
        check_draws(t.name, p, 3.6e-7);
    }
}

TEST_CASE("tables: the light over the sphere is 1, shares ascend from 0 to exactly 1") {
    for (const Named& t : every_table()) {
        PhaseStore store;
        const PhaseTable& table = *phase_table(t.list, store).table;
        // Densities are floats: 2^-24 each, all of one sign at worst.
        CHECK(double(table_share(table, from_plus(0))) == doctest::Approx(1).epsilon(6e-8));
        CHECK(table.share[0] == 0.0f);
        CHECK(table.share[table.cells] == 1.0f);
        std::int64_t wrong = 0;
        for (std::int32_t i = 0; i < table.cells; ++i)
            wrong += table.share[i] > table.share[i + 1] || table.turn[i] > table.turn[i + 1];
        CHECK(wrong == 0);
        CHECK(phase_peak(store.params()) ==
              *std::max_element(table.density, table.density + table.cells + 1));
    }
}

TEST_CASE("S9: cells without light are never drawn, whatever the draw") {
    PhaseStore store;
    const PhaseParams p = phase_table(every_table()[2].list, store);
    std::int64_t wrong = 0;
    for (std::uint32_t k = 0; k < (1u << 23); k += 11) {
        const Turn<float> turn = phase_sample(p, uniform_open(k << 9));
        const double angle = std::acos(1 - double(turn.one_minus_cos)) * 180 / double(kPiReal);
        // A float's cosine places these angles within 1e-5 degrees.
        const bool lit =
            (angle > 29.9999 && angle < 32.0001) || (angle > 89.9999 && angle < 120.0001);
        wrong += !lit;
    }
    CHECK(wrong == 0);
}

TEST_CASE("tables: moments are those of the density") {
    static const Quadrature q = gauss_legendre(16);
    for (const Named& t : every_table()) {
        PhaseStore store;
        const PhaseTable& table = *phase_table(t.list, store).table;
        if (table.cells > 2000) continue;
        double moment[kPhaseMoments] = {};
        for (std::int32_t i = 0; i < table.cells; ++i) {
            const double base = double(table.base[i]), width = double(table.width[i]);
            const double a = double(table.density[i]), b = double(table.density[i + 1]);
            const bool front = i < table.forward;
            for (int l = 0; l < kPhaseMoments; ++l)
                moment[l] += 2 * double(kPiReal) * integrate(q, 0, width, [&](double at) {
                                 const double f = front ? at / width : 1 - at / width;
                                 const double c = front ? 1 - base - at : base + at - 1;
                                 return (a + (b - a) * f) * legendre(l, c);
                             });
        }
        for (int l = 0; l < kPhaseMoments; ++l)
            CHECK_MESSAGE(std::fabs(moment[l] - double(table.moment[l])) <= 1.2e-7, t.name, l);
    }
}

TEST_CASE("HG and Draine: draws, density, moments and the mean cosine in closed form") {
    for (const double d : {5.0, 6.0, 8.0, 10.0, 15.0, 20.0, 35.0, 50.0}) {
        const PhaseParams p = hg_draine(d);
        PhaseParams alone = p;
        alone.weight = 0;
        check_draws("Draine alone, " + std::to_string(int(d)) + " um", alone, 8e-7);
        const double g = double(p.g2), alpha = double(p.alpha), w = double(p.weight);
        const double draine =
            g * (1 + alpha * (3 + 2 * g * g) / 5) / (1 + alpha * (1 + 2 * g * g) / 3);
        CHECK(double(phase_moment(p, 1)) ==
              doctest::Approx(w * double(p.g1) + (1 - w) * draine).epsilon(3e-7));
        static const Quadrature q = gauss_legendre(16);
        for (int l = 0; l < 8; ++l) {
            const double moment =
                2 * double(kPiReal) * integrate_graded(q, 0.0, 2.0, 40, [&](double x) {
                    return double(phase_density(p, float(x))) * legendre(l, 1 - x);
                });
            CHECK(std::fabs(moment - double(phase_moment(p, l))) <= 1e-6);
        }
    }
    // Jendersie and d'Eon 2023, equations 4 to 7 at 10 um, worked out by hand to six digits.
    const PhaseParams p = hg_draine(10);
    CHECK(double(p.g1) == doctest::Approx(0.988176).epsilon(2e-6));
    CHECK(double(p.g2) == doctest::Approx(0.555671).epsilon(2e-6));
    CHECK(double(p.alpha) == doctest::Approx(21.9955).epsilon(5e-6));
    CHECK(double(1 - p.weight) == doctest::Approx(0.481955).epsilon(2e-5));
}

TEST_CASE("faults: no light, and a peak beyond 1e15 per steradian") {
    PhaseNodes nodes;
    PhaseStore store;
    REQUIRE(nodes.angle_deg.resize(3, "nodes"));
    REQUIRE(nodes.value.resize(3, "nodes"));
    nodes.angle_deg[1] = 1e-7, nodes.angle_deg[2] = 180;
    CHECK(make_phase_table("x.txt", nodes, store).message ==
          "x.txt: values: all zero, allowed: one above 0 at the least");
    nodes.value[0] = 1;
    CHECK(make_phase_table("x.txt", nodes, store).code == Code::kBadInput);
    nodes.angle_deg[1] = 1e-4;
    CHECK(make_phase_table("x.txt", nodes, store));
}

TEST_CASE("tables, clouds, HG and Draine give the same stored digest at every width") {
    PILEUS_EACH_WIDTH(check_digest);
}
