// SPDX-License-Identifier: Apache-2.0
// How lit collectors become planes of pixels: the background, the march, the billboards.
// in: CollectorsRun, colours, the light to show -> out: Planes.
// docs/methods.md 3, each image frame, steps 4 and 5; repairs 3 and 4.
#include "src/methods/collectors/collectors_display.h"

#include "src/methods/collectors/billboards/billboard_spheres.h"
#include "src/methods/collectors/billboards/gl_billboards.h"
#include "src/methods/collectors/collectors_memory.h"
#include "src/methods/collectors/photons/source_grid.h"
#include "src/picture/background.h"
#include "src/picture/march_view.h"
#include "src/picture/nodes/solid_shadow.h"
#include "src/world/majorant/majorant.h"

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
    return make_medium_view(run.world->medium, run.majorants);
}

NodeGrid shadow_grid(const CollectorsRun& run) {
    float coarse = 0;
    for (float cell : run.world->medium.grid.cell_m) coarse = cell > coarse ? cell : coarse;
    return make_node_grid(run.world->medium.grid, run.world->medium.extent_m,
                          kShadowVoxels * double(coarse));
}

/// Optical depth towards the sun, once per position of the sun.
Status make_shadow(const Context& context, CollectorsRun& run) {
    if (run.shadow_ready || !run.lighting.sunlit || run.deposit.first_order != 2)
        return Status::ok();
    const StageClock clock(context, "shadow");
    run.shadow_nodes = shadow_grid(run);
    PILEUS_TRY(allocate(arrays::shadow(node_count(run.shadow_nodes), Stage::kShadow), run.shadow));
    ShadowParams k{};
    k.medium = view_of(run);
    k.nodes = run.shadow_nodes;
    for (std::size_t a = 0; a < 3; ++a) k.to_sun[a] = run.lighting.to_sun[a];
    PILEUS_TRY(run_rows(context, context.kernels->shadow_rows, k, ShadowBuffers{run.shadow.data()},
                        std::uint32_t(k.nodes.size[1] * k.nodes.size[2])));
    if (run.lighting.solids != nullptr)
        PILEUS_TRY(solid_visibility(context, *run.lighting.solids, run.shadow_nodes,
                                    run.lighting.to_sun, run.visibility));
    run.shadow_ready = true;
    return Status::ok();
}

/// Spacing of the source nodes: what the budget allows, at least the cells of a cell estimate.
double source_spacing(const CollectorsRun& run) {
    const auto& e = run.world->medium.extent_m;
    const double smallest = double(smallest_cell(run.world->medium.grid));
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
    options.periodic = run.world->medium.grid.periodic;
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
    b.parts = run.world->medium.parts.data();
    b.transmittance = planes.transmittance.data();
    b.half_depth = planes.half_depth.data();
    b.colour = target;
    b.visibility = run.visibility.data();
    PILEUS_TRY(
        run_rows(context, context.kernels->march_rows, k, b, std::uint32_t(k.camera.height)));
    return Status::ok();
}

/// What all marches of a picture share.
MarchParams march_params(const CollectorsRun& run, const ReconstructInput& lit) {
    const Lighting& light = *lit.lighting;
    MarchParams k{};
    k.medium = view_of(run);
    k.camera = lit.camera;
    k.media = run.world->medium.count;
    for (std::size_t c = 0; c < 3; ++c) {
        k.sun_travel[c] = -light.to_sun[c];
        k.constant[c] = float(light.constant[c]);
    }
    for (int i = 0; i < run.world->medium.count; ++i) {
        const Optics& optics = run.world->medium.optics[std::size_t(i)];
        k.phase[i] = optics.phase;
        for (std::size_t c = 0; c < 3 && run.deposit.first_order == 2; ++c)
            k.sun_source[i][c] = float(light.sun_irradiance[c] * double(optics.albedo[c]));
    }
    k.shadow = run.shadow_nodes;
    k.source =
        make_node_grid(run.world->medium.grid, run.world->medium.extent_m, source_spacing(run));
    k.channels = 3;
    k.cut = kCut;
    return k;
}

