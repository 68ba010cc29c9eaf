// SPDX-License-Identifier: Apache-2.0
// Picture files without libraries (PFM, PPM), the dispatch by extension, the pixel hash.
// in: small pictures -> out: pass or fail.
// docs/testing.md, label io
#include "src/base/digest.h"
#include "tests/io/temp_folder.h"
#include "tests/io/test_image.h"

using namespace pileus;
using test::holds;

TEST_CASE("image: a PFM file byte by byte") {
    const test::TempFolder folder;
    Image image;
    image.width = 1;
    image.height = 2;
    for (const char* name : {"B", "G", "R"}) {  // order in memory must not matter
        image.channels.emplace_back();
        image.channels.back().name = name;
        REQUIRE(image.channels.back().pixels.resize(2, name));
    }
    image.channels[2].pixels[0] = 1.0f;   // upper pixel, red:   00 00 80 3f
    image.channels[0].pixels[1] = -2.0f;  // lower pixel, blue:  00 00 00 c0
    REQUIRE(write_image(image, folder.path("a.pfm"), {}));
    const std::string zero(4, '\0');
    CHECK(folder.get("a.pfm") == "PF\n1 2\n-1\n" + zero + zero + std::string("\0\0\0\xc0", 4) +
                                     std::string("\0\0\x80\x3f", 4) + zero + zero);
}

TEST_CASE("image: PFM round trip, big-endian and grey files") {
    const test::TempFolder folder;
    const Image image = test::make_image(5, 3);
    REQUIRE(write_image(image, folder.path("a.pfm"), {}));
    Image read;
    REQUIRE(read_image(folder.path("a.pfm"), read));
    CHECK(read.width == 5);
    CHECK(read.height == 3);
    REQUIRE(read.channels.size() == 3);
    for (std::size_t c = 0; c < 3; ++c) CHECK(test::same_bits(read.channels[c], image.channels[c]));

    const std::string one("\x3f\x80\0\0", 4);
    REQUIRE(read_image(folder.put("b.pfm", "Pf 1 1 1.0\n" + one), read));
    for (const Channel& channel : read.channels) CHECK(channel.pixels[0] == 1.0f);
}

TEST_CASE("image: each PFM fault has its line") {
    const test::TempFolder folder;
    struct Row {
        std::string bytes;
        Code code;
        const char* line;
    };
    const Row rows[] = {
        {"", Code::kBadInput, "not a PFM file"},
        {"P6\n1 1\n255\nabc", Code::kBadInput, "not a PFM file"},
        {"PF\n1 1\n", Code::kBadInput, "not a PFM file"},
        {"PF\nx 1\n-1\n", Code::kBadInput, "not a PFM file"},
        {"PF\n1 1\n0\n", Code::kBadInput, "a scale that is not 0"},
        {"PF\n1 1\nnan\n", Code::kBadInput, "a scale that is not 0"},
        {"PF\n0 1\n-1\n", Code::kBadInput, "size: out of range, 0 x 1"},
        {"PF\n-5 1\n-1\n", Code::kBadInput, "size: out of range, -5 x 1"},
        {"PF\n1000000 1000000\n-1\n", Code::kLimit, "size: too large, 1000000 x 1000000"},
        {"PF\n20000 20000\n-1\n", Code::kLimit, "and 268435456 pixels"},
        {"PF\n1 1\n-1\n12345678901", Code::kBadInput, "11 bytes, allowed: exactly 12"},
        {"PF\n1 1\n-1\n1234567890123", Code::kBadInput, "13 bytes, allowed: exactly 12"},
    };
    for (const Row& row : rows) {
        Image read;
        const Status status = read_image(folder.put("a.pfm", row.bytes), read);
        INFO(row.bytes, " -> ", status.message);
        CHECK(status.code == row.code);
        CHECK(holds(status.message, row.line));
    }
    Image read;
    CHECK(read_image(folder.path("none.pfm"), read).code == Code::kBadInput);
    CHECK(read_image(folder.path("none.txt"), read).code == Code::kBadInput);
}

