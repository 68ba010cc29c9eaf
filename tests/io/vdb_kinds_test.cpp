// SPDX-License-Identifier: Apache-2.0
// Grids as simulations leave them: empty, a little negative, with twins, with axes exchanged.
// in: small OpenVDB and NanoVDB files made here -> out: pass or fail.
// docs/formats.md, "OpenVDB"; docs/testing.md, label io
#include "src/io/volumes/vdb/vdb_names.h"
#include "src/io/volumes/volume_file.h"
#include "tests/io/nvdb_bytes.h"
#include "tests/io/temp_folder.h"

using namespace pileus;
using namespace pileus::test;

namespace {

/// 2 x 3 x 4 voxels that all differ: x + 2 y + 6 z + 1, cells of 1, 2, 3 m from the origin.
Volume numbered() {
    Volume v;
    v.size = {2, 3, 4};
    REQUIRE(v.density.resize(24, "v"));
    for (std::size_t i = 0; i < 24; ++i) v.density[i] = float(i + 1);
    v.knows_bounds = true;
    v.bounds_m = {{{0, 0, 0}, {2, 6, 12}}};
    return v;
}

std::string vdb_of(const Volume& volume) {
    Buffer<char> bytes;
    REQUIRE(encode_vdb(volume, false, bytes));
    return {bytes.data(), bytes.size()};
}

Status read(const std::string& bytes, Volume& volume, const char* grid = "") {
    return decode_vdb("a.vdb", {bytes.data(), bytes.size()}, grid, VdbLimits(), volume);
}

std::string doubles(const std::vector<double>& values) {
    std::string text(8 * values.size(), '\0');
    for (std::size_t i = 0; i < values.size(); ++i) put_f64(text, 8 * i, values[i]);
    return text;
}

/// The file with an affine map, rows that multiply row vectors, in place of its own.
std::string with_map(std::string bytes, const char* kind, const std::vector<double>& rows) {
    const std::string old = "ScaleTranslateMap";
    const std::size_t at = bytes.find(old) - 4, length = 4 + old.size() + 18 * 8;
    std::string map(4, '\0');
    put(map, 0, std::strlen(kind), 4);
    map += kind + doubles(rows);
    const std::size_t end = bytes.find("Tree_float_5_4_3") + 16 + 4 + 16;
    bytes.replace(at, length, map);
    put(bytes, end, bytes.size(), 8);
    return bytes;
}

/// Voxel of a volume in the world's order.
float at(const Volume& v, int x, int y, int z) {
    return v.density[std::size_t((z * v.size[1] + y) * v.size[0] + x)];
}

}  // namespace

TEST_CASE("grids: without an active voxel they are one cell of clear air") {
    Volume empty = numbered(), v;
    for (float& value : empty.density.span()) value = 0;
    REQUIRE(read(vdb_of(empty), v));
    CHECK(v.size == std::array<int, 3>{1, 1, 1});
    CHECK(v.density[0] == 0.0f);
    // The cell of voxel 0 0 0.
    CHECK(v.bounds_m[0] == Double3{0, 0, 0});
    CHECK(v.bounds_m[1] == Double3{1, 2, 3});
    VolumeHead head;
    const std::string bytes = vdb_of(empty);
    REQUIRE(decode_vdb_head("a.vdb", {bytes.data(), bytes.size()}, "", VdbLimits(), head));
    CHECK(holds(head.detail, "0 active voxels, clear air"));

    std::string nano = plain(kFloat);
    const Places p(kFloat);
    put(nano, kListBytes + p.root + 24, 0, 4);
    for (const std::size_t count : {32u, 36u, 40u}) put(nano, kListBytes + p.tree + count, 0, 4);
    REQUIRE(decode(nano, v));
    CHECK(v.size == std::array<int, 3>{1, 1, 1});
    CHECK(v.density[0] == 0.0f);
}

