// SPDX-License-Identifier: Apache-2.0
// See sky_light.h. What a node holds depends on its place and its slice's sun alone; which nodes
// are made depends on the view, and no sample reads others.
#include "src/picture/nodes/sky_light.h"

#include <algorithm>
#include <cmath>

#include "platform/threads.h"
#include "src/run/device_launch.h"
#include "src/run/on_device.h"

namespace pileus {
namespace {

/// Nodes on either side of the camera's that a level is read within: rounding to whole nodes, the
/// next node and a rounding of places take the rest.
constexpr int reach_nodes(int bits) { return (1 << bits) / 2 - 3; }

/// Of level 0: as far apart as in height with 2^7 nodes, within the same reach with more.
double spacing_of(const SkyParams& sky, int bits) {
    return double(sky.height_m) / kSkyLightHeights * 128 / (1 << bits);
}

/// Half spaces that hold all that is seen: inward normals through the camera.
struct View {
    double origin[3];
    double normal[4][3];
    int planes = 0;
};
View view_of(const CameraParams& c) {
    View v{};
    for (int a = 0; a < 3; ++a) v.origin[a] = double(c.origin[a]);
    if (c.orthographic != 0) return v;
    v.planes = 4;
    const double high_x = double(c.shift_x) + double(c.half_width),
                 low_x = double(c.shift_x) - double(c.half_width);
    const double high_y = double(c.shift_y) + double(c.half_height),
                 low_y = double(c.shift_y) - double(c.half_height);
    for (int a = 0; a < 3; ++a) {
        const double f = double(c.forward[a]), r = double(c.right[a]), u = double(c.up[a]);
        // Of x = p . right / p . forward: low_x <= x <= high_x, and the same upwards.
        v.normal[0][a] = r - low_x * f;
        v.normal[1][a] = high_x * f - r;
        v.normal[2][a] = u - low_y * f;
        v.normal[3][a] = high_y * f - u;
    }
    for (auto& n : v.normal) {
        const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        for (double& x : n) x /= length;
    }
    return v;
}

/// Metres from the plane z = 0 of a place on the layer, box-local.
double z_of(const SkyParams& sky, double x, double y, double altitude) {
    const double k = double(sky.curvature_per_m);
    const double wx = x + double(sky.shift_m[0]), wy = y + double(sky.shift_m[1]);
    const double c = altitude + 0.5 * k * (altitude * altitude - wx * wx - wy * wy);
    return 2 * c / (1 + std::sqrt(std::max(0.0, 1 + 2 * k * c))) - double(sky.shift_m[2]);
}

/// Columns of a row that the view may read: a spacing and a half around what is seen. A bent row
/// lies within the heights of its ends and its middle.
NodeRange columns_seen(const SkyParams& sky, const View& view, double spacing, std::int32_t first,
                       std::int32_t last, std::int32_t row, int height) {
    double low = double(first) * spacing, high = double(last) * spacing;
    const double y = double(row) * spacing;
    const double altitude =
        double(sky.low_m) + double(sky.height_m) * height / (kSkyLightHeights - 1);
    const double ends[3] = {z_of(sky, low, y, altitude), z_of(sky, high, y, altitude),
                            z_of(sky, -double(sky.shift_m[0]), y, altitude)};
    const double z_low = std::min(ends[0], ends[1]);
    double z_high = std::max(ends[0], ends[1]);
    if (low < -double(sky.shift_m[0]) && high > -double(sky.shift_m[0]))
        z_high = std::max(z_high, ends[2]);
    const double margin = 2 * spacing + double(sky.height_m) / (kSkyLightHeights - 1);
    for (int p = 0; p < view.planes; ++p) {
        const double* n = view.normal[p];
        const double z = n[2] > 0 ? z_high : z_low;
        // n . (place - origin) >= -margin, solved for x.
        const double rest = n[1] * (y - view.origin[1]) + n[2] * (z - view.origin[2]) + margin;
        if (std::fabs(n[0]) < 1e-9) {
            if (rest < 0) return {first, first};
            continue;
        }
        const double x = view.origin[0] - rest / n[0];
        if (n[0] > 0)
            low = std::max(low, x);
        else
            high = std::min(high, x);
        if (low > high) return {first, first};
    }
    const auto within = [&](double x) {
        return std::min(std::max(x / spacing, double(first)), double(last));
    };
    return {std::int32_t(std::floor(within(low))), std::int32_t(std::ceil(within(high)))};
}

/// The nodes to be made, by slice, and what is held then.
class LightRows {
public:
    LightRows(const CameraParams& camera, const SkyParams& sky, const std::vector<char>& due,
              SkyLight& out)
        : sky_(sky),
          view_(view_of(camera)),
          due_(due),
          out_(out),
          edge_(1 << out.view.bits),
          wanted(due.size()) {}

