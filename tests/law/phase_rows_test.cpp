// SPDX-License-Identifier: Apache-2.0
// Every phase function that a scene may name, at the ends of its numbers and between.
// in: the rows of phase_row.h -> out: light, draws, moments and cones that agree with the density.
// docs/contributing.md, "Add a phase function": a new row is tested by being there.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "src/base/number_text.h"
#include "src/scene/keys/all_keys.h"
#include "src/scene/rows/phase_row.h"
#include "src/world/phase/forward_share.h"
#include "src/world/phase/medium_phase.h"
#include "tests/io/temp_folder.h"
#include "tests/support/keys_text.h"
#include "tests/support/phase_reference.h"
#include "tests/support/quadrature.h"

namespace phase_rows_test {

using namespace pileus;

constexpr double kPi = 3.14159265358979324;

/// What a row's file may hold: a table with corners, moments; a row takes those that it can read.
const char* const kFiles[] = {"0 5\n3 2\n60 0.3\n100 0.1\n180 0.4\n", "1\n0.6\n0.3\n0.1\n"};

/// Ends of a key's range, places within, and 0 where it is one of them. Not too close to the low
/// end, for a peak behind that is narrower than 1 degree is blurred where densities are looked up
/// (docs/phase.md, "Tables").
std::vector<double> values_of(const KeyRow& key) {
    const KeyRange& r = key.allowed.range;
    const double span = r.high - r.low;
    std::vector<double> values;
    for (const double v : {r.low, r.low + 0.02 * span, r.low + 0.25 * span, 0.0,
                           r.low + 0.5 * span + 1e-3, r.low + 0.55 * span, r.low + 0.62 * span,
                           r.low + 0.9 * span, r.high - 0.005 * span, r.high})
        if (v >= r.low && v <= r.high) values.push_back(v);
    return values;
}

struct Case {
    std::string name;
    PhaseSettings settings;
};

std::string text_of(const PhaseSettings& settings) {
    std::string text = settings.type;
    for (const auto& [name, value] : settings.numbers)
        text += " " + name + " " + number_text(value);
    return text + " " + settings.file;
}

/// One number after the other through its values, the others at three places.
std::vector<Case> cases_of(const NamedPhase& type, const test::TempFolder& folder) {
    std::vector<Case> cases;
    PhaseSettings settings;
    settings.type = type.name;
    std::vector<const KeyRow*> numbers;
    bool has_file = false;
    for (const KeyRow& key : type.row->keys) {
        if (key.kind() == KeyKind::kNumber) numbers.push_back(&key);
        has_file |= key.kind() == KeyKind::kText;
    }
    const auto name = [](const KeyRow* key) {
        return std::string(key->path).substr(sizeof "medium.N.phase");
    };
    for (const KeyRow* key : numbers)
        for (const double at : {0.0, 0.6, 1.0}) {
            for (const KeyRow* other : numbers) {
                const KeyRange& r = other->allowed.range;
                settings.numbers[name(other)] = r.low + at * (r.high - r.low);
            }
            for (const double value : values_of(*key)) {
                settings.numbers[name(key)] = value;
                cases.push_back({text_of(settings), settings});
            }
            if (numbers.size() == 1) break;
        }
    int file = 0;
    if (has_file)
        for (const char* text : kFiles) {
            settings.file = folder.put(("p" + std::to_string(file++) + ".txt").c_str(), text);
            cases.push_back({text_of(settings), settings});
        }
    if (numbers.empty() && !has_file) cases.push_back({type.name, settings});
    return cases;
}

/// Panels of 1 - cos that halve towards both ends and part at a table's corners, by Gauss's rule.
struct Panels {
    std::vector<double> edges;

    explicit Panels(const PhaseParams& p) {
        for (int k = 0; k < 44; ++k) edges.push_back(std::ldexp(1, -k));
        for (int k = 1; k < 22; ++k) edges.push_back(2 - std::ldexp(1, -k));
        for (const double end : {0.0, 2.0}) edges.push_back(end);
        if (p.table != nullptr)
            for (int i = 0; i <= p.table->cells; ++i) edges.push_back(double(p.table->turn[i]));
        std::sort(edges.begin(), edges.end());
    }

