// SPDX-License-Identifier: Apache-2.0
// Who can do what: features of scenes and sessions by methods and cloud skies, as data.
// in: a feature, a column -> out: exact, bounded by a figure, or refused with its words.
// docs/support.md, which `pileus methods --markdown` prints. The rows are in src/methods/support.
#pragma once
#include <cstddef>

namespace pileus {

/// A method's display decides which one a scene has. kCloudSkies: `[[clouds]]` and pileus_clouds.
/// Each has its row in kColumnRows.
enum class MethodColumn {
    kCollectors,
    kCollectorBillboards,
    kPhotonGrid,
    kPath,
    kRaymarch,
    kOpticalDepth,
    kParticles,
    kParticleBillboards,
    kCloudSkies,
    kCount
};
constexpr std::size_t kMethodColumns = std::size_t(MethodColumn::kCount);

struct ColumnRow {
    MethodColumn column;
    const char* name;    ///< as `pileus methods NAME` takes it
    bool method = true;  ///< the name is one of `method.name`; else: a display of one, skies
};
inline constexpr ColumnRow kColumnRows[] = {
    {MethodColumn::kCollectors, "collectors"},
    {MethodColumn::kCollectorBillboards, "collectors-billboards", false},
    {MethodColumn::kPhotonGrid, "photon-grid"},
    {MethodColumn::kPath, "path"},
    {MethodColumn::kRaymarch, "raymarch"},
    {MethodColumn::kOpticalDepth, "optical-depth"},
    {MethodColumn::kParticles, "particles"},
    {MethodColumn::kParticleBillboards, "particles-billboards", false},
    {MethodColumn::kCloudSkies, "clouds", false},
};
static_assert(sizeof kColumnRows / sizeof kColumnRows[0] == kMethodColumns, "one for every column");

constexpr const char* method_column_name(MethodColumn column) {
    return kColumnRows[std::size_t(column)].name;
}

enum class SupportLevel {
    kExact,    ///< but for noise and rounding
    kBounded,  ///< off by what `text` says
    kRefused   ///< in one line, before any work
};
const char* level_name(SupportLevel level);

/// What one column does with one feature.
struct Support {
    SupportLevel level = SupportLevel::kRefused;
    const char* text = "";     ///< the figure and what it was measured on; what a fault says
    const char* allowed = "";  ///< of a fault: what stands behind "allowed:"

    bool refused() const { return level == SupportLevel::kRefused; }
};

/// In the order of the table's rows.
enum class Feature {
    kSun,
    kSunDisc,
    kSetInAir,
    kSkyConstant,
    kSkyMap,
    kGroundUnderMap,
    kAir,
    kAirOnMedia,
    kGroundUnderAir,
    kLampParallel,
    kLampPoint,
    kLampSpot,
    kLampSphere,
    kEmission,
    kGround,
    kGroundOnMedia,
    kMediaOnGround,
    kShadowOnGround,
    kGroundMap,
    kSea,
    kSolids,
    kDepthImage,
    kOrthographic,
    kFlux,
    kOffCentre,
    kLens,
    kInside,
    kMovingView,
    kSeveral,
    kColoured,
    kPeriodic,
    kConstantCells,
    kTransferRows,
    kDetailBaked,
    kDetailMarched,
    kSkyInPlace,
    kSkyOnGrid,
    kParticlesOnGrid,
    kParticleColumns,
    kWeather,
    kMediaMove,
    kSequence,
    kPhaseSmooth,
    kPhaseNarrow,
    kLayerDepth,
    kLayerError,
    kLayerCloud,
    kLayerTau,
    kLayerLight,
    kLayerOrder,
    kLayerShadow,
    kLayerOcclusion,
    kFilter,
    kThinning,
    kLateLight,
    kFrameSteps,
    kFramePhotons,
    kWorstCase,
    kBudgetPhotons,
    kBudgetSamples,
    kState,
    kBudgetSteps,
    kBudgetError,
    kBudgetSeconds,
    kSetLights,
    kCount
};
constexpr std::size_t kSupportFeatures = std::size_t(Feature::kCount);

enum class FeatureGroup {
    kOfLight,
    kOfGround,
    kOfCamera,
    kOfMedia,
    kOfPhase,
    kOfLayers,
    kOfWork,
    kCount
};
const char* group_name(FeatureGroup group);

struct FeatureRow {
    Feature feature;
    FeatureGroup group;
    const char* name;
    const char* key;   ///< of scenes, where its refusal stands; "": of sessions and options
    const char* note;  ///< holds in all columns; may be empty
    Support by[kMethodColumns];
};
const FeatureRow& feature_row(Feature feature);
const Support& support(Feature feature, MethodColumn column);

/// What two features do not do together, each of which a column takes by itself.
struct PairRow {
    const char* pair;
    unsigned columns;  ///< bits of 1 << MethodColumn
    const char* note;  ///< may be empty
};
const PairRow* support_pairs(std::size_t& count);

/// Pairs that code asks for: the first of support_pairs.
enum class FeaturePair { kLampsAndSolids };
bool excludes(FeaturePair pair, MethodColumn column);

/// What sessions say of kSetInAir, flights among them, which have no table.
constexpr const char* kSkyInAir = "sky: conflicts with [atmosphere], which has its own";
constexpr const char* kSkyInAirAllowed = "not set";
constexpr const char* kNoSunInAir = "sun: none under [atmosphere]";
constexpr const char* kNoSunInAirAllowed = "one, above the horizon or below it";

/// What runs methods: columns of a table of their own.
enum class Runner { kOnDevice, kInFlight, kUnderVerify, kOfFlux, kCount };
constexpr std::size_t kRunners = std::size_t(Runner::kCount);
const char* runner_name(Runner runner);
struct RunnerRow {
    const char* feature;
    Support by[kRunners];
};
const RunnerRow* support_runners(std::size_t& count);

}  // namespace pileus