TEST_CASE("image: a PPM file holds the tone-mapped bytes from the top") {
    const test::TempFolder folder;
    const Image image = test::make_image(3, 2);
    REQUIRE(write_image(image, folder.path("a.ppm"), {}));
    Buffer<std::uint8_t> rgb;
    REQUIRE(tone_map_8bit(image, {}, rgb));
    REQUIRE(rgb.size() == 18);
    const std::string bytes(reinterpret_cast<const char*>(rgb.data()), rgb.size());
    CHECK(folder.get("a.ppm") == "P6\n3 2\n255\n" + bytes);
    CHECK(folder.entries() == 1);
}

TEST_CASE("image: what cannot be written is refused and leaves no file") {
    const test::TempFolder folder;
    const Image good = test::make_image(2, 2);
    const ToneSettings tone;
    CHECK(write_image(good, folder.path("a.jpg"), tone).code == Code::kBadInput);
    CHECK(holds(can_write_image("a.jpg").message, "unknown, \".jpg\", allowed: .exr .png .pfm"));
    CHECK(write_image(good, folder.path("noext"), tone).code == Code::kBadInput);
    CHECK(write_image(Image(), folder.path("a.pfm"), tone).code == Code::kBadInput);

    Image twice = test::make_image(2, 2);
    twice.channels[1].name = "R";
    CHECK(holds(write_image(twice, folder.path("a.pfm"), tone).message, "R: given twice"));
    Image none = test::make_image(2, 2);
    none.channels[1].name = "green";
    CHECK(holds(write_image(none, folder.path("a.ppm"), tone).message, "channel G: missing"));
    Image nameless = test::make_image(2, 2);
    nameless.channels[1].name = "";
    CHECK(write_image(nameless, folder.path("a.pfm"), tone).code == Code::kBadInput);
    Image shorter = test::make_image(2, 2);
    shorter.height = 3;
    CHECK(holds(write_image(shorter, folder.path("a.pfm"), tone).message, "4, allowed: 6"));
    CHECK(folder.entries() == 0);

    // A target that cannot be replaced fails half way, in every format of this build.
    for (const char* name : {"d.pfm", "d.ppm", "d.png", "d.exr"}) {
        std::filesystem::create_directory(folder.path(name));
        const Code wanted = can_write_image(name) ? Code::kIo : Code::kBadInput;
        CHECK(write_image(good, folder.path(name), tone).code == wanted);
    }
    CHECK(folder.entries() == 4);
}

TEST_CASE("image: a format that was left out names the option") {
#ifndef PILEUS_WITH_OPENEXR
    CHECK(holds(can_write_image("a.exr").message, "-DPILEUS_OPENEXR=ON"));
#else
    CHECK(can_write_image("a.exr"));
#endif
#ifndef PILEUS_WITH_PNG
    CHECK(holds(can_write_image("a.png").message, "-DPILEUS_PNG=ON"));
#else
    CHECK(can_write_image("a.PNG"));
#endif
}

TEST_CASE("image: the pixel hash is XXH3 over R G B A of each pixel") {
    Image image = test::make_image(2, 1);
    Digest digest;
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t c = 0; c < 4; ++c) digest.f32(image.channels[c].pixels[i]);
    CHECK(pixel_hash(image) == digest.hex());

    // XXH3 64 of 16 zero bytes.
    for (std::size_t c = 0; c < 4; ++c) image.channels[c].pixels[0] = 0.0f;
    image.width = 1;
    CHECK(pixel_hash(image) == "d0a66a65c7528968");
    image.channels[4].pixels[0] = 5.0f;  // other layers do not count
    CHECK(pixel_hash(image) == "d0a66a65c7528968");
    image.channels[3].pixels[0] = 1.0f;
    const std::string opaque = pixel_hash(image);
    CHECK(opaque != "d0a66a65c7528968");
    image.channels[3].name = "other";  // a missing A counts as 1
    CHECK(pixel_hash(image) == opaque);
}
