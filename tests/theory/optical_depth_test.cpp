// SPDX-License-Identifier: Apache-2.0
// Method optical-depth against its formula: slabs under the sun, powder by either measure, bounds.
// in: uniform slabs seen from above, a small cumulus -> out: closed forms; pictures compared.
// docs/optical-depth.md; Maerkl 2018, 3.1.
#include <doctest/doctest.h>

#include <cmath>

#include "src/world/medium/mix_media.h"
#include "src/world/medium/resample.h"
#include "tests/support/render_harness.h"

namespace optical_depth_test {

using namespace render_test;
using Keys = std::vector<std::string>;

constexpr double kPi = 3.14159265358979323846;

/// A level slab of 100 m seen from right above, under a sun in the zenith.
const char* const kSlab = R"(
[camera]
position_m = [0, 0, 1000]
target_m = [0, 0, 0]
up = [0, 1, 0]
projection = "orthographic"
height_m = 10
resolution = [2, 2]
[sun]
elevation_deg = 90
azimuth_deg = 0
irradiance = [1, 2, 3]
[[medium]]
density = "uniform:box"
bounds_m = [[-50, -50, 0], [50, 50, 100]]
resolution = [2, 2, 512]
extinction_per_m = 0.04
albedo = 0.5
phase = { type = "henyey-greenstein", g = 0.4 }
[method]
name = "optical-depth"
[optical_depth]
stop_below = 0
[output]
layers = ["radiance", "alpha"]
)";

Picture picture_of(const char* text, const Keys& keys) {
    return render_one(scene_from(text, keys));
}

/// Integral over the slab of the light at depth t, seen through t.
double expected(double strength, double depth, double phase) {
    constexpr double kTau = 4, kAlbedo = 0.5;
    const double all = (1 - std::exp(-2 * kTau)) / 2;
    const double taken = strength * (1 - std::exp(-(2 + depth) * kTau)) / (2 + depth);
    return 2 * kAlbedo * phase * (all - taken);
}

