// SPDX-License-Identifier: Apache-2.0
// Layers of a session's pictures are those of the program's files, bit for bit.
// in: every method with the layers that it has -> out: each channel against the image's; refusals.
// docs/embedding.md, "Layers"
#include <algorithm>

#include "tests/embed/settings_rows.h"

using namespace host_test;
using render_test::kSmallCumulus;
using settings_test::kParticles;

namespace {

struct Row {
    const char* name;
    Overrides overrides;
    const char* text = kSmallCumulus;
};

const Row kRows[] = {
    {"raymarch",
     {"method.name=raymarch", "raymarch.steps=24",
      "output.layers=[\"depth\", \"cloud\", \"optical_depth\", \"transmittance\", \"light\", "
      "\"order\", \"reflectance\", \"shadow\"]"}},
    {"raymarch, thinned",
     {"method.name=raymarch", "raymarch.scale=2", "raymarch.steps=24",
      "output.layers=[\"depth\", \"optical_depth\", \"transmittance\", \"reflectance\"]"}},
    {"optical-depth",
     {"method.name=optical-depth",
      "output.layers=[\"depth\", \"optical_depth\", \"transmittance\", \"light\"]"}},
    {"collectors",
     {"method.name=collectors", "collectors.photons=2000", "collectors.generations=4",
      "output.layers=[\"depth\", \"cloud\", \"error\", \"optical_depth\", \"transmittance\", "
      "\"light\", \"order\", \"reflectance\", \"shadow\"]"}},
    {"photon-grid",
     {"method.name=photon-grid", "photon_grid.photons=2000", "photon_grid.generations=4",
      "photon_grid.ring=true",
      "output.layers=[\"depth\", \"cloud\", \"error\", \"optical_depth\", \"transmittance\", "
      "\"light\", \"reflectance\"]"}},
    {"path",
     {"method.name=path", "path.samples_per_pixel=4",
      "output.layers=[\"depth\", \"cloud\", \"error\", \"optical_depth\", \"transmittance\", "
      "\"light\", \"order\", \"reflectance\", \"shadow\"]"}},
    {"particles",
     {"method.name=particles",
      "output.layers=[\"depth\", \"optical_depth\", \"transmittance\", \"occlusion\"]"},
     kParticles},
};

pileus_host with_layers() {
    pileus_host host = pileus_host_default();
    host.layers = 1;
    return host;
}

/// The program's image of a scene.
pileus::Image image_of(const Row& row) {
    pileus::Scene scene;
    const pileus::Status read =
        pileus::read_scene_text(row.text, "scene", "", row.overrides, scene);
    REQUIRE_MESSAGE(bool(read), read.message);
    pileus::Image out;
    const pileus::Status status =
        pileus::render(scene, {}, [&](int, pileus::Image& image, pileus::Report&) {
            out = std::move(image);
            return pileus::Status::ok();
        });
    REQUIRE_MESSAGE(bool(status), status.message);
    return out;
}

/// Every channel of `image` from the session, rows two floats longer than they need be.
std::vector<std::vector<float>> layers_of(Hosted& host, const pileus::Image& image,
                                          bool bottom_up) {
    const std::size_t stride = std::size_t(image.width) + 2;
    std::vector<std::vector<float>> values(
        image.channels.size(), std::vector<float>(stride * std::size_t(image.height), -7.0f));
    std::vector<pileus_layer> layers;
    for (std::size_t i = 0; i < values.size(); ++i) {
        layers.push_back(pileus_layer_default());
        layers.back().name = image.channels[i].name.c_str();
        layers.back().values = values[i].data();
        layers.back().stride = std::int64_t(stride * sizeof(float));
    }
    pileus_frame frame = pileus_frame_default();
    frame.bottom_up = bottom_up ? 1 : 0;
    frame.layers = layers.data();
    frame.layer_count = std::uint32_t(layers.size());
    host.check(pileus_session_render(host.session.get(), &frame, &host.out.error));
    return values;
}

bool same_rows(const std::vector<float>& got, const pileus::Channel& channel, int width, int height,
               bool bottom_up) {
    const std::size_t w = std::size_t(width), stride = w + 2;
    bool same = true;
    for (std::size_t y = 0; y < std::size_t(height); ++y) {
        const float* row = got.data() + stride * (bottom_up ? std::size_t(height) - 1 - y : y);
        same = same && std::memcmp(row, channel.pixels.data() + y * w, w * sizeof(float)) == 0 &&
               row[w] == -7.0f && row[w + 1] == -7.0f;
    }
    return same;
}

/// Whether errors are as large in the mean: within a factor of 2, as those of four batches are.
bool like_errors(const std::vector<float>& got, const pileus::Channel& channel) {
    double sum = 0, wanted = 0;
    for (const float v : got) sum += v > 0 ? double(v) : 0;
    for (const float v : channel.pixels.span()) wanted += double(v);
    return wanted > 0 && sum > 0.5 * wanted && sum < 2 * wanted;
}

pileus_code draw_layer(Hosted& host, const char* name, float* values, std::int64_t stride,
                       std::uint32_t count = 1) {
    pileus_layer layer = pileus_layer_default();
    layer.name = name;
    layer.values = values;
    layer.stride = stride;
    pileus_frame frame = pileus_frame_default();
    frame.layers = &layer;
    frame.layer_count = count;
    return pileus_session_render(host.session.get(), &frame, &host.out.error);
}

}  // namespace

