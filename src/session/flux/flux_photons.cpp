// SPDX-License-Identifier: Apache-2.0
// Fluxes by photons: what each collision absorbs, and what leaves through top and bottom.
// in: FluxTask, a number of photons -> out: shares of the incident flux, maps, absorbed power.
// docs/flux.md, "By photons"
#include "src/base/random_streams.h"
#include "src/plan/accumulation.h"
#include "src/run/work_share.h"
#include "src/session/flux/flux_tally.h"
#include "src/world/majorant/majorants.h"
#include "src/world/plan_parts.h"

namespace pileus {
namespace {

constexpr std::int64_t kFewestPhotons = 1024;
/// Events after which a photon is given up.
constexpr std::uint32_t kMaxEvents = 1u << 20;

/// Parts of the grid's voxels along an axis: photons are counted voxel by voxel.
Status check_parts(const char* option, int parts, int voxels, const char* axis) {
    if (parts <= voxels && voxels % parts == 0) return Status::ok();
    return Status::bad_input(std::string(option) + ": along " + axis + ", " +
                             std::to_string(parts) + ", allowed: what divides the media's " +
                             std::to_string(voxels) + " cells (with photons)");
}

Status make_layout(const FluxTask& task, const FluxResult& result, FluxLayout& layout) {
    const Medium& medium = task.scenery.world->medium;
    const Grid& grid = medium.grid;
    const char* const axes[3] = {"x", "y", "z"};
    layout.columns = result.columns;
    for (std::size_t a = 0; a < 2; ++a)
        PILEUS_TRY(check_parts("--columns", layout.columns[a], grid.size[a], axes[a]));
    for (std::size_t a = 0; a < 3; ++a) {
        layout.cells[a] = 1;
        if (!task.settings.absorbed) continue;
        layout.cells[a] = task.settings.cells[a] > 0 ? task.settings.cells[a] : grid.size[a];
        PILEUS_TRY(check_parts("--cells", layout.cells[a], grid.size[a], axes[a]));
    }
    if (!is_white(medium)) layout.cell_count = layout.slice() * std::size_t(layout.cells[2]);
    const std::uint64_t faces =
        std::uint64_t(kMeterFaces) * std::uint64_t(grid.size[0]) * std::uint64_t(grid.size[1]);
    if (voxel_count(grid) + faces < std::uint64_t{1} << 31) return Status::ok();
    return Status::limit(task.scene.file +
                         ": media: more than 2^31 cells and faces, allowed: "
                         "fewer, by photons");
}

/// The collector of every voxel, and of every voxel's face on top and bottom.
Status number_collectors(const FluxLayout& layout, const Grid& g, Buffer<std::int32_t>& out) {
    const std::size_t nx = std::size_t(g.size[0]), ny = std::size_t(g.size[1]);
    const std::size_t voxels = voxel_count(g);
    PILEUS_TRY(out.resize(voxels + kMeterFaces * nx * ny, "collectors of the voxels"));
    const auto part = [&](std::size_t i, std::size_t a, int parts) {
        return i * std::size_t(parts) / std::size_t(g.size[a]);
    };
    for (std::size_t v = 0; v < voxels; ++v) {
        const std::size_t x = part(v % nx, 0, layout.cells[0]);
        const std::size_t y = part(v / nx % ny, 1, layout.cells[1]);
        const std::size_t z = part(v / (nx * ny), 2, layout.cells[2]);
        const std::size_t cell = z * layout.slice() + y * std::size_t(layout.cells[0]) + x;
        out[v] = layout.cell_count > 0 ? std::int32_t(cell) : -1;
    }
    for (std::size_t i = 0; i < kMeterFaces * nx * ny; ++i) {
        const std::size_t x = part(i % nx, 0, layout.columns[0]);
        const std::size_t y = part(i / nx % ny, 1, layout.columns[1]);
        const std::size_t column = y * std::size_t(layout.columns[0]) + x;
        out[voxels + i] = std::int32_t(layout.face(MeterFace(i / (nx * ny)), column));
    }
    return Status::ok();
}

/// All light that enters, none of it taken out as a constant: pictures may do so, fluxes may not.
Lighting lights_of(const FluxTask& task) {
    Lighting lit = task.scenery.lighting;
    const Medium& medium = task.scenery.world->medium;
    lit.lights.clear();
    lit.constant = {};
    const auto add = [&](const char* name, std::uint32_t stream, const Double3& colour,
                         Light light) {
        if (!(colour[0] > 0 || colour[1] > 0 || colour[2] > 0) || !(light.power_m2 > 0)) return;
        light.name = name;
        light.stream = stream;
        light.colour = colour;
        lit.lights.push_back(std::move(light));
    };
    if (task.settings.from_below) {
        const auto& below = task.settings.below_radiance;
        lit.map = SkyMapView{};
        add("from below", kGroundStream, {below[0], below[1], below[2]}, diffuse_light(medium, 1));
        return lit;
    }
    if (lit.sunlit) {
        const Double3 travel{-double(lit.to_sun[0]), -double(lit.to_sun[1]),
                             -double(lit.to_sun[2])};
        add("sun", kSunStream, lit.sun_irradiance, beam_light(medium, travel));
    }
    if (lit.map.columns > 0)
        add("sky", kSkyStream, {1, 1, 1}, map_light(task.scenery.environment.sky_map));
    else
        add("sky", kSkyStream, lit.sky, diffuse_light(medium, lit.ground.present ? -1 : 0));
    if (lit.ground.present)
        add("ground", kGroundStream, lit.ground.diffuse + lit.ground.sun, diffuse_light(medium, 1));
    return lit;
}

/// Bytes of all that is held beside the world.
std::uint64_t bytes_of_sums(const FluxTask& task, const FluxLayout& layout, const TraceInput& in,
                            std::uint64_t own) {
    const Grid& g = task.scenery.world->medium.grid;
    const std::uint64_t entries =
        voxel_count(g) + 4 * std::uint64_t(g.size[0]) * std::uint64_t(g.size[1]);
    const std::uint64_t lights = in.lighting->lights.size();
    std::uint64_t bytes = sum_of_bytes(own, bytes_of(entries, 4));
    bytes = sum_of_bytes(bytes, bytes_of(slot_stride(in), lights, 8));
    bytes = sum_of_bytes(bytes, bytes_of(layout.collectors(), 3, sizeof(Batched)));
    bytes = sum_of_bytes(bytes, bytes_of(layout.column_count(), 6, sizeof(Batched)));
    if (task.settings.absorbed) bytes = sum_of_bytes(bytes, bytes_of(layout.cell_count, 6, 4));
    return sum_of_bytes(bytes, bytes_of(voxel_count(g), 4));  // the density itself
}

/// Whether threads share their sums, and whether all fits.
Status weigh(const FluxTask& task, const FluxLayout& layout, TraceInput& in) {
    AccumulationSizes sizes;
    sizes.threads = std::uint64_t(in.threads);
    sizes.set = bytes_of(slot_stride(in), 8);
    sizes.others = bytes_of_sums(task, layout, in, 0);
    sizes.limit = task.context.limits[LimitId::kMemory];
    sizes.exact = true;
    const Accumulation way = plan_accumulation(AccumulationChoice::kAuto, sizes);
    in.shared_sums = way.shared;
    return check_limit(task.context.limits, LimitId::kMemory,
                       bytes_of_sums(task, layout, in, way.bytes), task.scene.file);
}

/// Shoots all batches into the tally.
Status shoot(const FluxTask& task, const TraceInput& in, std::size_t lights, FluxTally& tally,
             std::vector<TraceTally>& tallies) {
    const StageClock clock(task.context, "photons");
    TraceScratch scratch;
    PhotonSlot slot;
    PILEUS_TRY(prepare_trace(in, scratch));
    PILEUS_TRY(slot.sums.resize(slot_stride(in) * lights, "photon sums"));
    tallies.assign(lights, TraceTally{});
    for (int b = 0; b < kFluxBatches; ++b) {
        PILEUS_TRY(trace_generation(in, std::uint64_t(b), scratch, slot, tallies));
        if (task.context.sharing != nullptr) {
            PILEUS_TRY(task.context.sharing->sum(slot.sums.span()));
            PILEUS_TRY(task.context.sharing->sum({&slot.scatterings, 1}));
        }
        if (slot.generations == 0)
            return {Code::kCheckFailed, "interrupted before all was measured; nothing written"};
        tally.add(slot);
        empty_slot(slot, in.threads);
        task.context.tell("photons", double(b + 1) / kFluxBatches);
    }
    if (task.context.sharing == nullptr) return Status::ok();
    for (TraceTally& tally_of_light : tallies)
        PILEUS_TRY(task.context.sharing->sum({reinterpret_cast<std::int64_t*>(&tally_of_light),
                                              sizeof(TraceTally) / sizeof(std::int64_t)}));
    return Status::ok();
}

/// Majorants: where cells gather, each is met about once by light that crosses it.
Status make_tracks(const FluxTask& task, const FluxLayout& layout, Majorants& majorants) {
    const Medium& medium = task.scenery.world->medium;
    if (!task.settings.absorbed || layout.cell_count == 0 || !(medium.sigma > 0))
        return make_photon_majorants(medium, true, task.context, majorants);
    CellGrid cells;
    for (std::size_t a = 0; a < 3; ++a) cells.size[a] = layout.cells[a];
    CellMajorants near;
    return make_cell_majorants(medium, true, cells, task.context, majorants, near);
}

}  // namespace

Status flux_by_photons(const FluxTask& task, std::int64_t photons, FluxResult& out, Image& maps,
                       Report& report) {
    const Context& context = task.context;
    const Medium& medium = task.scenery.world->medium;
    if (photons < kFewestPhotons)
        return Status::bad_input("--budget photons: " + std::to_string(photons) +
                                 ", allowed: at least " + std::to_string(kFewestPhotons));
    PILEUS_TRY(
        check_limit(context.limits, LimitId::kPhotons, std::uint64_t(photons), "--budget photons"));
    FluxLayout layout;
    PILEUS_TRY(make_layout(task, out, layout));
    SkyMap& map = task.scenery.environment.sky_map;
    if (map.present() && !task.settings.from_below) {
        PILEUS_TRY(aim_sky_map(medium.extent_m, medium.grid.periodic, map));
        task.scenery.light(0);
        set_one_sun(task.scenery.lighting);
    }
    Lighting lighting = lights_of(task);
    share_photons(std::uint64_t(photons) / kFluxBatches, lighting.lights);

    Buffer<std::int32_t> collectors;
    PILEUS_TRY(number_collectors(layout, medium.grid, collectors));
    Majorants majorants;
    PILEUS_TRY(make_tracks(task, layout, majorants));
    TraceInput in;
    in.medium = &medium;
    in.lighting = &lighting;
    in.majorants = majorants.tracking.span();
    in.block = majorants.block;
    in.collector_of_voxel = collectors.span();
    in.collectors = layout.collectors();
    in.deposit.mode = kDepositAbsorbed;
    in.deposit.bands = in.deposit.coefficients = 1;
    in.deposit.channels = medium.channels == 3 || lighting.map.planes == 3 ? 3 : 1;
    in.deposit.places =
        fixed_point_places(double(photons) / kFluxBatches * 1.5 * double(kMaxEvents), 1.01);
    if (in.deposit.places < 0)
        return Status::limit("--budget photons: could overflow the 64-bit sums; take fewer");
    in.seed = std::uint64_t(task.scene.seed);
    in.threads = context.threads;
    in.kernels = context.kernels;
    in.max_events = kMaxEvents;
    if (context.sharing != nullptr)
        in.part = context.sharing->part();
    else
        in.ended = patient_stop(context);
    PILEUS_TRY(weigh(task, layout, in));
    PILEUS_TRY(check_work(estimate_work(medium_work(medium, task.scenery.world->source.mean_density,
                                                    double(kMaxEvents), double(photons))),
                          context.limits, task.scene.file));

    FluxTally tally(task, layout, in);
    PILEUS_TRY(tally.open());
    std::vector<TraceTally> tallies;
    PILEUS_TRY(shoot(task, in, lighting.lights.size(), tally, tallies));
    tally.shares(out);
    tally.maps(maps);
    if (task.settings.absorbed) PILEUS_TRY(tally.absorbed(out.absorbed));
    TraceTally all{};
    for (const TraceTally& t : tallies) add_tally(t, all);
    out.photons = std::uint64_t(all.photons);
    out.batches = kFluxBatches;
    if (all.light.emitted[0] > 0)
        out.terminated = double(all.light.terminated[0]) / double(all.light.emitted[0]);
    report.photons.traced = out.photons;
    report.photons.generations = kFluxBatches;
    report.counters.emplace_back("majorant_violations", std::uint64_t(all.majorant_violations));
    return Status::ok();
}

}  // namespace pileus
