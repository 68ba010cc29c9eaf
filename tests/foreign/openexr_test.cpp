// SPDX-License-Identifier: Apache-2.0
// What other programs write as OpenEXR: tiles, parts, half floats, windows, packings.
// in: files written by the OpenEXR library -> out: pass or fail, pixel by pixel.
// docs/testing.md, label foreign
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfTiledOutputFile.h>
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "lab/compare/picture.h"
#include "tests/io/temp_folder.h"

using namespace pileus;

namespace {

/// Small whole numbers over 8: exact as half floats, so that every packing without loss keeps them.
float value(int c, int x, int y) { return float((c * 5 + x * 3 + y * 7) % 64) / 8.0f; }

/// Planes of R G B A over a data window.
struct Planes {
    Imath::Box2i window;
    std::vector<float> floats[4];
    std::vector<half> halves[4];
    std::size_t width() const { return std::size_t(window.max.x - window.min.x + 1); }

    explicit Planes(const Imath::Box2i& w) : window(w) {
        for (int c = 0; c < 4; ++c)
            for (int y = w.min.y; y <= w.max.y; ++y)
                for (int x = w.min.x; x <= w.max.x; ++x) {
                    floats[c].push_back(value(c, x, y));
                    halves[c].push_back(half(value(c, x, y)));
                }
    }
    Imf::FrameBuffer frame(const std::string& layer, bool as_half) {
        Imf::FrameBuffer buffer;
        const char* const names[4] = {"R", "G", "B", "A"};
        for (int c = 0; c < 4; ++c) {
            const std::size_t size = as_half ? 2 : 4;
            void* data = as_half ? static_cast<void*>(halves[c].data())
                                 : static_cast<void*>(floats[c].data());
            buffer.insert(layer + names[c], Imf::Slice::Make(as_half ? Imf::HALF : Imf::FLOAT, data,
                                                             window, size, size * width()));
        }
        return buffer;
    }
};

Imf::Header header_of(const Imath::Box2i& display, const Imath::Box2i& window,
                      const std::string& layer, bool as_half, Imf::Compression packing) {
    Imf::Header header(display, window);
    header.compression() = packing;
    for (const char* name : {"R", "G", "B", "A"})
        header.channels().insert(layer + name, Imf::Channel(as_half ? Imf::HALF : Imf::FLOAT));
    return header;
}

/// Everything of the display is there: the window's values inside, 0 outside.
void check_read(const std::string& path, const Imath::Box2i& display, const Imath::Box2i& window) {
    Image image;
    std::string said;
    const Status status = read_picture(path, "", image, said);
    INFO(path << " " << status.message);
    REQUIRE(status);
    REQUIRE(image.width == display.max.x - display.min.x + 1);
    REQUIRE(image.height == display.max.y - display.min.y + 1);
    const char* const names[4] = {"R", "G", "B", "A"};
    std::size_t wrong = 0;
    for (int c = 0; c < 4; ++c) {
        const Channel* channel = image.find(names[c]);
        REQUIRE(channel != nullptr);
        std::size_t i = 0;
        for (int y = display.min.y; y <= display.max.y; ++y)
            for (int x = display.min.x; x <= display.max.x; ++x, ++i)
                wrong += channel->pixels[i] !=
                         (window.intersects(Imath::V2i(x, y)) ? value(c, x, y) : 0.0f);
    }
    CHECK(wrong == 0);
}

const Imath::Box2i kDisplay({0, 0}, {39, 24});
const Imath::Box2i kCropped({5, 3}, {20, 17});
const Imath::Box2i kOver({-4, -6}, {45, 30});

}  // namespace

TEST_CASE("OpenEXR: scanlines of half and float, every packing without loss, any window") {
    const test::TempFolder folder;
    int n = 0;
    for (const Imf::Compression packing :
         {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION,
          Imf::PIZ_COMPRESSION})
        for (const Imath::Box2i& window : {kDisplay, kCropped, kOver})
            for (const bool as_half : {false, true}) {
                const std::string path = folder.path(std::to_string(++n) + ".exr");
                Planes planes(window);
                {
                    Imf::OutputFile file(
                        path.c_str(),
                        header_of(kDisplay, window, "ViewLayer.Combined.", as_half, packing));
                    file.setFrameBuffer(planes.frame("ViewLayer.Combined.", as_half));
                    file.writePixels(int(planes.floats[0].size() / planes.width()));
                }
                check_read(path, kDisplay, window);
            }
}

TEST_CASE("OpenEXR: tiles, one level and many") {
    const test::TempFolder folder;
    for (const Imf::LevelMode mode : {Imf::ONE_LEVEL, Imf::MIPMAP_LEVELS}) {
        const std::string path = folder.path(std::to_string(int(mode)) + ".exr");
        Planes planes(kCropped);
        Imf::Header header = header_of(kDisplay, kCropped, "", true, Imf::ZIP_COMPRESSION);
        header.setTileDescription(Imf::TileDescription(7, 6, mode));
        {
            Imf::TiledOutputFile file(path.c_str(), header);
            file.setFrameBuffer(planes.frame("", true));
            for (int level = 0; level < file.numLevels(); ++level)
                file.writeTiles(0, file.numXTiles(level) - 1, 0, file.numYTiles(level) - 1, level);
        }
        check_read(path, kDisplay, kCropped);
    }
}

TEST_CASE("OpenEXR: of several parts the first") {
    const test::TempFolder folder;
    const std::string path = folder.path("parts.exr");
    Planes planes(kDisplay);
    std::vector<Imf::Header> headers = {
        header_of(kDisplay, kDisplay, "", false, Imf::ZIP_COMPRESSION),
        header_of(kDisplay, kDisplay, "depth.", false, Imf::ZIP_COMPRESSION)};
    for (std::size_t i = 0; i < 2; ++i) {
        headers[i].setName(i == 0 ? "rgba" : "depth");
        headers[i].setType(Imf::SCANLINEIMAGE);
    }
    {
        Imf::MultiPartOutputFile file(path.c_str(), headers.data(), 2);
        for (int i = 0; i < 2; ++i) {
            Imf::OutputPart part(file, i);
            part.setFrameBuffer(planes.frame(i == 0 ? "" : "depth.", false));
            part.writePixels(25);
        }
    }
    check_read(path, kDisplay, kDisplay);
}
