// SPDX-License-Identifier: Apache-2.0
// Pixels in a caller's memory: halves, 8 bits as the program's, blending, rows.
// in: planes of small pictures -> out: pass or fail.
// docs/embedding.md, "Pixels" and "Depth"; IEEE 754, binary16
#include "src/picture/pixels.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "kernels_cpu/display/tone.h"
#include "src/io/images/image_file.h"
#include "src/world/camera/view.h"

using namespace pileus;

namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr PixelFormat kFormats[] = {PixelFormat::kRgba8Srgb, PixelFormat::kRgba16F,
                                    PixelFormat::kRgba32F};

/// A picture of one transmittance, its light growing from pixel to pixel.
Planes planes_of(std::size_t pixels, float transmittance, bool background = true) {
    Planes p;
    REQUIRE(p.transmittance.resize(pixels, "t"));
    REQUIRE(p.colour.resize(3 * pixels, "c"));
    if (background) REQUIRE(p.background.resize(3 * pixels, "b"));
    for (std::size_t i = 0; i < pixels; ++i) p.transmittance[i] = transmittance;
    for (std::size_t i = 0; i < 3 * pixels; ++i) {
        p.colour[i] = (1 - transmittance) * 0.01f * float(i + 1);
        if (background) p.background[i] = 0.7f - 0.002f * float(i % pixels);
    }
    return p;
}

struct Written {
    std::vector<unsigned char> bytes;
    std::uint64_t broken = 0;
};

/// Rows lie close, from the top.
Written write(const Planes& planes, int width, int height, PixelFormat format, PixelBlend blend,
              std::vector<unsigned char> before = {}, float stops = 0) {
    Written out{std::move(before)};
    const std::size_t row = std::size_t(width) * pixel_bytes(format);
    out.bytes.resize(row * std::size_t(height));
    PixelTarget target;
    target.rows = {out.bytes.data(), std::int64_t(row), false};
    target.format = format;
    target.blend = blend;
    target.stops = stops;
    REQUIRE(write_pixels(planes, width, height, target, nullptr, 1, out.broken));
    return out;
}

template <class Number>
std::vector<unsigned char> bytes_from(const std::vector<Number>& values) {
    std::vector<unsigned char> bytes(values.size() * sizeof(Number));
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

float float_at(const Written& w, std::size_t i) {
    float v;
    std::memcpy(&v, w.bytes.data() + 4 * i, sizeof v);
    return v;
}

std::uint16_t half_at(const Written& w, std::size_t i) {
    std::uint16_t v;
    std::memcpy(&v, w.bytes.data() + 2 * i, sizeof v);
    return v;
}

}  // namespace

TEST_CASE("halves: all 65536 are the numbers of IEEE 754, and come back") {
    int wrong = 0;
    for (unsigned bits = 0; bits < 65536; ++bits) {
        const auto half = static_cast<std::uint16_t>(bits);
        const float value = float_of_half(half);
        const int exponent = int(bits >> 10 & 31), mantissa = int(bits & 1023);
        if (exponent == 31 && mantissa != 0) {
            const std::uint16_t back = half_of(value);
            wrong += value == value || (back & 0x7c00) != 0x7c00 || (back & 0x3ff) == 0;
            continue;
        }
        double wanted = exponent == 31  ? double(kInf)
                        : exponent == 0 ? std::ldexp(mantissa, -24)
                                        : std::ldexp(1024 + mantissa, exponent - 25);
        if (bits >= 0x8000) wanted = -wanted;
        wrong += double(value) != wanted || std::signbit(value) != (bits >= 0x8000) ||
                 half_of(value) != half;
    }
    CHECK(wrong == 0);
}

