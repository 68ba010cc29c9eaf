// SPDX-License-Identifier: Apache-2.0
// What the columns of the support table cannot hold: features that exclude one another, and what
// runs methods. in: nothing -> out: rows of src/methods/support.h. docs/support.md
#include "src/methods/support/make_rows.h"

namespace pileus {
namespace {

using namespace support_rows;

constexpr unsigned bit(MethodColumn column) { return 1u << int(column); }
constexpr unsigned kAll = (1u << kMethodColumns) - 1;
constexpr unsigned kByCollectors =
    bit(MethodColumn::kCollectors) | bit(MethodColumn::kCollectorBillboards);
constexpr unsigned kByPhotons = kByCollectors | bit(MethodColumn::kPhotonGrid);
constexpr unsigned kGrid = bit(MethodColumn::kPhotonGrid);
constexpr unsigned kMarch = bit(MethodColumn::kRaymarch) | bit(MethodColumn::kOpticalDepth);
constexpr unsigned kPaths = bit(MethodColumn::kPath), kSkies = bit(MethodColumn::kCloudSkies);

constexpr PairRow kPairRows[] = {
    {"[[light]] and [[solid]]", kByPhotons | kMarch, ""},
    {"[[light]] and periodic media, a sky in place, marched detail", kAll, ""},
    {"[[light]] whose sphere reaches below the ground, with shadow_samples > 1", kAll, ""},
    {"emission and transfer, a sky in place", kAll, ""},
    {"orthographic camera and [atmosphere]", kAll, ""},
    {"layers light, order and [atmosphere]", kAll, ""},
    {"scale, temporal and layers error, light, order", kByPhotons | bit(MethodColumn::kRaymarch),
     ""},
    {"filter and projection flux, layer light; oidn and layer error", kPaths, ""},
    {"closure = \"camera\" and a camera that moves in a film", kByPhotons, ""},
    {"closure = \"camera\" and set_camera", kByCollectors, ""},
    {"closure = \"camera\" and a phase function of g = 1 or -1", kByPhotons, ""},
    {"closure = \"camera\" and several media", kGrid, ""},
    {"closure = \"camera\" in a kind of clouds", kSkies, ""},
    {"closures but sh and periodic media in perspective", kByPhotons, ""},
    {"--budget error and a film", kGrid, ""},
    {"set_placement or keys of media and [[solid]]", kAll, ""},
    {"turned media and a sky map or [atmosphere]", kAll, ""},
    {"media, places of clouds, cameras, spheres of lamps and the ground above them", kAll, ""},
    {"keys of media and [clouds]", kSkies, ""},
    {"method, sky.map, camera.depth, lens, shutter and [clouds]", kSkies, ""},
    {"camera.depth without # and a camera that moves", kAll, ""},
    {"marched detail and several media, transfer, constant cells", kAll, ""},
    {"a sky in place and several media, transfer, constant cells, detail",
     bit(MethodColumn::kRaymarch), ""},
    {"set_ground that adds or takes the ground and a sky map", kAll, ""},
};

constexpr const char* kNoView = "it measures a box, not a camera's view";
constexpr const char* kOfHosts = "a call of a host's session";

constexpr RunnerRow kRunnerRows[] = {
    runner_row("collectors, path", exact("the same bits"), exact(), exact(), exact()),
    runner_row("photon-grid, raymarch, optical-depth, particles", refused(), exact(), exact(),
               refused()),
    runner_row("filter", refused(), exact("regression; oidn is refused"), exact(), refused()),
    runner_row("path.importance", exact("on the host"), refused("when it is packed"), exact(),
               exact("paths one by one")),
    runner_row("[[light]], emission", refused(),
               exact("refused by a library that is built without"), exact(), refused()),
    runner_row("[[solid]]", refused(), refused("when it is packed"), exact(), refused()),
    runner_row("camera.depth from a file", refused(), refused("when it is packed"), exact(),
               exact(kNoView)),
    runner_row("set_depth", refused(), exact(), refused(kOfHosts), refused(kOfHosts)),
    runner_row("scale, temporal, light_refresh", refused(), exact(), exact(), exact(kNoView)),
    runner_row("marched detail", refused(), refused("when it is packed"), refused(), refused()),
    runner_row("[atmosphere]", refused(), exact("set_sun, set_ground are refused"), exact(),
               exact("no air between")),
    runner_row("sky in place", refused(), exact(), refused(), exact("on a grid")),
    runner_row("animation, sequences", exact(), refused("when it is packed"), exact(),
               bounded("the first frame")),
    runner_row("layers but depth", exact("shadow is refused"), refused(),
               exact("the picture's light is compared"), exact(kNoView)),
    runner_row("compositors of OpenGL", exact(), refused("when it is packed"), refused(kOfHosts),
               refused(kOfHosts)),
    runner_row("cloud skies", refused(), refused(), refused(), refused()),
    runner_row("hand-over", exact(), refused(), refused(kOfHosts), refused(kOfHosts)),
};

constexpr const char* kRunnerNames[] = {"device", "flight", "verify", "flux"};
static_assert(sizeof kRunnerNames / sizeof kRunnerNames[0] == kRunners, "a name for every runner");

}  // namespace

const PairRow* support_pairs(std::size_t& count) {
    count = sizeof kPairRows / sizeof kPairRows[0];
    return kPairRows;
}

bool excludes(FeaturePair pair, MethodColumn column) {
    return (kPairRows[std::size_t(pair)].columns & bit(column)) != 0;
}

const RunnerRow* support_runners(std::size_t& count) {
    count = sizeof kRunnerRows / sizeof kRunnerRows[0];
    return kRunnerRows;
}

const char* runner_name(Runner runner) { return kRunnerNames[std::size_t(runner)]; }

}  // namespace pileus
