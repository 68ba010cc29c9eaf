// SPDX-License-Identifier: Apache-2.0
// Light by discrete ordinates: limits that are known, and the path tracer between them.
// in: small scenes -> out: means of pictures within stated bounds. docs/ordinates.md
#include "src/picture/ordinates/ordinates.h"

#include "tests/support/render_harness.h"

using namespace render_test;

namespace {

/// A box that repeats, from above and aslant; its vertical optical depth is 800 times the
/// extinction.
constexpr const char* kSlab = R"(
seed = 3
[camera]
projection = "orthographic"
position_m = [0, -3000, 5200]
target_m = [0, 0, 0]
height_m = 100
resolution = [4, 4]
[sun]
azimuth_deg = 65
elevation_deg = 45
[sky]
radiance = [0, 0, 0]
[[medium]]
density = "uniform:box"
bounds_m = [[-400, -400, 0], [400, 400, 800]]
resolution = [2, 2, 16]
extinction_per_m = 0.05
phase = { type = "henyey-greenstein", g = 0.85 }
boundary = "periodic"
[method]
name = "raymarch"
[raymarch]
scattering = "ordinates"
spacing = "voxel"
[path]
target_error = 0
samples_per_pixel = 4096
[output]
layers = ["cloud"]
)";

double mean_of(const Scene& scene, const char* channel = "cloud.R") {
    const Picture p = render_one(scene);
    return sum_of(p, channel).value / (p.image.width * p.image.height);
}

/// The picture's mean over the path tracer's.
double over_path(const char* text, std::vector<std::string> set) {
    const double ours = mean_of(scene_from(text, set));
    set.push_back("method.name=\"path\"");
    return ours / mean_of(scene_from(text, set));
}

}  // namespace

TEST_CASE("a thin sphere is lit by single scattering: twice the light of none") {
    // Depth 0.004 at most: second scatterings are below 0.4 % of the first.
    const std::vector<std::string> thin{"medium.0.density=\"uniform:sphere\"",
                                        "medium.0.boundary=\"open\"",
                                        "medium.0.resolution=[32,32,32]",
                                        "medium.0.extinction_per_m=0.000005",
                                        "camera.height_m=700",
                                        "camera.resolution=[16,16]"};
    for (const char* azimuth : {"0", "65", "180"}) {
        CAPTURE(azimuth);
        std::vector<std::string> set = thin;
        set.push_back(std::string("sun.azimuth_deg=") + azimuth);
        const double all = mean_of(scene_from(kSlab, set));
        set.push_back("raymarch.scattering=\"single\"");
        const double single = mean_of(scene_from(kSlab, set));
        CHECK(all / single > 0.998);
        CHECK(all / single < 1.01);
    }
}

TEST_CASE("in light from all sides what absorbs nothing cannot be seen") {
    // The iterations end at changes of 2e-4, of which many are left in a thick slab.
    for (const char* extinction : {"0.0005", "0.005", "0.05"}) {
        CAPTURE(extinction);
        const Scene scene =
            scene_from(kSlab, {"sky.radiance=[1,1,1]", "sun.irradiance=[0,0,0]",
                               std::string("medium.0.extinction_per_m=") + extinction,
                               "output.layers=[\"radiance\"]"});
        const double radiance = mean_of(scene, "R");
        CHECK(radiance > 0.995);
        CHECK(radiance < 1.005);
    }
}

TEST_CASE("slabs are as bright as by paths") {
    // Paths' noise is below 0.5 %; nodes are coarse to first order (docs/ordinates.md, "Bounds").
    struct Row {
        const char *extinction, *phase, *albedo, *elevation;
    };
    constexpr const char* kG85 = "{type=\"henyey-greenstein\",g=0.85}";
    constexpr const char* kBack = "{type=\"henyey-greenstein\",g=-0.5}";
    constexpr const char* kWater = "{type=\"cloud\",effective_radius_um=10}";
    const Row rows[] = {{"0.0025", kG85, "1", "45"}, {"0.0125", kG85, "1", "90"},
                        {"0.05", kG85, "1", "45"},   {"0.05", kG85, "1", "15"},
                        {"0.05", kG85, "0.9", "45"}, {"0.0125", kBack, "1", "45"},
                        {"0.05", kWater, "1", "45"}, {"0.05", "{type=\"rayleigh\"}", "1", "45"}};
    for (const Row& row : rows) {
        CAPTURE(row.extinction);
        CAPTURE(row.phase);
        CAPTURE(row.elevation);
        const double ratio =
            over_path(kSlab, {std::string("medium.0.extinction_per_m=") + row.extinction,
                              std::string("medium.0.phase=") + row.phase,
                              std::string("medium.0.albedo=") + row.albedo,
                              std::string("sun.elevation_deg=") + row.elevation});
        CHECK(ratio > 0.94);
        CHECK(ratio < 1.06);
    }
}

