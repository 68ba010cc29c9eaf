// SPDX-License-Identifier: Apache-2.0
// Furnaces: inside a uniform field of radiance a white cloud cannot be told from its surroundings.
// in: sky, ground of albedo 1, clouds -> out: pixels and collectors that show the same radiance.
// docs/methods.md 3 "Shoot" (furnace identity); the ground's rules by forcing its photons.
#include "kernels_cpu/core/vec.h"
#include "kernels_cpu/isa/kernels.h"
#include "src/base/fnv1a64.h"
#include "src/methods/collectors/photons/reconstruct.h"
#include "src/methods/collectors/prepare/prepare.h"
#include "src/methods/collectors/prepare/shares.h"
#include "src/world/density/cumulus.h"
#include "tests/support/media_harness.h"
#include "tests/support/render_harness.h"

using namespace trace_test;

namespace {

const char* const kText = R"(
seed = 5
[camera]
position_m = [0, -3000, 1400]
target_m = [0, 0, 1150]
fov_deg = 40
resolution = [48, 27]
[sky]
radiance = [0.5, 1, 2]
[[medium]]
density = "procedural:cumulus"
bounds_m = [[-800, -800, 600], [800, 800, 1700]]
resolution = [48, 48, 32]
extinction_per_m = 0.05
albedo = 1.0
phase = { type = "henyey-greenstein", g = 0.85 }
[collectors]
photons = 200_000
generations = 2
samples = 2_000
)";

double worst_pixel(const render_test::Picture& p) {
    const char* const names[3] = {"R", "G", "B"};
    const double sky[3] = {0.5, 1, 2};
    double worst = 0;
    for (int c = 0; c < 3; ++c)
        for (int y = 0; y < p.image.height; ++y)
            for (int x = 0; x < p.image.width; ++x)
                worst = std::max(worst, std::fabs(double(p.at(names[c], x, y)) / sky[c] - 1));
    return worst;
}

/// A cumulus with collectors, 1 km wide, its box's bottom at z = 0.
struct Furnace {
    Rig rig;
    Prepared prepared;
};
void make_furnace(Furnace& f) {
    f.rig = make_rig({32, 32, 24}, {1000, 1000, 700}, 0.04);
    CumulusSettings cumulus;
    cumulus.resolution = {32, 32, 24};
    REQUIRE(make_cumulus(cumulus, *kernel_table(nullptr), 1, f.rig.medium.volume));
    f.rig.medium.optics[0].phase.g1 = 0.6f;
    Context context;
    Report report;
    context.kernels = f.rig.kernels;
    context.report = &report;
    CollectorSettings settings;
    settings.placement.samples = 1000;
    REQUIRE(prepare_collectors(f.rig.medium, settings, 1, context, f.prepared));
    f.rig.collector_of_voxel.swap(f.prepared.collector_of_voxel);
    f.rig.collectors = f.prepared.collectors.size();
    set_majorants(f.rig, 4);
    REQUIRE(f.rig.collectors > 50);
}

/// Colour of the collectors in the upper and the lower half, weighted by mass.
struct Halves {
    double low = 0, high = 0;
};
Halves half_means(const Furnace& f, const PhotonSlot& slot, const Vec<float>& forward) {
    Photons photons;
    photons.slots.resize(1);
    PhotonSlot& copy = photons.slots[0];
    REQUIRE(copy.sums.resize(slot.sums.size(), "copy"));
    std::memcpy(copy.sums.data(), slot.sums.data(), slot.sums.bytes());
    copy.generations = slot.generations;
    for (const Light& l : f.rig.lighting.lights)
        copy.flux_per_photon_m2.push_back(l.power_m2 / double(l.photons));
    ReconstructInput in;
    in.medium = &f.rig.medium;
    // A large constant keeps noise from being clamped at zero; it is taken off again.
    Lighting lighting = f.rig.lighting;
    lighting.constant = {1e9, 1e9, 1e9};
    in.lighting = &lighting;
    in.photons = &photons;
    in.collectors = f.prepared.collectors.span();
    in.shares = f.prepared.shares.span();
    in.camera.orthographic = 1;
    in.camera.forward[0] = forward.x, in.camera.forward[1] = forward.y;
    in.camera.forward[2] = forward.z;
    in.deposit = f.rig.deposit;
    CollectorColours colours;
    REQUIRE(reconstruct(in, colours));
    REQUIRE(colours.clamped_negative == 0);
    double sum[2] = {0, 0}, mass[2] = {0, 0};
    for (std::size_t i = 0; i < f.rig.collectors; ++i) {
        const Collector& c = f.prepared.collectors[i];
        const std::size_t half = c.centre[2] > 350 ? 1 : 0;
        sum[half] += c.mass * double(colours.colour[i]);
        mass[half] += c.mass;
    }
    return {sum[0] / mass[0], sum[1] / mass[1]};
}