    void visit(int level) {
        const double spacing = double(out_.view.spacing_m) * double(1 << level);
        std::int32_t low[2];
        for (int a = 0; a < 2; ++a)
            low[a] = std::int32_t(std::floor(double(out_.view.camera[a]) / spacing)) - edge_ / 2;
        const std::int32_t last = low[0] + edge_;
        for (int height = 0; height < kSkyLightHeights; ++height)
            for (std::int32_t row = low[1]; row < low[1] + edge_; ++row)
                take({level, height, row, low[0], last},
                     columns_seen(sky_, view_, spacing, low[0], last, row, height));
    }

private:
    void take(const SkyLightRow& row, const NodeRange& seen) {
        const std::size_t slices = due_.size(), n = slices;
        const std::size_t slice =
            std::size_t((row.row % std::int32_t(n) + std::int32_t(n)) % std::int32_t(n));
        const std::size_t at =
            (std::size_t(row.level) * kSkyLightHeights + std::size_t(row.height)) *
                std::size_t(edge_) +
            std::size_t(row.row & (edge_ - 1));
        NodeRange& held = out_.columns[at];
        if (out_.row[at] != row.row || due_[slice] != 0) held = {0, 0};
        out_.row[at] = row.row;
        // Of what was made some may have left the level.
        held.first = std::max(held.first, row.first);
        held.last = std::min(held.last, row.last);
        if (seen.first >= seen.last) return;
        const auto add = [&](std::int32_t first, std::int32_t last) {
            if (first >= last) return;
            wanted[slice].push_back({row.level, row.height, row.row, first, last});
            out_.made += std::uint64_t(last - first);
        };
        if (held.first >= held.last || seen.first > held.last || seen.last < held.first) {
            add(seen.first, seen.last);
            held = seen;
            return;
        }
        add(seen.first, held.first);
        add(held.last, seen.last);
        held = {std::min(seen.first, held.first), std::max(seen.last, held.last)};
    }

    const SkyParams& sky_;
    View view_;
    const std::vector<char>& due_;
    SkyLight& out_;
    std::int32_t edge_;

public:
    std::vector<std::vector<SkyLightRow>> wanted;  ///< [slice]
};

Status make_rows(const Context& context, const RaymarchParams& k, const SkyParams& sky,
                 const std::vector<SkyLightRow>& rows, SkyLight& out) {
    constexpr std::int64_t kPiece = 16;
    const std::int64_t pieces = (std::int64_t(rows.size()) + kPiece - 1) / kPiece;
    std::vector<std::int64_t> read(rows.size(), 0);
    const SkyLightParams params{k, sky, out.view};
    const SkyLightBuffers b{rows.data(), out.words.data(), read.data()};
    const DeviceTable* const device = context.kernels->device;
    if (on_device(device))
        PILEUS_TRY(launch_on_device(*device, params, b, std::uint32_t(rows.size())));
    const auto make = [&](std::int64_t piece, int) {
        const std::int64_t end = std::min(std::int64_t(rows.size()), (piece + 1) * kPiece);
        context.kernels->sky_light_rows(params, b, std::uint32_t(piece * kPiece),
                                        std::uint32_t(end));
    };
    const bool whole =
        on_device(device) || run_until(context.threads, pieces, context.interrupted, make);
    if (!whole)
        return {Code::kCheckFailed, "interrupted before the picture was whole; no file written"};
    for (const std::int64_t n : read) out.densities += std::uint64_t(n);
    return Status::ok();
}

}  // namespace

int sky_light_levels(const SkyParams& sky, int bits) {
    double far = double(sky.reach_m);
    // A bent layer is seen to where it sinks below the plain.
    const double k = double(sky.curvature_per_m);
    if (k > 0)
        far = std::min(far, 2 * std::sqrt(2 * (double(sky.low_m) + double(sky.height_m)) / k));
    if (sky.boxed != 0) far = 2 * std::max(double(sky.extent_m[0]), double(sky.extent_m[1]));
    int levels = 1;
    for (double reach = reach_nodes(bits) * spacing_of(sky, bits); reach < far; reach *= 2)
        ++levels;
    return std::min(levels, kMaxSkyLightLevels);
}

Status reserve_sky_light(const SkyParams& sky, int bits, SkyLight& out) {
    const int levels = sky_light_levels(sky, bits);
    const std::size_t rows = std::size_t(levels) * kSkyLightHeights << bits;
    out.row.reserve(rows);
    out.columns.reserve(rows);
    out.slices.reserve();
    const Array<std::int32_t> nodes = arrays::sky_light_nodes(levels, bits, Stage::kWrite);
    return out.words.reserve(nodes.count, nodes.name);
}

Status follow_sky_light(const Context& context, const RaymarchParams& k, const SkyParams& sky,
                        int bits, int near_steps, const SunTurn& turn, SkyLight& out) {
    const StageClock clock(context, "shadow");
    const int levels = sky_light_levels(sky, bits);
    const std::size_t rows = std::size_t(levels) * kSkyLightHeights << bits;
    if (out.row.size() != rows || out.view.bits != bits) {
        out.row.assign(rows, 0);
        out.columns.assign(rows, NodeRange{0, 0});
        out.slices.held.clear();
    }
    PILEUS_TRY(allocate_once(arrays::sky_light_nodes(levels, bits, Stage::kWrite), out.words));
    out.view.words = out.words.data();
    out.view.spacing_m = float(spacing_of(sky, bits));
    out.view.reach_m = out.view.spacing_m * float(reach_nodes(bits));
    out.view.levels = levels;
    out.view.bits = bits;
    out.view.near_steps = near_steps;
    for (int a = 0; a < 2; ++a) out.view.camera[a] = k.camera.origin[a];
    std::vector<char> due(std::size_t(turn.slices), 0);
    for (const int slice : follow_sun(turn, out.slices)) due[std::size_t(slice)] = 1;
    LightRows wanted(k.camera, sky, due, out);
    for (int level = 0; level < levels; ++level) wanted.visit(level);
    RaymarchParams own = k;
    for (std::size_t slice = 0; slice < due.size(); ++slice) {
        for (std::size_t a = 0; a < 3; ++a) own.to_sun[a] = out.slices.held[slice][a];
        PILEUS_TRY(make_rows(context, own, sky, wanted.wanted[slice], out));
    }
    return Status::ok();
}

}  // namespace pileus
