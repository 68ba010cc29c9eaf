// SPDX-License-Identifier: Apache-2.0
// See composite_billboards.h.
// in: spheres and a camera -> out: image planes; checks, sorts, bins, then one kernel per tile.
// docs/methods.md 3, each image frame, step 5.
#include "src/methods/collectors/billboards/composite_billboards.h"

#include <cmath>
#include <string>

#include "platform/threads.h"
#include "src/base/number_text.h"
#include "src/methods/collectors/billboards/billboard_spheres.h"
#include "src/run/device_launch.h"
#include "src/run/on_device.h"
#include "src/scene/toml/toml_tree.h"

namespace pileus {
namespace {

constexpr float kLargestLength = 1e15f;

Status fault(std::uint32_t sphere, const char* what, float value, const char* allowed) {
    return Status::bad_input("billboard " + std::to_string(sphere) + ": " + what + ": " +
                             number_text(value) + ", " + allowed);
}

Status check_sphere(const BillboardScene& s, std::uint32_t i) {
    const float* centre[3] = {s.x, s.y, s.z};
    const char* names[3] = {"x", "y", "z"};
    for (int k = 0; k < 3; ++k)
        if (!(std::fabs(centre[k][i]) <= kLargestLength))
            return fault(i, names[k], centre[k][i], "allowed: -1e15 to 1e15");
    if (!(s.radius[i] >= 0.0f && s.radius[i] <= kLargestLength))
        return fault(i, "radius", s.radius[i], "allowed: 0 to 1e15");
    if (!(s.extinction[i] >= 0.0f && std::isfinite(s.extinction[i])))
        return fault(i, "extinction", s.extinction[i], "allowed: 0 or more, finite");
    for (std::size_t k = 0; k < static_cast<std::size_t>(s.channels); ++k) {
        const float value = s.colour[k * s.count + i];
        if (!std::isfinite(value)) return fault(i, "colour", value, "allowed: finite");
    }
    return Status::ok();
}

constexpr std::int32_t kMaxSide = 1 << 20;

Status check_camera(const CameraParams& c) {
    if (c.width < 1 || c.height < 1 || c.width > kMaxSide || c.height > kMaxSide)
        return Status::bad_input("camera: resolution: " + std::to_string(c.width) + " x " +
                                 std::to_string(c.height) + ", allowed: 1 to 1048576 each");
    if (!(c.half_width > 0.0f && c.half_height > 0.0f && std::isfinite(c.half_width) &&
          std::isfinite(c.half_height)))
        return Status::bad_input("camera: extent of the image plane: allowed: above 0, finite");
    for (int k = 0; k < 3; ++k) {
        if (!(std::fabs(c.origin[k]) <= kLargestLength))
            return Status::bad_input("camera: position: allowed: -1e15 to 1e15 metres");
        if (!std::isfinite(c.right[k] + c.up[k] + c.forward[k]))
            return Status::bad_input("camera: direction: allowed: finite, unit length");
    }
    return Status::ok();
}

Status check_tiling(const BillboardTiling& t) {
    if (t.width < 1 || t.height < 0 || t.width > kMaxSide || t.height > kMaxSide)
        return Status::bad_input("billboards: tile: " + std::to_string(t.width) + " x " +
                                 std::to_string(t.height) + ", allowed: 1 to 1048576 each");
    return Status::ok();
}

BlendParams make_params(const BillboardScene& s, const CameraParams& c, const BillboardTiling& t) {
    BlendParams p{};
    p.width = c.width;
    p.height = c.height;
    p.channels = s.channels;
    p.orthographic = c.orthographic;
    p.colour_stride = s.count;
    p.half_width = c.half_width;
    p.half_height = c.half_height;
    p.cut = kBlendCut;

    // Keep the planes of one tile near half a mebibyte, a share of any second-level cache.
    constexpr std::int32_t kTileFloats = 1 << 17;
    p.tile_width = t.width < kMaxTileWidth ? t.width : kMaxTileWidth;
    p.tile_width = p.tile_width < c.width ? p.tile_width : c.width;
    std::int32_t rows = kTileFloats / ((kBlendPlanes + s.channels) * p.tile_width);
    rows = rows < 1 ? 1 : rows > 32 ? 32 : rows;
    p.tile_height = t.height > 0 ? t.height : rows;
    p.tile_height = p.tile_height < c.height ? p.tile_height : c.height;
    p.tiles_x = (c.width + p.tile_width - 1) / p.tile_width;
    return p;
}

/// A buffer of the wanted size; one that already fits keeps its memory.
Status fit(Buffer<float>& buffer, std::uint64_t count, const char* what) {
    if (buffer.size() == count) return Status::ok();
    return buffer.resize(count, what);
}

Status prepare_image(const BlendParams& p, bool half_depth, BillboardImage& out) {
    const std::uint64_t pixels = std::uint64_t(p.width) * std::uint64_t(p.height);
    PILEUS_TRY(fit(out.transmittance, pixels, "transmittance"));
    PILEUS_TRY(fit(out.half_depth, half_depth ? pixels : 0, "half depth"));
    PILEUS_TRY(fit(out.colour, pixels * std::uint64_t(p.channels), "colour of the media"));
    out.width = p.width;
    out.height = p.height;
    out.channels = p.channels;
    return Status::ok();
}

}  // namespace

Status check_billboards(const BillboardScene& s, const CameraParams& c) {
    if (s.channels < 1 || s.channels > kMaxBlendChannels)
        return Status::bad_input("billboards: channels: " + std::to_string(s.channels) +
                                 ", allowed: 1 to " + std::to_string(kMaxBlendChannels));
    PILEUS_TRY(check_camera(c));
    for (std::uint32_t i = 0; i < s.count; ++i) PILEUS_TRY(check_sphere(s, i));
    return Status::ok();
}

Status composite_billboards(const BillboardScene& scene, const CameraParams& camera, int threads,
                            BlendFunction blend, BillboardImage& out, const BillboardTiling& tiling,
                            const DeviceTable* device) {
    PILEUS_TRY(check_billboards(scene, camera));
    PILEUS_TRY(check_tiling(tiling));
    if (threads < 1) threads = hardware_threads();
    const BlendParams params = make_params(scene, camera, tiling);
    const std::int32_t tiles_y = (params.height + params.tile_height - 1) / params.tile_height;
    const std::uint64_t tiles = std::uint64_t(params.tiles_x) * std::uint64_t(tiles_y);
    if (tiles > 0xffffffffu)
        return Status::limit("billboards: more than 4294967295 tiles: make the tiles larger");

    // Order the spheres and give each tile the list of those that touch it.
    BillboardLists lists;
    PILEUS_TRY(project_billboards(scene, camera, threads, lists));
    PILEUS_TRY(bin_billboards(params, static_cast<std::uint32_t>(tiles), lists));

    // Lend each thread its own planes.
    Buffer<float> scratch;
    const std::uint64_t share = blend_scratch_share(params);
    const std::uint64_t own_planes = on_device(device) ? 0 : std::uint64_t(threads);
    PILEUS_TRY(scratch.resize(share * own_planes, "planes of the tiles"));
    PILEUS_TRY(prepare_image(params, scene.half_depth, out));
    const BlendBuffers buffers{
        lists.spheres.data(),      scene.colour,       lists.tile_begin.data(),
        lists.tile_spheres.data(), scene.opaque_depth, out.transmittance.data(),
        out.half_depth.data(),     out.colour.data(),  nullptr};
    if (on_device(device))
        return launch_on_device(*device, params, buffers, lists.spheres.size(),
                                static_cast<std::uint32_t>(tiles));
    parallel_for(threads, static_cast<std::int64_t>(tiles), [&](std::int64_t piece, int thread) {
        BlendBuffers own = buffers;
        own.scratch = scratch.data() + share * std::uint64_t(thread);
        const auto tile = static_cast<std::uint32_t>(piece);
        blend(params, own, tile, tile + 1);
    });
    return Status::ok();
}

}  // namespace pileus
