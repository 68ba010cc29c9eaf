// SPDX-License-Identifier: Apache-2.0
// See march.h.
#include "src/methods/march/march.h"

#include <algorithm>
#include <optional>

#include "kernels_cpu/core/rng.h"
#include "kernels_cpu/core/vec.h"
#include "platform/threads.h"
#include "src/base/angles.h"
#include "src/base/random_streams.h"
#include "src/base/single.h"
#include "src/picture/march_view.h"
#include "src/run/device_launch.h"
#include "src/run/on_device.h"
#include "src/world/camera/view.h"
#include "src/world/light/behind.h"
#include "src/world/phase/forward_share.h"

namespace pileus {
namespace {

/// Sum of growth^n over so many steps; large enough where it leaves the range of floats.
float series_of(double growth, int steps) {
    double sum = 0, power = 1;
    for (int n = 0; n < steps && sum < 1e30; ++n) sum += power, power *= growth;
    return float(sum);
}

std::int32_t rule_of(RaymarchIntegrator integrator) { return std::int32_t(integrator); }

/// Directions around the sun's, a quarter of half the cone farther off with each of four.
void set_turns(const RaymarchInput& in, RaymarchLight& light) {
    constexpr double kGoldenTurn = 360 * 0.38196601125010515180;
    const auto& s = in.lighting->to_sun;
    const Vec<float> axis{s[0], s[1], s[2]};
    light.turns = kLightTurns;
    for (int i = 0; i < kLightTurns; ++i) {
        const SineCosine off = sincos_deg(0.125 * in.settings->scattering.cone_deg * (i % 4 + 1));
        const SineCosine around = sincos_deg(kGoldenTurn * i);
        const Vec<float> d = turned(axis, float(off.cosine), float(off.sine), float(around.cosine),
                                    float(around.sine));
        light.direction[i][0] = d.x;
        light.direction[i][1] = d.y;
        light.direction[i][2] = d.z;
    }
}

void set_jitter(const RaymarchInput& in, StepParams& k) {
    k.grid_m = float(in.settings->march.grid_lock_m);
    k.jitter_share = float(in.settings->march.jitter_share);
    k.jitter = std::int32_t(in.settings->march.jitter);
    const Key key = make_key(in.seed, kJitterStream, 0);
    k.key[0] = key.k0;
    k.key[1] = key.k1;
}

double kept_of(const RaymarchScatterSettings& s, const Optics& optics) {
    if (!s.forward) return 0;
    return s.forward_share >= 0 ? s.forward_share : forward_share(optics.phase, 0.5 * s.cone_deg);
}

void set_light(const RaymarchInput& in, RaymarchParams& k) {
    const RaymarchSettings& s = *in.settings;
    RaymarchLight& light = k.light;
    light.march = in.march_light ? 1 : 0;
    if (in.nodes.sun != nullptr) light.nodes = in.nodes.sun->nodes;
    light.steps = s.light.steps;
    light.first_m = s.light.steps == 0 ? march_step(*in.medium) : float(s.light.first_step_m);
    light.growth = float(s.light.growth);
    light.series = s.light.steps > 0 ? series_of(s.light.growth, s.light.steps) : 1.0f;
    if (s.light.cone) set_turns(in, light);
    light.powder = std::int32_t(s.look.powder);
    light.powder_strength = float(s.look.powder_strength);
    light.forward = s.scattering.forward ? 1 : 0;
    light.channels = keep_forward(s.scattering, *in.medium, light.kept);
}

void set_media(const RaymarchInput& in, RaymarchParams& k) {
    const Lighting& lighting = *in.lighting;
    k.media = in.medium->count;
    for (int i = 0; i < in.medium->count; ++i) {
        const Optics& optics = in.medium->optics[std::size_t(i)];
        k.phase[i] = optics.phase;
        const float peak = phase_peak(optics.phase);
        k.phase_scale[i] = in.settings->look.peak_phase && peak > 0 ? 1.0f / peak : 1.0f;
        for (std::size_t c = 0; c < 3; ++c) {
            k.albedo[i][c] = optics.albedo[c];
            k.sun_source[i][c] = float(lighting.sun_irradiance[c] * double(optics.albedo[c]));
            if (lighting.sunlit && k.sun_source[i][c] > 0) k.sunlit = 1;
        }
    }
    for (std::size_t c = 0; c < 3; ++c) {
        k.to_sun[c] = lighting.to_sun[c];
        k.ambient[c] = in.settings->look.ambient[c];
    }
}

/// Maerkl 2018, 3.1.4 and 4.4.2: twice the light of a single scattering, less the powder effect.
void set_look(const OpticalDepthSettings& s, RaymarchParams& k) {
    k.sunlit = 0;
    for (int i = 0; i < k.media; ++i) {
        if (s.g >= -1) {
            k.phase[i] = {kPhaseHg, float(s.g), 0, 1};
            k.phase_scale[i] = 1;
        }
        for (float& source : k.sun_source[i]) {
            source = float(2 * s.intensity * double(source));
            if (source > 0) k.sunlit = 1;
        }
    }
    k.light.powder = s.powder_by_extinction ? kPowderLocal : kPowderSimple;
    if (!(s.powder_strength > 0)) k.light.powder = kPowderNone;
    k.light.powder_strength = float(s.powder_depth);
    k.light.powder_share = float(s.powder_strength);
}

void set_levels(const RaymarchInput& in, RaymarchParams& k) {
    if (in.levels == nullptr) return;
    for (const DensityLevel& level : *in.levels) {
        MediumView& v = k.level[k.levels++];
        v = k.medium;
        for (int a = 0; a < 3; ++a) {
            v.size[a] = level.grid.size[a];
            v.cell[a] = level.grid.cell_m[a];
        }
        block_counts(level.grid, in.majorants->skip_block, v.blocks);
        v.density = level.density.data();
        v.majorant = level.majorants.data();
    }
}

}  // namespace

int raymarch_levels(const RaymarchSettings& s, const CameraParams& camera, const Medium& medium,
                    double reach_m) {
    if (!s.march.detail) return 0;
    double diagonal = 0;
    for (double e : medium.extent_m) diagonal += e * e;
    diagonal = __builtin_sqrt(diagonal);
    const StepParams k = raymarch_steps(s.march, camera, medium.grid);
    double widest = double(k.pixel) * (camera.orthographic != 0 ? 1 : reach_m);
    const auto at_least = [&](double width) { widest = width > widest ? width : widest; };
    if (s.march.steps > 0 && s.march.spacing == RaymarchSpacing::kUniform)
        at_least(diagonal / s.march.steps);
    // Growing steps may end with any share of the way, a slanted way is longer.
    if (k.grows != 0) at_least(diagonal);
    if (s.light.steps > 0) at_least(diagonal);
    if (medium.grid.periodic) at_least(diagonal);
    int levels = 0;
    for (double cell = double(smallest_cell(medium.grid)); cell < widest && levels < kMaxLevels;
         cell *= 2)
        ++levels;
    return int(level_grids(medium.grid, levels).size());
}

void set_octaves(const RaymarchSettings& settings, const Medium& medium, const float (*first)[3],
                 float (*g)[kMaxOctaves], float (*source)[kMaxOctaves][3]) {
    const Octaves octaves = octaves_of(settings.scattering);
    for (int i = 0; i < medium.count; ++i) {
        const Optics& optics = medium.optics[std::size_t(i)];
        float own = phase_moment(optics.phase, 1), light[3];
        for (int c = 0; c < 3; ++c) light[c] = first[i][c];
        for (int n = 1; n < octaves.count; ++n) {
            own *= float(settings.scattering.octave_anisotropy);
            g[i][n] = own;
            for (int c = 0; c < 3; ++c) {
                light[c] *= optics.albedo[c] * octaves.share;
                source[i][n][c] = light[c];
            }
        }
    }
}

OctaveDepths octave_depths(const Octaves& octaves, const Medium& medium) {
    OctaveDepths out{};
    bool absorbs = false, coloured = false;
    for (int i = 0; i < medium.count && octaves.count > 1; ++i) {
        const Optics& optics = medium.optics[std::size_t(i)];
        for (std::size_t c = 0; c < 3; ++c) {
            absorbs |= optics.albedo[c] < 1;
            coloured |= optics.albedo[c] != optics.albedo[0];
            const float least = diffusion_exponent(optics.phase, optics.albedo[c]);
            float thinner = 1;
            for (int n = 1; n < octaves.count; ++n) {
                thinner *= octaves.extinction;
                out.thinner[i][n][c] = thinner > least ? thinner : least;
            }
        }
    }
    out.channels = !absorbs ? 0 : coloured ? 3 : 1;
    return out;
}

Octaves octaves_of(const RaymarchScatterSettings& s) {
    return {s.many ? s.octaves : 1, float(s.octave_extinction), float(s.octave_share)};
}

int keep_forward(const RaymarchScatterSettings& s, const Medium& medium,
                 float (&kept)[kMaxMedia][3]) {
    int channels = 1;
    for (int i = 0; s.forward && i < medium.count; ++i) {
        const Optics& optics = medium.optics[std::size_t(i)];
        const double share = kept_of(s, optics);
        for (std::size_t c = 0; c < 3; ++c) {
            kept[i][c] = float(share * double(optics.albedo[c]));
            if (kept[i][c] != kept[i][0]) channels = 3;
        }
    }
    return channels;
}

double mean_kept(const RaymarchScatterSettings& s, const Medium& medium) {
    double sum = 0;
    for (int i = 0; i < medium.count; ++i) {
        const Optics& optics = medium.optics[std::size_t(i)];
        for (float albedo : optics.albedo) sum += kept_of(s, optics) * double(albedo) / 3;
    }
    return medium.count > 0 ? sum / medium.count : 0;
}

StepParams raymarch_steps(const RaymarchStepSettings& s, const CameraParams& camera,
                          const Grid& grid) {
    StepParams k{};
    k.most = float(s.steps);
    k.stretch = s.stretch ? 1 : 0;
    k.growth = k.series = 1;
    k.pixel = pixel_step(camera);
    switch (s.spacing) {
        case RaymarchSpacing::kUniform:
            break;
        case RaymarchSpacing::kVoxel:
            k.least_m = smallest_cell(grid);
            // So many that the cell decides, as long as float counts them.
            if (s.steps > 0) k.most = grid.periodic ? 0x1p17f : 0x1p13f;
            break;
        case RaymarchSpacing::kOptimal:
            if (camera.orthographic != 0) {
                k.least_m = k.pixel;
                break;
            }
            k.grows = k.by_distance = 1;
            // No nearer than what is told from 0: the way over it is a number.
            k.near_m = (s.first_step_m > 0 ? float(std::max(s.first_step_m, kMinPositive))
                                           : 0.5f * smallest_cell(grid)) /
                       k.pixel;
            break;
        case RaymarchSpacing::kGeometric:
            k.least_m = float(s.first_step_m);
            k.growth = float(s.growth);
            k.grows = k.growth > 1 ? 1 : 0;
            k.series = series_of(s.growth, s.steps);
            break;
    }
    return k;
}

RaymarchParams raymarch_params(const RaymarchInput& in) {
    RaymarchParams k{};
    k.medium = make_medium_view(*in.medium, *in.majorants);
    k.camera = in.camera;
    k.lattice = in.lattice.every > 0 ? in.lattice : whole_lattice(in.camera);
    k.rule = rule_of(in.settings->march.integrator);
    k.step = raymarch_steps(in.settings->march, in.camera, in.medium->grid);
    if (in.medium->detail.present()) {
        // Levels are told by cells.
        k.medium.step = smallest_cell(in.medium->grid);
        if (in.settings->march.spacing == RaymarchSpacing::kVoxel)
            k.step.least_m = march_step(*in.medium);
    }
    if (!(in.medium->sigma > 0)) k.step.most = 0;  // nothing to see, and no light was made for it
    set_jitter(in, k.step);
    set_levels(in, k);
    if (in.nodes.sky != nullptr) {
        k.sky.nodes = in.nodes.sky->grid;
        k.sky.sets = in.nodes.sky->sets;
        std::memcpy(k.sky.colour, in.nodes.sky->colour, sizeof k.sky.colour);
    }
    k.cut = float(in.settings->march.stop_below);
    k.visibility = in.nodes.visibility_grid;
    set_media(in, k);
    set_light(in, k);
    k.light.octaves = octaves_of(in.settings->scattering);
    set_octaves(*in.settings, *in.medium, k.sun_source, k.light.octave_g, k.octave_source);
    k.octave_depths = octave_depths(k.light.octaves, *in.medium);
    if (in.look != nullptr) set_look(*in.look, k);
    return k;
}

OrdinatesMarchParams ordinates_params(const RaymarchInput& in, const RaymarchParams& march) {
    const OrdinateNodes& nodes = *in.nodes.ordinates;
    const Lighting& light = *in.lighting;
    OrdinatesMarchParams o{};
    o.march = march;
    o.nodes = nodes.grid;
    if (in.nodes.sky_levels != nullptr) o.levels = *in.nodes.sky_levels;
    o.sets = std::int32_t(nodes.shown.size());
    o.moments = nodes.has_moments ? kOrdinateMoments : 0;
    o.per_near = nodes.per_near;
    for (std::size_t s = 0; s < nodes.shown.size(); ++s) {
        const OrdinateShown& shown = nodes.shown[s];
        for (std::size_t c = 0; c < 3; ++c) o.colour[s][c] = shown.colour[c];
        for (int i = 0; i < nodes.media; ++i)
            for (int l = 0; l < 4; ++l)
                o.scatter[s][i][l] = ordinate_scatter(nodes.optics[i][shown.channel], l);
    }
    o.channels = in.medium->channels > 1 ? 3 : 1;
    o.turn = ordinate_peak();
    o.sunlit = march.sunlit;
    o.behind = nodes.behind;
    const bool told = nodes.ground.map.size[0] > 0;
    set_behind(light, told ? nodes.ground.sends : light.ground.radiance(), o.behind);
    o.behind.hidden = in.nodes.hidden ? 1 : 0;
    for (std::size_t c = 0; c < 3; ++c) {
        for (int i = 0; i < nodes.media; ++i) {
            o.rest[i][c] = nodes.optics[i][c].rest;
            o.sun[i][c] = march.sun_source[i][c];
        }
        o.beam_rest[c] = nodes.peak.rest[c];
    }
    return o;
}

Status raymarch_picture(const Context& context, const RaymarchInput& in, Planes& planes,
                        RaymarchTally& tally) {
    constexpr std::uint32_t kPiece = 4;
    const StageClock clock(context, "march");
    const RaymarchParams k = raymarch_params(in);
    const std::uint32_t rows = std::uint32_t(k.lattice.height);
    Buffer<std::int64_t> counts;
    PILEUS_TRY(allocate(arrays::raymarch_counts(rows), counts));
    RaymarchBuffers b{};
    if (in.nodes.sun != nullptr) b.optical_depth = in.nodes.sun->optical_depth.data();
    b.visibility = in.nodes.visibility;
    b.sky_light = in.nodes.sky_light;
    b.opaque_depth = planes.opaque_depth.data();
    if (in.nodes.sky != nullptr) b.sky = in.nodes.sky->light.data();
    if (in.noise != nullptr) b.noise = in.noise->data();
    b.parts = in.medium->parts.data();
    b.transmittance = planes.transmittance.data();
    b.half_depth = planes.half_depth.data();
    b.colour = planes.colour.data();
    b.ray_depth = planes.optical_depth.data();
    b.counts = counts.data();
    std::optional<RaymarchSkyParams> of_sky;
    if (in.layer != nullptr) of_sky = RaymarchSkyParams{k, in.layer->params};
    std::optional<OrdinatesMarchParams> of_ordinates;
    std::optional<OrdinatesSkyParams> of_sky_ordinates;
    OrdinatesMarchBuffers ordinates{};
    if (in.nodes.ordinates != nullptr) {
        of_ordinates = ordinates_params(in, k);
        if (in.layer != nullptr)
            of_sky_ordinates = OrdinatesSkyParams{*of_ordinates, in.layer->params};
        const OrdinateNodes& nodes = *in.nodes.ordinates;
        const float* const surfaces = in.nodes.surfaces;
        ordinates = {b,        nodes.light.data(),  nodes.near.data(), nodes.peak.tables.data(),
                     surfaces, nodes.sunward.data()};
    }
    // Where a device draws, it runs the others.
    const KernelTable& kernels = host_kernels(context.kernels);
    const auto march = [&](std::int64_t piece, int) {
        const std::uint32_t begin = std::uint32_t(piece) * kPiece;
        const std::uint32_t end = begin + kPiece < rows ? begin + kPiece : rows;
        if (of_sky_ordinates)
            kernels.ordinates_sky_rows(*of_sky_ordinates, ordinates, begin, end);
        else if (of_ordinates && k.medium.detail != nullptr)
            kernels.detail_ordinates_rows(*of_ordinates, ordinates, begin, end);
        else if (of_ordinates)
            kernels.ordinates_rows(*of_ordinates, ordinates, begin, end);
        else if (in.layer != nullptr)
            kernels.raymarch_sky_rows(*of_sky, b, begin, end);
        else if (k.medium.detail != nullptr)
            kernels.detail_raymarch_rows(k, b, begin, end);
        else
            kernels.raymarch_rows(k, b, begin, end);
    };
    const DeviceTable* const device = of_ordinates ? nullptr : context.kernels->device;
    if (on_device(device))
        PILEUS_TRY(of_sky ? launch_on_device(*device, *of_sky, b, rows)
                          : launch_on_device(*device, k, b, rows));
    const bool whole = on_device(device) || run_until(context.threads, (rows + kPiece - 1) / kPiece,
                                                      context.interrupted, march);
    if (!whole)
        return {Code::kCheckFailed, "interrupted before the picture was whole; no file written"};
    for (std::size_t row = 0; row < rows; ++row) {
        const std::int64_t* own = counts.data() + row * kRaymarchCounts;
        tally.samples += std::uint64_t(own[kCountSamples]);
        tally.light_samples += std::uint64_t(own[kCountLightSamples]);
        tally.breaches += std::uint64_t(own[kCountBreaches]);
        tally.cut += std::uint64_t(own[kCountCut]);
    }
    return Status::ok();
}

}  // namespace pileus
