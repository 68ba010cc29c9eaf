// SPDX-License-Identifier: Apache-2.0
// Layers, work, budgets and what sessions set.
// in: nothing -> out: rows of the support table, entries in the order of MethodColumn.
// docs/support.md
#pragma once
#include "src/methods/support/make_rows.h"

namespace pileus {
namespace support_rows {

constexpr const char* kMarchLayers =
    "radiance, alpha, depth, cloud, optical_depth, transmittance, light, order, reflectance, "
    "shadow";
constexpr const char* kOneKind = "method particles has no noise and one kind of light";
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

// Of budgets: what is allowed in their place.
constexpr Support kPathBudgets = refused("", "samples=N, error=E, seconds=S");
constexpr Support kPhotonBudgets = refused("", "photons=N, seconds=S, generations=N");
constexpr Support kGridBudgets = refused("", "photons=N, seconds=S, error=E, generations=N");
constexpr Support kMarchBudgets = refused("", "steps=N, seconds=S");
constexpr Support kBinBudgets = refused("", "--budget steps");
constexpr Support kNoBudgets = refused("", "none");
constexpr Support kPathState = refused("", "method.name = \"path\"");

constexpr Support kCloudBudgets =
    refused("not for a scene with [clouds]", "keys of the kinds' scenes, by clouds.kind.N.set");
constexpr Support kCloudState =
    refused("not for a scene with [clouds]", "left out, or with the scene of a kind");

constexpr Support kOfTheView =
    refused("what method particles takes depends on the view", "another method");

constexpr FeatureRow kWorkRows[] = {
    row(Feature::kLayerDepth, FeatureGroup::kOfLayers, "layer depth", "output.layers",
        "radiance and alpha: all; sessions give depth alone", exact(),
        exact("not by compositors of OpenGL"), exact(), exact(), exact(), exact(), exact(), exact(),
        exact()),
    row(Feature::kLayerError, FeatureGroup::kOfLayers, "layer error", "output.layers", "",
        bounded("noise, without bias: 1 sigma holds 0.68 to 0.76 of it, 2 sigma 0.92 to 0.96"),
        bounded("noise, without bias: 1 sigma holds 0.64 to 0.73 of it, 2 sigma 0.92 to 0.95"),
        bounded("noise, without bias: 1 sigma holds 0.70 to 0.74 of it, 2 sigma 0.94 to 0.96"),
        bounded("1 sigma holds 0.68 to 0.74 of the pixels, 2 sigma 0.89 to 0.97; filtered: noise "
                "to a half, without bias"),
        refused("method raymarch has no noise", kMarchLayers),
        refused("method optical-depth has no noise", kMarchLayers),
        refused(kOneKind, kParticleLayers), refused(kOneKind, kParticleLayers), kNotOfClouds),
    row(Feature::kLayerCloud, FeatureGroup::kOfLayers, "layer cloud", "output.layers", "", exact(),
        exact(), exact(), exact("of filtered pictures: filtered alike"), exact(), exact(), exact(),
        exact(), exact()),
    row(Feature::kLayerTau, FeatureGroup::kOfLayers, "layers optical_depth, transmittance",
        "output.layers", "", exact(), bounded("transmittance of spheres, not e^-tau"), exact(),
        exact(), bounded("as fine as its steps"), bounded("as raymarch"), exact(),
        bounded("of balls as they are shown"), kNotOfClouds),
    row(Feature::kLayerLight, FeatureGroup::kOfLayers, "layer light", "output.layers", "", exact(),
        exact(), exact(), bounded("lamps in the total alone"), exact(), exact(),
        refused(kOneKind, kParticleLayers), refused(kOneKind, kParticleLayers), kNotOfClouds),
    row(Feature::kLayerOrder, FeatureGroup::kOfLayers, "layer order", "output.layers", "",
        exact("with first_order_split or closure = \"camera\""), exact("with first_order_split"),
        exact("with first_order_split"), exact(), exact(),
        refused("\"order\": light of method optical-depth has no orders of scattering",
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
        exact(), refused("what billboards take depends on the view", "display = \"march\""),
        exact(), exact(), exact("not of periodic media"), exact("not of periodic media"),
        kOfTheView, kOfTheView, kNoSetWork),
    row(Feature::kBudgetPhotons, FeatureGroup::kOfWork, "--budget photons, generations", "", "",
        exact(), exact(), exact(), kPathBudgets, kMarchBudgets, kMarchBudgets, kBinBudgets,
        kNoBudgets, kCloudBudgets),
    row(Feature::kBudgetSamples, FeatureGroup::kOfWork, "--budget samples", "", "", kPhotonBudgets,
        kPhotonBudgets, kGridBudgets, exact(), kMarchBudgets, kMarchBudgets, kBinBudgets,
        kNoBudgets, kCloudBudgets),
    row(Feature::kState, FeatureGroup::kOfWork, "--state", "", "", kPathState, kPathState,
        kPathState, exact(), kPathState, kPathState, kPathState, kPathState, kCloudState),
    row(Feature::kBudgetSteps, FeatureGroup::kOfWork, "--budget steps", "", "", kPhotonBudgets,
        kPhotonBudgets, kGridBudgets, kPathBudgets, exact(), exact(), exact(),
        refused("not for method particles with billboards", "none"), kCloudBudgets),
    row(Feature::kBudgetError, FeatureGroup::kOfWork, "--budget error", "", "", kPhotonBudgets,
        kPhotonBudgets, exact("with layer error, no film"), exact(), kMarchBudgets, kMarchBudgets,
        kBinBudgets, kNoBudgets, kCloudBudgets),
    row(Feature::kBudgetSeconds, FeatureGroup::kOfWork, "--budget seconds", "", "", exact(),
        exact(), exact(), exact(), exact(), exact(), kBinBudgets, kNoBudgets, kCloudBudgets),
    row(Feature::kSetLights, FeatureGroup::kOfWork, "set_lights", "", "of a session", exact(),
        refused("not for collectors as billboards in this version"), exact(), exact(), exact(),
        exact(), exact(), exact(), kNoSetWork),
};

}  // namespace support_rows
}  // namespace pileus
