// SPDX-License-Identifier: Apache-2.0
// Our reader and writer of .vdb files against the OpenVDB library.
// in: random sparse grids, and the real cloud -> out: pass or fail, voxel by voxel.
// docs/testing.md, label foreign
#include <doctest/doctest.h>

#include <cstdlib>
#include <string>

#include "kernels_cpu/core/rng.h"
#include "src/io/volumes/vdb/vdb_file.h"
#include "tests/foreign/random_grid.h"
#include "tests/io/temp_folder.h"

using namespace pileus;
using test::Draws;
using test::holds;
using test::random_grid;
using test::random_transform;

namespace {

namespace vdb = openvdb;

template <class Grid>
void check_equal(const Grid& grid, const Volume& volume, bool as_half) {
    test::check_equal(grid, volume, [&](const vdb::Coord& at, auto& access) {
        const float value = float(access.getValue(at));
        return as_half ? float(vdb::math::half(value)) : value;
    });
}

/// The library never zips what is a fog volume by name, so a grid to be zipped has no class.
void write(const std::string& path, const vdb::GridPtrVec& grids, std::uint32_t compression) {
    for (const vdb::GridBase::Ptr& grid : grids)
        if ((compression & vdb::io::COMPRESS_ZIP) != 0 &&
            grid->getGridClass() == vdb::GRID_FOG_VOLUME)
            grid->setGridClass(vdb::GRID_UNKNOWN);
    vdb::io::File file(path);
    file.setCompression(compression);
    file.write(grids);
    file.close();
}

vdb::GridBase::Ptr read_library(const std::string& path) {
    vdb::io::File file(path);
    file.open(false);
    return file.readGrid("density");
}

constexpr std::uint32_t kPackings[] = {
    vdb::io::COMPRESS_NONE,  vdb::io::COMPRESS_ACTIVE_MASK,
    vdb::io::COMPRESS_ZIP,   vdb::io::COMPRESS_ZIP | vdb::io::COMPRESS_ACTIVE_MASK,
    vdb::io::COMPRESS_BLOSC, vdb::io::COMPRESS_BLOSC | vdb::io::COMPRESS_ACTIVE_MASK};

}  // namespace

TEST_CASE("OpenVDB: what the library writes is read voxel by voxel") {
    vdb::initialize();
    const test::TempFolder folder;
    const std::string path = folder.path("a.vdb");
    Draws draws(1);
    for (int round = 0; round < 48; ++round) {
        const bool as_half = round / 6 % 2 == 1, wide = round / 12 % 2 == 1;
        INFO("round ", round);
        Volume volume;
        if (wide) {
            auto grid = random_grid<vdb::DoubleGrid>(draws, round % 3 == 0);
            grid->setTransform(random_transform(draws, round % 6));
            grid->setSaveFloatAsHalf(as_half);
            write(path, {grid}, kPackings[round % 6]);
            const Status status = read_vdb_volume(path, "", volume);
            INFO(status.message);
            REQUIRE(status);
            check_equal(*grid, volume, as_half);
        } else {
            auto grid = random_grid<vdb::FloatGrid>(draws, round % 3 == 0);
            grid->setTransform(random_transform(draws, round % 6));
            grid->setSaveFloatAsHalf(as_half);
            write(path, {grid}, kPackings[round % 6]);
            const Status status = read_vdb_volume(path, "density", volume);
            INFO(status.message);
            REQUIRE(status);
            check_equal(*grid, volume, as_half);
            VolumeHead head;
            REQUIRE(read_vdb_head(path, "", head));
            CHECK(head.size == volume.size);
            const char* const packings[] = {"not packed", "zip", "blosc"};
            CHECK(holds(head.detail, std::string("; ") + packings[round % 6 / 2]));
            CHECK(head.bounds_m == volume.bounds_m);
            CHECK(holds(head.detail, std::to_string(grid->activeVoxelCount()) + " active voxels"));
        }
    }
}

