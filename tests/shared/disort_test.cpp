// SPDX-License-Identifier: Apache-2.0
// The published test problems of DISORT: fluxes and radiances at all levels, by path and photons.
// in: PILEUS_DATA_DIR/reference/disort_*.csv -> out: a row per number, or why it was skipped.
// docs/validation.md; Stamnes, Tsay, Wiscombe, Laszlo 2000, "DISORT report v1.1".
#include "tests/shared/disort_case.h"
#include "tests/support/validation_rows.h"

using namespace disort;
using namespace validation;

namespace {

/// A level at the border is looked at from just outside, where nothing more is in the way.
constexpr double kOutside = 1e-3;

double place_of(const Case& c, double level) {
    if (level <= 0) return 1 + kOutside;
    return level >= c.tau ? -kOutside : c.height(level);
}

std::vector<std::unique_ptr<Case>> read_cases(const std::string& root) {
    std::vector<std::unique_ptr<Case>> cases;
    for (const published::Row& row : published::read_table(root + "/reference/disort_cases.csv")) {
        cases.push_back(std::make_unique<Case>());
        read_case(row, root + "/reference/cloud_C1_moments.csv", *cases.back());
    }
    return cases;
}

Case& case_of(const std::vector<std::unique_ptr<Case>>& cases, const std::string& name) {
    for (const auto& c : cases)
        if (c->name == name) return *c;
    FAIL("no case ", name);
    return *cases[0];
}

/// Thick white layers keep a path for long: fewer of them where every run must take them.
std::uint64_t count_for(const Case& c) {
    const bool long_lived = c.tau >= 8 && c.albedo[0] == 1;
    return samples(long_lived ? 16'000 : 50'000, 1'000'000);
}

/// Sunlight by paths through cloud C.1, whose peak is 1700 times its mean, comes in so few samples
/// that their scatter tells nothing before there are millions: for the long form alone.
bool is_too_peaked(const Case& c) { return c.is_beam() && c.phase.bytes() > 0 && !long_tests(); }

/// The sun's light that was not scattered, through a plane that faces it.
double straight(const Case& c, double level) {
    return c.is_beam() ? c.beam * std::exp(-level / c.mu0) : 0;
}

/// 1 - albedo at a level; on a border DISORT counts the layer above.
double absorbed_share(const Case& c, double level) {
    const double below = level / c.tau * double(c.albedo.size());
    return 1 - c.albedo[std::size_t(std::fmax(0, std::ceil(below) - 1))];
}

/// The same without sampling; 0 for a case that has no exact solution.
double exact_flux(const Case& c, const std::string& quantity, double level) {
    if (c.exact == nullptr) return 0;
    if (quantity != "dfdt") return c.exact->flux(level, quantity == "flup");
    return absorbed_share(c, level) * 4 * std::acos(-1.0) * c.exact->mean_radiance(level);
}

/// What a row of disort_fluxes.csv asks for, by path.
Mean flux_by_path(const Case& c, const std::string& quantity, double level, std::uint64_t count,
                  std::uint64_t seed) {
    const double z = place_of(c, level);
    if (quantity == "flup") return flux(c.rig, z, true, count, seed);
    if (quantity == "rfldn") return flux(c.rig, z, false, count, seed);
    // dfdt = (1 - albedo) times the light of all directions.
    const int edge = int(samples(64, 256));
    Mean m = all_directions(c.rig, z, edge, 2 + count / std::uint64_t(6 * edge * edge), seed);
    m.value += straight(c, level);
    m.value *= absorbed_share(c, level);
    m.error *= absorbed_share(c, level);
    return m;
}

/// What a value is compared with, and how far that itself may be off: the exact solution where
/// there is one (2e-5 of it), else the printed number (half a unit of its last digit).
struct Reference {
    double value, open;
};
Reference reference_of(const Case& c, double exact, const std::string& printed) {
    const double value = published::number(printed);
    if (c.exact == nullptr) return {value, published::half_of_last_digit(printed)};
    // What was printed was computed with few directions: 0.3 % off in the worst row.
    CHECK(std::fabs(value / exact - 1) <= 0.005);
    return {exact, 2e-5 * std::fabs(exact)};
}

const char* const kFluxHead =
    "| case | depth | quantity | published | reference | path | standard error | z | detectable "
    "bias "
    "|\n"
    "|---|---|---|---|---|---|---|---|---|";
const char* const kRadianceHead =
    "| case | depth | mu | phi | published | reference | path | standard error | z | detectable "
    "bias "
    "|\n"
    "|---|---|---|---|---|---|---|---|---|---|";

}  // namespace

