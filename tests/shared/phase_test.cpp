// SPDX-License-Identifier: Apache-2.0
// The I3RC cloud C.1: table to moments, moments to table, and the published lists beside them.
// in: PILEUS_DATA_DIR/data/i3rc/phase_C1 and reference -> out: pass or fail, or why it was skipped.
// docs/phase.md, "Moments"; docs/testing.md, label shared
#include <doctest/doctest.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "src/base/file.h"
#include "src/world/phase/phase_table.h"

using namespace pileus;

namespace {

/// Empty, with a line, where there are no data.
std::string folder() {
    const char* path = std::getenv("PILEUS_DATA_DIR");
    if (path != nullptr && path[0] != '\0') return path;
    std::printf("skipped: PILEUS_DATA_DIR is not set\n");
    return "";
}

/// Second column of a table `l,chi_l,(2l+1) chi_l` with a head.
std::vector<double> published(const std::string& path) {
    Buffer<char> text;
    REQUIRE(read_whole_file(path, 1 << 20, text));
    std::vector<double> list;
    const std::string all(text.data(), text.size());
    for (std::size_t at = all.find('\n'); at != std::string::npos && at + 1 < all.size();
         at = all.find('\n', at + 1)) {
        const std::size_t comma = all.find(',', at);
        double value = 0;
        std::from_chars(all.data() + comma + 1, all.data() + all.size(), value);
        list.push_back(value);
    }
    return list;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
    double largest = 0;
    for (std::size_t l = 0; l < std::min(a.size(), b.size()); ++l)
        largest = std::max(largest, std::fabs(a[l] - b[l]));
    return largest;
}

std::vector<double> moments_of(const PhaseStore& store, std::size_t count) {
    std::vector<double> list(count);
    phase_table_moments(store.table[0], int(count), list.data());
    return list;
}

}  // namespace

TEST_CASE("C.1: the table's moments are the published ones") {
    const std::string data = folder();
    if (data.empty()) return;
    PhaseNodes nodes;
    PhaseStore store;
    REQUIRE(read_phase_table(data + "/data/i3rc/phase_C1/C.1_PF", nodes));
    REQUIRE(nodes.value.size() == 1801);
    REQUIRE(make_phase_table("C.1", nodes, store));
    const std::vector<double> listed = published(data + "/reference/cloud_C1_moments.csv");
    REQUIRE(listed.size() == 300);
    const std::vector<double> own = moments_of(store, listed.size());
    std::printf("C.1 table: mean cosine %.6f, listed %.6f; 300 moments within %.3g\n", own[1],
                listed[1], largest_difference(own, listed));
    CHECK(own[0] == doctest::Approx(1).epsilon(1e-7));
    // Lines between angles 0.1 degrees apart lie above the peak's curve: 4e-4 of the light.
    CHECK(largest_difference(own, listed) <= 5e-4);
    // The light over the sphere as published, half the integral of P over the cosine, is 1.
    const double scale =
        nodes.value[0] / (12.566370614359172954 * double(store.table[0].density[0]));
    std::printf("C.1 table: light over the sphere %.6f\n", scale);
    CHECK(scale == doctest::Approx(1).epsilon(1e-3));
}

TEST_CASE("C.1 and haze L: a table made from the published moments has them") {
    const std::string data = folder();
    if (data.empty()) return;
    for (const char* name : {"cloud_C1_moments.csv", "haze_L_moments.csv"}) {
        const std::vector<double> listed = published(data + "/reference/" + name);
        PhaseStore store;
        double clipped = -1;
        REQUIRE(make_phase_from_moments(name, {listed.data(), listed.size()}, store, clipped));
        const std::vector<double> own = moments_of(store, listed.size());
        std::printf("%s: %zu moments, kept within %.3g; light added where negative: %.3g\n", name,
                    listed.size(), largest_difference(own, listed), clipped);
        // Sixteen lines to a wave of the last degree: 1 - (pi/16)^2/6 of its height, summed twice.
        CHECK(largest_difference(own, listed) <= 1e-4);
        CHECK(clipped <= 1e-6);
    }
}

TEST_CASE("C.1: moments and table are one function") {
    const std::string data = folder();
    if (data.empty()) return;
    PhaseNodes nodes;
    PhaseStore table, series;
    Buffer<double> moments;
    double clipped = 0;
    REQUIRE(read_phase_table(data + "/data/i3rc/phase_C1/C.1_PF", nodes));
    REQUIRE(make_phase_table("C.1", nodes, table));
    REQUIRE(read_phase_moments(data + "/data/i3rc/phase_C1/C.1_leg_coef", moments));
    REQUIRE(make_phase_from_moments("C.1", moments.span(), series, clipped));
    double worst = 0;
    for (double angle = 0; angle <= 180; angle += 0.25) {
        const float x = float(1 - std::cos(angle * 0.0174532925199433));
        const double a = double(phase_density(table.params(), x));
        const double b = double(phase_density(series.params(), x));
        worst = std::max(worst, std::fabs(a / b - 1));
    }
    std::printf("C.1: table against %zu moments, largest relative difference %.3g\n",
                moments.size(), worst);
    // Seven printed digits of the moments are 5e-7 of a peak of 136 against 2e-3 at the side.
    CHECK(worst <= 5e-3);
}
