// SPDX-License-Identifier: Apache-2.0
// See cumulus.h. Spheres pushed out by billows, cut flat at the base, turned into a firm shell.
// in: settings -> out: nx*ny*nz floats in [0, 1].
// Rise of liquid water: Rogers and Yau 1989, "A short course in cloud physics", ch. 3.
#include "src/world/density/cumulus.h"

#include <string>

#include "kernels_cpu/core/rng.h"
#include "kernels_cpu/procedural/noise.h"
#include "platform/threads.h"
#include "src/base/random_streams.h"
#include "src/scene/rows/density_row.h"
#include "src/world/density/bubbles.h"

namespace pileus {
namespace {

constexpr int kBlock = 8;                 // cells along a block's edge
constexpr int kPart = 4;                  // and along the edge of a part of it
constexpr int kWidth = 4;                 // cells computed side by side
constexpr std::uint64_t kFirstCloud = 4;  // seed 0 is the cloud a first picture should show
using FF = F<kWidth>;

// Lengths in units of the box's height.
constexpr float kBasePlane = 0.055f;  // height of the flat base over the box's floor
constexpr float kWarp = 0.030f;       // largest shift of a point by the warp, per axis
constexpr float kPushIn = 0.044f;     // largest displacement of the surface inwards
constexpr float kPushOut = 0.024f;    // and outwards
constexpr float kCore = 0.10f;        // depth from which on density no longer grows

struct Field {
    BubbleList list;
    std::array<int, 3> n{};
    std::array<float, 3> cell{};    // edge lengths of a cell
    std::array<float, 3> corner{};  // centre of cell 0
    float voxel = 0;                // longest of them
    float shell = 0;                // width of the edge of the cloud
    std::uint32_t seed = 0;
    float* density = nullptr;
};

template <class T>
T smooth(T t) {
    const T c = max_(min_(t, all<T>(1.0f)), all<T>(0.0f));
    return c * c * (3.0f - 2.0f * c);
}

struct Point {
    FF x, y, z;
};

/// Bends space at two scales, so that no sphere stays a sphere.
Point warp(const Field& f, const Point& p) {
    Point q = p;
    float scale = 4.5f, reach = kWarp * 0.45f;
    for (std::uint32_t octave = 0; octave < 2; ++octave) {
        const std::uint32_t s = f.seed + 16u + octave * 3u;
        q.x = q.x + reach * gradient_noise<FF>(p.x * scale, p.y * scale, p.z * scale, s);
        q.y = q.y + reach * gradient_noise<FF>(p.x * scale, p.y * scale, p.z * scale, s + 1u);
        q.z = q.z + reach * gradient_noise<FF>(p.x * scale, p.y * scale, p.z * scale, s + 2u);
        scale *= 2.7f, reach *= 0.45f;
    }
    return q;
}

/// Displacement outwards in [-kPushIn, kPushOut]: humps upon humps, as long as cells resolve them.
FF billows(const Field& f, const Point& p) {
    FF sum{};
    float size = 0.080f, reach = 0.030f;
    for (std::uint32_t octave = 0; octave < 4 && size > 1.9f * f.voxel; ++octave) {
        const float scale = 1.0f / size;
        const FF hump = billow<FF>(p.x * scale, p.y * scale, p.z * scale, f.seed + octave);
        sum = sum + reach * (hump - 0.65f);
        size *= 0.47f, reach *= 0.62f;
    }
    return sum;
}

/// Signed distance to the spheres named by `near`, negative inside.
FF distance(const Field& f, const Point& p, const std::uint16_t* near, std::size_t count) {
    FF d = all<FF>(1e9f);
    for (std::size_t i = 0; i < count; ++i) {
        const Bubble& b = f.list.bubbles[near[i]];
        const FF x = p.x - b.x, y = p.y - b.y, z = p.z - b.z;
        d = min_(d, sqrt_(x * x + y * y + z * z) - b.r);
    }
    return d;
}

/// Density at four points whose height above the base is p.z, and which are bent to `q`.
FF density_at(const Field& f, const Point& p, const Point& q, const std::uint16_t* near,
              std::size_t count) {
    const FF smooth_d = distance(f, q, near, count);
    if (!any(smooth_d < kPushOut + f.shell)) return FF{};
    // Calm the billows towards the base, where the cloud is young and ragged instead of firm.
    const FF calm = 0.55f + 0.45f * smooth<FF>(p.z * 8.0f);
    FF d = smooth_d;
    if (any(d > -(kPushIn + f.shell))) d = d - calm * billows(f, q);
    // Outside the edge nothing is left that the rest could scale.
    if (!any(d < 0.5f * f.shell)) return FF{};
    const FF slow = gradient_noise<FF>(p.x * 5.0f, p.y * 5.0f, p.z * 5.0f, f.seed + 40u);
    const FF fast = gradient_noise<FF>(p.x * 14.0f, p.y * 14.0f, p.z * 14.0f, f.seed + 41u);
    // Edge: a thin firm shell, then a core that entrainment has not reached.
    const FF edge = smooth<FF>(0.5f - d / f.shell);
    const FF core = 0.80f + 0.20f * smooth<FF>(smooth_d * (-1.0f / kCore));
    // Base: a plane that undulates by about one percent and fades in over a few.
    const FF ragged = 0.012f * slow + 0.016f * fast;
    const FF base = smooth<FF>((p.z + ragged) * (1.0f / 0.035f));
    const FF rise = min_(max_(p.z * (1.0f / f.list.top), all<FF>(0.0f)), all<FF>(1.0f));
    const FF profile = 0.35f + 0.65f * min_(rise * 1.3f, all<FF>(1.0f));
    const FF patchy = 1.0f - 0.10f * smooth<FF>(0.5f + slow);
    return edge * core * base * profile * patchy;
}

struct Block {
    std::array<int, 3> begin, end;
    std::array<float, 3> centre;
    float radius;
};

Block make_block(const Field& f, const std::array<int, 3>& begin, const std::array<int, 3>& end) {
    Block b{begin, end, {}, 0.0f};
    float sum = 0.0f;
    for (std::size_t a = 0; a < 3; ++a) {
        const float half = 0.5f * float(end[a] - begin[a]) * f.cell[a];
        b.centre[a] = f.corner[a] + (float(begin[a]) - 0.5f) * f.cell[a] + half;
        sum += half * half;
    }
    b.radius = sqrt_(sum) + 2.0f * kWarp;
    return b;
}

/// Keeps the spheres that can be nearest somewhere in the block; returns how many of `from` (all
/// spheres when null) stay in `kept`, 0 when the block lies clear of the cloud. `kept` may be
/// `from`.
std::size_t cull(const Field& f, const Block& b, const std::uint16_t* from, std::size_t count,
                 std::uint16_t* kept) {
    const auto gap = [&](std::size_t i) {
        const Bubble& s = f.list.bubbles[i];
        const float x = s.x - b.centre[0], y = s.y - b.centre[1], z = s.z - b.centre[2];
        return sqrt_(x * x + y * y + z * z) - s.r;
    };
    float nearest = 1e9f;
    for (std::size_t i = 0; i < count; ++i) nearest = min_(nearest, gap(from ? from[i] : i));
    if (nearest > b.radius + kPushOut + f.shell) return 0;
    std::size_t n = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t s = from ? from[i] : i;
        if (gap(s) <= nearest + 2.0f * b.radius) kept[n++] = std::uint16_t(s);
    }
    return n;
}

/// Ball around the bent points, a little wider than rounding needs.
void enclose(const Point* q, int count, Block& part) {
    Point low = q[0], high = q[0];
    for (int i = 1; i < count; ++i) {
        low = {min_(low.x, q[i].x), min_(low.y, q[i].y), min_(low.z, q[i].z)};
        high = {max_(high.x, q[i].x), max_(high.y, q[i].y), max_(high.z, q[i].z)};
    }
    const FF lows[3] = {low.x, low.y, low.z}, highs[3] = {high.x, high.y, high.z};
    float square = 0.0f;
    for (std::size_t a = 0; a < 3; ++a) {
        float from = lows[a][0], to = highs[a][0];
        for (int i = 1; i < kWidth; ++i) {
            from = min_(from, float(lows[a][i]));
            to = max_(to, float(highs[a][i]));
        }
        part.centre[a] = 0.5f * (from + to);
        square += 0.25f * (to - from) * (to - from);
    }
    part.radius = sqrt_(square) + 1e-4f;
}

/// Fills a part of a block. Few spheres can be the nearest to its points once these are bent;
/// `scratch` holds a list of kMaxBubbles numbers.
void fill_part(const Field& f, Block part, const std::uint16_t* near, std::size_t count,
               std::uint16_t* scratch) {
    Point p[kPart * kPart * kPart / kWidth] = {}, q[kPart * kPart * kPart / kWidth] = {};
    int points = 0;
    for (int z = part.begin[2]; z < part.end[2]; ++z)
        for (int y = part.begin[1]; y < part.end[1]; ++y, ++points) {
            p[points].x =
                f.corner[0] + (float(part.begin[0]) + to_float(iota<I<kWidth>>())) * f.cell[0];
            p[points].y = all<FF>(f.corner[1] + float(y) * f.cell[1]);
            p[points].z = all<FF>(f.corner[2] + float(z) * f.cell[2]);
            q[points] = warp(f, p[points]);
        }
    enclose(q, points, part);
    const std::size_t n = cull(f, part, near, count, scratch);
    if (n == 0) return;
    points = 0;
    for (int z = part.begin[2]; z < part.end[2]; ++z)
        for (int y = part.begin[1]; y < part.end[1]; ++y, ++points) {
            const FF value = density_at(f, p[points], q[points], scratch, n);
            const std::size_t row =
                (std::size_t(z) * std::size_t(f.n[1]) + std::size_t(y)) * std::size_t(f.n[0]);
            for (int i = 0; i < kWidth && part.begin[0] + i < part.end[0]; ++i)
                f.density[row + std::size_t(part.begin[0] + i)] = value[i];
        }
}

void fill_block(const Field& f, const Block& b, const std::uint16_t* near, std::size_t count,
                std::uint16_t* scratch) {
    static_assert(kPart == kWidth, "a row of a part is one group of lanes");
    for (int z = b.begin[2]; z < b.end[2]; z += kPart)
        for (int y = b.begin[1]; y < b.end[1]; y += kPart)
            for (int x = b.begin[0]; x < b.end[0]; x += kPart) {
                Block part = b;
                part.begin = {x, y, z};
                part.end = {min_(x + kPart, b.end[0]), min_(y + kPart, b.end[1]),
                            min_(z + kPart, b.end[2])};
                fill_part(f, part, near, count, scratch);
            }
}

/// Fills one row of blocks along x; `scratch` holds three lists of kMaxBubbles numbers.
void fill_row(const Field& f, int by, int bz, std::uint16_t* scratch) {
    // Leave the outermost layer of cells at zero.
    std::array<int, 3> begin{1, 1 + by * kBlock, 1 + bz * kBlock};
    std::array<int, 3> end{f.n[0] - 1, begin[1] + kBlock, begin[2] + kBlock};
    end[1] = min_(end[1], f.n[1] - 1), end[2] = min_(end[2], f.n[2] - 1);
    // Drop what is too far for the whole row first, then for each block.
    std::uint16_t *in_row = scratch, *in_block = scratch + kMaxBubbles;
    begin[0] = 1, end[0] = f.n[0] - 1;
    const std::size_t row = cull(f, make_block(f, begin, end), nullptr, f.list.count, in_row);
    for (int x = 1; row > 0 && x < f.n[0] - 1; x += kBlock) {
        begin[0] = x, end[0] = min_(x + kBlock, f.n[0] - 1);
        const Block block = make_block(f, begin, end);
        const std::size_t n = cull(f, block, in_row, row, in_block);
        if (n > 0) fill_block(f, block, in_block, n, scratch + 2 * kMaxBubbles);
    }
}

Status check(const CumulusSettings& s) {
    for (int n : s.resolution)
        if (n < 3 || n > 4096)
            return Status::bad_input("resolution: " + std::to_string(n) +
                                     " cells, allowed 3..4096 for procedural:cumulus");
    for (const double e : {s.extent_m.x, s.extent_m.y, s.extent_m.z}) {
        const double share = e / s.extent_m[2];
        if (!(e > 0 && share >= 1e-3 && share <= 1e3))
            return Status::bad_input("bounds_m: the box's width over its height is " +
                                     std::to_string(share) +
                                     ", allowed 0.001..1000 for procedural:cumulus");
    }
    return Status::ok();
}

/// Lays out the grid and grows the bubbles so that all displacements stay inside the box.
Status prepare(const CumulusSettings& settings, Field& f) {
    f.n = settings.resolution;
    for (std::size_t a = 0; a < 3; ++a) {
        const double cell = settings.extent_m[a] / settings.extent_m[2] / double(f.n[a]);
        f.cell[a] = float(cell);
        f.corner[a] = float(-0.5 * cell * double(f.n[a] - 1));
        f.voxel = max_(f.voxel, f.cell[a]);
    }
    // Stand the base plane on the lowest cells that may hold cloud.
    const float floor = kBasePlane + f.cell[2];
    f.corner[2] = 0.5f * f.cell[2] - floor;
    f.shell = max_(1.3f * f.voxel, 0.008f);
    const float skin = kWarp + kPushOut + 0.5f * f.shell + f.voxel;
    const float half_x = 0.5f * f.cell[0] * float(f.n[0]) - skin;
    const float half_y = 0.5f * f.cell[1] * float(f.n[1]) - skin;
    const float height = 1.0f - floor - skin;
    constexpr float kLeast = 0.05f;  // for grids too coarse to leave room
    const std::uint64_t seed = std::uint64_t(settings.seed) + kFirstCloud;
    f.seed = make_key(seed, kDetailStream, 0).k0;
    return grow_bubbles(seed, max_(half_x, kLeast), max_(half_y, kLeast), max_(height, kLeast),
                        f.list);
}

DensityOutline outline_row(const MediumSettings&) {
    constexpr double kMean = 0.08;  // in the default box, which other boxes come close to
    return {CumulusSettings().resolution, kMean, kMaxBubbles * sizeof(Bubble),
            3 * kMaxBubbles * sizeof(std::uint16_t)};
}

Status make_row(const MediumSettings& medium, const DensityMaking& with, Volume& volume) {
    CumulusSettings settings;
    settings.resolution = with.size;
    settings.seed = medium.shape_seed;
    settings.extent_m = medium.bounds_m[1] - medium.bounds_m[0];
    return make_cumulus(settings, with.threads, volume);
}

constexpr DensityRow cumulus_row() {
    DensityRow row;
    row.name = "procedural:cumulus";
    row.takes_seed = true;
    row.least_cells = 3;  // the outermost layer of cells stays empty
    row.outline = outline_row;
    row.mean_within = 1.05;
    row.working = "bubbles of the cumulus";
    row.make = make_row;
    return row;
}

}  // namespace

