// SPDX-License-Identifier: Apache-2.0
// Which light of a run is shown, and to whom.
// in: slots of integer sums, lights, the camera -> out: sums per light as power; the ground's
// light. docs/methods.md 3, each image frame, step 4.
#pragma once
#include "kernels_cpu/core/sh.h"
#include "kernels_cpu/display/pixel_light.h"
#include "src/photons/trace.h"

namespace pileus {

/// What one light's bands and the degrees about its axis are multiplied by.
struct Damping {
    double factor[kMaxBands + kMaxAxisDegrees];
};

struct LightInput {
    const Medium* medium = nullptr;
    const Lighting* lighting = nullptr;
    const Photons* photons = nullptr;
    const PhotonSlot* whole = nullptr;  ///< all slots as one, where that is kept; else null
    CameraParams camera{};
    DepositPlan deposit;
    bool first_order_alone = false;  ///< only sunlight scattered once, where deposits keep it apart
    bool damps = false;              ///< see damp_rings
    Damping damping;                 ///< of the beam and of lamps
    LightAxis axes[kMaxAxes]{};      ///< see set_axes
    int batches = 0;  ///< also one RGB for each of so many groups of slots, for the error
    int threads = 1;
};

namespace arrays {

/// Three channels of what the ground sends back.
inline Array<float> ground_light(std::uint64_t cells) {
    return {"ground map", bytes_of(3, cells), Stage::kBackground, Stage::kBackground};
}

}  // namespace arrays

/// Slots up to the first that no generation has reached: tracing may have ended early.
std::size_t filled_slots(const Photons& photons);

/// Slots that are shown together.
struct Batch {
    Span<const PhotonSlot> slots;
    double generations = 0;
};

/// Those of group `batch` of `in.batches`, or of all of the light: -1.
Batch batch_of(const LightInput& in, int batch);

/// What a light's sums in a slot are multiplied by, to be of unit colour.
double slot_norm(const LightInput& in, const PhotonSlot& slot, std::size_t light);

/// What the degrees of the deposits are about: the sun's present way and lamps where they are now.
void set_axes(LightInput& in);

/// The way of the straight light that an axis is about, at a place, m, box-local.
Vec<float> axis_way(const LightAxis& axis, const Vec<float>& place);

/// Lights whose narrow peak no table of a beam holds (beam.h) go on as narrow as they came where
/// phase functions are. Few bands of that ring at all angles, and as no light is less than none,
/// the rings' positive halves would be light that is not there. So they are spread: by
/// (sin x / x)^2 of a degree's place among all.
void damp_rings(LightInput& in);
void damp(const LightInput& in, std::size_t light, double* sums);

/// Most that a phase function's mean over a pixel can be where light goes `to` the camera.
inline float most_towards(const LightInput& in, const Vec<float>& to) {
    return most_density(in.camera, Vec<float>{-to.x, -to.y, -to.z});
}

/// Sums of one set of one light in one slot, times `norm`.
inline void slot_sums(const LightInput& in, const PhotonSlot& slot, std::size_t light,
                      std::uint64_t set, double norm, double* sums) {
    const int n = in.deposit.coefficients;
    const std::uint64_t stride = slot.sums.size() / in.lighting->lights.size();
    numbers_of_set(slot, light, stride, set, n, sums);
    for (int i = 0; i < n; ++i) sums[i] *= norm;
    if (in.damps) damp(in, light, sums);
}

/// Sums of one set of one light in one slot, per unit of its colour.
void slot_sums(const LightInput& in, const PhotonSlot& slot, std::size_t light, std::uint64_t set,
               double* sums);

/// Sets of a run whose sums have so many colour channels: one per light where light differs in
/// colour only, otherwise one per channel.
int harmonic_sets(int channels, const Lighting& lighting);

/// Radiance that the cells of the ground send back of the light scattered onto them (or kept from
/// them, then negative): [3][cells * cells]. `batch` 0: of all slots; 1 ... in.batches: of that
/// group of them alone. kLimit: out of memory.
Status reconstruct_ground(const LightInput& in, const GroundMap& map, int batch,
                          Buffer<float>& radiance);

}  // namespace pileus