TEST_CASE("layers: those of the program's picture, in every method, in the second frame too") {
    for (const Row& row : kRows) {
        const std::string name = row.name;
        CAPTURE(name);
        const pileus::Image image = image_of(row);
        REQUIRE(image.channels.size() > 4);
        const pileus_host asking = with_layers();
        Hosted host(row.text, row.overrides, &asking);
        REQUIRE_MESSAGE(host.code == PILEUS_OK, host.out.line());
        host.step(host.whole());
        const std::string hash = host.hash();
        for (const bool bottom_up : {false, true}) {
            const auto values = layers_of(host, image, bottom_up);
            for (std::size_t i = 0; i < values.size(); ++i) {
                CAPTURE(image.channels[i].name);
                // Batches of a host's ring are other groups of the same photons.
                const bool batches =
                    image.channels[i].name.rfind("error.", 0) == 0 && name != "path";
                CHECK((batches ? like_errors(values[i], image.channels[i])
                               : same_rows(values[i], image.channels[i], image.width, image.height,
                                           bottom_up)));
            }
        }
        CHECK(host.hash() == hash);
        CHECK(hash == program_hashes(row.text, row.overrides)[0]);
    }
}

TEST_CASE("layers: what is not there is refused in a line, and nothing is written") {
    Hosted host(kSmallCumulus, {"method.name=raymarch", "raymarch.steps=24"});
    std::vector<float> values(64 * 64, -7.0f);
    CHECK(draw_layer(host, "tau", values.data(), 0) == PILEUS_ERROR_INPUT);
    CHECK_MESSAGE(host.out.line().find("frame.layers[0].name: \"tau\", allowed: R, G, B, A") == 0,
                  host.out.line());
    CHECK(draw_layer(host, nullptr, values.data(), 0) == PILEUS_ERROR_INPUT);
    CHECK(draw_layer(host, "A", nullptr, 0) == PILEUS_ERROR_INPUT);
    CHECK(draw_layer(host, "A", values.data(), 4) == PILEUS_ERROR_INPUT);
    CHECK(draw_layer(host, "A", values.data(), 0, 257) == PILEUS_ERROR_INPUT);
    CHECK(values == std::vector<float>(64 * 64, -7.0f));
    pileus_layer unmarked{};
    pileus_frame frame = pileus_frame_default();
    frame.layer_count = 1;
    CHECK(pileus_session_render(host.session.get(), &frame, nullptr) == PILEUS_ERROR_INPUT);
    frame.layers = &unmarked;
    CHECK(pileus_session_render(host.session.get(), &frame, nullptr) == PILEUS_ERROR_INPUT);
    CHECK(draw_layer(host, "A", values.data(), 0) == PILEUS_OK);
    CHECK(values[0] >= 0);
}

TEST_CASE("layers: an error needs two samples, or a full ring") {
    for (const char* method : {"collectors", "photon-grid"}) {
        CAPTURE(method);
        const pileus_host asking = with_layers();
        Hosted host(kSmallCumulus,
                    {std::string("method.name=") + method, "collectors.photons=2000",
                     "photon_grid.photons=2000", "photon_grid.ring=true"},
                    &asking);
        std::vector<float> values(64 * 64, -7.0f);
        host.step(1);
        CHECK(draw_layer(host, "error.G", values.data(), 0) == PILEUS_ERROR_INPUT);
        host.step(host.whole());
        for (int i = 0; i < 2; ++i) {
            CHECK(draw_layer(host, "error.G", values.data(), 0) == PILEUS_OK);
            CHECK(*std::max_element(values.begin(), values.end()) > 0);
            // A change of light that empties the ring, and one that does not.
            host.sun(100, 30);
            auto ground = cleared<pileus_ground>();
            ground.present = 1;
            ground.altitude_m = 10;
            ground.albedo = 0.25;
            host.check(pileus_session_set_ground(host.session.get(), &ground, &host.out.error));
            host.step(1);
            const pileus_code code = draw_layer(host, "error.G", values.data(), 0);
            for (const float v : values) CHECK(v - v == 0);
            CHECK((code == PILEUS_OK || code == PILEUS_ERROR_INPUT));
            host.step(host.whole());
        }
    }

    const pileus_host asking = with_layers();
    Hosted host(kSmallCumulus, {"method.name=path", "output.layers=[\"error\"]"}, &asking);
    std::vector<float> values(64 * 64);
    host.step(1);
    CHECK(draw_layer(host, "error.G", values.data(), 0) == PILEUS_ERROR_INPUT);
    host.step(1);
    CHECK(draw_layer(host, "error.G", values.data(), 0) == PILEUS_OK);
}

TEST_CASE("layers: a name that is not there leaves the pictures after it as they are") {
    const Overrides sets{"method.name=raymarch", "raymarch.steps=24", "raymarch.temporal=4"};
    Hosted one(kSmallCumulus, sets), other(kSmallCumulus, sets);
    std::vector<float> values(64 * 64);
    for (int frame = 0; frame < 3; ++frame) {
        CHECK(draw_layer(one, "tua", values.data(), 0) == PILEUS_ERROR_INPUT);
        CHECK(one.hash() == other.hash());
    }
}
