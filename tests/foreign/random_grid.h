// SPDX-License-Identifier: Apache-2.0
// Random sparse grids of the OpenVDB library, and the comparison of what was read with them.
// in: a seed -> out: grids with tiles and transforms of every kind; pass or fail.
// docs/testing.md, label foreign
#pragma once
#include <doctest/doctest.h>
#include <openvdb/openvdb.h>

#include <cmath>

#include "src/io/volumes/volume.h"

namespace pileus {
namespace test {

namespace vdb = openvdb;

/// A few numbers by counter, so that each case is the same on every machine.
class Draws {
public:
    explicit Draws(std::uint32_t seed) : seed_(seed) {}
    std::uint32_t next() {
        state_ = state_ * 6364136223846793005ull + 1442695040888963407ull + seed_;
        return std::uint32_t(state_ >> 32);
    }
    int below(int n) { return int(next() % std::uint32_t(n)); }
    float share() { return float(next() >> 8) / 16777216.0f; }

private:
    std::uint64_t seed_, state_ = 0x9e3779b97f4a7c15ull;
};

/// Scattered voxels and tiles of 8 and 128 voxels, some active voxels 0, some inactive ones not.
template <class Grid>
typename Grid::Ptr random_grid(Draws& draws, bool tiles) {
    typename Grid::Ptr grid = Grid::create(0);
    auto access = grid->getAccessor();
    const int spread = 1 + draws.below(150), shift = draws.below(9000) - 4500;
    for (int i = 0; i < 400; ++i) {
        const vdb::Coord at(shift + draws.below(spread), draws.below(spread) - shift,
                            draws.below(spread) - 40);
        access.setValue(at, draws.below(10) == 0 ? 0.0f : draws.share() * 4.0f);
        if (draws.below(8) == 0) access.setValueOff(at, draws.share());
    }
    for (int i = 0; tiles && i < 3; ++i) {
        const vdb::Coord at(shift + draws.below(200), draws.below(200) - shift, draws.below(200));
        access.addTile(draws.below(4) == 0 ? 2 : 1, at, draws.share(), draws.below(4) != 0);
    }
    grid->setName("density");
    grid->setGridClass(vdb::GRID_FOG_VOLUME);
    return grid;
}

/// What ours read must be, in the axes and the place of the library's grid; `wanted` gives the
/// value of an active voxel.
template <class Grid, class Wanted>
void check_equal(const Grid& grid, const Volume& volume, Wanted wanted) {
    const vdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
    REQUIRE(volume.size == std::array<int, 3>{box.dim()[0], box.dim()[1], box.dim()[2]});
    auto access = grid.getConstAccessor();
    std::size_t index = 0;
    long wrong = 0;
    for (int z = box.min()[2]; z <= box.max()[2]; ++z)
        for (int y = box.min()[1]; y <= box.max()[1]; ++y)
            for (int x = box.min()[0]; x <= box.max()[0]; ++x) {
                const vdb::Coord at(x, y, z);
                const float right = access.isValueOn(at) ? wanted(at, access) : 0.0f;
                wrong += volume.density[index++] == right ? 0 : 1;
            }
    CHECK(wrong == 0);
    // Rounding of a few products of doubles is all that may differ.
    const vdb::Vec3d low = grid.indexToWorld(box.min().asVec3d() - vdb::Vec3d(0.5));
    const vdb::Vec3d high = grid.indexToWorld(box.max().asVec3d() + vdb::Vec3d(0.5));
    CHECK(volume.knows_bounds);
    for (int a = 0; a < 3; ++a) {
        const double near = 1e-12 * (1 + std::abs(low[a]) + std::abs(high[a]));
        CHECK(std::abs(volume.bounds_m[0][std::size_t(a)] - low[a]) <= near);
        CHECK(std::abs(volume.bounds_m[1][std::size_t(a)] - high[a]) <= near);
    }
}

/// Each kind of map that the reader takes.
inline vdb::math::Transform::Ptr random_transform(Draws& draws, int kind) {
    using namespace vdb::math;
    const vdb::Vec3d scale(0.5 + draws.share(), 0.25 + draws.share(), 2 + draws.share());
    const vdb::Vec3d shift(100 * draws.share(), -draws.share(), 1e4 * draws.share());
    Transform::Ptr transform = Transform::createLinearTransform(0.125);
    if (kind == 1) transform.reset(new Transform(MapBase::Ptr(new ScaleMap(scale))));
    if (kind == 2) transform.reset(new Transform(MapBase::Ptr(new TranslationMap(shift))));
    if (kind == 3)
        transform.reset(new Transform(MapBase::Ptr(new ScaleTranslateMap(scale, shift))));
    if (kind == 4)
        transform.reset(new Transform(MapBase::Ptr(new UniformScaleTranslateMap(0.3, shift))));
    if (kind == 5) {
        Mat4d matrix = Mat4d::identity();
        matrix.setToScale(scale);
        matrix.setTranslation(shift);
        transform.reset(new Transform(MapBase::Ptr(new AffineMap(matrix))));
    }
    return transform;
}

}  // namespace test
}  // namespace pileus
