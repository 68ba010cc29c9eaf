// SPDX-License-Identifier: Apache-2.0
// See reconstruct.h.
#include "src/methods/collectors/photons/reconstruct.h"

#include <vector>

#include "platform/threads.h"

namespace pileus {
namespace {

constexpr double kPerSphere = 0.079577471545947667884;  // 1 / 4 pi

/// The share of a medium is that of the collector's extinction: the light is taken to be the same
/// all over the leaf, as its colour is.
Mixture mixture_of(const ReconstructInput& in, std::size_t collector, std::size_t channel) {
    Mixture mix;
    mix.medium = in.medium;
    if (in.deposit.apart()) mix.apart = &in.deposit;
    const std::size_t count = std::size_t(in.medium->count);
    for (std::size_t i = 0; i < count; ++i) {
        const float share = count == 1 ? 1.0f : in.shares[collector * count + i];
        mix.weight[i] = share * in.medium->optics[i].albedo[channel];
        mix.albedo += mix.weight[i];
    }
    for (std::size_t i = 0; i < count && mix.albedo > 0; ++i) mix.weight[i] /= mix.albedo;
    return mix;
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

/// What of one collector is the same in every slot.
struct Seen {
    Direction to;
    double depth_m2;
    Mixture mix[3];
    BandWeights bands[3];
    AxisWeights axis[3];
    Direction sun{};  ///< that `axis` is for
    bool has_axis = false;
};

/// Collectors that are lit together: slot by slot, so that each slot's sums are read in one go.
constexpr std::size_t kTogether = 16;

struct Row {
    double rgb[3];
};

/// Two kilobytes, of which one channel needs a third: what is not needed is left as it was.
void see_from_camera(const ReconstructInput& in, const Window& window, std::size_t i, Seen& out) {
    const Collector& c = in.collectors[i];
    out.has_axis = false;
    out.to = towards_camera(in, c);
    out.depth_m2 = c.mass * double(in.medium->sigma);
    const bool by_bands = in.closure == Closure::kSh && !in.first_order_alone;
    for (std::size_t ch = 0; ch < std::size_t(sum_channels(*in.medium, in.deposit)); ++ch) {
        out.mix[ch] = mixture_of(in, i, ch);
        if (by_bands) out.bands[ch] = band_weights(in.deposit, window, out.mix[ch], out.to);
    }
}

/// The weights about the axis of the beam follow a slot's sun.
void turn_axis(const ReconstructInput& in, const Direction& sun, Seen& seen) {
    if (seen.has_axis && sun.x == seen.sun.x && sun.y == seen.sun.y && sun.z == seen.sun.z) return;
    for (std::size_t ch = 0; ch < std::size_t(sum_channels(*in.medium, in.deposit)); ++ch)
        seen.axis[ch] = axis_weights(in.deposit, seen.mix[ch], sun, seen.to);
    seen.sun = sun;
    seen.has_axis = true;
}

/// Light whose sums these are, scattered towards the camera, per unit of its colour.
double scattered_power(const ReconstructInput& in, const Seen& seen, std::size_t channel, bool beam,
                       const double* sums) {
    if (in.closure == Closure::kCamera) return sums[0];
    const int bands = in.deposit.bands;
    const Mixture& mix = seen.mix[channel];
    double power = in.first_order_alone ? 0
                   : in.closure == Closure::kLobe
                       ? lobe_power(in.deposit, mix, sums, seen.to, most_towards(in, seen.to))
                       : sh_power(bands, seen.bands[channel], sums);
    if (!beam) return power;
    if (!in.first_order_alone)
        power += axis_power(in.deposit.axis_degrees, seen.axis[channel], sums + bands * bands);
    if (in.deposit.first_order == 1)
        power += sums[in.deposit.coefficients - 1] *
                 double(min_(mix.density(one_minus_cosine(seen.sun, seen.to)),
                             most_towards(in, seen.to)));
    return power;
}

/// Of lamps' light, what the degrees about their own axes hold at a collector.
double lamp_axes_power(const ReconstructInput& in, const Seen& seen, const Collector& c,
                       std::size_t channel, const double* sums) {
    const DepositPlan& d = in.deposit;
    double power = 0;
    for (int n = d.lamp_axis; n < d.axes && d.axis_degrees > 0; ++n) {
        const Direction way = axis_way(in.axes[n], {c.centre[0], c.centre[1], c.centre[2]});
        power += axis_power(d.axis_degrees, axis_weights(d, seen.mix[channel], way, seen.to),
                            sums + d.bands * d.bands + n * d.axis_degrees);
    }
    return power;
}

/// Adds one light of one slot, `share` of the whole, to the colours of collectors from `begin` on.
void add_slot(const ReconstructInput& in, const PhotonSlot& slot, std::size_t light, double share,
              std::size_t begin, std::size_t count, Seen* seen, Row* rows) {
    const Light& l = in.lighting->lights[light];
    const std::size_t channels = std::size_t(sum_channels(*in.medium, in.deposit));
    // The deposits know the albedos at real collisions, and where several media share a voxel.
    const bool albedo_done = in.deposit.mode == kDepositOutgoing ||
                             (in.deposit.mode == kDepositCamera && in.medium->count > 1);
    const bool turns = l.beam && in.closure != Closure::kCamera;
    const bool by_axes = l.lamps && in.closure != Closure::kCamera && !in.first_order_alone;
    const Direction sun{slot.sun_travel[0], slot.sun_travel[1], slot.sun_travel[2]};
    const double norm = slot_norm(in, slot, light);
    for (std::size_t i = 0; i < count; ++i) {
        if (turns) turn_axis(in, sun, seen[i]);
        double power = 0;
        for (std::size_t ch = 0; ch < 3; ++ch) {
            if (ch == 0 || channels == 3) {
                double sums[kMaxNumbers];
                slot_sums(in, slot, light, (begin + i) * channels + ch, norm, sums);
                power = scattered_power(in, seen[i], ch, l.beam, sums);
                if (by_axes)
                    power += lamp_axes_power(in, seen[i], in.collectors[begin + i], ch, sums);
                power *= share;
                if (!albedo_done) power *= double(seen[i].mix[ch].albedo);
            }
            rows[i].rgb[ch] += power * l.colour[ch] / seen[i].depth_m2;
        }
    }
}

/// Colours of collectors from `begin` on, averaged over the slots of a batch.
void collector_colours(const ReconstructInput& in, std::size_t begin, std::size_t count,
                       const Batch& batch, Seen* seen, Row* rows) {
    for (std::size_t i = 0; i < count; ++i) rows[i] = Row{};
    for (const PhotonSlot& slot : batch.slots) {
        if (slot.generations == 0) continue;
        const double share = double(slot.generations) / batch.generations;
        for (std::size_t l = 0; l < in.lighting->lights.size(); ++l)
            add_slot(in, slot, l, share, begin, count, seen, rows);
    }
}

}  // namespace

Status reconstruct(const ReconstructInput& in, CollectorColours& out) {
    const std::size_t count = in.collectors.size, sets = 1 + std::size_t(in.batches);
    PILEUS_TRY(allocate_once(arrays::collector_colours(3 * sets, count), out.colour));
    const Window window = band_window(in.deposit.bands, in.window);
    std::vector<Batch> batches;
    for (int b = -1; b < in.batches; ++b) batches.push_back(batch_of(in, b));
    const std::size_t pieces = (count + kTogether - 1) / kTogether;
    Buffer<std::uint64_t> negative;
    PILEUS_TRY(negative.resize(pieces, "counters"));
    parallel_for(in.threads, std::int64_t(pieces), [&](std::int64_t piece, int) {
        const std::size_t begin = std::size_t(piece) * kTogether;
        const std::size_t own = begin + kTogether < count ? kTogether : count - begin;
        Seen seen[kTogether];
        Row rows[kTogether];
        for (std::size_t i = 0; i < own; ++i) see_from_camera(in, window, begin + i, seen[i]);
        for (std::size_t set = 0; set < sets; ++set) {
            collector_colours(in, begin, own, batches[set], seen, rows);
            for (std::size_t i = 0; i < own; ++i)
                for (std::size_t ch = 0; ch < 3; ++ch) {
                    // The constant part belongs to the radiance that must not be negative. Marched
                    // collectors may be: what noise takes from one it has given to others.
                    const double constant = in.lighting->constant[ch];
                    double v = rows[i].rgb[ch] + constant;
                    if (set == 0 && v < 0 && in.constant) {
                        v = 0;
                        ++negative[std::size_t(piece)];
                    }
                    if (!in.constant) v -= constant;
                    out.colour[(set * 3 + ch) * count + begin + i] = float(v);
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
                         const Batch& batch, const HarmonicSource& sets, double* out) {
    const Medium& m = *in.medium;
    const int channels = sum_channels(m, in.deposit);
    const int count = sets.numbers, bands = in.deposit.bands;
    const bool by_light = sets.sets < 3;
    const bool albedo_done = in.deposit.mode == kDepositOutgoing;
    for (int k = 0; k < sets.sets * count; ++k) out[k] = 0;
    for (std::size_t ch = 0; ch < std::size_t(channels); ++ch) {
        const Mixture mix = mixture_of(in, i, ch);
        double factor[kMaxBands + kMaxAxisDegrees];
        for (int l = 0; l < bands + in.deposit.axis_degrees; ++l) {
            factor[l] = double(albedo_done ? 1.0f : mix.moment(l) * mix.albedo) /
                        (in.collectors[i].mass * double(m.sigma));
            factor[l] *= l < bands ? double(window.factor[l]) : double(2 * l + 1) * kPerSphere;
        }
        for (const PhotonSlot& slot : batch.slots) {
            if (slot.generations == 0) continue;
            const double share = double(slot.generations) / batch.generations;
            for (std::size_t l = 0; l < in.lighting->lights.size(); ++l) {
                double sums[kMaxNumbers];
                slot_sums(in, slot, l, std::uint64_t(i) * std::uint64_t(channels) + ch, sums);
                // Which sets this light feeds, and how brightly.
                const auto& colour = in.lighting->lights[l].colour;
                for (std::size_t set = 0; set < std::size_t(sets.sets); ++set) {
                    if (by_light ? set != l : (channels == 3 && set != ch)) continue;
                    const double power = share * (by_light ? 1.0 : colour[set]);
                    int k = 0;
                    for (int band = 0; band < bands; ++band)
                        for (int order = -band; order <= band; ++order, ++k)
                            out[int(set) * count + k] += sums[k] * factor[band] * power;
                    // Only beams and lamps have sums about axes.
                    const Light& light = in.lighting->lights[l];
                    for (int d = 0; k < count && (light.beam || light.lamps); ++k, ++d)
                        out[int(set) * count + k] +=
                            sums[k] * factor[bands + d % in.deposit.axis_degrees] * power;
                }
            }
        }
    }
}

}  // namespace

Status reconstruct_harmonics(const ReconstructInput& in, int batch, Span<const std::uint32_t> which,
                             HarmonicSource& out) {
    const std::size_t count = which.size > 0 ? which.size : in.collectors.size;
    const Batch shown = batch_of(in, batch);
    out.numbers = in.deposit.bands * in.deposit.bands + axis_numbers(in.deposit);
    out.sets = harmonic_sets(sum_channels(*in.medium, in.deposit), *in.lighting);
    for (int s = 0; s < out.sets; ++s)
        for (std::size_t c = 0; c < 3; ++c)
            out.colour[s][c] = out.sets < 3 ? float(in.lighting->lights[std::size_t(s)].colour[c])
                                            : (std::size_t(s) == c ? 1.0f : 0.0f);
    const std::size_t numbers = std::size_t(out.sets) * std::size_t(out.numbers);
    PILEUS_TRY(allocate_once(arrays::collector_colours(numbers, count), out.values));
    const Window window = band_window(in.deposit.bands, in.window);
    constexpr std::size_t kPiece = 256;
    parallel_for(
        in.threads, std::int64_t((count + kPiece - 1) / kPiece), [&](std::int64_t piece, int) {
            const std::size_t begin = std::size_t(piece) * kPiece;
            const std::size_t end = begin + kPiece < count ? begin + kPiece : count;
            double own[3 * kMaxNumbers];
            for (std::size_t i = begin; i < end; ++i) {
                collector_harmonics(in, window, which.size > 0 ? which[i] : i, shown, out, own);
                for (std::size_t k = 0; k < numbers; ++k) out.values[k * count + i] = float(own[k]);
            }
        });
    return Status::ok();
}

}  // namespace pileus
