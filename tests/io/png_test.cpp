// SPDX-License-Identifier: Apache-2.0
// PNG files, read back by libpng itself.
// in: small pictures -> out: pass or fail, or one line why it was skipped.
// docs/testing.md, label io
#include "tests/io/temp_folder.h"
#include "tests/io/test_image.h"

#if defined(PILEUS_WITH_PNG) && __has_include(<png.h>)
#define PILEUS_TEST_PNG
#include <png.h>
#endif

using namespace pileus;
using test::holds;

TEST_CASE("png: signature, sRGB chunk and every byte of the picture") {
#ifdef PILEUS_TEST_PNG
    const test::TempFolder folder;
    const Image image = test::make_image(7, 5);
    const std::string path = folder.path("a.png");
    REQUIRE(write_image(image, path, {false, -1.5f}));
    const std::string bytes = folder.get("a.png");
    CHECK(bytes.compare(0, 8, "\x89PNG\r\n\x1a\n") == 0);
    CHECK(holds(bytes, std::string("\0\0\0\x01sRGB\0", 9)));  // rendering intent 0: perceptual
    CHECK(bytes.find("sRGB") < bytes.find("IDAT"));
    CHECK(bytes.find("tIME") == std::string::npos);

    png_image decoded = {};
    decoded.version = PNG_IMAGE_VERSION;
    REQUIRE(png_image_begin_read_from_memory(&decoded, bytes.data(), bytes.size()) != 0);
    CHECK(decoded.width == 7);
    CHECK(decoded.height == 5);
    decoded.format = PNG_FORMAT_RGB;
    std::vector<std::uint8_t> read(PNG_IMAGE_SIZE(decoded));
    REQUIRE(png_image_finish_read(&decoded, nullptr, read.data(), 0, nullptr) != 0);
    Buffer<std::uint8_t> rgb;
    REQUIRE(tone_map_8bit(image, {false, -1.5f}, rgb));
    REQUIRE(read.size() == rgb.size());
    CHECK(std::memcmp(read.data(), rgb.data(), rgb.size()) == 0);
#else
    MESSAGE("skipped: PNG is left out of this build");
#endif
}

TEST_CASE("png: larger than libpng's own buffers, and twice the same bytes") {
#ifdef PILEUS_WITH_PNG
    Buffer<std::uint8_t> rgb;
    REQUIRE(rgb.resize(300 * 200 * 3, "test"));
    std::uint32_t state = 1;
    for (std::uint8_t& byte : rgb.span())
        byte = std::uint8_t((state = state * 1664525u + 1u) >> 24);
    Buffer<char> first, second;
    REQUIRE(encode_png(300, 200, rgb.span(), first));
    REQUIRE(encode_png(300, 200, rgb.span(), second));
    CHECK(first.size() > 150000);  // noise does not compress
    REQUIRE(first.size() == second.size());
    CHECK(std::memcmp(first.data(), second.data(), first.size()) == 0);
    CHECK(encode_png(300, 201, rgb.span(), first).code == Code::kBadInput);
    CHECK(encode_png(0, 200, rgb.span(), first).code == Code::kBadInput);
#else
    MESSAGE("skipped: PNG is left out of this build");
#endif
}
