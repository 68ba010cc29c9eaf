// SPDX-License-Identifier: Apache-2.0
// See sun_tiles.h. A tile is halved until few places are left or it is small against the balls;
// then each place meets all balls that touch what is left, the nearest to the light first.
// in: balls, a direction -> out: tiles; depths by them.
#include "src/methods/particles/sun_tiles.h"

#include <algorithm>

#include "platform/threads.h"
#include "src/base/fnv1a64.h"
#include "src/methods/particles/tile_sort.h"
#include "src/run/device_launch.h"
#include "src/run/on_device.h"

namespace pileus {
namespace {

/// Places of a tile, where the balls' size allows it.
constexpr double kPlacesPerTile = 2048;
/// Side of a tile in mean radii at least.
constexpr double kMinSide = 3;
constexpr int kMaxAcross = 1024;
/// Times that a tile is halved at most, and what is not halved any more: so few places, or a side
/// of so many mean radii.
constexpr int kHalvings = 8;
constexpr std::uint64_t kFewPlaces = 256;
constexpr float kSmallSide = 0.5f;
/// Balls of a tile that are at hand at a time; places that are sorted at a time.
constexpr std::uint32_t kAtHand = 16384, kBatch = 1024;

using Offset = std::array<float, 3>;

struct Spot {
    float u, v, w;
};
struct TileBall {
    float w;
    std::uint32_t ball;
};
/// What is looked at to find the balls that touch a square.
struct Disc {
    float u, v, square;    ///< of the radius
    std::uint32_t number;  ///< at hand
};
/// A square of places, and the balls at hand that touch it.
struct Part {
    float low[2], side;
    std::uint64_t bounds[5];     ///< of its children's places; the first and last are its own
    std::uint32_t first, count;  ///< of its balls, in Scratch::named
    int child;                   ///< the next to look at; -1: places are not yet parted
};
struct Scratch {
    TileBall order[kAtHand];
    ParticleOccluder at_hand[kAtHand];
    ParticleOccluder met[kAtHand];
    Disc named[(kHalvings + 1) * kAtHand];  ///< part behind part
    float u[kBatch], v[kBatch], w[kBatch], depth[kBatch];
};

double dot3(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Two axes across the direction; along an axis of space they are axes of space.
void set_axes(const std::array<float, 3>& direction, const ParticleNode& box, SunTiles& t) {
    double* w = t.axis[2];
    for (std::size_t a = 0; a < 3; ++a) {
        w[a] = double(direction[a]);
        t.middle[a] = 0.5 * (double(box.low[a]) + double(box.high[a]));
    }
    const double length = __builtin_sqrt(dot3(w, w));
    std::size_t least = 0;
    for (std::size_t a = 0; a < 3; ++a) {
        w[a] /= length;
        if (w[a] * w[a] < w[least] * w[least]) least = a;
    }
    const std::size_t j = (least + 1) % 3, k = (least + 2) % 3;
    const double across = __builtin_sqrt(w[j] * w[j] + w[k] * w[k]);
    t.axis[0][least] = 0;
    t.axis[0][j] = w[k] / across;
    t.axis[0][k] = -w[j] / across;
    for (std::size_t a = 0; a < 3; ++a) {
        const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
        t.axis[1][a] = w[b] * t.axis[0][c] - w[c] * t.axis[0][b];
    }
}

Spot spot_at(const SunTiles& t, const double* place) {
    const double p[3] = {place[0] - t.middle[0], place[1] - t.middle[1], place[2] - t.middle[2]};
    return {float(dot3(t.axis[0], p)), float(dot3(t.axis[1], p)), float(dot3(t.axis[2], p))};
}
Spot spot_of(const SunTiles& t, const ParticleBall& ball, const Offset& offset) {
    const float radius = 1.0f / ball.per_radius;
    double place[3];
    for (std::size_t a = 0; a < 3; ++a) place[a] = double(ball.centre[a] + offset[a] * radius);
    return spot_at(t, place);
}

/// The tile of a place along u or v; what lies outside belongs to the edge.
int tile_at(const SunTiles& t, float place, int a) {
    const float at = (place - t.low[a]) / t.side;
    const int last = t.across[a] - 1;
    return at > 0 ? (at < float(last) ? int(at) : last) : 0;
}

/// Tiles over the box of all, `side` wide but for their most number.
void lay_tiles(const float (&size)[2], double side, SunTiles& t) {
    for (const float s : size) side = std::max(side, double(s) / (kMaxAcross - 1));
    t.side = float(side);
    for (int a = 0; a < 2; ++a) t.across[a] = 1 + int(size[a] / t.side);
}

ParticleOccluder occluder_of(const SunTiles& t, const ParticleBall& ball) {
    const Spot s = spot_of(t, ball, {0, 0, 0});
    const float radius = 1.0f / ball.per_radius;
    return {s.u,
            s.v,
            s.w,
            ball.per_radius * ball.per_radius,
            ball.depth * (16.0f / 15),
            s.w + radius,
            s.w - radius,
            ball.per_radius};
}

/// Nearest to the light first; equal ones by their numbers.
struct FirstOf {
    bool operator()(const TileBall& a, const TileBall& b) const {
        return a.w != b.w ? a.w > b.w : a.ball < b.ball;
    }
};

/// The work on one tile.
class TileWork {
public:
    TileWork(const Context& context, const SunTiles& tiles, const Offset& offset, float most,
             Scratch& scratch, std::uint32_t* places, float* depth, Status& status)
        : kernels_(*context.kernels),
          t_(tiles),
          offset_(offset),
          most_(most),
          s_(scratch),
          places_(places),
          depth_(depth),
          status_(status) {}

    /// `balls` [count] are sorted here; places are numbers of `places`.
    void run(std::uint32_t tile, std::uint32_t* balls, std::size_t count, std::uint64_t begin,
             std::uint64_t end) {
        // What is not at hand at once is sorted in place and taken by and by.
        if (count > kAtHand)
            std::sort(balls, balls + count, [&](std::uint32_t a, std::uint32_t b) {
                return FirstOf()({back_of(a), a}, {back_of(b), b});
            });
        for (std::size_t from = 0; from < count; from += kAtHand) {
            const std::uint32_t own = std::uint32_t(std::min<std::size_t>(kAtHand, count - from));
            for (std::uint32_t i = 0; i < own; ++i) {
                const std::uint32_t ball = balls[from + i];
                s_.order[i] = {back_of(ball), ball};
            }
            if (count <= kAtHand) std::sort(s_.order, s_.order + own, FirstOf());
            float radii = 0;
            for (std::uint32_t i = 0; i < own; ++i) {
                const ParticleBall& ball = t_.casts[s_.order[i].ball];
                const ParticleOccluder o = occluder_of(t_, ball);
                const float radius = 1.0f / ball.per_radius;
                s_.at_hand[i] = o;
                s_.named[i] = {o.u, o.v, radius * radius, i};
                radii += radius;
            }
            small_ = kSmallSide * radii / float(own);
            const std::uint32_t across = std::uint32_t(t_.across[0]);
            Part root{};
            root.low[0] = t_.low[0] + float(tile % across) * t_.side;
            root.low[1] = t_.low[1] + float(tile / across) * t_.side;
            root.side = t_.side;
            root.bounds[0] = begin, root.bounds[4] = end;
            root.count = own;
            root.child = -1;
            halve(root);
        }
    }

private:
    float back_of(std::uint32_t ball) const {
        const ParticleBall& b = t_.casts[ball];
        return spot_of(t_, b, {0, 0, 0}).w + 1.0f / b.per_radius;
    }
    Spot spot(std::uint32_t ball) const { return spot_of(t_, t_.tree->balls[ball], offset_); }

    /// First children first.
    void halve(const Part& root) {
        Part stack[kHalvings + 1];
        int depth = 0;
        stack[depth++] = root;
        while (depth > 0) {
            Part& top = stack[depth - 1];
            if (top.child < 0) {
                const bool few = top.bounds[4] - top.bounds[0] <= kFewPlaces;
                if (few || top.side <= small_ || depth > kHalvings) {
                    meet(top);
                    --depth;
                    continue;
                }
                part_places(top);
                top.child = 0;
            }
            if (top.child == 4) {
                --depth;
                continue;
            }
            const int c = top.child++;
            if (top.bounds[c] == top.bounds[c + 1]) continue;
            Part child{};
            child.side = 0.5f * top.side;
            child.low[0] = top.low[0] + float(c & 1) * child.side;
            child.low[1] = top.low[1] + float(c >> 1) * child.side;
            child.bounds[0] = top.bounds[c], child.bounds[4] = top.bounds[c + 1];
            child.first = top.first + top.count;
            child.child = -1;
            name_balls(top, child);
            if (child.count > 0) stack[depth++] = child;
        }
    }
    void part_places(Part& p) const {
        const float u = p.low[0] + 0.5f * p.side, v = p.low[1] + 0.5f * p.side;
        std::uint32_t *begin = places_ + p.bounds[0], *end = places_ + p.bounds[4];
        const auto below = [&](std::uint32_t ball) { return spot(ball).v < v; };
        const auto left = [&](std::uint32_t ball) { return spot(ball).u < u; };
        std::uint32_t* middle = std::partition(begin, end, below);
        p.bounds[1] = std::uint64_t(std::partition(begin, middle, left) - places_);
        p.bounds[2] = std::uint64_t(middle - places_);
        p.bounds[3] = std::uint64_t(std::partition(middle, end, left) - places_);
    }
    /// Those of the parent that touch the child, in the same order.
    void name_balls(const Part& parent, Part& child) const {
        const float half = 0.5f * child.side;
        const float u = child.low[0] + half, v = child.low[1] + half;
        const Disc *from = s_.named + parent.first, *end = from + parent.count;
        Disc* to = s_.named + child.first;
        for (; from < end; ++from) {
            const Disc disc = *from;
            const float x = std::max(__builtin_fabsf(disc.u - u) - half, 0.0f);
            const float y = std::max(__builtin_fabsf(disc.v - v) - half, 0.0f);
            *to = disc;
            to += x * x + y * y < disc.square ? 1 : 0;
        }
        child.count = std::uint32_t(to - s_.named) - child.first;
    }
    void meet(const Part& p) const {
        ParticleDepthParams k{};
        k.occluders = s_.met;
        k.count = std::int32_t(p.count);
        k.most = most_;
        for (std::uint32_t i = 0; i < p.count; ++i)
            s_.met[i] = s_.at_hand[s_.named[p.first + i].number];
        for (std::uint64_t from = p.bounds[0]; from < p.bounds[4]; from += kBatch) {
            const std::uint32_t count =
                std::uint32_t(std::min<std::uint64_t>(kBatch, p.bounds[4] - from));
            for (std::uint32_t i = 0; i < count; ++i) {
                const std::uint32_t ball = places_[from + i];
                s_.order[i] = {spot(ball).w, ball};
            }
            std::sort(s_.order, s_.order + count, FirstOf());
            for (std::uint32_t i = 0; i < count; ++i) {
                const Spot at = spot(s_.order[i].ball);
                s_.u[i] = at.u, s_.v[i] = at.v, s_.w[i] = at.w;
                s_.depth[i] = depth_[s_.order[i].ball];
            }
            const ParticleDepthBuffers b{s_.u, s_.v, s_.w, s_.depth};
            if (!on_device(kernels_.device))
                kernels_.particle_depths(k, b, 0, count);
            else if (status_)
                status_ = launch_on_device(*kernels_.device, k, b, count);
            for (std::uint32_t i = 0; i < count; ++i) depth_[s_.order[i].ball] = s_.depth[i];
        }
    }

    const KernelTable& kernels_;
    const SunTiles& t_;
    const Offset& offset_;
    float most_, small_ = 0;
    Scratch& s_;
    std::uint32_t* places_;
    float* depth_;
    Status& status_;  ///< of a device, whose tiles follow one another
};

}  // namespace

std::uint64_t sun_tile_scratch_bytes() { return sizeof(Scratch); }

Status choose_occluders(const ParticleTree& tree, double share, Buffer<ParticleBall>& chosen) {
    const std::uint64_t below = std::uint64_t(share * 0x1p32);
    const auto each = [&](auto take) {
        for (std::size_t i = 0; i < tree.balls.size(); ++i) {
            const ParticleBall& ball = tree.balls[i];
            Fnv1a64 mark;
            if (tree.id.empty()) {
                mark.floats({ball.centre, 3});
                mark.floats({&ball.per_radius, 1});
                mark.floats({&ball.depth, 1});
            } else {
                // Another lot than that of density.share.
                mark.u32(1);
                mark.u64(tree.id[i]);
            }
            if (lot_of(mark.value()) < below) take(ball);
        }
    };
    std::size_t count = 0;
    each([&](const ParticleBall&) { ++count; });
    PILEUS_TRY(chosen.resize(count, arrays::particle_occluders(0).name));
    count = 0;
    each([&](const ParticleBall& ball) {
        chosen[count] = ball;
        chosen[count++].depth = float(double(ball.depth) / share);
    });
    return Status::ok();
}

Status make_sun_tiles(const Context& context, const ParticleTree& tree,
                      Span<const ParticleBall> casts, const std::array<float, 3>& direction,
                      SunTiles& t) {
    t.tree = &tree;
    t.casts = casts;
    const std::size_t count = casts.size;
    const ParticleNode& box = tree.nodes[0];
    set_axes(direction, box, t);
    float high[2] = {-3e38f, -3e38f};
    t.low[0] = t.low[1] = 3e38f;
    for (int corner = 0; corner < 8; ++corner) {
        double place[3];
        for (int a = 0; a < 3; ++a)
            place[a] = double((corner >> a & 1) != 0 ? box.high[a] : box.low[a]);
        const Spot s = spot_at(t, place);
        const float at[2] = {s.u, s.v};
        for (int a = 0; a < 2; ++a) {
            t.low[a] = std::min(t.low[a], at[a]);
            high[a] = std::max(high[a], at[a]);
        }
    }
    const float size[2] = {high[0] - t.low[0], high[1] - t.low[1]};
    double radii = 0;
    for (const ParticleBall& ball : tree.balls.span()) radii += 1 / double(ball.per_radius);
    const double places = double(tree.balls.size());
    const double area = double(size[0]) * double(size[1]) * kPlacesPerTile / places;
    double side = std::max(__builtin_sqrt(area), kMinSide * radii / places);
    const std::uint64_t most = arrays::tile_balls(count).count;
    for (bool fits = false; !fits; side *= 2) {
        lay_tiles(size, side, t);
        PILEUS_TRY(sort_into(context, count, t.count(), t.begin, most, fits, t.balls,
                             [&](std::size_t i, auto put) {
                                 const ParticleBall& ball = t.casts[i];
                                 const Spot s = spot_of(t, ball, {0, 0, 0});
                                 const float radius = 1.0f / ball.per_radius;
                                 const int last_u = tile_at(t, s.u + radius, 0),
                                           last_v = tile_at(t, s.v + radius, 1);
                                 for (int v = tile_at(t, s.v - radius, 1); v <= last_v; ++v)
                                     for (int u = tile_at(t, s.u - radius, 0); u <= last_u; ++u)
                                         put(std::uint32_t(v * t.across[0] + u));
                             }));
    }
    return Status::ok();
}

Status sun_depths(const Context& context, SunTiles& t, const std::array<float, 3>& offset,
                  float most, float* depth, int pass, int passes) {
    const std::size_t count = t.tree->balls.size();
    Buffer<std::uint64_t> begin;
    Buffer<std::uint32_t> places;
    bool fits = false;
    PILEUS_TRY(sort_into(
        context, count, t.count(), begin, count, fits, places, [&](std::size_t i, auto put) {
            const Spot s = spot_of(t, t.tree->balls[i], offset);
            put(std::uint32_t(tile_at(t, s.v, 1) * t.across[0] + tile_at(t, s.u, 0)));
        }));
    Buffer<Scratch> scratch;
    PILEUS_TRY(scratch.resize(std::uint64_t(context.threads), "tiles"));
    for (std::size_t i = 0; i < count; ++i) depth[i] = 0;
    Status status;
    const int threads = on_device(context.kernels->device) ? 1 : context.threads;
    parallel_for(threads, t.count(), [&](std::int64_t tile, int thread) {
        if (thread == 0) context.tell("light", (pass + double(tile) / double(t.count())) / passes);
        TileWork work(context, t, offset, most, scratch[std::size_t(thread)], places.data(), depth,
                      status);
        const std::size_t own = std::size_t(tile);
        if (begin[own] == begin[own + 1]) return;
        work.run(std::uint32_t(tile), t.balls.data() + t.begin[own],
                 std::size_t(t.begin[own + 1] - t.begin[own]), begin[own], begin[own + 1]);
    });
    return status;
}

}  // namespace pileus
