// SPDX-License-Identifier: Apache-2.0
// Maps of heights: exact corners and normals, every kind of file alike, holes, limits, bad files.
// in: small files in memory -> out: pass or fail.
// docs/solids.md, "Height maps".
#include "src/io/heights/height_map.h"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>

#include "src/io/images/image_file.h"
#include "src/io/images/png_samples.h"
#include "src/scene/rows/height_format.h"
#include "tests/io/tiff_bytes.h"

using namespace pileus;

namespace {

constexpr std::uint64_t kTriangles = 1000;

/// Samples of 4 columns and 3 rows that lie on x = 0 .. 3, y = 20 .. 0.
SolidSettings settings_of(int columns = 4, int rows = 3) {
    SolidSettings s;
    s.heights.bounds_m = {{{0, 0}, {3, 20}}};
    s.heights.raw_size = {columns, rows};
    return s;
}

std::string bytes_of_samples(const std::vector<double>& samples, HeightType type, bool big) {
    std::string bytes;
    for (const double v : samples) {
        std::uint32_t bits = std::uint32_t(std::int32_t(v));
        if (type == HeightType::kFloat32) {
            const float f = float(v);
            std::memcpy(&bits, &f, 4);
        }
        const int count = type == HeightType::kFloat32 ? 4 : 2;
        for (int i = 0; i < count; ++i)
            bytes += char(bits >> (8 * (big ? count - 1 - i : i)) & 255);
    }
    return bytes;
}

std::string floats(const std::vector<double>& samples) {
    return bytes_of_samples(samples, HeightType::kFloat32, false);
}

SolidSettings as_floats(SolidSettings s) {
    s.heights.raw_type = HeightType::kFloat32;
    return s;
}

Status decode(const std::string& bytes, const char* extension, const SolidSettings& settings,
              Mesh& mesh, std::uint64_t max_triangles = kTriangles) {
    return decode_height_map("m" + std::string(extension), extension, {bytes.data(), bytes.size()},
                             settings, max_triangles, mesh);
}

std::string fault(const std::string& bytes, const char* extension, const SolidSettings& settings,
                  std::uint64_t max_triangles = kTriangles) {
    Mesh mesh;
    const Status status = decode(bytes, extension, settings, mesh, max_triangles);
    CHECK(!status);
    CHECK(status.message.find('\n') == std::string::npos);
    return status.message;
}

/// h(row, column), row by row.
std::vector<double> samples_of(int columns, int rows, const std::function<double(int, int)>& h) {
    std::vector<double> out;
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c) out.push_back(h(r, c));
    return out;
}

const std::vector<double> kMap =
    samples_of(4, 4, [](int r, int c) { return 1 + 3 * c + 11 * r * r; });

/// Height at a corner of the mesh; NaN: there is none.
double height_at(const Mesh& mesh, double x, double y) {
    for (std::size_t i = 0; i < mesh.corners.size(); i += 3)
        if (std::fabs(mesh.corners[i] - x) + std::fabs(mesh.corners[i + 1] - y) < 1e-9)
            return mesh.corners[i + 2];
    return NAN;
}

bool same(const Mesh& a, const Mesh& b) {
    if (a.corners.size() != b.corners.size() || a.normals.size() != b.normals.size()) return false;
    return std::memcmp(a.corners.data(), b.corners.data(), a.corners.bytes()) == 0 &&
           std::memcmp(a.normals.data(), b.normals.data(), a.normals.bytes()) == 0;
}

std::string picture(const std::vector<double>& samples, int columns, bool exr) {
    Image image;
    image.width = columns, image.height = int(samples.size()) / columns;
    for (const char* name : {"R", "G", "B"}) {
        image.channels.emplace_back();
        image.channels.back().name = name;
        REQUIRE(image.channels.back().pixels.resize(samples.size(), "test"));
        for (std::size_t i = 0; i < samples.size(); ++i)
            image.channels.back().pixels[i] = float(samples[i]);
    }
    Buffer<char> bytes;
    REQUIRE((exr ? encode_exr(image, bytes) : encode_pfm(image, bytes)));
    return {bytes.data(), bytes.size()};
}

std::string png16(const std::vector<double>& samples, int columns) {
    std::vector<std::uint16_t> codes;
    for (const double v : samples) codes.push_back(std::uint16_t(v));
    Buffer<char> bytes;
    REQUIRE(encode_png_samples(columns, int(samples.size()) / columns, {codes.data(), codes.size()},
                               bytes));
    return {bytes.data(), bytes.size()};
}

}  // namespace

