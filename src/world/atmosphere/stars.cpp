// SPDX-License-Identifier: Apache-2.0
// See stars.h. Precession: Lieske 1979 (Meeus 1998, chapter 21); the galaxy's axes: Blaauw et al.
// 1960 at J2000; counts by magnitude: Allen 1976; light of faint stars: Leinert et al. 1998.
#include "src/world/atmosphere/stars.h"

#include "src/base/powers.h"
#include "src/world/atmosphere/earth_turn.h"
#include "src/world/atmosphere/star_catalogue.h"
#include "src/world/atmosphere/sun_position.h"

namespace pileus {
namespace {

constexpr double kFaintest = 6.5, kSunMagnitude = -26.74;
/// Logarithm of counts by magnitude: 92 to 2.5, 8768 to 6.5.
constexpr double kCountSlope = 0.495;
constexpr double kTenth = 0.4 * 3.3219280948873623479;  // log2 of a magnitude

/// Rows: towards the galaxy's middle, along its plane, its pole, in the equator of J2000.
constexpr double kGalaxy[3][3] = {{-0.0548755604, -0.8734370902, -0.4838350155},
                                  {0.4941094279, -0.4448296300, 0.7469822445},
                                  {-0.8676661490, -0.1980763734, 0.4559837762}};

/// R G B of B - V from -0.4 on, every 0.2: black bodies of Ballesteros' temperatures (2012), over
/// one of 0.65, through the CIE 1931 observer.
constexpr double kColours[][3] = {
    {0.660, 0.997, 2.026}, {0.716, 1.005, 1.783}, {0.777, 1.009, 1.563}, {0.842, 1.010, 1.366},
    {0.910, 1.007, 1.191}, {0.982, 1.002, 1.036}, {1.056, 0.994, 0.899}, {1.133, 0.983, 0.777},
    {1.211, 0.970, 0.670}, {1.292, 0.956, 0.575}, {1.373, 0.940, 0.492}, {1.457, 0.923, 0.418},
    {1.541, 0.905, 0.353}};
/// B - V that bright stars have, each as often.
constexpr double kOften[] = {-0.15, -0.08, 0.0, 0.08, 0.2, 0.35, 0.5, 0.85, 1.0, 1.1, 1.3, 1.55};

/// In [0, 1), of a number and which of its draws: a mix of its bits (Steele et al. 2014).
double chance(std::uint64_t number, std::uint64_t draw) {
    std::uint64_t z = (number * 4 + draw + 1) * 0x9e3779b97f4a7c15ull;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    z ^= z >> 31;
    return double(z >> 11) * 0x1p-53;
}

double dot(const double (&row)[3], const Double3& v) {
    return row[0] * v.x + row[1] * v.y + row[2] * v.z;
}

/// From the equator of J2000 to east, north and up.
struct Turn {
    double rows[3][3];

