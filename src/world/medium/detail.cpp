// SPDX-License-Identifier: Apache-2.0
// See detail.h. Mean and cut of the noise are of integers, so that any order gives them.
// in: noise volumes of src/world/density -> out: tiles; densities of finer cells.
// docs/detail.md, "Formula"
#include "src/world/medium/detail.h"

#include <cmath>

#include "kernels_cpu/media/detail.h"
#include "platform/threads.h"
#include "src/base/number_text.h"
#include "src/world/density/noise_volume.h"
#include "src/world/medium/refine.h"

namespace pileus {
namespace {

constexpr double kMaxTiles = 65536;  // along the box: a float then still tells a cell of the tile
constexpr int kCut = 146;            // two deviations of a noise volume, in half steps of a byte
constexpr double kWhole = 1 << 20;   // weight of a noise that is alone
constexpr std::uint32_t kLifeSeeds = 0x9e3779b9u;  // between the seeds of two lives

/// A byte's distance from the middle in half steps, cut at two deviations: noise seldom goes
/// farther, and would hardly be seen if its rarest value were the strongest.
std::int64_t cut_byte(std::uint8_t byte) {
    const int twice = 2 * int(byte) - 255;
    return twice < -kCut ? -kCut : twice > kCut ? kCut : twice;
}

/// The noise between two others, one of which becomes the other during a life. Weights are smooth
/// in time, and independent noises keep their deviation by the root of the weights' squares.
struct Blend {
    std::int64_t first, second;
    std::int64_t most;  ///< what is cut, of both

    explicit Blend(double age) {
        const double since = age - std::floor(age);
        second = std::int64_t(since * since * (3 - 2 * since) * kWhole + 0.5);
        first = std::int64_t(kWhole) - second;
        const double a = double(first), b = double(second);
        most = std::int64_t(kCut * __builtin_sqrt(a * a + b * b));
    }
    std::int64_t of(std::uint8_t one, std::uint8_t other) const {
        const std::int64_t sum = first * cut_byte(one) + second * cut_byte(other);
        return sum < -most ? -most : sum > most ? most : sum;
    }
};

int octaves_of(const DetailSettings& s) {
    return s.octaves > 0 ? s.octaves : most_octaves(s.cells, kDetailLumps);
}

/// Whole periods fill a medium that repeats.
double period_of(const Medium& medium, double tile_m, std::size_t axis) {
    if (!medium.grid.periodic || axis == 2) return tile_m;
    const double times = std::floor(medium.extent_m[axis] / tile_m + 0.5);
    return medium.extent_m[axis] / (times > 1 ? times : 1);
}

Status check_tiles(const Scene& scene, const MediumSettings& settings, const Medium& medium) {
    double largest = 0;
    for (const double e : medium.extent_m) largest = e > largest ? e : largest;
    if (largest <= kMaxTiles * settings.detail.tile_m) return Status::ok();
    return Status::bad_input(scene.file + ": " + medium_key(scene, settings) +
                             ".detail.tile_m: too short for a box of " + number_text(largest) +
                             " m, " + number_text(settings.detail.tile_m) +
                             ", allowed: at least 1/65536 of it");
}

DetailView view_of(const DetailSettings& s, const Buffer<float>& tile, const Medium& medium) {
    DetailView v{};
    v.tile = tile.data();
    v.cells = s.cells;
    for (std::size_t a = 0; a < 3; ++a) {
        const double period = period_of(medium, s.tile_m, a);
        v.period[a] = float(period);
        v.per_metre[a] = float(s.cells / period);
    }
    v.strength = float(s.strength);
    v.core = medium.density_max > 0 ? float((1 - s.dense) / double(medium.density_max)) : 0.0f;
    return v;
}

/// Density with detail in the middle of each finer cell.
void fill_slice(const float* from, const Grid& coarse, const DetailView& v, int refine, int z,
                Medium& out) {
    const Grid& fine = out.grid;
    const float per_cell = 1.0f / float(refine);
    const std::int32_t size[3] = {coarse.size[0], coarse.size[1], coarse.size[2]};
    const auto middle = [](int i) { return float(i) + 0.5f; };
    for (int y = 0; y < fine.size[1]; ++y)
        for (int x = 0; x < fine.size[0]; ++x) {
            const Vec<float> cell{middle(x), middle(y), middle(z)};
            const Vec<float> p{cell.x * per_cell, cell.y * per_cell, cell.z * per_cell};
            const Vec<float> metres{cell.x * fine.cell_m[0], cell.y * fine.cell_m[1],
                                    cell.z * fine.cell_m[2]};
            const Corners<float> c =
                coarse.constant ? own_cell(p, size) : corners(p, size, coarse.periodic);
            out.volume.density[voxel_index(fine, x, y, z)] =
                with_detail(v, metres, interpolate(from, c));
        }
}

/// Puts a finer density with detail in place of the medium's own.
Status lay_detail(const DetailView& view, int refine, int threads, Medium& medium) {
    const Grid coarse = medium.grid;
    Buffer<float> from;
    from.swap(medium.volume.density);
    refine_grid({refine, refine, refine}, medium);
    PILEUS_TRY(allocate(arrays::density(medium.grid), medium.volume.density));
    parallel_for(threads, medium.grid.size[2], [&](std::int64_t z, int) {
        fill_slice(from.data(), coarse, view, refine, int(z), medium);
    });
    medium.density_max = 0;
    for (const float value : medium.volume.density.span())
        if (value > medium.density_max) medium.density_max = value;
    return Status::ok();
}

}  // namespace

Status make_detail_tile(const DetailSettings& settings, const KernelTable& kernels, int threads,
                        Buffer<float>& tile) {
    NoiseParams params{};
    params.kind = settings.noise == DetailNoise::kPerlin ? kNoisePerlin : kNoiseWorley;
    params.size = settings.cells;
    params.cells = kDetailLumps;
    params.octaves = octaves_of(settings);
    params.gain = 0.5f;
    const Blend blend(settings.age);
    const auto life = std::uint32_t(std::floor(settings.age));
    Buffer<std::uint8_t> bytes, next;
    params.seed = std::uint32_t(settings.seed) + life * kLifeSeeds;
    PILEUS_TRY(make_noise(params, kernels, threads, bytes));
    if (blend.second > 0) {
        params.seed += kLifeSeeds;
        PILEUS_TRY(make_noise(params, kernels, threads, next));
    }
    const std::uint8_t* const other = blend.second > 0 ? next.data() : bytes.data();
    PILEUS_TRY(allocate(arrays::detail_tile(settings.cells), tile));
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) sum += blend.of(bytes[i], other[i]);
    // Less the mean, and no lower than -1.
    const double mean = double(sum) / double(bytes.size());
    const double most = double(blend.most) + (mean > 0 ? mean : 0);
    const std::size_t n = std::size_t(settings.cells), edge = n + 1;
    for (std::size_t z = 0; z < edge; ++z)
        for (std::size_t y = 0; y < edge; ++y)
            for (std::size_t x = 0; x < edge; ++x) {
                const std::size_t i = ((z % n) * n + y % n) * n + x % n;
                tile[(z * edge + y) * edge + x] =
                    float((double(blend.of(bytes[i], other[i])) - mean) / most);
            }
    return Status::ok();
}

