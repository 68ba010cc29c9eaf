// SPDX-License-Identifier: Apache-2.0
// See lamp_light.h.
#include "src/picture/nodes/lamp_light.h"

#include <cstring>

#include "kernels_cpu/core/profile.h"
#include "src/picture/march_view.h"
#include "src/picture/nodes/node_grid.h"
#include "src/run/device_launch.h"
#include "src/run/on_device.h"
#include "src/world/camera/view.h"
#include "src/world/light/lights.h"

namespace pileus {
namespace {

constexpr double kFewestNodes = 1u << 17, kMaxNodes = 1u << 20;
constexpr double kVoxelsPerNode = 8;

}  // namespace

NodeGrid lamp_node_grid(const Medium& medium) {
    double budget = double(voxel_count(medium.grid)) / kVoxelsPerNode;
    budget = budget < kFewestNodes ? kFewestNodes : budget > kMaxNodes ? kMaxNodes : budget;
    double spacing = 0;
    for (double edge : medium.extent_m) spacing = edge > spacing ? edge : spacing;
    // Flat boxes have one node at least along each axis.
    const auto nodes = [&](double apart) {
        double count = 1;
        for (double edge : medium.extent_m) count *= edge > apart ? edge / apart : 1;
        return count;
    };
    while (nodes(spacing / 1.125) <= budget) spacing /= 1.125;
    int size[3];
    for (int a = 0; a < 3; ++a) {
        const int n = int(medium.extent_m[a] / spacing + 0.5);
        size[a] = n < 1 ? 1 : n;
    }
    return make_sized_grid(size, medium.extent_m);
}

namespace {

/// Calls use(index, lamp) for lamps and, where they are wanted, their spots.
template <class Use>
void each_light(const Lighting& lighting, bool spots, const Use& use) {
    std::size_t n = 0;
    for (const LampParams& lamp : lighting.lamps) use(n++, lamp);
    for (const LampParams& spot : lighting.lamp_spots)
        if (spots && spot.strength > 0) use(n++, spot);
}

}  // namespace

std::uint64_t lamp_numbers(const Medium& medium, const Lighting& lighting, bool spots) {
    std::uint64_t lamps = 0;
    each_light(lighting, spots, [&](std::size_t, const LampParams&) { ++lamps; });
    return lamps > 0 ? bytes_of(node_count(lamp_node_grid(medium)), lamps) : 0;
}

namespace {

/// Whether nodes are of these lamps already; else lists them, in the memory that there is.
bool same_lights(const Lighting& lighting, bool spots, LampNodes& out) {
    std::size_t count = 0;
    bool same = true;
    each_light(lighting, spots, [&](std::size_t i, const LampParams& lamp) {
        same = same && i < out.lamps.size() && std::memcmp(&out.lamps[i], &lamp, sizeof lamp) == 0;
        count = i + 1;
    });
    if (same && count == out.lamps.size()) return true;
    out.lamps.clear();
    each_light(lighting, spots,
               [&](std::size_t, const LampParams& lamp) { out.lamps.push_back(lamp); });
    out.spot.assign(lighting.lamps.size(), -1);
    auto next = std::int32_t(lighting.lamps.size());
    for (std::size_t i = 0; i < lighting.lamp_spots.size(); ++i)
        if (spots && lighting.lamp_spots[i].strength > 0) out.spot[i] = next++;
    return false;
}

}  // namespace

Status make_lamp_nodes(const Context& context, const Medium& medium, const Majorants& majorants,
                       const Lighting& lighting, bool spots, LampNodes& out) {
    if (!kLights) return Status::ok();
    if (same_lights(lighting, spots, out) && !out.optical_depth.empty()) return Status::ok();
    const StageClock clock(context, "lights");
    out.grid = lamp_node_grid(medium);
    const std::uint64_t count = out.lamps.size();
    PILEUS_TRY(
        allocate(arrays::lamp_depths(lamp_numbers(medium, lighting, spots)), out.optical_depth));
    const LampMarchParams k = lamp_march_params(medium, majorants, lighting, {}, out, 0);
    LampMarchBuffers b{};
    b.lamps = out.lamps.data();
    b.optical_depth = out.optical_depth.data();
    const std::uint64_t rows =
        count * std::uint64_t(out.grid.size[1]) * std::uint64_t(out.grid.size[2]);
    if (on_device(context.kernels->device))
        return launch_on_device(*context.kernels->device, k, b, LampRows::kDepths,
                                std::uint32_t(rows));
    parallel_for(context.threads, std::int64_t(rows), [&](std::int64_t row, int) {
        context.kernels->lamp_depth_rows(k, b, std::uint32_t(row), std::uint32_t(row) + 1);
    });
    return Status::ok();
}

Status reserve_lamp_nodes(const Medium& medium, std::size_t lamps, LampNodes& out) {
    if (!kLights || lamps == 0) return Status::ok();
    out.lamps.reserve(lamps);
    out.spot.reserve(lamps);
    const Array<float> depths =
        arrays::lamp_depths(bytes_of(node_count(lamp_node_grid(medium)), lamps));
    return out.optical_depth.reserve(depths.count, depths.name);
}

LampMarchParams lamp_march_params(const Medium& medium, const Majorants& majorants,
                                  const Lighting& lighting, const CameraParams& camera,
                                  const LampNodes& nodes, double cut) {
    LampMarchParams k{};
    k.medium = make_medium_view(medium, majorants);
    k.camera = camera;
    k.media = medium.count;
    for (float& rest : k.surface_rest) rest = 1;
    for (int i = 0; i < medium.count; ++i) {
        const Optics& optics = medium.optics[std::size_t(i)];
        k.phase[i] = optics.phase;
        for (int c = 0; c < 3; ++c) {
            k.albedo[i][c] = optics.albedo[c];
            k.emission[i][c] = optics.emission[c];
        }
    }
    k.emits = emits(medium) ? 1 : 0;
    k.octaves = {1, 1, 1};
    k.lamps = std::int32_t(nodes.lamps.size());
    for (const LampParams& lamp : nodes.lamps)
        if (lamp.radius > 0) k.spheres = 1;
    k.nodes = nodes.grid;
    k.cut = float(cut);
    k.ground = lighting.ground.present ? 1 : 0;
    k.ground_z = float(lighting.ground.z);
    k.ground_albedo = float(lighting.ground.albedo);
    k.paint = lighting.ground.paint;
    k.paint.texel_turn = pixel_step(k.camera);
    return k;
}

Status add_lamp_light(const Context& context, const Medium& medium, const LampMarchParams& k,
                      const LampNodes& nodes, Planes& planes, std::size_t first, const float* beam,
                      bool whole) {
    if (!kLights) return Status::ok();
    const StageClock clock(context, "light of lights");
    LampMarchBuffers b{};
    b.lamps = nodes.lamps.data() + first;
    // Kernels of one launch fill it, those of the other read it.
    const std::size_t skipped = first * std::size_t(node_count(nodes.grid));
    b.optical_depth = const_cast<float*>(nodes.optical_depth.data()) + skipped;
    b.beam = beam;
    b.parts = medium.parts.data();
    b.opaque_depth = planes.opaque_depth.data();
    b.colour = planes.colour.data();
    b.background = planes.background.data();
    constexpr std::int64_t kPiece = 4;
    const std::int64_t rows = k.camera.height;
    if (on_device(context.kernels->device))
        return launch_on_device(*context.kernels->device, k, b, LampRows::kMarch,
                                std::uint32_t(rows));
    auto march = [&](std::int64_t piece, int) {
        const std::int64_t begin = piece * kPiece;
        const std::int64_t end = begin + kPiece < rows ? begin + kPiece : rows;
        context.kernels->lamp_march_rows(k, b, std::uint32_t(begin), std::uint32_t(end));
    };
    const std::int64_t pieces = (rows + kPiece - 1) / kPiece;
    if (whole)
        parallel_for(context.threads, pieces, march);
    else if (!run_until(context.threads, pieces, context.interrupted, march))
        return {Code::kCheckFailed, "interrupted before the picture was whole; no file written"};
    return Status::ok();
}

}  // namespace pileus
