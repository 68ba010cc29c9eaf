// SPDX-License-Identifier: Apache-2.0
// Buffers and matrices of a host, every kind of them: one says what the others say.
// in: one small picture -> out: formats, blends, depths and cameras against each other; refusals.
// docs/embedding.md
#include <cmath>
#include <limits>

#include "src/picture/pixels.h"
#include "tests/embed/host_harness.h"

using namespace host_test;
using render_test::kSmallCumulus;

namespace {

constexpr int kWidth = 24, kHeight = 14;
constexpr std::size_t kPixels = std::size_t(kWidth) * kHeight;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Hosted small(const char* method = "raymarch") {
    return {
        kSmallCumulus,
        {std::string("method.name=") + method, "raymarch.steps=24", "path.samples_per_pixel=1"}};
}

/// Draws into `pixels`, which hold what was there.
template <class Number>
void draw(Hosted& host, std::uint32_t format, std::uint32_t blend, bool bottom_up,
          std::vector<Number>& pixels) {
    auto frame = cleared<pileus_frame>();
    frame.colour = pixels.data();
    frame.format = format;
    frame.blend = blend;
    frame.bottom_up = bottom_up ? 1 : 0;
    host.check(pileus_session_render(host.session.get(), &frame, &host.out.error));
}

std::vector<float> depths(Hosted& host, std::uint32_t kind, bool bottom_up = false) {
    std::vector<float> out(kPixels);
    auto frame = cleared<pileus_frame>();
    frame.depth = out.data();
    frame.depth_kind = kind;
    frame.bottom_up = bottom_up ? 1 : 0;
    host.check(pileus_session_render(host.session.get(), &frame, &host.out.error));
    return out;
}

pileus_camera camera_of(double near_m, double far_m) {
    auto camera = cleared<pileus_camera>();
    camera.position_m[1] = -4000, camera.position_m[2] = camera.target_m[2] = 1000;
    camera.fov_deg = 40;
    camera.near_m = near_m, camera.far_m = far_m;
    return camera;
}

}  // namespace

TEST_CASE("targets: linear formats and blends are the same light") {
    for (const char* method : {"raymarch", "path"}) {
        CAPTURE(method);
        Hosted host = small(method);
        host.step(host.whole());
        std::vector<float> whole(4 * kPixels), media(4 * kPixels), over(4 * kPixels, 0.25f),
            nothing(4 * kPixels);
        draw(host, PILEUS_FORMAT_RGBA32F, PILEUS_BLEND_REPLACE, false, whole);
        draw(host, PILEUS_FORMAT_RGBA32F, PILEUS_BLEND_MEDIA, false, media);
        draw(host, PILEUS_FORMAT_RGBA32F, PILEUS_BLEND_OVER, false, over);
        draw(host, PILEUS_FORMAT_RGBA32F, PILEUS_BLEND_OVER, false, nothing);
        CHECK(nothing == media);
        int covered = 0;
        for (std::size_t i = 0; i < kPixels; ++i) {
            const float alpha = media[4 * i + 3];
            CHECK(alpha == whole[4 * i + 3]);
            covered += alpha > 0;
            for (std::size_t c = 0; c < 4; ++c) {
                if (c < 3) CHECK(media[4 * i + c] <= whole[4 * i + c] + 1e-6f);
                const float sum = media[4 * i + c] + (1 - alpha) * 0.25f;
                CHECK(over[4 * i + c] == doctest::Approx(sum).epsilon(1e-6));
            }
        }
        CHECK(covered > 10);
        // Halves are the floats rounded, and rows may lie the other way round.
        for (const bool up : {false, true})
            for (const std::uint32_t blend :
                 {PILEUS_BLEND_REPLACE, PILEUS_BLEND_MEDIA, PILEUS_BLEND_OVER}) {
                std::vector<std::uint16_t> halves(4 * kPixels);
                draw(host, PILEUS_FORMAT_RGBA16F, blend, up, halves);
                const std::vector<float>& floats = blend == PILEUS_BLEND_REPLACE ? whole : media;
                for (int y = 0; y < kHeight; ++y)
                    for (std::size_t x = 0; x < 4 * kWidth; ++x) {
                        const auto row = std::size_t(up ? kHeight - 1 - y : y);
                        CHECK(halves[std::size_t(y) * 4 * kWidth + x] ==
                              pileus::half_of(floats[row * 4 * kWidth + x]));
                    }
            }
    }
}

