// SPDX-License-Identifier: Apache-2.0
// The .vol reader and the heads of all formats: known answers, each fault once, hostile bytes.
// in: small files -> out: pass or fail.
// docs/testing.md, label io
#include <doctest/doctest.h>

#include <limits>

#include "src/io/volumes/volume_file.h"
#include "tests/io/temp_folder.h"

using namespace pileus;
using test::holds;

namespace {

std::string word(std::uint32_t value) {
    std::string bytes;
    for (int i = 0; i < 4; ++i) bytes += char(value >> 8 * i & 255);
    return bytes;
}

std::string number(float value) {
    std::uint32_t bits;
    std::memcpy(&bits, &value, 4);
    return word(bits);
}

struct Parts {
    std::string magic = "VOL\x03";
    std::uint32_t type = 1, nx = 2, ny = 1, nz = 3, channels = 1;
    std::vector<float> box{-1, 0, 0.5f, 1, 2, 3}, values{0, 0.5f, 5, 1e-45f, 3e38f, 1};
};

std::string bytes_of(const Parts& parts) {
    std::string bytes = parts.magic + word(parts.type) + word(parts.nx) + word(parts.ny) +
                        word(parts.nz) + word(parts.channels);
    for (const float v : parts.box) bytes += number(v);
    for (const float v : parts.values) bytes += number(v);
    return bytes;
}

template <class Change>
std::string with(Change&& change) {
    Parts parts;
    change(parts);
    return bytes_of(parts);
}

Status decode(const std::string& bytes, Volume& volume) {
    return decode_vol_volume("v.vol", {bytes.data(), bytes.size()}, volume);
}

}  // namespace

TEST_CASE("vol: size, box and values, read and decoded alike") {
    const test::TempFolder folder;
    const std::string path = folder.put("v.vol", bytes_of({}));
    Volume v;
    v.in_extinction = true;
    REQUIRE(read_volume({}, path, v));
    CHECK(v.size == std::array<int, 3>{2, 1, 3});
    CHECK(v.knows_bounds);
    CHECK_FALSE(v.in_extinction);
    CHECK(v.bounds_m[0] == Double3{-1, 0, 0.5});
    CHECK(v.bounds_m[1] == Double3{1, 2, 3});
    const std::vector<float> wanted = Parts().values;
    REQUIRE(v.density.size() == wanted.size());
    for (std::size_t i = 0; i < wanted.size(); ++i) CHECK(v.density[i] == wanted[i]);

    VolumeHead head;
    REQUIRE(read_volume_head({}, path, head));
    CHECK(head.size == v.size);
    CHECK(head.bounds_m == v.bounds_m);
    CHECK(head.kind == "Mitsuba grid volume");
    CHECK_FALSE(head.in_extinction);
}

