// SPDX-License-Identifier: Apache-2.0
// See ordinate_walls.h. Light of solids among nodes.
// in: ways, radiance on nodes -> out: what solids send on. docs/ordinates.md, "Solids"
#include <algorithm>

#include "kernels_cpu/display/march_ray.h"
#include "kernels_cpu/solids/solids.h"
#include "platform/threads.h"
#include "src/picture/background.h"
#include "src/picture/march_view.h"
#include "src/picture/ordinates/ordinate_solve.h"
#include "src/picture/ordinates/walls/ordinate_walls.h"
#include "src/world/solids/solids.h"

namespace pileus {

void light_surfaces(const Context& context, const Medium& medium, const Majorants& majorants,
                    const Lighting& lighting, const float (&rest)[3], OrdinateWalls& w) {
    MediumView view = make_medium_view(medium, majorants);
    // Coarse places see what detail keeps: the mean.
    view.detail = nullptr;
    const SolidsView solids = lighting.solids->view();
    const float to_sun[3] = {lighting.to_sun[0], lighting.to_sun[1], lighting.to_sun[2]};
    parallel_each(context.threads, w.surfaces.size(), [&](std::size_t i) {
        OrdinateSurface& s = w.surfaces[i];
        const float cosine =
            s.normal[0] * to_sun[0] + s.normal[1] * to_sun[1] + s.normal[2] * to_sun[2];
        for (float& sun : s.sun) sun = 0;
        if (!(cosine > 0) || solid_between(solids, s.at, to_sun, 3e38f)) return;
        const Ray<float> ray{{s.at[0], s.at[1], s.at[2]}, {to_sun[0], to_sun[1], to_sun[2]}};
        const float depth = optical_depth(view, ray, true);
        for (int c = 0; c < 3; ++c)
            s.sun[c] = c > 0 && rest[c] == rest[0] ? s.sun[0]
                                                   : cosine * (1 / kPi) * exp_(-(rest[c] * depth));
    });
}

namespace {

/// The way of light of each direction, and its solid angle's part of the irradiance over pi around.
void set_wall_directions(float (&way)[kOrdinates][3], float (&harmonic)[kOrdinates][kAroundTerms]) {
    for (int j = 0; j < kOrdinates; ++j) {
        const std::array<double, 3> d = ordinate_direction(j);
        const double from[3] = {-d[0], -d[1], -d[2]};
        double terms[kAroundTerms] = {};
        add_around(from, ordinate_weight(j), terms);
        for (int m = 0; m < kAroundTerms; ++m) harmonic[j][m] = float(terms[m]);
        for (std::size_t a = 0; a < 3; ++a) way[j][a] = float(d[a]);
    }
}

/// Calls use(direction, place in arrays of it) for a node.
template <class Use>
void each_direction(const OrdinateCells& nodes, const WallLight& light, std::size_t node,
                    const Use& use) {
    const std::size_t place_x = place_along_x(nodes.grid, node_place(nodes.grid, node));
    for (std::size_t j = 0; j < kOrdinates; ++j) use(j, light.sweeps[j].axis == 0 ? place_x : node);
}

}  // namespace

void keep_sources(const Context& context, const OrdinateCells& nodes, const WallLight& light,
                  OrdinateWalls& w) {
    const std::size_t all = std::size_t(node_count(nodes.grid)), lit = w.nodes.size();
    parallel_each(context.threads, lit, [&](std::size_t n) {
        each_direction(nodes, light, std::size_t(w.nodes[n]), [&](std::size_t j, std::size_t at) {
            w.sources[j * lit + n] = light.radiance[j * all + at];
        });
    });
}

double light_walls(const Context& context, const OrdinateCells& nodes, const WallLight& light,
                   bool begins, float mean, OrdinateWalls& w) {
    if (!w.any()) return 0;
    const std::size_t all = std::size_t(node_count(nodes.grid)), lit = w.nodes.size();
    float direction[kOrdinates][3], harmonic[kOrdinates][kAroundTerms];
    set_wall_directions(direction, harmonic);
    const auto channel = std::size_t(light.set->channel);
    parallel_each(context.threads, lit, [&](std::size_t n) {
        const auto node = std::size_t(w.nodes[n]);
        float in[kOrdinates];
        each_direction(nodes, light, node, [&](std::size_t j, std::size_t at) {
            // What leaves the node: surfaces lie behind it.
            const std::size_t way = std::size_t(light.sweeps[j].length) * all + at;
            const float source = w.sources[j * lit + n],
                        over = light.radiance[j * all + at] - source;
            in[j] = begins ? mean : source + over * (light.pass[way] / light.mean[way]);
        });
        for (int m = 0; m < kAroundTerms && light.around != nullptr; ++m) {
            float sum = 0;
            for (int j = 0; j < kOrdinates; ++j) sum += in[j] * harmonic[j][m];
            light.around[std::size_t(m) * lit + n] = sum;
        }
        for (std::int32_t i = w.begin[n]; i < w.begin[n + 1]; ++i) {
            const auto way = std::size_t(w.of_node[std::size_t(i)]);
            const OrdinateSurface& s = w.surfaces[way];
            // Of what the ground sends up, each of two sets has its own faces.
            const bool other = s.beyond != 0 && light.set->faces != OrdinateFaces::kAll &&
                               (light.set->faces == OrdinateFaces::kLower) != (s.beyond == 1);
            float sum = 0, whole = 0;
            for (int j = 0; j < kOrdinates; ++j) {
                const float cosine = direction[j][0] * s.normal[0] + direction[j][1] * s.normal[1] +
                                     direction[j][2] * s.normal[2];
                if (!(cosine < 0)) continue;
                whole -= cosine;
                sum -= cosine * (s.beyond == 0 ? in[j] : other ? 0.0f : light.enters[j]);
            }
            light.sends[way] = s.albedo[channel] *
                               (sum / std::max(whole, 1e-6f) + light.set->beam * s.sun[channel]);
        }
        // Nodes without medium have no source.
        if (nodes.density[node] > 0 || begins) return;
        each_direction(nodes, light, node,
                       [&](std::size_t j, std::size_t at) { light.radiance[j * all + at] = 0; });
    });
    double change = 0, norm = 0;
    for (std::size_t i = 0; i < w.ways.size(); ++i) {
        const double now = double(light.sends[i]), off = now - double(w.ways[i].sends);
        change += off * off, norm += now * now, w.ways[i].sends = light.sends[i];
    }
    return norm > 0 ? __builtin_sqrt(change / norm) : 0;
}

void mix_walls(const std::vector<OrdinateSet>& sets, OrdinateWalls& w) {
    const std::size_t numbers = kAroundTerms * w.nodes.size();
    for (std::size_t c = 0; c < 3 && w.any(); ++c)
        for (std::size_t i = 0; i < numbers; ++i) {
            float sum = 0;
            for (std::size_t s = 0; s < sets.size(); ++s)
                sum += sets[s].colour[c] * w.around[s * numbers + i];
            w.shown[c * numbers + i] = sum;
        }
}

void shade_cells(const Context& context, const Solids& solids, const ShadowParams& cells,
                 Buffer<float>& depth) {
    const SolidsView view = solids.view();
    if (view.count <= 0) return;
    const float to_sun[3] = {cells.to_sun[0], cells.to_sun[1], cells.to_sun[2]};
    parallel_each(context.threads, depth.size(), [&](std::size_t i) {
        const NodePlace p = node_place(cells.nodes, i);
        float at[3];
        for (std::size_t a = 0; a < 3; ++a)
            at[a] = (float(p[a]) + 0.5f) / cells.nodes.per_metre[a] + cells.origin[a];
        if (solid_between(view, at, to_sun, 3e38f)) depth[i] = 1e30f;
    });
}

AroundNodes around_nodes(const OrdinateCells& nodes) {
    const OrdinateWalls& w = nodes.walls;
    AroundNodes out{};
    if (!w.any() || w.shown.empty()) return out;
    out.nodes = nodes.grid;
    out.periodic = nodes.periodic ? 1 : 0;
    out.count = std::int32_t(w.nodes.size());
    out.number = w.number.data();
    out.light = w.shown.data();
    return out;
}

}  // namespace pileus
