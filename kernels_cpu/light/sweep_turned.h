// SPDX-License-Identifier: Apache-2.0
// The sweep where slices follow one another along x: rows become lanes.
// in: a block of rows and planes -> out: its optical depths, column by column.
// docs/buffer.md. Some columns of a block are turned into scratch where rows lie side by side,
// swept there and turned back: a node of a row waits for the node before it, rows do not wait for
// rows.
#pragma once
#include "kernels_cpu/light/sweep.h"

namespace pileus {
inline namespace PILEUS_ISA {

/// Columns that are turned at a time.
constexpr std::int32_t kSweepColumns = 64;

/// at[1 + column][1 + row], both counted from the sun; [0] is the neighbour nearer the sun.
struct TurnedColumns {
    float at[kSweepColumns + 1][kSweepRows + 1];
};

/// Columns from c0 on; `block` has their rows, of plane `plane` counted from the sun.
struct TurnedPart {
    SweepBlock block;
    std::int32_t plane, c0, columns;
};

PILEUS_FN std::int64_t turned_row(const SweepParams& k, const TurnedPart& p, std::int32_t row) {
    // Lanes past the last row repeat it. Before the first one its weight is 0, any number will do.
    const std::int32_t m = max_(min_(p.block.y0 + row, p.block.y1 - 1), std::int32_t{0});
    const std::int64_t y = from_sun(m, k.size[1], k.step[1]);
    const std::int64_t z = from_sun(p.plane, k.size[2], k.step[2]);
    return (z * k.size[1] + y) * k.size[0];
}

/// Turns rows [0, rows) and columns [-1, columns) of a part into `to`; row 0 and column -1 are the
/// neighbours of the first ones. Before the grid's first column there is 0.
PILEUS_FN void turn_in(const SweepParams& k, const float* from, const TurnedPart& p,
                       std::int32_t rows, std::int32_t columns, TurnedColumns& to) {
    const std::int32_t begin = p.c0 > 0 ? -1 : 0;
    for (std::int32_t l = 0; l < rows; ++l) {
        const float* row = from + turned_row(k, p, l - 1) + from_sun(p.c0, k.size[0], k.step[0]);
        if (begin == 0) to.at[0][l] = 0.0f;
        for (std::int32_t c = begin; c < columns; ++c) to.at[c + 1][l] = row[0 - c * k.step[0]];
    }
}
PILEUS_FN void turn_out(const SweepParams& k, const TurnedColumns& from, const TurnedPart& p,
                        float* to) {
    for (std::int32_t l = 0; l < p.block.y1 - p.block.y0; ++l) {
        float* row = to + turned_row(k, p, l) + from_sun(p.c0, k.size[0], k.step[0]);
        for (std::int32_t c = 0; c < p.columns; ++c) row[0 - c * k.step[0]] = from.at[c + 1][l + 1];
    }
}

/// Weights of W rows; the row nearest the sun has its own.
template <class T>
struct LaneTaps {
    T above[4], far[4], near[4];
};
template <class T>
PILEUS_FN LaneTaps<T> lane_taps(const SweepTaps* taps, bool first) {
    LaneTaps<T> w;
    for (int i = 0; i < 4; ++i) {
        w.above[i] = all<T>(taps[0].above[i]);
        w.far[i] = all<T>(taps[0].far[i]);
        w.near[i] = all<T>(taps[0].near[i]);
        if (!first) continue;
        set_lane(w.above[i], 0, taps[kSweepRimU].above[i]);
        set_lane(w.far[i], 0, taps[kSweepRimU].far[i]);
        set_lane(w.near[i], 0, taps[kSweepRimU].near[i]);
    }
    return w;
}

/// This plane and the one nearer the sun.
using Turned = TurnedColumns* [2];

/// W rows of one column from row l on.
template <class T>
PILEUS_FN void sweep_column(const LaneTaps<T>& w, const Turned& tau, const Turned& density,
                            std::int32_t c, std::int32_t l) {
    T above[4], far[4], near[4];
    for (int i = 0; i < 4; ++i) {
        const std::int32_t row = (i & 1) != 0 ? l : l + 1;
        above[i] = load_sweep<T>(tau[i / 2]->at[c] + row);
        far[i] = load_sweep<T>(density[i / 2]->at[c] + row);
        near[i] = load_sweep<T>(density[i / 2]->at[c + 1] + row);
    }
    const T sum = sweep_sum(w.above, w.far, w.near, above, far, near);
    __builtin_memcpy(tau[0]->at[c + 1] + l + 1, &sum, sizeof sum);
}

template <int W>
PILEUS_FN void sweep_turned_part(const SweepParams& k, const TurnedPart& p, const Turned& tau,
                                 const Turned& density) {
    const SweepTaps* taps = k.taps + (p.plane == 0 ? kSweepRimV : 0);
    for (std::int32_t l = 0; l < kSweepRows; l += W) {
        const bool first = l == 0 && p.block.y0 == 0;
        std::int32_t c = 0;
        if (p.c0 == 0) sweep_column(lane_taps<F<W>>(taps + kSweepTop, first), tau, density, c++, l);
        const LaneTaps<F<W>> w = lane_taps<F<W>>(taps, first);
        for (; c < p.columns; ++c) sweep_column(w, tau, density, c, l);
    }
}

/// At most kSweepRows rows.
template <int W>
PILEUS_FN void sweep_turned_rows(const SweepParams& k, const SweepBuffers& b, SweepBlock block) {
    constexpr std::int32_t rows = kSweepRows + 1;
    // Beyond the grid's rims any number will do, for its weight is 0; densities are numbers.
    const float* before_rows = block.y0 > 0 ? b.optical_depth : b.density;
    const float* before_planes = block.z0 > 0 ? b.optical_depth : b.density;
    TurnedColumns tau[2], density[2];
    for (std::int32_t c0 = 0; c0 < k.size[0]; c0 += kSweepColumns) {
        const std::int32_t columns = min_(kSweepColumns, k.size[0] - c0);
        TurnedPart p{block, max_(block.z0 - 1, std::int32_t{0}), c0, columns};
        turn_in(k, b.density, p, rows, columns, density[1]);
        turn_in(k, before_planes, p, rows, columns, tau[1]);
        for (p.plane = block.z0; p.plane < block.z1; ++p.plane) {
            const int own = (p.plane - block.z0) & 1, nearer = own ^ 1;
            turn_in(k, b.density, p, rows, columns, density[own]);
            // What is known of this plane: the column before all rows, the row before all columns.
            turn_in(k, b.optical_depth, p, rows, 0, tau[own]);
            turn_in(k, before_rows, p, 1, columns, tau[own]);
            const Turned taus{&tau[own], &tau[nearer]};
            const Turned densities{&density[own], &density[nearer]};
            sweep_turned_part<W>(k, p, taus, densities);
            turn_out(k, tau[own], p, b.optical_depth);
        }
    }
}

/// Slices along x.
template <int W>
PILEUS_FN void sweep_block_of_columns(const SweepParams& k, const SweepBuffers& b,
                                      SweepBlock block) {
    const std::int32_t end = block.y1;
    for (; block.y0 < end; block.y0 += kSweepRows) {
        block.y1 = min_(block.y0 + kSweepRows, end);
        sweep_turned_rows<W>(k, b, block);
    }
}

template <int W>
PILEUS_FN void sweep_blocks(const SweepParams& k, const SweepBuffers& b, std::uint32_t begin,
                            std::uint32_t end) {
    for (auto y = std::int32_t(begin); y < std::int32_t(end); ++y) {
        const auto block = std::uint32_t((k.diagonal - y) * k.blocks[0] + y);
        if (k.axis == 0)
            sweep_block_of_columns<W>(k, b, sweep_block_at(k, block));
        else
            sweep_block_of_rows<W>(k, b, sweep_block_at(k, block));
    }
}

}  // namespace PILEUS_ISA
}  // namespace pileus
