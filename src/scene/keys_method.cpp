// SPDX-License-Identifier: Apache-2.0
// Rows of the key table for how light is computed.
// in: checked TOML values -> out: fields of Scene, CollectorSettings, PathSettings.
// docs/scene.md.
#include "src/scene/scene_keys.h"

namespace pileus {
namespace {

constexpr KeyRange kShare{0, 1, false, false};
constexpr double kManyPhotons = 0x1p40, kManySamples = 0x1p32;

const KeyRow kRows[] = {
    choice_key(KeyKind::kText, "method.name", "\"collectors\"", kAvailableMethods, kKnownMethods,
               "how the light is computed; each method has a table of its own name, and the tables "
               "of other methods are left alone",
               [](const Node& n, KeyTarget t) { t.scene.method = n.text; }),

    range_key(KeyKind::kInteger, "collectors.photons", "", "5_000_000",
              {0, kManyPhotons, false, false}, "over the whole ring of generations",
              [](const Node& n, KeyTarget t) { t.scene.collectors.photons = integer_of(n); }),
    range_key(KeyKind::kInteger, "collectors.generations", "", "50", {1, 1000, false, false},
              "length of the ring; one generation shoots photons / generations",
              [](const Node& n, KeyTarget t) {
                  t.scene.collectors.generations = static_cast<int>(integer_of(n));
              }),
    range_key(KeyKind::kInteger, "collectors.bands", "", "4", {1, 8, false, false},
              "bands of spherical harmonics that a collector keeps",
              [](const Node& n, KeyTarget t) {
                  t.scene.collectors.bands = static_cast<int>(integer_of(n));
              }),
    range_key(KeyKind::kInteger, "collectors.axis_degrees", "", "8", {0, 16, false, false},
              "degrees beyond the bands that a collector keeps of the light around the sun's "
              "direction, up to degree 15; closure `sh` and variant `best` only",
              [](const Node& n, KeyTarget t) {
                  t.scene.collectors.axis_degrees = static_cast<int>(integer_of(n));
              }),
    range_key(KeyKind::kInteger, "collectors.samples", "", "20_000", {1, 10000000, false, false},
              "points from which the collectors are grown",
              [](const Node& n, KeyTarget t) {
                  t.scene.collectors.samples = static_cast<int>(integer_of(n));
              }),
    choice_key(
        KeyKind::kText, "collectors.tracking", "\"local\"", "local|global", nullptr,
        "majorant of the free flights: one per block of cells, or one for all",
        [](const Node& n, KeyTarget t) { t.scene.collectors.local_tracking = n.text == "local"; }),
    choice_key(
        KeyKind::kText, "collectors.closure", "\"sh\"", "sh|lobe|camera", nullptr,
        "how the light is read: all bands, one lobe from flux and mean direction, or cells lit "
        "towards a fixed camera",
        [](const Node& n, KeyTarget t) {
            t.scene.collectors.lobe_closure = n.text == "lobe";
            t.scene.collectors.camera_closure = n.text == "camera";
        }),
    range_key(KeyKind::kInteger, "collectors.cell_voxels", "cells", "2", {1, 64, false, false},
              "edge of a cell of closure `camera`, in cells of the density",
              [](const Node& n, KeyTarget t) {
                  t.scene.collectors.cell_voxels = static_cast<int>(integer_of(n));
              }),
    choice_key(KeyKind::kText, "collectors.variant", "\"best\"", "best|paper", nullptr,
               "`paper`: the method as first published; then display, sampler and "
               "first_order_split have the defaults \"billboards\", \"rejection\" and false",
               [](const Node& n, KeyTarget t) { t.scene.collectors.paper = n.text == "paper"; }),
    choice_key(
        KeyKind::kText, "collectors.display", "\"march\"", "march|billboards", nullptr,
        "how the lit collectors become a picture",
        [](const Node& n, KeyTarget t) { t.scene.collectors.billboards = n.text == "billboards"; }),
    choice_key(KeyKind::kText, "collectors.compositor", "\"builtin\"", "builtin|osmesa|egl",
               nullptr,
               "who blends billboards: pileus, or OpenGL by a foreign library, to compare; its "
               "pictures agree to a tolerance and have no promised bits",
               [](const Node& n, KeyTarget t) {
                   t.scene.collectors.compositor = n.text == "osmesa" ? Compositor::kOsmesa
                                                   : n.text == "egl"  ? Compositor::kEgl
                                                                      : Compositor::kBuiltin;
               }),
    choice_key(KeyKind::kText, "collectors.sampler", "\"stratified\"", "stratified|rejection",
               nullptr, "how the sample points are drawn",
               [](const Node& n, KeyTarget t) {
                   t.scene.collectors.rejection_sampler = n.text == "rejection";
               }),
    choice_key(KeyKind::kText, "collectors.placement", "\"gradient\"", "gradient|variance", nullptr,
               "what the density of sample points follows",
               [](const Node& n, KeyTarget t) {
                   t.scene.collectors.variance_field = n.text == "variance";
               }),
    range_key(KeyKind::kInteger, "collectors.variance_radius", "cells", "2", {1, 8, false, false},
              "half width of the neighbourhood whose variance is taken",
              [](const Node& n, KeyTarget t) {
                  t.scene.collectors.variance_radius = static_cast<int>(integer_of(n));
              }),
    range_key(KeyKind::kNumber, "collectors.density_range", "", "0.1", kShare,
              "a node whose densities differ by less is split no further",
              [](const Node& n, KeyTarget t) { t.scene.collectors.density_range = number_of(n); }),
    range_key(
        KeyKind::kNumber, "collectors.influence_radius", "diagonals", "0.05", {0, 1, true, false},
        "radius of influence of a sample, as a share of the box's "
        "diagonal",
        [](const Node& n, KeyTarget t) { t.scene.collectors.influence_radius = number_of(n); }),
    range_key(KeyKind::kNumber, "collectors.radius_factor", "", "1.35", {1, 3, false, false},
              "radius of a billboard over its collector's; variant `best` only",
              [](const Node& n, KeyTarget t) { t.scene.collectors.radius_factor = number_of(n); }),
    plain_key(KeyKind::kBool, "collectors.first_order_split", "true",
              "true: light straight from the sun is kept apart, with its exact direction",
              [](const Node& n, KeyTarget t) { t.scene.collectors.first_order_split = n.flag; }),
    plain_key(KeyKind::kBool, "collectors.window", "false",
              "true: damps the higher bands against ringing",
              [](const Node& n, KeyTarget t) { t.scene.collectors.window = n.flag; }),
    choice_key(
        KeyKind::kText, "collectors.accumulation", "\"auto\"", "auto|private|shared", nullptr,
        "sums per thread, or one set that all threads add to atomically, slower but "
        "smaller; `auto`: per thread up to a quarter of the limit of memory. The same "
        "bits either way",
        [](const Node& n, KeyTarget t) {
            t.scene.collectors.accumulation = n.text == "private"  ? AccumulationChoice::kPrivate
                                              : n.text == "shared" ? AccumulationChoice::kShared
                                                                   : AccumulationChoice::kAuto;
        }),

    range_key(KeyKind::kInteger, "path.samples_per_pixel", "", "64",
              {1, kManySamples, false, false}, "paths for each pixel",
              [](const Node& n, KeyTarget t) { t.scene.path.samples_per_pixel = integer_of(n); }),
    range_key(KeyKind::kInteger, "path.max_depth", "", "0", {0, 1000000, false, false},
              "scatterings after which light is not followed; 0: unlimited, without bias",
              [](const Node& n, KeyTarget t) {
                  t.scene.path.max_depth = static_cast<int>(integer_of(n));
              }),
    choice_key(KeyKind::kText, "path.pixel", "\"box\"", "box|centre", nullptr,
               "where a pixel's rays go: spread evenly over it, or all through its centre, as "
               "the other methods send theirs",
               [](const Node& n, KeyTarget t) { t.scene.path.centre = n.text == "centre"; }),
    range_key(KeyKind::kNumber, "path.target_error", "", "0", {0, 1, false, false},
              "ends where the standard error over the radiance, its mean over the cloud's "
              "pixels, is no more than this; 0: after samples_per_pixel",
              [](const Node& n, KeyTarget t) { t.scene.path.target_error = number_of(n); }),
    range_key(
        KeyKind::kInteger, "path.max_samples_per_pixel", "", "65_536",
        {1, kManySamples, false, false},
        "the most where target_error or --budget error or seconds decides",
        [](const Node& n, KeyTarget t) { t.scene.path.max_samples_per_pixel = integer_of(n); }),
};

}  // namespace

Span<const KeyRow> method_keys() { return {kRows, sizeof kRows / sizeof kRows[0]}; }

}  // namespace pileus
