// SPDX-License-Identifier: Apache-2.0
// Keys of method `raymarch`.
// in: checked values <-> out: fields of RaymarchSettings.
// docs/scene.md; docs/raymarch.md says what each costs.
#include "src/scene/keys/upsample_keys.h"

namespace pileus {
namespace {

template <auto... Members>
constexpr KeyField raymarch = field<&Scene::raymarch, Members...>;
template <auto Member>
constexpr KeyField march = raymarch<&RaymarchSettings::march, Member>;
template <auto Member>
constexpr KeyField scattering = raymarch<&RaymarchSettings::scattering, Member>;
template <auto Member>
constexpr KeyField light = raymarch<&RaymarchSettings::light, Member>;
template <auto Member>
constexpr KeyField look = raymarch<&RaymarchSettings::look, Member>;

constexpr KeyField kScattering{KeyKind::kChoice,
                               [](const KeySource& s) {
                                   const RaymarchSettings& r = s.scene.raymarch;
                                   if (r.scattering.automatic) return node_of(0);
                                   return node_of(r.scattering.ordinates ? 4
                                                  : r.scattering.many
                                                      ? 3
                                                      : 1 + int(r.scattering.forward));
                               },
                               [](const KeyTarget& t, const Node& n) {
                                   RaymarchSettings& r = t.scene.raymarch;
                                   r.scattering.automatic = n.integer == 0;
                                   r.scattering.forward = n.integer == 2;
                                   r.scattering.many = n.integer == 0 || n.integer >= 3;
                                   r.scattering.ordinates = n.integer == 4;
                               }};

constexpr KeyRow kRows[] = {
    {"raymarch.integrator", march<&RaymarchStepSettings::integrator>,
     one_of("closed|riemann|trapezoid|simpson|simpson38"), "",
     "how the light along a ray is added up; `closed`: each step exactly, as if its "
     "middle's density and light filled it"},
    {"raymarch.steps", march<&RaymarchStepSettings::steps>, from_to(0, 65536), "",
     "most steps of a ray through the medium, one sample each; 0: the medium is not seen"},
    {"raymarch.spacing", march<&RaymarchStepSettings::spacing>,
     one_of("uniform|voxel|optimal|geometric"), "",
     "`uniform`: all steps of a ray alike; `voxel`: each as long as a cell, however many; "
     "`optimal`: as long as a pixel is wide there; `geometric`: growing from one to the "
     "next"},
    {"raymarch.first_step_m", march<&RaymarchStepSettings::first_step_m>, from_to(0, 1e9), "m",
     "spacing `geometric`: the least first step; `optimal`: steps near the camera are no "
     "shorter; 0: what `steps` need to reach through the medium, half a cell"},
    {"raymarch.growth", march<&RaymarchStepSettings::growth>, from_to(1, 2), "",
     "spacing `geometric`: length of a step over that of the one before"},
    {"raymarch.occlusion", march<&RaymarchStepSettings::stretch>, one_of("cut|stretch"), "",
     "before something solid the last step ends at it, or all steps shrink, which shows "
     "its shape through opaque cloud; the latter only to compare"},
    {"raymarch.scattering", kScattering, one_of("auto|single|forward|octaves|ordinates"), "",
     "`auto`: ordinates where they know all of the scene, or octaves; sunlight scattered once; or "
     "what stays within a cone goes on as sunlight; or many "
     "scatterings as weaker and weaker copies of the first; or the radiance in 32 directions on "
     "coarse nodes, solved for"},
    {"raymarch.octaves", scattering<&RaymarchScatterSettings::octaves>, from_to(1, 8), "",
     "scattering `octaves`: number of copies"},
    {"raymarch.octave_extinction", scattering<&RaymarchScatterSettings::octave_extinction>,
     from_to(0, 1), "", "extinction of a copy over that of the one before"},
    {"raymarch.octave_share", scattering<&RaymarchScatterSettings::octave_share>, from_to(0, 1), "",
     "light of a copy over that of the one before"},
    {"raymarch.octave_anisotropy", scattering<&RaymarchScatterSettings::octave_anisotropy>,
     from_to(0, 1), "", "mean cosine of a copy over that of the one before"},
    {"raymarch.cone_deg", scattering<&RaymarchScatterSettings::cone_deg>, from_to(0, 360), "deg",
     "angle of that cone at its apex"},
    {"raymarch.forward_share", scattering<&RaymarchScatterSettings::forward_share>, from_to(0, 1),
     "",
     "share of scattered light that stays within the cone; left out: that of the phase "
     "function",
     kNoNote},
    {"raymarch.light", light<&RaymarchLightSettings::kind>,
     one_of("auto|march|buffer|buffer-exact"), "",
     "sunlight by a march from each sample, or from nodes made before: swept from slice to "
     "slice, or by exact rays; `auto`: what costs less of march and buffer-exact"},
    {"raymarch.light_steps", light<&RaymarchLightSettings::steps>, from_to(0, 65536), "",
     "steps of a march towards the sun; 0: as many of a cell's length as the way takes"},
    {"raymarch.light_first_step_m", light<&RaymarchLightSettings::first_step_m>, from_to(0, 1e9),
     "m",
     "first of light_steps; what lies behind the last is not seen; 0: they share the way "
     "out of the medium"},
    {"raymarch.light_growth", light<&RaymarchLightSettings::growth>, from_to(1, 16), "",
     "length of one of light_steps over that of the one before"},
    {"raymarch.light_path", light<&RaymarchLightSettings::cone>, one_of("straight|cone"), "",
     "`cone`: steps of a march towards the sun turn off by a quarter to all of half "
     "cone_deg, one after the other; softens shades"},
    {"raymarch.sky_light", light<&RaymarchLightSettings::sky_ambient>, one_of("none|ambient"), "",
     "light of sky and ground in the medium: none, or what reaches coarse nodes from 24 "
     "directions, scattered towards the camera; approximation"},
    {"raymarch.detail", march<&RaymarchStepSettings::detail>, any(), "",
     "true: where steps or pixels are wider than cells, coarser densities are marched"},
    {"raymarch.jitter", march<&RaymarchStepSettings::jitter>, one_of("none|hash|blue-noise"), "",
     "rays begin up to a panel before the medium, each pixel's by a number of its own: "
     "noise instead of bands"},
    {"raymarch.jitter_share", march<&RaymarchStepSettings::jitter_share>, from_to(0, 1), "panels",
     "how far before, at most"},
    {"raymarch.grid_lock_m", march<&RaymarchStepSettings::grid_lock_m>, from_to(0, 1e9), "m",
     "steps begin at planes across the view that stay where they are while the camera "
     "moves, so far apart: less boiling in animations of spacing `voxel`; 0: none"},
    {"raymarch.powder", look<&RaymarchLookSettings::powder>,
     one_of("none|powder|beer-powder|directional"), "",
     "darkens where little lies before the sun; appearance, not physics"},
    {"raymarch.powder_strength", look<&RaymarchLookSettings::powder_strength>, from_to(0, 1e6), "",
     "factor on the optical depth in `powder`"},
    {"raymarch.ambient", look<&RaymarchLookSettings::ambient>, from_to(0, 1e12), "",
     "radiance of an opaque medium without other light: emission in proportion to the "
     "density; appearance, not physics"},
    {"raymarch.stop_below", march<&RaymarchStepSettings::stop_below>, from_to(0, 1), "",
     "light of a ray ends where less of what lies behind is seen"},
    {"raymarch.scale", raymarch<&RaymarchSettings::thin, &UpsampleSettings::scale>,
     upsample_keys::kScales, "", upsample_keys::kScale},
    {"raymarch.upsample", raymarch<&RaymarchSettings::thin, &UpsampleSettings::upsample>,
     one_of("depth|linear|nearest"), "", upsample_keys::kUpsample},
    {"raymarch.temporal", raymarch<&RaymarchSettings::thin, &UpsampleSettings::temporal>,
     upsample_keys::kCells, "", upsample_keys::kTemporal},
    {"raymarch.light_refresh", light<&RaymarchLightSettings::refresh>,
     ranged(&RaymarchLightSettings::refresh), "frames", upsample_keys::kLightRefresh},
    {"raymarch.phase", look<&RaymarchLookSettings::peak_phase>, one_of("physical|peak"), "",
     "`peak`: phase functions over their largest value; appearance, not physics"},
};

}  // namespace

Span<const KeyRow> raymarch_keys() { return {kRows, sizeof kRows / sizeof kRows[0]}; }

}  // namespace pileus