    explicit Turn(const Night& night) {
        const double t = night.centuries;
        const double zeta = t * (0.6406161 + 0.0000839 * t), z = t * (0.6406161 + 0.0003041 * t),
                     theta = t * (0.5567530 - 0.0001185 * t);
        for (int axis = 0; axis < 3; ++axis) {
            Double3 v{axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0};
            v = about_pole(v, zeta);
            v = {v.x * cosine(theta) - v.z * sine(theta), v.y,
                 v.x * sine(theta) + v.z * cosine(theta)};
            v = about_pole(v, z);
            v = about_pole(v, -night.sidereal_deg);
            const SineCosine at = sincos_deg(night.latitude_deg);
            rows[0][axis] = v.y;
            rows[1][axis] = v.z * at.cosine - v.x * at.sine;
            rows[2][axis] = v.x * at.cosine + v.z * at.sine;
        }
    }
    static Double3 about_pole(const Double3& v, double degrees) {
        const double c = cosine(degrees), s = sine(degrees);
        return {v.x * c - v.y * s, v.x * s + v.y * c, v.z};
    }
    Double3 operator()(const Double3& v) const {
        return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
    }
};

Star star_of(const Double3& to, double magnitude, double colour, bool refraction) {
    Star star{};
    const double share = exp2_of(-kTenth * (magnitude - kSunMagnitude));
    const std::array<double, 3> rgb = star_colour(colour);
    for (std::size_t c = 0; c < 3; ++c) star.light[c] = float(share * rgb[c]);
    Double3 seen = to;
    const double flat = __builtin_sqrt(to.x * to.x + to.y * to.y);
    if (refraction && to.z > -0.07 && flat > 1e-9) {
        const double height = angle_of_deg(to.z, flat);
        const SineCosine lifted = sincos_deg(height + refraction_deg(height));
        seen = {to.x / flat * lifted.cosine, to.y / flat * lifted.cosine, lifted.sine};
    }
    for (int a = 0; a < 3; ++a) star.to[a] = float(seen[a]);
    return star;
}

/// Where a faint star stands: over the galaxy's plane there are three times as many as at its
/// poles, (x + 1.25)^-2 of the sine of the latitude.
Double3 chance_place(std::uint64_t number) {
    constexpr double kWide = 1.25, kMost = 1 / kWide - 1 / (1 + kWide);
    const double off = 1 / (1 / kWide - chance(number, 0) * kMost) - kWide;
    const double up = off < 1 ? off : 1, side = __builtin_sqrt(1 - up * up);
    const SineCosine along = sincos_deg(360 * chance(number, 1));
    const Double3 g{side * along.cosine, side * along.sine, chance(number, 2) < 0.5 ? up : -up};
    Double3 out;
    for (int a = 0; a < 3; ++a)
        out[a] = kGalaxy[0][a] * g.x + kGalaxy[1][a] * g.y + kGalaxy[2][a] * g.z;
    return out;
}

// Faint light in stars of magnitude 10 per square degree: everywhere, and in the plane's middle;
// how wide the band is, as the sine of a latitude, and its mean over all latitudes.
constexpr double kAround = 22, kBand = 230, kBandWide = 0.18, kBandMean = 0.2507;

}  // namespace

std::array<double, 3> star_colour(double colour) {
    constexpr int kRows = int(sizeof kColours / sizeof kColours[0]);
    const double place = (colour + 0.4) / 0.2;
    const double held = place < 0 ? 0 : place > kRows - 1 ? kRows - 1 : place;
    const int low = held < kRows - 2 ? int(held) : kRows - 2;
    std::array<double, 3> out{};
    for (std::size_t c = 0; c < 3; ++c)
        out[c] = kColours[low][c] + (kColours[low + 1][c] - kColours[low][c]) * (held - low);
    return out;
}

double milky_way(const Stars& stars, const Double3& to) {
    double g[3];
    for (std::size_t a = 0; a < 3; ++a) {
        const Double3& axis = stars.galaxy[a];
        g[a] = axis.x * to.x + axis.y * to.y + axis.z * to.z;
    }
    const double off = g[2] / kBandWide;
    // Brighter towards its middle.
    return kStarOfTen * (kAround + kBand * (0.75 + 0.5 * g[0]) / (1 + off * off));
}

Status turn_stars(const Night& night, Stars& out) {
    if (!night.stars) {
        out = Stars{};
        return Status::ok();
    }
    if (out.present() && out.sidereal_deg == night.sidereal_deg &&
        out.latitude_deg == night.latitude_deg && out.centuries == night.centuries)
        return Status::ok();
    PILEUS_TRY(out.stars.resize(std::size_t(kStars), "stars"));
    out.sidereal_deg = night.sidereal_deg;
    out.latitude_deg = night.latitude_deg;
    out.centuries = night.centuries;
    const Turn turn(night);
    for (std::size_t a = 0; a < 3; ++a)
        out.galaxy[a] = turn({kGalaxy[a][0], kGalaxy[a][1], kGalaxy[a][2]});
    Double3 sum{};
    std::size_t number = 0;
    const auto add = [&](const Double3& to, double magnitude, double colour) {
        const Star star = star_of(turn(to), magnitude, colour, night.refraction);
        for (int c = 0; c < 3; ++c) sum[c] += double(star.light[c]);
        out.stars[number++] = star;
    };
    const Span<const CatalogueStar> bright = bright_stars();
    for (std::size_t i = 0; i < bright.size; ++i) {
        const CatalogueStar& s = bright.data[i];
        const SineCosine up = sincos_deg(s.declination_deg),
                         along = sincos_deg(s.right_ascension_deg);
        add({up.cosine * along.cosine, up.cosine * along.sine, up.sine}, s.magnitude, s.colour);
    }
    constexpr std::size_t kColoursOften = sizeof kOften / sizeof kOften[0];
    while (number < std::size_t(kStars)) {
        const double rank = double(number) + 0.5;
        const double magnitude =
            kFaintest + log2_of(rank / kStars) / (3.3219280948873623479 * kCountSlope);
        const auto which = std::size_t(chance(number, 3) * double(kColoursOften));
        add(chance_place(number), magnitude, kOften[which]);
    }
    const double faint = kStarOfTen * (kAround + kBand * 0.75 * kBandMean);
    for (int c = 0; c < 3; ++c) out.even[c] = sum[c] / (4 * kPi64) + faint;
    return Status::ok();
}

}  // namespace pileus
