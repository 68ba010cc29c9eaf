// SPDX-License-Identifier: Apache-2.0
// See phase_table.h.
// in: nodes -> out: arrays of kernels_cpu/media/phase_table.h.
// docs/phase.md, "Tables".
#include "src/world/phase/phase_table.h"

#include "src/base/angles.h"

namespace pileus {
namespace {

constexpr double kMaxPeak = 1e15;
constexpr float kMinWidth = 1e-37f;

std::int32_t slots_of(std::size_t cells) {
    std::int32_t slots = 64;
    while (std::size_t(slots) < cells) slots *= 2;
    return slots;
}

/// Where a node lies: 1 - cos and 1 + cos, each with all its digits where it is the smaller.
struct NodePlace {
    double minus, plus;
};
NodePlace place_of(double angle_deg) {
    const SineCosine half = sincos_deg(0.5 * angle_deg);
    if (angle_deg <= 90) {
        const double minus = double(float(2 * half.sine * half.sine));
        return {minus, 2 - minus};
    }
    const double plus = double(float(2 * half.cosine * half.cosine));
    return {2 - plus, plus};
}

/// The arrays while they are filled.
struct Arrays {
    std::size_t nodes;
    float *turn, *density, *share, *base, *width;
};
Arrays arrays_in(Buffer<float>& numbers, std::size_t nodes) {
    float* at = numbers.data();
    return {nodes, at, at + nodes, at + 2 * nodes, at + 3 * nodes, at + 4 * nodes};
}

void set_cells(const PhaseNodes& nodes, Arrays& a, PhaseTable& table) {
    for (std::size_t i = 0; i < a.nodes; ++i) a.turn[i] = float(place_of(nodes.angle_deg[i]).minus);
    for (std::size_t i = 0; i + 1 < a.nodes; ++i) {
        const NodePlace first = place_of(nodes.angle_deg[i]),
                        last = place_of(nodes.angle_deg[i + 1]);
        const bool front = a.turn[i] < 1.0f;
        a.base[i] = float(front ? first.minus : last.plus);
        const float width = float(front ? last.minus - first.minus : first.plus - last.plus);
        a.width[i] = width > kMinWidth ? width : kMinWidth;
        if (front) table.forward = std::int32_t(i) + 1;
    }
}

/// Light of a cell that is linear in the cosine.
double light_of(double first, double last, float width) {
    return 0.5 * kTwoPi64 * (first + last) * double(width);
}

Status set_density(const std::string& name, const PhaseNodes& nodes, Arrays& a, PhaseTable& table) {
    // Scale by the largest first, so that no sum leaves the range of numbers.
    double largest = 0, light = 0;
    for (double v : nodes.value.span()) largest = v > largest ? v : largest;
    if (!(largest > 0))
        return Status::bad_input(name + ": values: all zero, allowed: one above 0 at the least");
    for (std::size_t i = 0; i + 1 < a.nodes; ++i)
        light += light_of(nodes.value[i] / largest, nodes.value[i + 1] / largest, a.width[i]);
    if (!(1 / light < kMaxPeak))
        return Status::bad_input(name +
                                 ": values: a peak too narrow, allowed: up to 1e15 per "
                                 "steradian once the light over the sphere is 1");
    table.peak = 0;
    for (std::size_t i = 0; i < a.nodes; ++i) {
        a.density[i] = float(nodes.value[i] / largest / light);
        if (a.density[i] > table.peak) table.peak = a.density[i];
    }
    return Status::ok();
}

/// Adds up the light of the densities as they are rounded, so that draws follow just those.
void set_shares(Arrays& a) {
    double total = 0, sum = 0;
    const auto light = [&](std::size_t i) {
        return light_of(double(a.density[i]), double(a.density[i + 1]), a.width[i]);
    };
    for (std::size_t i = 0; i + 1 < a.nodes; ++i) total += light(i);
    for (std::size_t i = 0; i + 1 < a.nodes; ++i) {
        a.share[i] = float(sum / total);
        sum += light(i);
    }
    // Cells without light at the end must not be drawn: they begin at 1 exactly.
    a.share[a.nodes - 1] = 1;
    for (std::size_t i = a.nodes - 1; i-- > 0 && light(i) <= 0;) a.share[i] = 1;
}

/// First cell that may be meant in each slot: the last whose own slot is lower. Returns the
/// halvings that any slot needs.
template <class SlotOf>
std::int32_t set_guide(std::int32_t slots, std::size_t cells, SlotOf slot_of, std::int32_t* guide) {
    std::size_t cell = 0;
    std::int32_t most = 0;
    for (std::int32_t slot = 0; slot <= slots; ++slot) {
        while (cell + 1 < cells && slot_of(cell + 1) < slot) ++cell;
        guide[slot] = std::int32_t(cell);
        if (slot > 0 && guide[slot] - guide[slot - 1] > most) most = guide[slot] - guide[slot - 1];
    }
    std::int32_t steps = 0;
    while ((std::int64_t{1} << steps) < std::int64_t(most) + 1) ++steps;
    return steps;
}

}  // namespace

void point_into(PhaseStore& store) {
    PhaseTable& table = store.table[0];
    const Arrays a = arrays_in(store.numbers, std::size_t(table.cells) + 1);
    table.turn = a.turn, table.base = a.base, table.width = a.width;
    table.density = a.density, table.share = a.share;
    table.draw_guide = store.guides.data();
    table.find_guide = table.draw_guide + table.slots + 1;
}

bool is_whole(const PhaseStore& store) {
    if (store.table.size() != 1) return false;
    const PhaseTable& table = store.table[0];
    const std::int64_t most = std::int64_t(kMaxPhaseNodes);
    return table.cells >= 1 && table.cells < most && table.slots >= 1 && table.slots <= 2 * most &&
           store.numbers.size() == 5 * (std::size_t(table.cells) + 1) &&
           store.guides.size() == 2 * (std::size_t(table.slots) + 1);
}

Status make_phase_table(const std::string& name, const PhaseNodes& nodes, PhaseStore& out) {
    const std::size_t count = nodes.value.size(), cells = count - 1;
    assert(count >= 2 && count <= kMaxPhaseNodes && nodes.angle_deg.size() == count);
    const std::int32_t slots = slots_of(cells);
    PILEUS_TRY(out.table.resize(1, "phase table"));
    PILEUS_TRY(out.numbers.resize(5 * count, "phase table"));
    PILEUS_TRY(out.guides.resize(2 * (std::size_t(slots) + 1), "phase table"));
    PhaseTable& table = out.table[0];
    Arrays a = arrays_in(out.numbers, count);
    table.cells = std::int32_t(cells);
    table.slots = slots;
    set_cells(nodes, a, table);
    PILEUS_TRY(set_density(name, nodes, a, table));
    set_shares(a);

    std::int32_t* draw = out.guides.data();
    std::int32_t* find = draw + slots + 1;
    point_into(out);
    table.draw_steps = set_guide(
        slots, cells, [&](std::size_t i) { return draw_slot(slots, a.share[i]); }, draw);
    table.find_steps = set_guide(
        slots, cells, [&](std::size_t i) { return find_slot(slots, a.turn[i]); }, find);
    double moment[kPhaseMoments];
    phase_table_moments(table, kPhaseMoments, moment);
    for (int l = 0; l < kPhaseMoments; ++l) table.moment[l] = float(moment[l]);
    return Status::ok();
}

}  // namespace pileus