double hg(double cosine, double g) {
    return (1 - g * g) / (4 * kPi * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}

TEST_CASE("optical-depth: a slab from above has the formula's radiance") {
    struct Row {
        double strength, depth;
    };
    // The light of the first half cell is that of its middle: 1/1024 of the slab, tau 0.004, whose
    // share of the integral errs by half of that.
    constexpr double kTolerance = 4e-3;
    for (const Row& row : {Row{0, 2}, Row{1, 2}, Row{0.6, 0.5}, Row{1, 100}}) {
        CAPTURE(row.strength);
        CAPTURE(row.depth);
        const Picture p =
            picture_of(kSlab, {"optical_depth.powder_strength=" + std::to_string(row.strength),
                               "optical_depth.powder_depth=" + std::to_string(row.depth)});
        const double want = expected(row.strength, row.depth, hg(-1, 0.4));
        for (int c = 0; c < 3; ++c) {
            const char* const name[] = {"R", "G", "B"};
            CHECK(double(p.image.find(name[c])->pixels[0]) ==
                  doctest::Approx((c + 1) * want).epsilon(kTolerance));
        }
    }
}

TEST_CASE("optical-depth: reflectance is radiance over that of a white plane in the sun") {
    const Picture p =
        picture_of(kSlab, {"sun.elevation_deg=30", "output.layers=[\"reflectance\"]"});
    const char* const from[] = {"R", "G", "B"};
    const char* const to[] = {"reflectance.R", "reflectance.G", "reflectance.B"};
    for (int c = 0; c < 3; ++c) {
        const double radiance = double(p.image.find(from[c])->pixels[1]);
        CHECK(radiance > 0);
        CHECK(double(p.image.find(to[c])->pixels[1]) ==
              doctest::Approx(kPi * radiance / (0.5 * (c + 1))).epsilon(1e-6));
    }
    const Picture night =
        picture_of(kSlab, {"sun.elevation_deg=-30", "output.layers=[\"reflectance\"]"});
    CHECK(night.image.find("reflectance.G")->pixels[0] == 0.0f);
}

TEST_CASE("optical-depth: powder by extinction, a phase function for all, ambient light") {
    // At 0.04 per metre and 30 m the powder leaves 1 - 0.8 exp(-1.2) everywhere.
    const Picture p =
        picture_of(kSlab, {"optical_depth.powder_by=extinction", "optical_depth.powder_depth=30",
                           "optical_depth.powder_strength=0.8", "optical_depth.g=0",
                           "optical_depth.intensity=3", "optical_depth.ambient=[0.5, 0, 0]"});
    const double left = 1 - 0.8 * std::exp(-1.2);
    const double want = 3 * left * expected(0, 1, 1 / (4 * kPi));
    CHECK(double(p.image.find("G")->pixels[0]) == doctest::Approx(2 * want).epsilon(4e-3));
    const double ambient = 0.5 * (1 - std::exp(-4.0));
    CHECK(double(p.image.find("R")->pixels[0]) == doctest::Approx(want + ambient).epsilon(4e-3));
    // A share above 1 takes all light where it would take more.
    const Picture dark =
        picture_of(kSlab, {"optical_depth.powder_by=extinction", "optical_depth.powder_depth=0",
                           "optical_depth.powder_strength=5"});
    CHECK(dark.image.find("R")->pixels[0] == 0.0f);
}

TEST_CASE("optical-depth: without powder it is twice raymarch's single scattering, bit for bit") {
    const Keys march = {"method.name=raymarch",       "raymarch.light=buffer",
                        "raymarch.sky_light=none",    "raymarch.spacing=voxel",
                        "raymarch.scattering=single", "output.layers=[\"cloud\"]"};
    const Keys simple = {"method.name=optical-depth", "optical_depth.powder_strength=0",
                         "output.layers=[\"cloud\"]"};
    const Picture a = picture_of(kSmallCumulus, march), b = picture_of(kSmallCumulus, simple);
    const auto &one = a.image.find("cloud.G")->pixels, &two = b.image.find("cloud.G")->pixels;
    bool lit = false;
    for (std::size_t i = 0; i < one.size(); ++i) {
        CHECK(two[i] == 2 * one[i]);
        lit |= one[i] > 0;
    }
    CHECK(lit);
}

TEST_CASE("optical-depth: a largest extinction is that of the medium where it is lower") {
    const Picture cut = picture_of(kSlab, {"optical_depth.max_extinction_per_m=0.01"});
    const Picture thin = picture_of(kSlab, {"medium.0.extinction_per_m=0.01"});
    for (const char* name : {"R", "A"})
        CHECK(cut.image.find(name)->pixels[0] ==
              doctest::Approx(thin.image.find(name)->pixels[0]).epsilon(1e-5));
    const Picture above = picture_of(kSlab, {"optical_depth.max_extinction_per_m=0.05"});
    CHECK(above.report.hash == picture_of(kSlab, {}).report.hash);
}

TEST_CASE("optical-depth: the buffer's own cells") {
    // As many as the medium has, or none named: the same bits.
    const Keys method = {"method.name=optical-depth", "output.layers=[\"alpha\"]",
                         "medium.0.extinction_per_m=0.0625"};
    const std::string plain = picture_of(kSmallCumulus, method).report.hash;
    const Scene scene = scene_from(kSmallCumulus, method);
    auto n = scene.media[0].box.resolution;
    // Cells of four optical depths are divided by three.
    for (int& cells : n) cells *= 3;
    const std::string own =
        "optical_depth.resolution=[" + std::to_string(n[0]) + ", 0, " + std::to_string(n[2]) + "]";
    CHECK(picture_of(kSmallCumulus, {method[0], method[1], method[2], own}).report.hash == plain);
    CHECK(picture_of(kSmallCumulus,
                     {method[0], method[1], method[2], "optical_depth.resolution=[1, 1, 1]"})
              .report.hash != plain);
    // Light through twice the extinction is light through the same twice as dense.
    const Picture twice = picture_of(kSlab, {"optical_depth.light_scale=0"});
    const double unshaded = 2 * 0.5 * hg(-1, 0.4) * (1 - std::exp(-4.0));
    // Without a way through the medium the powder takes all of it: strength 1.
    CHECK(twice.image.find("R")->pixels[0] == 0.0f);
    const Picture bare =
        picture_of(kSlab, {"optical_depth.light_scale=0", "optical_depth.powder_strength=0"});
    CHECK(double(bare.image.find("R")->pixels[0]) == doctest::Approx(unshaded).epsilon(1e-3));
}

TEST_CASE("optical-depth: cells of another size hold what the medium's hold") {
    const Scene scene = scene_from(kSmallCumulus, {});
    Plan plan;
    Medium medium;
    REQUIRE(load_media(scene, Limits{}, 1, plan, medium));
    const auto mass = [](const Medium& m) {
        double sum = 0;
        for (float d : m.volume.density.span()) sum += double(d);
        return sum * m.extent_m[0] * m.extent_m[1] * m.extent_m[2] /
               double(m.volume.density.size()) * double(m.sigma);
    };
    for (const std::array<int, 3>& size :
         {std::array<int, 3>{7, 11, 5}, std::array<int, 3>{1, 1, 1},
          std::array<int, 3>{61, 40, 33}}) {
        Medium out;
        const Array<float> array{"density", std::uint64_t(size[0] * size[1] * size[2])};
        REQUIRE(resample_medium(medium, size, 2, array, out));
        // Cells are floats: each is right to 6e-8 of itself.
        CHECK(mass(out) == doctest::Approx(mass(medium)).epsilon(1e-7));
    }
}

TEST_CASE("optical-depth: what it cannot do is refused in one line") {
    const auto fault = [](const Keys& keys, const RenderOptions& options) {
        const Status status = render(scene_from(kSmallCumulus, keys), options,
                                     [](int, Image&, Report&) { return Status::ok(); });
        CHECK(status.code == Code::kBadInput);
        return status.message;
    };
    RenderOptions photons;
    photons.budget.photons = 5;
    CHECK(fault({"method.name=optical-depth"}, photons) ==
          "--budget photons: not for method optical-depth, allowed: steps=N, seconds=S");
    CHECK(fault({"method.name=optical-depth", "output.layers=[\"error\"]"}, {})
              .find("test.toml: output.layers: method optical-depth has no noise") == 0);
    const Status two =
        render(scene_from(std::string(kSlab) + "[[medium]]\ndensity = \"uniform:box\"\n"
                                               "bounds_m = [[0, 0, 0], [9, 9, 9]]\n"
                                               "resolution = [2, 2, 2]\nextinction_per_m = 1\n"
                                               "phase = { type = \"isotropic\" }\n",
                          {"optical_depth.max_extinction_per_m=1"}),
               {}, [](int, Image&, Report&) { return Status::ok(); });
    CHECK(two.code == Code::kBadInput);
    CHECK(two.message.find("optical_depth.max_extinction_per_m: not with several media") !=
          std::string::npos);
}

}  // namespace optical_depth_test
