// SPDX-License-Identifier: Apache-2.0
// See mix_media.h.
#include "src/base/single.h"
#include "src/world/medium/mix_media.h"

namespace pileus {
namespace {

/// The rows as one colour sees them: extinction over the colour's largest, 0 of other colours.
struct ColourRows {
    const std::vector<TransferRow>& rows;
    std::vector<double> share;

    float density(float value) const {
        if (value != value) return 0;
        const TransferPlace at = transfer_place(rows, double(value));
        const double low = share[at.low], high = share[at.high];
        const double density = low + (high - low) * at.share;
        return float(single_or_0(density < 1 ? density : 1));
    }
};

/// All of a medium but its values and its phase function's table.
Medium like(const Medium& field, const Float3& albedo) {
    Medium out;
    out.volume.size = field.volume.size;
    out.grid = field.grid;
    out.low_m = field.low_m;
    for (std::size_t a = 0; a < 3; ++a) out.extent_m[a] = field.extent_m[a];
    Optics& optics = out.optics[0];
    optics.phase = field.optics[0].phase;
    optics.albedo_max = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        optics.albedo[c] = albedo[c];
        if (albedo[c] > optics.albedo_max) optics.albedo_max = albedo[c];
    }
    out.channels = albedo[0] == albedo[1] && albedo[1] == albedo[2] ? 1 : 3;
    return out;
}

/// `to` may be the values themselves.
float fill(const ColourRows& rows, Span<const float> values, Span<float> to) {
    float largest = 0;
    for (std::size_t i = 0; i < values.size; ++i) {
        to[i] = rows.density(values[i]);
        if (to[i] > largest) largest = to[i];
    }
    return largest;
}

}  // namespace

Status split_by_transfer(const std::vector<TransferRow>& rows, Medium& field,
                         std::vector<Medium>& out) {
    const std::vector<Float3> colours = transfer_colours(rows);
    const bool outline = field.volume.density.size() == 0;
    out.clear();
    for (std::size_t c = 0; c < colours.size(); ++c) {
        double sigma = 0;
        ColourRows own{rows, {}};
        for (const TransferRow& row : rows) {
            const bool mine = colour_of(row, colours) == c;
            own.share.push_back(mine ? row.extinction_per_m : 0);
            if (own.share.back() > sigma) sigma = own.share.back();
        }
        if (sigma > 0)
            for (double& share : own.share) share /= sigma;
        Medium medium = like(field, colours[c]);
        medium.sigma = float(sigma);
        medium.density_max = 1;
        if (!outline) {
            const Span<const float> values = field.volume.density.span();
            const bool last = c + 1 == colours.size();
            Buffer<float>& to = medium.volume.density;
            if (!last) PILEUS_TRY(to.resize(values.size, "density of a colour"));
            medium.density_max = fill(own, values, last ? field.volume.density.span() : to.span());
            if (last) to.swap(field.volume.density);
        }
        out.push_back(std::move(medium));
    }
    // Colours that are not there may be left out: the table goes with one that is.
    std::size_t owner = 0;
    while (owner + 1 < out.size() && !(out[owner].density_max > 0)) ++owner;
    if (!(out[owner].density_max > 0)) owner = out.size() - 1;
    out[owner].phases = std::move(field.phases);
    return Status::ok();
}

std::string told_transfer(std::size_t medium, const std::vector<TransferRow>& rows) {
    const std::size_t colours = transfer_colours(rows).size();
    return "medium " + std::to_string(medium) + " by a transfer function of " +
           std::to_string(rows.size()) + " values in " + std::to_string(colours) +
           (colours > 1 ? " colours, a medium each" : " colour");
}

}  // namespace pileus