TEST_CASE("OpenVDB: grids by name, instances, and what is refused") {
    vdb::initialize();
    const test::TempFolder folder;
    const std::string path = folder.path("a.vdb");
    Draws draws(2);
    auto vectors = vdb::Vec3SGrid::create();
    vectors->setName("v");
    vectors->tree().setValue(vdb::Coord(1, 2, 3), vdb::Vec3s(1, 2, 3));
    auto surface = vdb::FloatGrid::create(3.0f);
    surface->setName("surface");
    surface->setGridClass(vdb::GRID_LEVEL_SET);
    surface->tree().setValue(vdb::Coord(0, 0, 0), -1.0f);
    auto density = random_grid<vdb::FloatGrid>(draws, false);
    auto heat = random_grid<vdb::FloatGrid>(draws, false);
    heat->setName("temperature");
    vdb::FloatGrid::Ptr twin = density->copy();  // shares the tree
    twin->setName("twin");
    twin->setTransform(vdb::math::Transform::createLinearTransform(7.0));
    write(path, {vectors, surface, density, heat, twin}, vdb::io::COMPRESS_ZIP);

    Volume volume;
    REQUIRE(read_vdb_volume(path, "", volume));
    check_equal(*density, volume, false);
    REQUIRE(read_vdb_volume(path, "temperature", volume));
    check_equal(*heat, volume, false);
    const Status shared = read_vdb_volume(path, "twin", volume);
    INFO(shared.message);
    REQUIRE(shared);
    check_equal(*twin, volume, false);

    const Status unknown = read_vdb_volume(path, "smoke", volume);
    CHECK(unknown.code == Code::kBadInput);
    CHECK(holds(unknown.message,
                "grid: unknown, \"smoke\", allowed: \"v\" (vec3s), \"surface\" "
                "(float), \"density\" (float), \"temperature\" (float), \"twin\""));
    CHECK(holds(read_vdb_volume(path, "v", volume).message, "type \"Tree_vec3s_5_4_3\""));
    CHECK(holds(read_vdb_volume(path, "surface", volume).message, "a level set holds distances"));

    auto turned = random_grid<vdb::FloatGrid>(draws, false);
    turned->transform().postRotate(0.3, vdb::math::Z_AXIS);
    write(path, {turned}, vdb::io::COMPRESS_NONE);
    CHECK(holds(read_vdb_volume(path, "", volume).message, "transform: rotated"));
    auto fan = random_grid<vdb::FloatGrid>(draws, false);
    fan->setTransform(vdb::math::Transform::createFrustumTransform(
        vdb::BBoxd(vdb::Vec3d(0), vdb::Vec3d(10)), 0.5, 5.0));
    write(path, {fan}, vdb::io::COMPRESS_NONE);
    CHECK(holds(read_vdb_volume(path, "", volume).message, "\"NonlinearFrustumMap\""));
    auto mist = vdb::FloatGrid::create(0.5f);
    mist->tree().setValue(vdb::Coord(0, 0, 0), 1.0f);
    write(path, {mist}, vdb::io::COMPRESS_NONE);
    CHECK(holds(read_vdb_volume(path, "", volume).message, "background: 0.5"));
    auto negative = vdb::FloatGrid::create();
    negative->tree().setValue(vdb::Coord(-3, 14, 5), -0.25f);
    write(path, {negative}, vdb::io::COMPRESS_NONE);
    CHECK(holds(read_vdb_volume(path, "", volume).message, "voxel -3 14 5: -0.25"));
}

TEST_CASE("OpenVDB: the library reads what is written, voxel by voxel") {
    vdb::initialize();
    const test::TempFolder folder;
    const std::string path = folder.path("a.vdb");
    Draws draws(3);
    for (int round = 0; round < 12; ++round) {
        Volume volume;
        for (int& side : volume.size) side = 1 + draws.below(round < 11 ? 40 : 200);
        const auto& n = volume.size;
        REQUIRE(volume.density.resize(std::uint64_t(n[0]) * unsigned(n[1]) * unsigned(n[2]), "v"));
        for (float& value : volume.density.span())
            if (draws.below(3) == 0) value = draws.share();
        volume.density[volume.density.size() - 1] = 1;
        volume.knows_bounds = round % 2 == 0;
        volume.bounds_m = {{{-1.5, 2, 1000}, {3, 2.5 + draws.share(), 1001}}};
        Buffer<char> bytes;
        REQUIRE(encode_vdb(volume, round % 3 != 0, bytes));
        folder.put("a.vdb", std::string(bytes.data(), bytes.size()));
        const auto grid = vdb::gridPtrCast<vdb::FloatGrid>(read_library(path));
        REQUIRE(grid);
        CHECK(grid->getGridClass() == vdb::GRID_FOG_VOLUME);
        auto access = grid->getConstAccessor();
        std::size_t index = 0;
        long wrong = 0;
        for (int z = 0; z < n[2]; ++z)
            for (int y = 0; y < n[1]; ++y)
                for (int x = 0; x < n[0]; ++x, ++index) {
                    const float wanted = volume.density[index];
                    const vdb::Coord at(x, y, z);
                    wrong += access.getValue(at) != wanted || access.isValueOn(at) != (wanted != 0);
                }
        CHECK(wrong == 0);
        Volume again;
        REQUIRE(read_vdb_volume(path, "", again));
        check_equal(*grid, again, false);
    }
}

TEST_CASE("OpenVDB: the real cloud, voxel by voxel") {
    const char* root = std::getenv("PILEUS_DATA_DIR");
    if (root == nullptr || *root == '\0') {
        MESSAGE("skipped: PILEUS_DATA_DIR is not set");
        return;
    }
    vdb::initialize();
    for (const char* name : {"cloud", "sphere-div1", "sphere-div2"}) {
        const std::string path = std::string(root) + "/data/vdb/" + name + ".vdb";
        Volume volume;
        REQUIRE(read_vdb_volume(path, "", volume));
        check_equal(*vdb::gridPtrCast<vdb::FloatGrid>(read_library(path)), volume, false);
    }
}