/// Without colours there is one dark node, so that the sun's first order is alone.
Status show_marched(const Context& context, CollectorsRun& run, const ReconstructInput& lit,
                    const CollectorColours& colours, int channels, Planes& planes) {
    PILEUS_TRY(make_shadow(context, run));
    MarchParams k = march_params(run, lit);
    k.channels = channels;
    Buffer<float> source;
    if (colours.colour.empty()) {
        k.source = NodeGrid{{1, 1, 1}, {0, 0, 0}};
        PILEUS_TRY(allocate(arrays::source_grid(std::uint64_t(channels), 1), source));
    } else {
        PILEUS_TRY(splat(context, run, colours.colour.span(), channels, k.source, source));
    }
    return march(context, run, source.data(), k, planes.colour.data(), planes);
}

/// Numbers of one harmonic of one set after the other become those of one node after the other.
Status gather_by_node(const Context& context, const HarmonicSource& lit, const MarchParams& k,
                      Span<const float> planes, Buffer<float>& by_node) {
    const std::size_t nodes = std::size_t(node_count(k.source)),
                      own = std::size_t(k.bands) * std::size_t(k.bands);
    const std::size_t stored = std::size_t(k.harmonics), sets = std::size_t(lit.sets);
    PILEUS_TRY(allocate_once(arrays::source_by_node(nodes * sets * stored), by_node));
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
    MarchParams k = march_params(run, in);
    const std::size_t pixels = std::size_t(k.camera.width) * std::size_t(k.camera.height);
    HarmonicSource lit;
    Buffer<float> source, by_node;
    Digest digest;
    for (int batch = -1; batch < in.batches; ++batch) {
        {
            const StageClock clock(context, "reconstruct");
            PILEUS_TRY(reconstruct_harmonics(in, batch, lit));
        }
        if (batch < 0 && context.digests) digest.floats(lit.values.span());
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
    // The picture's own digest, not those of its parts.
    if (in.lighting == &run.lighting && context.digests)
        context.report->digests.emplace_back("colours", digest.hex());
    return Status::ok();
}

Status show_billboards(const Context& context, const CollectorsRun& run,
                       const ReconstructInput& lit, const CollectorColours& colours, int channels,
                       Planes& planes) {
    // Lend the planes' memory: they are blended where they will be read.
    BillboardImage out;
    const auto exchange = [&] {
        planes.transmittance.swap(out.transmittance);
        planes.half_depth.swap(out.half_depth);
        planes.colour.swap(out.colour);
    };
    exchange();
    PILEUS_TRY(collectors_billboards(context, run, lit.camera, colours, channels,
                                     planes.opaque_depth.data(), out));
    exchange();
    return Status::ok();
}

/// Sky and ground of `lit`; the light scattered onto the ground is that of `batch`, 0: of all.
Status fill_background(const Context& context, const CollectorsRun& run,
                       const ReconstructInput& lit, int batch, Planes& planes) {
    const StageClock clock(context, "background");
    const CameraParams& camera = lit.camera;
    const Lighting& light = *lit.lighting;
    Buffer<float> map;
    PILEUS_TRY(reconstruct_ground(lit, run.ground_map, batch, map));
    BackgroundParams k{};
    k.medium = view_of(run);
    k.camera = camera;
    k.ground = light.ground ? 1 : 0;
    k.ground_z = float(light.ground_z);
    for (std::size_t c = 0; c < 3; ++c) {
        k.sky[c] = float(light.sky[c]);
        k.ground_diffuse[c] = float(light.ground_diffuse[c]);
        k.ground_sun[c] = float(light.ground_sun[c]);
        k.to_sun[c] = light.to_sun[c];
    }
    k.sky_map = light.map;
    k.map.size[0] = k.map.size[1] = run.ground_map.cells;
    k.map.size[2] = 1;
    for (int a = 0; a < 2; ++a) {
        k.map.per_metre[a] = run.ground_map.per_metre[a];
        k.map_origin[a] = run.ground_map.origin[a];
    }
    const BackgroundBuffers b{map.data(), planes.background.data(), planes.opaque_depth.data()};
    return show_background(context, light, k, b);
}

}  // namespace

Status collectors_background(const Context& context, const CollectorsRun& run,
                             const ReconstructInput& lit, Planes& planes) {
    return fill_background(context, run, lit, 0, planes);
}

