// SPDX-License-Identifier: Apache-2.0
// See transfer.h.
#include "src/scene/media/transfer.h"

namespace pileus {

TransferPlace transfer_place(const std::vector<TransferRow>& rows, double value) {
    if (!(value > rows.front().value)) return {0, 0, 0};
    std::size_t high = 1;
    while (high < rows.size() && rows[high].value < value) ++high;
    if (high == rows.size()) return {high - 1, high - 1, 0};
    const double from = rows[high - 1].value;
    return {high - 1, high, (value - from) / (rows[high].value - from)};
}

double transfer_extinction(const std::vector<TransferRow>& rows, double value) {
    const TransferPlace at = transfer_place(rows, value);
    const double low = rows[at.low].extinction_per_m, high = rows[at.high].extinction_per_m;
    return low + (high - low) * at.share;
}

std::vector<Float3> transfer_colours(const std::vector<TransferRow>& rows) {
    std::vector<Float3> colours;
    for (const TransferRow& row : rows)
        if (row.extinction_per_m > 0 && colour_of(row, colours) == colours.size())
            colours.push_back(row.albedo);
    if (colours.empty()) colours.push_back(rows.front().albedo);
    return colours;
}

std::size_t colour_of(const TransferRow& row, const std::vector<Float3>& colours) {
    std::size_t i = 0;
    while (i < colours.size() && (!(row.extinction_per_m > 0) || colours[i] != row.albedo)) ++i;
    return i;
}

std::uint64_t media_by_colour(const Scene& scene) {
    std::uint64_t count = 0;
    for (const MediumSettings& medium : scene.media)
        count +=
            medium.optics.transfer.empty() ? 1 : transfer_colours(medium.optics.transfer).size();
    return count;
}

}  // namespace pileus
