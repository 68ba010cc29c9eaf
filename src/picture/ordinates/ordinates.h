// SPDX-License-Identifier: Apache-2.0
// Light scattered any number of times, by discrete ordinates on coarse nodes: no noise.
// in: a medium, sun, sky and ground -> out: its radiance towards a camera on nodes.
// docs/ordinates.md; Evans 1998 (SHDOM), Wiscombe 1977 (the peak apart).
#pragma once
#include <array>

#include "kernels_cpu/ordinates/ordinates_params.h"
#include "src/picture/nodes/lamp_light.h"
#include "src/picture/nodes/node_grid.h"
#include "src/picture/nodes/sun_depth.h"
#include "src/picture/ordinates/walls/ordinate_walls.h"
#include "src/plan/array.h"
#include "src/run/context.h"
#include "src/world/light/beam.h"
#include "src/world/light/lights.h"
#include "src/world/majorant/majorants.h"

namespace pileus {

/// Iterations that are mixed, and moments that are: degrees 0 and 1, which change last.
constexpr int kMixedIterations = 5;
constexpr std::size_t kSlowMoments = 4;

/// How a medium scatters once turns within the peak of its phase function no longer count: its
/// extinction is `rest` of what it was, of a channel.
struct OrdinateOptics {
    float rest = 1;
    float albedo = 1;
    float moment[4] = {1, 0, 0, 0};  ///< degrees 0..3, such that no light is negative
};

/// Share of a moment that is scattered.
inline float ordinate_scatter(const OrdinateOptics& optics, int degree) {
    return optics.albedo * optics.moment[degree];
}

/// Faces at which light enters that goes up.
enum class OrdinateFaces { kAll, kLower, kSides };

/// Light of one colour that enters, and its solution.
struct OrdinateSet {
    std::array<float, 3> colour{};
    std::array<float, kOrdinates> enters{};  ///< radiance by direction
    float beam = 0;                          ///< of the sun's irradiance
    int channel = 0;                         ///< whose optics
    /// Light of lamps and of the media: 0: none, 1 + c: of channel c, kLampStrength: by strength.
    int own = 0;
    bool solved = false;  ///< there is a solution for it, or for one before
    bool same = false;    ///< that is for light like this
    OrdinateFaces faces = OrdinateFaces::kAll;
    bool ground = false;  ///< of what the ground sends up, of radiance 1; `colour` is its radiance
    int iterations = 0;
    double residual = 0;  ///< of the mean radiance, the last iteration's change over its norm
};

/// One set, or all of a channel, as a march reads them.
struct OrdinateShown {
    std::array<float, 3> colour{};
    int channel = 0;  ///< whose optics
    int set = -1;     ///< -1: all sets of the channel, each by its colour there
};
/// Most that the sun shines in: one a channel.
constexpr int kMaxOrdinateBeams = 3;
/// Most that are shown, where sets may be shown together.
constexpr std::size_t kMaxShown = 3;

/// Nodes as a solution is found on them.
struct OrdinateCells {
    NodeGrid grid{};
    bool periodic = false;  ///< what lies in the nodes repeats along x and y
    /// Of a level of a sky: the outermost nodes along x and y hold what enters it, and all others
    /// count as filled.
    bool ring = false;
    int media = 1;
    OrdinateOptics optics[kMaxMedia][3];
    Buffer<float> density;        ///< [node]
    Buffer<std::int32_t> filled;  ///< nodes that hold medium; others have no light of their own
    Buffer<float> parts;          ///< [medium][node]: of the density; of several media alone
    Buffer<float> solution;       ///< [set][moment][filled]
    OrdinateWalls walls;
};

/// Nodes of twice the size, and which of them others lie in.
struct OrdinateHalf {
    OrdinateCells nodes;
    Buffer<std::int32_t> number;  ///< [larger node]: among those that count as filled; -1: none
    Buffer<std::int32_t> parent;  ///< [filled]: such a number
    Buffer<float> share;          ///< [filled]: of the parent's density
    Buffer<float> correction;     ///< [set][moment][larger filled]: what solutions are short of
};

/// Light on the ground beside what reaches it without the medium, and what it sends up.
struct OrdinateGround {
    NodeGrid map{};          ///< cells; size 0: no ground
    float origin[2]{};       ///< m, box-local
    double z = 0;            ///< m, box-local
    Buffer<float> light;     ///< [set][cell]: irradiance over pi by a set of colour 1; may be < 0
    Buffer<float> radiance;  ///< [3][cell]: of the ground
    Buffer<float> into;      ///< [2][cell]: share of what it sends up that enters the box: from
                             ///< below, from beside
    std::array<bool, kMaxOrdinateSets> known{};      ///< there is light of the set
    std::array<double, kMaxOrdinateSets> mean[2]{};  ///< of it, by what enters from each
    Double3 sends{};                                 ///< mean radiance
};

struct OrdinateNodes : OrdinateCells {
    std::array<int, 3> within{1, 1, 1};  ///< samples of a node, along each axis
    Beam peak;                           ///< of the sun's light, turned within the peak
    BehindView behind{};                 ///< without lights
    double depth = 0;                    ///< node_depth()
    float mean_rest[3] = {1, 1, 1};      ///< of the extinction, what keeps light from surfaces
    std::vector<OrdinateSet> sets;
    std::vector<OrdinateShown> shown;  ///< as `light` and `near` hold them
    bool has_moments = false;  ///< the camera is among the nodes, or copies of them are seen
    float per_near = 0;        ///< OrdinatesMarchParams::per_near
    Buffer<std::int32_t> rim;  ///< empty nodes beside filled ones
    Buffer<float> samples;     ///< of the density, within nodes
    bool by_filled = false;    ///< as [filled][sample of a node]; else [sample of the whole grid]
    Buffer<float> seen;     ///< [node]: of the sun, what solids leave; of scenes with solids alone
    Buffer<float> beam;     ///< [set with a beam][filled]: sunlight, where it follows the sun
    Buffer<float> sunward;  ///< [medium][node]: of the optical depth to the sun; of several media
    OrdinateHalf half;
    Buffer<float> light;     ///< [shown][medium][node], as the march reads it
    Buffer<float> near;      ///< [shown][moment][node], likewise, with has_moments alone
    bool near_made = false;  ///< of the solutions as they are
    OrdinateGround ground;
};

/// Width of what counts as the peak of a phase function, and 1 - cos of it.
constexpr double kOrdinatePeakDeg = 20;
float ordinate_peak();

/// Most nodes that there are, and most samples of the density within one, along each axis.
constexpr double kMaxOrdinateNodes = 40000;
constexpr int kMaxOrdinateSamples = 4;

/// Nodes over a medium: so near that extinction that counts is below one a node, where their number
/// allows that.
NodeGrid ordinate_grid(const Medium& medium, double rest);

/// Samples of the density within nodes, so near that they see every voxel where few enough do.
NodeGrid ordinate_samples(const NodeGrid& grid, const Medium& medium);

/// No fewer nodes than any phase function brings, and samples within them.
std::uint64_t max_ordinate_nodes(const Medium& medium);
std::uint64_t max_ordinate_samples(const Medium& medium);

namespace arrays {

inline Array<float> ordinate_solution(std::uint64_t nodes, std::uint64_t sets) {
    return {"ordinates: moments on nodes", bytes_of(sets * kOrdinateMoments, nodes), Stage::kShadow,
            Stage::kWrite};
}
/// Towards the camera; each medium has its own.
inline Array<float> ordinate_light(std::uint64_t nodes, std::uint64_t sets, int media) {
    return {"ordinates: light on nodes", bytes_of(sets * std::uint64_t(media), nodes),
            Stage::kShadow, Stage::kWrite};
}
inline Array<float> ordinate_near(std::uint64_t nodes, std::uint64_t sets, bool any) {
    return {"ordinates: light near the camera", any ? bytes_of(sets * kOrdinateMoments, nodes) : 0,
            Stage::kShadow, Stage::kWrite};
}
/// Before it is known which nodes hold medium.
inline Array<float> ordinate_all_densities(std::uint64_t samples) {
    return {"ordinates: density within all nodes", samples, Stage::kMajorants, Stage::kMajorants};
}
/// Densities, which stay, or depths towards the sun.
inline Array<float> ordinate_densities(std::uint64_t samples) {
    return {"ordinates: density within nodes", samples, Stage::kShadow, Stage::kWrite};
}
inline Array<float> ordinate_depths(std::uint64_t samples) {
    return {"ordinates: sunlight within nodes", samples, Stage::kShadow, Stage::kShadow};
}
/// Of whole nodes: densities, which stay, or the beam, or light before it is spread.
inline Array<float> ordinate_nodes(std::uint64_t nodes, Stage last) {
    return {"ordinates: numbers of nodes", nodes, Stage::kShadow, last};
}
/// Of sets with a beam.
inline Array<float> ordinate_beams(std::uint64_t nodes, int sets) {
    return {"ordinates: sunlight on nodes", bytes_of(std::uint64_t(sets), nodes), Stage::kShadow,
            Stage::kWrite};
}
/// Of the sun, what solids leave.
inline Array<float> ordinate_seen(std::uint64_t nodes) {
    return {"ordinates: shadow of solids", nodes, Stage::kShadow, Stage::kWrite};
}
/// Which nodes hold medium; or where they are in slices along x.
inline Array<std::int32_t> ordinate_places(std::uint64_t nodes, Stage last) {
    return {"ordinates: places of nodes", nodes, Stage::kShadow, last};
}
inline Array<std::int32_t> ordinate_rim(std::uint64_t nodes) {
    return {"ordinates: rim of nodes", nodes, Stage::kShadow, Stage::kWrite};
}
/// Parts of the density, and of the depth towards the sun, by medium.
inline Array<float> ordinate_parts(std::uint64_t nodes, int media) {
    return {"ordinates: parts of the media", media > 1 ? bytes_of(std::uint64_t(media), nodes) : 0,
            Stage::kShadow, Stage::kWrite};
}
/// Parts of the extinction that counts.
inline Array<float> ordinate_part_work(std::uint64_t nodes, int media) {
    return renamed(ordinate_parts(nodes, media), "ordinates: parts at work", Stage::kShadow,
                   Stage::kShadow);
}
/// What lamps and media send from nodes, by direction.
inline Array<float> ordinate_own(std::uint64_t nodes, bool any) {
    return {"ordinates: light of lamps", any ? bytes_of(kOrdinates, nodes) : 0, Stage::kShadow,
            Stage::kShadow};
}
/// Of sets that are shown together.
inline Array<float> ordinate_together(std::uint64_t nodes, bool any) {
    return {"ordinates: moments together", any ? bytes_of(kOrdinateMoments, nodes) : 0,
            Stage::kShadow, Stage::kShadow};
}
/// By a set, or by a channel.
inline Array<float> ordinate_ground(std::uint64_t cells, std::uint64_t sets) {
    return {"ordinates: light on the ground", bytes_of(sets, cells), Stage::kShadow, Stage::kWrite};
}
/// Of the sun, on every second cell.
inline Array<float> ordinate_ground_sun(std::uint64_t cells) {
    return {"ordinates: sunlight on the ground", cells, Stage::kShadow, Stage::kShadow};
}
/// Radiance by direction and factors of ways; of those that hold medium what iterations are mixed
/// of.
inline Array<float> ordinate_work(std::uint64_t nodes, std::uint64_t filled) {
    constexpr std::uint64_t kMixed = 2 * kSlowMoments + kMixedIterations * (kSlowMoments + 1) + 1;
    return {
        "ordinates: one solution at work",
        sum_of_bytes(bytes_of(kOrdinates + 2 * kOrdinateClasses, nodes), bytes_of(kMixed, filled)),
        Stage::kShadow, Stage::kShadow};
}

/// What enters a ring, by direction, and which nodes it is.
inline Array<float> ordinate_ring(std::uint64_t nodes) {
    return {"ordinates: light of a ring", bytes_of(kOrdinates, nodes), Stage::kShadow,
            Stage::kShadow};
}

}  // namespace arrays

/// Memory that is large enough is kept.
inline Status hold(const Array<float>& array, Buffer<float>& buffer) {
    return buffer.size() >= array.count ? Status::ok() : allocate(array, buffer);
}

/// Optics of a medium; f: the peak's share.
OrdinateOptics ordinate_optics(const Optics& optics, int channel, double f);

/// What a picture does of light that follows the sun over several of them: nodes whose number
/// modulo `slices` is due see the sun where it stands. Then light is solved for, or what leaves the
/// nodes for the ground.
struct OrdinateFollow {
    int slices = 1;
    std::vector<int> due;
    bool solve = true;  ///< false: the ground
};

/// Of lamps whose light has one colour.
constexpr int kLampStrength = 4;

/// Nodes around, twice as wide along x and y and as many upwards, whose light enters at a ring.
struct OrdinateCoarser {
    const OrdinateCells* nodes = nullptr;
    const OrdinateCells* larger = nullptr;  ///< their own larger ones
    double first[2] = {}, step[2] = {};  ///< of the finer ones: middle of the first, in its nodes
};

/// How a solution is found. Light that enters as before and has no beam keeps its own.
struct OrdinateAsk {
    const SunDepth* sun = nullptr;  ///< depths towards it, read between voxels; null: rays
    int iterations = 0;  ///< > 0: so many at most, from the last solution on; 0: all, from none
    const LampNodes* lamps = nullptr;  ///< of these so many shine; null: none
    std::size_t first_lamp = 0, lamp_count = 0;
    int beside = -1;        ///< one more of them; -1: none
    bool emission = false;  ///< media shine
    bool ground =
        false;  ///< light on the ground is wanted; it then sends up its mean below the medium
    /// Out: optical depths to the sun from samples; null: unwanted.
    Buffer<float>* depths = nullptr;
    bool sampled = false;                    ///< these are there already
    int only = -1;                           ///< set that is solved for; -1: all
    const OrdinateFollow* follow = nullptr;  ///< null: all of it
    bool keeps_beam = false;  ///< OrdinateNodes::beam stays, for pictures that follow
    OrdinateCoarser coarser;  ///< of a ring
};

/// Calls use(index among ask.lamps) for each that shines.
template <class Use>
void each_lamp(const OrdinateAsk& ask, const Use& use) {
    for (std::size_t i = 0; i < ask.lamp_count; ++i) use(ask.first_lamp + i);
    if (ask.beside >= 0) use(std::size_t(ask.beside));
}

/// Radiances that enter, by light or, where channels differ, by channel. `walls`: solids end ways.
void set_ordinate_lights(const Medium& medium, const Lighting& lighting, const OrdinateAsk& ask,
                         bool walls, std::vector<OrdinateSet>& out);
/// 3: channels are solved for by themselves, for media or solids are coloured; else 1.
int light_channels(const Medium& medium, const Lighting& lighting, bool walls);
/// Number of sets, at most; `ground`: OrdinateAsk::ground.
int ordinate_sets(const Medium& medium, const Lighting& lighting, bool ground, int channels);

/// Unit vector of the way of light in a direction, and its solid angle.
std::array<double, 3> ordinate_direction(int j);
double ordinate_weight(int j);
bool goes_up(int j);
/// Such a way within a direction's part of the sphere, at shares of its height and its azimuth.
std::array<double, 3> ordinate_part(int j, double height, double azimuth);

/// Spherical harmonics of all directions.
void set_ordinate_harmonics(float (&out)[kOrdinates][kOrdinateMoments]);
/// What moments of light become that is scattered into each direction, by shares of degrees:
/// `whole` in all, though parts of a phase function of so few degrees are negative; none below 0.
void scatter_moments(const float (&moments)[kOrdinateMoments], const float (&kept)[4],
                     const float (&harmonic)[kOrdinates][kOrdinateMoments], float whole,
                     float (&out)[kOrdinates]);

/// Ways through nodes that are alike, and in slices along x or not.
struct OrdinateWay {
    double length_m = 0;
    bool along_x = false;
};

/// Ways of all directions through nodes of such a size.
void set_ordinate_sweeps(const NodeGrid& grid, bool periodic, OrdinateWay (&way)[kOrdinateClasses],
                         OrdinatesParams& k);

/// Solids among nodes, and the ground that they stand on.
struct OrdinateSolids {
    const Solids* meshes = nullptr;      ///< null: none
    double ground_z = -__builtin_inf();  ///< m, box-local; -infinity: none
};
OrdinateSolids ordinate_solids(const Lighting& lighting);

/// Nodes and what lies in them, which no light changes. `points`: the beam has tables for lamps
/// that have a place, too. kLimit: out of memory.
Status prepare_ordinates(const Context& context, const Medium& medium, const Majorants& majorants,
                         const OrdinateSolids& solids, bool points, OrdinateNodes& out);
/// Optics and tables of the beam alone.
Status prepare_optics(const Context& context, const Medium& medium, bool points,
                      OrdinateNodes& out);
/// Largest optical depth of a node's shortest edge that counts.
double node_depth(const Medium& medium, const OrdinateNodes& nodes);
/// Memory for any lights and cameras, so that frames keep none. kLimit: out of memory.
Status reserve_ordinates(OrdinateNodes& out);

/// Change of the mean radiance over its norm by an iteration that is the last.
constexpr double kSolvedChange = 2e-4;
/// Of a host's picture whose light follows its sun.
constexpr int kFollowedIterations = 3;

/// OrdinatesMarchParams::per_near of nodes with such edges, beyond which the camera is outside.
constexpr double kNearNodes = 2;
float ordinate_per_near(const NodeGrid& grid);

/// Whether some solution has not come to its end.
bool unsolved(const OrdinateNodes& nodes);

/// Solves for the lights there are. The nodes are prepared. kLimit: out of memory.
Status make_ordinates(const Context& context, const Medium& medium, const Majorants& majorants,
                      const Lighting& lighting, const OrdinateAsk& ask, OrdinateNodes& out);

/// Numbers of a node that a march of a camera reads: one a medium towards it, or all moments.
bool sees_moments(const Medium& medium, const CameraParams& camera, const NodeGrid& grid);

/// Every set by itself.
void show_each(OrdinateNodes& nodes);

/// Finds OrdinateNodes::rim. kLimit: out of memory.
Status find_rim(const Context& context, bool periodic, OrdinateNodes& out);

/// nodes.light, of what one medium's whole phase function, without its albedo, scatters of all
/// light but the first of the sun and lamps towards a camera. kLimit: out of memory.
Status turn_light(const Context& context, const Medium& medium, const CameraParams& camera,
                  OrdinateNodes& nodes);

/// Light as the march of a camera reads it; `together`: no more than kMaxShown. kLimit: out of
/// memory.
Status turn_ordinates(const Context& context, const Medium& medium, const CameraParams& camera,
                      bool together, OrdinateNodes& nodes);

}  // namespace pileus
