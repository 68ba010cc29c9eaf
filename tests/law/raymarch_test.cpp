// SPDX-License-Identifier: Apache-2.0
// Laws of the raymarch's pictures: skipping, cutting and widths of lanes change nothing, what
// stands in an opaque cloud leaves no trace, skylight in thin media is the sky's. in: a small
// cumulus, its settings -> out: planes of pixels compared. docs/raymarch.md; Palenik 2016,
// figure 4.2.
#include <doctest/doctest.h>

#include <cmath>

#include "src/base/digest.h"
#include "src/methods/march/march.h"
#include "src/picture/blue_noise.h"
#include "src/world/camera/view.h"
#include "src/world/medium/mix_media.h"
#include "src/world/phase/forward_share.h"
#include "tests/support/render_harness.h"

namespace raymarch_test {

using namespace render_test;

/// A cumulus with everything that a march needs, to be marched under changing settings.
struct Rig {
    Scene scene;
    Context context;
    Report report;
    Medium medium;
    Majorants majorants;
    Lighting lighting;
    SunDepth nodes;
    SkyNodes sky;
    Buffer<float> noise;
    std::vector<DensityLevel> levels;
    RaymarchInput in;

    explicit Rig(const std::vector<std::string>& overrides) {
        scene = scene_from(kSmallCumulus, overrides);
        context.kernels = kernel_table(nullptr);
        context.report = &report;
        Plan plan;
        REQUIRE(load_media(scene, context.limits, 1, plan, medium));
        REQUIRE(make_majorants(medium, false, context, majorants));
        lighting = make_lighting({scene.sun, scene.sky, scene.ground, scene.lights}, medium,
                                 place_of(scene.sun));
        REQUIRE(make_sun_depth(context, medium, majorants, lighting.to_sun, SunDepthKind::kExact,
                               nodes));
        in.camera = make_camera(scene.camera, 0, medium.low_m);
        const SkyView view{true, in.camera, float(scene.raymarch.scattering.octave_anisotropy)};
        if (scene.raymarch.light.sky_ambient)
            REQUIRE(make_sky_nodes(context, medium, majorants, lighting,
                                   mean_kept(scene.raymarch.scattering, medium),
                                   octaves_of(scene.raymarch.scattering), view, sky));
        if (scene.raymarch.march.jitter == RaymarchJitterKind::kBlueNoise)
            REQUIRE(make_blue_noise(noise));
        REQUIRE(make_density_levels(medium, 4, majorants.skip_block, context, levels));
        in.medium = &medium;
        in.majorants = &majorants;
        in.lighting = &lighting;
        in.settings = &scene.raymarch;
        in.nodes.sun = &nodes;
        if (scene.raymarch.light.sky_ambient) in.nodes.sky = &sky;
        in.noise = &noise;
        if (scene.raymarch.march.detail) in.levels = &levels;
        in.march_light = scene.raymarch.light.kind == RaymarchLightKind::kMarch;
    }