TEST_CASE("heights: a plane has exact corners, one normal, and its front above") {
    // h = 5 + x / 2 - y / 4
    const auto plane =
        samples_of(4, 3, [](int r, int c) { return 5 + 0.5 * c - 0.25 * (20 - 10 * r); });
    Mesh mesh;
    REQUIRE(decode(floats(plane), ".raw", as_floats(settings_of()), mesh));
    CHECK(mesh.triangles() == 12);
    const double length = std::sqrt(0.25 + 0.0625 + 1);
    const double normal[3] = {-0.5 / length, 0.25 / length, 1 / length};
    for (std::size_t i = 0; i < mesh.corners.size(); i += 3) {
        const double* p = &mesh.corners[i];
        CHECK(p[2] == 5 + p[0] / 2 - p[1] / 4);
        for (std::size_t a = 0; a < 3; ++a)
            CHECK(double(mesh.normals[i + a]) == doctest::Approx(normal[a]).epsilon(1e-6));
    }
    double area = 0;
    for (std::size_t t = 0; t < mesh.corners.size(); t += 9) {
        const double* p = &mesh.corners[t];
        const double twice = (p[3] - p[0]) * (p[7] - p[1]) - (p[6] - p[0]) * (p[4] - p[1]);
        CHECK(twice > 0);  // counter-clockwise from above
        area += twice / 2;
    }
    CHECK(area == doctest::Approx(60));
}

TEST_CASE("heights: the first row is the north, the first column the west") {
    const auto map = samples_of(4, 3, [](int r, int c) { return 10 * r + c; });
    Mesh mesh;
    REQUIRE(decode(floats(map), ".raw", as_floats(settings_of()), mesh));
    CHECK(height_at(mesh, 0, 20) == 0);
    CHECK(height_at(mesh, 3, 20) == 3);
    CHECK(height_at(mesh, 0, 0) == 20);
    CHECK(height_at(mesh, 1, 10) == 11);
}

TEST_CASE("heights: normals of a hill are those of central differences") {
    const auto hill =
        samples_of(5, 5, [](int r, int c) { return 9 - (c - 2) * (c - 2) - (r - 2) * (r - 2); });
    SolidSettings s = as_floats(settings_of(5, 5));
    s.heights.bounds_m = {{{0, 0}, {4, 4}}};
    Mesh mesh;
    REQUIRE(decode(floats(hill), ".raw", s, mesh));
    for (std::size_t i = 0; i < mesh.corners.size(); i += 3) {
        const double x = mesh.corners[i], y = mesh.corners[i + 1];
        if (x < 1 || x > 3 || y < 1 || y > 3) continue;
        // Of a parabola they are exact: dh/dx = -2 (x - 2).
        const double nx = 2 * (x - 2), ny = 2 * (y - 2), unit = std::sqrt(nx * nx + ny * ny + 1);
        CHECK(double(mesh.normals[i]) == doctest::Approx(nx / unit).epsilon(1e-6));
        CHECK(double(mesh.normals[i + 1]) == doctest::Approx(ny / unit).epsilon(1e-6));
        CHECK(double(mesh.normals[i + 2]) == doctest::Approx(1 / unit).epsilon(1e-6));
    }
}

TEST_CASE("heights: every kind of file that holds a map makes the same triangles") {
    SolidSettings s = settings_of(4, 4);
    Mesh truth;
    REQUIRE(decode(floats(kMap), ".raw", as_floats(s), truth));
    for (const bool big : {false, true})
        for (const HeightType type :
             {HeightType::kInt16, HeightType::kUint16, HeightType::kFloat32}) {
            CAPTURE(int(type));
            s.heights.raw_type = type, s.heights.raw_big_endian = big;
            Mesh mesh;
            REQUIRE(decode(bytes_of_samples(kMap, type, big), ".raw", s, mesh));
            CHECK(same(mesh, truth));
        }
    Mesh hgt, pfm, exr, png;
    REQUIRE(decode(bytes_of_samples(kMap, HeightType::kInt16, true), ".hgt", s, hgt));
    CHECK(same(hgt, truth));
    REQUIRE(decode(picture(kMap, 4, false), ".pfm", s, pfm));
    CHECK(same(pfm, truth));
#ifdef PILEUS_WITH_OPENEXR
    REQUIRE(decode(picture(kMap, 4, true), ".exr", s, exr));
    CHECK(same(exr, truth));
#endif
#ifdef PILEUS_WITH_PNG
    s.heights.height_m = {0, 65535};
    REQUIRE(decode(png16(kMap, 4), ".png", s, png));
    CHECK(same(png, truth));
#endif
    s.heights.height_m = {0, 0};
    for (const bool big : {false, true}) {
        TiffBytes tiff(4, 4, big);
        tiff.samples(kMap, 16, 2);
        Mesh mesh;
        const Status status = decode(tiff.bytes(), ".tif", s, mesh);
        if (without_tiff(status)) return;
        REQUIRE_MESSAGE(status, status.message);
        CHECK(same(mesh, truth));
    }
}

