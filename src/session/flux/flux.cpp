// SPDX-License-Identifier: Apache-2.0
// See flux.h. Checks, lights, and the choice of the way.
// in: a scene -> out: what flux_paths.cpp or flux_photons.cpp measure.
// docs/flux.md
#include <algorithm>
#include <cmath>

#include "src/base/angles.h"
#include "src/io/volumes/weather_file.h"
#include "src/run/work_share.h"
#include "src/session/flux/flux_run.h"
#include "src/session/run_context.h"
#include "src/world/atmosphere/atmosphere.h"
#include "src/world/medium/detail.h"
#include "src/world/phase/forward_share.h"

namespace pileus {
namespace {

/// Rows of the map of a sky that shines from below. It is read bilinearly: the horizon is blurred
/// over a row, by which the flux is wrong by less than 10^-6.
constexpr int kBelowRows = 4096;
constexpr std::int64_t kUsualPhotons = 1 << 20;
/// Of fluxes without a budget: standard error over mean.
constexpr double kFluxAim = 0.005;

/// A sky that is dark above and has the settings' radiance below.
Status make_sky_below(const FluxSettings& settings, SkyMap& map) {
    Image image;
    image.width = 1;
    image.height = kBelowRows;
    const char* const names[3] = {"R", "G", "B"};
    for (std::size_t c = 0; c < 3; ++c) {
        image.channels.emplace_back();
        Channel& channel = image.channels.back();
        channel.name = names[c];
        PILEUS_TRY(channel.pixels.resize(kBelowRows, "sky below"));
        for (std::size_t y = kBelowRows / 2; y < std::size_t(kBelowRows); ++y)
            channel.pixels[y] = float(settings.below_radiance[c]);
    }
    return make_sky_map("--from-below", image, Sky{}, false, map);
}

Status add_planes(const char* const (&names)[3], std::size_t pixels, Image& maps) {
    for (const char* name : names) {
        maps.channels.emplace_back();
        maps.channels.back().name = name;
        PILEUS_TRY(maps.channels.back().pixels.resize(pixels, "flux maps"));
    }
    return Status::ok();
}

Status check_settings(const FluxSettings& settings, const Scene& scene, const Budget& budget) {
    const bool photons = settings.method == FluxMethod::kPhotons;
    if (budget.error > 0 || budget.seconds > 0)
        return unknown_budget(budget.error > 0 ? "--budget error" : "--budget seconds", "flux",
                              photons ? "photons=N" : "samples=N");
    if (budget.generations > 0)
        return unknown_budget("--budget generations", "flux", photons ? "photons=N" : "samples=N");
    if (photons && budget.samples >= 0)
        return unknown_budget("--budget samples", "photons", "photons=N");
    if (photons && scene.surface.sea)
        return Status::bad_input(
            scene.file +
            ": ground.surface: photons know land alone, \"sea\", allowed: land, "
            "or --method path");
    if (settings.absorbed && !photons)
        return Status::bad_input("--absorbed: by photons alone, allowed: --method photons");
    if (!settings.sensors.empty() && photons)
        return Status::bad_input("--sensors: by paths alone, allowed: --method path");
    if (settings.from_below && scene.ground.present)
        return Status::bad_input(scene.file +
                                 ": ground: lies between --from-below and the media, "
                                 "allowed: a scene without a ground");
    return Status::ok();
}

/// Paths find the sun by the density of phase functions, which light that goes exactly straight on
/// or back has not: it would be missing from every figure.
Status check_needles(const Scene& scene, const Medium& medium) {
    for (int i = 0; i < medium.count; ++i)
        if (needle_shares(medium.optics[std::size_t(i)].phase).any())
            return Status::bad_input(scene.file + ": medium." + std::to_string(i) +
                                     ".phase: a lobe of g = 1 or -1, which paths do not find, "
                                     "allowed: a wider one, or --method photons");
    return Status::ok();
}

Status check_flux(const Scene& scene, const Context& context, const Scenery& scenery,
                  bool from_below) {
    const auto fault = [&](const char* what) {
        return Status::bad_input(scene.file + ": " + what);
    };
    if (scene.media.empty()) return fault("medium: none, allowed: at least one, to measure");
    PILEUS_TRY(refuse_marched_detail(scene, "flux"));
    if (context.kernels->device != nullptr)
        return fault("--isa: a device, allowed: an instruction set of the host");
    if (!scene.solids.empty())
        return fault("solid: fluxes are those of media alone, allowed: a scene without solids");
    if (!scene.lights.empty())
        return fault("light: fluxes are shares of sun and sky, allowed: a scene without [[light]]");
    if (emits(scenery.world->medium))
        return fault("medium.emission: fluxes are shares of sun and sky, allowed: 0");
    if (!from_below && (!scenery.lighting.sunlit || !(scenery.lighting.to_sun[2] > 0)))
        return fault("sun: not above the horizon, or dark, allowed: what fluxes are shares of");
    return Status::ok();
}

/// The scene as it is measured: no camera; from below no lights of its own.
Scene scene_to_measure(const Scene& scene, const FluxSettings& settings) {
    Scene own = scene;
    own.method = "path";
    own.output = OutputSettings{};
    own.camera = Camera{};
    // What the plan weighs is a film of the columns, where they are known already.
    if (settings.columns[0] > 0) own.camera.resolution = settings.columns;
    if (settings.from_below) {
        own.sun.present = false;
        own.sky.present = false;
        own.view_files.sky_map.clear();
        own.atmosphere.present = false;
    }
    place_sun(own.atmosphere, 0, own.sun);
    return own;
}

Status choose_columns(const FluxSettings& settings, const FluxTask& task, FluxResult& out) {
    for (std::size_t a = 0; a < 2; ++a)
        out.columns[a] =
            settings.columns[a] > 0 ? settings.columns[a] : task.scenery.world->medium.grid.size[a];
    return check_limit(task.context.limits, LimitId::kPixels,
                       std::uint64_t(out.columns[0]) * std::uint64_t(out.columns[1]), "--columns");
}

}  // namespace

double flux_excess(const FluxTask& task, const FluxResult& flux) {
    constexpr double kLeast = 0.02;
    const bool photons = task.settings.method == FluxMethod::kPhotons;
    double worst = 0;
    const auto take = [&](const FluxShare& share, double least) {
        for (std::size_t c = 0; c < 3; ++c) {
            if (!(task.level[c] > 0)) continue;
            const double mean = std::fabs(share.mean[c]);
            const double allowed = kFluxAim * (mean > least ? mean : least);
            worst = std::max(worst, share.standard_error[c] / allowed);
        }
    };
    take(flux.reflectance, kLeast);
    take(flux.transmittance, kLeast);
    take(flux.absorptance, photons ? kLeast : 1.0);
    return worst;
}

namespace {

/// One measurement by so many paths a column, or photons.
Status measure_once(const FluxTask& task, std::int64_t count, FluxResult& out, Image& maps,
                    Report& report) {
    FluxResult fresh;
    fresh.mu0 = out.mu0;
    fresh.irradiance = out.irradiance;
    fresh.columns = out.columns;
    PILEUS_TRY(make_flux_maps(fresh.columns, maps));
    if (task.settings.method == FluxMethod::kPhotons) {
        PILEUS_TRY(flux_by_photons(task, count, fresh, maps, report));
    } else {
        fresh.samples = std::uint64_t(count);
        PILEUS_TRY(flux_by_paths(task, fresh.samples, fresh, maps));
    }
    out = std::move(fresh);
    return Status::ok();
}

/// Measures by `first`, and where no budget says how many again by as many as the errors ask for.
/// What is shown is one measurement, that of a budget of the same number.
Status measure_to_aim(FluxTask& task, std::int64_t first, bool aims, FluxResult& out, Image& maps,
                      Report& report) {
    constexpr std::uint64_t kMax = std::uint64_t{1} << 26;  // paths of a detector, or photons
    constexpr int kRounds = 4;
    // Errors are known to an eighth by photons: aim a little beyond.
    constexpr double kBeyond = 1.2;
    const bool photons = task.settings.method == FluxMethod::kPhotons;
    const std::uint64_t each =
        photons ? 1 : std::uint64_t(out.columns[0]) * std::uint64_t(out.columns[1]);
    const std::int64_t most = std::max(first, std::int64_t(kMax / each));
    const std::size_t counters = report.counters.size();
    for (int round = 0;; ++round) {
        report.counters.resize(counters);
        task.last = !aims || first >= most || round + 1 == kRounds;
        PILEUS_TRY(measure_once(task, first, out, maps, report));
        const double excess = flux_excess(task, out);
        if (!(excess > 1) || task.last) return Status::ok();
        const double wanted = double(first) * excess * excess * kBeyond;
        first = wanted < double(most) ? std::int64_t(wanted) + 1 : most;
    }
}

}  // namespace

Status make_flux_maps(const std::array<int, 2>& columns, Image& maps) {
    const std::size_t n = std::size_t(columns[0]) * std::size_t(columns[1]);
    maps = Image{};
    maps.width = columns[0];
    maps.height = columns[1];
    PILEUS_TRY(add_planes({"R", "G", "B"}, n, maps));
    PILEUS_TRY(add_planes({"error.R", "error.G", "error.B"}, n, maps));
    PILEUS_TRY(add_planes({"transmittance.R", "transmittance.G", "transmittance.B"}, n, maps));
    return add_planes({"direct.R", "direct.G", "direct.B"}, n, maps);
}

Status measure_flux(const Scene& scene, const RenderOptions& options, const FluxSettings& settings,
                    FluxResult& out, Image& maps, Report& report) {
    const Scene own = scene_to_measure(scene, settings);
    Context context;
    PILEUS_TRY(make_context(own, options, context, report));
    MethodRow row = path_row();
    // What is absorbed is told by the data's cells.
    row.world = WorldUse::kDataCells;
    Budget budget = options.budget;
    PILEUS_TRY(check_settings(settings, own, budget));
    const bool photons = settings.method == FluxMethod::kPhotons;
    const std::int64_t wanted = budget.photons >= 0 ? budget.photons : kUsualPhotons;
    if (photons) budget.photons = -1;
    PILEUS_TRY(row.check(own, budget));
    Scenery scenery(own);
    scenery.media = options.media;
    scenery.weather = make_weather_files();
    Plan plan;
    MadeMethod made;
    PathMethod& path = make_path({own, budget}, made);
    // The first plan weighs the largest film: a pixel a column.
    const auto open = [&]() -> Status {
        PILEUS_TRY(open_method(row, made, context, true, nullptr, nullptr, scenery, plan));
        if (settings.from_below) PILEUS_TRY(make_sky_below(settings, scenery.environment.sky_map));
        scenery.light(0);
        set_one_sun(scenery.lighting);
        PILEUS_TRY(path.set_view(context, scenery.view(0), {}));
        return check_flux(own, context, scenery, settings.from_below);
    };
    const Status opened = open();
    if (options.sharing != nullptr && !options.sharing->all_ready(bool(opened))) return opened;
    PILEUS_TRY(opened);
    if (!photons && scenery.lighting.sunlit) PILEUS_TRY(check_needles(own, scenery.world->medium));
    out = FluxResult{};
    FluxTask task{own, settings, context, scenery, path};
    PILEUS_TRY(choose_columns(settings, task, out));
    out.mu0 = settings.from_below ? 1 : double(scenery.lighting.to_sun[2]);
    for (std::size_t c = 0; c < 3; ++c) {
        const double light = settings.from_below ? kPi64 * settings.below_radiance[c]
                                                 : scenery.lighting.sun_irradiance[int(c)];
        out.irradiance[c] = float(light);
        task.level[c] = light * out.mu0;
    }
    if (photons) report.method = "photons";
    const bool aims = photons ? options.budget.photons < 0 : budget.samples <= 0;
    const std::int64_t first = photons              ? wanted
                               : budget.samples > 0 ? budget.samples
                                                    : own.path.samples_per_pixel;
    PILEUS_TRY(measure_to_aim(task, first, aims, out, maps, report));
    take_clocks(report.clocks);
    return Status::ok();
}

}  // namespace pileus
