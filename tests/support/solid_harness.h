// SPDX-License-Identifier: Apache-2.0
// Solid meshes made in memory, for tests of rays against them.
// in: corners -> out: Solids with their tree.
// docs/solids.md.
#pragma once
#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "src/world/solids/solids.h"

namespace pileus {

struct TestMesh {
    std::vector<double> corners;

    void add(const Float3& a, const Float3& b, const Float3& c) {
        for (const Float3& p : {a, b, c}) corners.insert(corners.end(), p.begin(), p.end());
    }
};

/// Triangles as they stand, albedo 1/2.
inline Solids make_solids(const TestMesh& mesh, const SolidSettings& settings = {}) {
    Solids s;
    s.meshes = true;
    REQUIRE(s.triangles.resize(mesh.corners.size() / 9, "triangles"));
    REQUIRE(s.albedo.resize(3, "colours of solids"));
    for (std::size_t c = 0; c < 3; ++c) s.albedo[c] = 0.5f;
    Mesh read;
    REQUIRE(read.corners.resize(mesh.corners.size(), "mesh"));
    std::copy(mesh.corners.begin(), mesh.corners.end(), read.corners.span().begin());
    if (settings.smooth == SmoothUse::kYes) {
        REQUIRE(smooth_mesh(read));
        REQUIRE(s.normals.resize(mesh.corners.size(), "normals"));
    }
    std::uint64_t used = 0;
    const Status placed = place_triangles(settings, "mesh", 0, -1, {0, 0, 0}, read, used, s);
    REQUIRE_MESSAGE(placed, placed.message);
    s.triangles.truncate(std::size_t(used));
    REQUIRE(build_solid_tree(s));
    return s;
}

/// Numbers in [0, 1) that any machine draws alike.
class Luck {
public:
    explicit Luck(std::uint64_t seed) : state_(seed * 2 + 1) {}
    float next() {
        state_ = state_ * 6364136223846793005u + 1442695040888963407u;
        return float(state_ >> 40) * 0x1p-24f;
    }
    float both_ways(float size) { return (next() - 0.5f) * 2 * size; }
    Float3 place(float size) { return {both_ways(size), both_ways(size), both_ways(size)}; }

private:
    std::uint64_t state_;
};

/// A closed ball around the origin out of `rows` x 2 `rows` fields.
inline TestMesh ball_mesh(int rows, float radius) {
    TestMesh mesh;
    const auto place = [&](int r, int c) {
        const double turn = 3.14159265358979 / rows;
        const double theta = r * turn, phi = (c % (2 * rows)) * turn;
        if (r == 0) return Float3{0, 0, radius};
        if (r == rows) return Float3{0, 0, -radius};
        return Float3{float(radius * __builtin_sin(theta) * __builtin_cos(phi)),
                      float(radius * __builtin_sin(theta) * __builtin_sin(phi)),
                      float(radius * __builtin_cos(theta))};
    };
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < 2 * rows; ++c) {
            if (r > 0) mesh.add(place(r, c), place(r + 1, c), place(r, c + 1));
            if (r + 1 < rows) mesh.add(place(r, c + 1), place(r + 1, c), place(r + 1, c + 1));
        }
    return mesh;
}

}  // namespace pileus
