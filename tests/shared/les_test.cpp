// SPDX-License-Identifier: Apache-2.0
// Fields of large-eddy simulations and a .vol grid, read as published.
// in: PILEUS_DATA_DIR/data/les and data/vol -> out: pass or fail, or one line why it was skipped.
// docs/testing.md, label shared
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <string>

#include "platform/clock.h"
#include "src/io/volumes/volume_file.h"

using namespace pileus;

namespace {

struct Facts {
    std::string name;
    std::array<int, 3> size;
    Double3 cell_m;
    double bottom_m;
    int filled;
    double most, mean, mean_depth, most_depth;
};

// Sums of 1.5 LWC / r_eff over the rows, by a separate script in decimal text and doubles.
const Facts kFacts[] = {
    {"les/rico122x106x39.txt",
     {122, 106, 39},
     {20, 20, 40},
     420,
     15905,
     0.10517066233238523,
     0.0005172203356011921,
     0.806863723537861,
     22.03317497605472},
    {"les/rico32x37x26.txt",
     {32, 37, 26},
     {20, 20, 40},
     420,
     3943,
     0.12302496487625635,
     0.0030573126924346764,
     3.1796052001320607,
     25.84797876886887},
    {"les/les_stcu.txt",
     {64, 64, 16},
     {55, 55, 24.975},
     425.2625,
     24789,
     0.2645409429280397,
     0.016996387461682545,
     6.780425504713905 * 24.975 * 15 / 374,
     26.192041525236263 * 24.975 * 15 / 374},
};

void check_field(const std::string& root, const Facts& facts) {
    CAPTURE(facts.name);
    Volume v;
    const double start = cpu_seconds();
    const Status status = read_volume({}, root + "/data/" + facts.name, v);
    const double seconds = cpu_seconds() - start;
    REQUIRE_MESSAGE(status, status.message);
    MESSAGE(facts.name, ": read in ", seconds, " s of CPU");
    CHECK(v.size == facts.size);
    CHECK(v.in_extinction);
    REQUIRE(v.knows_bounds);
    CHECK(v.bounds_m[0][2] == doctest::Approx(facts.bottom_m).epsilon(1e-9));
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double cell = (v.bounds_m[1][axis] - v.bounds_m[0][axis]) / v.size[axis];
        CHECK(cell == doctest::Approx(facts.cell_m[axis]).epsilon(1e-9));
    }

    const std::size_t plane = std::size_t(v.size[0]) * std::size_t(v.size[1]);
    double sum = 0, most = 0, most_depth = 0;
    int filled = 0;
    for (std::size_t column = 0; column < plane; ++column) {
        double depth = 0;
        for (std::size_t i = column; i < v.density.size(); i += plane) {
            depth += double(v.density[i]) * facts.cell_m[2];
            most = std::fmax(most, v.density[i]);
            filled += v.density[i] > 0 ? 1 : 0;
        }
        sum += depth;
        most_depth = std::fmax(most_depth, depth);
    }
    // Floats keep 6e-8 of each value.
    CHECK(filled == facts.filled);
    CHECK(most == doctest::Approx(facts.most).epsilon(1e-7));
    CHECK(sum / double(plane) == doctest::Approx(facts.mean_depth).epsilon(1e-7));
    CHECK(sum / facts.cell_m[2] / double(v.density.size()) ==
          doctest::Approx(facts.mean).epsilon(1e-7));
    CHECK(most_depth == doctest::Approx(facts.most_depth).epsilon(1e-7));
}

}  // namespace

TEST_CASE("LES fields: size, place, extinction and optical depth") {
    const char* root = std::getenv("PILEUS_DATA_DIR");
    if (root == nullptr || *root == '\0') {
        MESSAGE("skipped: PILEUS_DATA_DIR is not set");
        return;
    }
    for (const Facts& facts : kFacts) check_field(root, facts);
}

TEST_CASE("vol grids: a density is read, a colour refused") {
    const char* root = std::getenv("PILEUS_DATA_DIR");
    if (root == nullptr || *root == '\0') {
        MESSAGE("skipped: PILEUS_DATA_DIR is not set");
        return;
    }
    const std::string folder = std::string(root) + "/data/vol/";
    Volume v;
    REQUIRE(read_volume({}, folder + "sigmat.vol", v));
    CHECK(v.size == std::array<int, 3>{16, 16, 16});
    CHECK(v.bounds_m[1] == Double3{1, 1, 1});
    double sum = 0;
    float most = 0;
    int filled = 0;
    for (const float value : v.density.span()) {
        sum += double(value);
        most = value > most ? value : most;
        filled += value > 0 ? 1 : 0;
    }
    CHECK(most == 5.0f);
    CHECK(filled == 2112);
    CHECK(sum / 4096 == doctest::Approx(0.609156635866384).epsilon(1e-12));
    CHECK(read_volume({}, folder + "albedo.vol", v).code == Code::kBadInput);
}
