// SPDX-License-Identifier: Apache-2.0
// See light_input.h.
#include "src/photons/light_input.h"

namespace pileus {

std::size_t filled_slots(const Photons& photons) {
    std::size_t filled = 0;
    while (filled < photons.slots.size() && photons.slots[filled].generations > 0) ++filled;
    return filled;
}

double slot_norm(const LightInput& in, const PhotonSlot& slot, std::size_t light) {
    return slot.flux_per_photon_m2[light] / double(std::uint64_t{1} << in.deposit.places) /
           slot.generations_of(light);
}

void slot_sums(const LightInput& in, const PhotonSlot& slot, std::size_t light, std::uint64_t set,
               double* sums) {
    slot_sums(in, slot, light, set, slot_norm(in, slot, light), sums);
}

int harmonic_sets(int channels, const Lighting& lighting) {
    return channels == 1 && lighting.lights.size() < 3 ? int(lighting.lights.size()) : 3;
}

Status reconstruct_ground(const LightInput& in, const GroundMap& map, int batch,
                          Buffer<float>& radiance) {
    const std::size_t cells = std::size_t(map.cells) * std::size_t(map.cells);
    PILEUS_TRY(allocate(arrays::ground_light(cells), radiance));
    if (cells == 0) return Status::ok();
    // The same groups of slots as the collectors' batches.
    const std::size_t slots = in.photons->slots.size(), group = std::size_t(batch);
    const std::size_t batches = std::size_t(in.batches);
    const std::size_t first = batch > 0 ? (group - 1) * slots / batches : 0;
    const std::size_t last = batch > 0 ? group * slots / batches : slots;
    double generations = 0;
    for (std::size_t s = first; s < last; ++s)
        generations += double(in.photons->slots[s].generations);
    if (!(generations > 0)) return Status::ok();
    // What a generation that was ended within has brought counts for the lights that it reached.
    std::vector<double> whole;
    for (std::size_t l = 0; l < in.lighting->lights.size(); ++l) {
        double shot = 0;
        for (std::size_t s = first; s < last; ++s)
            if (in.photons->slots[s].generations > 0)
                shot += in.photons->slots[s].generations_of(l);
        whole.push_back(generations / shot);
    }
    // Irradiance = flux per cell area; a Lambertian ground sends albedo / pi of it back.
    const double unit = in.lighting->ground_albedo / 3.14159265358979323846 *
                        double(map.per_metre[0]) * double(map.per_metre[1]) /
                        (generations * double(std::uint64_t{1} << in.deposit.places));
    const std::size_t channels = std::size_t(sum_channels(*in.medium, in.deposit));
    for (std::size_t i = 0; i < cells; ++i) {
        double rgb[3] = {};
        for (std::size_t s = first; s < last; ++s) {
            const PhotonSlot& slot = in.photons->slots[s];
            if (slot.generations == 0) continue;
            const std::size_t stride = slot.sums.size() / in.lighting->lights.size();
            for (std::size_t l = 0; l < in.lighting->lights.size(); ++l) {
                const std::int64_t* cell =
                    slot.sums.data() + (l + 1) * stride - (cells - i) * channels;
                for (std::size_t c = 0; c < 3; ++c)
                    rgb[c] += double(cell[channels == 3 ? c : 0]) * slot.flux_per_photon_m2[l] *
                              in.lighting->lights[l].colour[c] * whole[l];
            }
        }
        for (std::size_t c = 0; c < 3; ++c) radiance[c * cells + i] = float(rgb[c] * unit);
    }
    return Status::ok();
}

}  // namespace pileus
