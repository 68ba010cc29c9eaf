// SPDX-License-Identifier: Apache-2.0
// See beam.h.
// in: a phase function -> out: its moments within a cone and in all, sums of Legendre polynomials.
// docs/methods.md 3, "The beam's peak".
#include "src/world/light/beam.h"

#include "platform/threads.h"
#include "src/base/angles.h"
#include "src/base/exponential.h"
#include "src/base/legendre.h"
#include "src/world/phase/forward_share.h"

namespace pileus {
namespace {

/// Degrees that are tried: smooth phase functions are done after the first.
constexpr int kDegrees[] = {96, 512, 1024};
constexpr int kMaxDegrees = kDegrees[2];
constexpr double kNothing = 1e-5;  // of a degree's part in the sum
/// Of the last eighth of the degrees: a sum cut off there would ring, by a thirtieth of that at
/// angles far from the peak, where P_l is as small.
constexpr double kRings = 1e-3;
/// ln of what is left of the last degree of a sum that is smoothed.
constexpr double kSmoothing = 14;
/// Straight on a phase function above this has its peak within 1 - cos = 2^-40 and nearer.
constexpr double kNeedle = 17500;

/// Moments of the whole function and of what stays in the beam; degrees that count.
struct Moments {
    std::vector<double> all, kept;
    int degrees = 1;  ///< the last that counts, and one
    /// 0; or the peak is narrower than the degrees hold, and degree l counts e^(-smooth l (l + 1)):
    /// spread by a Gaussian, which moves light by fractions of a degree, makes none and is never
    /// negative. A sum that is only cut off rings at all angles, and its positive parts are shown.
    double smooth = 0;

