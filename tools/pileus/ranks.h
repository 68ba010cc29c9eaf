// SPDX-License-Identifier: Apache-2.0
// Processes that work on one picture together, where MPI has started them.
// in: what a rank has -> out: what all have, at rank 0 or everywhere. Without MPI there is one
// rank. docs/farm.md, "Ranks of MPI"
#pragma once
#include <cstdint>
#include <vector>

#include "src/base/buffer.h"
#include "src/base/span.h"
#include "src/base/status.h"
#include "src/run/work_share.h"

namespace pileus {

struct Ranks {
    int rank = 0, count = 1;
    int beside = 1;  ///< ranks on this machine

    bool is_first() const { return rank == 0; }
};

/// Whether the program was built with MPI.
bool has_mpi();
/// Names with which the variables begin that a launcher sets, for a process that it did not start.
inline const char* const kLauncherVariables[] = {"OMPI_", "PMI_", "PMIX_"};

/// The ranks that a launcher of MPI started this program among; alone where none did. The first
/// call begins MPI. Calls are made by one thread, by all ranks in one order.
const Ranks& ranks();
/// Before the program ends: the exit status, which rank 0 alone has where all have agreed on it. A
/// launcher would end the others by a signal, and they would tell of that.
int end_ranks(int status);

/// All go on, or all end: the worst status of any rank, with the words of the first that has it at
/// rank 0 and none elsewhere.
Status agree(const Status& own);

/// Sums over all ranks, at rank 0; elsewhere `values` stay.
Status sum_to_first(Span<std::int64_t> values);
/// What rank 0 has, at all ranks: `bytes` of the same size everywhere.
void send_from_first(Span<char> bytes);
/// What each rank has, in their order, at rank 0; elsewhere nothing. kLimit: out of memory.
Status gather_to_first(Span<const char> own, std::vector<Buffer<char>>& all);
/// The work of a measurement shared among the ranks; null: there is one rank.
WorkShare* rank_share();

}  // namespace pileus
