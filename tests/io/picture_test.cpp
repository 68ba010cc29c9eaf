// SPDX-License-Identifier: Apache-2.0
// The picture in a foreign file: which layer, which part of the display, which light.
// in: channels of many names, windows, PNG files -> out: pass or fail.
// docs/compare.md, "Foreign files"
#include "lab/compare/picture.h"

#include <cmath>
#include <vector>

#include "tests/io/temp_folder.h"
#include "tests/io/test_image.h"

using namespace pileus;
using test::holds;

namespace {

/// One pixel; channel n holds n + 1.
Image with_channels(const std::vector<const char*>& names) {
    Image image;
    image.width = image.height = 1;
    for (const char* name : names) {
        image.channels.emplace_back();
        image.channels.back().name = name;
        REQUIRE(image.channels.back().pixels.resize(1, name));
        image.channels.back().pixels[0] = float(image.channels.size());
    }
    return image;
}

/// "R=1 G=2 ..." of what was chosen, or the fault.
std::string chosen(const std::vector<const char*>& names, const std::string& layer = "") {
    Image image = with_channels(names);
    std::string name;
    const Status status = choose_layer("f.exr", layer, image, name);
    if (!status) {
        CHECK(status.code == Code::kBadInput);
        return status.message;
    }
    std::string text = name + ":";
    for (const Channel& channel : image.channels)
        text += " " + channel.name + "=" + std::to_string(int(channel.pixels[0]));
    return text;
}

}  // namespace

TEST_CASE("picture: layers under the names of other renderers") {
    CHECK(chosen({"A", "B", "G", "R"}) == ": R=4 G=3 B=2 A=1");
    CHECK(chosen({"A", "B", "G", "R", "Z", "cloud.B", "cloud.G", "cloud.R"}) ==
          ": R=4 G=3 B=2 A=1");
    CHECK(chosen({"B", "G", "R", "error.B", "error.G", "error.R"}) ==
          ": R=3 G=2 B=1 error.R=6 error.G=5 error.B=4");
    CHECK(chosen({"ViewLayer.Combined.A", "ViewLayer.Combined.B", "ViewLayer.Combined.G",
                  "ViewLayer.Combined.R", "ViewLayer.Depth.Z"}) ==
          "ViewLayer.Combined: R=4 G=3 B=2 A=1");
    CHECK(chosen({"beauty.B", "beauty.G", "beauty.R", "diffuse.B", "diffuse.G", "diffuse.R"}) ==
          "beauty: R=3 G=2 B=1");
    CHECK(chosen({"A", "x.blue", "x.green", "x.red"}) == "x: R=4 G=3 B=2 A=1");
    CHECK(chosen({"rgba.r", "rgba.g", "rgba.b", "rgba.a"}) == "rgba: R=1 G=2 B=3 A=4");
}

TEST_CASE("picture: grey under R, Y, V or any name that stands alone") {
    CHECK(chosen({"Y"}) == ": Y=1");
    CHECK(chosen({"density"}) == ": Y=1");
    CHECK(chosen({"A"}) == ": Y=1");
    CHECK(chosen({"A", "Y"}) == ": Y=2 A=1");
    CHECK(chosen({"beauty.R"}) == "beauty: Y=1");
    CHECK(chosen({"Depth.Z", "beauty.A", "beauty.R"}) == "beauty: Y=3 A=2");
    CHECK(chosen({"flux.V", "depth.Z"}) == "flux: Y=1");
}

TEST_CASE("picture: a layer by name, and what is said where none stands out") {
    const std::vector<const char*> two = {"l.B", "l.G", "l.R", "r.B", "r.G", "r.R", "A"};
    CHECK(chosen(two, "r") == "r: R=6 G=5 B=4 A=7");
    CHECK(chosen(two) == "f.exr: layer: none stands out as the picture, \"\", allowed: l, r");
    CHECK(chosen(two, "q") == "f.exr: layer: not there, \"q\", allowed: l, r");
    CHECK(chosen({"Z", "id"}) ==
          "f.exr: layer: none stands out as the picture, \"\", allowed: none in this file");
    CHECK(chosen({"R", "G", "B", "cloud.R", "cloud.G", "cloud.B"}, "cloud") ==
          "cloud: R=4 G=5 B=6");
}

