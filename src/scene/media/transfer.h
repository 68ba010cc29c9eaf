// SPDX-License-Identifier: Apache-2.0
// A transfer function: what a medium is at each value of the field that it shows.
// in: rows of rising values -> out: extinctions, and the colours that need a medium each.
// docs/scene.md, "A transfer function"; piecewise linear, constant beyond its ends.
#pragma once
#include "src/scene/scene.h"

namespace pileus {

constexpr std::size_t kMaxTransferRows = 64;

/// Between which rows a value stands: `share` of the way from `low` to `high`, in [0, 1].
struct TransferPlace {
    std::size_t low = 0, high = 0;
    double share = 0;
};

/// `rows` are two or more by rising values; `value` is a number.
TransferPlace transfer_place(const std::vector<TransferRow>& rows, double value);

/// 1/m, of all colours together.
double transfer_extinction(const std::vector<TransferRow>& rows, double value);

/// Albedos of the rows with extinction, each once and in the order of the rows; that of the first
/// row where none has any.
std::vector<Float3> transfer_colours(const std::vector<TransferRow>& rows);

/// The row's place among the colours; that of no colour for a row without extinction.
std::size_t colour_of(const TransferRow& row, const std::vector<Float3>& colours);

/// Media that the scene's become where each colour of a transfer function is one.
std::uint64_t media_by_colour(const Scene& scene);

}  // namespace pileus
