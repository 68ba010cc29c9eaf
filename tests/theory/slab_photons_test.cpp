// SPDX-License-Identifier: Apache-2.0
// Thirty slabs by photons against the answers of adding and doubling.
// in: tests/theory/slab_list.h -> out: a row for each share; four slabs, all in the long form.
// docs/validation.md
#include "tests/support/validation_rows.h"
#include "tests/theory/adding_doubling.h"
#include "tests/theory/slab_list.h"

using namespace trace_test;
using namespace validation;

namespace {

void check_slab(const slab_list::Case& c, Section& section) {
    const auto answer =
        adding_doubling::solve({c.tau, double(c.albedo), double(c.g)}, {c.mu0}, 64)[0];
    Rig rig = make_slab(c.tau, c.albedo, c.g);
    add_light(rig, beam_light(rig.medium, {std::sqrt(1 - c.mu0 * c.mu0), 0, -c.mu0}));
    const auto measure = [&](auto fate) {
        return [&, fate](int multiple, std::uint64_t seed) {
            const std::uint64_t photons = samples(100'000, 2'000'000);
            const TraceTally t = shoot(rig, photons * std::uint64_t(multiple), seed);
            return share_mean(fate(t.light), t);
        };
    };
    const auto cells = [&](const char* what) {
        return text_of("%g | %g | %g | %g | %s", c.tau, double(c.g), double(c.albedo), c.mu0, what);
    };
    // The solver is good to 1e-7; the sides see 1e-5 of a share at most.
    const double open = 1e-7;
    section.check(text_of("photons: tau %g g %g albedo %g mu0 %g R", c.tau, double(c.g),
                          double(c.albedo), c.mu0),
                  cells("R"), answer.reflected, open,
                  measure([](const Fates& f) { return f.top[0]; }));
    section.check(text_of("photons: tau %g g %g albedo %g mu0 %g T", c.tau, double(c.g),
                          double(c.albedo), c.mu0),
                  cells("T"), answer.transmitted, open,
                  measure([](const Fates& f) { return f.bottom[0]; }));
}

}  // namespace

TEST_CASE("validation: thirty slabs by photons against adding and doubling") {
    Section section("slabs-photons",
                    "| tau | g | albedo | mu0 | share | adding-doubling | photons | standard error "
                    "| z | detectable bias |\n|---|---|---|---|---|---|---|---|---|---|");
    const int count = long_tests() ? 30 : slab_list::kPlain;
    for (int i = 0; i < count; ++i) check_slab(slab_list::kCases[i], section);
}
