// SPDX-License-Identifier: Apache-2.0
// Phase functions as tables: nodes become arrays for the kernels, with their guides and moments.
// in: values at angles, Legendre moments, or two tables -> out: one owned, normalised table.
// docs/phase.md, "Tables".
#pragma once
#include "kernels_cpu/media/phase.h"
#include "src/io/text/phase_file.h"

namespace pileus {

/// A table and the memory that it points into; its address stays when the owner moves.
struct PhaseStore {
    Buffer<PhaseTable> table;  ///< one, or none
    Buffer<float> numbers;
    Buffer<std::int32_t> guides;

    PhaseParams params() const { return {kPhaseTable, 0, 0, 1, 0, table.data()}; }
    std::uint64_t bytes() const { return table.bytes() + numbers.bytes() + guides.bytes(); }
};

/// Points the table at its arrays, whose sizes are those that its numbers ask for.
void point_into(PhaseStore& store);
/// Whether they are.
bool is_whole(const PhaseStore& store);

/// Largest share of the light that moments may be short of a phase function in a scene.
constexpr double kMaxClipped = 0.01;

/// Normalises to one over the sphere. kBadInput, opened with `name`: no light at all, or more than
/// 1e15 per steradian; kLimit: out of memory.
Status make_phase_table(const std::string& name, const PhaseNodes& nodes, PhaseStore& out);

/// Nodes of sum (2l+1) moment[l] P_l(cos), moment[0] = 1, |moment| <= 1, at most kMaxPhaseMoments:
/// 16 nodes a degree, 721 at the least, evenly in angle. What lies below 0 is set to 0; `clipped`
/// is the light that this adds, as a share of all. kLimit: out of memory.
Status phase_nodes_from_moments(Span<const double> moment, PhaseNodes& nodes, double& clipped);

/// The same as a table.
Status make_phase_from_moments(const std::string& name, Span<const double> moment, PhaseStore& out,
                               double& clipped);

/// Legendre moments 0 ... count - 1 of the table's own function, to 1e-9 for count <= 1000.
void phase_table_moments(const PhaseTable& table, int count, double* moment);

/// Share of the light that turns by less than an angle in [0, 180] degrees.
double phase_table_share(const PhaseTable& table, double angle_deg);

}  // namespace pileus
