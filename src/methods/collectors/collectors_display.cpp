// SPDX-License-Identifier: Apache-2.0
// How lit collectors become planes of pixels: the background, the march, the billboards.
// in: CollectorsState, colours, the light to show -> out: Planes.
// docs/methods.md 3, each image frame, steps 4 and 5; repairs 3 and 4.
#include "src/methods/collectors/collectors_display.h"

#include "src/methods/collectors/billboards/billboard_spheres.h"
#include "src/methods/collectors/billboards/gl_billboards.h"
#include "src/methods/collectors/collectors_memory.h"
#include "src/methods/collectors/photons/source_grid.h"
#include "src/photons/lit_march.h"
#include "src/picture/march_view.h"
#include "src/run/on_device.h"

namespace pileus {
namespace {

constexpr float kSplatFactor = 1.2f;  // docs/methods.md 3, repair 4
constexpr double kPriorScatterings = 8;
constexpr std::uint64_t kNodeBudget = 1u << 19;      // nodes of the source grid, about
constexpr std::uint64_t kHarmonicBudget = 1u << 18;  // of one that holds harmonics

/// Nodes of the source: as many as the budget allows, at least the cells of a cell estimate.
NodeGrid source_grid_of(const FrameView& view, const CollectorsState& state) {
    const Medium& medium = view.world.medium;
    const double smallest = double(smallest_cell(medium.grid));
    if (state.camera_cells > 0)
        return make_node_grid(medium.grid, medium.extent_m, smallest * state.camera_cells);
    const double budget = double(shows_harmonics(view, state) ? kHarmonicBudget : kNodeBudget);
    return make_layered_grid(medium.grid, medium.extent_m, max_extinction(medium), 2 * smallest,
                             budget);
}

/// The prior weighs as much as the medium that eight scatterings happen in on average.
SplatOptions splat_options(const FrameView& view, const CollectorsState& state) {
    double mass = 0, scatterings = 0;
    for (const Collector& c : state.prepared.collectors.span()) mass += c.mass;
    // Those of the ring alone: a frame must not know how many frames came before it.
    for (const PhotonSlot& slot : state.ring.photons.slots) scatterings += double(slot.scatterings);
    SplatOptions options;
    options.radius_factor = kSplatFactor;
    options.periodic = view.world.medium.grid.periodic;
    options.medium = make_medium_view(view.world.medium, state.majorants);
    options.prior_mass = scatterings > 0 ? float(kPriorScatterings * mass / scatterings) : 0.0f;
    return options;
}

/// The colours on nodes, in state.source. Under a sky the media's constant light is not in them,
/// and photons may take some of it away: together there is no less than no light.
Status splat(const Context& context, Span<const float> colour, int numbers, const NodeGrid& nodes,
             const Lighting& light, const float* beside, const FrameView& view,
             CollectorsState& state) {
    const StageClock clock(context, "splat");
    SplatOptions options = splat_options(view, state);
    options.beside = beside;
    options.guided = state.settings.display.guided_nodes;
    options.sun_depth = sun_depths_at(state.shadow, nodes);
    // Light that is scattered forward on its way has not faded.
    options.sun_fades = 1 - mean_cosine(view.world.medium);
    options.bounded = shows_harmonics(view, state) ? 0 : 3;
    for (std::size_t c = 0; c < 3; ++c) options.least[c] = least_light(view, state, light, c);
    return splat_colours(state.prepared.collectors.span(), colour, numbers, nodes, options,
                         context.threads, state.source);
}

/// Numbers on all of `nodes`, in a buffer of their own.
SplatOptions near_options(const FrameView& view, const CollectorsState& state) {
    SplatOptions options = splat_options(view, state);
    options.medium = MediumView{};
    return options;
}

/// The collectors whose light near nodes may hold, moved to where these begin.
void choose_near(Span<const Collector> all, const MarchParams& k, Buffer<Collector>& moved,
                 std::vector<std::uint32_t>& which) {
    for (std::size_t i = 0; i < all.size; ++i) {
        Collector c = all[i];
        const SplatMetric metric = splat_metric(k.source);
        const float ball = ball_radius(c, k.source, kSplatFactor);
        bool reaches = true;
        for (std::size_t a = 0; a < 3; ++a) {
            const float spacing = 1.0f / k.source.per_metre[a], radius = ball / metric.axis[a];
            c.centre[a] -= float(k.near.first[a]) * spacing;
            reaches = reaches && c.centre[a] + radius > 0 &&
                      c.centre[a] - radius < float(k.near.size[a]) * spacing;
        }
        if (!reaches) continue;
        moved[which.size()] = c;
        which.push_back(std::uint32_t(i));
    }
}

/// What the nodes around the camera scatter in all directions, the whole picture's first and then
/// that of each batch; nothing where the camera is too far away.
Status light_near(const Context& context, const FrameView& view, CollectorsState& state,
                  const ReconstructInput& lit, MarchParams& k, NodeLight& light) {
    if (!shows_near(view, state)) return Status::ok();
    k.near = near_nodes(k.source, lit.camera.origin);
    if (k.near.size[0] == 0) return Status::ok();
    const StageClock clock(context, "splat");
    const Span<const Collector> all = state.prepared.collectors.span();
    Buffer<Collector> moved;
    PILEUS_TRY(allocate(arrays::near_collectors(all.size), moved));
    std::vector<std::uint32_t> which;
    choose_near(all, k, moved, which);
    if (which.empty()) {
        k.near = NearNodes{};
        return Status::ok();
    }
    moved.truncate(which.size());
    NodeGrid nodes = k.source;
    for (int a = 0; a < 3; ++a) nodes.size[a] = k.near.size[a];
    const SplatOptions options = near_options(view, state);
    HarmonicSource harmonics;
    Buffer<float> splatted;
    for (int part = 0; part <= lit.batches; ++part) {
        PILEUS_TRY(reconstruct_harmonics(lit, part - 1, {which.data(), which.size()}, harmonics));
        set_harmonic_sets(lit, harmonics.sets, harmonics.colour, k);
        PILEUS_TRY(splat_colours(moved.span(), harmonics.values.span(),
                                 harmonics.sets * harmonics.numbers, nodes, options,
                                 context.threads, splatted));
        const std::size_t numbers =
            std::size_t(node_count(nodes)) * std::size_t(k.sets) * std::size_t(k.harmonics);
        const std::size_t parts = 1 + std::size_t(lit.batches);
        PILEUS_TRY(allocate_once(
            arrays::near_nodes(parts * std::uint64_t(k.sets * k.harmonics), node_count(nodes)),
            state.picture.near_light));
        gather_by_node(context, k, node_count(nodes), splatted.span(),
                       state.picture.near_light.span().part(std::size_t(part) * numbers, numbers));
    }
    light.near = state.picture.near_light.data();
    return Status::ok();
}

/// Whether this is the picture itself and not that of a part of its light.
bool is_whole(const CollectorsState& state, const ReconstructInput& lit) {
    return lit.lighting == &state.lights.lighting && !lit.first_order_alone;
}

/// Without colours there is one dark node, so that the sun's first order is alone.
Status show_marched(const Context& context, const FrameView& view, CollectorsState& state,
                    const ReconstructInput& lit, const CollectorColours& colours, int channels,
                    Planes& planes) {
    const NearNodesOfPicture near(state);
    PILEUS_TRY(make_sun_shadow(context, view, state));
    MarchParams k = lit_march_params(view, state, lit, source_grid_of(view, state));
    k.channels = channels;
    NodeLight light;
    Buffer<float> by_channel;
    if (colours.colour.empty()) {
        k.source = NodeGrid{{1, 1, 1}, {0, 0, 0}};
        PILEUS_TRY(allocate(arrays::source_planes(std::uint64_t(channels), 1), by_channel));
        light.planes = by_channel.data();
    } else {
        PILEUS_TRY(light_near(context, view, state, lit, k, light));
        const float* depths = channels == 3 ? sun_depths_at(state.shadow, k.source) : nullptr;
        PILEUS_TRY(splat(context, colours.colour.span(), channels, k.source, *lit.lighting, depths,
                         view, state));
        if (reads_quads(context, channels, k.source)) {
            light.quads = state.source.data();
            light.depths = depths != nullptr;
        } else {
            const StageClock clock(context, "splat");
            PILEUS_TRY(planes_of_nodes(state.source.span(), channels, k.source, context.threads,
                                       by_channel));
            light.planes = by_channel.data();
        }
    }
    if (is_whole(state, lit)) return march_thinned(context, view, light, k, state, planes);
    return march_lit(context, view, state, light, k, planes.colour.data(), planes);
}

/// A periodic medium shows each collector from many directions at once: the nodes hold harmonics.
/// One march for the picture and one for each batch.
Status show_harmonics(const Context& context, const FrameView& view, CollectorsState& state,
                      const ReconstructInput& in, Planes& planes) {
    PILEUS_TRY(make_sun_shadow(context, view, state));
    MarchParams k = lit_march_params(view, state, in, source_grid_of(view, state));
    const std::size_t pixels = std::size_t(k.camera.width) * std::size_t(k.camera.height);
    HarmonicSource lit;
    Buffer<float> by_node;
    for (int batch = -1; batch < in.batches; ++batch) {
        {
            const StageClock clock(context, "reconstruct");
            PILEUS_TRY(reconstruct_harmonics(in, batch, {}, lit));
        }
        // The picture's own digest, not those of its parts.
        if (batch < 0 && is_whole(state, in)) note_colours(context, lit.values.span(), state);
        set_harmonic_sets(in, lit.sets, lit.colour, k);
        float* target = planes.colour.data() + 3 * std::size_t(batch + 1) * pixels;
        PILEUS_TRY(splat(context, lit.values.span(), lit.sets * lit.numbers, k.source, *in.lighting,
                         nullptr, view, state));
        PILEUS_TRY(allocate_once(
            arrays::source_by_node(node_count(k.source) * std::uint64_t(k.sets * k.harmonics)),
            by_node));
        gather_by_node(context, k, node_count(k.source), state.source.span(), by_node.span());
        const NodeLight light{by_node.data()};
        PILEUS_TRY(batch < 0 && is_whole(state, in)
                       ? march_thinned(context, view, light, k, state, planes)
                       : march_lit(context, view, state, light, k, target, planes));
    }
    return Status::ok();
}

Status show_billboards(const Context& context, const FrameView& view, const CollectorsState& state,
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
    const Status status = collectors_billboards(context, view, state, lit.camera, colours, channels,
                                                planes.opaque_depth.data(), out);
    exchange();
    return status;
}

}  // namespace

Status collectors_display(const Context& context, const FrameView& view, CollectorsState& state,
                          const ReconstructInput& lit, const CollectorColours& colours,
                          int channels, Planes& planes) {
    if (!is_marched(state))
        return show_billboards(context, view, state, lit, colours, channels, planes);
    PILEUS_TRY(shows_harmonics(view, state) && !lit.first_order_alone
                   ? show_harmonics(context, view, state, lit, planes)
                   : show_marched(context, view, state, lit, colours, channels, planes));
    return add_lit_lamps(context, view, state, lit, planes);
}

Status collectors_billboards(const Context& context, const FrameView& view,
                             const CollectorsState& state, const CameraParams& camera,
                             const CollectorColours& colours, int channels,
                             const float* opaque_depth, BillboardImage& out) {
    const StageClock clock(context, "blend");
    const std::size_t n = state.prepared.collectors.size();
    Buffer<float> spheres;
    PILEUS_TRY(allocate(arrays::billboard_numbers(n), spheres));
    for (std::size_t i = 0; i < n; ++i) {
        const Collector& c = state.prepared.collectors[i];
        for (std::size_t a = 0; a < 3; ++a) spheres[a * n + i] = c.centre[a];
        spheres[3 * n + i] = c.billboard_radius;
        spheres[4 * n + i] = c.extinction * view.world.medium.sigma;
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
    scene.half_depth = view.wants_depth();
    const Compositor by = state.settings.display.compositor;
    if (by == Compositor::kBuiltin)
        return composite_billboards(
            scene, camera, context.threads, context.kernels->blend_tile, out,
            on_device(context.kernels->device) ? kDeviceTiling : BillboardTiling{},
            context.kernels->device);
    GlBlender blender;
    PILEUS_TRY(open_gl_blender(by, blender));
    return blend_by_gl(blender, scene, camera, context.threads, out);
}

void collectors_size_display(const FrameView& view, const CollectorsState& state,
                             const Context& context, CollectorsSizes& sizes) {
    const OutputSettings& output = view.scene.output;
    sizes.picture.width = std::uint64_t(view.scene.camera.resolution[0]);
    sizes.picture.height = std::uint64_t(view.scene.camera.resolution[1]);
    sizes.picture.planes = 3 * (1 + std::uint64_t(photon_batches(state)));
    sizes.picture.layers = 4 + extra_layers(output, view.depths, sizes.picture.planes > 3);
    sizes.picture.marched = is_marched(state);
    sizes.picture.ground = state.lights.lighting.opaque();
    sizes.picture.depth = view.wants_depth();
    const std::uint64_t parts = (output.layer_light ? 3u : 0u) + (output.layer_order ? 3u : 0u);
    sizes.picture.extra_planes = parts + whole_ray_planes(output);
    sizes.picture.parts = parts > 0;
    if (!sizes.picture.marched) return;
    const NodeGrid nodes = source_grid_of(view, state);
    sizes.nodes.source_nodes = source_nodes(nodes);
    sizes.nodes.guided_nodes = state.settings.display.guided_nodes ? node_count(nodes) : 0;
    // Without scattered light there is one dark node.
    sizes.nodes.planes_by_channel = sizes.picture.planes;
    sizes.nodes.fine_nodes =
        reads_quads(context, int(sizes.picture.planes), nodes) ? 1 : node_count(nodes);
    const std::uint64_t numbers =
        std::uint64_t(state.lights.deposit.bands) * std::uint64_t(state.lights.deposit.bands) +
        std::uint64_t(axis_numbers(state.lights.deposit));
    const std::uint64_t stored = std::uint64_t(stored_harmonics(state.lights.deposit));
    const std::uint64_t sets =
        std::uint64_t(harmonic_sets(state.lights.deposit.channels, state.lights.lighting));
    if (shows_harmonics(view, state)) {
        sizes.nodes.harmonics = sets * numbers;
        sizes.nodes.numbers_by_node = bytes_of(node_count(nodes), sets * stored);
    }
    if (shows_near(view, state)) {
        sizes.nodes.near_nodes = near_nodes_of(context, view, nodes);
        sizes.nodes.near_levels = 2 * sizes.nodes.near_nodes + 64;
        sizes.nodes.near_harmonics = sets * numbers;
        sizes.nodes.near_stored = sets * stored;
    }
    if (state.lights.lighting.sunlit && state.lights.deposit.first_order == 2)
        sizes.nodes.shadow_nodes = sun_shadow_numbers(view);
    sizes.nodes.beam_sets = beam_sets(view, state);
    sizes.nodes.lamp_depths = lamp_numbers(view.world.medium, state.lights.lighting);
}

}  // namespace pileus
