// SPDX-License-Identifier: Apache-2.0
// Ground, solids and cameras.
// in: nothing -> out: rows of the support table, entries in the order of MethodColumn.
// docs/support.md
#pragma once
#include "src/methods/support/make_rows.h"

namespace pileus {
namespace support_rows {

constexpr const char* kNoFlux = "measured by no method but path";
constexpr const char* kNoSea = "a sea is shown by methods path and raymarch";
constexpr const char* kSeaMethods = "land, or method.name = \"raymarch\"";
constexpr Support kNoLens =
    refused("for billboards of particles alone",
            "0, or method.name = \"particles\" and particles.display = \"billboards\"");

constexpr FeatureRow kViewRows[] = {
    row(Feature::kGround, FeatureGroup::kOfGround, "[ground]", "ground", "", exact(), exact(),
        exact(), exact(), exact(), exact(), exact(), exact(),
        bounded("-1 to -2.4 %: no light of clouds on it")),
    row(Feature::kGroundOnMedia, FeatureGroup::kOfGround, "light from the ground into media", "",
        "", exact(), exact(), exact(), exact(),
        bounded("one radiance below, one beside: 5 %; octaves: without their shadow, +8 to +18 %"),
        bounded("as the sun: an appearance without it"), bounded("as raymarch; bases -18 %"),
        bounded("as particles"), bounded("as its kinds, of a level ground without end")),
    row(Feature::kMediaOnGround, FeatureGroup::kOfGround,
        "light that media scatter onto the ground", "", "", exact(), exact(), exact(), exact(),
        bounded("64 looks up: 2 %; octaves and skies in place: left out"),
        bounded("as the sun: left out"), bounded("as raymarch by ordinates; else left out"),
        bounded("as particles"), bounded("left out: -2.4 % of the mean")),
    row(Feature::kShadowOnGround, FeatureGroup::kOfGround, "shadow of media on the ground", "", "",
        exact(), exact(), exact(), exact(), exact(), exact(), bounded("of the grid: 5 %"),
        bounded("as particles"), bounded("of each cloud's picture from the sun")),
    row(Feature::kGroundMap, FeatureGroup::kOfGround, "ground.map, ground.colour", "ground.map",
        "all but path light media by the mean", bounded("light on media: of the mean, 5 %"),
        bounded("as collectors"), bounded("as collectors"), exact(), bounded("as collectors"),
        bounded("as collectors"), bounded("as collectors"), bounded("as collectors"),
        bounded("as collectors")),
    row(Feature::kSea, FeatureGroup::kOfGround, "ground.surface sea", "ground.surface", "",
        refused(kNoSea, kSeaMethods), refused(kNoSea, kSeaMethods), refused(kNoSea, kSeaMethods),
        exact(),
        bounded("8 %: sky and clouds by a map of them from the camera's mirror image; "
                "solids are not mirrored"),
        bounded("as raymarch"), refused(kNoSea, kSeaMethods), refused(kNoSea, kSeaMethods),
        refused(kNoSea, "land")),
    row(Feature::kSolids, FeatureGroup::kOfGround, "[[solid]]", "solid.N",
        "below media as the ground there by ordinates over a ground with an albedo; else all but "
        "path: surfaces have all of the sky, x 2 below thick decks, as the plan says",
        bounded("3 %"), bounded("-2 to +4 %"), bounded("3 %"), exact(),
        bounded("sun's shadow on nodes two cells apart: -2 to +2 %"), bounded("as raymarch"),
        bounded("no sun's shadow with light = exact; 5 %"), bounded("as particles"),
        bounded("the sky's are drawn and cast no shadow on clouds, as the plan says; a kind's are "
                "refused")),
    row(Feature::kDepthImage, FeatureGroup::kOfGround, "camera.depth, set_depth", "camera.depth",
        "", exact(), exact(), exact(), exact(), exact(), exact(), exact(), exact(),
        exact("by set_depth; the key beside [clouds] is refused")),
    row(Feature::kOrthographic, FeatureGroup::kOfCamera, "camera.projection orthographic",
        "camera.projection", "", exact(), exact(), exact(), exact(), exact(), exact(), exact(),
        exact(), exact()),
    row(Feature::kFlux, FeatureGroup::kOfCamera, "camera.projection flux", "camera.projection", "",
        refused(kNoFlux, "perspective, orthographic with method collectors"),
        refused(kNoFlux, "perspective, orthographic with method collectors"),
        refused(kNoFlux, "perspective, orthographic with method photon-grid"), exact(),
        refused(kNoFlux, "perspective, orthographic with method raymarch"),
        refused(kNoFlux, "perspective, orthographic with method optical-depth"),
        refused(kNoFlux, "perspective, orthographic with method particles"),
        refused(kNoFlux, "perspective, orthographic with method particles"),
        refused("conflicts with [clouds]", "left out")),
    row(Feature::kOffCentre, FeatureGroup::kOfCamera, "off-centre projection of a host", "", "",
        exact(), refused("off-centre", "a symmetric one with display = \"billboards\""), exact(),
        exact(), exact(), exact(), exact(), exact(), exact()),
    row(Feature::kLens, FeatureGroup::kOfCamera, "camera.aperture_radius_m, camera.shutter_s",
        "camera.aperture_radius_m", "", kNoLens, kNoLens, kNoLens, kNoLens, kNoLens, kNoLens,
        kNoLens, exact(), refused("conflicts with [clouds]", "left out")),
    row(Feature::kInside, FeatureGroup::kOfCamera, "camera within media", "", "",
        bounded("nodes around it: +0.6 %; deep in thick media -15 to +8 %"),
        bounded("boards that the camera is in: +8 %"), bounded("-5 to +2 %"), exact(),
        bounded("-1 to +4 %; deep in thick media +19 %"), bounded("-95 %"),
        bounded("within deep particles +34 %, absorbed colours x 2.3"),
        bounded("boards that the camera is in: +65 %, absorbed colours x 9"),
        bounded("marched, as its kinds")),
    row(Feature::kMovingView, FeatureGroup::kOfCamera, "camera that moves while light stays", "",
        "", exact("closure = \"camera\" is refused"), exact(),
        exact("closure = \"camera\" is refused in films"), exact("begins anew"), exact(), exact(),
        exact(), exact(), exact("kinds with closure = \"camera\" are refused")),
};

}  // namespace support_rows
}  // namespace pileus
