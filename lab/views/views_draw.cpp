// SPDX-License-Identifier: Apache-2.0
// Draws the views: what each puts on the canvas and in which colours.
// in: a prepared view, a camera -> out: an image of R G B A.
// docs/how-it-works.md; Elek 2011, figures 5.1 (gradient), 5.2 (samples), 5.5 (tree), 5.6 (peak
// densities per leaf), 5.7 (collectors and billboards).
#include "lab/views/views_draw.h"

#include <algorithm>

#include "kernels_cpu/core/math.h"
#include "lab/views/colours.h"
#include "lab/views/show_boxes.h"
#include "src/base/digest.h"
#include "src/base/powers.h"
#include "src/methods/collectors/prepare/tree.h"
#include "src/world/camera/view.h"

namespace pileus {
namespace {

const Float3 kNight{0.006f, 0.008f, 0.012f};  // behind everything
const Float3 kDarkSky{0.0015f, 0.002f, 0.003f};
constexpr float kVeilDepth = 3.0f;    // optical depth of a veil across the height of the box
constexpr float kFaintEdge = 0.012f;  // of leaves that the middle plane does not cut
constexpr float kBoxSolidity = 4;     // leaves as boxes, times the true extinction

/// A field as heat: on the middle plane, or the largest value on each ray.
Status draw_field(Span<const float> field, float full, bool slice, Drawing& d) {
    const Grid& grid = d.world().medium.grid;
    if (slice) {
        PILEUS_TRY(look_at_plane(field, grid, d.camera, d.context.threads, d.value));
    } else {
        FieldView view;
        PILEUS_TRY(look_through(field, grid, d.camera, d.context.threads, view));
        d.value.swap(view.largest);
    }
    paint_heat(d.value.span(), full, d.context.threads, d.canvas);
    return Status::ok();
}

Status draw_samples(Drawing& d) {
    PILEUS_TRY(draw_veil(d));
    const Grid& grid = d.world().medium.grid;
    Buffer<Disc> discs;
    PILEUS_TRY(discs.resize(d.of.samples().samples.size(), "discs"));
    std::size_t count = 0;
    double near = 3e38, far = -3e38;
    for (const Sample& s : d.of.samples().samples.span()) {
        double at[3];
        for (int a = 0; a < 3; ++a) at[a] = double(s.x[a]) * double(grid.cell_m[a]);
        const Projected p = project_point(d.camera, at);
        if (!p.visible) continue;
        near = p.depth < near ? p.depth : near;
        far = p.depth > far ? p.depth : far;
        discs[count++] = {p.x, p.y, p.depth, d.pixels(1.6), 0.85f, {}, false};
    }
    const Span<Disc> drawn{discs.data(), count};
    // Near is bright, so that the front stands out.
    for (Disc& disc : drawn)
        disc.colour = map_colour(ColourMap::kSize,
                                 far > near ? float((far - disc.depth) / (far - near)) : 1.0f);
    sort_by_depth(drawn);
    draw_discs(drawn, d.context.threads, d.canvas);
    d.counters.emplace_back("samples_drawn", count);
    return Status::ok();
}

struct TreeLines {
    Buffer<Line> edges, section;
    std::size_t edge_count = 0, section_count = 0, cut = 0, voxels = 0;
};

void add_leaf(const Drawing& d, const Leaf& leaf, const MiddlePlane& plane, double largest,
              TreeLines& lines) {
    const Box box = box_of(leaf, d.world().medium.grid);
    double volume = 1;
    std::size_t inside = 1;
    for (int a = 0; a < 3; ++a) {
        volume *= box.high[a] - box.low[a];
        inside *= std::size_t(leaf.hi[a] - leaf.lo[a]);
    }
    lines.voxels += inside;
    const bool filled = leaf.collector >= 0;
    const float small = 1.0f - float(cube_root(volume) / largest);
    Line look{};
    look.colour = filled ? map_colour(ColourMap::kSize, small) : kVeil;
    look.width = d.pixels(0.8);
    look.alpha = kFaintEdge;
    const auto add = [&](Buffer<Line>& to, std::size_t& count) {
        return [&](const double(&a)[3], const double(&b)[3]) {
            Line line = look;
            if (project_line(d.camera, a, b, line)) to[count++] = line;
        };
    };
    if (filled) for_edges(box, add(lines.edges, lines.edge_count));
    look.width = d.pixels(filled ? 1.3 : 1.0);
    look.alpha = filled ? 0.95f : 0.5f;
    const std::size_t before = lines.section_count;
    for_section(box, plane, add(lines.section, lines.section_count));
    lines.cut += lines.section_count > before ? 1 : 0;
}

Status draw_tree(Drawing& d) {
    PILEUS_TRY(draw_veil(d));
    const Span<const Leaf> leaves = d.state().prepared.leaves.span();
    TreeLines lines;
    PILEUS_TRY(lines.edges.resize(std::uint64_t(leaves.size) * 12, "edges of leaves"));
    PILEUS_TRY(lines.section.resize(std::uint64_t(leaves.size) * 6, "cuts of leaves"));
    double diagonal = 0;
    for (double e : d.world().medium.extent_m) diagonal += e * e;
    const double largest = __builtin_sqrt(diagonal) * kLeafShare;
    const MiddlePlane plane = middle_plane(d.world().medium.grid, d.camera);
    for (const Leaf& leaf : leaves) add_leaf(d, leaf, plane, largest, lines);
    // Empty leaves first, then farthest first.
    const Span<Line> edges{lines.edges.data(), lines.edge_count};
    const Span<Line> section{lines.section.data(), lines.section_count};
    std::stable_partition(section.begin(), section.end(),
                          [](const Line& l) { return l.alpha < 0.9f; });
    sort_by_depth(edges);
    draw_lines(edges, d.context.threads, d.canvas);
    draw_lines(section, d.context.threads, d.canvas);
    d.counters.emplace_back("leaves_drawn", leaves.size);
    d.counters.emplace_back("leaves_cut", lines.cut);
    d.counters.emplace_back("voxels_in_leaves", lines.voxels);
    return Status::ok();
}

Status draw_leaf_density(Drawing& d) {
    const Prepared& p = d.state().prepared;
    LeafBoxes boxes;
    boxes.leaves = p.leaves.span();
    boxes.collectors = p.collectors.span();
    boxes.collector_of_voxel = p.collector_of_voxel.span();
    boxes.sigma = kBoxSolidity * d.world().medium.sigma;
    boxes.full = d.world().medium.density_max;
    paint_leaf_boxes(boxes, d.world().medium.grid, d.camera, d.context.threads, d.canvas);
    d.counters.emplace_back("leaves_drawn", p.collectors.size());
    return Status::ok();
}

/// Balls behind the middle plane: where the front half is taken away, their sizes show.
Status draw_collectors(Drawing& d) {
    const Span<const Collector> collectors = d.state().prepared.collectors.span();
    const MiddlePlane plane = middle_plane(d.world().medium.grid, d.camera);
    Buffer<Disc> discs;
    PILEUS_TRY(discs.resize(collectors.size, "discs"));
    std::size_t count = 0;
    for (std::size_t i = 0; i < collectors.size; ++i) {
        const Collector& c = collectors[i];
        const double at[3] = {double(c.centre[0]), double(c.centre[1]), double(c.centre[2])};
        double height = -plane.offset;
        for (int a = 0; a < 3; ++a) height += plane.normal[a] * at[a];
        const Projected p = project_point(d.camera, at);
        if (!p.visible || height < 0) continue;
        const float radius = float(double(c.radius) * p.scale);
        discs[count++] = {p.x, p.y, p.depth, radius, 1.0f, name_colour(std::uint32_t(i)), true};
    }
    const Span<Disc> drawn{discs.data(), count};
    sort_by_depth(drawn);
    draw_discs(drawn, d.context.threads, d.canvas);
    d.counters.emplace_back("collectors", collectors.size);
    d.counters.emplace_back("collectors_drawn", count);
    return Status::ok();
}

Status draw_illumination(Drawing& d, Report& report) {
    const Span<const Collector> collectors = d.state().prepared.collectors.span();
    CollectorColours colours;
    PILEUS_TRY(reconstruct(collectors_reconstruct_input(d.context, d.view, d.state()), colours));
    Digest digest;
    digest.floats(colours.colour.span());
    report.digests.emplace_back("colours", digest.hex());
    Buffer<Disc> discs;
    PILEUS_TRY(discs.resize(collectors.size, "discs"));
    std::size_t count = 0;
    for (std::size_t i = 0; i < collectors.size; ++i) {
        const Collector& c = collectors[i];
        const double at[3] = {double(c.centre[0]), double(c.centre[1]), double(c.centre[2])};
        const Projected p = project_point(d.camera, at);
        if (!p.visible) continue;
        // A disc hides what its leaf would hide along its diameter.
        const double r = double(c.radius);
        const double mean = c.mass / (4.0 / 3.0 * double(kPi) * r * r * r);
        const float alpha = one_minus_exp(float(2.0 * r * mean * double(d.world().medium.sigma)));
        Disc& disc = discs[count++];
        disc = {p.x, p.y, p.depth, float(r * p.scale), alpha, {}, false};
        for (std::size_t k = 0; k < 3; ++k)
            disc.colour[k] = colours.colour[k * collectors.size + i];
    }
    const Span<Disc> drawn{discs.data(), count};
    sort_by_depth(drawn);
    draw_discs(drawn, d.context.threads, d.canvas);
    d.counters.emplace_back("collectors_drawn", count);
    d.counters.emplace_back("clamped_negative", colours.clamped_negative);
    return Status::ok();
}

Status add_channel(const char* name, std::size_t pixels, Image& image) {
    image.channels.emplace_back();
    image.channels.back().name = name;
    return image.channels.back().pixels.resize(pixels, name);
}

Status make_image(const Canvas& canvas, Image& image) {
    image.width = canvas.width;
    image.height = canvas.height;
    const std::size_t pixels = canvas.rgb.size() / 3;
    const char* const names[4] = {"R", "G", "B", "A"};
    for (std::size_t c = 0; c < 4; ++c) {
        PILEUS_TRY(add_channel(names[c], pixels, image));
        Buffer<float>& plane = image.channels.back().pixels;
        for (std::size_t i = 0; i < pixels; ++i) plane[i] = c < 3 ? canvas.rgb[3 * i + c] : 1.0f;
    }
    return Status::ok();
}

}  // namespace

/// The cloud as a faint X-ray, to see where the marks are.
Status draw_veil(Drawing& d) {
    const Medium& m = d.world().medium;
    FieldView view;
    PILEUS_TRY(look_through(m.volume.density.span(), m.grid, d.camera, d.context.threads, view));
    const double across = m.extent_m[2] * double(m.density_max);
    const float per_unit = across > 0 ? float(double(kVeilDepth) / across) : 0.0f;
    paint_veil(view.integral.span(), per_unit, kVeil, d.context.threads, d.canvas);
    return Status::ok();
}

Status draw_view(const Context& context, const FrameView& view, const ViewMethod& of,
                 Image& image) {
    const Medium& medium = view.world.medium;
    const View what = of.what();
    const CameraParams& camera = view.camera;
    Drawing d{context, view, of, camera, {}, {}, {}};
    PILEUS_TRY(make_canvas(camera.width, camera.height, view_is_light(what) ? kDarkSky : kNight,
                           d.canvas));
    Report& report = *context.report;
    {
        const StageClock clock(context, "draw");
        switch (what) {
            case View::kDensitySlice:
                PILEUS_TRY(draw_field(medium.volume.density.span(), medium.density_max, true, d));
                break;
            case View::kGradientSlice:
            case View::kGradient:
                PILEUS_TRY(
                    draw_field(of.field().span(), of.stats().max, what == View::kGradientSlice, d));
                break;
            case View::kSamples:
                PILEUS_TRY(draw_samples(d));
                break;
            case View::kTree:
                PILEUS_TRY(draw_tree(d));
                break;
            case View::kLeafDensity:
                PILEUS_TRY(draw_leaf_density(d));
                break;
            case View::kCollectors:
                PILEUS_TRY(draw_collectors(d));
                break;
            case View::kPhotons:
                PILEUS_TRY(draw_photons(d));
                break;
            case View::kIllumination:
                PILEUS_TRY(draw_illumination(d, report));
                break;
        }
    }
    report.counters = d.counters;
    PILEUS_TRY(make_image(d.canvas, image));
    if (!d.value.empty()) {
        PILEUS_TRY(add_channel("value", d.value.size(), image));
        image.channels.back().pixels.swap(d.value);
    }
    image.display_colours = !view_is_light(what);
    set_image_camera(camera, medium.low_m, image);
    return Status::ok();
}

}  // namespace pileus
