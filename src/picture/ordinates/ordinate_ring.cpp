// SPDX-License-Identifier: Apache-2.0
// See ordinate_ring.h.
#include "src/picture/ordinates/ordinate_ring.h"

#include <algorithm>

#include "platform/threads.h"

namespace pileus {
namespace {

/// Between two of the nodes along an axis that have moments.
struct Between {
    std::size_t low = 0, high = 0;
    float share = 0;
};
Between between(double at, int first, int count) {
    const double place = std::min(std::max(at - first, 0.0), double(count - 1));
    Between out;
    out.low = std::size_t(place);
    out.high = std::min(out.low + 1, std::size_t(count - 1));
    out.share = float(place - double(out.low));
    return out;
}

/// A coarser solution, read at places of finer nodes; both have the same heights.
class CoarserLight {
public:
    CoarserLight(const OrdinateCoarser& from, std::size_t s)
        : from_(from),
          ring_(from.nodes->ring ? 1 : 0),
          nx_(from.nodes->grid.size[0] - 2 * ring_),
          ny_(from.nodes->grid.size[1] - 2 * ring_),
          filled_(from.nodes->filled.size()),
          moments_(from.nodes->solution.data() + s * filled_ * kOrdinateMoments) {}

    void read(const NodePlace& p, float (&out)[kOrdinateMoments]) const {
        const Between u = between(from_.first[0] + from_.step[0] * p[0], ring_, nx_);
        const Between v = between(from_.first[1] + from_.step[1] * p[1], ring_, ny_);
        const std::size_t slice = std::size_t(p[2]) * std::size_t(ny_);
        const float* low = moments_ + (slice + v.low) * std::size_t(nx_);
        const float* high = moments_ + (slice + v.high) * std::size_t(nx_);
        for (int m = 0; m < kOrdinateMoments; ++m, low += filled_, high += filled_) {
            const float a = low[u.low] + (low[u.high] - low[u.low]) * u.share;
            const float b = high[u.low] + (high[u.high] - high[u.low]) * u.share;
            out[m] = a + (b - a) * v.share;
        }
    }

private:
    const OrdinateCoarser& from_;
    int ring_, nx_, ny_;
    std::size_t filled_;
    const float* moments_;
};

}  // namespace

Status light_ring(const Context& context, const OrdinateCoarser& coarser, std::size_t s,
                  bool begins, OrdinateCells& nodes, Buffer<float>& ring, OrdinateSources& from) {
    const std::size_t of_ring = std::size_t(ring_count(nodes.grid)), filled = nodes.filled.size();
    PILEUS_TRY(allocate_once(arrays::ordinate_ring(of_ring), ring));
    const CoarserLight light(coarser, s);
    const auto read = [&](std::size_t i, float(&out)[kOrdinateMoments]) {
        light.read(node_place(nodes.grid, i), out);
    };
    float harmonic[kOrdinates][kOrdinateMoments];
    set_ordinate_harmonics(harmonic);
    each_of_ring(nodes.grid, [&](std::size_t r, std::size_t i) {
        float moment[kOrdinateMoments];
        read(i, moment);
        for (std::size_t j = 0; j < kOrdinates; ++j) {
            float sum = 0;
            for (std::size_t m = 0; m < kOrdinateMoments; ++m) sum += moment[m] * harmonic[j][m];
            ring[j * of_ring + r] = std::max(sum, 0.0f);
        }
    });
    from.ring = ring.data();
    from.started = begins;
    if (!begins) return Status::ok();
    float* start = nodes.solution.data() + s * filled * kOrdinateMoments;
    parallel_each(context.threads, filled, [&](std::size_t n) {
        float moment[kOrdinateMoments];
        read(std::size_t(nodes.filled[n]), moment);
        for (std::size_t m = 0; m < kOrdinateMoments; ++m) start[m * filled + n] = moment[m];
    });
    return Status::ok();
}

}  // namespace pileus
