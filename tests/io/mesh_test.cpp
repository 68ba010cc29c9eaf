// SPDX-License-Identifier: Apache-2.0
// Meshes from files: known triangles of each kind, each fault once, and damaged bytes.
// in: small files in memory -> out: pass or fail.
// docs/solids.md, "Files"; docs/testing.md S5.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>

#include "src/base/file.h"
#include "src/io/meshes/mesh_file.h"
#include "tests/io/temp_folder.h"

using namespace pileus;

namespace {

const std::string kObj =
    "# two squares\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 0.5\nf 1 2 3 4\nf 1 2 5\n";
const std::string kPly =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n1 1 0.25\n0 1 0\n4 0 1 2 3\n";

std::string gltf() {
    // Three corners as floats, then three indices as bytes: (0,0,0) (1,0,0) (0,2,0).
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"mesh":0,"translation":[0,0,4],"children":[1]},{"mesh":0,"scale":[2,2,2]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
"buffers":[{"byteLength":39,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAEAAAAAAAAEC"}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":3}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,2,0]},
{"bufferView":1,"componentType":5121,"count":3,"type":"SCALAR"}]})";
}

Status decode(const std::string& text, const char* extension, Mesh& mesh,
              std::uint64_t most = 1000) {
    return decode_mesh("m" + std::string(extension), extension, {text.data(), text.size()}, most,
                       mesh);
}

}  // namespace

TEST_CASE("mesh: obj and ply, polygons as fans") {
    Mesh mesh;
    REQUIRE(decode(kObj, ".obj", mesh));
    CHECK(mesh.triangles() == 3);
    CHECK(mesh.corners[9 + 6 + 1] == 1.0f);
    CHECK(mesh.corners[18 + 6 + 2] == 0.5f);
    REQUIRE(decode(kPly, ".ply", mesh));
    REQUIRE(mesh.triangles() == 2);
    const float expected[18] = {0, 0, 0, 1, 0, 0, 1, 1, 0.25f, 0, 0, 0, 1, 1, 0.25f, 0, 1, 0};
    for (std::size_t i = 0; i < 18; ++i) CHECK(mesh.corners[i] == expected[i]);
}

TEST_CASE("mesh: places on a map keep their digits, and a mark of UTF-8 is no part of a text") {
    const std::string mark = "\xef\xbb\xbf";
    const std::string obj =
        "v 500000.25 5400000.5 812.125\nv 500001.5 5400000.5 812.125\nv 500000.25 5400001.75 812\n"
        "f 1 2 3\n";
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\n"
        "property double z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
        "500000.25 5400000.5 812.125\n500001.5 5400000.5 812.125\n500000.25 5400001.75 812\n"
        "3 0 1 2\n";
    const double expected[9] = {500000.25, 5400000.5, 812.125,    500001.5, 5400000.5,
                                812.125,   500000.25, 5400001.75, 812};
    for (const std::string& begin : {std::string(), mark}) {
        Mesh mesh;
        REQUIRE(decode(begin + obj, ".obj", mesh));
        REQUIRE(mesh.triangles() == 1);
        for (std::size_t i = 0; i < 9; ++i) CHECK(mesh.corners[i] == expected[i]);
        REQUIRE(decode(begin + ply, ".ply", mesh));
        for (std::size_t i = 0; i < 9; ++i) CHECK(mesh.corners[i] == expected[i]);
    }
    Mesh mesh;
    CHECK(decode(mark + "{}", ".gltf", mesh).code == Code::kBadInput);
}

TEST_CASE("mesh: a ply that states an element twice is refused before anything is read of it") {
    // Room for one vertex by the last count, values for two million by the first.
    std::string text =
        "ply\nformat binary_little_endian 1.0\nelement vertex 2000000\n"
        "property float x\nproperty float y\nproperty float z\n"
        "element vertex 1\nproperty float x\nend_header\n";
    text.append(12 * 2'000'000, 'A');
    Mesh mesh;
    CHECK(decode(text, ".ply", mesh).message ==
          "m.ply:7:8: element vertex: given twice, allowed: once");
    const std::string face = "element face 1\nproperty list uchar int vertex_indices\n";
    text = kPly;
    text.insert(text.find("end_header"), face);
    CHECK(decode(text, ".ply", mesh).message ==
          "m.ply:9:8: element face: given twice, allowed: once");
    text = "ply\nformat ascii 1.0\n";
    for (int i = 0; i < 300; ++i) text += "element e" + std::to_string(i) + " 0\n";
    CHECK(decode(text + "end_header\n", ".ply", mesh).message ==
          "m.ply:259:8: element e256: too many elements, allowed: up to 256");
}

TEST_CASE("mesh: ply vertices have all three numbers of a place") {
    Mesh mesh;
    CHECK(decode("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float z\n"
                 "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                 "0 0\n1 0\n1 1\n3 0 1 2\n",
                 ".ply", mesh)
              .message == "m.ply:9:1: element vertex: no property y, allowed: x, y and z");
}