constexpr int kRows = 6;  // three views, two halves
const Vec<float> kForwards[3] = {{0, 1, 0}, {0.6f, 0, -0.8f}, {0, 0, 1}};

/// Means over generations of all the rig's lights together, of radiance 1 each.
std::array<Mean, kRows> shoot_furnace(Furnace& f, std::uint64_t photons, std::uint64_t seed) {
    constexpr std::size_t kGenerations = 64;
    for (Light& l : f.rig.lighting.lights) l.photons = photons;
    const TraceInput in = input_of(f.rig, seed);
    TraceScratch scratch;
    REQUIRE(prepare_trace(in, scratch));
    std::array<std::array<double, kGenerations>, kRows> values{};
    for (std::size_t b = 0; b < kGenerations; ++b) {
        PhotonSlot slot;
        REQUIRE(slot.sums.resize(slot_stride(in) * in.lighting->lights.size(), "sums"));
        std::vector<TraceTally> tallies(in.lighting->lights.size());
        REQUIRE(trace_generation(in, b, scratch, slot, tallies));
        for (const TraceTally& t : tallies) {
            CHECK(balance(t.light, 0) == 0);
            CHECK(balance(t.shadow, 0) == 0);
        }
        for (std::size_t view = 0; view < 3; ++view) {
            const Halves h = half_means(f, slot, kForwards[view]);
            values[2 * view][b] = h.low;
            values[2 * view + 1][b] = h.high;
        }
    }
    std::array<Mean, kRows> means;
    for (std::size_t row = 0; row < kRows; ++row) {
        Mean& m = means[row];
        for (double v : values[row]) m.value += v / kGenerations;
        for (double v : values[row]) m.error += (v - m.value) * (v - m.value);
        m.error = std::sqrt(m.error / (kGenerations * (kGenerations - 1.0)));
    }
    return means;
}

/// The two-stage rule for all rows of one furnace together.
void check_furnace(const std::string& name, Furnace& f, std::uint64_t photons) {
    const auto row_name = [&](std::size_t row) {
        return name + ", view " + std::to_string(row / 2) + (row % 2 == 0 ? ", lower" : ", upper");
    };
    bool doubt = false;
    const std::uint64_t seed = fnv1a64({name.data(), name.size()});
    const auto first = shoot_furnace(f, photons, seed);
    for (std::size_t row = 0; row < kRows; ++row) {
        doubt = print_row(row_name(row).c_str(), first[row], 1, 0) > 4.5 || doubt;
        CHECK(first[row].error < 0.02);  // otherwise the row would say little
    }
    if (!doubt) return;
    const auto second = shoot_furnace(f, 16 * photons, seed + 1);
    for (std::size_t row = 0; row < kRows; ++row) {
        const double z = print_row((row_name(row) + " (16x)").c_str(), second[row], 1, 0);
        CHECK_MESSAGE(z <= 5.7, row_name(row));
    }
}

void add_ground(Furnace& f, double z, double albedo) {
    f.rig.lighting.ground.present = true;
    f.rig.lighting.ground.z = z;
    f.rig.lighting.ground.albedo = albedo;
}

}  // namespace

TEST_CASE("furnace: every pixel shows the sky, in both displays") {
    for (const char* display : {"march", "billboards"})
        for (const char* shape : {"procedural:cumulus", "uniform:box", "uniform:sphere"}) {
            const render_test::Picture p = render_test::render_one(render_test::scene_from(
                kText, {std::string("collectors.display=\"") + display + "\"",
                        std::string("medium.0.density=\"") + shape + "\""}));
            const double worst = worst_pixel(p);
            std::printf("furnace %s %s: worst pixel off by %.2g\n", display, shape, worst);
            CHECK(worst <= 1e-3);
            CHECK(p.report.photons.traced == 0);  // the furnace identity needs none
        }
}

