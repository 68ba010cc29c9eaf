// SPDX-License-Identifier: Apache-2.0
// The tables of file formats: no two rows take one file, and every message lists them.
// in: volume_formats, picture_formats, mesh_formats -> out: names, extensions, round trips.
// docs/contributing.md, "Add a file format"; docs/formats.md.
#include <doctest/doctest.h>

#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "src/io/images/image_file.h"
#include "src/io/volumes/volume_file.h"
#include "src/scene/keys/all_keys.h"
#include "src/scene/rows/height_format.h"
#include "src/scene/rows/mesh_format.h"
#include "src/scene/rows/picture_format.h"
#include "src/scene/rows/volume_format.h"
#include "tests/io/temp_folder.h"

namespace format_rows_test {

using namespace pileus;

std::set<std::string> parts(const std::string& list, char bar) {
    std::set<std::string> out;
    std::size_t from = 0;
    for (std::size_t to; (to = list.find(bar, from)) != std::string::npos; from = to + 1)
        CHECK_MESSAGE(out.insert(list.substr(from, to - from)).second, list);
    CHECK_MESSAGE(out.insert(list.substr(from)).second, list);
    return out;
}

std::string file_text(const std::string& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

TEST_CASE("format rows: an extension means one format, and the documents name it") {
    const std::string page = file_text("docs/formats.md"), solids = file_text("docs/solids.md");
    std::set<std::string> names, seen;
    for (const VolumeFormat& format : volume_formats()) {
        CAPTURE(format.name);
        CHECK(names.insert(format.name).second);
        CHECK(volume_format_named(format.name) == &format);
        CHECK((format.read != nullptr && format.read_head != nullptr));
        for (const std::string& extension : parts(format.extensions, '|')) {
            CHECK(seen.insert(extension).second);
            CHECK(volume_format_of("a/b" + extension) == &format);
            CHECK(page.find("`" + extension + "`") != std::string::npos);
            CHECK(volume_format_extensions().find(extension) != std::string::npos);
        }
        CHECK(volume_format_names().find(std::string("\"") + format.name + '"') !=
              std::string::npos);
        // A scene states the place of bare numbers; they can't be told from their head.
        CHECK((!format.bare || !format.has_grids));
    }
    // NetCDF holds grids and pictures; which of them a name means is known where it stands, and
    // none is read as a picture.
    CHECK(seen.erase(".nc") == 1);
    CHECK((picture_format_of("a.nc")->decode == nullptr));
    for (const PictureFormat& format : picture_formats()) {
        CAPTURE(format.extension);
        CHECK(seen.insert(format.extension).second);
        CHECK(picture_format_of(std::string("A") + format.extension) == &format);
        CHECK(page.find(format.extension) != std::string::npos);
        CHECK((format.built || format.library != nullptr));
        CHECK(bool(can_write_image(std::string("a") + format.extension)) == format.built);
    }
    // So PLY is known by where it stands, as a medium or a solid.
    CHECK(seen.erase(".ply") == 1);
    for (const MeshFormat& format : mesh_formats()) {
        CAPTURE(format.extension);
        CHECK(seen.insert(format.extension).second);
        CHECK(mesh_format_of(std::string("A") + format.extension) == &format);
        CHECK(solids.find(format.extension) != std::string::npos);
    }
    // A map of heights is known by where it stands, too, as a solid.
    for (const HeightFormat& format : height_formats()) {
        CAPTURE(format.extension);
        CHECK(height_format_of(std::string("A") + format.extension) == &format);
        CHECK(mesh_format_of(format.extension) == nullptr);
        CHECK(solids.find(std::string("`") + format.extension) != std::string::npos);
    }
    for (const KeyRow* row : all_scene_keys())
        if (std::string(row->path) == "medium.N.format")
            CHECK(std::string(row->allowed.choices) == volume_format_choices());
    CHECK(volume_format_of("a.exr") == nullptr);
    CHECK(picture_format_of("a") == nullptr);
    CHECK(mesh_format_of("Y.OBJ") == mesh_format_of("x.obj"));
}

TEST_CASE("format rows: what a row writes it reads again") {
    const test::TempFolder folder;
    for (const VolumeFormat& format : volume_formats()) {
        // A grid of particles has other cells than the one that they were made of.
        if (format.write == nullptr || format.is_particles) continue;
        CAPTURE(format.name);
        Volume volume, again;
        volume.size = {3, 2, 4};
        REQUIRE(volume.density.resize(24, "test"));
        // Corners are lit, so that a format of active voxels keeps the box.
        for (std::size_t i = 0; i < 24; ++i) volume.density[i] = float(i + 1) / 32;
        MediumSettings medium;
        medium.source.format = format.name;
        medium.source.raw_size = volume.size;
        const std::string path = folder.path(std::string("a.") + format.name);
        REQUIRE(format.write(medium, path, volume));
        REQUIRE(read_volume(medium, path, again));
        CHECK(again.size == volume.size);
        bool same = true;
        for (std::size_t i = 0; i < 24; ++i) same = same && again.density[i] == volume.density[i];
        CHECK(same);
        VolumeHead head;
        REQUIRE(read_volume_head(medium, path, head));
        CHECK(head.size == volume.size);
        CHECK(head.in_extinction == format.in_extinction);
    }
    for (const PictureFormat& format : picture_formats()) {
        if (!format.built || format.decode == nullptr) continue;
        CAPTURE(format.extension);
        Image image, again;
        image.width = 2, image.height = 1;
        for (const char* name : {"R", "G", "B"}) {
            image.channels.emplace_back();
            image.channels.back().name = name;
            REQUIRE(image.channels.back().pixels.resize(2, "test"));
            image.channels.back().pixels[0] = 0.25f;
            image.channels.back().pixels[1] = 0.5f;
        }
        const std::string path = folder.path(std::string("a") + format.extension);
        REQUIRE(write_image(image, path, {}));
        REQUIRE(decode_image(format, path, again, 16));
        CHECK(again.width == 2);
        REQUIRE(again.find("G") != nullptr);
        if (format.radiance) CHECK(again.find("G")->pixels[1] == 0.5f);
    }
}

}  // namespace format_rows_test
