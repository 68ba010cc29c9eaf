// SPDX-License-Identifier: Apache-2.0
// Keys of method `photon-grid`.
// in: checked values <-> out: fields of PhotonGridSettings.
// docs/scene.md; docs/photon-grid.md says what they do.
#include "src/scene/keys/upsample_keys.h"

namespace pileus {
namespace {

template <auto... Members>
constexpr KeyField grid = field<&Scene::photon_grid, Members...>;

constexpr KeyField kTracking{
    KeyKind::kChoice,
    [](const KeySource& s) { return node_of(!s.scene.photon_grid.local_tracking); },
    [](const KeyTarget& t, const Node& n) { t.scene.photon_grid.local_tracking = !n.flag; }};

constexpr KeyRow kRows[] = {
    {"photon_grid.photons", grid<&PhotonGridSettings::photons>, from_to(0, 0x1p40), "",
     "over all generations"},
    {"photon_grid.generations", grid<&PhotonGridSettings::generations>, from_to(1, 1000), "",
     "pieces in which the photons are shot, each of photons / generations"},
    {"photon_grid.ring", grid<&PhotonGridSettings::ring>, any(), "",
     "true: an animation keeps the sums of every generation and replaces the oldest with each "
     "frame; false: one sum, and all photons anew for each frame"},
    {"photon_grid.cells", grid<&PhotonGridSettings::cells>, from_to(1, 1024), "cells",
     "cells of the photon grid along x, y, z; left out: a number that suits the photons", kNoNote},
    {"photon_grid.closure", grid<&PhotonGridSettings::closure>, one_of("sh|published|mean|camera"),
     "",
     "what a cell keeps of the directions: harmonics; flux and mean cosine to the light, as "
     "published; the mean direction; or the light scattered to a fixed camera"},
    {"photon_grid.bands", grid<&PhotonGridSettings::bands>, from_to(1, 8), "",
     "closure `sh`: bands of spherical harmonics"},
    {"photon_grid.axis_degrees", grid<&PhotonGridSettings::axis_degrees>, from_to(0, 16), "",
     "closure `sh`: degrees beyond the bands that are kept of the light around the "
     "directions of the sun and of four lamps, up to degree 15"},
    {"photon_grid.peak_deg", grid<&PhotonGridSettings::peak_deg>, from_to(0, 90), "deg",
     "scatterings that turn light of sun and lamps by less stay in its beam, which the march shows "
     "by small-angle theory, and other light goes on as it came; 0: none do"},
    {"photon_grid.tracking", kTracking, one_of("local|global"), "",
     "majorant of the free flights: one per block of cells, or one for all"},
    {"photon_grid.first_order_split", grid<&PhotonGridSettings::first_order_split>, any(), "",
     "true: light straight from the sun is left to the march, with its exact direction"},
    {"photon_grid.directions", grid<&PhotonGridSettings::directions>, one_of("near|camera"), "",
     "of what cells show to a perspective camera: the light along the line to it, or the same but "
     "for cells around a camera within or beside a medium, whose light is read along each ray"},
    {"photon_grid.scale", grid<&PhotonGridSettings::thin, &UpsampleSettings::scale>,
     upsample_keys::kScales, "", upsample_keys::kScale},
    {"photon_grid.upsample", grid<&PhotonGridSettings::thin, &UpsampleSettings::upsample>,
     one_of("depth|linear|nearest"), "", upsample_keys::kUpsample},
    {"photon_grid.temporal", grid<&PhotonGridSettings::thin, &UpsampleSettings::temporal>,
     upsample_keys::kCells, "", upsample_keys::kTemporal},
    {"photon_grid.light_refresh", grid<&PhotonGridSettings::light_refresh>,
     ranged(&RaymarchLightSettings::refresh), "frames", upsample_keys::kLightRefresh},
    {"photon_grid.accumulation", grid<&PhotonGridSettings::accumulation>,
     one_of("auto|private|shared"), "",
     "sums per thread, or one set that all threads add to atomically; `auto`: per thread up to a "
     "quarter of the limit of memory. The same bits either way"},
};

}  // namespace

Span<const KeyRow> photon_grid_keys() { return {kRows, sizeof kRows / sizeof kRows[0]}; }

}  // namespace pileus
