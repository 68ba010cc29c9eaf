// SPDX-License-Identifier: Apache-2.0
// The reader of NetCDF files: heads, records, blocks, every type, damage.
// in: small files of all three classic versions -> out: pass or fail.
// docs/formats.md; docs/testing.md, label weather
#include <doctest/doctest.h>

#include <cmath>

#include "src/io/netcdf/netcdf_file.h"
#include "tests/support/netcdf_maker.h"

using namespace pileus;
using test::NetcdfMaker;

namespace {

NetcdfMaker two_variables() {
    NetcdfMaker maker;
    maker.records = 3;
    maker.dimension("time", 0);
    maker.dimension("y", 2);
    maker.dimension("x", 3);
    std::vector<double> records, plain;
    for (int i = 0; i < 18; ++i) records.push_back(0.5 * i - 2);
    for (int i = 0; i < 6; ++i) plain.push_back(7 - i);
    maker.variable("a", {"time", "y", "x"}, records, "K").texts.emplace_back("long_name", "abc");
    maker.variable("b", {"y", "x"}, plain).type = NcType::kShort;
    maker.variable("c", {"time"}, {1, 2, 3}).type = NcType::kByte;
    maker.globals.emplace_back("DX", 1000.5);
    return maker;
}

Span<const char> span_of(const std::string& bytes) { return {bytes.data(), bytes.size()}; }

std::vector<double> read(const NcFile& file, const char* name, std::vector<std::uint64_t> start,
                         std::vector<std::uint64_t> count) {
    const NcVariable* v = file.head().find(name);
    REQUIRE(v != nullptr);
    const NcBlock block{start, count};
    std::vector<double> values(std::size_t(block.values()));
    REQUIRE(file.read(*v, block, {values.data(), values.size()}));
    return values;
}

}  // namespace

TEST_CASE("NetCDF: heads and values of all classic versions") {
    for (const int version : {1, 2, 5}) {
        CAPTURE(version);
        const std::string bytes = two_variables().bytes(version);
        NcFile file;
        const Status status = file.open_bytes("t.nc", span_of(bytes));
        REQUIRE_MESSAGE(status, status.message);
        const NcHead& head = file.head();
        REQUIRE(head.dimensions.size() == 3);
        CHECK(head.dimensions[0].unlimited);
        CHECK(head.dimensions[0].size == 3);
        CHECK(head.attribute("DX")->numbers == std::vector<double>{1000.5});
        CHECK(head.find("a")->text("long_name") == "abc");
        CHECK(head.find("a")->by_record);
        CHECK_FALSE(head.find("b")->by_record);
        const std::vector<double> all = read(file, "a", {0, 0, 0}, {3, 2, 3});
        for (int i = 0; i < 18; ++i) CHECK(all[std::size_t(i)] == 0.5 * i - 2);
        CHECK(read(file, "a", {1, 0, 1}, {2, 2, 1}) == std::vector<double>{1.5, 3, 4.5, 6});
        CHECK(read(file, "b", {1, 0}, {1, 3}) == std::vector<double>{4, 3, 2});
        CHECK(read(file, "b", {0, 1}, {2, 2}) == std::vector<double>{6, 5, 3, 2});
        CHECK(read(file, "c", {1}, {2}) == std::vector<double>{2, 3});
    }
}

TEST_CASE("NetCDF: numbers of every type, and records of one variable alone without padding") {
    const double kinds[][2] = {{1, -5},  {3, -300},  {4, -70000}, {5, 0.1f},   {6, 0.1},
                               {7, 200}, {8, 60000}, {9, 4e9},    {10, -5e12}, {11, 5e12}};
    for (const auto& kind : kinds) {
        CAPTURE(kind[0]);
        NetcdfMaker maker;
        maker.records = 3;
        maker.dimension("t", 0);
        maker.variable("v", {"t"}, {1, kind[1], 2}).type = NcType(std::uint32_t(kind[0]));
        const std::string bytes = maker.bytes(5);
        NcFile file;
        REQUIRE(file.open_bytes("t.nc", span_of(bytes)));
        CHECK(read(file, "v", {0}, {3}) == std::vector<double>{1, kind[1], 2});
    }
}

TEST_CASE("NetCDF: a file cut at any byte is one line, never a wrong value") {
    const std::string whole = two_variables().bytes(2);
    for (std::size_t n = 0; n < whole.size(); ++n) {
        CAPTURE(n);
        const std::string cut = whole.substr(0, n);
        NcFile file;
        Status status = file.open_bytes("t.nc", span_of(cut));
        if (status) {
            // The last record's byte has three of padding, which nobody needs.
            const NcVariable* v = file.head().find("c");
            std::vector<double> values(3);
            status = file.read(*v, whole_block(file.head(), *v), {values.data(), 3});
            if (status) CHECK(n + 3 >= whole.size());
        }
        if (status) continue;
        CHECK(status.code == Code::kBadInput);
        CHECK(status.message.find("t.nc: ") == 0);
        CHECK(status.message.find('\n') == std::string::npos);
    }
}

TEST_CASE("NetCDF: what a head declares is not believed") {
    NcFile file;
    const auto fault = [](const std::string& bytes) {
        NcFile broken;
        const Status status = broken.open_bytes("t.nc", span_of(bytes));
        return status ? std::string("no fault") : status.message;
    };
    CHECK(fault("").find("t.nc: no NetCDF file") == 0);
    CHECK(fault("CDF\x03zzzzzzzzzzzz").find("version: unknown, 3") != std::string::npos);
    // 10^18 elements: the head may say so; reading them is refused before memory is taken.
    NetcdfMaker maker;
    maker.dimension("x", 1000000000000000000ull);
    maker.variable("v", {"x"}, {1, 2});
    const std::string bytes = maker.bytes(5);
    NcFile huge;
    const Status opened = huge.open_bytes("t.nc", span_of(bytes));
    CHECK_FALSE(opened);
    CHECK(opened.message.find("t.nc: variable v: more elements than can be counted") == 0);
    // A dimension that is not there, and a list longer than the file.
    std::string wrong = two_variables().bytes(1);
    wrong[8 + 3] = 99;
    CHECK(fault(wrong).find("t.nc: byte") == 0);
}
