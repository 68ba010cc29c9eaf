// SPDX-License-Identifier: Apache-2.0
// Light of point, spot and parallel lights, scattered once on its way to the camera, and what the
// media emit.
// in: lamps, a medium, a camera -> out: optical depths on nodes; light added to a picture's planes.
// docs/lights.md, "By marching".
#pragma once
#include <vector>

#include "kernels_cpu/raymarch/lamp_march_params.h"
#include "src/picture/layers.h"
#include "src/plan/array.h"
#include "src/run/context.h"
#include "src/world/light/lights.h"
#include "src/world/majorant/majorants.h"

namespace pileus {

/// Optical depths from nodes to each lamp, and the lamps that they are of.
struct LampNodes {
    NodeGrid grid{};
    Buffer<float> optical_depth;     ///< [lamp][node]
    std::vector<LampParams> lamps;   ///< those of a Lighting, and then their spots on the ground
    std::vector<std::int32_t> spot;  ///< [lamp]: index of its spot; -1: none
};

/// Nodes of one lamp: 2^17, and of a medium of many voxels one for each eight, at most 2^20.
NodeGrid lamp_node_grid(const Medium& medium);

/// Numbers of all lamps' nodes; `spots`: and of their spots on the ground.
std::uint64_t lamp_numbers(const Medium& medium, const Lighting& lighting, bool spots = false);

namespace arrays {

/// Of all lamps.
inline Array<float> lamp_depths(std::uint64_t numbers) {
    return {"optical depths to lights", numbers, Stage::kShadow, Stage::kWrite};
}

}  // namespace arrays

/// Fills `out` where its lamps are not those of `lighting`, with their spots on the ground where
/// they are wanted. kLimit: out of memory. Needs kernels of the host.
Status make_lamp_nodes(const Context& context, const Medium& medium, const Majorants& majorants,
                       const Lighting& lighting, bool spots, LampNodes& out);

/// Room for so many lamps, which may all shine later on. kLimit: out of memory.
Status reserve_lamp_nodes(const Medium& medium, std::size_t lamps, LampNodes& out);

/// The launch that add_lamp_light makes: media with their phase functions and albedos.
LampMarchParams lamp_march_params(const Medium& medium, const Majorants& majorants,
                                  const Lighting& lighting, const CameraParams& camera,
                                  const LampNodes& nodes, double cut);

/// Adds the lamps' light and the media's own to the planes' colour and, where rays end at the
/// ground, that of the lamps to their background. Of k.lamps lamps of `nodes` from `first` on.
/// `beam`: tables of k.beam_sets. `whole`: a user's wish to end waits.
Status add_lamp_light(const Context& context, const Medium& medium, const LampMarchParams& k,
                      const LampNodes& nodes, Planes& planes, std::size_t first = 0,
                      const float* beam = nullptr, bool whole = false);

}  // namespace pileus
