// SPDX-License-Identifier: Apache-2.0
// See shade.h.
#include "src/clouds/shade.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "src/base/powers.h"

namespace pileus {
namespace {

/// Most nodes along a side of the ground's shadow, and how many of them the smallest cloud has.
constexpr int kGroundNodes = 1024, kNodesOfRadius = 12;
/// A sun lower than this throws shadows that are longer than skies are wide.
constexpr double kLowestSine = 0.02;
/// What is left of sunlight counts as so much at least: a depth of 25.
constexpr double kMinLight = 1e-11;
constexpr double kLn2 = 0.693147180559945309;
/// Mean cosine of scattering by cloud droplets.
constexpr double kDropletCosine = 0.86;

/// Light that is scattered again and again does not end where a shadow does: means over 5 texels
/// along both axes, twice, a sixth of the cloud's width in all. Beyond the rim it is as at the rim.
void blur(Buffer<float>& shade) {
    if (shade.empty()) return;
    constexpr int n = kShadeTexels;
    std::array<float, kShadeTexels> line{};
    for (int pass = 0; pass < 4; ++pass)
        for (int k = 0; k < n; ++k) {
            const int first = pass % 2 == 0 ? k * n : k, step = pass % 2 == 0 ? 1 : n;
            for (int i = 0; i < n; ++i) line[std::size_t(i)] = shade[std::size_t(first + i * step)];
            for (int i = 0; i < n; ++i) {
                float sum = 0;
                for (int j = i - 2; j <= i + 2; ++j)
                    sum += line[std::size_t(std::clamp(j, 0, n - 1))];
                shade[std::size_t(first + i * step)] = sum * 0.2f;
            }
        }
}

}  // namespace

float shadow_at(const float* texels, int side, float x, float y) {
    const float px = (x * 0.5f + 0.5f) * float(side) - 0.5f;
    const float py = (0.5f - y * 0.5f) * float(side) - 0.5f;
    if (!(px > -1.0f && px < float(side) && py > -1.0f && py < float(side))) return 1;
    const int x0 = int(px + 1.0f) - 1, y0 = int(py + 1.0f) - 1;
    const float fx = px - float(x0), fy = py - float(y0);
    const float* const at = texels + y0 * side + x0;
    if (x0 >= 0 && y0 >= 0 && x0 + 1 < side && y0 + 1 < side) {
        const float top = at[0] + (at[1] - at[0]) * fx;
        return top + (at[side] + (at[side + 1] - at[side]) * fx - top) * fy;
    }
    const auto texel = [&](int i, int j) {
        const bool there = x0 + i >= 0 && y0 + j >= 0 && x0 + i < side && y0 + j < side;
        return there ? at[j * side + i] : 1.0f;
    };
    const float top = texel(0, 0) + (texel(1, 0) - texel(0, 0)) * fx;
    return top + (texel(0, 1) + (texel(1, 1) - texel(0, 1)) * fx - top) * fy;
}

float left_by(const ShadowSource& source, const SunPlane& plane, const Double3& at) {
    if (source.shadow == nullptr) return source.beyond;
    const SunPlane& seen = source.plane != nullptr ? *source.plane : plane;
    const Double3 to = at - source.middle;
    const float x = float(glm::dot(to, seen.right) / source.radius);
    const float y = float(glm::dot(to, seen.up) / source.radius);
    const bool beyond = !(x > -1 && x < 1 && y > -1 && y < 1);
    if (source.plane != nullptr && beyond) return source.beyond;
    return shadow_at(source.shadow, source.side, x, y);
}

bool is_sunward(const ShadowSource& source, const SunPlane& plane, const Double3& at) {
    if (source.plane != nullptr) return at.z < source.middle.z;
    if (source.shadow == nullptr) return false;
    return glm::dot(source.middle - at, plane.to_sun) > 0;
}

float total_left(float left, double mean_cosine) {
    const double depth = -kLn2 * log2_of(std::max(double(left), kMinLight));
    return left < 1 ? float(1 / (1 + 0.75 * (1 - mean_cosine) * depth)) : 1.0f;
}

float sunlight_left(const SunPlane& plane, const std::vector<ShadowSource>& all, const Double3& at,
                    bool spread) {
    float left = 1;
    for (const ShadowSource& source : all) {
        if (!is_sunward(source, plane, at)) continue;
        const float by = left_by(source, plane, at);
        left *= spread && source.plane == nullptr ? total_left(by, kDropletCosine) : by;
    }
    return left;
}

Status shade_cloud(const SunPlane& plane, const std::vector<ShadowSource>& all, std::size_t own,
                   Buffer<float>& shade) {
    shade = Buffer<float>();
    const ShadowSource& me = all[own];
    for (std::size_t j = 0; j < all.size(); ++j) {
        const ShadowSource& other = all[j];
        if (j == own || !is_sunward(other, plane, me.middle)) continue;
        const Double3 to = other.middle - me.middle;
        const double x = glm::dot(to, plane.right), y = glm::dot(to, plane.up);
        const double reach = me.radius + other.radius;
        const bool layer = other.plane != nullptr;
        if (!layer && (x > reach || x < -reach || y > reach || y < -reach)) continue;
        if (shade.empty()) {
            PILEUS_TRY(shade.resize(kShadeTexels * kShadeTexels, "shadow on a cloud"));
            for (float& v : shade.span()) v = 1;
        }
        for (int row = 0; row < kShadeTexels; ++row)
            for (int column = 0; column < kShadeTexels; ++column) {
                const double from_x = ((column + 0.5) * 2 / kShadeTexels - 1) * me.radius;
                const double from_y = (1 - (row + 0.5) * 2 / kShadeTexels) * me.radius;
                const double at_x = from_x - x, at_y = from_y - y;
                if (layer) {
                    shade[std::size_t(row * kShadeTexels + column)] *=
                        left_by(other, plane, me.middle + plane.right * from_x + plane.up * from_y);
                    continue;
                }
                shade[std::size_t(row * kShadeTexels + column)] *= float(
                    shadow_at(other.shadow, kSunTexels, at_x / other.radius, at_y / other.radius));
            }
    }
    blur(shade);
    return Status::ok();
}

Status shade_ground(const SunPlane& plane, const std::vector<ShadowSource>& all, double ground_m,
                    CloudsOnGround& out) {
    out.nodes = NodeGrid{};
    out.depth.truncate(0);
    const Double3& s = plane.to_sun;
    if (s.z < kLowestSine) return Status::ok();
    double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300}, smallest = 1e300;
    const auto foot = [&](const ShadowSource& c, int a) {
        const Double3& own = c.plane != nullptr ? c.plane->to_sun : s;
        return c.middle[a] - own[a] * ((c.middle.z - ground_m) / own.z);
    };
    for (const ShadowSource& c : all) {
        if (c.shadow == nullptr || c.middle.z <= ground_m) continue;
        smallest = std::min(smallest, c.plane != nullptr ? c.radius / 16 : c.radius);
        for (int a = 0; a < 2; ++a) {
            // The rim of a layer's goes on beyond the nodes.
            const double reach = c.plane != nullptr ? c.radius : c.radius / s.z;
            low[a] = std::min(low[a], foot(c, a) - reach);
            high[a] = std::max(high[a], foot(c, a) + reach);
        }
    }
    if (smallest > 1e299) return Status::ok();
    double spacing = smallest / kNodesOfRadius;
    // Two nodes of nothing around all.
    for (int a = 0; a < 2; ++a)
        spacing = std::max(spacing, (high[a] - low[a]) / (kGroundNodes - 4));
    for (int a = 0; a < 2; ++a) {
        out.low[a] = low[a] - 2 * spacing;
        out.nodes.size[a] = int((high[a] - low[a]) / spacing) + 4;
        out.nodes.per_metre[a] = float(1 / spacing);
    }
    out.nodes.size[2] = 1;
    out.nodes.per_metre[2] = 1;
    const std::size_t columns = std::size_t(out.nodes.size[0]);
    PILEUS_TRY(out.depth.resize(columns * std::size_t(out.nodes.size[1]), "shadow of clouds"));
    for (const ShadowSource& c : all) {
        if (c.shadow == nullptr || c.middle.z <= ground_m) continue;
        int first[2], last[2];
        for (int a = 0; a < 2; ++a) {
            const double at = (foot(c, a) - out.low[a]) / spacing, reach = c.radius / s.z / spacing;
            first[a] = std::max(1, int(at - reach));
            last[a] = std::min(out.nodes.size[a] - 2, int(at + reach) + 1);
            // Beyond its square, and beyond the nodes, a layer goes on.
            if (c.plane != nullptr) first[a] = 0, last[a] = out.nodes.size[a] - 1;
        }
        for (int j = first[1]; j <= last[1]; ++j)
            for (int i = first[0]; i <= last[0]; ++i) {
                const Double3 at{out.low[0] + (i + 0.5) * spacing, out.low[1] + (j + 0.5) * spacing,
                                 ground_m};
                const double left = double(left_by(c, plane, at));
                if (left >= 1) continue;
                out.depth[std::size_t(j) * columns + std::size_t(i)] -=
                    float(kLn2 * log2_of(std::max(left, kMinLight)));
            }
    }
    return Status::ok();
}

}  // namespace pileus