TEST_CASE("grids: a little below 0 counts as 0, and is counted; more is refused with its number") {
    // The largest is 24, so that -2.4e-4 is the bound.
    Volume given = numbered(), v;
    given.density[5] = -1e-9f;
    given.density[7] = -2.3e-4f;
    REQUIRE(read(vdb_of(given), v));
    CHECK(v.clamped == 2);
    CHECK(v.density[5] == 0.0f);
    CHECK(v.density[7] == 0.0f);
    CHECK(v.density[8] == 9.0f);
    given.density[7] = -2.5e-4f;
    const std::string line = read(vdb_of(given), v).message;
    CHECK(holds(line, "voxel 1 0 1: -0.00025, allowed: a finite number >= 0; down to -0.00024"));
    // Of next to nothing rounding is nothing, too.
    for (float& value : given.density.span()) value = -1e-12f;
    REQUIRE(read(vdb_of(given), v));
    CHECK(v.clamped == 24);

    std::string nano = plain(kFloat);
    const Places p(kFloat);
    put_f32(nano, kListBytes + p.leaf + 96 + 4 * 73, -1e-9f);
    put_f32(nano, kListBytes + p.lower_table() + 8 * 512, -1e-6f);  // of 512 voxels
    REQUIRE(decode(nano, v));
    CHECK(v.clamped == 2);
    put_f32(nano, kListBytes + p.leaf + 96 + 4 * 73, -0.01f);
    CHECK(holds(decode(nano, v).message, "voxel -4095 1 4097: -0.01, allowed"));

    MediumSettings medium;
    const TempFolder folder;
    std::string raw(8, '\0');
    put_f32(raw, 0, 0.5f);
    put_f32(raw, 4, -1e-9f);
    REQUIRE(decode_raw_volume("a.raw", {raw.data(), raw.size()}, RawType::kFloat32, {2, 1, 1},
                              false, v));
    CHECK(v.clamped == 1);
    CHECK(v.density[1] == 0.0f);
    put_f32(raw, 4, -1e-5f);
    const Status low = decode_raw_volume("a.raw", {raw.data(), raw.size()}, RawType::kFloat32,
                                         {2, 1, 1}, false, v);
    CHECK(holds(low.message, "a.raw: density: voxel 1 0 0 (index 1), -1e-05, allowed"));
    const std::string head =
        "Volume \"volumegrid\" \"integer nx\" 2 \"integer ny\" 1 \"integer nz\" 1 \"float "
        "density\" ";
    const std::string little = head + "[0.5 -1e-9]", more = head + "[0.5 -0.1]";
    REQUIRE(decode_pbrt_volume("a.pbrt", {little.data(), little.size()}, v));
    CHECK(v.clamped == 1);
    CHECK(holds(decode_pbrt_volume("a.pbrt", {more.data(), more.size()}, v).message,
                "voxel 1 0 0 (index 1), -0.1, allowed"));
}

