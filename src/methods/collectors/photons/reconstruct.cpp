// SPDX-License-Identifier: Apache-2.0
// See reconstruct.h.
#include "src/methods/collectors/photons/reconstruct.h"

#include "platform/threads.h"

namespace pileus {
namespace {

/// The share of a medium is that of the collector's extinction: the light is taken to be the same
/// all over the leaf, as its colour is.
Mixture mixture_of(const ReconstructInput& in, std::size_t collector, std::size_t channel) {
    Mixture mix;
    mix.medium = in.medium;
    const std::size_t count = std::size_t(in.medium->count);
    for (std::size_t i = 0; i < count; ++i) {
        const float share = count == 1 ? 1.0f : in.shares[collector * count + i];
        mix.weight[i] = share * in.medium->optics[i].albedo[channel];
        mix.albedo += mix.weight[i];
    }
    for (std::size_t i = 0; i < count && mix.albedo > 0; ++i) mix.weight[i] /= mix.albedo;
    return mix;
}

/// Light of one light in one slot, scattered towards `to`, per unit of its colour.
double slot_power(const ReconstructInput& in, const Window& window, const Mixture& mix,
                  const PhotonSlot& slot, std::size_t light, std::uint64_t set,
                  const Direction& to) {
    if (slot.generations == 0) return 0;
    double sums[kMostNumbers];
    slot_sums(in, slot, light, set, sums);
    if (in.closure == Closure::kCamera) return sums[0];

    double power = in.first_order_alone           ? 0
                   : in.closure == Closure::kLobe ? lobe_power(in.deposit, mix, sums, to)
                                                  : sh_power(in.deposit, window, mix, sums, to);
    if (!in.lighting->lights[light].beam) return power;
    const Direction sun{slot.sun_travel[0], slot.sun_travel[1], slot.sun_travel[2]};
    if (!in.first_order_alone)
        power += axis_power(in.deposit, mix, sums + in.deposit.bands * in.deposit.bands, sun, to);
    if (in.deposit.first_order == 1)
        power += sums[in.deposit.coefficients - 1] * double(mix.density(one_minus_cosine(sun, to)));
    return power;
}

Direction towards_camera(const ReconstructInput& in, const Collector& c) {
    if (in.camera.orthographic != 0)
        return {-in.camera.forward[0], -in.camera.forward[1], -in.camera.forward[2]};
    const Direction d{in.camera.origin[0] - c.centre[0], in.camera.origin[1] - c.centre[1],
                      in.camera.origin[2] - c.centre[2]};
    // From inside the collector there is no such direction: any will do.
    if (!(dot(d, d) > 1e-12f)) return {0, 0, 1};
    return normalized(d);
}

struct Row {
    double rgb[3];
};

/// Colour of collector i from slots [first, last), averaged.
Row collector_colour(const ReconstructInput& in, const Window& window, std::size_t i,
                     std::size_t first, std::size_t last) {
    const Collector& c = in.collectors[i];
    const Direction to = towards_camera(in, c);
    const Medium& m = *in.medium;
    const int channels = sum_channels(m, in.deposit);
    const double depth_m2 = c.mass * double(m.sigma);
    Mixture mix[3];
    for (std::size_t ch = 0; ch < std::size_t(channels); ++ch) mix[ch] = mixture_of(in, i, ch);
    // The deposits know the albedos at real collisions, and where several media share a voxel.
    const bool albedo_done =
        in.deposit.mode == kDepositOutgoing || (in.deposit.mode == kDepositCamera && m.count > 1);
    Row row{};
    double generations = 0;
    for (std::size_t s = first; s < last; ++s)
        generations += double(in.photons->slots[s].generations);
    for (std::size_t s = first; s < last; ++s) {
        const PhotonSlot& slot = in.photons->slots[s];
        const double share = generations > 0 ? double(slot.generations) / generations : 0;
        for (std::size_t l = 0; l < in.lighting->lights.size(); ++l) {
            const auto& colour = in.lighting->lights[l].colour;
            double power = 0;
            for (std::size_t ch = 0; ch < 3; ++ch) {
                if (ch == 0 || channels == 3) {
                    const std::uint64_t set = std::uint64_t(i) * std::uint64_t(channels) + ch;
                    power = slot_power(in, window, mix[ch], slot, l, set, to) * share;
                    if (!albedo_done) power *= double(mix[ch].albedo);
                }
                row.rgb[ch] += power * colour[ch] / depth_m2;
            }
        }
    }
    return row;
}

}  // namespace

Status reconstruct(const ReconstructInput& in, CollectorColours& out) {
    const std::size_t slots = filled_slots(*in.photons), count = in.collectors.size;
    const std::size_t batches = std::size_t(in.batches), sets = 1 + batches;
    PILEUS_TRY(allocate_once(arrays::collector_colours(3 * sets, count), out.colour));
    const Window window = band_window(in.deposit.bands, in.window);
    constexpr std::size_t kPiece = 256;
    const std::size_t pieces = (count + kPiece - 1) / kPiece;
    Buffer<std::uint64_t> negative;
    PILEUS_TRY(negative.resize(pieces, "counters"));
    parallel_for(in.threads, std::int64_t(pieces), [&](std::int64_t piece, int) {
        const std::size_t begin = std::size_t(piece) * kPiece;
        const std::size_t end = begin + kPiece < count ? begin + kPiece : count;
        for (std::size_t i = begin; i < end; ++i) {
            for (std::size_t set = 0; set < sets; ++set) {
                const Row row =
                    collector_colour(in, window, i, set == 0 ? 0 : (set - 1) * slots / batches,
                                     set == 0 ? slots : set * slots / batches);
                for (std::size_t ch = 0; ch < 3; ++ch) {
                    // The constant part belongs to the radiance that must not be negative.
                    const double constant = in.lighting->constant[ch];
                    double v = row.rgb[ch] + constant;
                    if (set == 0 && v < 0) {
                        v = 0;
                        ++negative[std::size_t(piece)];
                    }
                    if (!in.constant) v -= constant;
                    out.colour[(set * 3 + ch) * count + i] = float(v);
                }
            }
        }
    });
    out.clamped_negative = 0;
    for (std::uint64_t n : negative.span()) out.clamped_negative += n;
    return Status::ok();
}

namespace {

/// Harmonics of collector i: [set][harmonic] into `out`.
void collector_harmonics(const ReconstructInput& in, const Window& window, std::size_t i,
                         std::size_t first, std::size_t last, const HarmonicSource& sets,
                         double* out) {
    const Medium& m = *in.medium;
    const int channels = sum_channels(m, in.deposit);
    const int count = sets.bands * sets.bands;
    const bool by_light = sets.sets < 3;
    const bool albedo_done = in.deposit.mode == kDepositOutgoing;
    double generations = 0;
    for (std::size_t s = first; s < last; ++s)
        generations += double(in.photons->slots[s].generations);
    for (int k = 0; k < sets.sets * count; ++k) out[k] = 0;
    for (std::size_t ch = 0; ch < std::size_t(channels); ++ch) {
        const Mixture mix = mixture_of(in, i, ch);
        double factor[kMaxBands];
        for (int l = 0; l < sets.bands; ++l)
            factor[l] = double(albedo_done ? 1.0f : mix.moment(l) * mix.albedo) *
                        double(window.factor[l]) / (in.collectors[i].mass * double(m.sigma));
        for (std::size_t s = first; s < last; ++s) {
            const PhotonSlot& slot = in.photons->slots[s];
            if (slot.generations == 0) continue;
            const double share = double(slot.generations) / generations;
            for (std::size_t l = 0; l < in.lighting->lights.size(); ++l) {
                double sums[kMostNumbers];
                slot_sums(in, slot, l, std::uint64_t(i) * std::uint64_t(channels) + ch, sums);
                // Which sets this light feeds, and how brightly.
                const auto& colour = in.lighting->lights[l].colour;
                for (std::size_t set = 0; set < std::size_t(sets.sets); ++set) {
                    if (by_light ? set != l : (channels == 3 && set != ch)) continue;
                    const double power = share * (by_light ? 1.0 : colour[set]);
                    for (int band = 0, k = 0; band < sets.bands; ++band)
                        for (int order = -band; order <= band; ++order, ++k)
                            out[int(set) * count + k] += sums[k] * factor[band] * power;
                }
            }
        }
    }
}

}  // namespace

Status reconstruct_harmonics(const ReconstructInput& in, int batch, HarmonicSource& out) {
    const std::size_t slots = filled_slots(*in.photons), count = in.collectors.size;
    const std::size_t batches = std::size_t(in.batches);
    const std::size_t first = batch < 0 ? 0 : std::size_t(batch) * slots / batches;
    const std::size_t last = batch < 0 ? slots : (std::size_t(batch) + 1) * slots / batches;
    out.bands = in.deposit.bands;
    out.sets = harmonic_sets(sum_channels(*in.medium, in.deposit), *in.lighting);
    for (int s = 0; s < out.sets; ++s)
        for (std::size_t c = 0; c < 3; ++c)
            out.colour[s][c] = out.sets < 3 ? float(in.lighting->lights[std::size_t(s)].colour[c])
                                            : (std::size_t(s) == c ? 1.0f : 0.0f);
    const std::size_t numbers = std::size_t(out.sets) * std::size_t(out.bands * out.bands);
    PILEUS_TRY(allocate_once(arrays::collector_colours(numbers, count), out.values));
    const Window window = band_window(in.deposit.bands, in.window);
    constexpr std::size_t kPiece = 256;
    parallel_for(in.threads, std::int64_t((count + kPiece - 1) / kPiece),
                 [&](std::int64_t piece, int) {
                     const std::size_t begin = std::size_t(piece) * kPiece;
                     const std::size_t end = begin + kPiece < count ? begin + kPiece : count;
                     double own[3 * kMaxBands * kMaxBands];
                     for (std::size_t i = begin; i < end; ++i) {
                         collector_harmonics(in, window, i, first, last, out, own);
                         for (std::size_t k = 0; k < numbers; ++k)
                             out.values[k * count + i] = float(own[k]);
                     }
                 });
    return Status::ok();
}

}  // namespace pileus
