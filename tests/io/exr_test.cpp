// SPDX-License-Identifier: Apache-2.0
// OpenEXR files: bit-equal round trips, a file built by hand, hostile bytes.
// in: small pictures -> out: pass or fail, or one line why it was skipped.
// docs/testing.md, label io
#include "tests/io/temp_folder.h"
#include "tests/io/test_image.h"

using namespace pileus;
using test::holds;

#ifdef PILEUS_WITH_OPENEXR
namespace {

std::string number(std::uint64_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += char(value >> 8 * i & 255);
    return text;
}
std::string attribute(const char* name, const char* type, const std::string& value) {
    return name + std::string(1, '\0') + type + std::string(1, '\0') + number(value.size(), 4) +
           value;
}
std::string channel(const char* name, std::uint64_t type, std::uint64_t sampling) {
    return name + std::string(1, '\0') + number(type, 4) + number(0, 4) + number(sampling, 4) +
           number(sampling, 4);
}
std::string box(int x0, int y0, int x1, int y1) {
    return number(std::uint64_t(x0), 4) + number(std::uint64_t(y0), 4) +
           number(std::uint64_t(x1), 4) + number(std::uint64_t(y1), 4);
}

/// Everything before the table of offsets, for uncompressed scanlines.
std::string head(const std::string& channels, const std::string& window) {
    return number(20000630, 4) + number(2, 4) +
           attribute("channels", "chlist", channels + std::string(1, '\0')) +
           attribute("compression", "compression", number(0, 1)) +
           attribute("dataWindow", "box2i", window) +
           attribute("displayWindow", "box2i", box(0, 0, 9, 9)) +
           attribute("lineOrder", "lineOrder", number(0, 1)) +
           attribute("pixelAspectRatio", "float", number(0x3f800000, 4)) +
           attribute("screenWindowCenter", "v2f", number(0, 8)) +
           attribute("screenWindowWidth", "float", number(0x3f800000, 4)) + std::string(1, '\0');
}

Status decode(const std::string& bytes, Image& image) {
    image = Image();
    return decode_exr("x.exr", {bytes.data(), bytes.size()}, image);
}

}  // namespace

TEST_CASE("exr: round trip is bit-equal, attributes included") {
    const test::TempFolder folder;
    const Image image = test::make_image(37, 21);  // more rows than one ZIP block of 16
    REQUIRE(write_image(image, folder.path("a.exr"), {}));
    Image read;
    REQUIRE(read_image(folder.path("a.exr"), read));
    CHECK(read.width == 37);
    CHECK(read.height == 21);
    REQUIRE(read.channels.size() == image.channels.size());
    for (const Channel& wanted : image.channels) {
        const Channel* got = read.find(wanted.name.c_str());
        REQUIRE(got != nullptr);
        CHECK(test::same_bits(*got, wanted));
    }
    CHECK(read.world_to_camera == image.world_to_camera);
    CHECK(read.world_to_ndc == image.world_to_ndc);
    CHECK(read.screen_window_width == 0.75f);
    CHECK(read.scene_text == image.scene_text);
    CHECK(read.pixel_hash == image.pixel_hash);
    CHECK(pixel_hash(read) == image.pixel_hash);
}

TEST_CASE("exr: the header names the primaries and no clock, host or owner") {
    Buffer<char> first, second;
    REQUIRE(encode_exr(test::make_image(4, 4), first));
    REQUIRE(encode_exr(test::make_image(4, 4), second));
    const std::string bytes(first.data(), first.size());
    CHECK(bytes == std::string(second.data(), second.size()));
    CHECK(holds(bytes, attribute("compression", "compression", number(3, 1))));
    CHECK(holds(bytes, attribute("pileus.scene", "string", "seed = 7\n")));
    CHECK(holds(bytes, std::string("chromaticities\0chromaticities\0\x20\0\0\0", 34)));
    for (const char* name : {"capDate", "utcOffset", "owner", "comments", "software"})
        CHECK_FALSE(holds(bytes, name));
}

