// SPDX-License-Identifier: Apache-2.0
// The marched picture of light on nodes: the sun's first order exact, sky and ground behind it.
// in: PhotonState after shooting, nodes that hold scattered light -> out: planes of pixels.
// docs/methods.md 3, repairs 3 and 4; 4.
#pragma once
#include "src/photons/light_input.h"
#include "src/photons/photon_state.h"
#include "src/picture/nodes/node_grid.h"

namespace pileus {

namespace arrays {

/// Optical depths towards the sun, from the first stage that shows or, in animations, shoots.
inline Array<float> shadow(std::uint64_t nodes, Stage first) {
    return {"shadow", nodes, first, Stage::kWrite};
}
/// With the ground's light of the batch beside it.
inline Array<float> batch_background(std::uint64_t pixels) {
    return {"ground light of a batch", bytes_of(3, pixels), Stage::kLayers, Stage::kLayers};
}
/// Three colours and the sun's optical depth of each node side by side.
inline Array<float> lit_quads(std::uint64_t nodes) {
    return {"lit nodes", bytes_of(4, nodes), Stage::kSplat, Stage::kWrite};
}
/// The same of nodes around the camera, for the picture and each batch.
inline Array<float> near_nodes(std::uint64_t numbers, std::uint64_t nodes) {
    return {"near nodes", bytes_of(numbers, nodes), Stage::kSplat, Stage::kWrite};
}
/// Harmonics on nodes as kernels read them: one node's numbers after the other.
inline Array<float> source_by_node(std::uint64_t numbers) {
    return {"source by node", numbers, Stage::kSplat, Stage::kDisplay};
}

}  // namespace arrays

/// Optical depth towards the sun, once per position of the sun; where the march does the first
/// order.
Status make_sun_shadow(const Context& context, const FrameView& view, PhotonState& state);

/// The media have moved: nothing that the sun's light was kept for holds.
void forget_sun_shadow(PhotonState& state);

/// Numbers that it keeps.
std::uint64_t sun_shadow_numbers(const FrameView& view);

/// Light on the nodes that a march reads, in one of two orders.
struct NodeLight {
    const float* planes = nullptr;  ///< [channel][node]; with bands [node][set][harmonic]
    const float* quads = nullptr;   ///< [node][R, G, B, the sun's optical depth]; null: not made
    bool depths = false;            ///< quads hold these depths: shadow nodes are the same
    const float* near = nullptr;    ///< MarchBuffers::near
};

/// Lives as long as a picture is made, however that ends. Nodes around a camera are as many as it
/// is near: a flight has no room of its own for them, and gives back what a picture took.
class NearNodesOfPicture {
public:
    explicit NearNodesOfPicture(PhotonState& state) : state_(state) {}
    ~NearNodesOfPicture() {
        if (state_.sealed) state_.picture.near_light = Buffer<float>();
    }
    NearNodesOfPicture(const NearNodesOfPicture&) = delete;
    NearNodesOfPicture& operator=(const NearNodesOfPicture&) = delete;

private:
    PhotonState& state_;
};

/// Whether a march of so many channels reads quads: a device reads grids one by one.
bool reads_quads(const Context& context, int channels, const NodeGrid& nodes);

/// Optical depths to the sun at these nodes, or null where they are kept at others.
const float* sun_depths_at(const SunShadow& shadow, const NodeGrid& nodes);

/// The same for the picture itself, of which thinning may leave pixels to be filled in:
/// transmittance, three colours and depths.
Status march_thinned(const Context& context, const FrameView& view, const NodeLight& source,
                     const MarchParams& k, PhotonState& state, Planes& planes);

/// Thinned pictures are of the light as a whole: kBadInput names the layer that is not. `method`
/// names the keys.
Status check_thinned(const Scene& scene, const char* method, const PhotonState& state);

/// What the plan counts for the ground's shadow and for a thinned picture.
void add_picture_rows(const Context& context, const FrameView& view, const PhotonState& state,
                      MemoryTable& table);

/// Least light of a node that is none less than none beside the constant of the furnace identity.
float least_light(const FrameView& view, const PhotonState& state, const Lighting& light,
                  std::size_t channel);

/// What all marches of a picture share.
MarchParams lit_march_params(const FrameView& view, const PhotonState& state, const LightInput& lit,
                             const NodeGrid& source);

/// Marches through `source` into `target`'s planes.
Status march_lit(const Context& context, const FrameView& view, PhotonState& state,
                 const NodeLight& source, const MarchParams& k, float* target, Planes& planes);

/// late_rows_of a picture whose light is the march's or the blend's alone; null where it has
/// batches.
LateRows* late_photons(LateRows* late, const FrameView& view, const PhotonState& state);

/// Nodes around the camera, for the plan: the largest number where it moves.
std::uint64_t near_nodes_of(const Context& context, const FrameView& view, const NodeGrid& nodes);

/// Numbers per node and set, filled up to whole groups.
int stored_harmonics(const DepositPlan& deposit);

/// Nodes hold so many sets of harmonics of these colours.
void set_harmonic_sets(const LightInput& lit, int sets, const float (&colour)[3][3],
                       MarchParams& k);

/// Numbers of each of `nodes`, [set][harmonic] and one more, become [set][stored harmonic].
void gather_by_node(const Context& context, const MarchParams& k, std::uint64_t nodes,
                    Span<const float> numbers, Span<float> by_node);

/// Adds light of `lit`'s lamps, scattered once, and in the whole picture the media's own to the
/// picture's planes; not to those of batches, as it has no noise. kLimit: out of memory.
Status add_lit_lamps(const Context& context, const FrameView& view, PhotonState& state,
                     const LightInput& lit, Planes& planes);

/// Sky and ground of `lit`; the light scattered onto the ground is that of `batch`, 0: of all.
Status fill_lit_background(const Context& context, const FrameView& view, PhotonState& state,
                           const LightInput& lit, int batch, Planes& planes);

/// Adds to every batch's colour what its own photons brought to the ground, seen through the media:
/// the spread of the batches then holds that light's noise, too. After the display.
Status add_ground_noise(const Context& context, const FrameView& view, PhotonState& state,
                        const LightInput& lit, Planes& planes);

/// Scattered light of a pixel that noise has left below 0 becomes 0, and is counted.
void cut_below_zero(const Context& context, Planes& planes);

/// Data of whole rays, where layers show them: optical depth, and transmittance to the end where
/// the picture's own ends before.
Status show_whole_rays(const Context& context, const FrameView& view, const PhotonState& state,
                       const LightInput& lit, Planes& planes);

/// Numbers a pixel that stay of them.
inline std::uint64_t whole_ray_planes(const OutputSettings& output) {
    return output.layer_optical_depth ? 2 : output.layer_transmittance ? 1 : 0;
}

}  // namespace pileus
