// SPDX-License-Identifier: Apache-2.0
// See billboard_spheres.h.
// in: centres and radii -> out: camera coordinates, screen rectangles, sorted places, tile lists.
// Rectangle: tangents from the camera to the sphere's circle in the planes of each screen axis.
#include "src/methods/collectors/billboards/billboard_spheres.h"

#include <cmath>
#include <cstring>

#include "platform/threads.h"

namespace pileus {
namespace {

struct Interval {
    double low, high;
};

/// Tangent slopes of a circle at (side, ahead) seen from the origin; ahead > radius.
Interval tangents(double side, double ahead, double radius) {
    const double root = std::sqrt(side * side + (ahead - radius) * (ahead + radius));
    const double below = (ahead - radius) * (ahead + radius);
    return {(side * ahead - radius * root) / below, (side * ahead + radius * root) / below};
}

/// First and one past the last pixel whose centre may lie within [low, high] of the screen's
/// [-1, 1], one pixel wider on each side than exact arithmetic needs.
void pixel_range(double low, double high, std::int32_t count, std::int32_t& first,
                 std::int32_t& end) {
    const double from = std::floor((low + 1.0) * 0.5 * count - 0.5);
    const double to = std::ceil((high + 1.0) * 0.5 * count - 0.5) + 1.0;
    const double size = count;
    first = static_cast<std::int32_t>(from < 0.0 ? 0.0 : from > size ? size : from);
    end = static_cast<std::int32_t>(to < 0.0 ? 0.0 : to > size ? size : to);
}

/// A sphere's centre along the camera's axes.
struct SphereAt {
    double x, y, z, radius;
};

/// The rectangle of a sphere that the camera touches or sees at a grazing angle.
void find_rectangle(const CameraParams& c, const SphereAt& at, BlendSphere& s) {
    // Widen the sphere by the rounding of the kernel's distance, 16 units in the last place.
    const double reach = std::fabs(at.x) + std::fabs(at.y) + std::fabs(at.z);
    const double wide = at.radius + reach * 0x1p-20;
    s.kind = kBlendNear;
    if (at.z <= -wide) return;
    if (c.orthographic == 0 && at.z <= wide) {
        s.x1 = c.width;
        s.y1 = c.height;
        return;
    }
    const bool flat = c.orthographic != 0;
    const Interval x = flat ? Interval{at.x - wide, at.x + wide} : tangents(at.x, at.z, wide);
    const Interval y = flat ? Interval{at.y - wide, at.y + wide} : tangents(at.y, at.z, wide);
    pixel_range(x.low / c.half_width, x.high / c.half_width, c.width, s.x0, s.x1);
    pixel_range(-y.high / c.half_height, -y.low / c.half_height, c.height, s.y0, s.y1);
}

/// A sphere's ellipse on the image plane: middle, how its columns lean per row coordinate, and
/// q = 1 - ey (sy - y)^2 - ex (sx - x - lean (sy - y))^2; half a chord is scale sqrt(q) / |ray|.
struct Ellipse {
    double x, y, lean, ex, ey, scale;
};

/// From r^2 |ray|^2 - |centre x ray|^2, completed to squares; the sphere lies before the camera.
Ellipse find_ellipse(const SphereAt& p, bool flat) {
    const double r2 = p.radius * p.radius;
    if (flat) return {p.x, p.y, 0, 1 / r2, 1 / r2, p.radius};
    const double b = (p.z - p.radius) * (p.z + p.radius), a = b + p.y * p.y, t = a + p.x * p.x;
    return {p.x * p.z / b,    p.y * p.z / b,    p.x * p.y / a,
            a * b / (t * r2), b * b / (a * r2), std::sqrt(t * r2 / b)};
}

/// Whole and remaining part of a place between pixels; the kernel's differences stay exact.
float split(double at, std::int32_t& whole) {
    const double low = std::floor(at);
    whole = static_cast<std::int32_t>(low);
    return static_cast<float>(at - low);
}

/// Sets the ellipse in pixels and its rectangle. False where it is no ellipse to speak of: the
/// camera touches the sphere, or sees it so far aside that its ellipse is drawn out.
bool set_ellipse(const CameraParams& c, const SphereAt& at, BlendSphere& s) {
    if (!(at.z > at.radius * 1.001)) return false;
    const double across = at.x * at.x + at.y * at.y;
    if (c.orthographic == 0 && across > 64 * (at.z - at.radius) * (at.z + at.radius)) return false;
    const Ellipse e = find_ellipse(at, c.orthographic != 0);
    const double column = 2.0 * double(c.half_width) / c.width,
                 row = 2.0 * double(c.half_height) / c.height;
    const double x = (e.x + double(c.half_width)) / column - 0.5,
                 y = (double(c.half_height) - e.y) / row - 0.5;
    const double lean = -e.lean * row / column;
    const double high = 1 / (std::sqrt(e.ey) * row), reach = 1 / (std::sqrt(e.ex) * column);
    const double wide = std::sqrt(reach * reach + lean * lean * high * high);
    constexpr double kFar = 1 << 22;
    if (!(std::fabs(x) < kFar && std::fabs(y) < kFar && wide < kFar && high < kFar)) return false;
    s.kind = kBlendEllipse;
    s.column_part = split(x, s.column);
    s.row_part = split(y, s.row);
    s.lean = static_cast<float>(lean);
    s.ex = static_cast<float>(e.ex * column * column);
    s.ey = static_cast<float>(e.ey * row * row);
    s.reach = static_cast<float>(reach * (1 + 0x1p-18));
    s.half_scale = static_cast<float>(e.scale);
    const auto range = [](double middle, double side, std::int32_t count, std::int32_t& first,
                          std::int32_t& end) {
        const double size = count, from = std::floor(middle - side - 0.01) + 1,
                     to = std::floor(middle + side + 0.01) + 1;
        first = static_cast<std::int32_t>(from < 0.0 ? 0.0 : from > size ? size : from);
        end = static_cast<std::int32_t>(to < 0.0 ? 0.0 : to > size ? size : to);
    };
    range(x, wide * (1 + 0x1p-18), c.width, s.x0, s.x1);
    range(y, high * (1 + 0x1p-18), c.height, s.y0, s.y1);
    return true;
}

/// How the kernel finds the share of light that a layer up to `depth` thick takes.
std::int32_t doublings_of(double depth) {
    std::int32_t n = 0;
    while (n <= kMaxDoublings && depth > double(kThinLayer)) {
        depth *= 0.5;
        ++n;
    }
    return n;
}

/// Unsigned integers in the order of the floats.
std::uint32_t sortable(float value) {
    std::uint32_t bits;
    std::memcpy(&bits, &value, 4);
    return (bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u;
}

std::uint32_t project(const BillboardScene& scene, const CameraParams& c, std::uint32_t i,
                      BlendSphere& s) {
    const float x = scene.x[i] - c.origin[0], y = scene.y[i] - c.origin[1],
                z = scene.z[i] - c.origin[2];
    s = BlendSphere{};
    s.x = x * c.right[0] + y * c.right[1] + z * c.right[2];
    s.y = x * c.up[0] + y * c.up[1] + z * c.up[2];
    s.z = x * c.forward[0] + y * c.forward[1] + z * c.forward[2];
    s.radius_squared = scene.radius[i] * scene.radius[i];
    s.extinction = scene.extinction[i];
    s.index = i;
    const SphereAt at{double(s.x), double(s.y), double(s.z), double(scene.radius[i])};
    const double away = std::sqrt(at.x * at.x + at.y * at.y + at.z * at.z);
    s.far = static_cast<float>((away + at.radius) * (1 + 0x1p-18));
    s.doublings = doublings_of(2 * at.radius * double(s.extinction));
    // What has no size or takes no light is on no tile's list.
    if (at.radius > 0 && s.extinction > 0 && !set_ellipse(c, at, s)) find_rectangle(c, at, s);
    return sortable(c.orthographic != 0 ? s.z : std::sqrt(x * x + y * y + z * z));
}

/// Radix sort by key, stable: equal keys keep the order of their index.
void sort_items(Buffer<BillboardDistance>& items, Buffer<BillboardDistance>& other) {
    for (int shift = 0; shift < 32; shift += 8) {
        std::uint32_t start[257] = {};
        for (const BillboardDistance& item : items.span())
            ++start[((item.key >> shift) & 255u) + 1];
        for (int k = 0; k < 256; ++k) start[k + 1] += start[k];
        for (const BillboardDistance& item : items.span())
            other[start[(item.key >> shift) & 255u]++] = item;
        items.swap(other);
    }
}

struct TileRange {
    std::int32_t x0, x1, y0, y1;
};

TileRange tiles_of(const BlendParams& p, const BlendSphere& s) {
    if (s.x0 >= s.x1 || s.y0 >= s.y1) return {0, 0, 0, 0};
    return {s.x0 / p.tile_width, (s.x1 - 1) / p.tile_width + 1, s.y0 / p.tile_height,
            (s.y1 - 1) / p.tile_height + 1};
}

/// Calls function(tile) for every tile that the sphere's rectangle touches.
template <class Function>
void for_tiles(const BlendParams& p, const BlendSphere& s, Function&& function) {
    const TileRange r = tiles_of(p, s);
    for (std::int32_t y = r.y0; y < r.y1; ++y)
        for (std::int32_t x = r.x0; x < r.x1; ++x)
            function(static_cast<std::size_t>(y) * static_cast<std::size_t>(p.tiles_x) +
                     static_cast<std::size_t>(x));
}

}  // namespace

Status project_billboards(const BillboardScene& scene, const CameraParams& camera, int threads,
                          BillboardLists& lists) {
    Buffer<BillboardDistance> items, other;
    PILEUS_TRY(allocate(arrays::billboard_spheres(scene.count), lists.spheres));
    PILEUS_TRY(allocate(arrays::billboard_distances(scene.count), items));
    PILEUS_TRY(allocate(arrays::billboard_distances(scene.count), other));
    PILEUS_TRY(allocate(arrays::billboard_order(scene.count), lists.order));

    // Look at each sphere from the camera.
    parallel_each(threads, std::uint64_t(scene.count), [&](std::size_t i) {
        const auto at = static_cast<std::uint32_t>(i);
        items[at] = {project(scene, camera, at, lists.spheres[at]), at};
    });

    // Put them in order of their distance.
    sort_items(items, other);
    for (std::size_t i = 0; i < items.size(); ++i) lists.order[i] = items[i].place;
    return Status::ok();
}

Status bin_billboards(const BlendParams& params, std::uint32_t tiles, BillboardLists& lists) {
    // Count first, so that the lists lie one after the other without gaps.
    PILEUS_TRY(allocate(arrays::tile_begin(tiles), lists.tile_begin));
    for (const BlendSphere& s : lists.spheres.span())
        for_tiles(params, s, [&](std::size_t tile) { ++lists.tile_begin[tile + 1]; });
    for (std::size_t i = 0; i < tiles; ++i) lists.tile_begin[i + 1] += lists.tile_begin[i];

    // Fill in the order of the spheres, so that each list is in that order too.
    Buffer<std::uint64_t> next;
    PILEUS_TRY(allocate(arrays::tile_begin(tiles), next));
    PILEUS_TRY(allocate(arrays::billboards_of_tiles(lists.tile_begin[tiles]), lists.tile_spheres));
    for (std::size_t i = 0; i < tiles; ++i) next[i] = lists.tile_begin[i];
    for (const std::uint32_t i : lists.order.span())
        for_tiles(params, lists.spheres[i],
                  [&](std::size_t tile) { lists.tile_spheres[next[tile]++] = i; });
    return Status::ok();
}

}  // namespace pileus