TEST_CASE("mesh: binary ply of both byte orders, other elements and properties passed over") {
    for (bool big : {false, true}) {
        std::string text = "ply\nformat binary_" + std::string(big ? "big" : "little") +
                           "_endian 1.0\ncomment x\nelement vertex 3\nproperty float64 x\n"
                           "property uchar red\nproperty float y\nproperty short z\n"
                           "element edge 1\nproperty list uchar int list\n"
                           "element face 1\nproperty uchar flag\n"
                           "property list uchar ushort vertex_index\nend_header\n";
        const auto put = [&](auto v) {
            char bytes[sizeof v];
            std::memcpy(bytes, &v, sizeof v);
            const std::uint16_t probe = 1;
            char first;
            std::memcpy(&first, &probe, 1);
            if ((first == 0) != big) std::reverse(bytes, bytes + sizeof v);
            text.append(bytes, sizeof v);
        };
        for (int i = 0; i < 3; ++i)
            put(1.5 * i), put(std::uint8_t(9)), put(0.25f * float(i * i)), put(std::int16_t(-i));
        put(std::uint8_t(2)), put(std::int32_t(7)), put(std::int32_t(8));
        put(std::uint8_t(1)), put(std::uint8_t(3));
        for (int i = 0; i < 3; ++i) put(std::uint16_t(i));
        Mesh mesh;
        const Status status = decode(text, ".ply", mesh);
        REQUIRE_MESSAGE(status, status.message);
        REQUIRE(mesh.triangles() == 1);
        CHECK(mesh.corners[3] == 1.5f);
        CHECK(mesh.corners[7] == 1.0f);
        CHECK(mesh.corners[8] == -2.0f);
        for (std::size_t n = 0; n < text.size(); ++n)
            CHECK_FALSE(decode(text.substr(0, n), ".ply", mesh));
    }
}

TEST_CASE("mesh: glTF places its meshes by nodes within nodes") {
    const test::TempFolder folder;
    const std::string path = folder.path("m.gltf");
    const std::string text = gltf();
    REQUIRE(write_file(path, {text.data(), text.size()}));
    Mesh mesh;
    const Status status = read_mesh(path, Limits(), mesh);
    if (!status && status.message.find("libassimp") != std::string::npos) return;
    if (!status && status.message.find("PILEUS_ASSIMP") != std::string::npos) return;
    REQUIRE_MESSAGE(status, status.message);
    REQUIRE(mesh.triangles() == 2);
    CHECK(mesh.corners[2] == 4.0f);      // moved
    CHECK(mesh.corners[9 + 3] == 2.0f);  // and scaled
    CHECK(mesh.corners[9 + 7] == 4.0f);
    CHECK(mesh.corners[9 + 2] == 4.0f);
}

TEST_CASE("mesh: each fault has its line") {
    Mesh mesh;
    const auto message = [&](const std::string& text, const char* extension,
                             std::uint64_t most = 9) {
        const Status status = decode(text, extension, mesh, most);
        CHECK_FALSE(status);
        CHECK(status.message.find('\n') == std::string::npos);
        return status.message;
    };
    CHECK(message("", ".obj") == "m.obj: mesh: no triangles, allowed: one or more");
    CHECK(message("v 0 0 0\n", ".obj") == "m.obj: mesh: no triangles, allowed: one or more");
    CHECK(message(kObj, ".obj", 2) ==
          "m.obj: limits.triangles: needs 3, allowed: at most 2 (--limit triangles=...)");
    CHECK(message(kObj + "f 1 2 6\n", ".obj") ==
          "m.obj:9:7: f: no such vertex, 6, allowed: 1 to 5");
    CHECK(message(kObj + "f 1 -6 2\n", ".obj") ==
          "m.obj:9:5: f: no such vertex, -6, allowed: 1 to 5");
    CHECK(message(kObj + "f 1 2\n", ".obj") ==
          "m.obj:9:1: f: too few corners, 2, allowed: 3 or more");
    CHECK(message(kObj + "v 1 nan 0\n", ".obj") ==
          "m.obj:9:5: v: out of range, nan, allowed: number in [-1e12, 1e12]");
    CHECK(message(kObj + "v 1 inf 0\n", ".obj").find("out of range, inf") != std::string::npos);
    std::string wild = kPly;
    wild.replace(wild.find("0.25"), 4, "1e30");
    CHECK(message(wild, ".ply").find("vertex: not a number or out of range") != std::string::npos);
    wild = kPly;
    wild.replace(wild.find("vertex 4"), 8, "vertex 999999999999");
    CHECK(message(wild, ".ply").find("m.ply:3:16: element vertex: more than the file can hold") ==
          0);
    wild = kPly;
    wild.replace(wild.find("4 0 1 2 3"), 9, "4 0 1 2 4");
    CHECK(message(wild, ".ply").find("face: no such vertex or length") != std::string::npos);
    CHECK(message("ply\n", ".ply") == "m.ply:2:1: header: no end_header");
    CHECK(message("", ".ply").find("header: ") != std::string::npos);
    CHECK(message("{", ".glb").find("m.glb: mesh: ") == 0);
    CHECK(message("", ".gltf").find("m.gltf: mesh: ") == 0);
    const Status missing = read_mesh("/nowhere/m.obj", Limits(), mesh);
    CHECK(missing.code == Code::kBadInput);
}

TEST_CASE("mesh: whatever is cut off or overwritten, there is an end and a line") {
    for (const auto& file : {std::pair{kObj, ".obj"}, std::pair{kPly, ".ply"}}) {
        for (std::size_t n = 0; n < file.first.size(); n += 3) {
            Mesh mesh;
            const Status cut = decode(file.first.substr(0, n), file.second, mesh);
            if (!cut) CHECK(cut.message.find('\n') == std::string::npos);
            std::string changed = file.first;
            changed[n] = char('0' + n % 75);
            const Status status = decode(changed, file.second, mesh);
            if (status)
                for (double v : mesh.corners.span()) CHECK(v - v == 0.0f);
        }
    }
}
