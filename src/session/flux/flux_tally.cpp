// SPDX-License-Identifier: Apache-2.0
// See flux_tally.h.
// in: slots of sums -> out: what they are worth.
// docs/flux.md, "By photons"
#include "src/session/flux/flux_tally.h"

namespace pileus {
namespace {

void put(const Batched& from, double scale, std::size_t c, FluxShare& to) {
    to.mean[c] = from.mean() * scale;
    to.standard_error[c] = from.error() * scale;
}

}  // namespace

Status FluxTally::open() {
    for (auto& layer : layers_) layer.assign(std::size_t(layout_.cells[2]), Batched{});
    PILEUS_TRY(columns_.resize(6 * layout_.column_count(), "fluxes of the columns"));
    return items_.resize(3 * layout_.collectors(), "sums of the photons");
}

/// Power in a collector, W, of all lights or of those alone whose unturned part is direct.
double FluxTally::value(const PhotonSlot& slot, std::size_t collector, std::size_t c,
                        bool straight_only) const {
    const std::uint64_t stride = slot_stride(in_);
    const double unit = 1.0 / double(std::uint64_t{1} << in_.deposit.places);
    const std::size_t channel = channels_ == 3 ? c : 0;
    double sum = 0;
    for (std::size_t l = 0; l < in_.lighting->lights.size(); ++l) {
        const Light& light = in_.lighting->lights[l];
        if (light.photons == 0) continue;
        if (straight_only && !light.beam && !task_.settings.from_below) continue;
        const std::int64_t quanta =
            slot.sums[l * stride + collector * std::size_t(channels_) + channel];
        sum +=
            double(quanta) * unit * light.power_m2 / double(light.photons) * light.colour[int(c)];
    }
    return sum;
}

void FluxTally::add(const PhotonSlot& slot) {
    const std::size_t columns = layout_.column_count();
    for (std::size_t c = 0; c < 3; ++c) {
        double up = 0, down = 0, direct = 0, kept = 0;
        const bool below = task_.settings.from_below;
        for (std::size_t i = 0; i < columns; ++i) {
            const auto of = [&](MeterFace f, bool alone) {
                return value(slot, layout_.face(f, i), c, alone);
            };
            const double top = of(kTopTurned, false) + of(kTopStraight, false);
            const double bottom = of(kBottomTurned, false) + of(kBottomStraight, false);
            const double straight = of(below ? kTopStraight : kBottomStraight, true);
            columns_[(2 * c) * columns + i].add(top);
            columns_[(2 * c + 1) * columns + i].add(bottom);
            item(c, layout_.face(kBottomStraight, i)).add(straight);
            up += top, down += bottom, direct += straight;
        }
        std::size_t i = 0;
        for (Batched& layer : layers_[c]) {
            double sum = 0;
            for (std::size_t n = 0; layout_.cell_count > 0 && n < layout_.slice(); ++n, ++i) {
                const double power = value(slot, i, c, false) * most_absorbed_[c];
                item(c, i).add(power);
                sum += power;
            }
            layer.add(sum);
            kept += sum;
        }
        up_[c].add(up), down_[c].add(down), direct_[c].add(direct), absorbed_[c].add(kept);
    }
}

void FluxTally::shares(FluxResult& out) const {
    const bool below = task_.settings.from_below;
    for (std::size_t c = 0; c < 3; ++c) {
        const double scale = task_.share(1.0 / area_, c);
        put(below ? down_[c] : up_[c], scale, c, out.reflectance);
        put(below ? up_[c] : down_[c], scale, c, out.transmittance);
        put(direct_[c], scale, c, out.transmittance_direct);
        put(absorbed_[c], scale, c, out.absorptance);
    }
}

void FluxTally::maps(Image& maps) const {
    const std::size_t width = std::size_t(maps.width), columns = layout_.column_count();
    const std::size_t back = task_.settings.from_below ? 1 : 0, through = 1 - back;
    for (std::size_t i = 0; i < columns; ++i) {
        // Columns begin in the south, the rows of a map in the north.
        const std::size_t p = (std::size_t(maps.height) - 1 - i / width) * width + i % width;
        for (std::size_t c = 0; c < 3; ++c) {
            const double scale = task_.share(double(columns) / area_, c);
            const Batched& sent = columns_[(2 * c + back) * columns + i];
            maps.channels[c].pixels[p] = float(sent.mean() * scale);
            maps.channels[3 + c].pixels[p] = float(sent.error() * scale);
            maps.channels[6 + c].pixels[p] =
                float(columns_[(2 * c + through) * columns + i].mean() * scale);
            maps.channels[9 + c].pixels[p] =
                float(item(c, layout_.face(kBottomStraight, i)).mean() * scale);
        }
    }
}

Status FluxTally::absorbed(AbsorbedPower& out) const {
    const Medium& m = *in_.medium;
    const std::size_t count = layout_.slice() * std::size_t(layout_.cells[2]);
    const double volume = area_ * m.extent_m[2], each = double(count) / volume;
    out.cells = layout_.cells;
    out.bounds_m = {m.low_m, m.low_m + Double3{m.extent_m[0], m.extent_m[1], m.extent_m[2]}};
    out.layers.resize(std::size_t(layout_.cells[2]));
    for (std::size_t c = 0; c < 3; ++c) {
        PILEUS_TRY(out.mean[c].resize(count, "absorbed power"));
        PILEUS_TRY(out.error[c].resize(count, "absorbed power"));
        out.largest[c] = 0;
        put(absorbed_[c], 1 / volume, c, out.all);
        for (std::size_t z = 0; z < out.layers.size(); ++z)
            put(layers_[c][z], double(layout_.cells[2]) / volume, c, out.layers[z]);
        for (std::size_t i = 0; i < layout_.cell_count; ++i) {
            const double mean = item(c, i).mean() * each;
            out.mean[c][i] = float(mean);
            out.error[c][i] = float(item(c, i).error() * each);
            out.largest[c] = mean > out.largest[c] ? mean : out.largest[c];
        }
    }
    return Status::ok();
}

}  // namespace pileus
