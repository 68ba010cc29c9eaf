// SPDX-License-Identifier: Apache-2.0
// Legendre moments of tables, and tables from moments; see phase_table.h.
// in: a table, or moments -> out: moments, or nodes.
// docs/phase.md, "Moments"; Abramowitz and Stegun 8.5.3, table 25.4.
#include "src/base/angles.h"
#include "src/world/phase/phase_table.h"

namespace pileus {
namespace {

/// Gauss's eight points on [-1, 1]: the positive half.
constexpr double kNode[4] = {0.18343464249564980494, 0.52553240991632898582, 0.79666647741362673959,
                             0.96028985649753623168};
constexpr double kWeight[4] = {0.36268378337836198297, 0.31370664587788728734,
                               0.22238103445337447054, 0.10122853629037625915};

/// Adds `light` that turns to `cosine` to the moments.
void add_light(double cosine, double light, int count, double* moment) {
    double p = 1, previous = 0;
    for (int l = 0; l < count; ++l) {
        moment[l] += light * p;
        const double next = ((2 * l + 1) * cosine * p - l * previous) / (l + 1);
        previous = p;
        p = next;
    }
}

/// Panels of a cell, so that P_l turns by no more than about a radian in each.
int panels_of(const PhaseTable& t, std::int32_t cell, int count) {
    const double a = double(t.base[cell]), b = a + double(t.width[cell]);
    // Angle to the pole is 2 asin sqrt(x/2) <= 1.12 sqrt(2x) up to 90 degrees, 2.3 sqrt(x/2)
    // beyond.
    const double turn = 2.3 * (__builtin_sqrt(0.5 * b) - __builtin_sqrt(0.5 * a));
    return 1 + int(turn * count);
}

}  // namespace

void phase_table_moments(const PhaseTable& t, int count, double* moment) {
    for (int l = 0; l < count; ++l) moment[l] = 0;
    for (std::int32_t cell = 0; cell < t.cells; ++cell) {
        const double first = double(t.density[cell]), last = double(t.density[cell + 1]);
        if (!(first + last > 0)) continue;
        const bool front = cell < t.forward;
        const double base = double(t.base[cell]), width = double(t.width[cell]);
        const int panels = panels_of(t, cell, count);
        for (int i = 0; i < 8 * panels; ++i) {
            const int k = i % 4;
            const double at = i % 8 < 4 ? kNode[k] : -kNode[k];
            const double f = (double(i / 8) + 0.5 + 0.5 * at) / panels;
            const double near = base + width * (front ? f : 1 - f);
            const double density = first + (last - first) * f;
            add_light(front ? 1 - near : near - 1,
                      kTwoPi64 * density * 0.5 * kWeight[k] * width / panels, count, moment);
        }
    }
}

double phase_table_share(const PhaseTable& t, double angle_deg) {
    const SineCosine half = sincos_deg(0.5 * angle_deg);
    const double minus = 2 * half.sine * half.sine, plus = 2 * half.cosine * half.cosine;
    double sum = 0;
    for (std::int32_t cell = 0; cell < t.cells; ++cell) {
        const double base = double(t.base[cell]), width = double(t.width[cell]);
        const double part = cell < t.forward ? (minus - base) / width : 1 - (plus - base) / width;
        if (!(part > 0)) break;
        const double f = part < 1 ? part : 1;
        const double first = double(t.density[cell]), last = double(t.density[cell + 1]);
        sum += kTwoPi64 * width * f * (first + 0.5 * f * (last - first));
    }
    return sum;
}

Status phase_nodes_from_moments(Span<const double> moment, PhaseNodes& nodes, double& clipped) {
    assert(moment.size >= 1 && moment.size <= kMaxPhaseMoments);
    const std::size_t wanted = 16 * moment.size < 720 ? 720 : 16 * moment.size;
    const std::size_t cells = wanted < kMaxPhaseNodes ? wanted : kMaxPhaseNodes - 1;
    PILEUS_TRY(nodes.angle_deg.resize(cells + 1, "phase table"));
    PILEUS_TRY(nodes.value.resize(cells + 1, "phase table"));
    double light = 0, below = 0;
    for (std::size_t i = 0; i <= cells; ++i) {
        const double angle = 180.0 * double(i) / double(cells);
        const SineCosine at = sincos_deg(angle);
        double sum = 0, p = 1, previous = 0;
        for (std::size_t l = 0; l < moment.size; ++l) {
            const double n = double(l);
            sum += (2 * n + 1) * moment[l] * p;
            const double next = ((2 * n + 1) * at.cosine * p - n * previous) / (n + 1);
            previous = p;
            p = next;
        }
        nodes.angle_deg[i] = angle;
        nodes.value[i] = sum > 0 ? sum : 0;
        light += at.sine * nodes.value[i];
        if (sum < 0) below -= at.sine * sum;
    }
    clipped = light > 0 ? below / light : 0;
    return Status::ok();
}

Status make_phase_from_moments(const std::string& name, Span<const double> moment, PhaseStore& out,
                               double& clipped) {
    PhaseNodes nodes;
    PILEUS_TRY(phase_nodes_from_moments(moment, nodes, clipped));
    return make_phase_table(name, nodes, out);
}

}  // namespace pileus
