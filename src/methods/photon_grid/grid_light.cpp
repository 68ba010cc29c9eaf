// SPDX-License-Identifier: Apache-2.0
// See grid_light.h.
// in: sums, weights of the closure -> out: light per cell.
// docs/photon-grid.md, "What a cell shows".
#include "src/methods/photon_grid/grid_light.h"

#include "platform/threads.h"
#include "src/photons/scatter.h"

namespace pileus {
namespace {

constexpr int kMaxMoments = kMaxBands + kMaxAxisDegrees;
constexpr double kPerSphere = 0.079577471545947667884;  // 1 / 4 pi

/// What the media of one place scatter, per channel.
struct CellOptics {
    Mixture mix[3];
    float moment[3][kMaxMoments];
};

CellOptics optics_of(const GridLightInput& in, std::size_t cell) {
    CellOptics out;
    const Medium& m = *in.medium;
    const std::size_t count = std::size_t(m.count);
    for (std::size_t c = 0; c < 3; ++c) {
        Mixture& mix = out.mix[c];
        mix.medium = in.medium;
        if (in.deposit.apart()) mix.apart = &in.deposit;
        for (std::size_t i = 0; i < count; ++i) {
            const float share = count == 1 ? 1.0f : in.shares[cell * count + i];
            mix.weight[i] = share * m.optics[i].albedo[c];
            mix.albedo += mix.weight[i];
        }
        for (std::size_t i = 0; i < count && mix.albedo > 0; ++i) mix.weight[i] /= mix.albedo;
        const int most = in.deposit.bands + in.deposit.axis_degrees;
        for (int l = 0; l < most; ++l) out.moment[c][l] = mix.moment(l);
    }
    return out;
}

/// The middle of cell number `i`, m, box-local.
Vec<float> middle_of(const GridLightInput& in, std::size_t i) {
    const std::size_t nx = std::size_t(in.cells.size[0]), ny = std::size_t(in.cells.size[1]);
    const std::size_t at[3] = {i % nx, i / nx % ny, i / (nx * ny)};
    float middle[3];
    for (std::size_t a = 0; a < 3; ++a)
        middle[a] = float((double(at[a]) + 0.5) * in.medium->extent_m[a] / in.cells.size[a]);
    return {middle[0], middle[1], middle[2]};
}

/// Where the camera sees it from.
Direction cell_to_camera(const GridLightInput& in, const Vec<float>& middle) {
    if (in.camera.orthographic != 0)
        return {-in.camera.forward[0], -in.camera.forward[1], -in.camera.forward[2]};
    const Direction d{in.camera.origin[0] - middle.x, in.camera.origin[1] - middle.y,
                      in.camera.origin[2] - middle.z};
    // From the middle of the cell there is no such direction: any will do.
    if (!(dot(d, d) > 1e-12f)) return {0, 0, 1};
    return normalized(d);
}

/// What multiplies each of a light's sums in one cell and channel, closures kSh and kCamera. The
/// sums about axes are those of beams and lamps alone: they are zero for other lights.
struct Weights {
    bool made = false;
    Direction sun{};
    double w[kMaxNumbers];
};

void make_axis_weights(const GridLightInput& in, const float* moment, const Direction& to,
                       const Direction& way, double* w) {
    float p[kMaxAxisDegrees];
    const int bands = in.deposit.bands, degrees = in.deposit.axis_degrees;
    axis_values(bands, degrees, 1.0f - one_minus_cosine(way, to), p);
    for (int j = 0; j < degrees; ++j) {
        const int l = bands + j;
        w[j] = double(2 * l + 1) * kPerSphere * double(moment[l]) * double(p[j]);
    }
}

void make_weights(const GridLightInput& in, const float* moment, const Vec<float>& middle,
                  const Direction& to, const Direction& sun, Weights& out) {
    const bool same = sun.x == out.sun.x && sun.y == out.sun.y && sun.z == out.sun.z;
    if (out.made && same) return;
    out.made = true;
    out.sun = sun;
    if (in.closure == GridClosure::kCamera) {
        out.w[0] = 1;
        return;
    }
    float y[kMaxBands * kMaxBands];
    const int bands = in.deposit.bands, degrees = in.deposit.axis_degrees;
    sh_values(bands, to, y);
    for (int l = 0, i = 0; l < bands; ++l)
        for (int m = -l; m <= l; ++m, ++i) out.w[i] = double(moment[l]) * double(y[i]);
    for (int n = 0; n < in.deposit.axes && degrees > 0; ++n)
        make_axis_weights(in, moment, to,
                          n < in.deposit.lamp_axis ? sun : axis_way(in.axes[n], middle),
                          out.w + bands * bands + n * degrees);
}

/// As published: flux, and the mean cosine g' to the light's axis; every medium with g g'.
double published_power(const Mixture& mix, const double* sums, const Direction& axis,
                       const Direction& to, float most) {
    const double flux = sums[0];
    if (!(flux > 0)) return flux * kPerSphere;
    double mean = sums[1] / flux;
    if (mean > 0.999) mean = 0.999;
    if (mean < -0.999) mean = -0.999;
    float density = 0;
    for (int i = 0; i < mix.medium->count; ++i) {
        const float g = phase_moment(mix.medium->optics[std::size_t(i)].phase, 1);
        density +=
            mix.weight[i] * min_(hg_density(g * float(mean), one_minus_cosine(axis, to)), most);
    }
    return flux * double(density);
}

/// A cell while it is lit.
struct CellView {
    CellOptics optics;
    Vec<float> middle;
    Direction to;
    Weights weights[3];
};

/// Light of one light in one cell and slot, scattered towards the camera, per unit of its colour.
double cell_power(const GridLightInput& in, CellView& cell, std::size_t channel,
                  const PhotonSlot& slot, std::size_t light, std::uint64_t set) {
    double sums[kMaxNumbers];
    slot_sums(in, slot, light, set, sums);
    const Mixture& mix = cell.optics.mix[channel];
    const Direction sun{slot.sun_travel[0], slot.sun_travel[1], slot.sun_travel[2]};
    if (in.closure == GridClosure::kMean)
        return lobe_power(in.deposit, mix, sums, cell.to, most_towards(in, cell.to));
    if (in.closure == GridClosure::kPublished) {
        const Light& l = in.lighting->lights[light];
        const Direction axis = l.beam ? sun : Direction{0, 0, l.hemisphere > 0 ? 1.0f : -1.0f};
        return published_power(mix, sums, axis, cell.to, most_towards(in, cell.to));
    }
    Weights& w = cell.weights[channel];
    make_weights(in, cell.optics.moment[channel], cell.middle, cell.to, sun, w);
    double power = 0;
    for (int i = 0; i < in.deposit.coefficients; ++i) power += w.w[i] * sums[i];
    return power;
}

struct Row {
    double rgb[3] = {};
};

Row cell_row(const GridLightInput& in, const Batch& batch, std::size_t number, CellView& cell) {
    const std::size_t channels = std::size_t(sum_channels(*in.medium, in.deposit));
    Row row;
    for (const PhotonSlot& slot : batch.slots) {
        if (slot.generations == 0) continue;
        const double share = double(slot.generations) / batch.generations / in.unit_m2;
        for (std::size_t l = 0; l < in.lighting->lights.size(); ++l) {
            double power = 0;
            for (std::size_t c = 0; c < 3; ++c) {
                if (c == 0 || channels == 3)
                    power = cell_power(in, cell, c, slot, l, number * channels + c) * share *
                            double(cell.optics.mix[c].albedo);
                row.rgb[c] += power * in.lighting->lights[l].colour[c];
            }
        }
    }
    return row;
}

}  // namespace

Status light_cells(const GridLightInput& in, Buffer<float>& out) {
    const std::size_t count = std::size_t(in.cells.count());
    PILEUS_TRY(allocate_once(arrays::cell_light(3 * (1 + std::uint64_t(in.batches)), count), out));
    const std::size_t slice = count / std::size_t(in.cells.size[2]);
    const CellOptics all = in.medium->count == 1 ? optics_of(in, 0) : CellOptics{};
    std::vector<Batch> batches;
    for (int b = -1; b < in.batches; ++b) batches.push_back(batch_of(in, b));
    parallel_for(in.threads, in.cells.size[2], [&](std::int64_t z, int) {
        for (std::size_t i = std::size_t(z) * slice; i < (std::size_t(z) + 1) * slice; ++i) {
            if (in.marks[i] == kCellEmpty) continue;
            CellView cell;
            cell.optics = in.medium->count == 1 ? all : optics_of(in, i);
            cell.middle = middle_of(in, i);
            cell.to = cell_to_camera(in, cell.middle);
            for (std::size_t b = 0; b < batches.size(); ++b) {
                const Row row = cell_row(in, batches[b], i, cell);
                for (std::size_t c = 0; c < 3; ++c)
                    out[(3 * b + c) * count + i] = float(row.rgb[c]);
            }
        }
    });
    return Status::ok();
}

namespace {

/// Adds the harmonics of one light in one channel of a cell to the sets that it feeds.
void add_harmonics(const GridLightInput& in, const CellOptics& optics, std::size_t channel,
                   const double* sums, double share, std::size_t light, int stored,
                   const CellHarmonics& sets, double* out) {
    const bool by_light = sets.sets < 3;
    const bool apart = sum_channels(*in.medium, in.deposit) == 3;
    const auto& colour = in.lighting->lights[light].colour;
    for (int set = 0; set < sets.sets; ++set) {
        if (by_light ? set != int(light) : (apart && set != int(channel))) continue;
        const double power = share * double(optics.mix[channel].albedo) *
                             (by_light ? 1.0 : colour[std::size_t(set)]);
        double* own = out + set * stored;
        int i = 0;
        for (int l = 0; l < in.deposit.bands; ++l)
            for (int m = -l; m <= l; ++m, ++i)
                own[i] += sums[i] * double(optics.moment[channel][l]) * power;
        for (int d = 0; d < axis_numbers(in.deposit); ++d, ++i) {
            const int l = in.deposit.bands + d % in.deposit.axis_degrees;
            own[i] += sums[i] * double(2 * l + 1) * kPerSphere * double(optics.moment[channel][l]) *
                      power;
        }
    }
}

void cell_harmonics(const GridLightInput& in, const CellOptics& optics, const Batch& batch,
                    std::size_t cell, int stored, const CellHarmonics& sets, double* out) {
    const std::size_t channels = std::size_t(sum_channels(*in.medium, in.deposit));
    for (int k = 0; k < sets.sets * stored; ++k) out[k] = 0;
    for (const PhotonSlot& slot : batch.slots) {
        if (slot.generations == 0) continue;
        const double share = double(slot.generations) / batch.generations / in.unit_m2;
        for (std::size_t c = 0; c < channels; ++c)
            for (std::size_t l = 0; l < in.lighting->lights.size(); ++l) {
                double sums[kMaxNumbers];
                slot_sums(in, slot, l, cell * channels + c, sums);
                add_harmonics(in, optics, c, sums, share, l, stored, sets, out);
            }
    }
}

}  // namespace

Status light_cell_harmonics(const GridLightInput& in, const HarmonicPart& which,
                            const NearNodes& those, CellHarmonics& out, Buffer<float>& values) {
    const std::size_t count = std::size_t(node_count(those));
    out.sets = harmonic_sets(sum_channels(*in.medium, in.deposit), *in.lighting);
    for (int s = 0; s < out.sets; ++s)
        for (std::size_t c = 0; c < 3; ++c)
            out.colour[s][c] = out.sets < 3 ? float(in.lighting->lights[std::size_t(s)].colour[c])
                                            : (std::size_t(s) == c ? 1.0f : 0.0f);
    const std::size_t numbers = std::size_t(out.sets) * std::size_t(which.stored);
    PILEUS_TRY(
        allocate_once(arrays::cell_light(std::uint64_t(which.parts) * numbers, count), values));
    const std::size_t nx = std::size_t(those.size[0]), ny = std::size_t(those.size[1]);
    const std::size_t columns = std::size_t(in.cells.size[0]), rows = std::size_t(in.cells.size[1]);
    const CellOptics all = in.medium->count == 1 ? optics_of(in, 0) : CellOptics{};
    const Batch slots = batch_of(in, which.batch);
    float* part = values.data() + std::size_t(which.part) * count * numbers;
    parallel_for(in.threads, those.size[2], [&](std::int64_t z, int) {
        double own[3 * kMaxHarmonics];
        for (std::size_t n = std::size_t(z) * nx * ny; n < (std::size_t(z) + 1) * nx * ny; ++n) {
            const std::size_t x = n % nx + std::size_t(those.first[0]);
            const std::size_t y = n / nx % ny + std::size_t(those.first[1]);
            const std::size_t i =
                ((std::size_t(z) + std::size_t(those.first[2])) * rows + y) * columns + x;
            float* out_of_cell = part + n * numbers;
            if (in.marks[i] == kCellEmpty) {
                for (std::size_t k = 0; k < numbers; ++k) out_of_cell[k] = 0;
                continue;
            }
            const CellOptics optics = in.medium->count == 1 ? all : optics_of(in, i);
            cell_harmonics(in, optics, slots, i, which.stored, out, own);
            for (std::size_t k = 0; k < numbers; ++k) out_of_cell[k] = float(own[k]);
        }
    });
    return Status::ok();
}

}  // namespace pileus
