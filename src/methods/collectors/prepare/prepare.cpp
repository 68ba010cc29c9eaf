// SPDX-License-Identifier: Apache-2.0
// See prepare.h.
#include "src/methods/collectors/prepare/prepare.h"

#include "src/base/random_streams.h"
#include "src/methods/collectors/prepare/leaves.h"
#include "src/methods/collectors/prepare/place_collectors.h"
#include "src/methods/collectors/prepare/shares.h"
#include "src/methods/collectors/prepare/tree.h"
#include "src/world/grid/grid.h"

namespace pileus {
namespace {

double diagonal_m(const Medium& medium) {
    double square = 0;
    for (double e : medium.extent_m) square += e * e;
    return __builtin_sqrt(square);
}

Status finish_leaves(const Medium& medium, const CollectorOptions& options,
                     Span<const Sample> samples, const Context& context, Prepared& out) {
    const StageClock clock(context, "collectors");
    const Span<const float> density = medium.volume.density.span();
    Buffer<LeafMoments> moments;
    PILEUS_TRY(allocate(arrays::leaf_moments(out.leaves.size()), moments));
    PILEUS_TRY(
        measure_leaves(density, medium.grid, context.threads, out.leaves.span(), moments.span()));
    // Only Elek's centroids ask for the leaf of a voxel.
    Buffer<std::int32_t>& of_voxel = out.collector_of_voxel;
    PILEUS_TRY(allocate(arrays::collector_of_voxel(medium.grid, Stage::kWrite), of_voxel));
    const auto label = [&](LeafLabel which) {
        fill_leaf_grid(out.leaves.span(), medium.grid, context.threads, which, of_voxel.span());
    };
    if (options.paper) label(LeafLabel::kLeaf);
    PILEUS_TRY(place_collectors(options, moments.span(), medium.grid, samples, of_voxel.span(),
                                context.threads, out.leaves.span(), out.collectors));
    label(LeafLabel::kCollector);
    if (medium.count == 1) return Status::ok();
    return measure_shares(medium, out.leaves.span(), out.collectors.span(), context.threads,
                          out.shares);
}

}  // namespace

Status prepare_sample_field(const Medium& medium, const CollectorSettings& settings,
                            const Context& context, Buffer<float>& field, FieldStats& stats) {
    const StageClock clock(context, "gradient");
    const Span<const float> density = medium.volume.density.span();
    PILEUS_TRY(allocate(arrays::gradient_field(medium.grid), field));
    return settings.placement.variance_field
               ? local_variance(density, medium.grid, settings.placement.variance_radius,
                                context.threads, field.span(), stats)
               : gradient_magnitude(density, medium.grid, context.threads, field.span(), stats);
}

Status prepare_sample_set(const Medium& medium, const CollectorSettings& settings,
                          std::int64_t seed, const Context& context, SampleSet& set) {
    const Span<const float> density = medium.volume.density.span();
    Buffer<float> field;
    FieldStats stats;
    PILEUS_TRY(prepare_sample_field(medium, settings, context, field, stats));
    const StageClock clock(context, "samples");
    SampleOptions options;
    options.count = std::uint32_t(settings.placement.samples);
    options.seed = std::uint64_t(seed);
    options.stream = kSampleStream;
    return settings.placement.rejection_sampler
               ? sample_rejection(field.span(), stats, density, medium.grid, options,
                                  context.threads, set)
               : sample_stratified(field.span(), stats, density, medium.grid, options,
                                   context.threads, set);
}

double leaf_share(const Medium& medium) {
    return medium.detail_m > 0 ? kLeafShare * (medium.detail_m / diagonal_m(medium)) : kLeafShare;
}

Status prepare_collectors(const Medium& medium, const CollectorSettings& settings,
                          std::int64_t seed, const Context& context, Prepared& out) {
    SampleSet set;
    PILEUS_TRY(prepare_sample_set(medium, settings, seed, context, set));
    out.samples = set.samples.size();
    out.rejected = set.given_up;
    const double share = leaf_share(medium), detail = share / kLeafShare;
    TreeOptions tree;
    tree.density_range = float(settings.placement.density_range) * medium.density_max;
    tree.influence_m = float(settings.placement.influence_radius * detail * diagonal_m(medium));
    const double per_m = max_extinction(medium);
    if (!settings.paper) {
        leaf_limit(medium.grid, share, per_m, tree.max_leaf_voxels);
        face_leaf_limit(medium.grid, per_m, settings.photons, tree.max_leaf_voxels,
                        tree.max_face_voxels);
    }
    for (int a = 0; a < 3 && !settings.paper; ++a) {
        const double edge = double(tree.max_leaf_voxels[a]) * double(medium.grid.cell_m[a]);
        out.cell_m = a == 0 || edge < out.cell_m ? edge : out.cell_m;
    }
    const std::uint64_t most = context.limits[LimitId::kLeaves];
    tree.max_leaves =
        most > 0 ? most
                 : expected_leaves(medium.grid, share, per_m, settings.photons, set.samples.size());
    if (context.report != nullptr) tree.where = context.report->scene;
    {
        const StageClock clock(context, "tree");
        PILEUS_TRY(build_tree(set.samples.span(), medium.volume.density.span(), medium.grid, tree,
                              context.threads, out.leaves));
    }
    return finish_leaves(medium, {settings.paper, float(settings.display.radius_factor)},
                         set.samples.span(), context, out);
}

Status prepare_cells(const Medium& medium, int edge, const Context& context, Prepared& out) {
    const Grid& g = medium.grid;
    int n[3];
    for (int a = 0; a < 3; ++a) n[a] = (g.size[a] + edge - 1) / edge;
    const std::uint64_t cells = std::uint64_t(n[0]) * std::uint64_t(n[1]) * std::uint64_t(n[2]);
    PILEUS_TRY(allocate(arrays::leaves(cells), out.leaves));
    std::size_t at = 0;
    for (int z = 0; z < n[2]; ++z)
        for (int y = 0; y < n[1]; ++y)
            for (int x = 0; x < n[0]; ++x) {
                Leaf& leaf = out.leaves[at++];
                const int cell[3] = {x, y, z};
                for (int a = 0; a < 3; ++a) {
                    leaf.lo[a] = cell[a] * edge;
                    const int hi = leaf.lo[a] + edge;
                    leaf.hi[a] = hi < g.size[a] ? hi : g.size[a];
                }
            }
    return finish_leaves(medium, {false, 1.35f}, {}, context, out);
}

}  // namespace pileus
