// SPDX-License-Identifier: Apache-2.0
// Grids of every format on their way to a picture: one voxel, flat voxels, densities above 1.
// in: the same field written in each format -> out: the same picture, and the optical depth it has.
// docs/testing.md, label io
#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>

#include "src/io/volumes/vdb/vdb_file.h"
#include "src/io/volumes/volume_file.h"
#include "src/world/medium/medium.h"
#include "tests/io/temp_folder.h"
#include "tests/support/render_harness.h"

using namespace pileus;

namespace {

constexpr double kPeak = 0.03;  // extinction of the densest voxel, 1/m

/// A field that grows along each axis.
struct Field {
    std::array<int, 3> size;
    double unit;  ///< its smallest value
    std::vector<float> values;

    Field(std::array<int, 3> cells, double density) : size(cells), unit(density) {
        for (int z = 0; z < size[2]; ++z)
            for (int y = 0; y < size[1]; ++y)
                for (int x = 0; x < size[0]; ++x)
                    values.push_back(float(unit * double(1 + x) * (1 + y) * (1 + z)));
    }
    double peak() const { return unit * size[0] * size[1] * size[2]; }
};

std::string digits(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.12g", value);
    return text;
}

std::string float_bytes(const std::vector<float>& values) {
    std::string bytes;
    for (const float value : values) {
        std::uint32_t bits;
        std::memcpy(&bits, &value, 4);
        for (int i = 0; i < 4; ++i) bytes += char(bits >> 8 * i & 255);
    }
    return bytes;
}

std::string pbrt_text(const Field& f) {
    std::string text = "Volume \"volumegrid\" \"integer nx\" " + std::to_string(f.size[0]) +
                       " \"integer ny\" " + std::to_string(f.size[1]) + " \"integer nz\" " +
                       std::to_string(f.size[2]) + " \"float density\" [";
    for (const float value : f.values) text += ' ' + digits(value);
    return text + "]";
}

std::string vol_bytes(const Field& f) {
    std::string bytes("VOL\x03\x01\0\0\0", 8);
    for (const int n : f.size) bytes += std::string{char(n), '\0', '\0', '\0'};
    bytes += std::string("\x01\0\0\0", 4);
    return bytes + float_bytes({0, 0, 0, 1, 1, 1}) + float_bytes(f.values);
}

/// LWC and r_eff that give kPeak where the field is largest.
std::string les_text(const Field& f) {
    const double scale = kPeak / 1.5 / f.peak();
    std::string text = std::to_string(f.size[0]) + ',' + std::to_string(f.size[1]) + ',' +
                       std::to_string(f.size[2]) + "\n.1,.1\n";
    for (int z = 0; z < f.size[2]; ++z) text += (z > 0 ? "," : "") + std::to_string(z + 1);
    text += "\ni,j,k,lwc,reff\n";
    std::size_t i = 0;
    for (int z = 0; z < f.size[2]; ++z)
        for (int y = 0; y < f.size[1]; ++y)
            for (int x = 0; x < f.size[0]; ++x)
                text += std::to_string(x) + ',' + std::to_string(y) + ',' + std::to_string(z) +
                        ',' + digits(1e6 * scale * f.values[i++]) + ",1000000\n";
    return text;
}

/// A box of 100 x 100 x 40 m in front of a bright sky, seen along y.
render_test::Picture render_file(const std::string& density, double extinction_per_m) {
    std::string text =
        "seed = 3\n[camera]\nposition_m = [0, -1000, 20]\ntarget_m = [0, 0, 20]\n"
        "projection = \"orthographic\"\nheight_m = 40\nresolution = [25, 10]\n"
        "[sky]\nradiance = 1\n[[medium]]\nbounds_m = [[-50, -50, 0], [50, 50, 40]]\nalbedo = 0.5\n"
        "[collectors]\nphotons = 20000\ngenerations = 2\nsamples = 200\n";
    std::vector<std::string> sets{"medium.0.density=" + density};
    if (extinction_per_m > 0)
        sets.push_back("medium.0.extinction_per_m=" + digits(extinction_per_m));
    return render_test::render_one(render_test::scene_from(text, sets));
}

}  // namespace

