// SPDX-License-Identifier: Apache-2.0
// Layers, work, budgets and what sessions set.
// in: nothing -> out: rows of the support table, entries in the order of MethodColumn.
// docs/support.md
#pragma once
#include "src/methods/support/make_rows.h"

namespace pileus {
namespace support_rows {

constexpr const char* kNoNoise = "no noise";
constexpr const char* kOneKind = "no noise and one kind of light";
constexpr const char* kParticleLayers =
    "radiance, alpha, depth, cloud, optical_depth, transmittance, reflectance, shadow, occlusion";
constexpr Support kNotOfClouds =
    refused("not of a sky with [clouds]", "radiance, alpha, depth, cloud");
constexpr Support kByParticles =
    refused("by method particles alone", "other layers, or method.name = \"particles\"");
constexpr Support kByPath =
    refused("filters pictures of method path alone", "none, or method.name = \"path\"");
constexpr Support kNoSetWork =
    refused("not in a sky of clouds", "none; what clouds may cost is pileus_cloud_detail's");

constexpr FeatureRow kWorkRows[] = {
    row(Feature::kLayerDepth, FeatureGroup::kOfLayers, "layer depth", "output.layers",
        "radiance and alpha: all; sessions give depth alone", exact(),
        exact("not by compositors of OpenGL"), exact(), exact(), exact(), exact(), exact(), exact(),
        exact()),
    row(Feature::kLayerError, FeatureGroup::kOfLayers, "layer error", "output.layers", "",
        bounded("1 sigma holds 0.32 to 0.67 of the pixels"), bounded("as collectors"),
        bounded("1 sigma holds 0.30 to 0.65 of the pixels"),
        bounded("1 sigma holds 0.58 to 0.69 of the pixels"), refused(kNoNoise), refused(kNoNoise),
        refused(kOneKind, kParticleLayers), refused(kOneKind, kParticleLayers), kNotOfClouds),
    row(Feature::kLayerCloud, FeatureGroup::kOfLayers, "layer cloud", "output.layers", "", exact(),
        exact(), exact(), exact("of filtered pictures: unfiltered"), exact(), exact(), exact(),
        exact(), exact()),
    row(Feature::kLayerTau, FeatureGroup::kOfLayers, "layers optical_depth, transmittance",
        "output.layers", "", exact(), exact(), exact(), exact(),
        bounded("ends at stop_below: 9.4 for 50"), bounded("as raymarch"), unknown(), unknown(),
        kNotOfClouds),
    row(Feature::kLayerLight, FeatureGroup::kOfLayers, "layer light", "output.layers", "", exact(),
        exact(), exact(), bounded("lamps in the total alone"), exact(), exact(),
        refused(kOneKind, kParticleLayers), refused(kOneKind, kParticleLayers), kNotOfClouds),
    row(Feature::kLayerOrder, FeatureGroup::kOfLayers, "layer order", "output.layers", "",
        exact("with first_order_split or closure = \"camera\""), exact("with first_order_split"),
        exact("with first_order_split"), exact(), exact(),
        refused("light of method optical-depth has no orders of scattering",
                "light, or method raymarch"),
        refused(kOneKind, kParticleLayers), refused(kOneKind, kParticleLayers), kNotOfClouds),
    row(Feature::kLayerShadow, FeatureGroup::kOfLayers, "layers reflectance, shadow",
        "output.layers", "", exact(), exact(), exact(), exact(), exact(), exact(),
        bounded("shadow of the grid"), bounded("shadow of the grid"), kNotOfClouds),
    row(Feature::kLayerOcclusion, FeatureGroup::kOfLayers, "layer occlusion", "output.layers", "",
        kByParticles, kByParticles, kByParticles, kByParticles, kByParticles, kByParticles,
        bounded("24 directions"), bounded("24 directions"), kNotOfClouds),
    row(Feature::kFilter, FeatureGroup::kOfWork, "filter.kind", "filter.kind", "", kByPath, kByPath,
        kByPath, bounded("half to two thirds of the error with 1 sample a pixel"), kByPath, kByPath,
        kByPath, kByPath, kByPath),
    row(Feature::kThinning, FeatureGroup::kOfWork, "scale, temporal", "METHOD.scale", "",
        bounded("of edges"), refused(), bounded("of edges"), refused(), bounded("of edges"),
        refused(), refused(), refused(), kNoSetWork),
    row(Feature::kLateLight, FeatureGroup::kOfWork, "light_refresh", "METHOD.light_refresh", "",
        bounded("late by as many frames"), bounded("as collectors"), bounded("as collectors"),
        refused(), bounded("as collectors"), refused(), refused(), refused(), kNoSetWork),
    row(Feature::kFrameSteps, FeatureGroup::kOfWork, "steps or bins of a frame", "", "of a session",
        refused(), refused(), refused(), refused(), exact(),
        exact("where the scene gives steps; else refused"), exact(), refused(), kNoSetWork),
    row(Feature::kFramePhotons, FeatureGroup::kOfWork, "photons of a frame", "", "of a session",
        exact(), exact(), exact("with ring; else refused"), refused(), refused(), refused(),
        refused(), refused(), kNoSetWork),
    row(Feature::kWorstCase, FeatureGroup::kOfWork, "most_units, fit, govern", "", "of a session",
        exact(), refused("the view decides"), exact(), exact(), exact("not of periodic media"),
        exact("not of periodic media"), refused("the view decides"), refused("the view decides"),
        kNoSetWork),
    row(Feature::kBudgetPhotons, FeatureGroup::kOfWork, "--budget photons, generations", "", "",
        exact(), exact(), exact(), refused(), refused(), refused(), refused(), refused(),
        refused()),
    row(Feature::kBudgetSamples, FeatureGroup::kOfWork, "--budget samples, --state", "", "",
        refused(), refused(), refused(), exact(), refused(), refused(), refused(), refused(),
        refused()),
    row(Feature::kBudgetSteps, FeatureGroup::kOfWork, "--budget steps", "", "", refused(),
        refused(), refused(), refused(), exact(), exact(), exact(), refused(), refused()),
    row(Feature::kBudgetError, FeatureGroup::kOfWork, "--budget error", "", "", refused(),
        refused(), exact("with layer error, no film"), exact(), refused(), refused(), refused(),
        refused(), refused()),
    row(Feature::kBudgetSeconds, FeatureGroup::kOfWork, "--budget seconds", "", "", exact(),
        exact(), exact(), exact(), exact(), exact(), refused(), refused(), refused()),
    row(Feature::kSetLights, FeatureGroup::kOfWork, "set_lights", "", "of a session", exact(),
        refused("not for collectors as billboards in this version"), exact(), exact(), exact(),
        exact(), exact(), unknown(), kNoSetWork),
};

}  // namespace support_rows
}  // namespace pileus