Status outline_detail(const Scene& scene, const MediumSettings& settings, const Limits& limits,
                      Medium& medium, MediumSource& source) {
    const DetailSettings& s = settings.detail;
    if (!s.present()) return Status::ok();
    PILEUS_TRY(check_tiles(scene, settings, medium));
    // The noise as floats and as bytes, that which it becomes, and the tile.
    const std::uint64_t cells = std::uint64_t(s.cells);
    const std::uint64_t noise = noise_making_bytes(cells) + cells * cells * cells;
    if (s.refine == 0) {
        source.tile_cells = s.cells;
        source.making.push_back({"noise of detail", noise, 0});
        return Status::ok();
    }
    source.making.push_back({"noise of detail", noise + arrays::detail_tile(s.cells).bytes(), 0});
    source.making.push_back(
        {"density before its detail", bytes_of(4, voxel_count(medium.grid)), 0});
    refine_grid({s.refine, s.refine, s.refine}, medium);
    return check_voxels(scene.file, medium.volume.size, limits);
}

Status add_detail(const Scene& scene, const MediumSettings& settings, int threads,
                  const KernelTable* kernels, Medium& medium) {
    const DetailSettings& s = settings.detail;
    if (!s.present()) return Status::ok();
    PILEUS_TRY(check_tiles(scene, settings, medium));
    MediumDetail& detail = medium.detail;
    PILEUS_TRY(make_detail_tile(s, kernels_of(kernels), threads, detail.tile));
    detail.view = view_of(s, detail.tile, medium);
    // Two steps over each of the smallest lumps.
    detail.step_m = float(s.tile_m / double(kDetailLumps << octaves_of(s)));
    if (s.refine == 0) return Status::ok();
    PILEUS_TRY(lay_detail(detail.view, s.refine, threads, medium));
    medium.detail = MediumDetail{};
    return Status::ok();
}

Status refuse_marched_detail(const Scene& scene, const std::string& who) {
    for (const MediumSettings& settings : scene.media)
        if (settings.detail.is_marched())
            return Status::bad_input(scene.file + ": " + medium_key(scene, settings) +
                                     ".detail.refine: " + who +
                                     " knows detail on a grid alone, 0, allowed: 1 to 16");
    return Status::ok();
}

std::string told_detail(std::size_t name, const DetailSettings& s) {
    if (!s.present()) return {};
    const std::string text = "detail of medium " + std::to_string(name) + ", ";
    if (s.refine == 0) return text + "made while marching";
    return text + "laid on cells " + std::to_string(s.refine) + " times as fine";
}

}  // namespace pileus
