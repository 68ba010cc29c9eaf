// SPDX-License-Identifier: Apache-2.0
// Scene-linear radiance to the 8-bit sRGB numbers of a daylight photograph.
// in: R G B radiance, a gain -> out: three whole numbers 0..255, monotone in the radiance.
// Narkowicz 2016, "ACES filmic tone mapping curve"; IEC 61966-2-1 (sRGB).
#pragma once
#include <cstdint>

#include "kernels_cpu/core/math.h"

namespace pileus {

inline namespace PILEUS_ISA {

/// Sunlight of irradiance 1 on white paper is radiance 1/pi: this gain places it at code 224, a
/// sunlit cloud of 0.5 at 236 and a blue sky of 0.05 0.07 0.11 in the middle tones.
constexpr float kDaylightGain = 3.5f;

/// Linear value at which the code k+1 begins: the smallest float not below the inverse sRGB curve
/// at (k + 1/2)/255, evaluated in extended precision. So code = round(255 encode(v)), half up.
constexpr float kSrgbThresholds[255] = {
    0.000151763496f, 0.000455290487f, 0.000758817478f, 0.00106234453f, 0.00136587152f,
    0.00166939851f,  0.00197292562f,  0.00227645249f,  0.00257997937f, 0.00288350647f,
    0.00318830111f,  0.00350925955f,  0.00384831498f,  0.00420574844f, 0.00458183279f,
    0.00497683743f,  0.00539102452f,  0.0058246511f,   0.00627796957f, 0.00675122766f,
    0.00724466844f,  0.00775853079f,  0.00829304848f,  0.00884845387f, 0.00942497142f,
    0.0100228265f,   0.010642237f,    0.0112834219f,   0.0119465925f,  0.0126319602f,
    0.0133397318f,   0.0140701123f,   0.0148233036f,   0.0155995032f,  0.0163989104f,
    0.0172217172f,   0.0180681162f,   0.0189382955f,   0.0198324434f,  0.0207507461f,
    0.0216933843f,   0.0226605386f,   0.0236523915f,   0.0246691164f,  0.0257108882f,
    0.026777884f,    0.0278702714f,   0.0289882217f,   0.0301319025f,  0.0313014835f,
    0.0324971229f,   0.0337189883f,   0.0349672437f,   0.0362420455f,  0.0375435539f,
    0.038871929f,    0.04022732f,     0.0416098908f,   0.0430197865f,  0.0444571637f,
    0.045922175f,    0.0474149659f,   0.048935689f,    0.0504844859f,  0.0520615093f,
    0.0536669008f,   0.055300802f,    0.0569633618f,   0.0586547181f,  0.0603750125f,
    0.0621243864f,   0.0639029741f,   0.0657109171f,   0.067548357f,   0.0694154128f,
    0.0713122413f,   0.0732389614f,   0.0751957074f,   0.0771826208f,  0.0791998208f,
    0.0812474489f,   0.0833256245f,   0.085434489f,    0.0875741616f,  0.089744769f,
    0.0919464454f,   0.0941793025f,   0.0964434817f,   0.098739095f,   0.101066276f,
    0.103425138f,    0.105815805f,    0.108238406f,    0.110693052f,   0.11317987f,
    0.115698971f,    0.118250489f,    0.120834522f,    0.123451203f,   0.126100644f,
    0.128782958f,    0.131498262f,    0.134246677f,    0.137028307f,   0.139843285f,
    0.142691687f,    0.145573661f,    0.148489311f,    0.151438743f,   0.15442206f,
    0.157439396f,    0.160490841f,    0.163576499f,    0.166696504f,   0.169850945f,
    0.173039928f,    0.176263571f,    0.179521978f,    0.182815254f,   0.186143503f,
    0.189506844f,    0.192905352f,    0.19633916f,     0.199808359f,   0.203313053f,
    0.206853345f,    0.210429341f,    0.214041144f,    0.217688859f,   0.221372575f,
    0.225092396f,    0.228848428f,    0.232640773f,    0.236469522f,   0.240334779f,
    0.244236648f,    0.248175219f,    0.252150595f,    0.256162852f,   0.260212123f,
    0.264298499f,    0.268422037f,    0.272582889f,    0.276781112f,   0.281016827f,
    0.285290092f,    0.289601028f,    0.293949753f,    0.298336297f,   0.30276081f,
    0.30722338f,     0.311724067f,    0.31626296f,     0.32084021f,    0.325455844f,
    0.330110013f,    0.334802747f,    0.339534193f,    0.344304383f,   0.349113464f,
    0.353961498f,    0.358848572f,    0.363774806f,    0.368740231f,   0.373744994f,
    0.378789157f,    0.383872777f,    0.388996005f,    0.3941589f,     0.399361551f,
    0.404604018f,    0.40988642f,     0.415208846f,    0.420571357f,   0.425974071f,
    0.431417048f,    0.436900377f,    0.442424119f,    0.447988421f,   0.453593343f,
    0.459238917f,    0.464925319f,    0.47065255f,     0.47642073f,    0.482229948f,
    0.488080263f,    0.493971765f,    0.499904573f,    0.505878747f,   0.511894345f,
    0.517951429f,    0.524050176f,    0.530190587f,    0.536372721f,   0.542596757f,
    0.548862696f,    0.555170655f,    0.561520696f,    0.567912936f,   0.574347377f,
    0.580824137f,    0.587343335f,    0.593905032f,    0.600509286f,   0.607156157f,
    0.613845766f,    0.62057817f,     0.62735343f,     0.634171665f,   0.641032934f,
    0.647937298f,    0.654884875f,    0.661875665f,    0.668909848f,   0.675987422f,
    0.683108449f,    0.690273106f,    0.697481394f,    0.704733372f,   0.712029159f,
    0.719368875f,    0.72675246f,     0.734180093f,    0.741651833f,   0.74916774f,
    0.756727874f,    0.764332294f,    0.77198118f,     0.77967447f,    0.787412345f,
    0.795194805f,    0.803021908f,    0.810893834f,    0.818810582f,   0.826772213f,
    0.834778845f,    0.842830539f,    0.850927293f,    0.859069288f,   0.867256522f,
    0.875489116f,    0.883767128f,    0.892090559f,    0.900459588f,   0.908874214f,
    0.917334557f,    0.925840676f,    0.934392571f,    0.942990422f,   0.951634228f,
    0.960324049f,    0.969060004f,    0.977842152f,    0.986670554f,   0.995545268f,
};

/// 8-bit sRGB code of a linear value: how many thresholds it has reached. NaN gives 0.
PILEUS_FN std::uint32_t srgb_code(float linear) {
    std::uint32_t code = 0;
    for (std::uint32_t step = 128; step > 0; step /= 2)
        code += linear >= kSrgbThresholds[code + step - 1] ? step : 0u;
    return code;
}

/// Gain for an exposure in stops: the daylight gain times 2^stops, exact for whole stops.
/// Stops are held to [-64, 64]; NaN counts as 64 below.
PILEUS_FN float exposure_gain(float stops) {
    const float held = min_(max_(stops, -64.0f), 64.0f);
    const std::int32_t whole = floor_int(held);
    const float power = reinterpret<float>((whole + 127) << 23);
    return kDaylightGain * exp_((held - float(whole)) * 0.693147180559945f) * power;
}

template <class T>
struct Rgb {
    T r, g, b;
};

/// Luminance (Rec. 709), exactly the common value where all three are equal.
template <class T>
PILEUS_FN T luminance(Rgb<T> c) {
    return c.g + 0.2126f * (c.r - c.g) + 0.0722f * (c.b - c.g);
}

/// Filmic curve: Narkowicz' x(2.51x + 0.03)/(x(2.43x + 0.59) + 0.14) as a chain of steps of which
/// each is monotone after rounding, so that the whole is. x in [1e-20, 1e6]; result in [0, 1.033).
template <class T>
PILEUS_FN T filmic_curve(T x) {
    const T toe = x / (1.0f + 0.237619f / (x + 0.0119522f));
    return 1.0329218f / (1.0f + 0.230847f / toe);
}

/// Radiance to display-linear. Negative and NaN count as 0; anything huge as 1e6 after the gain.
template <class T>
PILEUS_FN Rgb<T> tone_curve(Rgb<T> radiance, float gain) {
    const T dark = all<T>(1e-20f), bright = all<T>(1e6f);
    const T r = min_(max_(radiance.r * gain, dark), bright);
    const T g = min_(max_(radiance.g * gain, dark), bright);
    const T b = min_(max_(radiance.b * gain, dark), bright);

    // Let what is brighter than white paper lose its colour as film does. The share stays below
    // 0.8 m^2/(m^2 + 9), for which every channel still grows with the exposure.
    const T m = max_(max_(r, g), b);
    const T share = 0.8f / (1.0f + 9.0f / (m * m));
    const T y = luminance(Rgb<T>{r, g, b});
    return {filmic_curve(max_(r + share * (y - r), dark)),
            filmic_curve(max_(g + share * (y - g), dark)),
            filmic_curve(max_(b + share * (y - b), dark))};
}

}  // namespace PILEUS_ISA
}  // namespace pileus