TEST_CASE("a cloud is as bright as by paths, from each side of the sun and within it") {
    for (const char* azimuth : {"0", "65", "180"}) {
        CAPTURE(azimuth);
        const double ratio = over_path(
            kSmallCumulus,
            {"medium.0.albedo=1", "method.name=\"raymarch\"", "raymarch.scattering=\"ordinates\"",
             "output.layers=[\"cloud\"]", "path.target_error=0", "path.samples_per_pixel=1024",
             std::string("sun.azimuth_deg=") + azimuth});
        CHECK(ratio > 0.92);
        CHECK(ratio < 1.08);
    }
    const double within =
        over_path(kSmallCumulus, {"method.name=\"raymarch\"", "raymarch.scattering=\"ordinates\"",
                                  "output.layers=[\"cloud\"]", "path.target_error=0",
                                  "path.samples_per_pixel=1024", "camera.position_m=[0,0,1000]",
                                  "camera.target_m=[300,100,1050]"});
    CHECK(within > 0.92);
    CHECK(within < 1.08);
}

/// A cloud and, to the east, smoke that overlaps it.
constexpr const char* kCloudAndSmoke = R"(
seed = 3
[camera]
position_m = [0, -3000, 1500]
target_m = [0, 0, 400]
fov_deg = 24
resolution = [32, 18]
[sun]
azimuth_deg = 65
elevation_deg = 45
[sky]
radiance = [0.05, 0.06, 0.08]
[[medium]]
density = "uniform:sphere"
bounds_m = [[-500, -250, 100], [100, 250, 700]]
resolution = [32, 32, 32]
extinction_per_m = 0.03
phase = { type = "henyey-greenstein", g = 0.85 }
[[medium]]
density = "uniform:sphere"
bounds_m = [[-50, -250, 100], [550, 250, 700]]
resolution = [32, 32, 32]
extinction_per_m = 0.02
albedo = 0.6
phase = { type = "henyey-greenstein", g = 0.5 }
[method]
name = "raymarch"
[raymarch]
scattering = "ordinates"
[path]
target_error = 0
samples_per_pixel = 1024
[output]
layers = ["cloud"]
)";

TEST_CASE("several media are as bright as by paths, each with its phase function and albedo") {
    for (const char* azimuth : {"0", "65", "250"})
        for (const char* albedo : {"0.6", "[0.9,0.7,0.4]"}) {
            CAPTURE(azimuth);
            CAPTURE(albedo);
            const double ratio =
                over_path(kCloudAndSmoke, {std::string("sun.azimuth_deg=") + azimuth,
                                           std::string("medium.1.albedo=") + albedo});
            CHECK(ratio > 0.95);
            CHECK(ratio < 1.05);
        }
    // From within: all moments are read.
    const double within = over_path(
        kCloudAndSmoke, {"camera.position_m=[-200,-100,400]", "camera.target_m=[200,0,450]"});
    CHECK(within > 0.92);
    CHECK(within < 1.08);
}

TEST_CASE("one medium in two halves is that medium") {
    // The same density twice, each of half the extinction, in boxes and voxels that are alike.
    constexpr const char* kHalf = R"(
[[medium]]
density = "uniform:box"
bounds_m = [[-400, -400, 0], [400, 400, 800]]
resolution = [2, 2, 16]
extinction_per_m = 0.01
phase = { type = "henyey-greenstein", g = 0.85 }
boundary = "periodic"
)";
    const double one = mean_of(scene_from(kSlab, {"medium.0.extinction_per_m=0.02"}));
    const std::string two = std::string(kSlab) + kHalf;
    const double both = mean_of(scene_from(two.c_str(), {"medium.0.extinction_per_m=0.01"}));
    CHECK(both / one == doctest::Approx(1).epsilon(1e-4));
}