TEST_CASE("validation: fluxes of DISORT's test problems by path") {
    const std::string root = published::data_folder();
    if (root.empty()) return;
    const auto cases = read_cases(root);
    Section section("disort-fluxes", kFluxHead);
    int zeros = 0;
    for (const published::Row& row : published::read_table(root + "/reference/disort_fluxes.csv")) {
        const Case& c = case_of(cases, row.text("case"));
        const std::string &quantity = row.text("quantity"), &printed = row.text("value");
        const double level = row.value("tau_level"), value = row.value("value");
        if (quantity == "rfldir" || is_too_peaked(c)) continue;  // the former by photons, below
        const auto measure = [&](int multiple, std::uint64_t seed) {
            return flux_by_path(c, quantity, level, count_for(c) * std::uint64_t(multiple), seed);
        };
        if (value == 0) {
            // Nothing comes from outside, and a white layer absorbs nothing: zero, not about zero.
            CHECK(measure(1, 1).value == 0.0);
            zeros += 1;
            continue;
        }
        const Reference r = reference_of(c, exact_flux(c, quantity, level), printed);
        section.check(
            text_of("path: DISORT %s depth %g %s", c.name.c_str(), level, quantity.c_str()),
            text_of("%s | %g | %s | %s", c.name.c_str(), level, quantity.c_str(), printed.c_str()),
            r.value, r.open, measure);
    }
    section.line(text_of("\n%d published zeros are found as zeros, exactly.", zeros));
}

TEST_CASE("validation: radiances of DISORT's test problems by path") {
    const std::string root = published::data_folder();
    if (root.empty()) return;
    const auto cases = read_cases(root);
    Section section("disort-radiances", kRadianceHead);
    int zeros = 0;
    for (const published::Row& row :
         published::read_table(root + "/reference/disort_radiances.csv")) {
        const Case& c = case_of(cases, row.text("case"));
        const double level = row.value("tau_level"), value = row.value("radiance");
        const double mu = row.value("mu"), phi = row.value("phi_deg");
        if (is_too_peaked(c)) continue;
        const auto measure = [&](int multiple, std::uint64_t seed) {
            return radiance(c.rig, place_of(c, level), travel_of(mu, phi),
                            count_for(c) * std::uint64_t(multiple), seed);
        };
        if (value == 0) {
            CHECK(measure(1, 1).value == 0.0);
            zeros += 1;
            continue;
        }
        const std::string& printed = row.text("radiance");
        const Reference r =
            reference_of(c, c.exact != nullptr ? c.exact->radiance(level, mu) : 0, printed);
        const std::string cells =
            text_of("%s | %g | %g | %g | %s", c.name.c_str(), level, mu, phi, printed.c_str());
        // DISORT's manual itself calls 3a at mu = +-1 inexact: shown, not judged.
        if (c.name == "3a" && std::fabs(mu) == 1)
            section.show(cells, r.value, r.open, measure(1, 1));
        else
            section.check(text_of("path: DISORT %s depth %g mu %g", c.name.c_str(), level, mu),
                          cells, r.value, r.open, measure);
    }
    section.line(text_of("\n%d published zeros are found as zeros, exactly.", zeros));
}

