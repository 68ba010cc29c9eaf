// SPDX-License-Identifier: Apache-2.0
// Discrete ordinates of a sky in place: levels of nodes around the camera, each within a coarser
// one whose light enters it.
// in: a sky, lights, a camera -> out: light on nodes, as the march reads it.
// docs/ordinates.md, "Skies"
#pragma once
#include "kernels_cpu/ordinates/ordinates_sky_params.h"
#include "src/picture/ordinates/ordinates.h"
#include "src/world/density/sky_field.h"

namespace pileus {

/// How many levels there are, of which sizes.
struct SkyOrdinateSizes {
    int levels = 1;
    int size[3] = {1, 1, 1};  ///< nodes of each level
    double step[2] = {1, 1};  ///< m between nodes of the finest level
    bool wraps = false;       ///< the coarsest goes on without end
    std::uint64_t nodes() const {
        return std::uint64_t(size[0]) * std::uint64_t(size[1]) * std::uint64_t(size[2]);
    }
};
/// `extinction_per_m`: the largest.
SkyOrdinateSizes sky_ordinate_sizes(const SkyParams& sky, double extinction_per_m);
/// Samples of all nodes of a level.
std::uint64_t sky_ordinate_samples(const SkyOrdinateSizes& sizes);

/// Sets of light that a sky has at most: its lamps and its emission have none.
constexpr std::uint64_t kMaxSkySets = 3;

struct SkyLevel {
    OrdinateNodes nodes;
    std::array<double, 2> low{};  ///< m, box-local
    double step[2] = {};
    bool solved = false, followed = false;  ///< by some iterations, from another sun's solution
    std::uint64_t moves = 0, made = 0;      ///< places and solutions so far
    std::uint64_t moves_from = 0, made_from = 0;  ///< of the coarser one, when this was solved
    std::array<float, 3> to_sun{};                ///< then
};

struct SkyOrdinates {
    SkyOrdinateSizes sizes;
    std::vector<SkyLevel> levels;  ///< the finest first
    /// A level that is made beside the others, one light a picture, and which.
    SkyLevel spare;
    bool has_spare = false;
    int building = -1, built = 0;
    /// Optics, beam and sets of all, and what is read: `light` is [set][level][node], `near` of the
    /// finest level.
    OrdinateNodes front;
    Buffer<float> depths;  ///< of the samples of one level to the sun
    OrdinateLevelsView view{};
    std::vector<OrdinateSet> lights;  ///< of the picture
    int next = 0;                     ///< level whose sun a host's next picture looks at
    int pause = 0;                    ///< pictures until one does
    std::uint64_t turned = 0;         ///< solutions that are turned to the camera
    CameraParams camera{};            ///< this one
};

/// Optics and memory of nodes; `spare`: for levels that are made over several pictures. kLimit: out
/// of memory.
Status prepare_sky_ordinates(const Context& context, const Medium& medium, const SkyParams& sky,
                             bool spare, SkyOrdinates& out);
/// Memory for any camera and lights, so that frames keep none. kLimit: out of memory.
Status reserve_sky_ordinates(SkyOrdinates& out);

/// What changes between pictures.
struct SkyOrdinateAsk {
    const RaymarchParams* march = nullptr;  ///< ways to the sun
    const SkyParams* sky = nullptr;
    CameraParams camera{};
    int pictures = 1;  ///< > 1: what changes takes more of them, a part of it each
};
/// Solves where place or light have changed, and turns light to the camera. kLimit: out of memory.
Status follow_sky_ordinates(const Context& context, const Medium& medium,
                            const Majorants& majorants, const Lighting& lighting,
                            const SkyOrdinateAsk& ask, SkyOrdinates& out);

}  // namespace pileus
