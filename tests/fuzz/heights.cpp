// SPDX-License-Identifier: Apache-2.0
// Fuzz target: maps of heights of every kind of file.
// in: kind, flags, group, two sides, then the file -> out: a mesh of finite corners with unit
// normals, or one line. docs/solids.md, "Height maps"
#include "src/base/reading_limit.h"
#include "src/io/heights/height_map.h"
#include "src/scene/rows/height_format.h"
#include "tests/fuzz/target.h"

int fuzz::heights(const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t kHead = 5;
    constexpr std::uint64_t kMaxTriangles = 1 << 14;
    if (size < kHead) return 0;
    const auto formats = pileus::height_formats();
    const pileus::HeightFormat& format = formats[data[0] % formats.size];
    pileus::SolidSettings settings;
    pileus::HeightMapSettings& map = settings.heights;
    const int flags = data[1];
    map.raw_type = pileus::HeightType(flags % 3);
    map.raw_big_endian = (flags & 4) != 0;
    map.holes = (flags & 8) != 0 ? pileus::HoleUse::kFill : pileus::HoleUse::kRefuse;
    if ((flags & 16) == 0) map.bounds_m = {{{-10, -20}, {30, 40}}};
    if ((flags & 32) != 0) map.height_m = {-5, 100};
    map.every = 1 + data[2] % 64;
    map.raw_size = {data[3], data[4]};
    pileus::Limits limits;
    limits[pileus::LimitId::kMemory] = 1 << 26;
    const pileus::ReadingLimit readers(limits);
    pileus::Mesh mesh;
    const pileus::Status status =
        pileus::decode_height_map("h", format.extension, fuzz::text_of(data + kHead, size - kHead),
                                  settings, kMaxTriangles, mesh);
    if (!status) {
        fuzz::check_fault(status, "h:", true);
        return 0;
    }
    fuzz::require(mesh.triangles() > 0 && mesh.triangles() <= kMaxTriangles, "as many as allowed");
    fuzz::require(mesh.normals.size() == mesh.corners.size(), "a normal for each corner");
    for (const double v : mesh.corners.span())
        fuzz::require(v >= -pileus::kMaxCoordinate && v <= pileus::kMaxCoordinate,
                      "corners are finite");
    for (std::size_t i = 0; i < mesh.normals.size(); i += 3) {
        const float* n = &mesh.normals[i];
        const float square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
        fuzz::require(square > 0.999f && square < 1.001f && n[2] >= 0, "normals are unit, upwards");
    }
    return 0;
}