TEST_CASE("vol: each fault has its line") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    struct Row {
        std::string bytes;
        Code code;
        const char* line;
    };
    const Row rows[] = {
        {"", Code::kBadInput, "v.vol: first bytes: not those of a grid volume, allowed: VOL"},
        {with([](Parts& p) { p.magic = "VOX\x03"; }), Code::kBadInput, "first bytes: not those"},
        {with([](Parts& p) { p.magic = "VOL\x04"; }), Code::kBadInput,
         "version: not supported, 4, allowed: 3"},
        {bytes_of({}).substr(0, 47), Code::kBadInput, "header: cut short, 47 bytes, allowed: at"},
        {with([](Parts& p) { p.type = 3; }), Code::kBadInput,
         "type: not supported, 3, allowed: 1 (float32)"},
        {with([](Parts& p) { p.channels = 3; }), Code::kBadInput,
         "channels: not supported, 3, allowed: 1 (a density)"},
        {with([](Parts& p) { p.ny = 0; }), Code::kBadInput, "ny: out of range, 0, allowed: 1 to"},
        {with([](Parts& p) { p.nz = 0xffffffff; }), Code::kBadInput, "nz: out of range, -1"},
        {with([](Parts& p) { p.nx = p.ny = p.nz = 10000; }), Code::kBadInput, "nx: out of range"},
        {with([](Parts& p) { p.nx = p.ny = p.nz = 4096; }), Code::kLimit, "too many voxels"},
        {with([](Parts& p) { p.nx = p.ny = 1024, p.nz = 2048; }), Code::kBadInput,
         "72 bytes, allowed: exactly 8589934640"},
        {with([](Parts& p) { p.values.pop_back(); }), Code::kBadInput,
         "68 bytes, allowed: exactly 72"},
        {bytes_of({}) + '\n', Code::kBadInput, "73 bytes, allowed: exactly 72"},
        {with([](Parts& p) { p.box[4] = 0; }), Code::kBadInput, "not above the lower on axis 1"},
        {with([&](Parts& p) { p.box[0] = nan; }), Code::kBadInput, "box: out of range, nan"},
        {with([](Parts& p) { p.box[5] = 2e9f; }), Code::kBadInput, "box: out of range, 2000"},
        {with([&](Parts& p) { p.values[4] = nan; }), Code::kBadInput,
         "v.vol: density: voxel 0 0 2 (index 4), nan, allowed: a finite number >= 0"},
        {with([](Parts& p) { p.values[1] = -1, p.values[4] = 1; }), Code::kBadInput,
         "voxel 1 0 0 (index 1), -1"},
    };
    for (const Row& row : rows) {
        Volume volume;
        const Status status = decode(row.bytes, volume);
        INFO(status.message);
        CHECK(status.code == row.code);
        CHECK(holds(status.message, row.line));
    }
}

TEST_CASE("vol: every truncation is a fault, every changed byte ends in a Status") {
    const test::TempFolder folder;
    const std::string good = bytes_of({});
    Volume volume;
    for (std::size_t n = 0; n < good.size(); ++n) {
        INFO(n);
        CHECK(decode(good.substr(0, n), volume).code == Code::kBadInput);
    }
    CHECK(read_volume({}, folder.put("v.vol", good.substr(0, 60)), volume).code == Code::kBadInput);
    for (std::size_t n = 0; n < good.size(); ++n)
        for (const char byte : {'\0', '\x01', '\x7f', '\x80', '\xff'}) {
            std::string bad = good;
            bad[n] = byte;
            const Status status = decode(bad, volume);
            CHECK((status || status.code == Code::kBadInput || status.code == Code::kLimit));
        }
}

TEST_CASE("heads: pbrt with its parameters in any order, raw by its length") {
    const test::TempFolder folder;
    const std::string sizes = "\"integer nx\" 2 \"integer ny\" 1 \"integer nz\" 1 ";
    const std::string points = "\"point p0\" [0 0 0] \"point p1\" [2 1 1] ";
    const std::string values = "\"float density\" [" + std::string(70000, ' ') + "1 2] ";
    for (const std::string& rest : {sizes + points + values, values + points + sizes,
                                    sizes + values, sizes + values + points}) {
        const std::string path = folder.put("v.pbrt", "Volume \"volumegrid\" " + rest);
        VolumeHead head;
        Volume volume;
        const Status status = read_volume_head({}, path, head);
        REQUIRE_MESSAGE(status, status.message);
        REQUIRE(read_volume({}, path, volume));
        CHECK(head.size == volume.size);
        CHECK(head.knows_bounds == volume.knows_bounds);
        CHECK(head.bounds_m == volume.bounds_m);
    }
    VolumeHead head;
    const std::string short_text = "Volume \"volumegrid\" " + sizes;
    CHECK(holds(read_volume_head({}, folder.put("v.pbrt", short_text), head).message,
                "float density: missing"));

    MediumSettings raw;
    raw.source.raw_size = {3, 1, 1};
    raw.source.raw_type = RawType::kUint8;
    REQUIRE(read_volume_head(raw, folder.put("v.raw", "123"), head));
    CHECK(head.size == raw.source.raw_size);
    CHECK(head.kind == "raw numbers, uint8");
    CHECK(read_volume_head(raw, folder.put("v.raw", "12"), head).code == Code::kBadInput);
}