    template <class Function>
    double integrate_to(double end, Function f) const {
        static const Quadrature q = gauss_legendre(12);
        double sum = 0;
        for (std::size_t i = 0; i + 1 < edges.size() && edges[i] < end; ++i)
            if (edges[i] < edges[i + 1])
                sum += integrate(q, edges[i], std::fmin(edges[i + 1], end), f);
        return sum;
    }
};

/// Draws with every uniform of a fine comb: their errors are of rounding and of the comb, not of
/// chance. Light that goes straight on or straight back has no density; its sine is 0.
struct Drawn {
    double straight_on = 0, straight_back = 0, mean_cosine = 0;
    bool sound = true;
    std::vector<double> within;  // shares of draws that turn by less than kCones
};

constexpr double kCones[] = {1, 10, 40, 90, 150, 179};
constexpr int kDraws = 1 << 18;

Drawn draw(const PhaseParams& p) {
    Drawn d;
    d.within.assign(std::size(kCones), 0);
    for (int i = 0; i < kDraws; ++i) {
        const Turn<float> t = phase_sample(p, float(2 * i + 1) / float(2 * kDraws));
        const double x = double(t.one_minus_cos), s = double(t.sine);
        d.sound &= x >= 0 && x <= 2 && s >= 0 && s <= 1;
        if (s == 0) (x < 1 ? d.straight_on : d.straight_back) += 1.0 / kDraws;
        d.mean_cosine += (1 - x) / kDraws;
        for (std::size_t c = 0; c < std::size(kCones); ++c) {
            const double half = std::sin(kCones[c] * kPi / 360);
            if (x <= 2 * half * half) d.within[c] += 1.0 / kDraws;
        }
    }
    return d;
}

// Densities are good to 1e-6 of themselves; behind, what a float knows of the angle adds to that.
constexpr double kLight = 2e-6;
// A lobe is torn where the comb passes from one to the other, and a draw is off by 8e-7.
constexpr double kComb = 2.0 / kDraws + 1e-6;

/// The largest deviations over all cases, for the log.
struct Worst {
    double light = 0, cone = 0, draws = 0;
};

void check_laws(const PhaseParams& p, Worst& worst) {
    const Panels panels(p);
    const auto density = [&](double x) { return double(phase_density(p, float(x))); };
    const Drawn d = draw(p);
    REQUIRE(d.sound);
    const double peak = double(phase_peak(p));
    bool below_peak = std::isfinite(peak);
    for (int i = 0; i <= 4096; ++i) {
        const double v = density(2.0 * i / 4096);
        below_peak &= v >= 0 && v <= peak * (1 + 1e-6);
    }
    CHECK(below_peak);
    const double lines = d.straight_on + d.straight_back;
    const double comb = lines > 0 ? 2.0 / kDraws : 0;
    for (int l = 0; l < kPhaseMoments; ++l) {
        CAPTURE(l);
        const double sum = panels.integrate_to(
            2, [&](double x) { return 2 * kPi * density(x) * legendre(l, 1 - x); });
        const double expected = double(phase_moment(p, l));
        const double seen = sum + d.straight_on + (l % 2 == 0 ? 1 : -1) * d.straight_back;
        CHECK(std::fabs(seen - expected) <= kLight + comb);
        worst.light = std::fmax(worst.light, std::fabs(seen - expected) - comb);
    }
    CHECK(std::fabs(d.mean_cosine - double(phase_moment(p, 1))) <= kLight + kComb);
    for (std::size_t c = 0; c < std::size(kCones); ++c) {
        CAPTURE(kCones[c]);
        const double half = std::sin(kCones[c] * kPi / 360), x = 2 * half * half;
        const double sum = panels.integrate_to(x, [&](double at) { return 2 * kPi * density(at); });
        CHECK(std::fabs(forward_share(p, kCones[c]) - sum - d.straight_on) <= kLight + comb);
        // Simpson's rule goes across the corners of a table.
        const double corners = p.type == kPhaseTable ? 1e-4 : 0;
        CHECK(std::fabs(forward_share_by_density(p, kCones[c]) - sum) <= 2 * kLight + corners);
        CHECK(std::fabs(d.within[c] - sum - d.straight_on) <= kLight + kComb);
        const double cone = std::fabs(forward_share(p, kCones[c]) - sum - d.straight_on) - comb;
        worst.cone = std::fmax(worst.cone, cone);
        worst.draws = std::fmax(worst.draws, std::fabs(d.within[c] - sum - d.straight_on));
    }
    CHECK(forward_share(p, 0) == 0);
    CHECK(forward_share(p, 180) == doctest::Approx(1).epsilon(kLight));
}

TEST_CASE("phase rows: light is 1, and draws, moments and cones follow the density") {
    const test::TempFolder folder;
    for (const NamedPhase& type : phase_rows()) {
        int tried = 0;
        Worst worst;
        for (const Case& c : cases_of(type, folder)) {
            CAPTURE(c.name);
            PhaseStore store;
            PhaseParams params;
            const Status status = load_phase("", c.settings, store, params);
            if (!c.settings.file.empty() && !status) continue;
            REQUIRE_MESSAGE(bool(status), status.message);
            CHECK((params.type == kPhaseTable) == (params.table != nullptr));
            CHECK((params.table == nullptr || params.table == store.table.data()));
            check_laws(params, worst);
            ++tried;
        }
        std::printf("%-18s %2d settings: light within %.2g, cones %.2g, draws %.2g\n", type.name,
                    tried, worst.light, worst.cone, worst.draws);
        CHECK_MESSAGE(tried > 0, type.name);
    }
}

TEST_CASE("phase rows: names, keys and the page") {
    std::ifstream file("docs/phase.md");
    const std::string page{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    std::string names;
    for (const NamedPhase& type : phase_rows()) {
        CAPTURE(std::string(type.name));
        names += (names.empty() ? "" : "|") + std::string(type.name);
        CHECK(phase_row_named(type.name) == type.row);
        CHECK(page.find("| `" + std::string(type.name) + "` |") != std::string::npos);
        CHECK((!type.row->one_is_enough || type.row->keys.size == 2));
        for (const KeyRow& key : type.row->keys) {
            CAPTURE(std::string(key.path));
            CHECK(std::string(key.path).find("medium.N.phase.") == 0);
            // Rows that share a key agree on all but its meaning, and the first reads it.
            for (const KeyRow* listed : phase_keys()) {
                if (std::string(listed->path) != key.path) continue;
                CHECK(listed->kind() == key.kind());
                CHECK(allowed_text(*listed) == allowed_text(key));
                CHECK(toml_text(default_value(*listed)) == toml_text(default_value(key)));
                CHECK(std::string(listed->unit) == key.unit);
                // The same words, wherever a compiler keeps them.
                const auto words = [](const char* v) {
                    return std::string(v != nullptr ? v : "-");
                };
                CHECK(words(listed->fallback) == words(key.fallback));
                CHECK(meaning_of(*listed).find(key.help) != std::string::npos);
            }
        }
    }
    CHECK(names == kPhaseNames.text);
    CHECK(phase_row_named("mie") == nullptr);
    PhaseSettings settings;
    settings.type = "mie\n";
    PhaseStore store;
    PhaseParams params;
    CHECK(load_phase("", settings, store, params).message == "phase.type: unknown value, mie\\x0a");
}

TEST_CASE("cornette-shanks: the function of 1992 and its mean cosine") {
    double front = 0, back = 0;
    for (const double g : {-0.99, -0.9, -0.5, -0.1, -1e-4, 0.0, 1e-4, 0.1, 0.1999, 0.2, 0.5, 0.85,
                           0.99, 0.9901, 0.9999}) {
        CAPTURE(g);
        PhaseSettings settings;
        settings.type = "cornette-shanks";
        settings.numbers["g"] = g;
        PhaseStore store;
        PhaseParams params;
        REQUIRE(load_phase("", settings, store, params));
        const double f = double(float(g));
        CHECK(double(phase_moment(params, 1)) ==
              doctest::Approx(3 * f * (4 + f * f) / (5 * (2 + f * f))).epsilon(1e-5).scale(1));
        for (int i = 0; i <= 1000; ++i) {
            // Close to the peak, where float tells angles apart.
            const double share = i / 1000.0;
            const double near = 2 * share * share * share;
            const double x = double(float(f < 0 ? 2 - near : near)), c = 1 - x;
            const double square = (1 - f) * (1 - f) + 2 * f * x;
            const double p = 1.5 * (1 - f * f) / (2 + f * f) * (1 + c * c) /
                             (square * std::sqrt(square)) / (4 * kPi);
            double& worst = f < 0 ? back : front;
            worst = std::fmax(worst, std::fabs(double(phase_density(params, float(x))) / p - 1));
        }
    }
    std::printf("Cornette and Shanks: density within %.3g, %.3g of itself\n", front, back);
    // The lines of the table of 0.9999, whose steps are 2.6e-3 of the angle.
    CHECK(front <= 1.5e-5);
    // Behind, 1 - cos tells angles apart to 0.03 degrees only.
    CHECK(back <= 2e-3);
}

TEST_CASE("cornette-shanks: the kernel of Draine's function draws it from 0.2 to 0.99") {
    double worst = 0;
    for (int step = 0; step <= 79; ++step) {
        PhaseSettings settings;
        settings.type = "cornette-shanks";
        settings.numbers["g"] = 0.2 + 0.01 * step;
        PhaseStore store;
        PhaseParams params;
        REQUIRE(load_phase("", settings, store, params));
        REQUIRE(params.type == kPhaseHgDraine);
        for (int i = 0; i < 4096; ++i) {
            const float u = float(2 * i + 1) / 8192;
            const Turn<float> turn = phase_sample(params, u);
            const Angle angle = from_minus(Real(turn.one_minus_cos));
            worst = std::fmax(worst, std::fabs(double(phase_share(params, angle) - Real(u))));
        }
    }
    std::printf("Cornette and Shanks: light before a draw is u within %.3g\n", worst);
    CHECK(worst <= 1e-6);
}

}  // namespace phase_rows_test
