// SPDX-License-Identifier: Apache-2.0
// Fills the planes of pictures that show a comparison.
// in: PicturePair, FlipResult -> out: Image.
// Magma: S. van der Walt and N. Smith, matplotlib (CC0), 17 of its 256 colours; docs/compare.md
#include "lab/compare/difference.h"

#include <cmath>

#include "lab/compare/metrics_pair.h"
#include "src/io/images/srgb.h"

namespace pileus {

namespace {

struct Colour {
    double r, g, b;  ///< sRGB, 0..1
};

constexpr Colour kMagma[17] = {
    {0.001462, 0.000466, 0.013866}, {0.039608, 0.031090, 0.133515}, {0.113094, 0.065492, 0.276784},
    {0.211718, 0.061992, 0.418647}, {0.316654, 0.071690, 0.485380}, {0.414709, 0.110431, 0.504662},
    {0.512831, 0.148179, 0.507648}, {0.613617, 0.181811, 0.498536}, {0.716387, 0.214982, 0.475290},
    {0.816914, 0.255895, 0.436461}, {0.904281, 0.319610, 0.388137}, {0.960949, 0.418323, 0.359630},
    {0.986700, 0.535582, 0.382210}, {0.996096, 0.653659, 0.446213}, {0.996898, 0.769591, 0.534892},
    {0.992440, 0.884330, 0.640099}, {0.987053, 0.991438, 0.749504}};
constexpr Colour kSigned[5] = {{0.02, 0.16, 0.42},
                               {0.26, 0.58, 0.80},
                               {0.97, 0.97, 0.97},
                               {0.89, 0.42, 0.30},
                               {0.45, 0.00, 0.10}};
constexpr Colour kLeftOut = {0.55, 0.55, 0.55}, kNotFinite = {1, 0.95, 0};

/// Between the nodes of a map, t in [0, 1].
template <int N>
Colour between(const Colour (&nodes)[N], double t) {
    const double place = (t < 0 ? 0 : t > 1 ? 1 : t) * (N - 1);
    int n = int(place);
    if (n > N - 2) n = N - 2;
    const double f = place - n;
    const Colour &p = nodes[n], &q = nodes[n + 1];
    return {p.r + f * (q.r - p.r), p.g + f * (q.g - p.g), p.b + f * (q.b - p.b)};
}

Status make_planes(int width, int height, const char* names, Image& out) {
    out = Image();
    out.width = width;
    out.height = height;
    for (const char* name = names; *name != '\0'; ++name) {
        out.channels.emplace_back();
        out.channels.back().name = *name;
        PILEUS_TRY(out.channels.back().pixels.resize(std::uint64_t(width) * std::uint64_t(height),
                                                     "picture of a comparison"));
    }
    return Status::ok();
}

void put(Image& out, std::size_t i, const Colour& colour) {
    const double srgb[3] = {colour.r, colour.g, colour.b};
    for (std::size_t c = 0; c < 3; ++c) out.channels[c].pixels[i] = float(linear_of_srgb(srgb[c]));
}

/// `value(channel, pixel, known)` over the counted pixels.
template <class Value>
Status fill(const PicturePair& pair, Image& out, Value&& value) {
    PILEUS_TRY(make_planes(pair.width, pair.height, "RGBA", out));
    for (std::size_t i = 0; i < pair.pixels(); ++i) {
        if (!pair.in_cloud(i)) continue;
        bool known = true;
        for (int c = 0; c < 3; ++c)
            out.channels[std::size_t(c)].pixels[i] =
                pair.finite(i) ? float(value(c, i, known)) : std::nanf("");
        out.channels[3].pixels[i] = known ? 1.0f : 0.0f;
    }
    return Status::ok();
}

}  // namespace

Status difference_picture(const Image& a, const Image& reference, double alpha_least, Image& out) {
    PicturePair pair;
    PILEUS_TRY(pair_pictures(a, reference, alpha_least, pair));
    return fill(pair, out, [&](int c, std::size_t i, bool&) { return pair.difference(c, i); });
}

Status z_picture(const Image& a, const Image& reference, double alpha_least, Image& out) {
    PicturePair pair;
    PILEUS_TRY(pair_pictures(a, reference, alpha_least, pair));
    if (pair.a_error[0] == nullptr && pair.r_error[0] == nullptr)
        return Status::bad_input(
            "z map: error layers: missing, allowed: error.R error.G error.B in either picture");
    return fill(pair, out, [&](int c, std::size_t i, bool& known) {
        const double variance = pair.variance(c, i);
        known = known && variance > 0;
        return variance > 0 ? pair.difference(c, i) / std::sqrt(variance) : 0.0;
    });
}

Status flip_picture(const FlipResult& result, Image& out) {
    PILEUS_TRY(make_planes(result.width, result.height, "Y", out));
    for (std::size_t i = 0; i < result.value.size(); ++i)
        out.channels[0].pixels[i] = result.value[i];
    return Status::ok();
}

Status signed_colours(const Image& values, double scale, Image& out) {
    PILEUS_TRY(make_planes(values.width, values.height, "RGB", out));
    out.display_colours = true;
    if (!(scale > 0)) scale = 1;
    const float* plane[4];
    for (std::size_t c = 0; c < 4; ++c) plane[c] = values.channels[c].pixels.data();
    for (std::size_t i = 0; i < values.channels[0].pixels.size(); ++i) {
        const double mean = (double(plane[0][i]) + double(plane[1][i]) + double(plane[2][i])) / 3;
        const bool counted = plane[3][i] > 0;
        put(out, i,
            !counted               ? kLeftOut
            : !std::isfinite(mean) ? kNotFinite
                                   : between(kSigned, 0.5 + 0.5 * (mean / scale)));
    }
    return Status::ok();
}

Status flip_colours(const FlipResult& result, Image& out) {
    PILEUS_TRY(make_planes(result.width, result.height, "RGB", out));
    out.display_colours = true;
    for (std::size_t i = 0; i < result.value.size(); ++i)
        put(out, i, between(kMagma, double(result.value[i])));
    return Status::ok();
}

}  // namespace pileus
