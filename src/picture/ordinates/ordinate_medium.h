// SPDX-License-Identifier: Apache-2.0
// What lies in the nodes of discrete ordinates, and how much of the sun's light arrives there.
// in: a medium, its nodes -> out: densities, parts of several media, the sun's beam.
// docs/ordinates.md, "Sunlight", "Several media"
#pragma once
#include "kernels_cpu/core/vec.h"
#include "src/picture/ordinates/ordinates.h"

namespace pileus {

/// Share of the extinction that counts in a channel, where media have these parts: [medium][node].
inline float ordinate_rest(const OrdinateCells& nodes, const Buffer<float>& parts, int channel,
                           std::size_t node) {
    if (nodes.media == 1) return nodes.optics[0][channel].rest;
    const std::size_t count = nodes.density.size();
    float rest = 0;
    for (int i = 0; i < nodes.media; ++i)
        rest += parts[std::size_t(i) * count + node] * nodes.optics[i][channel].rest;
    return rest;
}

/// Share of the sun's extinction that counts on surfaces, by channel: of several media their mean.
void set_mean_rest(const OrdinateNodes& nodes, float (&out)[3]);

/// Samples of the density within nodes.
struct NodeSamples {
    std::array<int, 3> within{};  ///< of a node, along each axis
    NodeGrid fine{};              ///< of all of them
    float share = 1;              ///< one over their number in a node
};
NodeSamples node_samples(const NodeGrid& grid, const std::array<int, 3>& within);
/// So many that they see every voxel, up to a number.
std::array<int, 3> samples_within(const NodeGrid& grid, const Medium& medium);

/// Calls use(index of a sample) for those within a node.
template <class Use>
void each_sample(const NodeGrid& grid, const NodeSamples& samples, std::size_t node,
                 const Use& use) {
    const std::size_t nx = std::size_t(grid.size[0]), ny = std::size_t(grid.size[1]);
    const std::size_t at[3] = {node % nx, node / nx % ny, node / (nx * ny)};
    const std::size_t w[3] = {std::size_t(samples.within[0]), std::size_t(samples.within[1]),
                              std::size_t(samples.within[2])};
    for (std::size_t z = 0; z < w[2]; ++z)
        for (std::size_t y = 0; y < w[1]; ++y)
            for (std::size_t x = 0; x < w[0]; ++x)
                use(((at[2] * w[2] + z) * (ny * w[1]) + at[1] * w[1] + y) * (nx * w[0]) +
                    at[0] * w[0] + x);
}

/// Calls use(index of a sample, its place in OrdinateNodes::samples) for those within filled node
/// `filled`.
template <class Use>
void each_held_sample(const OrdinateNodes& nodes, const NodeSamples& samples, std::size_t filled,
                      const Use& use) {
    std::size_t held =
        filled * std::size_t(samples.within[0] * samples.within[1] * samples.within[2]);
    each_sample(nodes.grid, samples, std::size_t(nodes.filled[filled]),
                [&](std::size_t s) { use(s, nodes.by_filled ? held++ : s); });
}

/// Place of a sample, box-local metres.
inline Vec<float> sample_place(const NodeSamples& samples, std::size_t i) {
    const NodeGrid& fine = samples.fine;
    const std::size_t nx = std::size_t(fine.size[0]), ny = std::size_t(fine.size[1]);
    return {(float(i % nx) + 0.5f) / fine.per_metre[0],
            (float(i / nx % ny) + 0.5f) / fine.per_metre[1],
            (float(i / (nx * ny)) + 0.5f) / fine.per_metre[2]};
}

/// Light that travels along a unit vector through samples' parts of nodes: one over its way through
/// the middle of one, and over its mean way.
struct SampleWay {
    float most = 0, across = 0;
    SampleWay(const NodeSamples& samples, const float (&way)[3]);
};
/// Mean of e^-tau over a sample's part of the node, by what counts of the extinction per metre and
/// of the depth from its middle to the light.
float light_in_sample(const SampleWay& way, float per_metre, float depth);

/// Densities of nodes, which are means of those of their samples, [sample of the whole grid].
void average_samples(const Context& context, const Buffer<float>& from, OrdinateNodes& nodes);

/// Densities of nodes and samples within them, and parts of media; none within closed `solids`,
/// null without. kLimit: out of memory.
Status sample_ordinates(const Context& context, const Medium& medium, const Majorants& majorants,
                        const Solids* solids, OrdinateNodes& out);

/// Optical depths towards the sun from samples that hold medium, held as their densities are; by
/// rays, where `sun` is null, of the whole grid. Of nodes which media they are of. kLimit: out of
/// memory.
Status sample_sun(const Context& context, const Medium& medium, const Majorants& majorants,
                  const Lighting& lighting, const SunDepth* sun, OrdinateNodes& nodes,
                  Buffer<float>& depths);

/// Mean irradiance of the sun on what lies in a node, of an irradiance of 1: over each sample's
/// part of the node it falls along the sun's way. `rays`: depths are of the whole grid.
void light_nodes(const Context& context, const Medium& medium, const OrdinateNodes& nodes,
                 const Lighting& lighting, int channel, bool rays, const Buffer<float>& depths,
                 float* beam);

/// The same of the nodes whose turn it is, of one medium without solids.
void follow_nodes(const Context& context, const Medium& medium, const OrdinateNodes& nodes,
                  const Lighting& lighting, int channel, const SunDepth& sun,
                  const OrdinateFollow& follow, float* beam);

}  // namespace pileus