TEST_CASE("halves: the nearest, ties to even, denormal ones too") {
    int wrong = 0;
    for (std::uint16_t low = 0; low < 0x7bff; ++low) {
        const auto high = static_cast<std::uint16_t>(low + 1);
        const float middle = 0.5f * (float_of_half(low) + float_of_half(high));
        for (const float sign : {1.0f, -1.0f}) {
            const unsigned s = sign < 0 ? 0x8000 : 0;
            wrong += half_of(sign * middle) != (s | ((low & 1) != 0 ? high : low));
            wrong += half_of(sign * std::nextafter(middle, kInf)) != (s | high);
            wrong += half_of(sign * std::nextafter(middle, 0.0f)) != (s | low);
        }
    }
    CHECK(wrong == 0);
    // Over the largest, 65504, the next would be 65536: half way is infinity.
    CHECK(half_of(65504.0f) == 0x7bff);
    CHECK(half_of(std::nextafter(65520.0f, 0.0f)) == 0x7bff);
    CHECK(half_of(65520.0f) == 0x7c00);
    CHECK(half_of(-65520.0f) == 0xfc00);
    CHECK(half_of(std::numeric_limits<float>::max()) == 0x7c00);
    CHECK(half_of(kInf) == 0x7c00);
    CHECK(half_of(0x1p-25f) == 0);
    CHECK(half_of(std::nextafter(0x1p-25f, 1.0f)) == 1);
    CHECK(half_of(std::numeric_limits<float>::denorm_min()) == 0);
    CHECK(half_of(-0.0f) == 0x8000);
}

TEST_CASE("pixels: 8 bits are those of the program's files") {
    constexpr int kWidth = 20, kHeight = 13;
    const Planes p = planes_of(kWidth * kHeight, 0.4f);
    Image image;
    image.width = kWidth, image.height = kHeight;
    image.channels.resize(3);
    for (std::size_t c = 0; c < 3; ++c) {
        image.channels[c].name = std::string(1, "RGB"[c]);
        REQUIRE(image.channels[c].pixels.resize(kWidth * kHeight, "pixels"));
        for (std::size_t i = 0; i < kWidth * kHeight; ++i) {
            const std::size_t at = c * kWidth * kHeight + i;
            image.channels[c].pixels[i] = p.colour[at] + p.transmittance[i] * p.background[at];
        }
    }
    for (const float stops : {0.0f, -1.5f, 3.0f}) {
        Buffer<std::uint8_t> rgb;
        REQUIRE(tone_map_8bit(image, {false, stops}, rgb));
        const Written w =
            write(p, kWidth, kHeight, PixelFormat::kRgba8Srgb, PixelBlend::kReplace, {}, stops);
        int wrong = 0;
        for (std::size_t i = 0; i < kWidth * kHeight; ++i) {
            for (std::size_t c = 0; c < 3; ++c) wrong += w.bytes[4 * i + c] != rgb[3 * i + c];
            wrong += w.bytes[4 * i + 3] != 153;  // 0.6 * 255
        }
        CHECK(wrong == 0);
        CHECK(w.broken == 0);
    }
}

TEST_CASE("pixels: over with alpha 0 leaves what is there") {
    std::vector<unsigned char> codes(256 * 4);
    for (std::size_t i = 0; i < codes.size(); ++i)
        codes[i] = static_cast<unsigned char>(i / 4 + 85 * (i % 4));
    CHECK(
        write(planes_of(256, 1), 16, 16, PixelFormat::kRgba8Srgb, PixelBlend::kOver, codes).bytes ==
        codes);

    // All halves but NaN, whose bits may change, and -0, which becomes 0.
    std::vector<std::uint16_t> halves;
    for (unsigned bits = 0; bits < 65536; ++bits)
        if ((bits & 0x7fff) <= 0x7c00 && bits != 0x8000)
            halves.push_back(static_cast<std::uint16_t>(bits));
    while (halves.size() % 4 != 0) halves.push_back(0);
    const int pixels = int(halves.size() / 4);
    CHECK(write(planes_of(std::size_t(pixels), 1), pixels, 1, PixelFormat::kRgba16F,
                PixelBlend::kOver, bytes_from(halves))
              .bytes == bytes_from(halves));

    const std::vector<float> floats{0,     1,      0.1f,  -3,   1e-40f, 3e38f, 65504, 0.5f,
                                    1e30f, 1e-30f, -2e9f, kInf, -kInf,  7,     8,     9};
    CHECK(write(planes_of(4, 1), 4, 1, PixelFormat::kRgba32F, PixelBlend::kOver, bytes_from(floats))
              .bytes == bytes_from(floats));
}

TEST_CASE("pixels: over with alpha 1 replaces all, infinities too") {
    const Planes p = planes_of(12, 0);
    for (const PixelFormat format : kFormats) {
        CAPTURE(int(format));
        std::vector<unsigned char> before(12 * pixel_bytes(format), 0x5a);
        if (format == PixelFormat::kRgba16F)
            before = bytes_from(std::vector<std::uint16_t>(48, 0x7c00));
        if (format == PixelFormat::kRgba32F)
            before = bytes_from(std::vector<float>{std::vector<float>(48, kInf)});
        const Written over = write(p, 4, 3, format, PixelBlend::kOver, before);
        CHECK(over.bytes == write(p, 4, 3, format, PixelBlend::kMedia).bytes);
        CHECK(over.bytes == write(p, 4, 3, format, PixelBlend::kReplace).bytes);
    }
}

