// SPDX-License-Identifier: Apache-2.0
// See trace.h.
#include "src/photons/trace.h"

#include <algorithm>

#include "kernels_cpu/core/accumulate.h"
#include "kernels_cpu/core/meshes.h"
#include "platform/threads.h"
#include "src/base/random_streams.h"
#include "src/run/context.h"
#include "src/run/device_launch.h"
#include "src/run/on_device.h"
#include "src/run/work_share.h"
#include "src/world/majorant/majorant.h"
#include "src/world/solids/solids.h"

namespace pileus {
namespace {

constexpr std::uint64_t kChunk = 4096;                         // photons per piece of work
constexpr std::uint64_t kMaxPhotons = std::uint64_t{1} << 31;  // per launch

std::uint64_t collector_numbers(const TraceInput& in) {
    return in.collectors * std::uint64_t(sum_channels(*in.medium, in.deposit)) *
           std::uint64_t(in.deposit.coefficients);
}

/// Whether photons add to one set of sums: no other thread does, or all do it atomically.
bool adds_directly(const TraceInput& in) {
    return in.threads == 1 || in.shared_sums || on_device(in.kernels->device);
}

/// `count` photons of one light that share the high half of their index.
struct Launch {
    const TraceInput* in;
    TraceScratch* scratch;
    TraceParams params;
    std::uint64_t count;
    std::int64_t* total;  ///< the light's sums, of all threads
    TraceKernel kernel;   ///< of the host
};

void run_piece(const Launch& launch, std::uint64_t piece, int thread) {
    const TraceInput& in = *launch.in;
    const std::uint64_t begin = piece * kChunk;
    const std::uint64_t end = begin + kChunk < launch.count ? begin + kChunk : launch.count;
    std::int64_t* sums = launch.total;
    if (!adds_directly(in))
        sums = launch.scratch->sums.data() + std::uint64_t(thread) * launch.scratch->stride;
    const TraceBuffers b{
        in.collector_of_voxel.data,   sums,
        sums + collector_numbers(in), &launch.scratch->tallies[std::size_t(thread) * 2],
        in.medium->parts.data(),      in.threads > 1 && adds_directly(in) ? 1 : 0};
    launch.kernel(launch.params, b, std::uint32_t(begin), std::uint32_t(end));
}

/// The whole launch at once, a photon per thread of the device.
Status run_on_device(const Launch& launch) {
    const TraceInput& in = *launch.in;
    const TraceBuffers b{in.collector_of_voxel.data,
                         launch.total,
                         launch.total + collector_numbers(in),
                         &launch.scratch->tallies[0],
                         in.medium->parts.data(),
                         1};
    return launch_on_device(*in.kernels->device, launch.params, b, slot_stride(in),
                            std::uint32_t(launch.count));
}

/// `ended`: not all photons ran, because the input said so.
Status run_launch(const Launch& launch, int threads, bool& ended) {
    if (on_device(launch.in->kernels->device)) return run_on_device(launch);
    const std::uint64_t pieces = (launch.count + kChunk - 1) / kChunk;
    if (launch.in->shared_sums && !kSharesSums) threads = 1;
    ended = !run_until(
        threads, std::int64_t(pieces), launch.in->ended,
        [&](std::int64_t piece, int thread) { run_piece(launch, std::uint64_t(piece), thread); });
    return Status::ok();
}

/// Numbers that one thread takes at a time.
constexpr std::uint64_t kTracePiece = 1u << 15;

/// Calls function(begin, end) for pieces of `count` numbers.
template <class Function>
void in_pieces(std::uint64_t count, int threads, Function function) {
    parallel_for(threads, std::int64_t((count + kTracePiece - 1) / kTracePiece),
                 [&](std::int64_t p, int) {
                     const std::uint64_t begin = std::uint64_t(p) * kTracePiece;
                     function(begin, begin + kTracePiece < count ? begin + kTracePiece : count);
                 });
}

/// Adds all threads' own sums to the total and leaves zeros behind.
void move_sums(TraceScratch& scratch, std::int64_t* total, std::uint64_t count, int threads) {
    in_pieces(count, threads, [&](std::uint64_t begin, std::uint64_t end) {
        for (int t = 0; t < threads; ++t) {
            std::int64_t* own = scratch.sums.data() + std::uint64_t(t) * scratch.stride;
            for (std::uint64_t i = begin; i < end; ++i) {
                total[i] += own[i];
                own[i] = 0;
            }
        }
    });
}

void add_fates(const Fates& from, Fates& to) {
    const auto* source = reinterpret_cast<const std::int64_t*>(&from);
    auto* target = reinterpret_cast<std::int64_t*>(&to);
    for (std::size_t i = 0; i < sizeof(Fates) / sizeof(std::int64_t); ++i) target[i] += source[i];
}

/// The ground is lit by less of the sun than the media high above it, and misses less of it where
/// they shadow it. One channel for all has the mean of what they take.
void set_unowed(const Lighting& light, TraceParams& k) {
    double all = 0, has = 0;
    for (int c = 0; c < 3; ++c) {
        all += light.ground.beam[c];
        has += light.ground.sun[c];
        if (light.ground.beam[c] > 0)
            k.unowed[c] = float(1 - std::min(light.ground.sun[c] / light.ground.beam[c], 1.0));
    }
    if (k.channels == 1 && all > 0) k.unowed[0] = float(1 - std::min(has / all, 1.0));
}

}  // namespace

TraceKernel trace_kernel(const KernelTable& kernels, const TraceParams& k) {
    if (k.cells[0] > 0) return kernels.trace_cells;
    return has_meshes(k.solids) ? kernels.trace_solids : kernels.trace;
}

TraceParams launch_params(const TraceInput& in, const Light& light, std::uint64_t generation) {
    const Medium& m = *in.medium;
    TraceParams k{};
    double diagonal = 0;
    for (int a = 0; a < 3; ++a) {
        k.direction[a] = light.travel[std::size_t(a)];
        k.camera[a] = in.deposit.camera[a];
        k.axis[a] = light.beam ? light.travel[std::size_t(a)]
                               : (a < 2 ? 0.0f : (light.hemisphere > 0 ? 1.0f : -1.0f));
        k.cells[a] = in.cells.size[a];
        k.cells_per_voxel[a] = float(double(in.cells.size[a]) / m.grid.size[a]);
        diagonal += m.extent_m[a] * m.extent_m[a];
    }
    k.cell_density = in.cells.density;
    k.grid = track_grid(m, in.majorants, in.block, in.max_events);
    k.channels = sum_channels(m, in.deposit);
    k.media = m.count;
    for (std::size_t i = 0; i < m.optics.size(); ++i) k.optics[i] = m.optics[i];
    if (light.emitter >= 0) k.emitted_below = m.emitters[std::size_t(light.emitter)].below.data();
    k.light = light.emitter >= 0 ? kLightMedia
              : light.map        ? kLightMap
              : light.lamps      ? kLightLamps
              : light.beam       ? kLightBeam
                                 : kLightDiffuse;
    k.map = in.lighting->map;
    k.lamps = in.lighting->lamp_emission.data();
    k.lamp_count = std::int32_t(in.lighting->lamp_emission.size());
    k.hemisphere = light.hemisphere;
    for (std::size_t f = 0; f < 6; ++f) k.face_cdf[f] = light.face_cdf[f];
    k.ground = in.lighting->ground.present ? 1 : 0;
    k.ground_z = float(in.lighting->ground.z);
    k.ground_albedo = float(in.lighting->ground.albedo);
    if (light.beam) set_unowed(*in.lighting, k);
    for (int a = 0; a < 2; ++a) {
        k.ground_cells[a] = in.ground.cells;
        k.ground_origin[a] = in.ground.origin[a];
        k.ground_cells_per_metre[a] = in.ground.per_metre[a];
    }
    k.mode = in.collectors == 0 ? kDepositNone : in.deposit.mode;
    k.bands = in.deposit.bands;
    k.first_order = in.deposit.first_order;
    k.axis_degrees = in.deposit.axis_degrees;
    k.axes = in.deposit.axes;
    k.lamp_axis = in.deposit.lamp_axis;
    k.peak_turn = light.lamps ? lamp_peak_turn(in.deposit) : in.deposit.peak_turn;
    k.coefficients = in.deposit.coefficients;
    k.scale = float(std::uint64_t{1} << in.deposit.places);
    k.path_scale = float(path_units(m) / __builtin_sqrt(diagonal));
    k.orthographic = in.deposit.orthographic ? 1 : 0;
    if (in.lighting->solids != nullptr) k.solids = in.lighting->solids->view();
    const Key shift = make_key(in.seed, shift_stream(light.stream), std::uint32_t(generation));
    k.shift[0] = shift.k0;
    k.shift[1] = shift.k1;
    return k;
}

void add_tally(const TraceTally& from, TraceTally& to) {
    add_fates(from.light, to.light);
    add_fates(from.shadow, to.shadow);
    to.photons += from.photons;
    to.scatterings += from.scatterings;
    to.tentative += from.tentative;
    to.crossings += from.crossings;
    to.path += from.path;
    to.majorant_violations += from.majorant_violations;
    to.absorption_tests += from.absorption_tests;
    to.bounces += from.bounces;
}

GroundMap make_ground_map(const Medium& medium, const Lighting& lighting) {
    constexpr int kCells = 40;
    GroundMap map;
    if (!lighting.ground.present || lighting.lights.empty()) return map;
    map.cells = kCells;
    const double reach = medium.grid.periodic ? 0 : medium.extent_m[2] - lighting.ground.z;
    for (int a = 0; a < 2; ++a) {
        map.origin[a] = float(-reach);
        map.per_metre[a] = float(kCells / (medium.extent_m[a] + 2 * reach));
    }
    return map;
}

SlotSize slot_size(const TraceInput& in) {
    return {in.collectors, std::uint64_t(sum_channels(*in.medium, in.deposit)),
            std::uint64_t(in.deposit.coefficients),
            std::uint64_t(in.ground.cells) * std::uint64_t(in.ground.cells)};
}

Status prepare_trace(const TraceInput& in, TraceScratch& scratch) {
    // Neighbouring threads keep 128 bytes apart (unpadded counters cost half the speed).
    scratch.stride = (slot_stride(in) + 31) / 16 * 16;
    scratch.blocks = adds_directly(in) ? (in.packs ? 1 : 0) : in.threads;
    PILEUS_TRY(
        allocate(arrays::photon_sums(scratch.stride, std::uint64_t(scratch.blocks), Stage::kWrite),
                 scratch.sums));
    return allocate(arrays::photon_tallies(std::uint64_t(in.threads), Stage::kWrite),
                    scratch.tallies);
}

Status trace_generation(const TraceInput& in, std::uint64_t generation, TraceScratch& scratch,
                        PhotonSlot& slot, std::vector<TraceTally>& tallies,
                        const std::function<void(std::size_t light)>& pack) {
    const std::uint64_t stride = slot_stride(in);
    std::vector<double> parts;
    bool ended = false;
    ++slot.serial;
    for (std::size_t l = 0; l < in.lighting->lights.size() && !ended; ++l) {
        const Light& light = in.lighting->lights[l];
        Launch launch{&in,
                      &scratch,
                      launch_params(in, light, generation),
                      0,
                      in.packs ? scratch.sums.data() : slot.sums.data() + l * stride,
                      nullptr};
        launch.kernel = trace_kernel(*in.kernels, launch.params);
        // Split where the photon index passes a multiple of 2^32: its high half is in the key.
        const std::uint64_t apart = light.apart > 0 ? light.apart : light.photons;
        const PartRange own = part_range(light.photons, in.part);
        std::uint64_t index = generation * apart + own.begin, left = own.end - own.begin;
        for (int a = 0; a < 2; ++a) launch.params.shift[a] += std::uint32_t(own.begin) * kR2[a];
        std::int64_t photons = 0;
        while (left > 0 && !ended) {
            const std::uint64_t room = (std::uint64_t{1} << 32) - (index & 0xffffffffu);
            launch.count = left < room ? left : room;
            if (launch.count > kMaxPhotons) launch.count = kMaxPhotons;
            launch.params.first_photon = std::uint32_t(index);
            launch.params.key = make_key(in.seed, light.stream, std::uint32_t(index >> 32));
            PILEUS_TRY(run_launch(launch, in.threads, ended));
            index += launch.count;
            left -= launch.count;
            launch.params.shift[0] += std::uint32_t(launch.count) * kR2[0];
            launch.params.shift[1] += std::uint32_t(launch.count) * kR2[1];
        }
        if (in.packs)
            pack(l);
        else if (!adds_directly(in))
            move_sums(scratch, launch.total, stride, in.threads);
        for (int t = 0; t < in.threads; ++t) {
            slot.scatterings += scratch.tallies[std::size_t(t) * 2].scatterings;
            photons += scratch.tallies[std::size_t(t) * 2].photons;
            add_tally(scratch.tallies[std::size_t(t) * 2], tallies[l]);
            scratch.tallies[std::size_t(t) * 2] = TraceTally{};
        }
        parts.push_back(light.photons > 0 ? double(photons) / double(light.photons) : 1.0);
    }
    if (ended) {
        parts.resize(in.lighting->lights.size(), 0.0);
        slot.parts = parts;
    } else {
        ++slot.generations;
    }
    return Status::ok();
}

}  // namespace pileus