TEST_CASE("picture: the display window crops and pads") {
    Image image = test::make_image(3, 2);
    const Image whole = test::make_image(3, 2);
    image.display = {1, -1, 4,
                     2};  // from x = 1, y = -1: one column lost, one row and two columns new
    REQUIRE(fit_display_window("f.exr", image));
    CHECK(image.width == 4);
    CHECK(image.height == 2);
    const Buffer<float>&got = image.find("G")->pixels, &from = whole.find("G")->pixels;
    for (std::size_t x = 0; x < 4; ++x) CHECK(got[x] == 0);
    CHECK(got[4] == from[1]);
    CHECK(got[5] == from[2]);
    CHECK(got[6] == 0);
    CHECK(got[7] == 0);
    Image far = test::make_image(3, 2);
    far.display = {-1, 0, 4, 2};  // of a depth nothing is known beyond the pixels
    REQUIRE(fit_display_window("f.exr", far, kMaxImagePixels, __builtin_inff()));
    CHECK(far.find("G")->pixels[0] == __builtin_inff());
    CHECK(far.find("G")->pixels[1] == from[0]);
    // Windows that do not meet leave an empty picture; vast ones are refused before memory is
    // taken.
    image.display = {1000000000, 0, 2, 2};
    REQUIRE(fit_display_window("f.exr", image));
    for (float v : image.find("R")->pixels.span()) CHECK(v == 0);
    image.display = {0, 0, 4000000000, 4000000000};
    const Status vast = fit_display_window("f.exr", image);
    CHECK(vast.code == Code::kLimit);
    CHECK(holds(vast.message, "f.exr: display window: size: too large"));
}

TEST_CASE("picture: PNG codes become light, and come back as the same codes") {
#ifdef PILEUS_WITH_PNG
    Buffer<std::uint8_t> codes;
    REQUIRE(codes.resize(256 * 3, "test"));
    for (std::size_t i = 0; i < codes.size(); ++i) codes[i] = std::uint8_t(i * 7 / 3);
    Buffer<char> bytes;
    REQUIRE(encode_png(16, 16, codes.span(), bytes));
    const test::TempFolder folder;
    folder.put("a.png", std::string(bytes.data(), bytes.size()));
    Image image;
    std::string said;
    REQUIRE(read_picture(folder.path("a.png"), "", image, said));
    CHECK(said == "light of a display");
    CHECK(image.display_colours);
    CHECK(image.find("A") == nullptr);
    // IEC 61966-2-1 by libm; floats round to 6e-8.
    for (std::size_t i = 0; i < 256; ++i) {
        const double v = double(codes[3 * i]) / 255;
        const double light = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
        CHECK(std::fabs(double(image.find("R")->pixels[i]) - light) < 6e-8);
    }
    Buffer<std::uint8_t> again;
    REQUIRE(tone_map_8bit(image, {}, again));
    CHECK(std::memcmp(again.data(), codes.data(), codes.size()) == 0);
    // Every truncation is refused.
    for (std::size_t n = 0; n + 12 < bytes.size(); n += 7) {
        Image broken;
        const Status status = decode_png("p.png", {bytes.data(), n}, broken);
        CHECK(status.code == Code::kBadInput);
        CHECK(holds(status.message, "p.png: PNG file: not readable, "));
    }
    CHECK(decode_png("p.png", bytes.span(), image, 100).code == Code::kLimit);
#else
    Image image;
    CHECK(decode_png("p.png", {}, image).code == Code::kBadInput);
#endif
}
