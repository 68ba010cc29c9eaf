// SPDX-License-Identifier: Apache-2.0
// Keys of method `collectors`.
// in: checked values <-> out: fields of CollectorSettings.
// docs/scene.md; docs/collectors.md says what they do.
#include "src/scene/keys/upsample_keys.h"

namespace pileus {
namespace {

template <auto... Members>
constexpr KeyField collectors = field<&Scene::collectors, Members...>;
template <auto Member>
constexpr KeyField placement = collectors<&CollectorSettings::placement, Member>;
template <auto Member>
constexpr KeyField closure = collectors<&CollectorSettings::closure, Member>;
template <auto Member>
constexpr KeyField display = collectors<&CollectorSettings::display, Member>;

constexpr KeyField kTracking{
    KeyKind::kChoice,
    [](const KeySource& s) { return node_of(!s.scene.collectors.local_tracking); },
    [](const KeyTarget& t, const Node& n) { t.scene.collectors.local_tracking = !n.flag; }};

constexpr KeyField kClosure{KeyKind::kChoice,
                            [](const KeySource& s) {
                                const CollectorSettings& c = s.scene.collectors;
                                return node_of(c.closure.camera ? 2 : int(c.closure.lobe));
                            },
                            [](const KeyTarget& t, const Node& n) {
                                t.scene.collectors.closure.lobe = n.integer == 1;
                                t.scene.collectors.closure.camera = n.integer == 2;
                            }};

constexpr KeyRow kRows[] = {
    {"collectors.photons", collectors<&CollectorSettings::photons>, from_to(0, 0x1p40), "",
     "over the whole ring of generations"},
    {"collectors.generations", collectors<&CollectorSettings::generations>, from_to(1, 1000), "",
     "length of the ring; one generation shoots photons / generations"},
    {"collectors.bands", closure<&CollectorClosure::bands>, from_to(1, 8), "",
     "bands of spherical harmonics that a collector keeps"},
    {"collectors.axis_degrees", closure<&CollectorClosure::axis_degrees>, from_to(0, 16), "",
     "degrees beyond the bands that a collector keeps of the light around the "
     "directions of the sun and of four lamps, up to degree 15; closure `sh` and variant `best` "
     "only"},
    {"collectors.peak_deg", collectors<&CollectorSettings::peak_deg>, from_to(0, 90), "deg",
     "scatterings that turn light of sun and lamps by less stay in its beam, which the march shows "
     "by small-angle theory, and other light goes on as it came; 0: none do"},
    {"collectors.samples", placement<&CollectorPlacement::samples>, from_to(1, 10000000), "",
     "points from which the collectors are grown"},
    {"collectors.tracking", kTracking, one_of("local|global"), "",
     "majorant of the free flights: one per block of cells, or one for all"},
    {"collectors.closure", kClosure, one_of("sh|lobe|camera"), "",
     "how the light is read: all bands, one lobe from flux and mean direction, or cells lit "
     "towards a fixed camera"},
    {"collectors.cell_voxels", closure<&CollectorClosure::cell_voxels>, from_to(1, 64), "cells",
     "edge of a cell of closure `camera`, in cells of the density"},
    {"collectors.variant", collectors<&CollectorSettings::paper>, one_of("best|paper"), "",
     "`paper`: the method as first published; then display, sampler and "
     "first_order_split have the defaults \"billboards\", \"rejection\" and false"},
    {"collectors.display", display<&CollectorDisplay::billboards>, one_of("march|billboards"), "",
     "how the lit collectors become a picture"},
    {"collectors.node_filter", display<&CollectorDisplay::guided_nodes>,
     one_of("surroundings|guided"), "",
     "what nodes lean on that few photons met: the mean around them, or a fit over what is known "
     "there without noise (docs/collectors.md); of the marched picture alone"},
    {"collectors.directions", display<&CollectorDisplay::directions>, one_of("near|camera|all"), "",
     "of what nodes show to a perspective camera: the light along the line to it; the same but for "
     "nodes around a camera within or beside a medium, whose light is read along each ray; or that "
     "of all nodes (periodic media always do)"},
    {"collectors.compositor", display<&CollectorDisplay::compositor>, one_of("builtin|osmesa|egl"),
     "",
     "who blends billboards: pileus, or OpenGL by a foreign library, to compare; its "
     "pictures agree to a tolerance and have no promised bits"},
    {"collectors.sampler", placement<&CollectorPlacement::rejection_sampler>,
     one_of("stratified|rejection"), "", "how the sample points are drawn"},
    {"collectors.placement", placement<&CollectorPlacement::variance_field>,
     one_of("gradient|variance"), "", "what the density of sample points follows"},
    {"collectors.variance_radius", placement<&CollectorPlacement::variance_radius>, from_to(1, 8),
     "cells", "half width of the neighbourhood whose variance is taken"},
    {"collectors.density_range", placement<&CollectorPlacement::density_range>, from_to(0, 1), "",
     "a node whose densities differ by less is split no further"},
    {"collectors.influence_radius", placement<&CollectorPlacement::influence_radius>, positive(1),
     "diagonals",
     "radius of influence of a sample, as a share of the box's "
     "diagonal"},
    {"collectors.radius_factor", display<&CollectorDisplay::radius_factor>, from_to(1, 3), "",
     "radius of a billboard over its collector's; variant `best` only"},
    {"collectors.first_order_split", collectors<&CollectorSettings::first_order_split>, any(), "",
     "true: light straight from the sun is kept apart, with its exact direction"},
    {"collectors.window", closure<&CollectorClosure::window>, any(), "",
     "true: damps the higher bands against ringing"},
    {"collectors.scale", collectors<&CollectorSettings::thin, &UpsampleSettings::scale>,
     upsample_keys::kScales, "", upsample_keys::kScale},
    {"collectors.upsample", collectors<&CollectorSettings::thin, &UpsampleSettings::upsample>,
     one_of("depth|linear|nearest"), "", upsample_keys::kUpsample},
    {"collectors.temporal", collectors<&CollectorSettings::thin, &UpsampleSettings::temporal>,
     upsample_keys::kCells, "", upsample_keys::kTemporal},
    {"collectors.light_refresh", collectors<&CollectorSettings::light_refresh>,
     ranged(&RaymarchLightSettings::refresh), "frames", upsample_keys::kLightRefresh},
    {"collectors.accumulation", collectors<&CollectorSettings::accumulation>,
     one_of("auto|private|shared"), "",
     "sums per thread, or one set that all threads add to atomically, slower but "
     "smaller; `auto`: per thread up to a quarter of the limit of memory. The same "
     "bits either way"},
};

}  // namespace

Span<const KeyRow> collectors_keys() { return {kRows, sizeof kRows / sizeof kRows[0]}; }

}  // namespace pileus
