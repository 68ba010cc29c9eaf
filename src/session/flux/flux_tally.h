// SPDX-License-Identifier: Apache-2.0
// Sums of photons as fluxes: means over batches, and errors from their scatter.
// in: slots of integer sums, one batch at a time -> out: shares, maps, absorbed power.
// docs/flux.md, "By photons"
#pragma once
#include "kernels_cpu/photons/meter_params.h"
#include "src/photons/trace.h"
#include "src/session/flux/flux_run.h"

namespace pileus {

/// Errors are from the scatter of so many groups of photons, each with random numbers of its own.
constexpr int kFluxBatches = 32;
/// Mean and scatter of numbers that each batch brings one of.
struct Batched {
    double sum = 0, square = 0;

    void add(double value) {
        sum += value;
        square += value * value;
    }
    double mean() const { return sum / kFluxBatches; }
    double error() const {
        const double variance = (square / kFluxBatches - mean() * mean()) / (kFluxBatches - 1);
        return variance > 0 ? __builtin_sqrt(variance) : 0;
    }
};

/// How the box is divided, and which collector has what.
struct FluxLayout {
    std::array<int, 3> cells{0, 0, 0};  ///< that gather what is absorbed
    std::array<int, 2> columns{1, 1};
    std::size_t cell_count = 0;  ///< 0: nothing is absorbed

    std::size_t column_count() const { return std::size_t(columns[0]) * std::size_t(columns[1]); }
    std::size_t slice() const { return std::size_t(cells[0]) * std::size_t(cells[1]); }
    std::size_t collectors() const { return cell_count + kMeterFaces * column_count(); }
    /// Column number `i` seen on one of the faces.
    std::size_t face(MeterFace f, std::size_t i) const {
        return cell_count + std::size_t(f) * column_count() + i;
    }
};

class FluxTally {
public:
    FluxTally(const FluxTask& task, const FluxLayout& layout, const TraceInput& in)
        : task_(task), layout_(layout), in_(in), channels_(in.deposit.channels) {
        const Medium& m = *in.medium;
        area_ = m.extent_m[0] * m.extent_m[1];
        for (std::size_t c = 0; c < 3; ++c) {
            most_absorbed_[c] = 0;
            for (int i = 0; i < m.count; ++i) {
                const double lost = 1.0 - double(m.optics[std::size_t(i)].albedo[c]);
                most_absorbed_[c] = lost > most_absorbed_[c] ? lost : most_absorbed_[c];
            }
        }
    }

    Status open();
    /// Takes a batch out of the slot.
    void add(const PhotonSlot& slot);
    void shares(FluxResult& out) const;
    void maps(Image& maps) const;
    Status absorbed(AbsorbedPower& out) const;

private:
    double value(const PhotonSlot& slot, std::size_t collector, std::size_t c,
                 bool straight_only) const;
    Batched& item(std::size_t c, std::size_t i) { return items_[c * layout_.collectors() + i]; }
    const Batched& item(std::size_t c, std::size_t i) const {
        return items_[c * layout_.collectors() + i];
    }

    const FluxTask& task_;
    const FluxLayout& layout_;
    const TraceInput& in_;
    int channels_;
    double area_ = 0, most_absorbed_[3];
    /// [channel][collector], W; of the two faces that hold straight light the part that is direct.
    Buffer<Batched> items_;
    Batched up_[3], down_[3], direct_[3], absorbed_[3];
    std::vector<Batched> layers_[3];
    /// Columns in whole, for the maps: [channel][top, bottom][column].
    Buffer<Batched> columns_;
};

}  // namespace pileus