TEST_CASE("grids: axes of the world that are exchanged and mirrored") {
    const std::string bytes = vdb_of(numbered());
    Volume v;
    // i runs along z, j along -x, k along y: quarter turns in single precision.
    const double rest = 4.4e-8;
    const std::vector<double> turned = {rest * 5, 0, 5, 0, -2, 2 * rest, 0,  0,
                                        0,        3, 0, 0, 10, 20,       30, 1};
    for (const char* kind : {"AffineMap", "UnitaryMap"}) {
        const Status status = read(with_map(bytes, kind, turned), v);
        REQUIRE_MESSAGE(status, status.message);
        REQUIRE(v.size == std::array<int, 3>{3, 4, 2});
        for (int i = 0; i < 2; ++i)
            for (int j = 0; j < 3; ++j)
                for (int k = 0; k < 4; ++k)
                    CHECK(at(v, 2 - j, k, i) == float(1 + i + 2 * j + 6 * k));
        // Centres: x = 10 - 2 j, y = 20 + 3 k, z = 30 + 5 i, and half a step around.
        CHECK(v.bounds_m[0] == Double3{5, 18.5, 27.5});
        CHECK(v.bounds_m[1] == Double3{11, 30.5, 37.5});
    }
    std::vector<double> sheared = turned;
    sheared[1] = 0.01;
    CHECK(holds(read(with_map(bytes, "AffineMap", sheared), v).message,
                "transform: rotated or sheared, allowed: scale and translation along the axes"));
    sheared = turned;
    sheared[4] = 0, sheared[6] = 2;  // two axes along z
    CHECK(holds(read(with_map(bytes, "AffineMap", sheared), v).message, "rotated or sheared"));

    // NanoVDB: the same of the tile and the leaves, x and y exchanged, z mirrored.
    std::string nano = plain(kFloat);
    for (std::size_t i = 0; i < 9; ++i) put_f64(nano, kListBytes + 384 + 8 * i, 0);
    put_f64(nano, kListBytes + 384 + 8 * 1, 2);    // x of the world by j
    put_f64(nano, kListBytes + 384 + 8 * 3, 0.5);  // y by i
    put_f64(nano, kListBytes + 384 + 8 * 8, -4);   // z by -k
    Volume plain_volume;
    REQUIRE(decode(plain(kFloat), plain_volume));
    const Status status = decode(nano, v);
    REQUIRE_MESSAGE(status, status.message);
    REQUIRE(v.size == std::array<int, 3>{8, 24, 8});
    for (int z = 0; z < 8; ++z)
        for (int y = 0; y < 24; ++y)
            for (int x = 0; x < 8; ++x) CHECK(at(v, x, y, z) == at(plain_volume, y, x, 7 - z));
}

TEST_CASE("grids: density before the first, and the second of two of one name") {
    std::vector<VdbName> names = {{"temperature", "float", true, -1, ""},
                                  {"v", "vec3s", false, -1, ""},
                                  {"density", "float", true, 0, ""},
                                  {"density", "float", true, 1, ""}};
    label_vdb_names(names);
    CHECK(vdb_name_list(names) ==
          "\"temperature\" (float), \"v\" (vec3s), \"density[0]\" (float), \"density[1]\" (float)");
    using List = std::vector<std::size_t>;
    CHECK(vdb_choices(names, "") == List{2, 3, 0});
    CHECK(vdb_choices(names, "density") == List{2, 3});
    CHECK(vdb_choices(names, "density[1]") == List{3});
    CHECK(vdb_choices(names, "temperature[0]") == List{0});
    CHECK(vdb_choices(names, "temperature[1]").empty());
    CHECK(vdb_choices(names, "v") == List{1});
    // A grid may be called so by its maker.
    names.push_back({"density[1]", "float", true, -1, "density[1]"});
    CHECK(vdb_choices(names, "density[1]") == List{4});

    const std::string grid = make_grid(kFloat);
    std::string other = grid;
    const Places p(kFloat);
    put_f32(other, p.lower_table() + 8 * 512, 0.25f);
    const std::string twins = plain(kFloat) + make_file(other, other.size(), kFloat, 0);
    const std::string behind = make_file(other, other.size(), kFloat, 0, "aheat__") + plain(kFloat);
    Volume v;
    const auto tile = [&](const std::string& bytes, const char* name) {
        const Status status = decode({bytes.data(), bytes.size()}, name, v);
        INFO(status.message);
        REQUIRE(status);
        return v.density[20];
    };
    CHECK(tile(twins, "density") == 0.5f);
    CHECK(tile(twins, "density[0]") == 0.5f);
    CHECK(tile(twins, "density[1]") == 0.25f);
    CHECK(tile(behind, "") == 0.5f);
    CHECK(tile(behind, "aheat__") == 0.25f);
    CHECK(holds(decode({twins.data(), twins.size()}, "density[2]", v).message,
                "unknown, \"density[2]\", allowed: \"density[0]\" (float), \"density[1]\""));
}