TEST_CASE("furnace: a white ground under a uniform sky is the other half of the sky") {
    for (const char* display : {"march", "billboards"})
        for (const char* altitude : {"0", "590"}) {
            const render_test::Picture p = render_test::render_one(render_test::scene_from(
                kText, {std::string("collectors.display=\"") + display + "\"", "ground.albedo=1",
                        std::string("ground.altitude_m=") + altitude}));
            CHECK(worst_pixel(p) <= 1e-3);
            CHECK(p.report.photons.traced == 0);
        }
}

TEST_CASE("furnace: light from all sides, by photons") {
    Furnace f;
    make_furnace(f);
    add_light(f.rig, diffuse_light(f.rig.medium, 0));
    check_furnace("full sky", f, 12'000);
}

TEST_CASE("furnace: upper and lower half of the sky add up") {
    Furnace f;
    make_furnace(f);
    add_light(f.rig, diffuse_light(f.rig.medium, -1));
    add_light(f.rig, diffuse_light(f.rig.medium, 1));
    check_furnace("two halves", f, 8'000);
}

TEST_CASE("furnace: two white media, one above the other with a zone where they mix") {
    Furnace f;
    make_furnace(f);
    split(f.rig, optics_of({1, 1, 1}, {kPhaseTwoLobe, 0.9f, -0.4f, 0.6f}),
          [](std::size_t v) { return std::min(1.0, std::max(0.0, (double(v / 1024) - 8) / 8)); });
    REQUIRE(measure_shares(f.rig.medium, f.prepared.leaves.span(), f.prepared.collectors.span(), 1,
                           f.prepared.shares));
    add_light(f.rig, diffuse_light(f.rig.medium, 0));
    check_furnace("two white media", f, 12'000);
}

TEST_CASE("furnace: two white media need no photon, one that is not does") {
    const std::string text = std::string(kText) + "\n[[medium]]\n" + "density = \"uniform:box\"\n" +
                             "bounds_m = [[-1000, -1000, 500], [1000, 1000, 1800]]\n" +
                             "extinction_per_m = 0.001\n";
    for (const char* display : {"march", "billboards"}) {
        const std::string shown = std::string("collectors.display=\"") + display + "\"";
        const render_test::Picture p =
            render_test::render_one(render_test::scene_from(text, {shown}));
        CHECK(worst_pixel(p) <= 1e-3);
        CHECK(p.report.photons.traced == 0);
        const render_test::Picture grey = render_test::render_one(
            render_test::scene_from(text, {shown, "medium.1.albedo=0.999"}));
        CHECK(grey.report.photons.traced > 0);
    }
}

TEST_CASE("furnace: sky above, white ground below, by photons") {
    for (double z : {0.0, -50.0, -800.0}) {
        Furnace f;
        make_furnace(f);
        add_ground(f, z, 1);
        add_light(f.rig, diffuse_light(f.rig.medium, -1));
        add_light(f.rig, diffuse_light(f.rig.medium, 1));
        char name[64];
        std::snprintf(name, sizeof name, "ground at %g m", z);
        check_furnace(name, f, 8'000);
    }
}

TEST_CASE("furnace: without the ground's own light the lower half is darker") {
    // The opposite of the tests above, to show that they can fail.
    Furnace f;
    make_furnace(f);
    add_light(f.rig, diffuse_light(f.rig.medium, -1));
    f.rig.lighting.lights[0].photons = 50'000;
    const TraceInput in = input_of(f.rig, 1);
    TraceScratch scratch;
    PhotonSlot slot;
    REQUIRE(prepare_trace(in, scratch));
    REQUIRE(slot.sums.resize(slot_stride(in), "sums"));
    std::vector<TraceTally> tallies(1);
    REQUIRE(trace_generation(in, 0, scratch, slot, tallies));
    const Halves h = half_means(f, slot, {0, 1, 0});
    CHECK(h.low < 0.8);
    CHECK(h.low < h.high);
}
