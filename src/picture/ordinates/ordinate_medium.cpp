// SPDX-License-Identifier: Apache-2.0
// See ordinate_medium.h.
#include "src/picture/ordinates/ordinate_medium.h"

#include <algorithm>

#include "kernels_cpu/media/detail.h"
#include "kernels_cpu/raymarch/raymarch_field.h"
#include "platform/threads.h"
#include "src/picture/march_view.h"
#include "src/picture/nodes/solid_shadow.h"
#include "src/run/device_launch.h"

namespace pileus {
namespace {

float density_at(const MediumView& view, const Vec<float>& p) {
    if (view.constant != 0) return grid_density<true>(view, p);
    const float density = grid_density<false>(view, p);
    return view.detail != nullptr ? with_detail(*view.detail, p, density) : density;
}

/// The grid of one of several media, from the second on.
const float* part_grid(const Medium& medium, int i) {
    return medium.parts.data() + std::size_t(i - 1) * std::size_t(voxel_count(medium.grid));
}

/// Parts of media 1, 2 ... are there, of a whole: makes them shares, and the first's what is left.
/// Where nothing is, they are those of `empty`, or the first medium's alone.
void share_out(int media, const float* empty, std::size_t count, std::size_t node, float whole,
               float* parts) {
    float left = 1;
    for (int i = 1; i < media; ++i) {
        float& part = parts[std::size_t(i) * count + node];
        if (!(whole > 0))
            part = empty != nullptr ? empty[std::size_t(i) * count + node] : 0;
        else
            part = std::max(std::min(part / whole, left), 0.0f);
        left -= part;
    }
    parts[node] = left;
}

Status sample_parts(const Context& context, const Medium& medium, const Majorants& majorants,
                    const NodeSamples& samples, OrdinateNodes& out) {
    if (out.media == 1) return Status::ok();
    const std::size_t count = out.density.size();
    PILEUS_TRY(allocate(arrays::ordinate_parts(count, out.media), out.parts));
    PILEUS_TRY(allocate(arrays::ordinate_parts(count, out.media), out.sunward));
    const MediumView view = make_medium_view(medium, majorants);
    parallel_each(context.threads, count, [&](std::size_t node) {
        for (int i = 1; i < out.media; ++i) {
            MediumView own = view;
            own.density = part_grid(medium, i);
            float sum = 0;
            each_sample(out.grid, samples, node,
                        [&](std::size_t s) { sum += density_at(own, sample_place(samples, s)); });
            out.parts[std::size_t(i) * count + node] = sum * samples.share;
        }
        share_out(out.media, nullptr, count, node, out.density[node], out.parts.data());
    });
    return Status::ok();
}

/// Which media the depths towards the sun are of.
Status part_sun(const Context& context, const ShadowParams& of_all, const Medium& medium,
                OrdinateNodes& nodes) {
    if (nodes.media == 1) return Status::ok();
    const std::size_t count = nodes.density.size();
    ShadowParams k = of_all;
    k.nodes = nodes.grid;
    const auto rows = std::uint32_t(nodes.grid.size[1] * nodes.grid.size[2]);
    for (int i = 0; i < nodes.media; ++i) {
        k.medium.density = i == 0 ? of_all.medium.density : part_grid(medium, i);
        PILEUS_TRY(run_rows(context, context.kernels->shadow_rows, k,
                            ShadowBuffers{nodes.sunward.data() + std::size_t(i) * count}, rows));
    }
    parallel_each(context.threads, count, [&](std::size_t node) {
        share_out(nodes.media, nodes.parts.data(), count, node, nodes.sunward[node],
                  nodes.sunward.data());
    });
    return Status::ok();
}

}  // namespace

void set_mean_rest(const OrdinateNodes& nodes, float (&out)[3]) {
    for (int c = 0; c < 3; ++c) {
        double rest = 0, mass = 0;
        for (std::size_t i = 0; i < nodes.density.size(); ++i) {
            rest += double(nodes.density[i] * ordinate_rest(nodes, nodes.parts, c, i));
            mass += double(nodes.density[i]);
        }
        out[c] = mass > 0 ? float(rest / mass) : 1.0f;
    }
}

std::array<int, 3> samples_within(const NodeGrid& grid, const Medium& medium) {
    std::array<int, 3> out{};
    for (int a = 0; a < 3; ++a) {
        const double voxels = 1 / (double(grid.per_metre[a]) * double(medium.grid.cell_m[a]));
        const int needed = int(0.5 * voxels + 0.999);
        out[std::size_t(a)] =
            voxels <= 1.01 ? 1 : std::min(std::max(needed, 2), kMaxOrdinateSamples);
    }
    return out;
}

NodeSamples node_samples(const NodeGrid& grid, const std::array<int, 3>& within) {
    NodeSamples out;
    out.within = within;
    out.fine = grid;
    for (std::size_t a = 0; a < 3; ++a) {
        out.fine.size[a] *= out.within[a];
        out.fine.per_metre[a] *= float(out.within[a]);
    }
    out.share = 1.0f / float(out.within[0] * out.within[1] * out.within[2]);
    return out;
}

namespace {

/// The mean over what it is at the middle.
float mean_in_sample(const SampleWay& way, float per_metre, float depth) {
    // At most the way through the middle of the sample's part.
    const float half = 0.5f * per_metre / way.most;
    if (!(half > 0.01f)) return 1;
    // sinh(x) / x, of which e^-tau at the middle is the mean; not beyond the near face.
    const float x = std::min(half, std::min(20.0f, std::max(depth, 0.01f)));
    return 0.5f * (exp_(x) - exp_(-x)) / x;
}

/// The largest mean: more light than enters does not end there.
float max_in_sample(const SampleWay& way, float per_metre) {
    // Volume over what is seen of the part by the light: its mean way through.
    const float depth = per_metre / way.across;
    return depth > 1e-3f ? one_minus_exp(depth) / depth : 1.0f;
}

}  // namespace

SampleWay::SampleWay(const NodeSamples& samples, const float (&way)[3]) {
    for (std::size_t a = 0; a < 3; ++a) {
        const float per_sample = (way[a] < 0 ? -way[a] : way[a]) * samples.fine.per_metre[a];
        most = std::max(most, per_sample);
        across += per_sample;
    }
}

float light_in_sample(const SampleWay& way, float per_metre, float depth) {
    return std::min(exp_(-depth) * mean_in_sample(way, per_metre, depth),
                    max_in_sample(way, per_metre));
}

NodeGrid ordinate_samples(const NodeGrid& grid, const Medium& medium) {
    return node_samples(grid, samples_within(grid, medium)).fine;
}

void average_samples(const Context& context, const Buffer<float>& from, OrdinateNodes& nodes) {
    const NodeSamples samples = node_samples(nodes.grid, nodes.within);
    parallel_each(context.threads, nodes.density.size(), [&](std::size_t i) {
        float sum = 0;
        each_sample(nodes.grid, samples, i, [&](std::size_t s) { sum += from[s]; });
        nodes.density[i] = sum * samples.share;
    });
}

namespace {

std::uint64_t samples_held(const NodeSamples& samples, std::uint64_t filled) {
    std::uint64_t out = filled;
    for (const int within : samples.within) out *= std::uint64_t(within);
    return out;
}

}  // namespace

namespace {

/// Nodes within closed solids hold no medium.
void empty_within(const Context& context, const Solids& solids, OrdinateNodes& nodes) {
    parallel_each(context.threads, nodes.density.size(), [&](std::size_t i) {
        const NodePlace p = node_place(nodes.grid, i);
        float at[3];
        for (std::size_t a = 0; a < 3; ++a) at[a] = (float(p[a]) + 0.5f) / nodes.grid.per_metre[a];
        if (nodes.density[i] > 0 && is_within_solid(solids, at)) nodes.density[i] = 0;
    });
}

}  // namespace

Status sample_ordinates(const Context& context, const Medium& medium, const Majorants& majorants,
                        const Solids* solids, OrdinateNodes& out) {
    out.within = samples_within(out.grid, medium);
    const NodeSamples samples = node_samples(out.grid, out.within);
    Buffer<float> all;
    PILEUS_TRY(allocate(arrays::ordinate_all_densities(node_count(samples.fine)), all));
    PILEUS_TRY(allocate(arrays::ordinate_nodes(node_count(out.grid), Stage::kWrite), out.density));
    const MediumView view = make_medium_view(medium, majorants);
    parallel_each(context.threads, all.size(),
                  [&](std::size_t i) { all[i] = density_at(view, sample_place(samples, i)); });
    average_samples(context, all, out);
    if (solids != nullptr) empty_within(context, *solids, out);
    std::uint64_t filled = 0;
    for (const float density : out.density.span()) filled += density > 0 ? 1 : 0;
    PILEUS_TRY(allocate(arrays::ordinate_places(filled, Stage::kWrite), out.filled));
    filled = 0;
    for (std::size_t i = 0; i < out.density.size(); ++i)
        if (out.density[i] > 0) out.filled[filled++] = std::int32_t(i);
    out.by_filled = true;
    PILEUS_TRY(allocate(arrays::ordinate_densities(samples_held(samples, filled)), out.samples));
    parallel_each(context.threads, filled, [&](std::size_t n) {
        each_held_sample(out, samples, n,
                         [&](std::size_t s, std::size_t held) { out.samples[held] = all[s]; });
    });
    PILEUS_TRY(find_rim(context, medium.grid.periodic, out));
    return sample_parts(context, medium, majorants, samples, out);
}

namespace {

/// Depth towards the sun, read from its nodes.
float depth_at_sample(const SunDepth& sun, const NodeSamples& samples, std::size_t s,
                      bool periodic) {
    const Vec<float> node = node_position(sun.nodes, sample_place(samples, s));
    return interpolate(sun.optical_depth.data(), node_corners(node, sun.nodes.size, periodic));
}

}  // namespace

Status sample_sun(const Context& context, const Medium& medium, const Majorants& majorants,
                  const Lighting& lighting, const SunDepth* sun, OrdinateNodes& nodes,
                  Buffer<float>& depths) {
    const NodeSamples samples = node_samples(nodes.grid, nodes.within);
    const std::uint64_t held =
        sun != nullptr ? samples_held(samples, nodes.filled.size()) : node_count(samples.fine);
    PILEUS_TRY(allocate(arrays::ordinate_depths(held), depths));
    ShadowParams k{};
    k.medium = make_medium_view(medium, majorants);
    k.nodes = samples.fine;
    for (std::size_t a = 0; a < 3; ++a) k.to_sun[a] = lighting.to_sun[a];
    if (sun != nullptr)
        parallel_each(context.threads, nodes.filled.size(), [&](std::size_t n) {
            each_held_sample(nodes, samples, n, [&](std::size_t s, std::size_t at) {
                if (nodes.samples[at] > 0)
                    depths[at] = depth_at_sample(*sun, samples, s, k.medium.periodic != 0);
            });
        });
    else
        PILEUS_TRY(run_rows(context, shadow_kernel(*context.kernels, k.medium), k,
                            ShadowBuffers{depths.data()},
                            std::uint32_t(k.nodes.size[1] * k.nodes.size[2])));
    if (lighting.solids != nullptr)
        PILEUS_TRY(
            solid_visibility(context, *lighting.solids, nodes.grid, lighting.to_sun, nodes.seen));
    return part_sun(context, k, medium, nodes);
}

namespace {

/// Mean irradiance on what lies in a filled node; depth(index of a sample, where it is held): that
/// counts.
template <class Depth>
float light_in_node(const Medium& medium, const OrdinateNodes& nodes, const NodeSamples& samples,
                    const SampleWay& way, int channel, std::size_t filled, const Depth& depth) {
    const float rest =
        ordinate_rest(nodes, nodes.parts, channel, std::size_t(nodes.filled[filled]));
    float light = 0, mass = 0;
    each_held_sample(nodes, samples, filled, [&](std::size_t s, std::size_t at) {
        const float density = nodes.samples[at];
        if (!(density > 0)) return;
        light += density * light_in_sample(way, rest * medium.sigma * density, depth(s, at));
        mass += density;
    });
    return mass > 0 ? light / mass : 0.0f;
}

}  // namespace

void light_nodes(const Context& context, const Medium& medium, const OrdinateNodes& nodes,
                 const Lighting& lighting, int channel, bool rays, const Buffer<float>& depths,
                 float* beam) {
    const NodeSamples samples = node_samples(nodes.grid, nodes.within);
    const SampleWay way(samples, {lighting.to_sun[0], lighting.to_sun[1], lighting.to_sun[2]});
    parallel_each(context.threads, nodes.filled.size(), [&](std::size_t filled) {
        const auto i = std::size_t(nodes.filled[filled]);
        const float sunward = ordinate_rest(nodes, nodes.sunward, channel, i);
        const float light = light_in_node(
            medium, nodes, samples, way, channel, filled,
            [&](std::size_t s, std::size_t at) { return sunward * depths[rays ? s : at]; });
        beam[filled] = light * (nodes.seen.empty() ? 1.0f : nodes.seen[i]);
    });
}

void follow_nodes(const Context& context, const Medium& medium, const OrdinateNodes& nodes,
                  const Lighting& lighting, int channel, const SunDepth& sun,
                  const OrdinateFollow& follow, float* beam) {
    const NodeSamples samples = node_samples(nodes.grid, nodes.within);
    const SampleWay way(samples, {lighting.to_sun[0], lighting.to_sun[1], lighting.to_sun[2]});
    const std::size_t count = nodes.filled.size(), every = std::size_t(follow.slices);
    const float rest = nodes.optics[0][channel].rest;
    for (const int slice : follow.due) {
        const std::size_t first = std::size_t(slice);
        const std::size_t due = first < count ? (count - first + every - 1) / every : 0;
        parallel_each(context.threads, due, [&](std::size_t n) {
            const std::size_t filled = first + n * every;
            beam[filled] = light_in_node(
                medium, nodes, samples, way, channel, filled, [&](std::size_t s, std::size_t) {
                    return rest * depth_at_sample(sun, samples, s, nodes.periodic);
                });
        });
    }
}

}  // namespace pileus