TEST_CASE("pixels: the media alone are premultiplied, and over them is the sum") {
    constexpr float kLeft = 0.25f;
    const Planes p = planes_of(6, kLeft);
    const Written media = write(p, 3, 2, PixelFormat::kRgba32F, PixelBlend::kMedia);
    const Written halves = write(p, 3, 2, PixelFormat::kRgba16F, PixelBlend::kMedia);
    const std::vector<float> before(24, 0.3f);
    const Written over =
        write(p, 3, 2, PixelFormat::kRgba32F, PixelBlend::kOver, bytes_from(before));
    const Written shown = write(p, 3, 2, PixelFormat::kRgba8Srgb, PixelBlend::kMedia);
    const float gain = exposure_gain(0);
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            const float own = p.colour[c * 6 + i];
            CHECK(float_at(media, 4 * i + c) == own);
            CHECK(half_at(halves, 4 * i + c) == half_of(own));
            CHECK(float_at(over, 4 * i + c) == own + kLeft * 0.3f);
        }
        CHECK(float_at(media, 4 * i + 3) == 1 - kLeft);
        CHECK(float_at(over, 4 * i + 3) == (1 - kLeft) + kLeft * 0.3f);
        // 8 bits: the curve is that of the media's light where they cover all.
        const float a = 1 - kLeft;
        const Rgb<float> full = tone_curve(
            Rgb<float>{p.colour[i] / a, p.colour[6 + i] / a, p.colour[12 + i] / a}, gain);
        CHECK(shown.bytes[4 * i] == srgb_code(full.r * a));
        CHECK(shown.bytes[4 * i + 1] == srgb_code(full.g * a));
        CHECK(shown.bytes[4 * i + 2] == srgb_code(full.b * a));
        CHECK(shown.bytes[4 * i + 3] == 191);  // 0.75 * 255
    }
    // A plane of the media's own light goes before a colour that holds the whole.
    Planes apart = planes_of(6, kLeft, false);
    REQUIRE(apart.cloud.resize(18, "cloud"));
    for (std::size_t i = 0; i < 18; ++i) apart.cloud[i] = 0.5f;
    CHECK(float_at(write(apart, 3, 2, PixelFormat::kRgba32F, PixelBlend::kMedia), 0) == 0.5f);
    CHECK(float_at(write(apart, 3, 2, PixelFormat::kRgba32F, PixelBlend::kReplace), 0) ==
          apart.colour[0]);
}

TEST_CASE("pixels: rows of any stride, either way up; what lies between stays") {
    constexpr int kWidth = 5, kHeight = 4;
    const Planes p = planes_of(kWidth * kHeight, 0.5f);
    for (const PixelFormat format : kFormats) {
        CAPTURE(int(format));
        const std::size_t row = kWidth * pixel_bytes(format), stride = row + 12;
        const Written close = write(p, kWidth, kHeight, format, PixelBlend::kReplace);
        for (const bool bottom_up : {false, true})
            for (const int threads : {1, 3}) {
                std::vector<unsigned char> bytes(stride * kHeight, 0xa5);
                PixelTarget target;
                target.rows = {bytes.data(), std::int64_t(stride), bottom_up};
                target.format = format;
                std::uint64_t broken = 9;
                REQUIRE(write_pixels(p, kWidth, kHeight, target, nullptr, threads, broken));
                CHECK(broken == 0);
                for (std::size_t y = 0; y < kHeight; ++y) {
                    const std::size_t from = bottom_up ? kHeight - 1 - y : y;
                    const unsigned char* at = bytes.data() + y * stride;
                    CHECK(std::memcmp(at, close.bytes.data() + from * row, row) == 0);
                    for (std::size_t i = row; i < stride; ++i) CHECK(at[i] == 0xa5);
                }
            }
    }
}