TEST_CASE("exr: a hand-made file with half, whole-number and float channels off the origin") {
    // Channels sorted by name: F float, H half, U whole number; window x -1..0, y 2..3.
    const std::string start =
        head(channel("F", 2, 1) + channel("H", 1, 1) + channel("U", 0, 1), box(-1, 2, 0, 3));
    const std::uint64_t block = 8 + 2 * (4 + 2 + 4), first = start.size() + 16;
    std::string bytes = start + number(first, 8) + number(first + block, 8);
    const auto row = [&](int y, std::uint64_t f, std::uint64_t h, std::uint64_t u) {
        bytes += number(std::uint64_t(y), 4) + number(block - 8, 4) + number(f, 4) +
                 number(0x40000000, 4) + number(h, 2) + number(0x3c00, 2) + number(u, 4) +
                 number(7, 4);
    };
    row(2, 0x3f800000, 0x3800, 3);          // 1.0, 0.5, 3
    row(3, 0xbf800000, 0x7bff, 123456789);  // -1.0, 65504, rounds to 123456792
    Image image;
    const Status status = decode(bytes, image);
    INFO(status.message);
    REQUIRE(status);
    CHECK(image.width == 2);
    CHECK(image.height == 2);
    REQUIRE(image.channels.size() == 3);
    const Channel &f = *image.find("F"), &h = *image.find("H"), &u = *image.find("U");
    CHECK(f.pixels[0] == 1.0f);
    CHECK(f.pixels[1] == 2.0f);
    CHECK(f.pixels[2] == -1.0f);
    CHECK(h.pixels[0] == 0.5f);
    CHECK(h.pixels[1] == 1.0f);
    CHECK(h.pixels[2] == 65504.0f);
    CHECK(u.pixels[0] == 3.0f);
    CHECK(u.pixels[1] == 7.0f);
    CHECK(u.pixels[2] == 123456792.0f);
}

TEST_CASE("exr: too large, subsampled and foreign files are refused with a line") {
    Image image;
    const Status wide = decode(head(channel("Y", 2, 1), box(0, 0, 999999, 0)), image);
    INFO(wide.message);
    CHECK(wide.code != Code::kOk);
    const Status vast = decode(
        head(channel("Y", 2, 1), box(0, 0, 32767, 8191)) + std::string(8 * 8192, '\0'), image);
    CHECK(vast.code == Code::kLimit);
    CHECK(holds(vast.message, "1073741824 bytes once decoded"));
    const Status sub =
        decode(head(channel("Y", 2, 2), box(0, 0, 1, 1)) + std::string(64, '\0'), image);
    CHECK(sub.code == Code::kBadInput);
    CHECK(holds(sub.message, "channel Y: subsampled"));
    const Status text = decode("this is not an OpenEXR file at all", image);
    CHECK(text.code == Code::kBadInput);
    CHECK(holds(text.message, "x.exr: EXR file: not readable, "));
    CHECK(decode("", image).code == Code::kBadInput);
}

TEST_CASE("exr: every truncation is refused, every changed byte ends in a Status") {
    Buffer<char> encoded;
    REQUIRE(encode_exr(test::make_image(6, 20), encoded));
    const std::string good(encoded.data(), encoded.size());
    Image image;
    REQUIRE(decode(good, image));
    for (std::size_t n = 0; n < good.size(); ++n) {
        const Status status = decode(good.substr(0, n), image);
        INFO(n);
        CHECK_FALSE(status);
        CHECK_FALSE(holds(status.message, "\n"));
    }
    std::size_t refused = 0;
    for (std::size_t n = 0; n < good.size(); ++n)
        for (const int flip : {1, 128, 255}) {
            std::string bad = good;
            bad[n] = char(bad[n] ^ flip);
            const Status status = decode(bad, image);
            refused += status ? 0 : 1;
            if (!status) CHECK((status.code == Code::kBadInput || status.code == Code::kLimit));
        }
    CHECK(refused > 100);
}
#else
TEST_CASE("exr: left out") { MESSAGE("skipped: OpenEXR is left out of this build"); }
#endif
