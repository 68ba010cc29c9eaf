// SPDX-License-Identifier: Apache-2.0
// Laws of skylight that is scattered towards a camera: shares add up, what is ahead shows most, and
// pictures have the mean of paths.
// in: phase functions, numbers of nodes, a small cumulus -> out: brightness compared.
// docs/raymarch.md, "Skylight".
#include "src/picture/nodes/sky_view.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "src/world/phase/forward_share.h"
#include "tests/support/render_harness.h"

namespace {

using namespace render_test;

Medium medium_of(const PhaseParams& phase) {
    Medium medium;
    medium.count = 1;
    medium.optics[0].phase = phase;
    return medium;
}

/// Nodes of one row that see all parts alike.
struct Row {
    static constexpr int kNodes = 5;
    SkyView view;
    SkyPhase phase;
    SkyDirections middles = sky_directions();
    std::vector<float> seen;
    double share[1][kSkyParts] = {};
    float light[kNodes] = {};

    explicit Row(const PhaseParams& p)
        : phase(sky_phase(medium_of(p))), seen(std::size_t(kSkyParts * kNodes), 0.5f) {
        view.turned = true;
    }
    void turn() {
        turn_sky_nodes({{{kNodes, 1, 1}, {0.1f, 0.1f, 0.1f}},
                        &view,
                        &phase,
                        &middles,
                        1,
                        1,
                        share,
                        {seen.data(), seen.size()}},
                       *kernel_table(nullptr), 0, kNodes, light);
    }
};

}  // namespace

TEST_CASE("sky view: what is scattered is one over the sphere, and ahead what lies within a part") {
    const double rim_deg = std::acos(1 - 2.0 / kSkyParts) * 57.29577951308232;
    for (const float g : {-0.9f, 0.0f, 0.5f, 0.85f, 0.99f}) {
        CAPTURE(g);
        const PhaseParams hg{kPhaseHg, g, 0, 1};
        const SkyPhase phase = sky_phase(medium_of(hg));
        double sum = 0;
        for (int k = 0; k <= kSkyPhaseSteps; ++k) {
            CHECK(phase[std::size_t(k)] >= 0);
            sum += double(phase[std::size_t(k)]) * (k % kSkyPhaseSteps == 0 ? 0.5 : 1.0);
        }
        // Rings of one degree, steps of 1/128 in the cosine.
        CHECK(sum / kSkyPhaseSteps == doctest::Approx(1).epsilon(0.01));
        const double ahead = kSkyParts * forward_share(hg, rim_deg);
        CHECK(double(phase[kSkyPhaseSteps]) == doctest::Approx(ahead).epsilon(0.05));
        if (g == 0.0f)
            for (const float v : phase) CHECK(double(v) == doctest::Approx(1).epsilon(0.03));
    }
}

TEST_CASE("sky view: light from everywhere is seen alike, light from one side by who looks there") {
    Row row({kPhaseHg, 0.85f, 0, 1});
    for (double& share : row.share[0]) share = 1.0 / kSkyParts;
    for (const float x : {-1000.0f, 0.0f, 25.0f, 5.0f, 1000.0f}) {
        CAPTURE(x);
        row.view.camera.origin[0] = x;
        row.turn();
        for (const float v : row.light) CHECK(double(v) == doctest::Approx(0.5).epsilon(1e-5));
    }
    for (double& share : row.share[0]) share = 0;
    row.share[0][kSkyParts / 2] = 1;
    const std::array<float, 3> to = sky_direction(kSkyParts / 2);
    const auto from = [&](float distance) {
        for (std::size_t a = 0; a < 3; ++a) row.view.camera.origin[a] = to[a] * distance;
        row.turn();
        return row.light[0];
    };
    const float against = from(-1e6f), along = from(1e6f);
    CHECK(against > 20 * along);
    CHECK(against <= 1);
    // A camera on a node looks along no known way, and a flat one has the same way everywhere.
    for (int a = 0; a < 3; ++a) row.view.camera.origin[a] = 5;
    row.turn();
    CHECK(double(row.light[0]) == doctest::Approx(0.5).epsilon(1e-5));
    row.view.camera.orthographic = 1;
    for (std::size_t a = 0; a < 3; ++a) row.view.camera.forward[a] = to[a];
    row.turn();
    for (const float v : row.light) CHECK(v == row.light[0]);
    CHECK(double(row.light[0]) == doctest::Approx(double(against)).epsilon(1e-4));
}