TEST_CASE("targets: 8-bit media over black and over a picture") {
    Hosted host = small();
    std::vector<unsigned char> media(4 * kPixels), black(4 * kPixels), white(4 * kPixels, 255);
    draw(host, PILEUS_FORMAT_RGBA8_SRGB, PILEUS_BLEND_MEDIA, false, media);
    draw(host, PILEUS_FORMAT_RGBA8_SRGB, PILEUS_BLEND_OVER, false, black);
    draw(host, PILEUS_FORMAT_RGBA8_SRGB, PILEUS_BLEND_OVER, false, white);
    CHECK(media == black);
    for (std::size_t i = 0; i < 4 * kPixels; ++i) {
        CHECK(white[i] >= media[i]);
        if (media[i - i % 4 + 3] == 0) CHECK(white[i] == 255);
    }
}

TEST_CASE("targets: blue first, and ten bits, are the same colours") {
    Hosted host = small();
    for (const std::uint32_t blend :
         {PILEUS_BLEND_REPLACE, PILEUS_BLEND_MEDIA, PILEUS_BLEND_OVER}) {
        CAPTURE(blend);
        std::vector<unsigned char> rgba(4 * kPixels), bgra(4 * kPixels);
        std::vector<std::uint32_t> words(kPixels);
        for (std::size_t i = 0; i < kPixels; ++i) {
            // The same colour in each: codes of 8 bits that are codes of 10, too (3 of 255,
            // 1023/85).
            const std::uint32_t r = 3 * (i % 86), g = 255 - r, b = 51, a = 85 * (i % 4);
            rgba[4 * i] = (unsigned char)(r), rgba[4 * i + 1] = (unsigned char)(g);
            rgba[4 * i + 2] = (unsigned char)(b), rgba[4 * i + 3] = (unsigned char)(a);
            bgra[4 * i] = (unsigned char)(b), bgra[4 * i + 1] = (unsigned char)(g);
            bgra[4 * i + 2] = (unsigned char)(r), bgra[4 * i + 3] = (unsigned char)(a);
            words[i] = (r * 1023 + 127) / 255 | (g * 1023 + 127) / 255 << 10 |
                       (b * 1023 + 127) / 255 << 20 | a / 85 << 30;
        }
        draw(host, PILEUS_FORMAT_RGBA8_SRGB, blend, false, rgba);
        draw(host, PILEUS_FORMAT_BGRA8_SRGB, blend, false, bgra);
        draw(host, PILEUS_FORMAT_RGB10A2_SRGB, blend, false, words);
        int finer = 0;
        for (std::size_t i = 0; i < kPixels; ++i) {
            for (std::size_t c = 0; c < 3; ++c) {
                CHECK(bgra[4 * i + c] == rgba[4 * i + 2 - c]);
                const double deep = double(words[i] >> (10 * c) & 1023u) * 255 / 1023;
                // Half a code of 8 bits, half a code of 10, and half of one that was read.
                CHECK(std::fabs(deep - double(rgba[4 * i + c])) < 0.5 + 2 * 0.125 + 1e-6);
                finer += std::fabs(deep - double(rgba[4 * i + c])) > 0.125;
            }
            CHECK(bgra[4 * i + 3] == rgba[4 * i + 3]);
            CHECK(std::fabs(double(words[i] >> 30) / 3 - double(rgba[4 * i + 3]) / 255) < 0.17);
        }
        CHECK(finer > 20);
    }
}

