// SPDX-License-Identifier: Apache-2.0
// Rows of the key table for method `raymarch`.
// in: checked TOML values -> out: fields of RaymarchSettings.
// docs/scene.md; docs/raymarch.md says what each costs.
#include "src/scene/scene_keys.h"

namespace pileus {
namespace {

constexpr KeyRange kShare{0, 1, false, false};
constexpr KeyRange kLength{0, 1e9, false, false};

/// Place of a text in a list parted by '|'.
template <class Kind>
Kind kind_of(const Node& n, const char* choices) {
    int at = 0;
    for (std::string_view choice : split_list(choices)) {
        if (choice == n.text) return Kind(at);
        ++at;
    }
    return Kind(0);
}

// In the order of their enumerations in scene.h.
constexpr const char* kIntegrators = "closed|riemann|trapezoid|simpson|simpson38";
constexpr const char* kSpacings = "uniform|voxel|optimal|geometric";
constexpr const char* kJitters = "none|hash|blue-noise";
constexpr const char* kLights = "auto|march|buffer|buffer-exact";
constexpr const char* kUpsamples = "depth|linear|nearest";
constexpr const char* kPowders = "none|powder|beer-powder|directional";

const KeyRow kRows[] = {
    choice_key(KeyKind::kText, "raymarch.integrator", "\"closed\"", kIntegrators, nullptr,
               "how the light along a ray is added up; `closed`: each step exactly, as if its "
               "middle's density and light filled it",
               [](const Node& n, KeyTarget t) {
                   t.scene.raymarch.integrator = kind_of<RaymarchIntegrator>(n, kIntegrators);
               }),
    range_key(KeyKind::kInteger, "raymarch.steps", "", "256", {0, 65536, false, false},
              "most steps of a ray through the medium, one sample each; 0: the medium is not seen",
              [](const Node& n, KeyTarget t) {
                  t.scene.raymarch.steps = static_cast<int>(integer_of(n));
              }),
    choice_key(
        KeyKind::kText, "raymarch.spacing", "\"uniform\"", kSpacings, nullptr,
        "`uniform`: all steps of a ray alike; `voxel`: each as long as a cell, however many; "
        "`optimal`: as long as a pixel is wide there; `geometric`: growing from one to the "
        "next",
        [](const Node& n, KeyTarget t) {
            t.scene.raymarch.spacing = kind_of<RaymarchSpacing>(n, kSpacings);
        }),
    range_key(KeyKind::kNumber, "raymarch.first_step_m", "m", "0", kLength,
              "spacing `geometric`: the least first step; `optimal`: steps near the camera are no "
              "shorter; 0: what `steps` need to reach through the medium, half a cell",
              [](const Node& n, KeyTarget t) { t.scene.raymarch.first_step_m = number_of(n); }),
    range_key(KeyKind::kNumber, "raymarch.growth", "", "1.01", {1, 2, false, false},
              "spacing `geometric`: length of a step over that of the one before",
              [](const Node& n, KeyTarget t) { t.scene.raymarch.growth = number_of(n); }),
    choice_key(KeyKind::kText, "raymarch.occlusion", "\"cut\"", "cut|stretch", nullptr,
               "before something solid the last step ends at it, or all steps shrink, which shows "
               "its shape through opaque cloud; the latter only to compare",
               [](const Node& n, KeyTarget t) { t.scene.raymarch.stretch = n.text == "stretch"; }),
    choice_key(KeyKind::kText, "raymarch.scattering", "\"single\"", "single|forward|octaves",
               nullptr,
               "sunlight scattered once; or what stays within a cone goes on as sunlight; or many "
               "scatterings as weaker and weaker copies of the first",
               [](const Node& n, KeyTarget t) {
                   t.scene.raymarch.forward = n.text == "forward";
                   t.scene.raymarch.many = n.text == "octaves";
               }),
    range_key(KeyKind::kInteger, "raymarch.octaves", "", "8", {1, 8, false, false},
              "scattering `octaves`: number of copies",
              [](const Node& n, KeyTarget t) {
                  t.scene.raymarch.octaves = static_cast<int>(integer_of(n));
              }),
    range_key(
        KeyKind::kNumber, "raymarch.octave_extinction", "", "0.45", kShare,
        "extinction of a copy over that of the one before",
        [](const Node& n, KeyTarget t) { t.scene.raymarch.octave_extinction = number_of(n); }),
    range_key(KeyKind::kNumber, "raymarch.octave_share", "", "0.65", kShare,
              "light of a copy over that of the one before",
              [](const Node& n, KeyTarget t) { t.scene.raymarch.octave_share = number_of(n); }),
    range_key(
        KeyKind::kNumber, "raymarch.octave_anisotropy", "", "0.75", kShare,
        "mean cosine of a copy over that of the one before",
        [](const Node& n, KeyTarget t) { t.scene.raymarch.octave_anisotropy = number_of(n); }),
    range_key(KeyKind::kNumber, "raymarch.cone_deg", "deg", "40", {0, 360, false, false},
              "angle of that cone at its apex",
              [](const Node& n, KeyTarget t) { t.scene.raymarch.cone_deg = number_of(n); }),
    range_key(KeyKind::kNumber, "raymarch.forward_share", "", "", kShare,
              "share of scattered light that stays within the cone; left out: that of the phase "
              "function",
              [](const Node& n, KeyTarget t) { t.scene.raymarch.forward_share = number_of(n); }),
    choice_key(
        KeyKind::kText, "raymarch.light", "\"auto\"", kLights, nullptr,
        "sunlight by a march from each sample, or from nodes made before: swept from slice to "
        "slice, or by exact rays; `auto`: what costs less of march and buffer-exact",
        [](const Node& n, KeyTarget t) {
            t.scene.raymarch.light = kind_of<RaymarchLightKind>(n, kLights);
        }),
    range_key(KeyKind::kInteger, "raymarch.light_steps", "", "0", {0, 65536, false, false},
              "steps of a march towards the sun; 0: as many of a cell's length as the way takes",
              [](const Node& n, KeyTarget t) {
                  t.scene.raymarch.light_steps = static_cast<int>(integer_of(n));
              }),
    range_key(
        KeyKind::kNumber, "raymarch.light_first_step_m", "m", "0", kLength,
        "first of light_steps; what lies behind the last is not seen; 0: they share the way "
        "out of the medium",
        [](const Node& n, KeyTarget t) { t.scene.raymarch.light_first_step_m = number_of(n); }),
    range_key(KeyKind::kNumber, "raymarch.light_growth", "", "1", {1, 16, false, false},
              "length of one of light_steps over that of the one before",
              [](const Node& n, KeyTarget t) { t.scene.raymarch.light_growth = number_of(n); }),
    choice_key(KeyKind::kText, "raymarch.light_path", "\"straight\"", "straight|cone", nullptr,
               "`cone`: steps of a march towards the sun turn off by a quarter to all of half "
               "cone_deg, one after the other; softens shades",
               [](const Node& n, KeyTarget t) { t.scene.raymarch.light_cone = n.text == "cone"; }),
    choice_key(
        KeyKind::kText, "raymarch.sky_light", "\"ambient\"", "none|ambient", nullptr,
        "light of sky and ground in the medium: none, or what reaches coarse nodes from 24 "
        "directions, scattered alike everywhere; approximation",
        [](const Node& n, KeyTarget t) { t.scene.raymarch.sky_ambient = n.text == "ambient"; }),
    plain_key(KeyKind::kBool, "raymarch.detail", "false",
              "true: where steps or pixels are wider than cells, coarser densities are marched",
              [](const Node& n, KeyTarget t) { t.scene.raymarch.detail = n.flag; }),
    choice_key(KeyKind::kText, "raymarch.jitter", "\"none\"", kJitters, nullptr,
               "rays begin up to a panel before the medium, each pixel's by a number of its own: "
               "noise instead of bands",
               [](const Node& n, KeyTarget t) {
                   t.scene.raymarch.jitter = kind_of<RaymarchJitterKind>(n, kJitters);
               }),
    range_key(KeyKind::kNumber, "raymarch.jitter_share", "panels", "1", kShare,
              "how far before, at most",
              [](const Node& n, KeyTarget t) { t.scene.raymarch.jitter_share = number_of(n); }),
    range_key(KeyKind::kNumber, "raymarch.grid_lock_m", "m", "0", kLength,
              "steps begin at planes across the view that stay where they are while the camera "
              "moves, so far apart: less boiling in animations of spacing `voxel`; 0: none",
              [](const Node& n, KeyTarget t) { t.scene.raymarch.grid_lock_m = number_of(n); }),
    choice_key(KeyKind::kText, "raymarch.powder", "\"none\"", kPowders, nullptr,
               "darkens where little lies before the sun; appearance, not physics",
               [](const Node& n, KeyTarget t) {
                   t.scene.raymarch.powder = kind_of<RaymarchPowderKind>(n, kPowders);
               }),
    range_key(KeyKind::kNumber, "raymarch.powder_strength", "", "1", {0, 1e6, false, false},
              "factor on the optical depth in `powder`",
              [](const Node& n, KeyTarget t) { t.scene.raymarch.powder_strength = number_of(n); }),
    range_key(KeyKind::kColor, "raymarch.ambient", "", "0", {0, 1e12, false, false},
              "radiance of an opaque medium without other light: emission in proportion to the "
              "density; appearance, not physics",
              [](const Node& n, KeyTarget t) { t.scene.raymarch.ambient = color_of(n); }),
    range_key(KeyKind::kNumber, "raymarch.stop_below", "", "1e-4", kShare,
              "a ray ends where less of what lies behind is seen",
              [](const Node& n, KeyTarget t) { t.scene.raymarch.stop_below = number_of(n); }),
    range_key(KeyKind::kInteger, "raymarch.scale", "", "1", {1, 4, false, false},
              "1, 2 or 4: one pixel of so many along x and y is marched, the others are filled in",
              [](const Node& n, KeyTarget t) {
                  t.scene.raymarch.scale = static_cast<int>(integer_of(n));
              }),
    choice_key(KeyKind::kText, "raymarch.upsample", "\"depth\"", kUpsamples, nullptr,
               "how pixels between marched ones are filled in; `depth` minds what stands behind",
               [](const Node& n, KeyTarget t) {
                   t.scene.raymarch.upsample = kind_of<RaymarchUpsample>(n, kUpsamples);
               }),
    range_key(KeyKind::kInteger, "raymarch.temporal", "", "0", {0, 4, false, false},
              "2 or 4: each frame marches one pixel of so many along x and y, in turn; the others "
              "come from the frame before; 0: frames know nothing of one another",
              [](const Node& n, KeyTarget t) {
                  t.scene.raymarch.temporal = static_cast<int>(integer_of(n));
              }),
    choice_key(KeyKind::kText, "raymarch.phase", "\"physical\"", "physical|peak", nullptr,
               "`peak`: phase functions over their largest value; appearance, not physics",
               [](const Node& n, KeyTarget t) { t.scene.raymarch.peak_phase = n.text == "peak"; }),
};

}  // namespace

Span<const KeyRow> raymarch_keys() { return {kRows, sizeof kRows / sizeof kRows[0]}; }

}  // namespace pileus
