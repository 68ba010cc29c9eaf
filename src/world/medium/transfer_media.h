// SPDX-License-Identifier: Apache-2.0
// A field that a transfer function shows, as media: one for each colour.
// in: values on a grid, rows -> out: densities of the media on the same grid.
// docs/scene.md, "A transfer function": a colour's extinction at a value is the sum over its rows
// of their extinction times their hat function, so that all colours add up to the linear law.
#pragma once
#include "src/scene/media/transfer.h"
#include "src/world/medium/medium.h"

namespace pileus {

/// Splits `field`, which is emptied: its values, or none where it is an outline, whose densities
/// then count as 1. NaN is nothing. A colour that no value shows has density_max 0. kLimit: memory.
Status split_by_transfer(const std::vector<TransferRow>& rows, Medium& field,
                         std::vector<Medium>& out);

/// What the plan says of it.
std::string told_transfer(std::size_t medium, const std::vector<TransferRow>& rows);

}  // namespace pileus