TEST_CASE("heights: whole samples within a range, others times scale") {
    SolidSettings s = settings_of(2, 2);
    s.heights.raw_type = HeightType::kUint16;
    s.heights.height_m = {-100, 900};
    Mesh mesh;
    REQUIRE(
        decode(bytes_of_samples({0, 65535, 0, 0}, HeightType::kUint16, false), ".raw", s, mesh));
    CHECK(height_at(mesh, 0, 20) == -100);
    CHECK(height_at(mesh, 3, 20) == 900);
    s.heights.height_m = {0, 0};
    s.scale = 0.5;
    REQUIRE(decode(bytes_of_samples({0, 7, 0, 0}, HeightType::kUint16, false), ".raw", s, mesh));
    CHECK(height_at(mesh, 3, 20) == 3.5);
    s.heights.raw_type = HeightType::kInt16;
    REQUIRE(decode(bytes_of_samples({0, -7, 0, 0}, HeightType::kInt16, false), ".raw", s, mesh));
    CHECK(height_at(mesh, 3, 20) == -3.5);
}

TEST_CASE("heights: holes are refused, or filled from their row and column") {
    SolidSettings s = as_floats(settings_of(4, 3));
    std::vector<double> map(12, 4);
    map[5] = NAN, map[6] = NAN;
    map[4] = 1, map[7] = 10, map[1] = 3, map[9] = 5;
    CHECK(fault(floats(map), ".raw", s) ==
          "m.raw: samples: 2 without a height, the first in row 1, column 1, allowed: none, or "
          "holes = \"fill\"");
    s.heights.holes = HoleUse::kFill;
    Mesh mesh;
    REQUIRE(decode(floats(map), ".raw", s, mesh));
    // West 1 at one sample, east 10 at two, north 3 and south 5 at one.
    CHECK(height_at(mesh, 1, 10) == doctest::Approx((1 + 10 / 2.0 + 3 + 5) / 3.5).epsilon(1e-6));
    // A cross of holes: what lies in neither row nor column is reached in a second pass.
    map = std::vector<double>(12, 4);
    for (const std::size_t i : {4u, 5u, 6u, 7u, 2u, 10u}) map[i] = NAN;
    REQUIRE(decode(floats(map), ".raw", s, mesh));
    CHECK(height_at(mesh, 2, 10) == doctest::Approx(4));
    CHECK(fault(floats(std::vector<double>(12, NAN)), ".raw", s) ==
          "m.raw: samples: 12 without a height, the first in row 0, column 0, which are all, "
          "allowed: one height or more");
    // Voids of whole numbers.
    s = settings_of(2, 2);
    CHECK(fault(bytes_of_samples({1, 2, -32768, 3}, HeightType::kInt16, true), ".hgt", s)
              .find("1 without a height, the first in row 1, column 0") != std::string::npos);
}

TEST_CASE("heights: the mean of groups of samples, the last of what is left") {
    const auto map = samples_of(5, 4, [](int r, int c) { return 10 * r + c; });
    SolidSettings s = as_floats(settings_of(5, 4));
    s.heights.bounds_m = {{{0, 0}, {4, 3}}};
    s.heights.every = 2;
    Mesh mesh;
    REQUIRE(decode(floats(map), ".raw", s, mesh));
    CHECK(mesh.triangles() == 4);
    CHECK(height_at(mesh, 0.5, 2.5) == 5.5);
    CHECK(height_at(mesh, 4, 0.5) == 29);
}

