// SPDX-License-Identifier: Apache-2.0
// What films have of photons: a ring that is settled, layers and digests of files. In no flight.
// in: a lit state, its planes -> out: batches' planes with the ground, a plane of depths.
// docs/formats.md, "Pictures out"
#include <algorithm>

#include "src/base/digest.h"
#include "src/photons/lit_march.h"
#include "src/picture/march_view.h"

namespace pileus {

void settle_ring(PhotonState& state) {
    PhotonRing& ring = state.ring;
    std::vector<PhotonSlot>& slots = ring.photons.slots;
    if (ring.fresh && ring.next_generation - ring.begin < slots.size()) {
        ring.first = ring.begin;
        ring.sum.counted.clear();
        std::rotate(slots.begin(), slots.begin() + std::ptrdiff_t(ring.first % slots.size()),
                    slots.end());
    }
    ring.fresh = false;
}

void note_colours(const Context& context, Span<const float> light, PhotonState& state) {
    if (!context.digests) return;
    Digest digest;
    digest.floats(light);
    state.picture.colours = digest.hex();
}

Status add_ground_noise(const Context& context, const FrameView& view, PhotonState& state,
                        const LightInput& lit, Planes& planes) {
    if (lit.batches < 2 || state.lights.ground_map.cells == 0) return Status::ok();
    // What is the same in every batch has no spread: sky, and the ground's light without the media.
    Lighting scattered = *lit.lighting;
    scattered.sky = scattered.ground.diffuse = scattered.ground.sun = scattered.ground.lamps = {};
    scattered.sun_irradiance = {};
    scattered.map = SkyMapView{};
    LightInput alone = lit;
    alone.lighting = &scattered;
    const std::size_t pixels = planes.transmittance.size();
    Planes part;
    PILEUS_TRY(allocate(arrays::batch_background(pixels), part.background));
    for (int b = 1; b <= lit.batches; ++b) {
        PILEUS_TRY(fill_lit_background(context, view, state, alone, b, part));
        float* colour = planes.colour.data() + std::size_t(3 * b) * pixels;
        for (std::size_t i = 0; i < 3 * pixels; ++i)
            colour[i] += planes.transmittance[i % pixels] * part.background[i];
    }
    return Status::ok();
}

Status show_whole_rays(const Context& context, const FrameView& view, const PhotonState& state,
                       const LightInput& lit, Planes& planes) {
    const OutputSettings& output = view.scene.output;
    if (whole_ray_planes(output) == 0) return Status::ok();
    const Lighting& light = *lit.lighting;
    Planes part;
    PILEUS_TRY(
        allocate_planes(lit.camera.width, lit.camera.height, 0, light.opaque(), false, part));
    PILEUS_TRY(march_medium(context, view.world.medium, state.majorants, light, lit.camera,
                            {false, output.layer_optical_depth}, part));
    // The picture's own as far as it goes, as its alpha has it.
    constexpr float kEnd = 1e-4f;
    for (std::size_t i = 0; i < part.transmittance.size(); ++i) {
        const float own = planes.transmittance[i];
        if (!(own < kEnd && part.transmittance[i] < own)) part.transmittance[i] = own;
    }
    planes.optical_depth.swap(part.optical_depth);
    planes.through.swap(part.transmittance);
    return Status::ok();
}

}  // namespace pileus
