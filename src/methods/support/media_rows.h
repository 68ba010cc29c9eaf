// SPDX-License-Identifier: Apache-2.0
// Media and their phase functions.
// in: nothing -> out: rows of the support table, entries in the order of MethodColumn.
// docs/support.md
#pragma once
#include "src/methods/support/make_rows.h"

namespace pileus {
namespace support_rows {

constexpr Support kOneOfParticles = refused("method particles shows one medium of particles",
                                            "one [[medium]] whose density is a file of particles");
constexpr Support kOnceEach = refused("method particles shows each particle once", "left out");
constexpr Support kNoGrid = refused("particles have no grid", "left out, or another method");
constexpr Support kOnGrid = refused("not here", "\"grid\", or method raymarch");
constexpr Support kOneAlbedo =
    bounded("one albedo and emission for all, with a warning: docs/particles.md");

constexpr FeatureRow kMediaRows[] = {
    row(Feature::kSeveral, FeatureGroup::kOfMedia, "several [[medium]]", "medium.N", "", exact(),
        exact(), exact("closure = \"camera\" is refused"), exact(), exact(),
        exact("max_extinction_per_m is refused"), kOneOfParticles, kOneOfParticles, exact()),
    row(Feature::kColoured, FeatureGroup::kOfMedia, "coloured albedo", "medium.N.albedo", "",
        exact(), exact(), exact(), exact("0.15 %"), bounded("-1 to +7 % of a colour"),
        bounded("as the sun: by design"), bounded("one value a ball: -20 % of a colour"),
        bounded("one value a ball: -23 % of a colour"), bounded("as its kinds")),
    row(Feature::kPeriodic, FeatureGroup::kOfMedia, "boundary = \"periodic\"", "medium.N.boundary",
        "", exact("closures lobe, camera: orthographic alone"),
        refused("not for periodic media", "march"), exact("closures but sh: orthographic alone"),
        exact(), exact(), exact(), kOnceEach, kOnceEach,
        refused("a scene without media, or with one that has no end", "media in boxes")),
    row(Feature::kConstantCells, FeatureGroup::kOfMedia, "interpolation = \"constant\"",
        "medium.N.interpolation", "", bounded("thick cells: -59 % for a box of one cell"),
        bounded("boards reach beyond a cell: as collectors"), bounded("as collectors"), exact(),
        bounded("-5 to +5 %; thick cells as a warning tells"), bounded("as the sun: by design"),
        bounded("as the sun"), bounded("as the sun"), bounded("as its kinds")),
    row(Feature::kTransferRows, FeatureGroup::kOfMedia, "medium.transfer", "medium.N.transfer", "",
        exact(), exact(), exact(), exact(), exact(), exact(), kOneOfParticles, kOneOfParticles,
        exact()),
    row(Feature::kDetailBaked, FeatureGroup::kOfMedia, "medium.detail, refine >= 1",
        "medium.N.detail.tile_m", "", exact(), exact(), exact(), exact(), exact(), exact(), kNoGrid,
        kNoGrid, exact()),
    row(Feature::kDetailMarched, FeatureGroup::kOfMedia, "medium.detail, refine = 0",
        "medium.N.detail.refine", "", bounded("photons fly without: -0.1 to -0.9 %"),
        refused("billboards are not marched", "1 to 16"), bounded("as collectors"),
        refused("method path does not march", "1 to 16"), bounded("-0.3 to -0.8 %"),
        bounded("as raymarch"), kNoGrid, kNoGrid, bounded("as its kinds")),
    row(Feature::kSkyInPlace, FeatureGroup::kOfMedia, "procedural sky, evaluate = \"direct\"",
        "medium.N.sky.evaluate", "", kOnGrid, kOnGrid, kOnGrid, kOnGrid, exact(), kOnGrid, kOnGrid,
        kOnGrid, refused("a scene without media, or with one that has no end", "media in boxes")),
    row(Feature::kSkyOnGrid, FeatureGroup::kOfMedia, "procedural sky, evaluate = \"grid\"",
        "medium.N.sky.evaluate", "", exact(), exact(), exact(), exact(), exact(), exact(),
        kOneOfParticles, kOneOfParticles, exact()),
    row(Feature::kParticlesOnGrid, FeatureGroup::kOfMedia, "a medium of particles",
        "medium.N.density", "", bounded("of the grid, 0.1 % on a fine one"),
        bounded("of the grid, 0.1 % on a fine one"), bounded("of the grid, 0.1 % on a fine one"),
        bounded("+0.1 % on a fine grid"), bounded("of the grid, 0.1 % on a fine one"),
        bounded("of the grid, 0.1 % on a fine one"), exact(), exact(), bounded("as its kinds")),
    row(Feature::kParticleColumns, FeatureGroup::kOfMedia,
        "colours, emission, velocities of particles", "", "", kOneAlbedo, kOneAlbedo, kOneAlbedo,
        kOneAlbedo, kOneAlbedo, kOneAlbedo, exact("velocities: billboards alone"), exact(),
        kOneAlbedo),
    row(Feature::kWeather, FeatureGroup::kOfMedia, "weather data", "medium.N.density", "", exact(),
        exact(), exact(), exact(), exact(), exact(), kOneOfParticles, kOneOfParticles, exact()),
    row(Feature::kMediaMove, FeatureGroup::kOfMedia, "media moved by keys or set_placement",
        "animation.keys", "below the ground refused", exact(), exact(), exact(), exact(), exact(),
        exact(), exact(), exact(), exact("by places; keys are refused")),
    row(Feature::kSequence, FeatureGroup::kOfMedia, "sequences of files, wind", "medium.N.density",
        "sessions show the first file", exact(), exact(), exact(), exact(), exact(), exact(),
        exact(), exact(), refused("a kind of clouds has one file in a film", "one file")),
    row(Feature::kPhaseSmooth, FeatureGroup::kOfPhase,
        "isotropic, rayleigh, henyey-greenstein, two-lobe, cornette-shanks to g 0.9",
        "medium.N.phase", "", bounded("as the sun"), bounded("as the sun"), bounded("as the sun"),
        exact("0.2 %"), bounded("as the sun; octaves +835 % at depth 0.04"),
        bounded("as the sun: its own g, docs/optical-depth.md"),
        bounded("as the sun; x 9.5 when thin, by octaves"), bounded("as the sun"),
        bounded("as its kinds")),
    row(Feature::kPhaseNarrow, FeatureGroup::kOfPhase,
        "hg-draine, cloud, table, moments, g above 0.9", "medium.N.phase",
        "no pixel brighter than its lights allow; on boards, by particles and by other closures "
        "than "
        "sh g above 0.95 a third too dark along thin decks and several times too bright where "
        "little light gets to, with a warning",
        bounded("by angle -6 to +6 %; g above 0.95 along thin decks -24 %"),
        bounded("by angle -19 to +26 %"), bounded("as collectors"), exact("0.9 % below 176 deg"),
        bounded("-5 to +5 %; octaves by angle -52 to +56 %"),
        bounded("as the sun: its own g, docs/optical-depth.md"),
        bounded("as the sun; +7 %; g above 0.95 +44 %, with a warning"), bounded("as particles"),
        bounded("as its kinds")),
};

}  // namespace support_rows
}  // namespace pileus