TEST_CASE("sky view: a cloud under its sky has the mean of paths, thin, white or absorbing") {
    const auto mean = [](const char* method, const std::vector<std::string>& more) {
        std::vector<std::string> settings = more;
        settings.insert(settings.end(),
                        {"sun.irradiance = [0, 0, 0]", "path.samples_per_pixel = 64",
                         "output.layers = [\"radiance\", \"alpha\", \"cloud\"]",
                         std::string("method.name = \"") + method + "\""});
        const Picture p = render_one(scene_from(kSmallCumulus, settings));
        const Buffer<float>& cloud = p.image.find("cloud.G")->pixels;
        double sum = 0;
        for (const float v : cloud.span()) sum += double(v);
        return sum / double(cloud.size());
    };
    const std::vector<std::vector<std::string>> media = {
        {"medium.0.phase.g = 0.85", "medium.0.albedo = 1"},
        {"medium.0.phase.g = 0.85", "medium.0.albedo = 1", "medium.0.extinction_per_m = 0.002"},
        {"medium.0.phase.g = 0.85", "medium.0.albedo = 0.9"},
        {"medium.0.phase.g = 0", "medium.0.albedo = 0.9"}};
    for (const auto& medium : media) {
        CAPTURE(medium.back());
        const double paths = mean("path", medium), marched = mean("raymarch", medium);
        // What docs/raymarch.md promises, and the noise of 64 samples a pixel, a hundredth at most.
        CHECK(marched == doctest::Approx(paths).epsilon(0.11));
    }
}

TEST_CASE("sky view: every instruction set has the same bits, wherever a piece of nodes ends") {
    constexpr std::int32_t kSize[3] = {7, 5, 3};
    constexpr std::size_t kCount = 7 * 5 * 3;
    const Row row({kPhaseHg, 0.85f, 0, 1});
    SkyView view = row.view;
    view.turned = true;
    double share[3][kSkyParts];
    for (std::size_t s = 0; s < 3; ++s)
        for (std::size_t p = 0; p < kSkyParts; ++p)
            share[s][p] = double((7 * s + 3 * p) % 11) / 121;
    std::vector<float> seen(std::size_t(sky_seen_numbers(true, 3)) * kCount);
    for (std::size_t i = 0; i < seen.size(); ++i) seen[i] = float((i * 7919) % 1009) / 1009;
    for (const bool parallel : {false, true})
        for (const int octaves : {1, 3}) {
            view.camera.orthographic = parallel ? 1 : 0;
            view.camera.forward[1] = 1;
            for (float& v : view.camera.origin) v = 25;
            std::vector<float> wanted;
            for (int i = 0; kernel_table_at(i) != nullptr; ++i)
                for (const std::uint32_t piece : {1u, 5u, 16u, 105u}) {
                    if (kernel_table_at(i)->turn_sky == nullptr) continue;  // a device
                    std::vector<float> light(3 * kCount, -1);
                    for (std::uint32_t begin = 0; begin < kCount; begin += piece)
                        turn_sky_nodes({{{kSize[0], kSize[1], kSize[2]}, {0.1f, 0.1f, 0.1f}},
                                        &view,
                                        &row.phase,
                                        &row.middles,
                                        3,
                                        octaves,
                                        share,
                                        {seen.data(), seen.size()}},
                                       *kernel_table_at(i), begin,
                                       std::min(begin + piece, std::uint32_t(kCount)),
                                       light.data());
                    if (wanted.empty()) wanted = light;
                    CHECK(light == wanted);
                }
            for (const float v : wanted) {
                REQUIRE(v >= 0);
                REQUIRE(v <= 1);
            }
        }
}
