// SPDX-License-Identifier: Apache-2.0
// Our reader of .nvdb files against the NanoVDB library.
// in: random sparse grids, made by OpenVDB and written by NanoVDB -> out: pass or fail, by voxel.
// docs/testing.md, label foreign
#include <doctest/doctest.h>

// The library packs only where it is told that it may.
#define NANOVDB_USE_ZIP
#define NANOVDB_USE_BLOSC
#include <nanovdb/util/IO.h>
#include <nanovdb/util/OpenToNanoVDB.h>

#include <cstdlib>
#include <string>
#include <vector>

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
using nanovdb::io::Codec;
using Handle = nanovdb::GridHandle<nanovdb::HostBuffer>;

constexpr Codec kCodecs[] = {Codec::NONE, Codec::ZIP, Codec::BLOSC};
constexpr const char* kPackings[] = {"; not packed", "; zip", "; blosc"};

/// Writes by the library as voxels of kind `Build`, reads by ours, and compares with the library's
/// own accessor.
template <class Build, class Grid>
void check_kind(const std::string& path, const Grid& grid, int codec) {
    using Tree = typename Grid::TreeType;
    const Handle handle = nanovdb::openToNanoVDB<nanovdb::HostBuffer, Tree, Build>(grid);
    nanovdb::io::writeGrid(path, handle, kCodecs[codec]);
    const auto* stored = handle.template grid<Build>();
    REQUIRE(stored != nullptr);
    Volume volume;
    const Status status = read_nvdb_volume(path, "density", volume);
    INFO(status.message);
    REQUIRE(status);
    auto values = stored->getAccessor();
    test::check_equal(grid, volume, [&](const vdb::Coord& at, auto&) {
        return float(values.getValue(nanovdb::Coord(at[0], at[1], at[2])));
    });
    VolumeHead head;
    REQUIRE(read_nvdb_head(path, "", head));
    CHECK(head.kind == "NanoVDB fog volume");
    CHECK(head.size == volume.size);
    CHECK(head.bounds_m == volume.bounds_m);
    CHECK(holds(head.detail, kPackings[codec]));
    CHECK(holds(head.detail, std::to_string(grid.activeVoxelCount()) + " active voxels"));
}

/// Values of differing roughness: the library's 0.01 asks for 1, 2, 4, 8 and 16 bits a voxel.
vdb::FloatGrid::Ptr uneven_grid(Draws& draws) {
    auto grid = vdb::FloatGrid::create(0);
    auto access = grid->getAccessor();
    for (int x = 0; x < 40; ++x)
        for (int y = 0; y < 16; ++y)
            for (int z = 0; z < 16; ++z) {
                const float rough[] = {0.01f, 0.05f, 0.25f, 4.0f, 60.0f};
                access.setValue(vdb::Coord(x, y, z), 1.0f + rough[x / 8] * draws.share());
            }
    grid->setName("density");
    grid->setGridClass(vdb::GRID_FOG_VOLUME);
    return grid;
}

/// Which widths its leaves have, a bit for each.
unsigned leaf_widths(const vdb::FloatGrid& grid) {
    const Handle handle =
        nanovdb::openToNanoVDB<nanovdb::HostBuffer, vdb::FloatTree, nanovdb::FpN>(grid);
    auto access = handle.grid<nanovdb::FpN>()->getAccessor();
    unsigned widths = 0;
    for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {
        const vdb::Coord at = leaf->origin();
        widths |= access.probeLeaf(nanovdb::Coord(at[0], at[1], at[2]))->data()->bitWidth();
    }
    return widths;
}

}  // namespace

TEST_CASE("NanoVDB: what the library writes is read voxel by voxel") {
    vdb::initialize();
    const test::TempFolder folder;
    const std::string path = folder.path("a.nvdb");
    Draws draws(1);
    for (int round = 0; round < 54; ++round) {
        INFO("round ", round);
        const int codec = round % 3, kind = round / 3 % 6;
        const bool tiles = round % 2 == 0;
        if (kind == 1) {
            auto grid = random_grid<vdb::DoubleGrid>(draws, tiles);
            grid->setTransform(random_transform(draws, round % 5));
            check_kind<double>(path, *grid, codec);
            continue;
        }
        auto grid = random_grid<vdb::FloatGrid>(draws, tiles);
        grid->setTransform(random_transform(draws, round % 6));
        if (kind == 0) check_kind<float>(path, *grid, codec);
        if (kind == 2) check_kind<nanovdb::Fp4>(path, *grid, codec);
        if (kind == 3) check_kind<nanovdb::Fp8>(path, *grid, codec);
        if (kind == 4) check_kind<nanovdb::Fp16>(path, *grid, codec);
        if (kind == 5) check_kind<nanovdb::FpN>(path, *grid, codec);
    }
    const auto uneven = uneven_grid(draws);
    CHECK(leaf_widths(*uneven) == (1 | 2 | 4 | 8 | 16));
    for (int codec = 0; codec < 3; ++codec) check_kind<nanovdb::FpN>(path, *uneven, codec);
}