TEST_CASE("heights: limits hold before there is memory, bad files are one line") {
    const SolidSettings s = as_floats(settings_of());
    const std::string map = floats(std::vector<double>(12, 1));
    CHECK(fault(map, ".raw", s, 11) ==
          "m.raw: limits.triangles: needs 12, allowed: at most 11 (--limit triangles=...)");
    CHECK(fault(map + "x", ".raw", s) ==
          "m.raw: file length: does not fit raw_size, 49 bytes, allowed: exactly 48");
    SolidSettings row = as_floats(settings_of(12, 1));
    CHECK(fault(map, ".raw", row) ==
          "m.raw: size: out of range, 12 x 1, allowed: 2 x 2 to 32768 samples along a side");
    SolidSettings every = s;
    every.heights.every = 3;
    CHECK(fault(map, ".raw", every) ==
          "m.raw: every: too many, 3 of 4 x 3 samples, allowed: less than each side");
    SolidSettings nowhere = s;
    nowhere.heights.bounds_m = {};
    CHECK(fault(map, ".raw", nowhere) == "m.raw: place: the file says none, allowed: bounds_m");
    SolidSettings ranged = s;
    ranged.heights.height_m = {0, 1};
    CHECK(fault(map, ".raw", ranged) ==
          "m.raw: samples: heights as they are, allowed: height_m left out");
    std::vector<double> high(12, 1);
    high[7] = 1e11;
    CHECK(fault(floats(high), ".raw", s).find("row 1, column 3: too high, ") != std::string::npos);
    CHECK(fault("12345", ".hgt", s).find("m.hgt: file length: no square of samples, 5 bytes") == 0);
    CHECK(fault("PF", ".pfm", s).find("m.pfm:1:1: head: not a PFM file") == 0);
    CHECK(fault("no picture", ".png", s).find("m.png: PNG file: ") == 0);
    CHECK(fault("no picture", ".exr", s).find("m.exr") == 0);
    CHECK(fault("no picture", ".tif", s).find("m.tif: TIFF file: ") == 0);
    CHECK(fault(map, ".bmp", s) ==
          "m.bmp: heights: unknown kind of file, .bmp, allowed: .png, .exr, .pfm, .tif, .tiff, "
          ".hgt, .raw");
}

TEST_CASE("heights: a damaged PNG is one line at every length") {
#ifdef PILEUS_WITH_PNG
    SolidSettings s = settings_of();
    s.heights.height_m = {0, 1};
    const std::string png = png16(kMap, 4);
    for (std::size_t length = 0; length < png.size(); ++length)
        CHECK(fault(png.substr(0, length), ".png", s).find("m.png: ") == 0);
#endif
}

TEST_CASE("heights: GeoTIFF says where it lies, of samples that are points or areas") {
    for (const bool point : {false, true}) {
        TiffBytes tiff(4, 4, false);
        tiff.samples(kMap, 32, 3);
        tiff.place(10, 5, 1000, 2000, point);
        SolidSettings s;
        Mesh mesh;
        const Status status = decode(tiff.bytes(), ".tif", s, mesh);
        if (without_tiff(status)) return;
        REQUIRE_MESSAGE(status, status.message);
        // Its corner is the north-west one of a sample, or the sample itself.
        const double x = 1000 + (point ? 0 : 5), y = 2000 - (point ? 0 : 2.5);
        CHECK(height_at(mesh, x, y) == 1);
        CHECK(height_at(mesh, x + 30, y - 15) == 1 + 9 + 99);
        // What the scene says comes first.
        s.heights.bounds_m = {{{0, 0}, {3, 3}}};
        REQUIRE(decode(tiff.bytes(), ".tif", s, mesh));
        CHECK(height_at(mesh, 0, 3) == 1);
    }
}

TEST_CASE("heights: GeoTIFF without a place, in degrees, with holes, of odd samples") {
    SolidSettings s;
    TiffBytes plain(4, 4, false);
    plain.samples(kMap, 16, 2);
    Mesh mesh;
    if (without_tiff(decode(plain.bytes(), ".tif", s, mesh))) return;
    CHECK(fault(plain.bytes(), ".tif", s) == "m.tif: place: the file says none, allowed: bounds_m");
    TiffBytes degrees(4, 4, false);
    degrees.samples(kMap, 16, 2);
    degrees.place(0.1, 0.1, 11, 47, false, 2);
    CHECK(fault(degrees.bytes(), ".tif", s) == "m.tif: place: not in metres, allowed: bounds_m");
    TiffBytes holes(4, 4, false);
    holes.samples(kMap, 16, 2);
    holes.no_data("4");
    CHECK(fault(holes.bytes(), ".tif", settings_of())
              .find("1 without a height, the first in row 0, column 1") != std::string::npos);
    TiffBytes odd(4, 4, false);
    odd.samples(kMap, 16, 3);
    CHECK(
        fault(odd.bytes(), ".tif", settings_of()).find("m.tif: samples: 1 of 16 bits, format 3") ==
        0);
    // Cut anywhere it is one line, or all that counts was there.
    const std::string bytes = plain.bytes();
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        const Status status = decode(bytes.substr(0, length), ".tif", settings_of(), mesh);
        if (!status) CHECK(status.message.find("m.tif: ") == 0);
    }
}
