// SPDX-License-Identifier: Apache-2.0
// Keys that do not go together are reported at their places, with what is allowed.
// in: small scene texts with one fault each -> out: the expected line of the message.
// docs/scene.md, section Messages.
#include <doctest/doctest.h>

#include <cstdlib>
#include <string>

#include "tests/cli/scene_faults.h"

namespace {

using namespace scene_faults;

TEST_CASE("keys that do not go together") {
    const std::string ortho = kCamera + "projection = \"orthographic\"\n";
    const Row rows[] = {
        {ortho + "fov_deg = 30\n",
         "s.toml:5:1: camera.fov_deg: conflicts with projection "
         "\"orthographic\", 30, allowed: left out"},
        {kCamera + "height_m = 30\n",
         "s.toml:4:1: camera.height_m: conflicts with projection "
         "\"perspective\", 30, allowed: left out"},
        {kCamera + "[collectors]\ndisplay = \"billboards\"\nnode_filter = \"guided\"\n",
         "s.toml:6:15: collectors.node_filter: filters nodes of the march, which billboards have "
         "not, \"guided\", allowed: surroundings, or display = \"march\""},
        {kCamera + "[filter]\nkind = \"regression\"\n",
         "s.toml:5:8: filter.kind: filters pictures of method path alone, \"regression\", allowed: "
         "none, or method.name = \"path\""},
        {kCamera + "projection = \"flux\"\n",
         "s.toml:4:14: camera.projection: measured by no method but path, \"flux\", allowed: "
         "perspective, orthographic with method collectors"},
        {"[camera]\nposition_m = [1, 2, 3]\ntarget_m = [1, 2, 3]\n",
         "s.toml:3:12: camera.target_m: same as position_m, [1, 2, 3], allowed: any other point"},
        {kCamera + "up = [0, -2, 0]\n",
         "s.toml:4:6: camera.up: parallel to the view, [0, -2, 0], allowed: any direction across "
         "target_m - position_m"},
        {"[camera]\nposition_m = [0, 0, 0]\ntarget_m = [0, 0, 9]\n",
         "s.toml:3:12: camera.up: parallel to the view, [0, 0, 1], ..."},
        {kCamera + "up = [0, 0, 0]\n", "s.toml:4:6: camera.up: no direction, [0, 0, 0], ..."},
        {kCamera + "[ground]\naltitude_m = 5.5\n",
         "s.toml:2:14: camera.position_m: below the ground, z 5, allowed: at least "
         "ground.altitude_m 5.5"},
        {kCamera + "[ground]\naltitude_m = 0.5\n" + kMedium,
         "s.toml:8:12: medium.0.bounds_m: below the ground, lowest z 0, allowed: at least "
         "ground.altitude_m 0.5"},
        {kCamera + kMedium + "phase = { type = \"isotropic\", g = 0.5 }\n",
         "s.toml:8:35: medium.0.phase.g: conflicts with phase.type \"isotropic\", 0.5, allowed: "
         "left out"},
        {kCamera + kMedium + "phase = { type = \"henyey-greenstein\" }\n",
         "s.toml:8:18: medium.0.phase.g: missing, nothing, allowed: a number, required by "
         "\"henyey-greenstein\""},
        {kCamera + kMedium + "phase = { type = \"cornette-shanks\" }\n",
         "s.toml:8:18: medium.0.phase.g: missing, nothing, allowed: a number, required by "
         "\"cornette-shanks\""},
        {kCamera + kMedium + "phase = { type = \"two-lobe\", g1 = 0.5, g2 = -0.1 }\n",
         "s.toml:8:18: medium.0.phase.weight: missing, ..."},
        {kCamera + kMedium + "phase = { type = \"cloud\" }\n",
         "s.toml:8:18: medium.0.phase.effective_radius_um: missing, nothing, allowed: a number, or "
         "phase.cloud, required by \"cloud\""},
        {kCamera + kMedium +
             "phase = { type = \"cloud\", cloud = \"fog\", "
             "effective_radius_um = 5 }\n",
         "s.toml:8:35: medium.0.phase.cloud: given twice, \"fog\", allowed: phase.cloud or "
         "phase.effective_radius_um"},
        {kCamera + kMedium + "phase = { type = \"rayleigh\", cloud = \"fog\" }\n",
         "s.toml:8:38: medium.0.phase.cloud: conflicts with phase.type \"rayleigh\", \"fog\", "
         "allowed: left out"},
        {kCamera + kMedium + "phase = { type = \"hg-draine\" }\n",
         "s.toml:8:18: medium.0.phase.droplet_diameter_um: missing, nothing, allowed: a number, "
         "required by \"hg-draine\""},
        {kCamera + kMedium + "phase = { type = \"table\" }\n",
         "s.toml:8:18: medium.0.phase.file: missing, nothing, allowed: a path, required by "
         "\"table\""},
        {kCamera + kMedium + "phase = { type = \"moments\", file = \"\" }\n",
         "s.toml:8:36: medium.0.phase.file: empty, \"\", allowed: the path of a file"},
        {kCamera + kMedium + "phase = { type = \"isotropic\", file = \"a.txt\" }\n",
         "s.toml:8:38: medium.0.phase.file: conflicts with phase.type \"isotropic\", \"a.txt\", "
         "allowed: left out"},
        {kCamera + "[animation]\nsun_elevation_deg = [1, 2]\n",
         "s.toml:5:1: animation.sun_elevation_deg: conflicts with a scene without a sun, [1, 2], "
         "allowed: left out"},
        {"[camera]\nposition_deg = [10, 50, 100]\ntarget_m = [0, 0, 0]\n",
         "s.toml:2:16: camera.position_deg: no map to find it on, [10, 50, 100], allowed: "
         "with a medium of weather data, or camera.position_m"},
        {"[camera]\nposition_m = [0, -9, 5]\ntarget_deg = [10, 95, 100]\n",
         "s.toml:3:14: camera.target_deg: out of range, [10, 95, 100], allowed: longitude "
         "-360 "
         "to 360, latitude -90 to 90, height"},
        {kCamera + "[output]\nfiles = [\"a.png\", \"b.jpg\"]\n",
         "s.toml:5:19: output.files: unknown kind of picture, \"b.jpg\", allowed: .exr, .png, "
         ".pfm, .ppm, .nc"},
        {kCamera + "[output]\nfiles = [\"a.png\", \"a.png\"]\n",
         "s.toml:5:19: output.files: given twice, \"a.png\", allowed: list of up to 16 texts"},
        {kCamera + "[output]\nlayers = [\"depht\"]\n",
         "s.toml:5:11: output.layers: unknown value, \"depht\", allowed: list of radiance, alpha, "
         "depth, error, cloud, optical_depth, transmittance, light, order, reflectance, shadow, "
         "occlusion"},
    };
    for (const Row& row : rows) check(row);
}

TEST_CASE("densities and their files") {
    const std::string box = "bounds_m = [[0, 0, 0], [1, 1, 1]]\n";
    const std::string raw = "density = { file = \"a.raw\", type = \"uint8\", size = [1, 2, 3] }\n";
    const Row rows[] = {
        {kCamera + kFile + "density = \"uniform:cone\"\n" + box,
         "s.toml:6:11: medium.0.density: unknown value, \"uniform:cone\", allowed: "
         "procedural:cumulus, ...the path of a file, or a table"},
        {kCamera + kFile + "density = 3\n", "s.toml:6:11: medium.0.density: wrong type, 3, ..."},
        {kCamera + kFile + "density = \"\"\n", "s.toml:6:11: medium.0.density: empty, \"\", ..."},
        {kCamera + kFile + "density = \"procedural:cumulus\"\n",
         "s.toml:6:11: medium.0.bounds_m: missing, nothing, allowed: [[x, y, z], [x, y, z]], ..."},
        {kCamera + kFile + "density = \"uniform:box\"\nbounds_m = [[0, 0, 2], [1, 1, 1]]\n",
         "s.toml:7:12: medium.0.bounds_m: inverted or empty, [[0, 0, 2], [1, 1, 1]], allowed: "
         "[[x, y, z], [x, y, z]] in [-1e+09, 1e+09], first below second"},
        {kCamera + kFile + "density = \"uniform:box\"\nbounds_m = [[0, 0], [1, 1, 1]]\n",
         "s.toml:7:13: medium.0.bounds_m: wrong length, [0, 0], ..."},
        {kCamera + kFile + "density = \"procedural:cumulus\"\nresolution = [9, 2, 9]\n" + box,
         "s.toml:7:14: medium.0.resolution: too coarse for procedural:cumulus, [9, 2, 9], ..."},
        {kCamera + kMedium + "shape_seed = 1\n",
         "s.toml:8:14: medium.0.shape_seed: for procedural:cumulus... only, 1, allowed: left out"},
        {kCamera + kMedium + "format = \"pbrt\"\n",
         "s.toml:8:10: medium.0.format: for files only, \"pbrt\", allowed: left out"},
        {kCamera + kMedium + "y_up = true\n", "s.toml:8:8: medium.0.y_up: for files only, true..."},
        {kCamera + kFile + "density = \"a.pbrt\"\nresolution = [1, 1, 1]\n",
         "s.toml:7:14: medium.0.resolution: not for a file, [1, 1, 1], allowed: left out"},
        {kCamera + kFile + "density = \"a.f32\"\n",
         "s.toml:6:11: medium.0.density: unknown kind of file, \"a.f32\", allowed: a name that "
         "ends in .pbrt, .raw, .vol, .txt, .les, .vdb, .nvdb, .nc, .nc4, .cdf, .grib, .grib2, "
         ".grb, .grb2, .ply, .csv, .prt, .bgeo, .geo, .bhclassic, .hclassic, .pdb, .pda; or beside "
         "it the "
         "key "
         "format, one of \"pbrt\", \"raw\", \"vol\", \"les\", \"openvdb\", \"nanovdb\", "
         "\"netcdf\", \"grib\", \"ply\", \"csv\", \"prt\", \"bgeo\", \"pdb\", \"pda\"; or "
         "density = { file = \"...\", type = \"float32\", size = [nx, ny, nz] } for a raw file"},
        {kCamera + "[output]\nlayers = [\"occlusion\"]\n",
         "s.toml:5:10: output.layers: by method particles alone, \"occlusion\", allowed: other "
         "layers, or method.name = \"particles\""},
        {kCamera + kFile + "density = { file = \"a.vdb\", share = 0.5 }\n",
         "s.toml:6:37: medium.0.density.share: for files of particles only, 0.5, allowed: left "
         "out"},
        {kCamera + kFile + "density = \"a.ply\"\nbounds_m = [[0, 0, 0], [1, 1, 1]]\n",
         "s.toml:7:12: medium.0.bounds_m: not for particles, [[0, 0, 0], [1, 1, 1]], allowed: left "
         "out"},
        {kCamera + kFile + "density = \"a.ply\"\nboundary = \"periodic\"\n",
         "s.toml:7:12: medium.0.boundary: not for particles, \"periodic\", allowed: left out"},
        {kCamera + kFile + "density = \"a.ply\"\nextinction_scale = 2\n",
         "s.toml:7:20: medium.0.extinction_scale: given twice, 2, allowed: extinction_per_m or "
         "extinction_scale"},
        {kCamera + kFile + "density = { file = \"a.vdb\", time = 3 }\n",
         "s.toml:6:36: medium.0.density.time: for NetCDF files only, 3, allowed: left out"},
        {kCamera +
             "[[medium]]\ndensity = { file = \"a.nc\", ice_dge_um = 40, ice_radius_um = 30 }\n",
         "s.toml:5:61: medium.0.density.ice_radius_um: given twice, 30, allowed: a radius or "
         "ice_dge_um"},
        {kCamera + kFile + "density = \"a.pbrt\"\ngrid = \"d\"\n",
         "s.toml:7:8: medium.0.grid: for OpenVDB and NanoVDB files only, \"d\", allowed: left out"},
        {kCamera + kFile + "density = { file = \"a.vdb\", grid = \"e\" }\ngrid = \"d\"\n",
         "s.toml:6:36: medium.0.density.grid: given twice, \"e\", allowed: grid or density.grid"},
        {kCamera + kFile + "density = { file = \"a.raw\", type = \"int\", size = [1, 1, 1] }\n" +
             box,
         "s.toml:6:36: medium.0.density.type: unknown value, \"int\", allowed: uint8, uint16, "
         "float32"},
        {kCamera + kFile + "density = { file = \"a.raw\", type = \"uint8\" }\n" + box,
         "s.toml:6:11: medium.0.density.size: missing, ..."},
        {kCamera + kFile + "density = { type = \"uint8\", size = [1, 1, 1] }\n" + box,
         "s.toml:6:11: medium.0.density.file: missing, ..."},
        {kCamera + kFile + raw, "s.toml:6:11: medium.0.bounds_m: missing, ..."},
        {kCamera + kFile + "format = \"pbrt\"\ndensity = { file = \"a\", endian = \"big\" }\n",
         "s.toml:7:34: medium.0.density.endian: for raw files only, \"big\", ..."},
        {kCamera + kFile + "density = \"a/${HOME}/b.pbrt\"\n",
         "s.toml:6:11: medium.0.density: unknown variable, \"a/${HOME}/b.pbrt\", allowed: "
         "${PILEUS_DATA_DIR} at the front"},
        {kCamera + kFile + "density = \"a\\u0000.pbrt\"\n",
         "s.toml:6:11: medium.0.density: null byte in text, \"a\\x00.pbrt\", ..."},
    };
    for (const Row& row : rows) check(row);
}

TEST_CASE("a transfer function has rising rows, and nothing beside it says what the medium is") {
    const std::string box =
        "[[medium]]\ndensity = \"uniform:box\"\nbounds_m = [[0, 0, 0], [1, 1, 1]]\n";
    const std::string two =
        "transfer = [{ value = 0, extinction_per_m = 0 }, { value = 1, extinction_per_m = 2 }]\n";
    const std::string nc = "[[medium]]\ndensity = { file = \"a.nc\", variable = \"cc\"";
    const char* const allowed =
        "allowed: list of 2 to 64 tables of value, extinction_per_m, albedo";
    const std::string length =
        std::string("s.toml:7:12: medium.0.transfer: wrong length, 1 rows, ") + allowed;
    const std::string type =
        std::string("s.toml:7:12: medium.0.transfer: wrong type, [1, 2], ") + allowed;
    const Row rows[] = {
        {kCamera + box + "transfer = [{ value = 0, extinction_per_m = 0 }]\n", length.c_str()},
        {kCamera + box + "transfer = [1, 2]\n", type.c_str()},
        {kCamera + box +
             "transfer = [{ value = 1, extinction_per_m = 0 }, { value = 1, extinction_per_m = 2 "
             "}]\n",
         "s.toml:7:60: medium.0.transfer.1.value: not rising, 1, allowed: more than 1, that of the "
         "row before"},
        {kCamera + box +
             "transfer = [{ value = nan, extinction_per_m = 0 }, { value = 1, "
             "extinction_per_m = 2 }]\n",
         "s.toml:7:23: medium.0.transfer.0.value: not finite, nan, ..."},
        {kCamera + box +
             "transfer = [{ value = 0, extinction_per_m = -1 }, { value = 1, "
             "extinction_per_m = 2 }]\n",
         "s.toml:7:45: medium.0.transfer.0.extinction_per_m: out of range, -1, allowed: number in "
         "[0, 1e+12]"},
        {kCamera + box +
             "transfer = [{ value = 0, extinction_per_m = 1, albedo = 2 }, { value = "
             "1, extinction_per_m = 2 }]\n",
         "s.toml:7:57: medium.0.transfer.0.albedo: out of range, 2, ..."},
        {kCamera + box + "transfer = [{ value = 0 }, { value = 1, extinction_per_m = 2 }]\n",
         "s.toml:7:13: medium.0.transfer.0.extinction_per_m: missing, nothing, ..."},
        {kCamera + box +
             "transfer = [{ value = 0, extinction_per_m = 0, color = 1 }, { value = 1, "
             "extinction_per_m = 2 }]\n",
         "s.toml:7:48: medium.0.transfer.0: unknown key, \"color\", allowed: value, "
         "extinction_per_m, albedo"},
        {kCamera + kMedium + two,
         "s.toml:7:20: medium.0.extinction_per_m: conflicts with transfer, 1, allowed: left out"},
        {kCamera + box + "albedo = 0.5\n" + two,
         "s.toml:7:10: medium.0.albedo: conflicts with transfer, 0.5, allowed: left out"},
        {kCamera + "[[medium]]\ndensity = \"a.txt\"\nextinction_scale = 2\n" + two,
         "s.toml:6:20: medium.0.extinction_scale: conflicts with transfer, 2, allowed: left out"},
        {kCamera + nc + " }\n",
         "s.toml:5:39: medium.0.density.variable: shown by a transfer function only, \"cc\", "
         "allowed: left out, or the key transfer"},
        {kCamera + nc + ", ice = \"none\" }\n" + two,
         "s.toml:5:51: medium.0.density.ice: of water, conflicts with variable, \"none\", allowed: "
         "left out"},
        {kCamera + kFile + "density = { file = \"a.vdb\", variable = \"cc\" }\n",
         "s.toml:6:40: medium.0.density.variable: for NetCDF files only, \"cc\", allowed: left "
         "out"},
    };
    for (const Row& row : rows) check(row);
    CHECK(read(kCamera + box + two));
    CHECK(read(kCamera + nc + " }\n" + two));
    // The kind of a sky brings an extinction, which is no fault beside the rows.
    const std::string sky =
        "[[medium]]\ndensity = \"procedural:sky\"\n" + box.substr(box.find("bounds_m")) + two;
    Scene scene;
    REQUIRE(pileus::read_scene_text(kCamera + sky, "s.toml", "", {}, scene));
    CHECK(pileus::check_scene(scene));
}

TEST_CASE("extinction is the scene's or the file's, never both") {
    const std::string bare = "[[medium]]\n";
    const Row rows[] = {
        {kCamera + bare + "density = \"a.txt\"\nextinction_per_m = 0.1\n",
         "s.toml:6:20: medium.0.extinction_per_m: the file holds extinction in 1/m, 0.1, allowed: "
         "left out, or the key extinction_scale"},
        {kCamera + bare + "density = \"a.b\"\nformat = \"les\"\nextinction_per_m = 0.1\n",
         "s.toml:7:20: medium.0.extinction_per_m: the file holds extinction in 1/m, ..."},
        {kCamera + kMedium + "extinction_scale = 1.0\n",
         "s.toml:8:20: medium.0.extinction_scale: for files that hold extinction only, 1, allowed: "
         "left out, and the key extinction_per_m"},
        {kCamera + bare + "density = \"a.vol\"\nextinction_per_m = 1\nextinction_scale = 2\n",
         "s.toml:7:20: medium.0.extinction_scale: for files that hold extinction only, 2, ..."},
        {kCamera + bare + "density = \"a.TXT\"\nextinction_scale = -1\n",
         "s.toml:6:20: medium.0.extinction_scale: out of range, -1, allowed: number in [0, 1e+12]"},
        {kCamera + bare + "density = \"a.VOL\"\n",
         "s.toml:4:1: medium.0.extinction_per_m: missing, nothing, allowed: number in [0, 1e+12]"},
    };
    for (const Row& row : rows) check(row);
}

TEST_CASE("faults of solids and of the camera's depth") {
    const std::string solid = "[[solid]]\nfile = ";
    const Row rows[] = {
        {kCamera + solid + "\"a.stl\"\n",
         "s.toml:5:8: solid.0.file: unknown kind of mesh, \"a.stl\", allowed: .obj, .ply, .gltf, "
         ".glb, .png, .exr, .pfm, .tif, .tiff, .hgt, .raw"},
        {kCamera + solid + "\"a.png\"\nheight_m = [0, 9]\n",
         "s.toml:5:8: solid.0.bounds_m: missing, nothing, allowed: [[x, y], [x, y]], metres"},
        {kCamera + solid + "\"a.png\"\nbounds_m = [[0, 0], [1, 1]]\n",
         "s.toml:5:8: solid.0.height_m: missing, nothing, allowed: 2 numbers, metres, of black and "
         "of white"},
        {kCamera + solid + "\"a.png\"\nbounds_m = [[0, 0], [1, 1]]\nheight_m = [9, 0]\n",
         "s.toml:7:12: solid.0.height_m: inverted or empty, [9, 0], allowed: 2 numbers, first "
         "below "
         "second"},
        {kCamera + solid + "\"a.png\"\nbounds_m = [[0, 0], [1, 0]]\nheight_m = [0, 9]\n",
         "s.toml:6:12: solid.0.bounds_m: inverted or empty, [[0, 0], [1, 0]], ..."},
        {kCamera + solid + "\"a.png\"\nbounds_m = [[0, 0], [1, 1]]\nheight_m = [0, 9]\nscale = 2\n",
         "s.toml:8:1: solid.0.scale: conflicts with height_m, which gives the heights, 2, allowed: "
         "left out"},
        {kCamera + solid + "\"a.tif\"\ny_up = true\n",
         "s.toml:6:1: solid.0.y_up: conflicts with a map of heights, which lies flat, true, "
         "allowed: left out"},
        {kCamera + solid + "\"a.raw\"\nbounds_m = [[0, 0], [1, 1]]\n",
         "s.toml:5:8: solid.0.raw_size: missing, nothing, allowed: 2 whole numbers, columns and "
         "rows"},
        {kCamera + solid + "\"a.hgt\"\nbounds_m = [[0, 0], [1, 1]]\nraw_endian = \"big\"\n",
         "s.toml:7:1: solid.0.raw_endian: conflicts with a map of heights that is no .raw, "
         "\"big\", "
         "allowed: left out"},
        {kCamera + solid + "\"a.pfm\"\nbounds_m = [[0, 0], [1, 1]]\nheight_m = [0, 1]\n",
         "s.toml:7:1: solid.0.height_m: conflicts with samples that are heights as they are, "
         "[0, 1], allowed: left out"},
        {kCamera + solid + "\"a.ply\"\nevery = 2\n",
         "s.toml:6:1: solid.0.every: conflicts with a mesh, which is no map of heights, 2, "
         "allowed: "
         "left out"},
        {kCamera + solid + "\"a.ply\"\nalbedo_map = \"a.ppm\"\n",
         "s.toml:6:14: solid.0.albedo_map: unknown kind of picture, \"a.ppm\", allowed: .exr, "
         ".png, "
         ".pfm"},
        {kCamera + solid + "\"a.ply\"\nalbedo_map = \"a.png\"\nalbedo = 0.5\n",
         "s.toml:7:1: solid.0.albedo: conflicts with albedo_map, which has the colours, 0.5, "
         "allowed: left out"},
        {kCamera + solid + "\"a.ply\"\nalbedo_map_scale = 0.5\n",
         "s.toml:6:1: solid.0.albedo_map_scale: conflicts with a solid without albedo_map, 0.5, "
         "allowed: left out"},
        {kCamera + "[[solid]]\nalbedo = 1\n",
         "s.toml:4:1: solid.0.file: missing, nothing, allowed: text"},
        {kCamera + solid + "\"a.ply\"\nalbedo = 1.5\n",
         "s.toml:6:10: solid.0.albedo: out of range, 1.5, allowed: ..."},
        {kCamera + solid + "\"a.ply\"\nscale = 0\n",
         "s.toml:6:9: solid.0.scale: out of range, 0, allowed: ..."},
        {kCamera + solid + "\"a.glb\"\ny_up = false\n",
         "s.toml:6:1: solid.0.y_up: conflicts with glTF, whose y axis always points up, false, "
         "allowed: left out"},
        {kCamera + "depth = \"z.png\"\n",
         "s.toml:4:9: camera.depth: unknown kind of picture, \"z.png\", allowed: .exr, .pfm"},
        {kCamera + "depth_kind = \"z\"\n",
         "s.toml:4:1: camera.depth_kind: conflicts with a camera without depth, \"z\", allowed: "
         "left "
         "out"},
        {kCamera + "depth = \"z.exr\"\n[animation]\nframes = 2\ncamera_orbit_deg = [0, 9]\n",
         "s.toml:7:1: animation.camera_orbit_deg: conflicts with camera.depth, which one camera "
         "sees where its name has no #, ..."},
        {kCamera + "solid = 1\n", "s.toml:4:1: camera.solid: ..."},
        {"solid = 1\n" + kCamera,
         "s.toml:1:9: solid: wrong type or too many, 1, allowed: up to 64 tables, each headed "
         "[[solid]]"},
    };
    for (const Row& row : rows) check(row);
}

TEST_CASE("a sky is constant or a map") {
    const std::string sky = kCamera + "[sky]\n";
    const Row rows[] = {
        {sky + "radiance = 1\nmap = \"a.exr\"\n",
         "s.toml:5:1: sky.radiance: conflicts with sky.map, 1, allowed: left out"},
        {sky + "map_scale = 2\n",
         "s.toml:5:1: sky.map_scale: conflicts with a sky without a map, 2, allowed: left out"},
        {sky + "radiance = 1\nmap_rotation_deg = 20\n",
         "s.toml:6:1: sky.map_rotation_deg: conflicts with a sky without a map, 20, ..."},
        {sky + "map = \"a.png\"\n",
         "s.toml:5:7: sky.map: unknown kind of picture, \"a.png\", allowed: .exr, .pfm"},
        {sky + "map = \"\"\n", "s.toml:5:7: sky.map: unknown kind of picture, \"\", ..."},
        {sky + "map = \"${HOME}/a.exr\"\n", "s.toml:5:7: sky.map: unknown variable, ..."},
        {sky + "map = 3\n", "s.toml:5:7: sky.map: wrong type, 3, allowed: text"},
        {sky + "map = \"a.exr\"\nmap_scale = -1\n",
         "s.toml:6:13: sky.map_scale: out of range, -1, ..."},
        {sky + "map = \"a.exr\"\nmap_rotation_deg = 361\n",
         "s.toml:6:20: sky.map_rotation_deg: out of range, 361, ..."},
    };
    for (const Row& row : rows) check(row);
}

TEST_CASE("an unset data folder is a fault of the key that asks for it") {
    const char* before = std::getenv("PILEUS_DATA_DIR");
    const std::string saved = before == nullptr ? "" : before;
    unsetenv("PILEUS_DATA_DIR");
    const std::string text = kCamera + kFile + "density = \"${PILEUS_DATA_DIR}/a.pbrt\"\n";
    check({text,
           "s.toml:6:11: medium.0.density: environment variable PILEUS_DATA_DIR is not set, "
           "\"${PILEUS_DATA_DIR}/a.pbrt\", allowed: set it to the folder that holds the "
           "data"});
    setenv("PILEUS_DATA_DIR", "/data", 1);
    Scene scene;
    CHECK(bool(pileus::read_scene_text(text, "s.toml", "d", {}, scene)));
    CHECK(scene.media.at(0).source.file == "/data/a.pbrt");
    CHECK((before == nullptr ? unsetenv("PILEUS_DATA_DIR")
                             : setenv("PILEUS_DATA_DIR", saved.c_str(), 1)) == 0);
}

}  // namespace
