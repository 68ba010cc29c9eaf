// SPDX-License-Identifier: Apache-2.0
// See sky_view.h.
// in: what nodes see -> out: what of it goes towards the camera.
// docs/raymarch.md, "Skylight".
#include "src/picture/nodes/sky_view.h"

#include "kernels_cpu/core/math.h"
#include "src/base/angles.h"
#include "src/world/phase/forward_share.h"

namespace pileus {
namespace {

constexpr int kChunk = 64;  // nodes that are worked on together
/// Cosine of the rim of a disc that is as large as a part.
constexpr double kRim = 1 - 2.0 / kSkyParts;

double arc_cosine_share(double cosine) {
    if (cosine >= 1) return 0;
    if (cosine <= -1) return 1;
    const double sine = __builtin_sqrt(1 - cosine * cosine);
    return 2 * double(atan2_turns(float(sine), float(cosine)));
}

/// Rings about the way ahead: where they lie and how much of the scattered light is in each.
struct Rings {
    static constexpr int kCount = 180;
    double cosine[kCount], sine[kCount], share[kCount];
};

Rings rings_of(const Medium& medium) {
    Rings r{};
    for (int n = 0; n < Rings::kCount; ++n) {
        const SineCosine middle = sincos_deg(n + 0.5);
        r.cosine[n] = middle.cosine;
        r.sine[n] = middle.sine;
    }
    for (int i = 0; i < medium.count; ++i) {
        double before = 0;
        for (int n = 0; n < Rings::kCount; ++n) {
            const double within = n + 1 < Rings::kCount
                                      ? forward_share(medium.optics[std::size_t(i)].phase, n + 1.0)
                                      : 1;
            r.share[n] += (within - before) / medium.count;
            before = within;
        }
    }
    return r;
}

/// Of some nodes, the way from the camera: a unit vector, and how much of it is known. Within two
/// nodes of the camera rays of all directions pass.
struct Ways {
    float x[kChunk], y[kChunk], z[kChunk], known[kChunk];
};

void find_ways(const SkyViewInput& in, std::size_t begin, int count, Ways& w) {
    const CameraParams& c = in.view->camera;
    const std::size_t nx = std::size_t(in.grid.size[0]), ny = std::size_t(in.grid.size[1]);
    float reach = 0;
    for (float per_metre : in.grid.per_metre) {
        const float spacing = 1 / per_metre;
        reach = 2 * spacing > reach ? 2 * spacing : reach;
    }
    for (int i = 0; i < count; ++i) {
        const std::size_t n = begin + std::size_t(i);
        const float at[3] = {(float(n % nx) + 0.5f) / in.grid.per_metre[0],
                             (float(n / nx % ny) + 0.5f) / in.grid.per_metre[1],
                             (float(n / (nx * ny)) + 0.5f) / in.grid.per_metre[2]};
        float d[3], square = 0;
        for (int a = 0; a < 3; ++a) {
            d[a] = c.orthographic != 0 ? c.forward[a] : at[a] - c.origin[a];
            square += d[a] * d[a];
        }
        const float length = __builtin_sqrtf(square), scale = length > 0 ? 1 / length : 0.0f;
        w.x[i] = d[0] * scale, w.y[i] = d[1] * scale, w.z[i] = d[2] * scale;
        w.known[i] = c.orthographic != 0 || length > reach ? 1 : length / reach;
    }
}

/// What later octaves bring to a node of each set, over what they would if nothing were absorbed.
void add_later(const SkyViewInput& in, std::size_t begin, int count, const Ways& w,
               const float* rest, float* light) {
    const std::size_t nodes = in.seen.size / std::size_t(sky_seen_numbers(true, in.octaves));
    const float* seen = in.seen.data + begin;
    float sum[3][kChunk] = {};
    for (std::size_t p = 0; p < kSkyParts; ++p) {
        const std::array<float, 3>& d = (*in.middles)[p];
        const float* alike = seen + (kSkyParts + p) * nodes;
        const float* turned = seen + (2 * kSkyParts + p) * nodes;
        for (int i = 0; i < count; ++i) {
            const float along = (d[0] * w.x[i] + d[1] * w.y[i] + d[2] * w.z[i]) * w.known[i];
            const float comes = alike[i] + turned[i] * along;
            for (int s = 0; s < in.sets; ++s) sum[s][i] += float(in.share[s][p]) * comes;
        }
    }
    const float* all = seen + 3 * kSkyParts * nodes;
    for (int i = 0; i < count; ++i) {
        const float along = all[nodes + std::size_t(i)] * w.x[i] +
                            all[2 * nodes + std::size_t(i)] * w.y[i] +
                            all[3 * nodes + std::size_t(i)] * w.z[i];
        const float white = all[i] + along * w.known[i];
        const float scale = rest[i] > 0 && white > 0 ? kSkyParts * rest[i] / white : 0.0f;
        for (int s = 0; s < in.sets; ++s)
            light[std::size_t(s) * nodes + begin + std::size_t(i)] += scale * sum[s][i];
    }
}

void turn_chunk(const SkyViewInput& in, std::size_t begin, int count, float* light) {
    const std::size_t nodes = in.seen.size / std::size_t(sky_seen_numbers(true, in.octaves));
    Ways w;
    find_ways(in, begin, count, w);
    float weight[kChunk] = {}, straight[kChunk] = {}, sum[3][kChunk] = {}, rest[kChunk];
    for (std::size_t p = 0; p < kSkyParts; ++p) {
        const std::array<float, 3>& d = (*in.middles)[p];
        const float* seen = in.seen.data + p * nodes + begin;
        for (int i = 0; i < count; ++i) {
            const float cosine = d[0] * w.x[i] + d[1] * w.y[i] + d[2] * w.z[i];
            float at = (cosine + 1) * (0.5f * kSkyPhaseSteps);
            at = at < 0 ? 0 : at > kSkyPhaseSteps - 0.001f ? kSkyPhaseSteps - 0.001f : at;
            const std::size_t step = std::size_t(int(at));
            const float low = (*in.phase)[step], high = (*in.phase)[step + 1];
            const float own = low + (high - low) * (at - float(step));
            const float scattered = 1 + (own - 1) * w.known[i];
            weight[i] += scattered;
            straight[i] += scattered * seen[i];
            for (int s = 0; s < in.sets; ++s)
                sum[s][i] += float(in.share[s][p]) * scattered * seen[i];
        }
    }
    for (int i = 0; i < count; ++i) {
        rest[i] = 1 - straight[i] / weight[i];
        for (int s = 0; s < in.sets; ++s)
            light[std::size_t(s) * nodes + begin + std::size_t(i)] =
                kSkyParts * sum[s][i] / weight[i];
    }
    if (in.octaves > 1) add_later(in, begin, count, w, rest, light);
    // What adds up to one may exceed it by rounding.
    for (int s = 0; s < in.sets; ++s)
        for (std::size_t n = begin; n < begin + std::size_t(count); ++n)
            if (light[std::size_t(s) * nodes + n] > 1) light[std::size_t(s) * nodes + n] = 1;
}

}  // namespace

std::array<float, 3> sky_direction(int part, double u, double v) {
    const int band = part / kSphereAround, turn = part % kSphereAround;
    const double z = -1 + 2 * (band + u) / kSphereBands;
    // Every other band turns by half a part.
    const double around = 360.0 / kSphereAround * (turn + v + 0.5 * (band % 2));
    const SineCosine a = sincos_deg(around);
    const double r = __builtin_sqrt(1 - z * z);
    return {float(a.cosine * r), float(a.sine * r), float(z)};
}

SkyDirections sky_directions() {
    SkyDirections d;
    for (int p = 0; p < kSkyParts; ++p) d[std::size_t(p)] = sky_direction(p);
    return d;
}

SkyPhase sky_phase(const Medium& medium) {
    const Rings r = rings_of(medium);
    SkyPhase phase{};
    for (int k = 0; k <= kSkyPhaseSteps; ++k) {
        const double cosine = -1 + 2.0 * k / kSkyPhaseSteps;
        const double sine = __builtin_sqrt(1 - cosine * cosine);
        double sum = 0;
        for (int n = 0; n < Rings::kCount; ++n) {
            // Share of a ring within the disc: by the angle where it meets the rim.
            const double across = r.sine[n] * sine, rim = kRim - r.cosine[n] * cosine;
            const double within = across > 1e-12 ? arc_cosine_share(rim / across) : rim <= 0;
            sum += r.share[n] * within;
        }
        phase[std::size_t(k)] = float(sum * kSkyParts);
    }
    return phase;
}

void turn_sky_nodes(const SkyViewInput& in, std::size_t begin, std::size_t end, float* light) {
    for (std::size_t n = begin; n < end; n += kChunk)
        turn_chunk(in, n, int(end - n < kChunk ? end - n : kChunk), light);
}

}  // namespace pileus