TEST_CASE("pixels: one pixel, and light that is no light") {
    for (const PixelFormat format : kFormats)
        for (const PixelBlend blend : {PixelBlend::kReplace, PixelBlend::kOver, PixelBlend::kMedia})
            CHECK(write(planes_of(1, 0.5f), 1, 1, format, blend).broken == 0);
    Planes p = planes_of(1, 0.5f, false);
    p.colour[0] = std::nanf("");
    p.colour[1] = -2;
    p.colour[2] = kInf;
    const Written w = write(p, 1, 1, PixelFormat::kRgba32F, PixelBlend::kReplace);
    CHECK(w.broken == 2);
    CHECK(float_at(w, 0) == 0);
    CHECK(float_at(w, 1) == 0);
    CHECK(float_at(w, 2) == kInf);
    const Written shown = write(p, 1, 1, PixelFormat::kRgba8Srgb, PixelBlend::kReplace);
    CHECK(shown.bytes[2] == 255);
}

TEST_CASE("pixels: depths of every kind are metres along the rays, and back") {
    Camera camera;
    camera.resolution = {4, 3};
    const CameraParams params = make_camera(camera, 0, {});
    const DepthScale scale = depth_scale(false, 2, 50000);
    std::vector<float> given(12, 800);
    given[1] = std::nanf("");
    given[2] = -5;
    given[3] = 1e30f;
    for (const DepthKind kind : {DepthKind::kDistance, DepthKind::kViewZ, DepthKind::kBuffer}) {
        CAPTURE(int(kind));
        std::vector<float> held = given;
        if (kind == DepthKind::kBuffer)
            for (float& v : held) v = float(scale.value(double(v)));
        CameraDepth depth;
        Rows rows{reinterpret_cast<unsigned char*>(held.data()), 16, true};
        REQUIRE(take_depths(rows, kind, scale, params, depth));
        CHECK(depth.metres.size() == 12);
        // The first row in memory is the lowest.
        CHECK(depth.metres[8 + 3] == kInf);
        if (kind != DepthKind::kBuffer) {
            CHECK(depth.metres[8 + 1] == kInf);
            CHECK(depth.metres[8 + 2] == 0);
            CHECK(depth.broken == 1);
            CHECK(depth.negative == 1);
        }
        const double slant = kind == DepthKind::kDistance ? 1 : ray_slant(params, 3, 1);
        CHECK(double(depth.metres[4 + 3]) == doctest::Approx(800 * slant).epsilon(1e-3));

        Planes planes;
        REQUIRE(planes.half_depth.resize(12, "depth"));
        for (std::size_t i = 0; i < 12; ++i) planes.half_depth[i] = depth.metres[i];
        std::vector<float> back(12);
        rows.first = reinterpret_cast<unsigned char*>(back.data());
        write_depths(planes, params, kind, false, scale, rows);
        CHECK(double(back[4]) == doctest::Approx(double(held[4])).epsilon(1e-5));
        CHECK(back[3] == (kind == DepthKind::kBuffer ? 1 : kInf));
    }
}

TEST_CASE("pixels: 8 bits on lanes are those made one by one, whatever the values and widths") {
    const float odd[] = {0.0f,  -0.0f, -1.0f,   kInf,  -kInf, std::nanf(""), 1e-30f,
                         1e30f, 5e-5f, 0.0003f, 0.28f, 3.0f,  0.999f};
    for (const int width : {1, 3, 7, 16, 37}) {
        const int height = 11;
        for (const bool background : {false, true}) {
            const std::size_t pixels = std::size_t(width) * height;
            Planes p = planes_of(pixels, 0.3f, background);
            for (std::size_t i = 0; i < 3 * pixels; ++i) {
                if (i % 3 == 0) p.colour[i] = odd[i / 3 % 13];
                if (i % 7 == 0) p.transmittance[i / 3] = float(i % 257) / 256.0f;
            }
            for (const float stops : {0.0f, 5.0f, -40.0f}) {
                PixelTarget target;
                const std::int64_t stride = 4 * width + 3;
                std::vector<unsigned char> one(std::size_t(stride) * height, 77), many = one;
                target.stops = stops;
                target.rows = {one.data(), stride, true};
                std::uint64_t broken = 0, alike = 0;
                REQUIRE(write_pixels(p, width, height, target, nullptr, 1, broken));
                target.rows.first = many.data();
                for (int i = 0; kernel_table_at(i) != nullptr; ++i) {
                    CAPTURE(std::string(kernel_table_at(i)->name));
                    REQUIRE(write_pixels(p, width, height, target, kernel_table_at(i), 2, alike));
                    CHECK(alike == broken);
                    CHECK(many == one);
                }
            }
        }
    }
}
