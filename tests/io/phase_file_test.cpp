// SPDX-License-Identifier: Apache-2.0
// Phase functions in files: known answers, each fault once with its place, and their limits.
// in: small texts -> out: pass or fail.
// docs/phase.md, "Files"; docs/testing.md S5, S9.
#include "src/io/text/phase_file.h"

#include <doctest/doctest.h>

#include "src/world/phase/medium_phase.h"
#include "tests/io/temp_folder.h"

using namespace pileus;

namespace {

Status decode(const std::string& text, PhaseNodes& nodes) {
    return decode_phase_table("p.txt", {text.data(), text.size()}, nodes);
}
Status decode(const std::string& text, Buffer<double>& moments) {
    return decode_phase_moments("m.txt", {text.data(), text.size()}, moments);
}

struct Row {
    std::string text;
    const char* line;
};

template <class Out>
void check_faults(const std::vector<Row>& rows) {
    for (const Row& row : rows) {
        Out out;
        const Status status = decode(row.text, out);
        CHECK(status.code == Code::kBadInput);
        CHECK_MESSAGE(status.message == row.line, row.text);
    }
}

std::string lines(int count) {
    std::string text = "0 1\n";
    for (int i = 1; i + 1 < count; ++i) text += std::to_string(i / 1000.0) + " 1\n";
    return text + "180 1\n";
}

}  // namespace

TEST_CASE("phase table: comments, blank lines, signs and exponents") {
    PhaseNodes nodes;
    REQUIRE(decode("# angle value\n\n 0.0  +0.17E+04 # peak\r\n\t90 0\n180 1e-4", nodes));
    REQUIRE(nodes.value.size() == 3);
    CHECK(nodes.angle_deg[1] == 90);
    CHECK(nodes.value[0] == 1700);
    CHECK(nodes.value[2] == 1e-4);
}

TEST_CASE("phase table: each fault has its line") {
    check_faults<PhaseNodes>({
        {"", "p.txt:1:1: phase table: wrong number of lines, 0, allowed: 2 to 65536"},
        {"0 1\n", "p.txt:2:1: phase table: wrong number of lines, 1, allowed: 2 to 65536"},
        {"0 1\nx 1\n", "p.txt:2:1: angle: not a number, x"},
        {"0 1\n90\n180 1",
         "p.txt:2:3: value: missing, nothing, allowed: `angle value` on each line"},
        {"0 1\n90 1 2\n180 1", "p.txt:2:6: line: too long, 2, allowed: `angle value` on each line"},
        {"0.1 1\n180 1", "p.txt:1:1: angle: the first is not 0, 0.1, allowed: 0 to 180 degrees"},
        {"0 1\n179.9 1", "p.txt:2:1: angle: the last is not 180, 179.9, allowed: 0 to 180 degrees"},
        {"0 1\n20 1\n20 1\n180 1",
         "p.txt:3:1: angle: not above the one before, 20, allowed: ascending angles"},
        {"0 1\n30 1\n20 1\n180 1",
         "p.txt:3:1: angle: not above the one before, 20, allowed: ascending angles"},
        {"0 1\n180.5 1", "p.txt:2:1: angle: out of range, 180.5, allowed: number in [0, 180]"},
        {"-1 1\n180 1", "p.txt:1:1: angle: out of range, -1, allowed: number in [0, 180]"},
        {"nan 1\n180 1", "p.txt:1:1: angle: out of range, nan, allowed: number in [0, 180]"},
        {"0 1\n180 -1", "p.txt:2:5: value: out of range, -1, allowed: number in [0, 1e+30]"},
        {"0 1\n180 inf", "p.txt:2:5: value: out of range, inf, allowed: number in [0, 1e+30]"},
        {"0 0\n180 0", "p.txt:2:6: value: all are 0, nothing is scattered, allowed: one above 0"},
    });
    PhaseNodes nodes;
    CHECK(decode(lines(65536), nodes));
    CHECK(decode(lines(65537), nodes).message ==
          "p.txt:65537:1: phase table: wrong number of lines, 65537, allowed: 2 to 65536");
}

TEST_CASE("phase moments: known answer and faults") {
    Buffer<double> moments;
    REQUIRE(decode("# HG\n1\n0.5\n 0.25 # two\n", moments));
    REQUIRE(moments.size() == 3);
    CHECK(moments[2] == 0.25);
    check_faults<Buffer<double>>({
        {"\n", "m.txt:2:1: moments: wrong number of lines, 0, allowed: 1 to 4096"},
        {"0.5\n", "m.txt:1:1: moment: out of range, 0.5, allowed: 1, the first"},
        {"1\n-1.5\n", "m.txt:2:1: moment: out of range, -1.5, allowed: number in [-1, 1]"},
        {"1\n0.5 3\n",
         "m.txt:2:5: line: too long, 3, allowed: one moment on each line, without 2l+1"},
        {"1\nnan\n", "m.txt:2:1: moment: out of range, nan, allowed: number in [-1, 1]"},
    });
}

TEST_CASE("phases of a scene: files are read from its folder, and moments must make a phase") {
    const test::TempFolder folder;
    PhaseSettings settings;
    settings.type = "table";
    settings.file = "p.txt";
    PhaseStore store;
    PhaseParams params;
    const std::string path = folder.put("p.txt", "0 2\n180 2\n");
    const std::string directory = path.substr(0, path.size() - 6);
    REQUIRE(load_phase(directory, settings, store, params));
    CHECK(params.table == store.table.data());
    CHECK(double(params.table->peak) == doctest::Approx(1 / 12.566370614359172).epsilon(1e-7));

    // HG of g = 0.9 from 60 moments: g^60 = 0.2 %, so that the sum hardly dips below 0.
    std::string text;
    for (int l = 0; l < 60; ++l) {
        double power = 1;
        for (int i = 0; i < l; ++i) power *= 0.9;
        text += std::to_string(power) + "\n";
    }
    folder.put("m.txt", text);
    settings.type = "moments";
    settings.file = "m.txt";
    REQUIRE(load_phase(directory, settings, store, params));
    CHECK(double(phase_moment(params, 1)) == doctest::Approx(0.9).epsilon(2e-3));

    // Four moments of a narrow peak are negative over half the sphere.
    folder.put("m.txt", "1\n0.9\n0.9\n0.9\n");
    const Status status = load_phase(directory, settings, store, params);
    CHECK(status.code == Code::kBadInput);
    CHECK(status.message.find("m.txt: moments: their sum is negative over 0.") !=
          std::string::npos);
    settings.file = "none.txt";
    CHECK(load_phase(directory, settings, store, params).code == Code::kBadInput);
}