TEST_CASE("targets: depths as halves are those of the floats") {
    Hosted host = small();
    for (const std::uint32_t kind : {PILEUS_DEPTH_DISTANCE, PILEUS_DEPTH_VIEW_Z}) {
        const std::vector<float> metres = depths(host, kind);
        std::vector<std::uint16_t> halves(kPixels + 1, 0x1234);
        auto frame = cleared<pileus_frame>();
        frame.depth = reinterpret_cast<float*>(halves.data());
        frame.depth_format = PILEUS_DEPTH_R16F;
        frame.depth_kind = kind;
        host.check(pileus_session_render(host.session.get(), &frame, &host.out.error));
        for (std::size_t i = 0; i < kPixels; ++i) CHECK(halves[i] == pileus::half_of(metres[i]));
        CHECK(halves[kPixels] == 0x1234);
        frame.depth_format = 2;
        CHECK(pileus_session_render(host.session.get(), &frame, &host.out.error) ==
              PILEUS_ERROR_INPUT);
        CHECK(host.out.line().find("frame.depth_format: 2, allowed: ") == 0);
    }
}

TEST_CASE("targets: halves go there and back, the largest and the smallest too") {
    // Every half but what is no number is itself again.
    for (std::uint32_t bits = 0; bits < 65536; ++bits) {
        const auto half = std::uint16_t(bits);
        const float value = pileus::float_of_half(half);
        if (value == value) REQUIRE(pileus::half_of(value) == half);
    }
    CHECK(pileus::half_of(65519.0f) == 0x7bff);
    CHECK(pileus::half_of(65520.0f) == 0x7c00);
    CHECK(pileus::half_of(-1e30f) == 0xfc00);
    CHECK(pileus::half_of(0x1p-25f) == 0);
    CHECK(pileus::half_of(0x1.8p-25f) == 1);
    CHECK((pileus::half_of(float(kNan)) & 0x7fffu) == 0x7e00);
}

TEST_CASE("targets: kinds of depth are one depth, and images of them go both ways") {
    Hosted host = small();
    const auto set = [&](double near_m, double far_m) {
        const pileus_camera camera = camera_of(near_m, far_m);
        host.check(pileus_session_set_camera(host.session.get(), &camera, &host.out.error));
    };
    for (const double far_m : {0.0, 20000.0}) {
        CAPTURE(far_m);
        set(1, far_m);
        const std::vector<float> way = depths(host, PILEUS_DEPTH_DISTANCE),
                                 z = depths(host, PILEUS_DEPTH_VIEW_Z),
                                 buffer = depths(host, PILEUS_DEPTH_BUFFER);
        const std::vector<float> turned = depths(host, PILEUS_DEPTH_DISTANCE, true);
        int seen = 0;
        for (std::size_t i = 0; i < kPixels; ++i) {
            const std::size_t x = i % kWidth, y = i / kWidth;
            CHECK(turned[(kHeight - 1 - y) * kWidth + x] == way[i]);
            if (std::isinf(way[i])) {
                CHECK(std::isinf(z[i]));
                CHECK(buffer[i] == 1.0f);
                continue;
            }
            ++seen;
            CHECK(z[i] <= way[i]);
            const double far = far_m > 0 ? far_m : 1e30,
                         value = far / (far - 1) * (1 - 1 / double(z[i]));
            CHECK(double(buffer[i]) == doctest::Approx(value < 1 ? value : 1).epsilon(1e-6));
        }
        CHECK(seen > 20);
        // What was drawn, handed back as something solid, is where the picture's rays end.
        std::vector<std::vector<float>> again;
        for (const std::uint32_t kind : {PILEUS_DEPTH_DISTANCE, PILEUS_DEPTH_VIEW_Z}) {
            auto image = cleared<pileus_depth_image>();
            image.kind = kind;
            image.values = kind == PILEUS_DEPTH_DISTANCE ? way.data() : z.data();
            host.check(pileus_session_set_depth(host.session.get(), &image, &host.out.error));
            again.push_back(depths(host, PILEUS_DEPTH_DISTANCE));
            for (std::size_t i = 0; i < kPixels; ++i)
                CHECK(again.back()[i] <= way[i] * (1 + 1e-5f));
            image.values = nullptr;
            host.check(pileus_session_set_depth(host.session.get(), &image, &host.out.error));
        }
        for (std::size_t i = 0; i < kPixels; ++i)
            if (!std::isinf(way[i]))
                CHECK(again[0][i] == doctest::Approx(again[1][i]).epsilon(1e-4));
        CHECK(depths(host, PILEUS_DEPTH_DISTANCE) == way);
    }
    // A buffer's own values, from the top and from the bottom.
    std::vector<float> half(kPixels, 0.9997f);
    auto image = cleared<pileus_depth_image>();
    image.kind = PILEUS_DEPTH_BUFFER;
    image.values = half.data();
    std::vector<float> ends[2];
    for (const bool up : {false, true}) {
        for (std::size_t i = 0; i < kPixels; ++i)
            half[i] = (i < kPixels / 2) != up ? 0.9997f : 1.0f;
        image.bottom_up = up ? 1 : 0;
        host.check(pileus_session_set_depth(host.session.get(), &image, &host.out.error));
        ends[up] = depths(host, PILEUS_DEPTH_DISTANCE);
        for (std::size_t i = 0; i < kPixels / 2; ++i) CHECK(ends[up][i] < 3500);
    }
    CHECK(ends[0] == ends[1]);
    // Parallel rays have a buffer only between two ends.
    pileus_camera flat = camera_of(1, 10000);
    flat.height_m = 3000;
    auto frame = cleared<pileus_frame>();
    std::vector<float> out(kPixels);
    frame.depth = out.data();
    frame.depth_kind = PILEUS_DEPTH_BUFFER;
    for (const double far_m : {10000.0, 0.0}) {
        flat.far_m = far_m;
        const pileus_code set_flat =
            pileus_session_set_camera(host.session.get(), &flat, &host.out.error);
        host.check(set_flat);
        CHECK(pileus_session_render(host.session.get(), &frame, &host.out.error) ==
              (far_m > 0 ? PILEUS_OK : PILEUS_ERROR_INPUT));
    }
}