TEST_CASE("validation: fluxes out of DISORT's beam problems by path, exchanged") {
    const std::string root = published::data_folder();
    if (root.empty()) return;
    Section section("disort-exchanged", kFluxHead);
    auto cases = read_cases(root);
    for (const published::Row& row : published::read_table(root + "/reference/disort_fluxes.csv")) {
        Case& c = case_of(cases, row.text("case"));
        const std::string& quantity = row.text("quantity");
        const double level = row.value("tau_level"), value = row.value("value");
        const bool up = quantity == "flup" && level <= 0,
                   down = quantity == "rfldn" && level >= c.tau;
        if (!c.is_beam() || value == 0 || !(up || down)) continue;
        // A ray towards the sun's place, or along its light, under a uniform sky.
        c.rig.lighting.sunlit = false;
        set_sky(c.rig, 1);
        const double in = c.beam * c.mu0;
        const std::string& printed = row.text("value");
        const Reference r = reference_of(c, exact_flux(c, quantity, level), printed);
        section.check(
            text_of("path: DISORT %s depth %g %s, exchanged", c.name.c_str(), level,
                    quantity.c_str()),
            text_of("%s | %g | %s | %s", c.name.c_str(), level, quantity.c_str(), printed.c_str()),
            r.value, r.open, [&](int multiple, std::uint64_t seed) {
                Mean m = radiance(c.rig, place_of(c, level), travel_of(up ? c.mu0 : -c.mu0, 0),
                                  count_for(c) * std::uint64_t(multiple), seed);
                m.value = in * m.value - (down ? straight(c, level) * c.mu0 : 0);
                m.error *= in;
                return m;
            });
    }
}

TEST_CASE("validation: fluxes out of DISORT's test problems by photons") {
    const std::string root = published::data_folder();
    if (root.empty()) return;
    auto cases = read_cases(root);
    Section section(
        "disort-photons",
        "| case | depth | quantity | published | reference | photons | standard error | "
        "z | detectable bias |\n|---|---|---|---|---|---|---|---|---|");
    for (const published::Row& row : published::read_table(root + "/reference/disort_fluxes.csv")) {
        Case& c = case_of(cases, row.text("case"));
        const std::string& quantity = row.text("quantity");
        const double level = row.value("tau_level"), value = row.value("value");
        const bool top = level <= 0, bottom = level >= c.tau;
        if (value < 1e-20 || quantity == "dfdt" || (!top && !bottom)) continue;
        if (top != (quantity == "flup")) continue;  // what arrives at the top is what was sent
        c.rig.lighting.lights.clear();
        c.rig.lighting.ground.present = false;
        const double sine = std::sqrt(1 - c.mu0 * c.mu0);
        add_light(c.rig, c.is_beam() ? beam_light(c.rig.medium, {-sine, 0, -c.mu0})
                                     : diffuse_light(c.rig.medium, -1));
        const double in = c.is_beam() ? c.beam * c.mu0 : c.sky * std::acos(-1.0);
        const std::string& printed = row.text("value");
        const bool scattered = quantity != "rfldir";
        const Reference r = reference_of(
            c, scattered ? exact_flux(c, quantity, level) : straight(c, level) * c.mu0, printed);
        section.check(
            text_of("photons: DISORT %s depth %g %s", c.name.c_str(), level, quantity.c_str()),
            text_of("%s | %g | %s | %s", c.name.c_str(), level, quantity.c_str(), printed.c_str()),
            r.value, r.open, [&](int multiple, std::uint64_t seed) {
                const TraceTally t = shoot(c.rig, 5 * count_for(c) * std::uint64_t(multiple), seed);
                const Fates& f = t.light;
                // A beam's `rfldn` is what was scattered on the way; a sky's is all that arrives.
                const std::int64_t fate = quantity == "flup"     ? f.top[0]
                                          : quantity == "rfldir" ? f.direct_bottom[0]
                                          : c.is_beam()          ? f.bottom[0] - f.direct_bottom[0]
                                                                 : f.bottom[0];
                Mean m = share_mean(fate, t);
                m.value *= in;
                m.error *= in;
                return m;
            });
    }
}
