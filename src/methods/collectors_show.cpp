// SPDX-License-Identifier: Apache-2.0
// The picture of a lit collectors run: reconstruct, display, layers; and what the report tells.
// in: CollectorsRun after shooting, a camera -> out: Image.
// docs/methods.md 3, each image frame, steps 4 and 5; repairs 3 and 4.
#include "src/base/digest.h"
#include "src/methods/collectors_memory.h"
#include "src/stages/layers.h"
#include "src/stages/prepare_majorant.h"
#include "src/stages/source_grid.h"

namespace pileus {
namespace {

constexpr float kCut = 1e-4f;         // transmittance that no eye misses
constexpr float kSplatFactor = 1.2f;  // docs/methods.md 3, repair 4
constexpr double kPriorScatterings = 8;
constexpr double kShadowVoxels = 2;                  // spacing of the shadow nodes
constexpr std::uint64_t kNodeBudget = 1u << 19;      // nodes of the source grid, about
constexpr std::uint64_t kHarmonicBudget = 1u << 18;  // of one that holds harmonics

/// Numbers per node and set, filled up to whole groups.
int stored_harmonics(int bands) {
    return (bands * bands + kHarmonicsAbreast - 1) / kHarmonicsAbreast * kHarmonicsAbreast;
}

float smallest_cell(const Grid& grid) {
    float smallest = grid.cell_m[0];
    for (float cell : grid.cell_m) smallest = cell < smallest ? cell : smallest;
    return smallest;
}

MediumView view_of(const CollectorsRun& run) {
    const Medium& m = run.medium;
    MediumView v{};
    for (int a = 0; a < 3; ++a) {
        v.size[a] = m.grid.size[a];
        v.cell[a] = m.grid.cell_m[a];
        v.extent[a] = float(m.extent_m[a]);
    }
    block_counts(m.grid, run.prepared.skip_block, v.blocks);
    v.block = float(run.prepared.skip_block);
    v.sigma = m.sigma;
    v.step = smallest_cell(m.grid);
    v.density = m.volume.density.data();
    v.majorant = run.prepared.skip_majorants.data();
    v.periodic = m.grid.periodic ? 1 : 0;
    return v;
}

Status make_background(const Context& context, const CollectorsRun& run,
                       const ReconstructInput& lit, Planes& planes) {
    const StageClock clock(context, "background");
    const CameraParams& camera = lit.camera;
    Buffer<float> map;
    PILEUS_TRY(reconstruct_ground(lit, run.ground_map, map));
    BackgroundParams k{};
    k.medium = view_of(run);
    k.camera = camera;
    k.ground = run.lighting.ground ? 1 : 0;
    k.ground_z = float(run.lighting.ground_z);
    for (std::size_t c = 0; c < 3; ++c) {
        k.sky[c] = float(run.lighting.sky[c]);
        k.ground_diffuse[c] = float(run.lighting.ground_diffuse[c]);
        k.ground_sun[c] = float(run.lighting.ground_sun[c]);
        k.to_sun[c] = run.lighting.to_sun[c];
    }
    k.sky_map = run.lighting.map;
    k.map.size[0] = k.map.size[1] = run.ground_map.cells;
    k.map.size[2] = 1;
    for (int a = 0; a < 2; ++a) {
        k.map.per_metre[a] = run.ground_map.per_metre[a];
        k.map_origin[a] = run.ground_map.origin[a];
    }
    const BackgroundBuffers b{map.data(), planes.background.data(), planes.opaque_depth.data()};
    run_rows(context, context.kernels->background_rows, k, b, std::uint32_t(camera.height));
    return Status::ok();
}

NodeGrid shadow_grid(const CollectorsRun& run) {
    float coarse = 0;
    for (float cell : run.medium.grid.cell_m) coarse = cell > coarse ? cell : coarse;
    return make_node_grid(run.medium.grid, run.medium.extent_m, kShadowVoxels * double(coarse));
}

/// Optical depth towards the sun, once per position of the sun.
Status make_shadow(const Context& context, CollectorsRun& run) {
    if (run.shadow_ready || !run.lighting.sunlit || run.deposit.first_order != 2)
        return Status::ok();
    const StageClock clock(context, "shadow");
    run.shadow_nodes = shadow_grid(run);
    PILEUS_TRY(run.shadow.resize(node_count(run.shadow_nodes), "shadow"));
    ShadowParams k{};
    k.medium = view_of(run);
    k.nodes = run.shadow_nodes;
    for (std::size_t a = 0; a < 3; ++a) k.to_sun[a] = run.lighting.to_sun[a];
    run_rows(context, context.kernels->shadow_rows, k, ShadowBuffers{run.shadow.data()},
             std::uint32_t(k.nodes.size[1] * k.nodes.size[2]));
    run.shadow_ready = true;
    return Status::ok();
}

/// Spacing of the source nodes: what the budget allows, at least the cells of a cell estimate.
double source_spacing(const CollectorsRun& run) {
    const auto& e = run.medium.extent_m;
    const double smallest = double(smallest_cell(run.medium.grid));
    if (run.camera_cells > 0) return smallest * run.camera_cells;
    double spacing = 2 * smallest;
    const double budget = double(shows_harmonics(run) ? kHarmonicBudget : kNodeBudget);
    while (e[0] * e[1] * e[2] > spacing * spacing * spacing * budget) spacing *= 1.25;
    return spacing;
}

/// The prior weighs as much as the medium that eight scatterings happen in on average.
SplatOptions splat_options(const CollectorsRun& run) {
    double mass = 0, scatterings = 0;
    for (const Collector& c : run.prepared.collectors.span()) mass += c.mass;
    // Those of the ring alone: a frame must not know how many frames came before it.
    for (const PhotonSlot& slot : run.photons.slots) scatterings += double(slot.scatterings);
    SplatOptions options;
    options.radius_factor = kSplatFactor;
    options.periodic = run.medium.grid.periodic;
    options.prior_mass = scatterings > 0 ? float(kPriorScatterings * mass / scatterings) : 0.0f;
    return options;
}

Status splat(const Context& context, const CollectorsRun& run, Span<const float> colour, int planes,
             const NodeGrid& nodes, Buffer<float>& source) {
    const StageClock clock(context, "splat");
    return splat_colours(run.prepared.collectors.span(), colour, planes, nodes, splat_options(run),
                         context.threads, source);
}

/// Marches through `source` into `target`'s planes.
Status march(const Context& context, const CollectorsRun& run, const float* source,
             const MarchParams& k, float* target, Planes& planes) {
    const StageClock clock(context, "march");
    MarchBuffers b{};
    b.optical_depth = run.shadow.data();
    b.source = source;
    b.opaque_depth = planes.opaque_depth.data();
    b.parts = run.medium.parts.data();
    b.transmittance = planes.transmittance.data();
    b.half_depth = planes.half_depth.data();
    b.colour = target;
    run_rows(context, context.kernels->march_rows, k, b, std::uint32_t(k.camera.height));
    return Status::ok();
}

/// What all marches of a picture share.
MarchParams march_params(const CollectorsRun& run, const CameraParams& camera) {
    MarchParams k{};
    k.medium = view_of(run);
    k.camera = camera;
    k.media = run.medium.count;
    for (std::size_t c = 0; c < 3; ++c) {
        k.sun_travel[c] = -run.lighting.to_sun[c];
        k.constant[c] = float(run.lighting.constant[c]);
    }
    for (int i = 0; i < run.medium.count; ++i) {
        const Optics& optics = run.medium.optics[std::size_t(i)];
        k.phase[i] = optics.phase;
        for (std::size_t c = 0; c < 3 && run.deposit.first_order == 2; ++c)
            k.sun_source[i][c] = float(run.lighting.sun_irradiance[c] * double(optics.albedo[c]));
    }
    k.shadow = run.shadow_nodes;
    k.source = make_node_grid(run.medium.grid, run.medium.extent_m, source_spacing(run));
    k.channels = 3;
    k.cut = kCut;
    return k;
}

Status show_marched(const Context& context, CollectorsRun& run, const CameraParams& camera,
                    const CollectorColours& colours, int channels, Planes& planes) {
    PILEUS_TRY(make_shadow(context, run));
    MarchParams k = march_params(run, camera);
    k.channels = channels;
    Buffer<float> source;
    PILEUS_TRY(splat(context, run, colours.colour.span(), channels, k.source, source));
    return march(context, run, source.data(), k, planes.colour.data(), planes);
}

/// Numbers of one harmonic of one set after the other become those of one node after the other.
Status gather_by_node(const Context& context, const HarmonicSource& lit, const MarchParams& k,
                      Span<const float> planes, Buffer<float>& by_node) {
    const std::size_t nodes = std::size_t(node_count(k.source)),
                      own = std::size_t(k.bands * k.bands);
    const std::size_t stored = std::size_t(k.harmonics), sets = std::size_t(lit.sets);
    if (by_node.size() != nodes * sets * stored)
        PILEUS_TRY(by_node.resize(nodes * sets * stored, "source by node"));
    const std::size_t slice = nodes / std::size_t(k.source.size[2]);
    parallel_for(context.threads, k.source.size[2], [&](std::int64_t z, int) {
        for (std::size_t n = std::size_t(z) * slice; n < (std::size_t(z) + 1) * slice; ++n)
            for (std::size_t s = 0; s < sets; ++s)
                for (std::size_t i = 0; i < own; ++i)
                    by_node[(n * sets + s) * stored + i] = planes[(s * own + i) * nodes + n];
    });
    return Status::ok();
}

/// A periodic medium shows each collector from many directions at once: the nodes hold harmonics.
/// One march for the picture and one for each batch.
Status show_harmonics(const Context& context, CollectorsRun& run, const ReconstructInput& in,
                      Planes& planes) {
    PILEUS_TRY(make_shadow(context, run));
    MarchParams k = march_params(run, in.camera);
    const std::size_t pixels = std::size_t(k.camera.width) * std::size_t(k.camera.height);
    HarmonicSource lit;
    Buffer<float> source, by_node;
    Digest digest;
    for (int batch = -1; batch < in.batches; ++batch) {
        {
            const StageClock clock(context, "reconstruct");
            PILEUS_TRY(reconstruct_harmonics(in, batch, lit));
        }
        if (batch < 0) digest.floats(lit.values.span());
        k.bands = lit.bands;
        k.sets = lit.sets;
        k.harmonics = stored_harmonics(lit.bands);
        for (int s = 0; s < lit.sets; ++s)
            for (int c = 0; c < 3; ++c) k.set_colour[s][c] = lit.colour[s][c];
        float* target = planes.colour.data() + 3 * std::size_t(batch + 1) * pixels;
        PILEUS_TRY(splat(context, run, lit.values.span(), lit.sets * lit.bands * lit.bands,
                         k.source, source));
        PILEUS_TRY(gather_by_node(context, lit, k, source.span(), by_node));
        source = Buffer<float>();
        PILEUS_TRY(march(context, run, by_node.data(), k, target, planes));
    }
    context.report->digests.emplace_back("colours", digest.hex());
    return Status::ok();
}

Status show_billboards(const Context& context, const CollectorsRun& run, const CameraParams& camera,
                       const CollectorColours& colours, int channels, Planes& planes) {
    BillboardImage out;
    PILEUS_TRY(collectors_billboards(context, run, camera, colours, channels,
                                     planes.opaque_depth.data(), out));
    planes.transmittance.swap(out.transmittance);
    planes.half_depth.swap(out.half_depth);
    planes.colour.swap(out.colour);
    return Status::ok();
}

}  // namespace

Status collectors_billboards(const Context& context, const CollectorsRun& run,
                             const CameraParams& camera, const CollectorColours& colours,
                             int channels, const float* opaque_depth, BillboardImage& out) {
    const StageClock clock(context, "blend");
    const std::size_t n = run.prepared.collectors.size();
    Buffer<float> spheres;
    PILEUS_TRY(spheres.resize(5 * n, "billboards"));
    for (std::size_t i = 0; i < n; ++i) {
        const Collector& c = run.prepared.collectors[i];
        for (std::size_t a = 0; a < 3; ++a) spheres[a * n + i] = c.centre[a];
        spheres[3 * n + i] = c.billboard_radius;
        spheres[4 * n + i] = c.extinction * run.medium.sigma;
    }
    BillboardScene scene;
    scene.x = spheres.data();
    scene.y = scene.x + n;
    scene.z = scene.y + n;
    scene.radius = scene.z + n;
    scene.extinction = scene.radius + n;
    scene.colour = colours.colour.data();
    scene.count = std::uint32_t(n);
    scene.channels = channels;
    scene.opaque_depth = opaque_depth;
    scene.half_depth = run.scene->output.layer_depth;
    return composite_billboards(scene, camera, context.threads, context.kernels->blend_tile, out);
}

int collectors_batches(const CollectorsRun& run) {
    const std::uint64_t slots = collectors_slots(run);
    if (!run.scene->output.layer_error || slots < 2) return 0;
    // An animation's ring may hold more generations than the blender has planes for.
    return int(slots < kMostBatches ? slots : kMostBatches);
}

void collectors_size_display(const CollectorsRun& run, CollectorsSizes& sizes) {
    const OutputSettings& output = run.scene->output;
    sizes.width = std::uint64_t(run.scene->camera.resolution[0]);
    sizes.height = std::uint64_t(run.scene->camera.resolution[1]);
    sizes.planes = 3 * (1 + std::uint64_t(collectors_batches(run)));
    sizes.layers = 4 + (output.layer_cloud ? 3u : 0u) + (output.layer_depth ? 1u : 0u) +
                   (sizes.planes > 3 ? 3u : 0u);
    sizes.marched = is_marched(run);
    sizes.ground = run.lighting.ground;
    sizes.depth = output.layer_depth;
    if (!sizes.marched) return;
    const NodeGrid nodes =
        make_node_grid(run.medium.grid, run.medium.extent_m, source_spacing(run));
    sizes.source_nodes = source_nodes(nodes);
    if (shows_harmonics(run)) {
        const std::uint64_t sets = std::uint64_t(harmonic_sets(run.medium, run.lighting));
        sizes.harmonics = sets * std::uint64_t(run.deposit.bands * run.deposit.bands);
        sizes.numbers_by_node =
            bytes_of(node_count(nodes), sets * std::uint64_t(stored_harmonics(run.deposit.bands)));
    }
    if (run.lighting.sunlit && run.deposit.first_order == 2)
        sizes.shadow_nodes = node_count(shadow_grid(run));
}

ReconstructInput collectors_reconstruct_input(const CameraParams& camera, const Context& context,
                                              const CollectorsRun& run) {
    ReconstructInput in;
    in.medium = &run.medium;
    in.lighting = &run.lighting;
    in.photons = &run.photons;
    in.collectors = run.prepared.collectors.span();
    in.shares = run.prepared.shares.span();
    in.camera = camera;
    in.deposit = run.deposit;
    in.closure = run.camera_cells > 0                 ? Closure::kCamera
                 : run.scene->collectors.lobe_closure ? Closure::kLobe
                                                      : Closure::kSh;
    in.window = run.scene->collectors.window;
    in.batches = collectors_batches(run);
    in.constant = !is_marched(run);
    in.threads = context.threads;
    return in;
}

Status collectors_show(double orbit_deg, const Context& context, CollectorsRun& run, Image& image) {
    const Scene& scene = *run.scene;
    const CameraParams camera = make_camera(scene.camera, orbit_deg, run.medium.low_m);
    const ReconstructInput in = collectors_reconstruct_input(camera, context, run);
    const int channels = 3 * (1 + in.batches);
    Planes planes;
    Report& report = *context.report;
    CollectorColours colours;
    if (!shows_harmonics(run)) {
        const StageClock clock(context, "reconstruct");
        PILEUS_TRY(reconstruct(in, colours));
    }
    PILEUS_TRY(allocate_planes(camera.width, camera.height, channels, run.lighting.ground,
                               scene.output.layer_depth, planes));
    PILEUS_TRY(make_background(context, run, in, planes));
    PILEUS_TRY(shows_harmonics(run) ? show_harmonics(context, run, in, planes)
               : is_marched(run)
                   ? show_marched(context, run, camera, colours, channels, planes)
                   : show_billboards(context, run, camera, colours, channels, planes));
    report.counters.clear();
    std::uint64_t clamped = colours.clamped_negative;
    PILEUS_TRY(make_layers(planes, camera.width, camera.height, channels, scene.output, image,
                           report, clamped));
    report.counters.emplace_back("clamped_negative", clamped);
    report.executed = {{"depth_tests", planes.opaque_depth.size()},
                       {"depths_stored", planes.half_depth.size()},
                       {"batches", std::uint64_t(in.batches)},
                       {"parts_stored", run.medium.parts.size()}};
    set_image_camera(camera, run.medium.low_m, image);
    if (shows_harmonics(run)) return Status::ok();
    Digest digest;
    digest.floats(colours.colour.span());
    report.digests.emplace_back("colours", digest.hex());
    return Status::ok();
}

}  // namespace pileus