Status make_cumulus(const CumulusSettings& asked, int threads, Volume& volume) {
    CumulusSettings settings = asked;
    if (settings.resolution == std::array<int, 3>{0, 0, 0})
        settings.resolution = CumulusSettings().resolution;
    PILEUS_TRY(check(settings));
    Field f;
    PILEUS_TRY(prepare(settings, f));
    const std::uint64_t cells =
        std::uint64_t(f.n[0]) * std::uint64_t(f.n[1]) * std::uint64_t(f.n[2]);
    PILEUS_TRY(volume.density.resize(cells, "cumulus"));
    f.density = volume.density.data();
    const int workers = threads > 0 ? threads : hardware_threads();
    Buffer<std::uint16_t> scratch;
    PILEUS_TRY(scratch.resize(3 * std::uint64_t(workers) * kMaxBubbles, "cumulus scratch"));
    const int rows_y = (f.n[1] - 3) / kBlock + 1, rows_z = (f.n[2] - 3) / kBlock + 1;
    parallel_for(workers, std::int64_t(rows_y) * rows_z, [&](std::int64_t piece, int thread) {
        fill_row(f, int(piece % rows_y), int(piece / rows_y),
                 scratch.data() + 3 * std::size_t(thread) * kMaxBubbles);
    });
    volume.size = f.n;
    volume.knows_bounds = false;
    return Status::ok();
}

extern const DensityRow kCumulusDensity;
constexpr DensityRow kCumulusDensity = cumulus_row();

}  // namespace pileus
