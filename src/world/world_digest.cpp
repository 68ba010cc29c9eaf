// SPDX-License-Identifier: Apache-2.0
// See world.h: a world's bytes, and what names its densities.
// in: World -> out: bytes, hex digits.
// docs/report.md
#include "src/base/digest.h"
#include "src/world/world.h"

namespace pileus {

std::uint64_t bytes_of_world(const World& world) {
    std::uint64_t bytes = world.medium.volume.density.bytes() + world.medium.parts.bytes() +
                          phase_bytes(world.medium) + world.solids.bytes() +
                          world.particles.position.bytes() + world.particles.radius.bytes() +
                          world.particles.density.bytes() + world.particles.colour.bytes() +
                          world.particles.emission.bytes() + world.particles.velocity.bytes() +
                          world.particles.id.bytes() + world.unrefined.density.bytes();
    for (const NoiseTexture* noise : {&world.layer.perlin, &world.layer.worley})
        bytes += noise->words.bytes();
    bytes += world.medium.detail.tile.bytes();
    for (const Emitter& emitter : world.medium.emitters) bytes += emitter.below.bytes();
    return bytes;
}

std::string density_digest(const World& world) {
    if (!world.density_digest.empty()) return world.density_digest;
    Digest digest;
    digest.floats(world.medium.volume.density.span());
    for (const NoiseTexture* noise : {&world.layer.perlin, &world.layer.worley})
        digest.words(noise->words.span());
    if (world.medium.count > 1) digest.floats(world.medium.parts.span());
    const MediumDetail& detail = world.medium.detail;
    if (detail.present()) {
        digest.floats(detail.tile.span());
        digest.floats({detail.view.period, 3});
        const float numbers[] = {detail.view.strength, detail.view.core};
        digest.floats({numbers, 2});
    }
    return digest.hex();
}

}  // namespace pileus