TEST_CASE("targets: matrices that are no camera's are refused in a line, and the picture stays") {
    Hosted host = small();
    const std::string before = host.hash();
    const double view[16] = {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, -1000, -4000, 1};
    const double f = 1 / std::tan(20 * 3.14159265358979323846 / 180);
    const double lens[16] = {f * kHeight / kWidth, 0, 0, 0, 0, f, 0, 0, 0, 0, -1, -1, 0, 0, -1, 0};
    const double flat[16] = {1e-3, 0, 0, 0, 0, 1e-3, 0, 0, 0, 0, -1e-4, 0, 0, 0, 0, 1};
    const auto set = [&](const double(&v)[16], const double(&p)[16]) {
        return pileus_session_set_matrices(host.session.get(), v, p, PILEUS_CLIP_ZERO, 0, 0,
                                           &host.out.error);
    };
    const struct {
        bool view, flat;
        int at;
        double value;
    } rows[] = {{true, false, 0, kNan},   {true, false, 0, 2},      {true, false, 1, 0.1},
                {true, false, 6, 1},      {true, false, 9, 2},      {true, false, 8, 0.5},
                {true, false, 3, 1},      {true, false, 7, 1},      {true, false, 11, 1},
                {true, false, 15, 2},     {false, false, 0, kNan},  {false, false, 0, -1},
                {false, false, 0, 0},     {false, false, 1, 1},     {false, false, 2, 1},
                {false, false, 3, 1},     {false, false, 4, 1},     {false, false, 5, 0},
                {false, false, 6, 1},     {false, false, 7, 1},     {false, false, 11, 0},
                {false, false, 11, 1},    {false, false, 15, 1},    {false, true, 15, 0},
                {false, true, 11, -1},    {false, true, 11, 1},     {false, false, 0, 1e-30},
                {false, false, 5, 1e-30}, {false, false, 8, 1e300}, {false, false, 9, 1e300}};
    for (const auto& row : rows) {
        CAPTURE(row.view);
        CAPTURE(row.at);
        CAPTURE(row.value);
        double v[16], p[16];
        std::memcpy(v, view, sizeof v);
        std::memcpy(p, row.flat ? flat : lens, sizeof p);
        (row.view ? v : p)[row.at] = row.value;
        CHECK(set(v, p) == PILEUS_ERROR_INPUT);
        CHECK_MESSAGE(
            host.out.line().find(row.view ? "view: " : "projection: ") != std::string::npos,
            host.out.line());
        CHECK(host.hash() == before);
    }
    CHECK(pileus_session_set_matrices(host.session.get(), nullptr, lens, PILEUS_CLIP_ZERO, 0, 0,
                                      &host.out.error) == PILEUS_ERROR_INPUT);
    // Both clip spaces and a buffer that is upside down are the same camera.
    std::string seen;
    for (const double side : {1.0, -1.0}) {
        double p[16];
        std::memcpy(p, lens, sizeof p);
        p[5] = side * f;
        host.check(set(view, p));
        if (seen.empty()) seen = host.hash();
        CHECK(host.hash() == seen);
    }
    CHECK(seen != before);
}