    explicit Moments(int count) : all(std::size_t(count)), kept(std::size_t(count)) {}
    double part(std::size_t l) const {
        const double value = (2 * double(l) + 1) * all[l] * kept[l];
        return value < 0 ? -value : value;
    }
    bool rings() const {
        for (std::size_t l = all.size() - all.size() / 8; l < all.size(); ++l)
            if (part(l) > kRings) return true;
        return false;
    }
};

/// Adds the integrals of 2 pi p P_l over 1 - cos in [begin, end], by Simpson's rule with at least
/// twelve places in a period of the highest degree.
void add_panel(const PhaseParams& phase, double turn, double begin, double end, Moments& m) {
    const auto angle = [](double x) {  // within a tenth: it only chooses how many places
        return x < 1 ? 1.5 * __builtin_sqrt(x) : 3.14159 - 1.5 * __builtin_sqrt(2 - x);
    };
    const int degrees = int(m.all.size());
    const int parts = 16 + 2 * int((angle(end) - angle(begin)) * degrees);
    for (int i = 0; i <= parts; ++i) {
        const double x = begin + (end - begin) * i / parts;
        const double simpson = i == 0 || i == parts ? 1 : i % 2 == 1 ? 4 : 2;
        const double weight = kTwoPi64 * simpson * (end - begin) / (3.0 * parts) *
                              double(phase_density(phase, float(x)));
        const double kept = x < 30 * turn ? weight * exponential(-x / turn) : 0;
        legendre(1 - x, degrees, [&](std::size_t l, double value) {
            m.all[l] += weight * value;
            m.kept[l] += kept * value;
        });
    }
}

/// Panels halve towards straight on and straight back, where peaks are. What goes exactly straight
/// on has no density: it is all in the beam.
Moments moments_of(const PhaseParams& phase, double turn) {
    const bool needle = double(phase_density(phase, 0.0f)) > kNeedle;
    const double least = needle ? 0x1p-60 : 0x1p-40;
    const double straight = needle_shares(phase).forward;
    for (const int degrees : kDegrees) {
        if (needle && degrees < kMaxDegrees) continue;
        Moments m(degrees);
        for (double outer = 1, inner; outer > 0; outer = inner) {
            inner = outer > least ? 0.5 * outer : 0;
            add_panel(phase, turn, inner, outer, m);
        }
        for (double outer = 1, inner; outer > 0; outer = inner) {
            inner = outer > 0x1p-22 ? 0.5 * outer : 0;
            add_panel(phase, turn, 2 - outer, 2 - inner, m);
        }
        for (std::size_t l = 0; straight > 0 && l < m.all.size(); ++l)
            m.all[l] += straight, m.kept[l] += straight;
        for (std::size_t l = 0; l < m.all.size(); ++l)
            if (m.part(l) > kNothing) m.degrees = int(l) + 1;
        // A sum that ends well before its degrees do has all that counts.
        if (m.degrees < degrees - degrees / 8) return m;
        if (degrees >= kDegrees[1] && !m.rings()) return m;
        if (degrees < kMaxDegrees) continue;
        m.smooth = kSmoothing / (double(degrees) * (degrees + 1));
        return m;
    }
    return Moments(1);
}

/// Moments of what stays in the beam of a point. Moments fall with the square of small angles times
/// l (l + 1): they are means over the root of that, up to each degree's, of values between whose
/// degrees they are linear in its square.
std::vector<double> point_moments(const Moments& m) {
    std::vector<double> mean(std::size_t(m.degrees), m.kept[0]);
    double sum = 0, a = 0;
    for (std::size_t l = 1; l < mean.size(); ++l) {
        const double b = __builtin_sqrt(double(l) * double(l + 1));
        const double slope = (m.kept[l] - m.kept[l - 1]) / (b * b - a * a);
        sum += (m.kept[l - 1] - slope * a * a) * (b - a) + slope * (b * b * b - a * a * a) / 3;
        mean[l] = sum / b;
        a = b;
    }
    return mean;
}

/// (2l+1)/4pi chi_l times the two exponentials' difference: [depth][degree]. `kept`: moments of
/// what stays in the beam.
std::vector<double> weights_of(const Moments& m, const std::vector<double>& kept, double albedo) {
    const std::size_t degrees = std::size_t(m.degrees);
    std::vector<double> w((kBeamDepths + 1) * degrees);
    for (int d = 0; d <= kBeamDepths; ++d) {
        // The last node stands for all that is deeper: there nothing of the beam is left.
        const double part = (d < kBeamDepths ? d : kBeamDepths - 0.5) / double(kBeamDepths);
        const double tau = double(kBeamDepth) * part / (1 - part) * albedo;
        for (std::size_t l = 0; l < degrees; ++l)
            w[std::size_t(d) * degrees + l] =
                (2.0 * double(l) + 1) / (2 * kTwoPi64) * m.all[l] *
                (exponential(-tau * (kept[0] - kept[l])) - exponential(-tau * kept[0]));
        for (std::size_t l = 0; m.smooth > 0 && l < degrees; ++l)
            w[std::size_t(d) * degrees + l] *= exponential(-m.smooth * double(l) * (double(l) + 1));
    }
    return w;
}

/// 1 - cos of a node of the tables, as find_angle of the march has them.
double turn_of_node(int node) { return turn_at_share(double(node) / kBeamAngles); }

/// Parts of several media of all extinction there is.
std::array<double, kMaxMedia> parts_of(const Medium& medium) {
    std::array<double, kMaxMedia> part{};
    const std::size_t voxels = std::size_t(voxel_count(medium.grid));
    double all = 0, first = 1;
    for (std::size_t v = 0; v < voxels; ++v) all += double(medium.volume.density[v]);
    for (int i = 1; i < medium.count && all > 0; ++i) {
        const float* from = medium.parts.data() + std::size_t(i - 1) * voxels;
        for (std::size_t v = 0; v < voxels; ++v) part[std::size_t(i)] += double(from[v]);
        part[std::size_t(i)] /= all;
        first -= part[std::size_t(i)];
    }
    part[0] = first > 0 ? first : 0;
    return part;
}

/// Of several media, each as often as its part of the extinction and its albedo: moments by
/// `albedo` times those of one phase function.
Moments mean_moments(const std::vector<Moments>& of, const Medium& medium,
                     const std::array<double, kMaxMedia>& part, std::size_t channel,
                     double& albedo) {
    std::size_t count = 0;
    for (const Moments& m : of) count = m.all.size() > count ? m.all.size() : count;
    Moments out{int(count)};
    albedo = 0;
    for (std::size_t i = 0; i < of.size(); ++i) {
        const double w = part[i] * double(medium.optics[i].albedo[channel]);
        albedo += w;
        out.degrees = of[i].degrees > out.degrees ? of[i].degrees : out.degrees;
        out.smooth = of[i].smooth > out.smooth ? of[i].smooth : out.smooth;
        for (std::size_t l = 0; l < of[i].all.size(); ++l) {
            out.all[l] += w * of[i].all[l];
            out.kept[l] += w * of[i].kept[l];
        }
    }
    for (std::size_t l = 0; l < count && albedo > 0; ++l)
        out.all[l] /= albedo, out.kept[l] /= albedo;
    return out;
}

void fill_angle(const Moments& m, const std::vector<double>& weights, int node, float* out) {
    double values[kMaxDegrees];
    legendre(1 - turn_of_node(node), m.degrees,
             [&](std::size_t l, double value) { values[l] = value; });
    for (int d = 0; d <= kBeamDepths; ++d) {
        const double* w = weights.data() + std::size_t(d) * std::size_t(m.degrees);
        double sum = 0;
        for (int l = 0; l < m.degrees; ++l) sum += w[l] * values[l];
        out[d] = sum > 0 ? float(sum) : 0.0f;
    }
}

}  // namespace

float turn_of_deg(double deg) {
    const double half = sincos_deg(0.5 * deg).sine;
    return float(2 * half * half);
}

std::vector<double> peak_moments(const PhaseParams& phase, float peak_turn) {
    const Moments m = moments_of(phase, double(peak_turn));
    return std::vector<double>(m.kept.begin(), m.kept.begin() + m.degrees);
}

Status make_beam(const Medium& medium, float peak_turn, bool points, BeamTurns turns, int threads,
                 Stage first, Beam& out) {
    const int sets = medium.channels, kinds = points ? 2 : 1;
    PILEUS_TRY(allocate_once(arrays::beam_tables(std::uint64_t(kinds * sets), first), out.tables));
    const int media = turns == BeamTurns::kPeak ? medium.count : 1;
    std::vector<Moments> of;
    for (int i = 0; i < media; ++i) {
        of.push_back(moments_of(medium.optics[std::size_t(i)].phase, double(peak_turn)));
        if (turns == BeamTurns::kPeak) of.back().all = of.back().kept;
        out.shares[i] = of.back().kept[0];
    }
    Moments m = of[0];
    std::array<double, kMaxMedia> part{};
    if (media > 1) part = parts_of(medium);
    for (std::size_t s = 0; s < 3; ++s) {
        double albedo = double(medium.optics[0].albedo[s]);
        if (media > 1) m = mean_moments(of, medium, part, medium.channels > 1 ? s : 0, albedo);
        out.rest[s] = float(1 - albedo * m.kept[0]);
        for (int kind = 0; kind < kinds && int(s) < sets; ++kind) {
            const std::vector<double> weights =
                weights_of(m, kind == 0 ? m.kept : point_moments(m), albedo);
            float* table = out.tables.data() + (kind * sets + int(s)) * kBeamNumbers;
            parallel_for(threads, kBeamAngles + 1, [&](std::int64_t node, int) {
                fill_angle(m, weights, int(node), table + node * (kBeamDepths + 1));
            });
        }
    }
    // Of tables that are there.
    out.sets = sets;
    out.points = points;
    return Status::ok();
}

}  // namespace pileus
