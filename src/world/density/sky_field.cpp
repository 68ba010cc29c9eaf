// SPDX-License-Identifier: Apache-2.0
// See sky_field.h. Offsets are taken within one tile in double, so that a wind may blow for years.
// in: SkySettings -> out: SkyParams, densities.
#include "src/world/density/sky_field.h"

#include <algorithm>
#include <cmath>

#include "platform/threads.h"
#include "src/run/device_launch.h"
#include "src/run/on_device.h"
#include "src/scene/checks/check_keys.h"
#include "src/scene/rows/density_row.h"

namespace pileus {
namespace {

constexpr int kColumns = 8192, kHeights = 32;
constexpr double kColumnTiles = 64;  // columns are strewn over so many tiles
constexpr std::uint32_t kWorleySeed = 0x51ed270bu;

NoiseParams noise_params(const SkySettings& settings, const SkyNoise& noise, NoiseKind kind) {
    NoiseParams p{};
    p.kind = kind, p.size = settings.size, p.cells = noise.cells;
    p.octaves = noise.octaves > 0 ? noise.octaves : most_octaves(settings.size, noise.cells);
    p.gain = float(settings.roughness);
    p.seed = std::uint32_t(settings.seed) + (kind == kNoiseWorley ? kWorleySeed : 0u);
    return p;
}

double within_one(double v) { return v - std::floor(v); }

/// Cosine and sine of an angle between a tile's axes and the world's.
struct TileTurn {
    double cosine, sine;
};
/// Tiles of skies that need not repeat over a box: turned against one another and against the axes,
/// that rows of tiles do not line up towards the horizon. Angles of 3-4-5 and 5-12-13.
constexpr TileTurn kPerlinTurn{0.8, 0.6}, kWorleyTurn{12.0 / 13, -5.0 / 13}, kNoTurn{1, 0};

/// Places a noise in the medium's local metres; `weight` is its share of the blend.
void place_noise(const SkySettings& settings, const SkyNoise& noise, const Double3& low_m,
                 double weight, const TileTurn& turn, double time_s, const NoiseTexture& texture,
                 NoiseView& view) {
    const double tile = noise.tile_m * settings.scale, share = weight * noise.gain / 255;
    view = texture.view();
    view.per_m = float(1 / tile);
    view.share = float(share);
    view.most = float(share * texture.most * (1 + 1e-6));
    view.turn[0] = float(turn.cosine), view.turn[1] = float(turn.sine);
    const auto& wind = settings.wind_m_per_s;
    const double low[3] = {turn.cosine * low_m[0] + turn.sine * low_m[1],
                           turn.cosine * low_m[1] - turn.sine * low_m[0], low_m[2]};
    const double blows[3] = {turn.cosine * wind[0] + turn.sine * wind[1],
                             turn.cosine * wind[1] - turn.sine * wind[0], 0};
    for (std::size_t a = 0; a < 3; ++a) {
        const double blown = std::fmod(blows[a] * time_s, tile);
        view.offset[a] = float(within_one(low[a] / tile) - within_one(blown / tile));
    }
    for (int l = 0; l <= view.last; ++l) view.lost[l] = float(share * share * texture.lost[l]);
}

/// A whole share of the thickness becomes a ramp's slope; none is a step.
float slope_of(double share) { return share > 1e-6 ? float(1 / share) : 1e6f; }

double smooth(double t) {
    const double s = std::min(1.0, std::max(0.0, t));
    return s * s * (3 - 2 * s);
}

/// The least lift of each band, a little less than that of its samples: it must be a bound.
void set_bands(const SkySettings& settings, SkyParams& p) {
    constexpr int kSamples = 64;
    for (int band = 0; band < kSkyBands; ++band) {
        double most = 0;
        for (int i = 0; i <= kSamples; ++i) {
            // Half a sample wider on both sides.
            const double place = (double(i) * (kSamples + 1.0) / kSamples - 0.5) / kSamples;
            const double share = (band + place) / kSkyBands;
            const double shape =
                smooth(share * double(p.rise)) * smooth((1 - share) * double(p.fall));
            most = std::max(most, shape);
        }
        p.least_lift[band] = float(std::max(0.0, settings.rounding * (0.995 - most)));
    }
}

void place_layer(const SkySettings& settings, const Double3& low_m, SkyParams& p) {
    p.middle = float(0.5 * (settings.threshold_low + settings.threshold_high));
    p.half_width = float(0.5 * (settings.threshold_high - settings.threshold_low));
    p.low_m = float(settings.base_m);
    p.height_m = float(settings.top_m - settings.base_m);
    p.inverse_m = 1.0f / p.height_m;
    p.rise = slope_of(settings.base_rise), p.fall = slope_of(settings.top_fall);
    p.rounding = float(settings.rounding);
    p.base_weight = float(settings.base_density);
    for (std::size_t a = 0; a < 3; ++a) p.shift_m[a] = float(low_m[a]);
    p.curvature_per_m = settings.planet_radius_m > 0 ? float(1 / settings.planet_radius_m) : 0.0f;
    p.empty = settings.coverage == 0 ? 1 : 0;
    set_bands(settings, p);
}

/// Moves the ramp so that the asked share of columns reaches its middle: columns strewn over the
/// layer tell their largest noise, and the middle is its quantile.
Status cover(const SkySettings& settings, const KernelTable& kernels, int threads, SkyParams& p) {
    if (!(settings.coverage > 0)) return Status::ok();
    Buffer<float> most;
    PILEUS_TRY(most.resize(kColumns, "columns of a sky"));
    ColumnParams k{};
    k.sky = p, k.heights = kHeights;
    k.reach_m = float(kColumnTiles * settings.scale *
                      std::max(settings.perlin.tile_m, settings.worley.tile_m));
    const ColumnBuffers b{most.data()};
    constexpr int kPiece = 256;
    if (on_device(kernels.device))
        PILEUS_TRY(launch_on_device(*kernels.device, k, b, kColumns));
    else
        parallel_for(threads, kColumns / kPiece, [&](std::int64_t piece, int) {
            const std::uint32_t begin = std::uint32_t(piece) * kPiece;
            kernels.sky_columns(k, b, begin, begin + kPiece);
        });
    std::sort(most.data(), most.data() + kColumns);
    const double place = (1 - settings.coverage) * (kColumns - 1);
    const std::size_t below = std::size_t(place);
    const std::size_t above = std::min(below + 1, std::size_t(kColumns - 1));
    const double rest = place - double(below);
    p.middle = float(double(most[below]) * (1 - rest) + double(most[above]) * rest);
    return Status::ok();
}

DensityOutline outline_row(const MediumSettings& medium) {
    constexpr double kMean = 0.1;  // coverage and shape move it by a factor of several
    const SkyBytes bytes = sky_bytes(medium.sky);
    return {default_sky_size(medium), kMean, bytes.kept + bytes.making, 0};
}

Status make_row(const MediumSettings& medium, const DensityMaking& with, Volume& volume) {
    return bake_sky(medium, with.size, kernels_of(with.kernels), with.threads, volume, with.field,
                    with.wind_s);
}

/// Whether the box holds whole tiles of both noises: then it may repeat, and tiles lie along its
/// axes.
bool tiles_fill_box(const MediumSettings& settings) {
    for (std::size_t a = 0; a < 2; ++a)
        for (const SkyNoise* noise : {&settings.sky.perlin, &settings.sky.worley}) {
            const double edge = settings.box.bounds_m[1][a] - settings.box.bounds_m[0][a];
            const double tiles = edge / (noise->tile_m * settings.sky.scale);
            if (std::fabs(tiles - std::floor(tiles + 0.5)) > 1e-6 * tiles) return false;
        }
    return true;
}

constexpr DensityRow sky_row() {
    DensityRow row;
    row.name = "procedural:sky";
    row.needs_bounds = false;  // of a sky that is put on a grid `check_sky` asks for them
    row.table = "sky";
    row.check = check_sky;
    row.outline = outline_row;
    row.mean_within = 4;
    row.working = "noises of the sky";
    row.make = make_row;
    row.has_field = true;
    row.factor = [](const MediumSettings& medium) { return medium.sky.density; };
    row.detail = [](const MediumSettings& medium) { return ", type " + medium.sky.type; };
    return row;
}

}  // namespace

Status make_sky(const SkySettings& settings, const Double3& low_m, const KernelTable& kernels,
                int threads, SkyField& sky, bool turned, double wind_s) {
    const auto load = [&](const SkyNoise& noise, NoiseKind kind, NoiseTexture& texture) -> Status {
        Buffer<std::uint8_t> texels;
        NoiseOrigin origin;
        PILEUS_TRY(load_noise(noise_params(settings, noise, kind), cache_folder(), kernels, threads,
                              texels, origin));
        ++(origin == NoiseOrigin::kRead ? sky.read : sky.made);
        return pack_noise(texels, settings.size, threads, texture);
    };
    sky.made = sky.read = 0;
    if (settings.has_perlin()) PILEUS_TRY(load(settings.perlin, kNoisePerlin, sky.perlin));
    if (settings.has_worley()) PILEUS_TRY(load(settings.worley, kNoiseWorley, sky.worley));
    SkyParams& p = sky.params;
    place_layer(settings, low_m, p);
    const double time_s = settings.time_s + wind_s;
    place_noise(settings, settings.perlin, low_m, settings.blend, turned ? kPerlinTurn : kNoTurn,
                time_s, sky.perlin, p.perlin);
    place_noise(settings, settings.worley, low_m, 1 - settings.blend,
                turned ? kWorleyTurn : kNoTurn, time_s, sky.worley, p.worley);
    PILEUS_TRY(cover(settings, kernels, threads, p));
    sky.threshold_low = double(p.middle) - double(p.half_width);
    sky.threshold_high = double(p.middle) + double(p.half_width);
    return Status::ok();
}

void bound_sky(const double* extent_m, SkyField& sky) {
    // Farther than any horizon of the Earth's, and than flat layers are of use.
    constexpr float kReach = 2e6f;
    sky.params.boxed = extent_m != nullptr ? 1 : 0;
    for (std::size_t a = 0; a < 3 && extent_m != nullptr; ++a)
        sky.params.extent_m[a] = float(extent_m[a]);
    sky.params.reach_m = kReach;
}

std::array<int, 3> default_sky_size(const MediumSettings& settings) {
    double edge[3], longest = 0;
    for (std::size_t a = 0; a < 3; ++a) {
        edge[a] = settings.box.bounds_m[1][a] - settings.box.bounds_m[0][a];
        longest = std::max(longest, edge[a]);
    }
    std::array<int, 3> size;
    for (std::size_t a = 0; a < 3; ++a)
        size[a] = std::max(3, int(std::ceil(256 * edge[a] / longest - 1e-9)));
    return size;
}

Status bake_sky(const MediumSettings& settings, const std::array<int, 3>& size,
                const KernelTable& kernels, int threads, Volume& volume, SkyField* keep,
                double wind_s) {
    SkyField own;
    SkyField& sky = keep != nullptr ? *keep : own;
    PILEUS_TRY(make_sky(settings.sky, settings.box.bounds_m[0], kernels, threads, sky,
                        !tiles_fill_box(settings), wind_s));
    BakeParams k{};
    k.sky = sky.params;
    volume.size = size;
    std::uint64_t cells = 1;
    for (std::size_t a = 0; a < 3; ++a) {
        k.size[a] = volume.size[a];
        k.cell_m[a] =
            float((settings.box.bounds_m[1][a] - settings.box.bounds_m[0][a]) / volume.size[a]);
        k.width_m = std::max(k.width_m, k.cell_m[a]);
        cells *= std::uint64_t(volume.size[a]);
    }
    PILEUS_TRY(volume.density.resize(cells, "density"));
    const std::int64_t rows = std::int64_t(volume.size[1]) * volume.size[2];
    constexpr std::int64_t kRows = 64;
    const BakeBuffers b{volume.density.data()};
    if (on_device(kernels.device))
        PILEUS_TRY(launch_on_device(*kernels.device, k, b, std::uint32_t(rows)));
    else
        parallel_for(threads, (rows + kRows - 1) / kRows, [&](std::int64_t piece, int) {
            kernels.bake_sky_rows(k, b, std::uint32_t(piece * kRows),
                                  std::uint32_t(std::min(rows, (piece + 1) * kRows)));
        });
    volume.knows_bounds = false;
    return Status::ok();
}

SkyBytes sky_bytes(const SkySettings& settings) {
    const std::uint64_t size = std::uint64_t(settings.size);
    const std::uint64_t noises =
        (settings.has_perlin() ? 1u : 0u) + (settings.has_worley() ? 1u : 0u);
    const std::uint64_t texels = size * size * size;
    return {noises * noise_texture_bytes(size),
            std::max(noise_making_bytes(size), texels + noise_packing_bytes(size)) + 4 * kColumns};
}

extern const DensityRow kSkyDensity;
constexpr DensityRow kSkyDensity = sky_row();

}  // namespace pileus