TEST_CASE("targets: what a session is set to out of range is refused, key by key") {
    Hosted host = small();
    pileus_session* const s = host.session.get();
    pileus_error* const e = &host.out.error;
    const std::string before = host.hash();
    const auto refused = [&](pileus_code code, const char* word) {
        CHECK(code == PILEUS_ERROR_INPUT);
        CHECK_MESSAGE(host.out.line().find(word) != std::string::npos, host.out.line());
        CHECK(host.hash() == before);
    };
    for (const int axis : {0, 1, 2})
        for (const double value : {1e9, -1e9, kNan}) {
            auto placement = cleared<pileus_placement>();
            placement.offset_m[axis] = value;
            refused(pileus_session_set_placement(s, &placement, e), "placement.offset_m");
        }
    auto sky = cleared<pileus_environment>();
    sky.present = 1;
    const std::vector<float> texels(6 * 3, 1.0f);
    sky.map = texels.data();
    sky.map_size[0] = 16386, sky.map_size[1] = 8193;
    refused(pileus_session_set_environment(s, &sky, e), "sky.map_size");
    std::uint32_t width = 0;
    refused(pileus_session_size(s, &width, nullptr, e), "width, height");
    auto depth = cleared<pileus_depth_image>();
    depth.values = texels.data();
    depth.stride = 8;
    refused(pileus_session_set_depth(s, &depth, e), "depth.stride: 8");
    auto frame = cleared<pileus_frame>();
    frame.blend = 3;
    refused(pileus_session_render(s, &frame, e), "frame.blend: 3");
    frame.blend = 0;
    frame.depth_kind = 3;
    refused(pileus_session_render(s, &frame, e), "frame.depth_kind: 3");
    frame.depth_kind = PILEUS_DEPTH_BUFFER;
    std::vector<float> out(kPixels);
    frame.depth = out.data();
    refused(pileus_session_render(s, &frame, e), "frame.depth: a depth buffer");
    // A ground that comes below a sky's picture would need that picture read again.
    const std::vector<float> map(4 * 2 * 3, 0.5f);
    sky.map = map.data();
    sky.map_size[0] = 4, sky.map_size[1] = 2;
    host.check(pileus_session_set_environment(s, &sky, e));
    const std::string under_map = host.hash();
    CHECK(under_map != before);
    const auto none = cleared<pileus_ground>();
    CHECK(pileus_session_set_ground(s, &none, e) == PILEUS_ERROR_INPUT);
    auto turned = cleared<pileus_placement>();
    turned.yaw_deg = 10;
    CHECK(pileus_session_set_placement(s, &turned, e) == PILEUS_ERROR_INPUT);
    // Kept as it is, then gone.
    sky.map = nullptr;
    host.check(pileus_session_set_environment(s, &sky, e));
    CHECK(host.hash() == under_map);
    sky.map_size[0] = sky.map_size[1] = 0;
    sky.radiance[0] = 0.0625f, sky.radiance[1] = 0.125f, sky.radiance[2] = 0.25f;
    host.check(pileus_session_set_environment(s, &sky, e));
    CHECK(host.hash() == before);
}
