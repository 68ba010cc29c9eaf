// SPDX-License-Identifier: Apache-2.0
// See device_launch.h: rows of pictures, and of the light on nodes that they read.
// in: structs of one launch -> out: the same with the device's pointers; results copied back.
// docs/crosscheck.md
#include "src/run/device_launch.h"
#include "src/run/device_views.h"

namespace pileus {
namespace {

using Size = DeviceSize;

Size words_of(const SkyLightView& view) {
    return (Size(view.levels) * Size(kSkyLightHeights)) << (2 * view.bits);
}

/// All but the field that is marched through in place of a grid.
void add_raymarch(DeviceArrays& a, RaymarchParams& k, RaymarchBuffers& b, std::uint32_t rows) {
    add_medium(a, k.medium);
    for (int i = 0; i < k.levels; ++i) add_medium(a, k.level[i]);
    for (int i = 0; i < k.media; ++i) a.in(k.phase[i].table);
    const Size pixels = pixels_in(k.lattice);
    a.in(b.optical_depth, k.light.march != 0 ? 0 : product(k.light.nodes.size));
    a.in(b.sky, Size(k.sky.sets) * product(k.sky.nodes.size));
    a.in(b.opaque_depth, pixels);
    a.in(b.noise, Size(kNoiseTile) * Size(kNoiseTile));
    a.in(b.parts, other_media(k.media, product(k.medium.size)));
    a.both(b.transmittance, pixels);
    a.both(b.half_depth, pixels);
    a.both(b.colour, 3 * pixels);
    a.both(b.ray_depth, pixels);
    a.both(b.counts, Size(rows) * kRaymarchCounts);
    a.in(b.visibility, product(k.visibility.size));
    if (b.sky_light == nullptr) return;
    SkyLightView view = *b.sky_light;
    a.in(view.words, words_of(view));
    b.sky_light = &view;
    a.in(b.sky_light, 1);
}

}  // namespace

Status launch_on_device(const DeviceTable& device, const ShadowParams& params,
                        const ShadowBuffers& buffers, std::uint32_t count) {
    ShadowParams k = params;
    ShadowBuffers b = buffers;
    DeviceArrays a(*device.device);
    add_medium(a, k.medium);
    a.both(b.optical_depth, product(k.nodes.size));
    a.in(b.rows, Size(k.nodes.size[1]) * Size(k.nodes.size[2]));
    const bool detail = k.medium.detail != nullptr;
    a.launch(detail ? device.kernels->detail_shadow_rows : device.kernels->shadow_rows, k, b, 0,
             count);
    return a.finish();
}

Status launch_on_device(const DeviceTable& device, const MarchParams& params,
                        const MarchBuffers& buffers, std::uint32_t count) {
    MarchParams k = params;
    MarchBuffers b = buffers;
    DeviceArrays a(*device.device);
    add_medium(a, k.medium);
    for (int i = 0; i < k.media; ++i) a.in(k.phase[i].table);
    if (k.apart == 0) k.behind.map = SkyMapView{};
    add_sky(a, k.behind.map);
    a.in(b.surfaces, 3 * pixels_in(k.camera));
    const Size pixels = pixels_in(k.lattice);
    const Size stored = Size(k.sets) * Size(k.harmonics);
    const Size numbers = k.bands > 0 && b.near == nullptr ? stored : Size(k.channels);
    a.in(b.near, Size(k.channels / 3) * stored * product(k.near.size));
    a.in(b.optical_depth, product(k.shadow.size));
    a.in(b.visibility, product(k.shadow.size));
    a.in(b.source, numbers * product(k.source.size));
    a.in(b.quads, 4 * product(k.source.size));
    a.in(b.beam, Size(k.beam_sets) * Size(kBeamNumbers));
    a.in(b.opaque_depth, pixels);
    a.in(b.parts, other_media(k.media, product(k.medium.size)));
    a.both(b.transmittance, pixels);
    a.both(b.half_depth, pixels);
    a.both(b.colour, Size(k.channels) * pixels);
    a.both(b.ray_depth, pixels);
    const bool detail = k.medium.detail != nullptr;
    a.launch(detail ? device.kernels->detail_march_rows : device.kernels->march_rows, k, b, 0,
             count);
    return a.finish();
}

Status launch_on_device(const DeviceTable& device, const BackgroundParams& params,
                        const BackgroundBuffers& buffers, std::uint32_t count) {
    BackgroundParams k = params;
    BackgroundBuffers b = buffers;
    DeviceArrays a(*device.device);
    add_background(a, k, b);
    a.launch(device.kernels->background_rows, k, b, 0, count);
    return a.finish();
}

Status launch_on_device(const DeviceTable& device, const SolidRowsParams& params,
                        const BackgroundBuffers& buffers, std::uint32_t count) {
    SolidRowsParams k = params;
    BackgroundBuffers b = buffers;
    DeviceArrays a(*device.device);
    add_background(a, k.back, b);
    add_solids(a, k.solids);
    add_heights(a, k.sun_heights);
    a.launch(device.kernels->solid_rows, k, b, 0, count);
    return a.finish();
}

Status launch_on_device(const DeviceTable& device, const UpsampleParams& params,
                        const UpsampleBuffers& buffers, std::uint32_t count) {
    UpsampleParams k = params;
    UpsampleBuffers b = buffers;
    DeviceArrays a(*device.device);
    add_box(k.medium);
    const Size few = pixels_in(k.lattice), all = pixels_in(k.camera);
    a.in(b.transmittance, few);
    a.in(b.colour, 3 * few);
    a.in(b.half_depth, few);
    a.in(b.ray_depth, few);
    a.in(b.opaque_depth, few);
    a.in(b.whole_opaque, all);
    const Size before = k.remembers != 0 ? all : 0;
    a.in(b.before_transmittance, before);
    a.in(b.before_colour, 3 * before);
    a.in(b.before_opaque, before);
    a.both(b.whole_transmittance, all);
    a.both(b.whole_colour, 3 * all);
    a.both(b.whole_half, all);
    a.both(b.whole_depth, all);
    a.both(b.kept, Size(k.camera.height));
    a.launch(device.kernels->upsample_rows, k, b, 0, count);
    return a.finish();
}

Status launch_on_device(const DeviceTable& device, const AirRowsParams& params,
                        const AirRowsBuffers& buffers, std::uint32_t count) {
    AirRowsParams k = params;
    AirRowsBuffers b = buffers;
    DeviceArrays a(*device.device);
    add_box(k.medium);
    const Size pixels = pixels_in(k.camera), rows = Size(k.rows), columns = Size(k.columns);
    a.in(b.sky, Size(k.downs + k.ups) * Size(k.turns) * kAirTexel);
    a.in(b.air, Size(k.slices) * rows * columns * kAirTexel);
    a.in(b.transmittance, pixels);
    a.in(b.half_depth, pixels);
    a.in(b.opaque_depth, pixels);
    a.both(b.light, 3 * pixels);
    a.both(b.behind, 3 * pixels);
    a.both(b.dimmed, 3 * pixels);
    a.both(b.kept, 3 * pixels);
    a.launch(device.kernels->air_rows, k, b, 0, count);
    return a.finish();
}

Status launch_on_device(const DeviceTable& device, const RaymarchParams& params,
                        const RaymarchBuffers& buffers, std::uint32_t count) {
    RaymarchParams k = params;
    RaymarchBuffers b = buffers;
    DeviceArrays a(*device.device);
    add_raymarch(a, k, b, count);
    const bool detail = k.medium.detail != nullptr;
    a.launch(detail ? device.kernels->detail_raymarch_rows : device.kernels->raymarch_rows, k, b, 0,
             count);
    return a.finish();
}

Status launch_on_device(const DeviceTable& device, const RaymarchSkyParams& params,
                        const RaymarchBuffers& buffers, std::uint32_t count) {
    RaymarchSkyParams k = params;
    RaymarchBuffers b = buffers;
    DeviceArrays a(*device.device);
    add_raymarch(a, k.march, b, count);
    add_layer(a, k.sky);
    a.launch(device.kernels->raymarch_sky_rows, k, b, 0, count);
    return a.finish();
}

Status launch_on_device(const DeviceTable& device, const SkyLightParams& params,
                        const SkyLightBuffers& buffers, std::uint32_t count) {
    SkyLightParams k = params;
    SkyLightBuffers b = buffers;
    DeviceArrays a(*device.device);
    // Of the march the way to the sun is read, which the layer fills.
    RaymarchBuffers none{};
    add_raymarch(a, k.march, none, 0);
    add_layer(a, k.sky);
    a.in(b.rows, count);
    a.both(b.words, words_of(k.view));
    k.view.words = nullptr;
    a.both(b.read, count);
    a.launch(device.kernels->sky_light_rows, k, b, 0, count);
    return a.finish();
}

Status launch_on_device(const DeviceTable& device, const SkyTurnParams& k,
                        const SkyTurnBuffers& buffers, std::uint32_t count) {
    SkyTurnBuffers b = buffers;
    DeviceArrays a(*device.device);
    const Size nodes = product(k.grid.size);
    // With octaves: shares of the first, those of the others and their turns, four sums of all.
    const Size numbers = k.later != 0 ? 3 * kSkyParts + 4 : kSkyParts;
    a.in(b.phase, kSkyPhaseSteps + 1);
    a.in(b.seen, numbers * nodes);
    a.both(b.light, Size(k.sets) * nodes);
    a.launch(device.kernels->turn_sky, k, b, 0, count);
    return a.finish();
}

Status launch_on_device(const DeviceTable& device, const LampMarchParams& params,
                        const LampMarchBuffers& buffers, LampRows rows, std::uint32_t count) {
    LampMarchParams k = params;
    LampMarchBuffers b = buffers;
    DeviceArrays a(*device.device);
    add_medium(a, k.medium);
    for (int i = 0; i < k.media; ++i) a.in(k.phase[i].table);
    add_solids(a, k.solids);
    add_paint(a, k.paint);
    a.in(b.lamps, Size(k.lamps));
    a.both(b.optical_depth, Size(k.lamps) * product(k.nodes.size));
    if (rows == LampRows::kDepths) {
        a.launch(device.kernels->lamp_depth_rows, k, b, 0, count);
        return a.finish();
    }
    const Size pixels = pixels_in(k.camera);
    a.in(b.beam, Size(k.beam_sets) * Size(kBeamNumbers) * (k.beam_points != 0 ? 2 : 1));
    a.in(b.parts, other_media(k.media, product(k.medium.size)));
    a.in(b.opaque_depth, pixels);
    a.both(b.colour, 3 * pixels);
    a.both(b.background, 3 * pixels);
    a.launch(device.kernels->lamp_march_rows, k, b, 0, count);
    return a.finish();
}

Status sweep_on_device(const DeviceTable& device, const SweepParams& params,
                       const SweepBuffers& buffers) {
    SweepParams k = params;
    SweepBuffers b = buffers;
    DeviceArrays a(*device.device);
    a.in(b.density, product(k.size));
    a.both(b.optical_depth, product(k.size));
    for (k.diagonal = 0; k.diagonal < diagonals(k); ++k.diagonal) {
        const SweepRange y = diagonal_blocks(k);
        a.launch(device.kernels->sweep_blocks, k, b, y.begin, y.end);
    }
    return a.finish();
}

Status sweep_on_device(const DeviceTable& device, Span<const SweepLayer> layers,
                       const SweepBuffers& buffers) {
    SweepBuffers b = buffers;
    DeviceArrays a(*device.device);
    if (layers.size == 0) return Status::ok();
    a.in(b.density, product(layers.data[0].k.size));
    a.both(b.optical_depth, product(layers.data[0].k.size));
    const SweepTap* copied = nullptr;
    for (std::size_t i = 0; i < layers.size; ++i) {
        const SweepLayer& layer = layers.data[i];
        // All but the first have the same.
        if (layer.taps != copied) {
            copied = b.taps = layer.taps;
            a.in(b.taps, Size(layer.k.taps));
        }
        a.launch(device.kernels->sweep_layer_rows, layer.k, b, 0, std::uint32_t(layer.k.size[1]));
    }
    return a.finish();
}

}  // namespace pileus
