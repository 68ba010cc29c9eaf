// SPDX-License-Identifier: Apache-2.0
// Nodes of twice the size: where iterations begin, and how far a solution is from that on nodes
// without size.
// in: nodes, sources -> out: a solution on fewer nodes; moments with less of the nodes' error.
// docs/ordinates.md, "Nodes of twice the size"; Richardson 1911
#pragma once
#include "src/picture/ordinates/ordinate_solve.h"

namespace pileus {

/// Of the difference between solutions on nodes and on those of twice the size, the share that
/// nodes without size would have again: errors fall as the size squared. They do so where nodes are
/// thin, slower in thick ones; there, and where larger nodes are too coarse to tell, no more is
/// changed than a tenth.
constexpr float kOrderShare = 1.0f / 3;
constexpr float kMaxCorrection = 0.1f;

/// Larger nodes, and which of them others lie in; weigh_half() is to follow. kLimit: out of memory.
Status make_half(OrdinateNodes& nodes);

/// What lies in them, where densities have changed.
void weigh_half(OrdinateNodes& nodes);

/// Memory for so many sets. kLimit: out of memory.
Status reserve_half(std::uint64_t sets, OrdinateNodes& nodes);

/// Solves set `s` on them, whole. kLimit: out of memory.
Status solve_half(const Context& context, const Medium& medium, OrdinateNodes& nodes,
                  const Lighting& lighting, const OrdinateAsk& ask, const OrdinateSources& from,
                  std::size_t s, OrdinateSolver& solver);

/// A start for set `s`.
void start_from_half(const Context& context, const OrdinateNodes& nodes, std::size_t s,
                     float* moments);

/// Finds what set `s` is short of, and adds it; or takes away what was added.
void add_correction(const Context& context, OrdinateNodes& nodes, std::size_t s, float* moments);
void take_correction(const Context& context, const OrdinateNodes& nodes, std::size_t s,
                     float* moments);

}  // namespace pileus
