// SPDX-License-Identifier: Apache-2.0
// Launches photons: chunks over threads, integer sums of each or of all, reduced exactly.
// in: medium, lights, a map from voxels to collectors -> out: one slot of sums per batch, ledgers.
// docs/methods.md 3; the result is a function of (seed, light, photon index) alone.
#pragma once
#include <functional>

#include "kernels_cpu/core/sh.h"
#include "kernels_cpu/isa/kernels.h"
#include "src/photons/photon_slot.h"
#include "src/plan/part_light.h"
#include "src/world/light/lights.h"
#include "src/world/majorant/majorants.h"

namespace pileus {

/// What is stored of a collision and how.
struct DepositPlan {
    std::int32_t mode = kDepositIncident;
    int bands = 4;
    int first_order = 0;                                      ///< see TraceParams
    int axis_degrees = 0;                                     ///< see TraceParams
    int axes = 1;                                             ///< see TraceParams
    int lamp_axis = 0;                                        ///< see TraceParams
    float peak_turn = 0;                                      ///< see TraceParams
    double peak_deg = 0;                                      ///< the same as an angle
    bool by_bands = false;                                    ///< marched nodes hold bands
    float kept[kMaxMedia][kMaxBands + kMaxAxisDegrees] = {};  ///< moments of that
    int coefficients = 16;                                    ///< per collector and channel
    int channels = 0;  ///< that photons tell apart, 1 or 3; 0: as many as the medium
    int places = 16;   ///< binary places of the sums
    float camera[3] = {0, 0, 0};
    bool orthographic = false;

    /// Whether what turns within the peak goes on as it came: MarchParams::apart.
    bool apart() const { return by_bands && peak_turn > 0; }
};

/// Numbers beyond the bands, about all axes.
inline int axis_numbers(const DepositPlan& deposit) { return deposit.axis_degrees * deposit.axes; }

/// 1 - cos of turns by less that keep light with its lamp: sums of scattered directions know lamps'
/// light by its order alone.
inline float lamp_peak_turn(const DepositPlan& deposit) {
    return deposit.mode == kDepositOutgoing ? 0.0f : deposit.peak_turn;
}

/// Square cells over the ground around the box in which arriving light is counted.
struct GroundMap {
    int cells = 0;         ///< along x and along y; 0: no map
    float origin[2]{};     ///< m, box-local
    float per_metre[2]{};  ///< cells per metre
};

/// A map that reaches out of the box by its height above the ground, or covers one period; none
/// without a ground.
GroundMap make_ground_map(const Medium& medium, const Lighting& lighting);

/// Colour channels of the sums.
inline int sum_channels(const Medium& medium, const DepositPlan& deposit) {
    return deposit.channels > 0 ? deposit.channels : medium.channels;
}

/// A regular grid over the box that gathers track lengths at every tentative collision.
struct GatherCells {
    int size[3] = {0, 0, 0};  ///< 0: leaves of collectors gather
    float density = 0;        ///< least positive majorant: a collision there deposits 1
};

struct TraceInput {
    const Medium* medium = nullptr;
    const Lighting* lighting = nullptr;
    Span<const float> majorants;
    int block = 1;
    Span<const std::int32_t> collector_of_voxel;
    std::uint64_t collectors = 0;  ///< or cells
    GatherCells cells;
    DepositPlan deposit;
    std::uint64_t seed = 0;
    int threads = 1;
    const KernelTable* kernels = nullptr;
    std::uint32_t max_events = 1u << 20;
    WorkPart part{};  ///< whose share of each generation's photons is traced
    GroundMap ground{};
    bool shared_sums = false;       ///< all threads add atomically to one set of sums
    bool packs = false;             ///< sums stay in the scratch until the caller has packed them
    std::function<bool()> ended{};  ///< asked between pieces of work whether to end there
};

struct Photons {
    std::vector<PhotonSlot> slots;
    std::vector<TraceTally> tallies;  ///< per light
};

/// Of what the launches of an input leave behind.
SlotSize slot_size(const TraceInput& in);

/// Numbers per light in a slot.
inline std::uint64_t slot_stride(const TraceInput& in) { return slot_size(in).numbers(); }

namespace arrays {

/// Every thread has two, a cache line pair apart; `last` traces.
inline Array<TraceTally> photon_tallies(std::uint64_t threads, Stage last) {
    return {"photon tallies per thread", bytes_of(2, threads), Stage::kPhotons, last};
}
/// Sums of all threads that have their own. The plan bounds them by bytes_of_sums, which it knows
/// before the stride.
inline Array<std::int64_t> photon_sums(std::uint64_t stride, std::uint64_t threads, Stage last) {
    return {"photon sums per thread", bytes_of(stride, threads), Stage::kPhotons, last};
}

}  // namespace arrays

/// Scratch of the tracer, allocated once: tallies per thread, and sums per thread where there are
/// several and they do not share; one set of sums at least where they are packed.
struct TraceScratch {
    Buffer<std::int64_t> sums;
    Buffer<TraceTally> tallies;
    std::uint64_t stride = 0;  ///< numbers per thread, padded to a cache line pair
    int blocks = 0;            ///< of sums
};
Status prepare_trace(const TraceInput& in, TraceScratch& scratch);

/// The kernel that a launch needs: cells gather, or there are solids on the way, or neither.
using TraceKernel = decltype(KernelTable::trace);
TraceKernel trace_kernel(const KernelTable& kernels, const TraceParams& k);

/// What a launch of one light's photons of a generation takes; `key`, and the place of the launch
/// within the generation, are the caller's.
TraceParams launch_params(const TraceInput& in, const Light& light, std::uint64_t generation);

/// Shoots one generation of every light into `slot` and adds to the tallies. Generation numbers
/// may grow without bound; each has photons of its own. Where `in.ended` ends it, it does not
/// count: slot.parts says how much of it each light has shot. `pack` is called for each light once
/// its sums are in the scratch, where in.packs, and leaves zeros there.
Status trace_generation(const TraceInput& in, std::uint64_t generation, TraceScratch& scratch,
                        PhotonSlot& slot, std::vector<TraceTally>& tallies,
                        const std::function<void(std::size_t light)>& pack = {});

/// Units of the ledger's paths per diagonal of the box: 2000 diagonals fit its 32 bits, and 128 000
/// where light may graze along a periodic medium.
inline double path_units(const Medium& medium) { return medium.grid.periodic ? 16384 : 1048576; }

/// Adds `from` to `to`, field by field.
void add_tally(const TraceTally& from, TraceTally& to);

}  // namespace pileus