    /// The picture, with something solid so many metres away in its left half.
    Planes march(float solid_m = 0, RaymarchTally* tally = nullptr) {
        Planes planes;
        const int w = in.camera.width, h = in.camera.height;
        REQUIRE(allocate_planes(w, h, 3, solid_m > 0, true, planes));
        for (std::size_t i = 0; i < planes.opaque_depth.size(); ++i)
            planes.opaque_depth[i] = int(i) % w < w / 2 ? solid_m : __builtin_inff();
        RaymarchTally own;
        REQUIRE(raymarch_picture(context, in, planes, tally != nullptr ? *tally : own));
        return planes;
    }
};

std::string digest_of(const Planes& p) {
    Digest d;
    d.floats(p.colour.span());
    d.floats(p.transmittance.span());
    d.floats(p.half_depth.span());
    return d.hex();
}

const char* const kRules[] = {"closed", "riemann", "trapezoid", "simpson", "simpson38"};

TEST_CASE("raymarch: empty blocks are skipped without a change of bits") {
    const std::vector<std::string> kinds[] = {
        {"raymarch.spacing=uniform", "raymarch.light=march", "raymarch.sky_light=none"},
        {"raymarch.spacing=voxel", "raymarch.jitter=hash", "raymarch.grid_lock_m=100"},
        {"raymarch.spacing=optimal", "raymarch.steps=200", "raymarch.detail=true",
         "camera.fov_deg=5", "camera.target_m=[450,0,1300]", "medium.0.resolution=[40,40,26]"},
        {"raymarch.spacing=geometric", "raymarch.growth=1.01", "raymarch.detail=true",
         "raymarch.steps=60", "camera.fov_deg=5", "camera.target_m=[450,0,1300]",
         "medium.0.resolution=[40,40,26]"}};
    for (const auto& kind : kinds)
        for (const char* rule : kRules) {
            std::vector<std::string> overrides = kind;
            overrides.push_back(std::string("raymarch.integrator=") + rule);
            Rig rig(overrides);
            CAPTURE(rule);
            CAPTURE(kind[0]);
            RaymarchTally skipped, whole;
            const std::string leaping = digest_of(rig.march(0, &skipped));
            for (float& bound : rig.majorants.skipping.span()) bound = 1;
            for (DensityLevel& level : rig.levels)
                for (float& bound : level.majorants.span()) bound = 1;
            CHECK(digest_of(rig.march(0, &whole)) == leaping);
            CHECK(skipped.samples < whole.samples);
        }
}

TEST_CASE("raymarch: every width of lanes, the same bits and counts") {
    Rig rig({"raymarch.integrator=simpson38", "raymarch.spacing=optimal", "raymarch.steps=24",
             "raymarch.scattering=forward", "raymarch.light=march", "raymarch.light_steps=4",
             "raymarch.light_path=cone", "raymarch.jitter=hash", "raymarch.detail=true",
             "raymarch.powder=directional", "raymarch.ambient=[0.1,0.2,0.3]"});
    RaymarchTally first;
    rig.context.kernels = kernel_table_at(0);
    const std::string digest = digest_of(rig.march(2500, &first));
    CHECK(first.samples > 0);
    for (int i = 1; kernel_table_at(i) != nullptr; ++i) {
        rig.context.kernels = kernel_table_at(i);
        RaymarchTally tally;
        CHECK(digest_of(rig.march(2500, &tally)) == digest);
        CHECK(tally.samples == first.samples);
        CHECK(tally.light_samples == first.light_samples);
    }
}

/// Largest change by something solid where next to no light comes from behind it, and how much
/// could: transmittance there times the phase function's peak.
struct Ghost {
    double change = 0, allowed = 0;
    int pixels = 0;
};
Ghost ghost_of(const char* rule, const char* occlusion) {
    // Palenik's figure 4.2: the camera stands in an opaque cloud, its steps are too long.
    Rig rig({"camera.position_m=[0,-300,800]", "camera.target_m=[200,400,800]",
             "medium.0.extinction_per_m=0.25", "raymarch.stop_below=0", "raymarch.steps=64",
             "raymarch.sky_light=none", "raymarch.scattering=forward",
             "raymarch.forward_share=0.97", std::string("raymarch.integrator=") + rule,
             std::string("raymarch.occlusion=") + occlusion});
    const Planes without = rig.march(1e6f), with = rig.march(250);
    const double peak = double(phase_peak(rig.medium));
    Ghost ghost;
    const std::size_t pixels = with.transmittance.size();
    for (std::size_t i = 0; i < pixels; ++i) {
        if (with.transmittance[i] > 1e-6f || int(i) % 24 >= 12) continue;
        ++ghost.pixels;
        ghost.allowed = std::max(ghost.allowed, peak * double(with.transmittance[i]));
        for (std::size_t c = 0; c < 3; ++c)
            ghost.change =
                std::max(ghost.change, std::fabs(double(with.colour[c * pixels + i]) -
                                                 double(without.colour[c * pixels + i])));
    }
    return ghost;
}

TEST_CASE("raymarch: nothing solid deep in an opaque cloud leaves a ghost, unless steps stretch") {
    for (const char* rule : kRules) {
        CAPTURE(rule);
        const Ghost cut = ghost_of(rule, "cut"), stretched = ghost_of(rule, "stretch");
        CAPTURE(cut.change);
        CAPTURE(cut.allowed);
        CAPTURE(stretched.change);
        CHECK(cut.pixels > 40);
        CHECK(cut.change <= cut.allowed);
        CHECK(stretched.change > 100 * cut.allowed);
    }
}

TEST_CASE("raymarch: rays that end early lose no more than what they would have seen") {
    Rig rig({"raymarch.ambient=1", "raymarch.sky_light=none", "sun.irradiance=0",
             "medium.0.extinction_per_m=0.0625"});
    const Planes early = rig.march();
    rig.scene.raymarch.march.stop_below = 0;
    const Planes late = rig.march();
    double worst = 0;
    for (std::size_t i = 0; i < early.colour.size(); ++i)
        worst = std::max(worst, double(late.colour[i]) - double(early.colour[i]));
    CHECK(worst > 0);
    CHECK(worst <= 1.01e-4);
}

TEST_CASE("raymarch: what exceeds its own bound is counted and scaled down to it") {
    for (const char* rule : kRules) {
        Rig rig({"raymarch.ambient=1", "raymarch.steps=6", "sun.irradiance=0",
                 "medium.0.density=uniform:box", "raymarch.sky_light=none",
                 std::string("raymarch.integrator=") + rule});
        RaymarchTally tally;
        const Planes planes = rig.march(0, &tally);
        CAPTURE(rule);
        // Riemann's and the closed form's weights are shares of what is left: never above 1.
        const bool bounded = std::string(rule) == "closed" || std::string(rule) == "riemann";
        CHECK((tally.breaches == 0) == bounded);
        for (float v : planes.colour.span()) CHECK(v <= 1.0002f);
    }
}

TEST_CASE("raymarch: a thin white medium under a constant sky cannot be told from it") {
    const char* kThin = "medium.0.extinction_per_m=1e-5";
    const Picture p = render_one(scene_from(
        kSmallCumulus, {"method.name=raymarch", "sun.irradiance=0", "sky.radiance=0.5", kThin,
                        "ground.altitude_m=-1e6", "camera.position_m=[16,-400,256]",
                        "medium.0.albedo=1", "output.layers=[\"alpha\"]"}));
    for (int y = 0; y < p.image.height / 2; ++y)
        for (int x = 0; x < p.image.width; ++x) {
            // Up to half of the light from all around is the ground's, at a fifth of the sky's.
            const double alpha = double(p.at("A", x, y));
            CHECK(double(p.at("G", x, y)) <= 0.5 + 1e-6);
            CHECK(double(p.at("G", x, y)) >= 0.5 - 0.5 * alpha);
        }
    const Picture all = render_one(scene_from(
        kSmallCumulus, {"method.name=raymarch", "sun.irradiance=0", "sky.radiance=0.5", kThin,
                        "ground.albedo=1", "medium.0.albedo=1", "output.layers=[\"alpha\"]"}));
    // A ground as bright as the sky closes the sphere: only what is scattered twice is missing.
    for (int y = 0; y < all.image.height; ++y)
        for (int x = 0; x < all.image.width; ++x) {
            const double alpha = double(all.at("A", x, y));
            if (alpha > 0) CHECK(std::fabs(double(all.at("G", x, y)) - 0.5) <= 0.02 * alpha);
        }
}

TEST_CASE("raymarch: octaves are copies of the first scattering in a thin medium") {
    const auto green = [](const std::vector<std::string>& more) {
        std::vector<std::string> overrides = {
            "medium.0.extinction_per_m=1e-6", "medium.0.phase={type=\"isotropic\"}",
            "medium.0.albedo=0.5", "sky.radiance=0", "ground.albedo=0"};
        overrides.insert(overrides.end(), more.begin(), more.end());
        return Rig(overrides).march();
    };
    const Planes one = green({"raymarch.scattering=single"});
    CHECK(digest_of(one) ==
          digest_of(green({"raymarch.scattering=octaves", "raymarch.octaves=1"})));
    // Each takes its share and the albedo once more: 1 + 0.3 + 0.09. What lies before the sun is
    // thinner for the later ones, at most by the whole depth: 1000 m of 1e-6.
    const Planes three =
        green({"raymarch.scattering=octaves", "raymarch.octaves=3", "raymarch.octave_share=0.6"});
    double lit = 0;
    for (std::size_t i = 0; i < one.colour.size(); ++i) {
        const double a = double(one.colour[i]), b = double(three.colour[i]);
        lit += a;
        if (a > 0) CHECK(std::fabs(b / a - 1.39) <= 1.39 * 1e-3);
    }
    CHECK(lit > 0);
}

TEST_CASE("raymarch: octaves never exceed the bound, and skylight through them no whole sphere") {
    // The shares' mean stays below one where each octave does; a white cloud under a constant sky
    // shows at most that sky.
    Rig rig({"raymarch.scattering=octaves", "raymarch.octave_share=0.9", "medium.0.albedo=1"});
    RaymarchTally tally;
    rig.march(0, &tally);
    CHECK(tally.breaches == 0);
    const Planes dark = Rig({"raymarch.scattering=octaves", "sun.irradiance=0", "sky.radiance=0.5",
                             "ground.albedo=1", "medium.0.albedo=1"})
                            .march();
    for (float v : dark.colour.span()) CHECK(v <= 0.5f * (1 + 1e-5f));
}

TEST_CASE("raymarch: a white cloud amid white surroundings cannot be told from them by octaves") {
    for (const char* extinction : {"0.001", "0.05", "2"}) {
        CAPTURE(extinction);
        const Scene scene =
            scene_from(kSmallCumulus, {"method.name = \"raymarch\"", "sun.irradiance = [0, 0, 0]",
                                       "raymarch.scattering = \"octaves\"",
                                       "sky.radiance = [1, 1, 1]", "ground.albedo = 1",
                                       "medium.0.albedo = 1", "raymarch.sky_light = \"ambient\"",
                                       std::string("medium.0.extinction_per_m = ") + extinction,
                                       "output.layers = [\"radiance\"]"});
        const Picture p = render_one(scene);
        // Every node's light is one but for rounding, and so is what every pixel shows.
        const auto& pixels = p.image.find("G")->pixels;
        for (const float v : pixels.span()) CHECK(double(v) == doctest::Approx(1).epsilon(1e-5));
    }
}

TEST_CASE("raymarch: octaves fade in absorbing media as light that diffuses does") {
    const PhaseParams even{kPhaseHg, 0, 0, 1};
    CHECK(diffusion_exponent(even, 1) == 0.0f);
    CHECK(diffusion_exponent(even, 0) == 1.0f);
    CHECK(double(diffusion_exponent(even, 0.9f)) == doctest::Approx(std::sqrt(0.3)).epsilon(1e-6));
    // Against paths of all orders: without it the shadow side is hundreds of times too bright.
    const std::vector<std::string> dark = {
        "sky.radiance = [0, 0, 0]",       "ground.albedo = 0",
        "medium.0.albedo = 0.9",          "medium.0.extinction_per_m = 0.05",
        "output.layers = [\"radiance\"]", "path.samples_per_pixel = 256"};
    const auto mean = [&](const char* method) {
        std::vector<std::string> settings = dark;
        settings.push_back(std::string("method.name = \"") + method + "\"");
        const Picture p = render_one(scene_from(kSmallCumulus, settings));
        const auto& pixels = p.image.find("G")->pixels;
        double sum = 0;
        for (const float v : pixels.span()) sum += double(v);
        return sum;
    };
    // Octaves are an approximation: a quarter is what they are off elsewhere (docs/raymarch.md).
    CHECK(mean("raymarch") == doctest::Approx(mean("path")).epsilon(0.25));
}

TEST_CASE("raymarch: levels of detail hold the density's mean") {
    Rig rig({"raymarch.detail=true"});
    double fine = 0;
    for (float v : rig.medium.volume.density.span()) fine += double(v);
    REQUIRE(rig.levels.size() == 4);
    double cells = 8;
    for (std::size_t l = 0; l < 3; ++l, cells *= 8) {
        double sum = 0;
        for (float v : rig.levels[l].density.span()) sum += double(v);
        CHECK(sum * cells == doctest::Approx(fine).epsilon(1e-5));
    }
    // 3 x 3 x 2 cells: odd sizes of a periodic grid would not meet themselves.
    CHECK(level_grids(rig.levels[2].grid, 4).size() == 2);
    Grid periodic = rig.levels[2].grid;
    periodic.periodic = true;
    CHECK(level_grids(periodic, 4).empty());
}

TEST_CASE("raymarch: blue noise holds each number once and no low frequencies") {
    Buffer<float> tile;
    REQUIRE(make_blue_noise(tile));
    constexpr int n = kNoiseTile;
    std::vector<bool> seen(n * n, false);
    for (float v : tile.span()) seen[std::size_t(v * n * n)] = true;
    CHECK(std::count(seen.begin(), seen.end(), true) == n * n);
    // Mean power of the waves that are longer than 8 pixels; white noise has 1/12 in each.
    double power = 0, waves = 0;
    for (int ky = -8; ky <= 8; ++ky)
        for (int kx = -8; kx <= 8; ++kx) {
            if (kx * kx + ky * ky > 64 || (kx == 0 && ky == 0)) continue;
            double re = 0, im = 0;
            for (int i = 0; i < n * n; ++i) {
                const double angle = 6.283185307179586 * (kx * (i % n) + ky * (i / n)) / n;
                re += double(tile[std::size_t(i)]) * std::cos(angle);
                im += double(tile[std::size_t(i)]) * std::sin(angle);
            }
            power += (re * re + im * im) / (n * n);
            waves += 1;
        }
    CHECK(power / waves * 12 < 0.05);
}

}  // namespace raymarch_test
