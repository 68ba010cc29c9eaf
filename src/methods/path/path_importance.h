// SPDX-License-Identifier: Apache-2.0
// Light by discrete ordinates as importance of paths: where it is expected, and how much.
// in: a medium, sun, sky and ground -> out: what trace_paths_importance reads.
// docs/importance.md
#pragma once
#include "kernels_cpu/path/importance_params.h"
#include "src/methods/method.h"
#include "src/picture/ordinates/ordinates.h"
#include "src/world/world.h"

namespace pileus {

/// Light that `made` says for; it points into its own buffers and stays where it is.
struct PathImportance {
    OrdinateNodes nodes;
    Buffer<std::int32_t> moments;    ///< [node][16]
    Buffer<std::int32_t> sun_depth;  ///< [node of ordinate_samples]
    Buffer<float> lobes;             ///< [kImportanceDepths][kImportanceLobes]
    ImportanceParams params{};
    bool made = false;
    std::array<float, 3> to_sun{};
    std::array<double, 3> shine{};  ///< worth of sun and sky, albedo of the ground

    PathImportance() = default;
    PathImportance(const PathImportance&) = delete;
    PathImportance& operator=(const PathImportance&) = delete;
};

namespace arrays {

inline Array<std::int32_t> importance_moments(std::uint64_t nodes) {
    return {"importance: light on nodes", bytes_of(kImportanceMoments, nodes), Stage::kShadow,
            Stage::kWrite};
}
inline Array<std::int32_t> importance_depths(std::uint64_t nodes) {
    return {"importance: sunlight's optical depth", nodes, Stage::kShadow, Stage::kWrite};
}
inline Array<float> importance_lobes() {
    return {"importance: lobes about the sun", std::uint64_t(kImportanceDepths) * kImportanceLobes,
            Stage::kShadow, Stage::kWrite};
}

}  // namespace arrays

/// Its arrays, for the plan.
void add_importance_rows(const FrameView& view, MemoryTable& table);

/// Whether a scene has it, as its files say.
bool asks_for_importance(const Scene& scene, const World& world);
/// Whether a view may come to have it, as a host sets lights and cameras.
bool may_have_importance(const FrameView& view);
/// Why a scene's paths are traced one by one, in words; null: importance splits them.
const char* why_no_importance(const FrameView& view);

/// Solves for the view's light, unless that is what `out` has. kLimit: out of memory.
Status make_importance(const Context& context, const FrameView& view, const Majorants& majorants,
                       PathImportance& out);

/// Coefficients of the lobes by depth: those whose sum is nearest to what turns within the peak
/// leave of an irradiance of 1, [kImportanceDepths][kImportanceLobes].
void fit_lobes(const PhaseParams& phase, double albedo, float peak_turn,
               const float (&g)[kImportanceLobes], float* out);

}  // namespace pileus
