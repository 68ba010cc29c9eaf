// SPDX-License-Identifier: Apache-2.0
// See light_input.h.
#include "src/photons/light_input.h"

#include "kernels_cpu/media/phase.h"
#include "src/base/angles.h"

namespace pileus {
namespace {

/// A phase function that sends on more of this degree than that is too narrow for few bands: from
/// g = 0.96 on of Henyey-Greenstein.
constexpr int kNarrowDegree = 4;
constexpr float kNarrow = 0.85f;

bool is_narrow(const Medium& medium) {
    for (int i = 0; i < medium.count; ++i) {
        const float chi = phase_moment(medium.optics[std::size_t(i)].phase, kNarrowDegree);
        if (chi > kNarrow || chi < -kNarrow) return true;
    }
    return false;
}

}  // namespace

void set_axes(LightInput& in) {
    for (LightAxis& axis : in.axes) axis = LightAxis{0, {0, 0, -1}};
    if (in.deposit.lamp_axis > 0)
        for (std::size_t a = 0; a < 3; ++a) in.axes[0].at[a] = -in.lighting->to_sun[a];
    for (const LampEmission& e : in.lighting->lamp_emission) {
        const int number = in.deposit.lamp_axis + e.own_axis;
        if (e.own_axis < 0 || number >= in.deposit.axes) continue;
        LightAxis& axis = in.axes[number];
        axis.placed = e.lamp.parallel == 0 ? 1 : 0;
        for (int a = 0; a < 3; ++a) axis.at[a] = axis.placed != 0 ? e.lamp.at[a] : -e.lamp.at[a];
    }
}

Vec<float> axis_way(const LightAxis& axis, const Vec<float>& place) {
    if (axis.placed == 0) return {axis.at[0], axis.at[1], axis.at[2]};
    const Vec<float> v{place.x - axis.at[0], place.y - axis.at[1], place.z - axis.at[2]};
    // At the lamp itself any way will do.
    if (!(dot(v, v) > 1e-12f)) return {0, 0, 1};
    return normalized(v);
}

void damp_rings(LightInput& in) {
    in.damps = is_narrow(*in.medium);
    if (!in.damps) return;
    double* factor = in.damping.factor;
    for (int l = 0; l < kMaxBands + kMaxAxisDegrees; ++l) factor[l] = 1;
    const int degrees = in.deposit.bands + in.deposit.axis_degrees;
    for (int l = 1; !(in.deposit.peak_turn > 0) && l < degrees; ++l) {
        const double x = double(l) / degrees;
        const double sinc = sincos_deg(180 * x).sine / (kPi64 * x);
        factor[l] = sinc * sinc;
    }
}

void damp(const LightInput& in, std::size_t light, double* sums) {
    const Light& shown = in.lighting->lights[light];
    if (!shown.beam && !shown.lamps) return;
    const double* factor = in.damping.factor;
    int i = 0;
    for (int l = 0; l < in.deposit.bands; ++l)
        for (int m = -l; m <= l; ++m, ++i) sums[i] *= factor[l];
    for (int axis = 0; axis < in.deposit.axes; ++axis)
        for (int d = 0; d < in.deposit.axis_degrees; ++d, ++i)
            sums[i] *= factor[in.deposit.bands + d];
}

std::size_t filled_slots(const Photons& photons) {
    std::size_t filled = 0;
    while (filled < photons.slots.size() && photons.slots[filled].generations > 0) ++filled;
    return filled;
}

Batch batch_of(const LightInput& in, int batch) {
    const std::size_t slots = filled_slots(*in.photons);
    std::size_t first = 0, last = slots;
    if (batch >= 0) {
        first = std::size_t(batch) * slots / std::size_t(in.batches);
        last = (std::size_t(batch) + 1) * slots / std::size_t(in.batches);
    }
    Batch b;
    b.slots = {in.photons->slots.data() + first, last - first};
    if (batch < 0 && in.whole != nullptr) b.slots = {in.whole, 1};
    for (const PhotonSlot& slot : b.slots) b.generations += double(slot.generations);
    return b;
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
    // The same groups of slots as those of the media's light.
    const Batch shown = batch_of(in, batch - 1);
    if (!(shown.generations > 0)) return Status::ok();
    // What a generation that was ended within has brought counts for the lights that it reached.
    std::vector<double> whole;
    for (std::size_t l = 0; l < in.lighting->lights.size(); ++l) {
        double shot = 0;
        for (const PhotonSlot& slot : shown.slots)
            if (slot.generations > 0) shot += slot.generations_of(l);
        whole.push_back(shown.generations / shot);
    }
    // Irradiance = flux per cell area; a Lambertian ground sends albedo / pi of it back.
    const double unit = in.lighting->ground.albedo / kPi64 * double(map.per_metre[0]) *
                        double(map.per_metre[1]) /
                        (shown.generations * double(std::uint64_t{1} << in.deposit.places));
    const std::size_t channels = std::size_t(sum_channels(*in.medium, in.deposit));
    for (std::size_t i = 0; i < cells; ++i) {
        double rgb[3] = {};
        for (const PhotonSlot& slot : shown.slots) {
            if (slot.generations == 0) continue;
            const std::size_t lights = in.lighting->lights.size();
            for (std::size_t l = 0; l < lights; ++l) {
                const std::int64_t* cell =
                    ground_of(slot, l, lights, cells * channels) + i * channels;
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
