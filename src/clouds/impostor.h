// SPDX-License-Identifier: Apache-2.0
// A cloud's picture on a plane through its middle, which stands for it while it is seen from nearly
// the same side (Schaufler 1995, dynamically generated impostors; Harris & Lastra 2001 for clouds).
// in: a group, a place, a camera -> out: texels, and where a pixel's ray meets them.
// docs/clouds.md, "Far clouds"
#pragma once
#include "src/clouds/group.h"
#include "src/clouds/shade.h"

namespace pileus {

/// Numbers of a texel: premultiplied R G B, alpha, alpha times metres behind the plane; the rest is
/// room.
constexpr std::size_t kTexelFloats = 8;

struct Impostor {
    bool made = false;
    Double3 eye{}, right{}, up{}, forward{};
    double plane_m = 0;                     ///< from the eye to the plane
    double u0 = 0, u1 = 0, v0 = 0, v1 = 0;  ///< tangents of its sides
    int width = 0, height = 0;
    double texels_per_unit = 0;
    std::uint64_t light = 0;           ///< CloudLight::version
    std::array<float, 3> level{};      ///< CloudLight::level of it
    std::uint64_t shading = 0;         ///< of layers above: Clouds counts them
    std::array<Double3, 4> corners{};  ///< in the world
    Buffer<float> texels;              ///< [row from the top][column][kTexelFloats]
};

/// With its cloud, that has gone somewhere else.
void shift(const Double3& by, Impostor& impostor);

/// What stands between a cloud and the sun, for each of its pixels.
struct CloudShade {
    const SunPlane* plane = nullptr;
    const float* texels = nullptr;  ///< kShadeTexels^2; null: nothing
    std::array<float, 3> ambient{};
    Double3 middle{};
    double radius = 1;
    float sky_left = 1;  ///< of the light that is not the sun's, through layers above

    /// Share of sunlight that is left at a place of the world.
    float left(const Double3& at) const;
    /// Without a sun all light is the sky's.
    void dim_sky(float (&rgba)[5]) const {
        if (texels != nullptr || !(sky_left < 1)) return;
        for (std::size_t c = 0; c < 3; ++c) rgba[c] *= sky_left;
    }
    /// Takes from premultiplied light what the sun no longer sends: all that is more than what
    /// light from all around alone would give.
    void darken(float left, float (&rgba)[5]) const {
        for (std::size_t c = 0; c < 3; ++c) {
            const float sun = rgba[c] - ambient[c] * rgba[3];
            if (sun > 0) rgba[c] -= (1.0f - left) * sun;
            if (sky_left < 1)
                rgba[c] -= (1.0f - sky_left) * (sun > 0 ? ambient[c] * rgba[3] : rgba[c]);
        }
    }
};

/// R G B of the media of a pixel. Noise may go below 0.
inline void take_light(const Planes& from, std::size_t pixel, float (&rgba)[5]) {
    const std::size_t pixels = from.transmittance.size();
    const float* const light = from.cloud.empty() ? from.colour.data() : from.cloud.data();
    for (std::size_t c = 0; c < 3; ++c) {
        const float v = light[c * pixels + pixel];
        rgba[c] = v > 0 ? v : 0.0f;
    }
}

/// A picture of this frame, as a group's session keeps it.
struct MarchedCloud {
    const Planes* planes = nullptr;
    PixelRect rect;
    float scale = 1;   ///< metres of the world for one of its depths
    float metres = 0;  ///< to what hides less than half
    CloudShade shade;

    /// Metres of the world along the ray of pixel (x, y) of `rect`: to half of the light, or where
    /// less is hidden as far as the nearest pixel that hides more, up to kThinPixels off.
    float depth(int x, int y) const;
    /// R G B, alpha, metres along the `ray` of a pixel from `eye`. False: nothing there.
    bool sample(int x, int y, const Double3& eye, const Double3& ray, float (&out)[5]) const;
};

/// A picture seen from `view`'s eye, with as many texels as `view` has pixels there, times
/// `sharpness`. Errors: a session's; kLimit: out of memory.
Status capture(const CloudView& view, const CloudPlace& place, const CloudBox& box,
               const CloudShade& shade, double sharpness, CloudGroup& group, Impostor& out);

/// How wrong it has become, in pixels: what its nearest and farthest parts have moved against one
/// another, or twice the share by which its scale is off.
double impostor_error(const Impostor& impostor, const CloudView& view, const CloudBox& box);

/// Rows of pixels of a view as places on an impostor.
class ImpostorRows {
public:
    ImpostorRows(const Impostor& impostor, const CloudView& view);
    /// The row's pixels from now on.
    void start(int y);
    /// R G B, alpha, metres along the ray. False: none there.
    bool sample(int x, float (&out)[5]) const;

private:
    const Impostor& impostor_;
    const CloudView& view_;
    double plane_side_;                  ///< N (c - o)
    Double3 from_eye_;                   ///< o - eye, by the impostor's axes right, up
    double row_[3] = {}, step_[3] = {};  ///< of the ray by right, up, forward: at x = 0, per pixel
    double row_y_ = 0;
    double u_scale_, v_scale_;
};

}  // namespace pileus
