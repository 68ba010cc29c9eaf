// SPDX-License-Identifier: Apache-2.0
// Power of every texel of a sky map towards a box, as tables of whole numbers to draw from.
// in: radiance per texel, the box -> out: cumulative powers, bounds, flux, light on the ground.
// docs/methods.md 3 "Sky map". The integrals over a texel part into a row's and a column's.
#include "src/base/angles.h"
#include "src/world/light/sky_map.h"

namespace pileus {
namespace {

double magnitude(double v) { return v < 0 ? -v : v; }
double larger(double a, double b) { return a > b ? a : b; }
double smaller(double a, double b) { return a < b ? a : b; }

std::int64_t floor_of(double v) {
    const std::int64_t i = std::int64_t(v);
    return double(i) > v ? i - 1 : i;
}

/// Integral of f over [a, b] turns, in radians: Gauss-Legendre, 8 points between quarter turns,
/// where |sin| and |cos| have their kinks. Relative error 1e-12 for what is asked here.
template <class Function>
double integrate(double a, double b, Function f) {
    static constexpr double kAt[4] = {0.18343464249564980494, 0.52553240991632898582,
                                      0.79666647741362673959, 0.96028985649753623168};
    static constexpr double kWeight[4] = {0.36268378337836198297, 0.31370664587788728734,
                                          0.22238103445337447054, 0.10122853629037625915};
    double sum = 0;
    for (std::int64_t quarter = floor_of(a * 4); a < b; ++quarter) {
        const double end = smaller(b, double(quarter + 1) * 0.25);
        const double middle = 0.5 * (a + end), half = 0.5 * (end - a);
        for (int i = 0; half > 0 && i < 4; ++i)
            sum += kWeight[i] * half * (f(middle - half * kAt[i]) + f(middle + half * kAt[i]));
        a = larger(a, end);
    }
    return sum * kTwoPi64;
}

/// Most of |sin| over [a, b] turns.
double most_sine(double a, double b) {
    if (floor_of((a - 0.25) * 2) != floor_of((b - 0.25) * 2)) return 1;
    return larger(magnitude(sincos_deg(360 * a).sine), magnitude(sincos_deg(360 * b).sine));
}

/// What a row (angle from the zenith) or a column (azimuth) brings into a texel's integral.
struct Part {
    double a, b;              ///< row: of sin^2, of |sin cos|; column: of |sin|, of |cos|
    double bound_a, bound_b;  ///< their largest values there
};

/// Row i shines with its own value from where its neighbours' centres lie; the outermost rows up
/// to the zenith and the foot.
Part row_part(const SkyMapView& v, int i) {
    const double turns = 1.0 / double(v.rows_per_turn), foot = double(v.foot);
    Part part{};
    for (int k = -1; k < 3; ++k) {
        const double from = larger(0, i + 0.5 * k), to = smaller(foot, i + 0.5 * (k + 1));
        const auto share = [&](double turn) {
            const double p = turn / turns;
            const double held = smaller(larger(p, 0.5), double(v.rows) - 0.5);
            return larger(0, 1 - magnitude(held - (i + 0.5)));
        };
        part.a += integrate(from * turns, to * turns, [&](double turn) {
            const double s = sincos_deg(360 * turn).sine;
            return share(turn) * s * s;
        });
        part.b += integrate(from * turns, to * turns, [&](double turn) {
            const SineCosine s = sincos_deg(360 * turn);
            return share(turn) * magnitude(s.sine * s.cosine);
        });
    }
    const double from = larger(0, i - 0.5) * turns, to = smaller(foot, i + 1.5) * turns;
    const double sine = most_sine(from, to);
    part.bound_a = sine * sine;
    part.bound_b = 0.5 * most_sine(2 * from, 2 * to);
    return part;
}

Part column_part(const SkyMapView& v, int j) {
    const double turns = 1.0 / double(v.columns), first = double(v.turn_of_first);
    const double centre = (j + 0.5) * turns + first;
    const auto share = [&](double turn) { return 1 - magnitude(turn - centre) / turns; };
    Part part{};
    for (int k = -1; k < 1; ++k) {
        const double from = centre + k * turns, to = centre + (k + 1) * turns;
        part.a += integrate(from, to, [&](double turn) {
            return share(turn) * magnitude(sincos_deg(360 * turn).sine);
        });
        part.b += integrate(from, to, [&](double turn) {
            return share(turn) * magnitude(sincos_deg(360 * turn).cosine);
        });
    }
    part.bound_a = most_sine(centre - turns, centre + turns);
    part.bound_b = most_sine(centre - turns + 0.25, centre + turns + 0.25);
    return part;
}

/// Rounded up, so that it also bounds what the kernel computes in single precision.
float bound_of(double v) { return float(v * (1 + 1e-5) + 1e-6); }

struct Parts {
    Buffer<Part> rows, columns;
};

Status measure(SkyMap& map, Parts& parts) {
    const SkyMapView& v = map.view;
    const std::size_t rows = std::size_t(v.rows), columns = std::size_t(v.columns);
    PILEUS_TRY(parts.rows.resize(rows, "sky map"));
    PILEUS_TRY(parts.columns.resize(columns, "sky map"));
    PILEUS_TRY(map.row_bound.resize(2 * rows, "sky map"));
    PILEUS_TRY(map.column_bound.resize(2 * columns, "sky map"));
    for (std::size_t i = 0; i < rows; ++i) {
        const Part part = parts.rows[i] = row_part(v, int(i));
        map.row_bound[i] = bound_of(part.bound_a);
        map.row_bound[rows + i] = bound_of(part.bound_b);
    }
    for (std::size_t j = 0; j < columns; ++j) {
        const Part part = parts.columns[j] = column_part(v, int(j));
        map.column_bound[j] = bound_of(part.bound_a);
        map.column_bound[columns + j] = bound_of(part.bound_b);
    }
    return Status::ok();
}

}  // namespace

/// Irradiance of the upper half on a level plane: the sky above the horizon alone, so with a
/// ground the rows that are kept.
void light_ground(SkyMap& map) {
    const SkyMapView& v = map.view;
    const std::size_t columns = std::size_t(v.columns);
    const std::size_t plane = std::size_t(v.rows) * columns;
    Double3 sum{};
    for (std::size_t i = 0; i < std::size_t(v.rows); ++i) {
        const double level = row_part(v, int(i)).b;
        for (std::size_t c = 0; c < 3; ++c) {
            const float* from = v.radiance + (v.planes == 1 ? 0 : c * plane) + i * columns;
            double row = 0;
            for (std::size_t j = 0; j < columns; ++j) row += double(from[j]);
            sum[int(c)] += row * level;
        }
    }
    map.ground_irradiance = sum * kTwoPi64 / double(v.columns);
}

double fill_cdf(const double* power, int count, std::int32_t* cdf) {
    double total = 0, sum = 0;
    int last = 0;
    for (int i = 0; i < count; ++i) {
        total += power[i];
        if (power[i] > 0) last = i;
    }
    for (int i = 0; i < count; ++i) {
        sum += power[i];
        const double units = total > 0 ? sum / total * 2147483648.0 + 0.5 : 0;
        const std::uint32_t bound = i >= last ? 0x80000000u : std::uint32_t(units);
        std::memcpy(cdf + i, &bound, sizeof bound);
    }
    return total;
}

Status aim_sky_map(const double (&extent_m)[3], bool periodic, SkyMap& map) {
    SkyMapView& v = map.view;
    const std::size_t rows = std::size_t(v.rows), columns = std::size_t(v.columns);
    const std::size_t plane = rows * columns;
    Parts parts;
    Buffer<double> power, of_row;
    PILEUS_TRY(measure(map, parts));
    PILEUS_TRY(map.row_cdf.resize(rows, "sky map"));
    PILEUS_TRY(map.column_cdf.resize(plane, "sky map"));
    PILEUS_TRY(power.resize(columns, "sky map"));
    PILEUS_TRY(of_row.resize(rows, "sky map"));
    const double sides = periodic ? 0 : extent_m[2];
    const double face[3] = {extent_m[1] * sides, sides * extent_m[0], extent_m[0] * extent_m[1]};
    const double turn = kTwoPi64 / double(columns);
    for (std::size_t i = 0; i < rows; ++i) {
        const Part& row = parts.rows[i];
        for (std::size_t j = 0; j < columns; ++j) {
            const Part& column = parts.columns[j];
            double most = 0;
            for (std::size_t c = 0; c < std::size_t(v.planes); ++c)
                most = larger(most, double(v.radiance[c * plane + i * columns + j]));
            const double side = face[0] * column.a + face[1] * column.b;
            power[j] = most * (row.a * side + row.b * face[2] * turn);
        }
        of_row[i] = fill_cdf(power.data(), v.columns, map.column_cdf.data() + i * columns);
    }
    map.power_m2 = fill_cdf(of_row.data(), v.rows, map.row_cdf.data());
    v.row_cdf = map.row_cdf.data();
    v.column_cdf = map.column_cdf.data();
    v.row_bound = map.row_bound.data();
    v.column_bound = map.column_bound.data();
    return Status::ok();
}

}  // namespace pileus
