// SPDX-License-Identifier: Apache-2.0
// Tone curves in double, so that they stay monotone over neighbouring floats.
// in: radiance, a gain -> out: see tones.h.
// Hable 2010, "Uncharted 2: HDR lighting" (GDC). AgX: T. Sobotka; fit by B. Wrensch 2023, "Minimal
// AgX implementation" (iolite-engine.com), with rows of its matrices scaled to the sum 1.
#include "src/io/images/develop/tones.h"

#include "src/base/powers.h"

namespace pileus {
namespace {

struct ToneRow {
    const char* name;
    double factor;
};
constexpr ToneRow kToneRows[] = {{"standard", 1},
                                 {"hable", 4.903684},
                                 {"agx", 1.416265},
                                 {"agx-punchy", 2.339024},
                                 {"linear", 1}};

double hable_curve(double x) {
    constexpr double a = 0.15, b = 0.5, c = 0.1, d = 0.2, e = 0.02, f = 0.3;
    return (x * (a * x + c * b) + d * e) / (x * (a * x + b) + d * f) - e / f;
}

/// A channel and the next two, moved by shares of their differences: equal ones stay as they are.
double mixed(double own, double next, double last, double by_next, double by_last) {
    return own + by_next * (next - own) + by_last * (last - own);
}

/// Light to the exponent that the curve gives it, before the primaries are put apart.
double agx_curve(double x) {
    constexpr double kLow = -12.47393, kHigh = 4.026069;
    double t = (log2_of(x > 1e-10 ? x : 1e-10) - kLow) / (kHigh - kLow);
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return (((((15.5 * t - 40.14) * t + 31.96) * t - 6.868) * t + 0.4298) * t + 0.1191) * t -
           0.00232;
}

/// Wrensch's "punchy" of encoded light: more contrast, and colours farther from grey.
void make_punchy(double (&v)[3]) {
    for (double& c : v) c = power_of(c, 1.35);
    const double y = v[1] + 0.2126 * (v[0] - v[1]) + 0.0722 * (v[2] - v[1]);
    for (double& c : v) c = y + 1.4 * (c - y);
}

Rgb<double> agx_tone(Rgb<double> x, bool punchy) {
    // Primaries are drawn together, each by its own shares, so that strong colours end in white.
    double e[3] = {agx_curve(mixed(x.r, x.g, x.b, 0.0784335999999992, 0.0792237451477643)),
                   agx_curve(mixed(x.g, x.b, x.r, 0.0791661274605434, 0.0423282422610123)),
                   agx_curve(mixed(x.b, x.r, x.g, 0.0423756549057051, 0.0784336))};
    if (punchy) make_punchy(e);
    const double v[3] = {mixed(e[0], e[1], e[2], -0.0980208811401368, -0.0990297440797205),
                         mixed(e[1], e[2], e[0], -0.0989611768448433, -0.0528968517574562),
                         mixed(e[2], e[0], e[1], -0.0529716355144438, -0.0980434501171241)};
    return {power_of(v[0], 2.2), power_of(v[1], 2.2), power_of(v[2], 2.2)};
}

double bounded(float radiance, double gain) {
    const double x = double(radiance) * gain;
    return x > 0 ? (x < 1e6 ? x : 1e6) : 0;
}

}  // namespace

std::string tone_names() {
    std::string names;
    for (const ToneRow& row : kToneRows)
        names += (names.empty() ? "" : ", ") + std::string(row.name);
    return names;
}

bool find_tone(const std::string& name, Tone& tone) {
    int place = 0;
    for (const ToneRow& row : kToneRows) {
        if (name == row.name) tone = Tone(place);
        if (name == row.name) return true;
        ++place;
    }
    return false;
}

double tone_factor(Tone tone) { return kToneRows[int(tone)].factor; }

Rgb<float> apply_tone(Tone tone, Rgb<float> radiance, float gain) {
    if (tone == Tone::kStandard) return tone_curve(radiance, gain);
    const double by = double(gain) * tone_factor(tone);
    Rgb<double> x{bounded(radiance.r, by), bounded(radiance.g, by), bounded(radiance.b, by)};
    if (tone == Tone::kHable) {
        const double white = hable_curve(11.2);
        x = {hable_curve(x.r) / white, hable_curve(x.g) / white, hable_curve(x.b) / white};
    } else if (tone != Tone::kLinear) {
        x = agx_tone(x, tone == Tone::kAgxPunchy);
    }
    return {float(x.r), float(x.g), float(x.b)};
}

}  // namespace pileus