Status collectors_ground_noise(const Context& context, const CollectorsRun& run,
                               const ReconstructInput& lit, Planes& planes) {
    if (lit.batches < 2 || run.ground_map.cells == 0) return Status::ok();
    // What is the same in every batch has no spread: sky, and the ground's light without the media.
    Lighting scattered = *lit.lighting;
    scattered.sky = scattered.ground_diffuse = scattered.ground_sun = {};
    scattered.sun_irradiance = {};
    scattered.map = SkyMapView{};
    ReconstructInput alone = lit;
    alone.lighting = &scattered;
    const std::size_t pixels = planes.transmittance.size();
    Planes part;
    PILEUS_TRY(allocate(arrays::batch_background(pixels), part.background));
    for (int b = 1; b <= lit.batches; ++b) {
        PILEUS_TRY(fill_background(context, run, alone, b, part));
        float* colour = planes.colour.data() + std::size_t(3 * b) * pixels;
        for (std::size_t i = 0; i < 3 * pixels; ++i)
            colour[i] += planes.transmittance[i % pixels] * part.background[i];
    }
    return Status::ok();
}

Status collectors_display(const Context& context, CollectorsRun& run, const ReconstructInput& lit,
                          const CollectorColours& colours, int channels, Planes& planes) {
    if (shows_harmonics(run) && !lit.first_order_alone)
        return show_harmonics(context, run, lit, planes);
    return is_marched(run) ? show_marched(context, run, lit, colours, channels, planes)
                           : show_billboards(context, run, lit, colours, channels, planes);
}

Status collectors_billboards(const Context& context, const CollectorsRun& run,
                             const CameraParams& camera, const CollectorColours& colours,
                             int channels, const float* opaque_depth, BillboardImage& out) {
    const StageClock clock(context, "blend");
    const std::size_t n = run.prepared.collectors.size();
    Buffer<float> spheres;
    PILEUS_TRY(allocate(arrays::billboard_numbers(n), spheres));
    for (std::size_t i = 0; i < n; ++i) {
        const Collector& c = run.prepared.collectors[i];
        for (std::size_t a = 0; a < 3; ++a) spheres[a * n + i] = c.centre[a];
        spheres[3 * n + i] = c.billboard_radius;
        spheres[4 * n + i] = c.extinction * run.world->medium.sigma;
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
    const Compositor by = run.scene->collectors.compositor;
    if (by == Compositor::kBuiltin)
        return composite_billboards(
            scene, camera, context.threads, context.kernels->blend_tile, out,
            context.kernels->device != nullptr ? kDeviceTiling : BillboardTiling{},
            context.kernels->device);
    GlBlender blender;
    PILEUS_TRY(open_gl_blender(by, blender));
    return blend_by_gl(blender, scene, camera, context.threads, out);
}

void collectors_size_display(const CollectorsRun& run, CollectorsSizes& sizes) {
    const OutputSettings& output = run.scene->output;
    sizes.width = std::uint64_t(run.scene->camera.resolution[0]);
    sizes.height = std::uint64_t(run.scene->camera.resolution[1]);
    sizes.planes = 3 * (1 + std::uint64_t(collectors_batches(run)));
    sizes.layers = 4 + extra_layers(output, sizes.planes > 3);
    sizes.marched = is_marched(run);
    sizes.ground = run.lighting.opaque();
    sizes.depth = output.layer_depth;
    const std::uint64_t parts = (output.layer_light ? 3u : 0u) + (output.layer_order ? 3u : 0u);
    sizes.extra_planes = parts + (output.layer_optical_depth ? 1u : 0u);
    sizes.parts = parts > 0;
    if (!sizes.marched) return;
    const NodeGrid nodes =
        make_node_grid(run.world->medium.grid, run.world->medium.extent_m, source_spacing(run));
    sizes.source_nodes = source_nodes(nodes);
    if (shows_harmonics(run)) {
        const std::uint64_t sets = std::uint64_t(harmonic_sets(run.deposit.channels, run.lighting));
        sizes.harmonics = sets * std::uint64_t(run.deposit.bands * run.deposit.bands);
        sizes.numbers_by_node =
            bytes_of(node_count(nodes), sets * std::uint64_t(stored_harmonics(run.deposit.bands)));
    }
    if (run.lighting.sunlit && run.deposit.first_order == 2)
        sizes.shadow_nodes = node_count(shadow_grid(run)) * (run.world->solids.meshes ? 2 : 1);
}

}  // namespace pileus