TEST_CASE("directions and moments: the sphere is filled, and rotations leave degrees alone") {
    double area = 0, sum[3] = {}, square[3][3] = {};
    for (int j = 0; j < kOrdinates; ++j) {
        const std::array<double, 3> d = ordinate_direction(j);
        const double w = ordinate_weight(j);
        area += w;
        for (std::size_t a = 0; a < 3; ++a) {
            sum[a] += w * d[a];
            for (std::size_t b = 0; b < 3; ++b) square[a][b] += w * d[a] * d[b];
        }
    }
    constexpr double kSphere = 12.566370614359172;
    CHECK(area == doctest::Approx(kSphere).epsilon(1e-14));
    for (int a = 0; a < 3; ++a) {
        CHECK(std::abs(sum[a]) < 1e-14);
        for (int b = 0; b < 3; ++b)
            CHECK(square[a][b] == doctest::Approx(a == b ? kSphere / 3 : 0).epsilon(1e-13));
    }
}

TEST_CASE("what is taken out of a phase function leaves the light it turns as it was") {
    // sigma (1 - a g) of transport, and sigma (1 - a), are the same before and after. Shares within
    // 20 degrees: of g 0 and below next to nothing.
    constexpr struct {
        float g;
        double f;
    } kRows[] = {{-0.5f, 0}, {0.0f, 0.03}, {0.6f, 0.196}, {0.85f, 0.517}, {0.95f, 0.797}};
    for (const auto& row : kRows)
        for (const float albedo : {0.5f, 0.9f, 1.0f}) {
            CAPTURE(row.g);
            Optics optics;
            optics.phase = {kPhaseHg, row.g, 0, 1};
            for (float& a : optics.albedo) a = albedo;
            const OrdinateOptics o = ordinate_optics(optics, 0, row.f);
            const double rest = double(o.rest), kept = double(o.albedo);
            CHECK(rest == doctest::Approx(1 - double(albedo) * row.f).epsilon(1e-6));
            CHECK(rest * (1 - kept * double(o.moment[1])) ==
                  doctest::Approx(1 - double(albedo) * double(row.g)).epsilon(1e-5));
            CHECK(rest * (1 - kept) == doctest::Approx(1 - double(albedo)).epsilon(1e-5));
        }
}

TEST_CASE("what ordinates do not know is refused in a line, and auto takes octaves there") {
    const char* const sets[] = {"raymarch.powder=\"powder\"",   "raymarch.integrator=\"simpson\"",
                                "raymarch.light_path=\"cone\"", "raymarch.phase=\"peak\"",
                                "raymarch.sky_light=\"none\"",  "raymarch.ambient=0.1"};
    const auto hash = [](const Scene& scene) { return render_one(scene).report.hash; };
    for (const char* set : sets) {
        CAPTURE(set);
        const Scene scene = scene_from(kSlab, {set});
        const Status status = render(scene, {}, [](int, Image&, Report&) { return Status::ok(); });
        REQUIRE_FALSE(status);
        CHECK(status.message.find("ordinates") != std::string::npos);
        CHECK(status.message.find("allowed: ") != std::string::npos);
        CHECK(hash(scene_from(kSlab, {set, "raymarch.scattering=\"auto\""})) ==
              hash(scene_from(kSlab, {set, "raymarch.scattering=\"octaves\""})));
    }
    CHECK(hash(scene_from(kSlab, {"raymarch.scattering=\"auto\""})) == hash(scene_from(kSlab, {})));
    // Keys that only octaves have are not without effect.
    CHECK(hash(scene_from(kSlab, {"raymarch.scattering=\"auto\"", "raymarch.octaves=3"})) ==
          hash(scene_from(kSlab, {"raymarch.scattering=\"octaves\"", "raymarch.octaves=3"})));
}