TEST_CASE("NanoVDB: grids by name, several segments, and what is refused") {
    vdb::initialize();
    const test::TempFolder folder;
    const std::string path = folder.path("a.nvdb");
    Draws draws(2);
    auto vectors = vdb::Vec3SGrid::create();
    vectors->setName("v");
    vectors->tree().setValue(vdb::Coord(1, 2, 3), vdb::Vec3s(1, 2, 3));
    auto surface = vdb::FloatGrid::create(3.0f);
    surface->setName("surface");
    surface->setGridClass(vdb::GRID_LEVEL_SET);
    surface->tree().setValue(vdb::Coord(0, 0, 0), -1.0f);
    auto density = random_grid<vdb::FloatGrid>(draws, false);
    auto heat = random_grid<vdb::FloatGrid>(draws, true);
    heat->setName("temperature");
    std::vector<Handle> first, second;
    for (const vdb::GridBase::Ptr& grid : vdb::GridPtrVec{vectors, surface, density})
        first.push_back(nanovdb::openToNanoVDB(grid));
    second.push_back(nanovdb::openToNanoVDB(vdb::GridBase::Ptr(heat)));
    {
        std::ofstream file(path, std::ios::binary);
        nanovdb::io::writeGrids(file, first, Codec::ZIP);
        nanovdb::io::writeGrids(file, second, Codec::NONE);
    }

    const auto exact = [](const vdb::Coord& at, auto& access) { return access.getValue(at); };
    Volume volume;
    const Status status = read_nvdb_volume(path, "", volume);
    INFO(status.message);
    REQUIRE(status);
    test::check_equal(*density, volume, exact);
    REQUIRE(read_nvdb_volume(path, "temperature", volume));
    test::check_equal(*heat, volume, exact);
    CHECK(holds(read_nvdb_volume(path, "smoke", volume).message,
                "grid: unknown, \"smoke\", allowed: \"v\" (vec3f), \"surface\" (float), "
                "\"density\" (float), \"temperature\" (float)"));
    CHECK(holds(read_nvdb_volume(path, "v", volume).message, "type vec3f, allowed: float"));
    CHECK(holds(read_nvdb_volume(path, "surface", volume).message, "a level set holds distances"));

    const auto refused = [&](const vdb::GridBase::Ptr& grid, const char* line) {
        nanovdb::io::writeGrid(path, nanovdb::openToNanoVDB(grid));
        const Status fault = read_nvdb_volume(path, "", volume);
        INFO(fault.message);
        CHECK(fault.code == Code::kBadInput);
        CHECK(holds(fault.message, line));
    };
    auto turned = random_grid<vdb::FloatGrid>(draws, false);
    turned->transform().postRotate(0.3, vdb::math::Z_AXIS);
    refused(turned, "transform: rotated or sheared");
    auto mist = vdb::FloatGrid::create(0.5f);
    mist->tree().setValue(vdb::Coord(0, 0, 0), 1.0f);
    refused(mist, "background: 0.5");
    auto negative = vdb::FloatGrid::create();
    negative->tree().setValue(vdb::Coord(-3, 14, 5), -0.25f);
    refused(negative, "voxel -3 14 5: -0.25");
    // A frame in which nothing is left is a frame of nothing.
    nanovdb::io::writeGrid(path,
                           nanovdb::openToNanoVDB(vdb::GridBase::Ptr(vdb::FloatGrid::create())));
    REQUIRE(read_nvdb_volume(path, "", volume));
    for (const float value : volume.density.span()) CHECK(value == 0.0f);
}

TEST_CASE("NanoVDB: the real cloud, voxel by voxel") {
    const char* root = std::getenv("PILEUS_DATA_DIR");
    if (root == nullptr || *root == '\0') {
        MESSAGE("skipped: PILEUS_DATA_DIR is not set");
        return;
    }
    vdb::initialize();
    const test::TempFolder folder;
    for (const char* name : {"cloud", "sphere-div1", "sphere-div2"}) {
        vdb::io::File file(std::string(root) + "/data/vdb/" + name + ".vdb");
        file.open(false);
        const auto grid = vdb::gridPtrCast<vdb::FloatGrid>(file.readGrid("density"));
        REQUIRE(grid);
        check_kind<float>(folder.path("a.nvdb"), *grid, 2);
        check_kind<nanovdb::FpN>(folder.path("a.nvdb"), *grid, 0);
    }
}
