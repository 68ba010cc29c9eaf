// SPDX-License-Identifier: Apache-2.0
// A procedural cloud of a type: balls of rising air over a condensation level, lumps upon them.
// in: CloudSettings, a box -> out: balls, where they stand; relative densities, the same bits
// everywhere. docs/generators.md
#pragma once
#include <cstddef>

#include "kernels_cpu/isa/kernels.h"
#include "src/base/buffer.h"
#include "src/base/status.h"
#include "src/io/volumes/volume.h"
#include "src/scene/scene.h"

namespace pileus {

struct SceneCheck;

constexpr std::size_t kMaxTurrets = 40;

/// The balls of a cloud, in units of its height from the middle of its foot, and what it takes up
/// with bends and lumps: lowest and highest corner.
struct CloudHeap {
    Buffer<CloudBall> balls;  ///< kMaxCloudBalls reserved
    std::size_t count = 0;
    std::array<Double3, 2> extent{};
    std::array<RainShaft, kMaxRainShafts> shaft{};  ///< below its tall turrets
    std::size_t shafts = 0;
};

/// Grows the balls of resolved settings. kLimit: out of memory.
Status grow_cloud(const CloudSettings& settings, CloudHeap& heap);

/// What a cloud with an age in seconds is by then.
struct CloudLife {
    double share = 0;      ///< of its life
    float lift = 0;        ///< that lumps have risen, over the height
    float water = 1;       ///< what is left
    double anvil = 1;      ///< 0: the anvil has not begun to come
    float anvil_sunk = 0;  ///< how far its surface lies within, over the height
    double rain = 1;       ///< share of the root of its extinction
    double rained_s = 0;   ///< since rain began
};
CloudLife cloud_life(const CloudSettings& settings);
/// Resolved settings with the age, dilution and anvil of that time.
CloudSettings cloud_at_age(const CloudSettings& settings);

/// Where a turret stands.
struct CloudFoot {
    float x, y;
};
/// Lets balls be where they are at the age of the settings: each turret rises at a time of its own.
/// `turret`: of each ball; `feet`: of each turret.
void rise_turrets(const CloudSettings& settings, const std::uint8_t* turret, const CloudFoot* feet,
                  std::size_t turrets, CloudHeap& heap);

/// The anvil of resolved settings, in units of the cloud's height; the unit vector of the wind.
struct AnvilPlace {
    float x, y, top, depth;
    float wind_x, wind_y;
};
AnvilPlace anvil_place(const CloudSettings& settings);
/// The direction in which air drifts at a height over the cloud's, of which the top has that of
/// anvil_place.
struct WindWay {
    float x, y;
};
WindWay wind_at(const CloudSettings& settings, double height);

/// What a lens takes up, in units of its height: lowest and highest corner.
std::array<Double3, 2> lens_extent(const CloudSettings& settings);

/// Where a cloud stands.
struct CloudInGrid {
    CloudSettings cloud;  ///< resolved; its height as the box allows it
    Double3 foot_m{};     ///< world place of the foot's middle on the condensation level
    std::array<Double3, 2> bounds_m{};
    double full_m = 0;  ///< height of the cloud that the extinction is for; one for all of a field
    double allowed_m = 0;  ///< largest height that fits the medium's box; below that of `cloud`: it
                           ///< was asked for and does not fit
};

/// Whether the height that was asked for is allowed.
bool fits(const CloudInGrid& place);

/// Places a medium's cloud in the medium's box, or a box around it; of one heap grows its balls.
/// kLimit: out of memory.
Status place_cloud(const MediumSettings& medium, CloudHeap& heap, CloudInGrid& place);

/// Laws between the keys of a cloud; fills in what its type brings.
void check_cloud(SceneCheck& check, std::size_t medium);

/// What making a cloud takes.
struct CloudMaking {
    std::array<int, 3> size{};  ///< cells of the box
    const KernelTable& kernels;
    int threads = 0;         ///< 0: all
    bool all_balls = false;  ///< no list of balls is shortened, for tests
};

/// Fills `volume` with the box: densities in [0, 1], zero in the lowest and highest layer of cells,
/// and but for layers in all outermost ones. kBadInput: a cloud that does not fit; kLimit: out of
/// memory.
Status make_cloud(const MediumSettings& medium, const CloudMaking& with, Volume& volume);

/// The same of one kind, into `volume`, which has its cells. Heaps lie upon one another.
Status make_heap(const CloudInGrid& place, const CloudHeap& heap, const CloudMaking& with,
                 Volume& volume);
Status make_field(const CloudInGrid& place, const CloudMaking& with, Volume& volume);
Status make_lens(const CloudInGrid& place, const CloudMaking& with, Volume& volume);
Status make_layer(const CloudInGrid& place, const CloudMaking& with, Volume& volume);
/// Adds the rain below a heap or a layer.
Status make_rain(const CloudInGrid& place, const CloudHeap& heap, const CloudMaking& with,
                 Volume& volume);

/// Cells where the scene leaves them out: cubes, so many along the longest edge of the box, and 24
/// and more along its height, of a lens 96. Of one heap 256, of a lens 320, with an anvil or of a
/// field 384, of a layer 448.
std::array<int, 3> default_cloud_size(const MediumSettings& medium);

}  // namespace pileus