TEST_CASE("grids: every format, one voxel to flat ones, densities above 1, one picture") {
    const test::TempFolder folder;
    const std::array<int, 3> sizes[] = {{1, 1, 1}, {1, 1, 5}, {3, 1, 2}, {2, 4, 7}, {7, 2, 1}};
    for (const auto& size : sizes)
        for (const double unit : {0.125, 8.0}) {
            const Field field(size, unit);
            INFO(size[0], " ", size[1], " ", size[2], ", unit ", unit);
            const double per_m = kPeak / field.peak();
            const auto quoted = [](const std::string& path) { return '"' + path + '"'; };
            const std::string raw =
                "{file=" + quoted(folder.put("f.raw", float_bytes(field.values))) +
                ",type=\"float32\",size=[" + std::to_string(size[0]) + ',' +
                std::to_string(size[1]) + ',' + std::to_string(size[2]) + "]}";
            const render_test::Picture pictures[] = {
                render_file(quoted(folder.put("f.pbrt", pbrt_text(field))), per_m),
                render_file(raw, per_m),
                render_file(quoted(folder.put("f.vol", vol_bytes(field))), per_m),
                render_file(quoted(folder.put("f.txt", les_text(field))), 0),
            };
            // Densities differ in the last bits of floats, 1e-7, and meet up to 3 optical depths.
            for (int y = 0; y < 10; ++y)
                for (int x = 0; x < 25; ++x)
                    for (const auto& picture : pictures)
                        CHECK(std::fabs(picture.at("A", x, y) - pictures[0].at("A", x, y)) < 2e-6);
            if (size != sizes[0]) continue;
            // One voxel is an even box: 100 m at the peak, 3 optical depths.
            for (const auto& picture : pictures)
                CHECK(std::fabs(picture.at("A", 12, 5) - (1 - std::exp(-3.0))) < 2e-4);
        }
}

TEST_CASE("grids: files in extinction end at density 1, and the scale counts once") {
    const test::TempFolder folder;
    Scene scene;
    scene.media.resize(1);
    MediumSettings& medium = scene.media[0];
    medium.density.clear();
    medium.source.file =
        folder.put("c.txt", "1,1,2\n.1,.1\n.1,.2\ni,j,k,lwc,reff\n0,0,0,.3,9\n0,0,1,.1,9\n");
    medium.optics.extinction_scale = 2;
    Medium loaded;
    REQUIRE(load_medium(scene, medium, 1, loaded));
    CHECK(loaded.density_max == 1.0f);
    CHECK(loaded.volume.density[0] == 1.0f);
    CHECK(std::fabs(loaded.volume.density[1] - 1.0f / 3) < 1e-7f);
    CHECK(loaded.sigma == doctest::Approx(0.1).epsilon(1e-7));
    CHECK(loaded.low_m == Double3{0, 0, 50});

    // Without any water there is nothing to divide by.
    medium.source.file = folder.put("e.txt", "1,1,2\n.1,.1\n.1,.2\ni,j,k,lwc,reff\n");
    Medium empty;
    REQUIRE(load_medium(scene, medium, 1, empty));
    CHECK(empty.sigma == 0.0f);
    CHECK(empty.density_max == 0.0f);
}

TEST_CASE("grids: the report counts what was a little below 0, and an empty .vdb is a clear sky") {
    const test::TempFolder folder;
    const std::vector<float> values = {0.5f, -1e-9f, 0.25f, -1e-7f};
    const std::string raw =
        "{file=\"" + folder.put("f.raw", float_bytes(values)) + "\",type=\"float32\",size=[2,2,1]}";
    CHECK(render_file(raw, 0.01).counter("density_negative") == 2);

    Volume empty;
    empty.size = {2, 2, 2};
    REQUIRE(empty.density.resize(8, "v"));
    Buffer<char> bytes;
    REQUIRE(encode_vdb(empty, false, bytes));
    const std::string file = folder.put("e.vdb", {bytes.data(), bytes.size()});
    const render_test::Picture clear = render_file('"' + file + '"', 0.01);
    CHECK(clear.counter("density_negative") == 0);
    for (const float v : clear.image.find("A")->pixels.span()) CHECK(v == 0.0f);
    for (const float v : clear.image.find("G")->pixels.span()) CHECK(v == 1.0f);
}
