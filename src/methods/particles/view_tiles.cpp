// SPDX-License-Identifier: Apache-2.0
// See view_tiles.h.
#include "src/methods/particles/view_tiles.h"

#include <algorithm>

#include "kernels_cpu/particles/particle_board_params.h"
#include "platform/threads.h"
#include "src/methods/particles/tile_sort.h"
#include "src/run/device_launch.h"
#include "src/run/on_device.h"

namespace pileus {
namespace {

/// Pixels across a tile, where balls are small, and across a block, whose rays share a list.
constexpr std::int32_t kTilePixels = 32, kBlockPixels = 8;
/// Balls of a tile; with more, its rays walk through the tree.
constexpr std::uint32_t kMaxSeen = 65536;
/// Of lengths in the kernel, rounding included; and of pixels.
constexpr double kSlack = 4e-6, kPixelSlack = 0.05;

/// Pixels whose centres a ball may cover, inclusive, and where rays may first meet it.
struct Cover {
    std::int32_t low[2], high[2];
    float front;
    std::uint32_t ball;
};
struct Nearer {
    bool operator()(const Cover& a, const Cover& b) const {
        return a.front != b.front ? a.front < b.front : a.ball < b.ball;
    }
};
struct Scratch {
    Cover covers[kMaxSeen];
    ParticleSeen seen[kMaxSeen];
};

class Screen {
public:
    Screen(const CameraParams& c, const ParticleNode& box) : c_(c) {
        for (std::size_t a = 0; a < 3; ++a) {
            axis_[0][a] = double(c.right[a]);
            axis_[1][a] = double(c.up[a]);
            axis_[2][a] = double(c.forward[a]);
            for (const float v : {c.origin[a], box.low[a], box.high[a]})
                largest_ = std::max(largest_, double(__builtin_fabsf(v)));
        }
    }

    /// False: no ray meets it.
    bool cover(const ParticleBall& ball, std::uint32_t number, Cover& out) const {
        double p[3] = {};
        for (int a = 0; a < 3; ++a)
            for (int i = 0; i < 3; ++i)
                p[a] += axis_[a][i] * (double(ball.centre[i]) - double(c_.origin[i]));
        const double radius = 1 / double(ball.per_radius);
        Outline o{};
        if (!outline(p, radius, o)) return false;
        const double way =
            c_.orthographic != 0 ? p[2] : __builtin_sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
        const double r = wide(radius);
        out.front = float(way - r - kSlack * (way + r));
        return pixels_of(o, number, out);
    }
    /// What has been found by frame().
    bool cover(const ParticleBoard& board, std::uint32_t number, Cover& out) const {
        for (int a = 0; a < 2; ++a) out.low[a] = board.low[a], out.high[a] = board.high[a];
        out.front = board.distance;
        out.ball = number;
        return board.low[0] <= board.high[0];
    }
    /// Finds the pixels that a board may cover, of all of the shutter's time.
    void frame(ParticleBoard& board) const {
        Cover own;
        const bool met = moving_cover(board, own);
        for (int a = 0; a < 2; ++a) {
            board.low[a] = met ? std::uint16_t(own.low[a]) : 1;
            board.high[a] = met ? std::uint16_t(own.high[a]) : 0;
        }
    }

private:
    bool moving_cover(const ParticleBoard& board, Cover& out) const {
        const double radius = 1 / __builtin_sqrt(double(board.per_square));
        Outline all{};
        int ahead = 0;
        const int times = board.way[0] == 0 && board.way[1] == 0 && board.way[2] == 0 ? 1 : 2;
        for (int time = 0; time < times; ++time) {
            const double when = times == 1 ? 0 : time - 0.5;
            double p[3];
            for (int a = 0; a < 3; ++a) p[a] = double(board.at[a]) + when * double(board.way[a]);
            Outline own{};
            if (!outline(p, radius, own)) continue;
            // A ball's way and what lies between two outlines are convex.
            for (int a = 0; a < 2 && ahead > 0; ++a) {
                own.low[a] = std::min(own.low[a], all.low[a]);
                own.high[a] = std::max(own.high[a], all.high[a]);
            }
            all = own;
            ++ahead;
        }
        if (ahead == 0) return false;
        // Through the camera's plane: anywhere.
        if (ahead < times) all = {{-kEverywhere, -kEverywhere}, {kEverywhere, kEverywhere}};
        return pixels_of(all, 0, out);
    }

    static constexpr double kEverywhere = 1e30;

    /// Pixels, columns and rows, whose centres a ball may cover.
    struct Outline {
        double low[2], high[2];
    };
    double wide(double radius) const { return (1 + kSlack) * radius + kSlack * largest_; }

    /// Of a ball at `p` along right, up, forward. False: behind the camera.
    bool outline(const double (&p)[3], double radius, Outline& out) const {
        const double r = wide(radius);
        if (p[2] + r <= 0) return false;
        const double shift[2] = {double(c_.shift_x), double(c_.shift_y)};
        const double half[2] = {double(c_.half_width), double(c_.half_height)};
        const std::int32_t pixels[2] = {whole_width(c_), whole_height(c_)};
        const std::int32_t first[2] = {c_.left, c_.top};
        for (int a = 0; a < 2; ++a) {
            double low = p[a] - r, high = p[a] + r;
            if (c_.orthographic == 0) {
                // Too near for an outline: everywhere.
                if (p[2] <= 1.001 * r) {
                    out.low[a] = -kEverywhere, out.high[a] = kEverywhere;
                    continue;
                }
                // Tangents in the plane of this axis and the view's.
                const double root = r * __builtin_sqrt(p[a] * p[a] + p[2] * p[2] - r * r);
                const double below = p[2] * p[2] - r * r;
                low = (p[a] * p[2] - root) / below, high = (p[a] * p[2] + root) / below;
            }
            const double scale = 0.5 * pixels[a] / half[a];
            out.low[a] = (low - shift[a] + half[a]) * scale - 0.5;
            out.high[a] = (high - shift[a] + half[a]) * scale - 0.5;
            if (a == 1) {
                const double turned = pixels[a] - 1 - out.low[a];
                out.low[a] = pixels[a] - 1 - out.high[a], out.high[a] = turned;
            }
            out.low[a] -= first[a], out.high[a] -= first[a];
        }
        return true;
    }
    /// Of a part's rows the first that is not above row `y` of the picture.
    std::int32_t row_from(std::int32_t y) const {
        const std::int32_t band = y / kPartRows, turn = band / c_.parts, of = band % c_.parts;
        if (of == c_.part) return turn * kPartRows + y % kPartRows;
        return (of < c_.part ? turn : turn + 1) * kPartRows;
    }
    bool pixels_of(const Outline& o, std::uint32_t number, Cover& out) const {
        out.ball = number;
        const std::int32_t rows = c_.parts == 1 ? c_.height : whole_height(c_) - c_.top;
        const std::int32_t pixels[2] = {c_.width, rows};
        for (int a = 0; a < 2; ++a) {
            const double first = o.low[a] - kPixelSlack, last = o.high[a] + kPixelSlack;
            if (!(last >= 0 && first <= pixels[a] - 1)) return false;
            out.low[a] = first > 0 ? up(first) : 0;
            out.high[a] = last < pixels[a] - 1 ? std::int32_t(last) : pixels[a] - 1;
            if (a == 1 && c_.parts > 1) {
                out.low[a] = row_from(out.low[a]);
                out.high[a] = std::min(row_from(out.high[a] + 1), c_.height) - 1;
            }
            if (out.low[a] > out.high[a]) return false;
        }
        return true;
    }
    static std::int32_t up(double v) {
        const std::int32_t whole = std::int32_t(v);
        return double(whole) < v ? whole + 1 : whole;
    }

    const CameraParams& c_;
    double axis_[3][3], largest_ = 0;
};

/// Balls of the picture's tiles.
struct Tiles {
    std::int32_t side = kTilePixels, across = 1, down = 1;
    Buffer<std::uint64_t> begin;
    Buffer<std::uint32_t> balls;

    std::uint32_t count() const { return std::uint32_t(across) * std::uint32_t(down); }
};

template <class Thing>
Status sort_things(const Context& context, Span<const Thing> things, const CameraParams& c,
                   const Screen& screen, Tiles& t) {
    const std::uint64_t most = arrays::view_balls(things.size).count;
    for (bool fits = false; !fits;) {
        t.across = (c.width - 1) / t.side + 1;
        t.down = (c.height - 1) / t.side + 1;
        PILEUS_TRY(sort_into(context, things.size, t.count(), t.begin, most, fits, t.balls,
                             [&](std::size_t i, auto put) {
                                 Cover own;
                                 if (!screen.cover(things[i], std::uint32_t(i), own)) return;
                                 for (int y = own.low[1] / t.side; y <= own.high[1] / t.side; ++y)
                                     for (int x = own.low[0] / t.side; x <= own.high[0] / t.side;
                                          ++x)
                                         put(std::uint32_t(y * t.across + x));
                             }));
        if (!fits) t.side *= 2;
    }
    return Status::ok();
}

/// Pixels of tile number `piece`.
ParticleTile tile_at(const Tiles& t, const CameraParams& c, std::int64_t piece) {
    ParticleTile tile{};
    tile.x_begin = std::int32_t(piece) % t.across * t.side;
    tile.y_begin = std::int32_t(piece) / t.across * t.side;
    tile.x_end = std::min(tile.x_begin + t.side, c.width);
    tile.y_end = std::min(tile.y_begin + t.side, c.height);
    return tile;
}

/// Calls draw(block) for the blocks of a tile, each with those of numbers[count] that it may see,
/// the nearest first; at most kMaxSeen.
template <class Thing, class Draw>
void draw_blocks(Span<const Thing> things, const Screen& screen, const std::uint32_t* numbers,
                 std::uint32_t count, ParticleTile tile, Scratch& s, Draw draw) {
    for (std::uint32_t i = 0; i < count; ++i)
        (void)screen.cover(things[numbers[i]], numbers[i], s.covers[i]);
    std::sort(s.covers, s.covers + count, Nearer());
    tile.seen = s.seen;
    const ParticleTile all = tile;
    for (tile.y_begin = all.y_begin; tile.y_begin < all.y_end; tile.y_begin += kBlockPixels)
        for (tile.x_begin = all.x_begin; tile.x_begin < all.x_end; tile.x_begin += kBlockPixels) {
            tile.x_end = std::min(tile.x_begin + kBlockPixels, all.x_end);
            tile.y_end = std::min(tile.y_begin + kBlockPixels, all.y_end);
            std::uint32_t seen = 0;
            for (std::uint32_t i = 0; i < count; ++i) {
                const Cover& o = s.covers[i];
                s.seen[seen] = {o.front, o.ball};
                const bool in = (o.low[0] < tile.x_end) & (o.high[0] >= tile.x_begin) &
                                (o.low[1] < tile.y_end) & (o.high[1] >= tile.y_begin);
                seen += in ? 1 : 0;
            }
            tile.count = std::int32_t(seen);
            draw(tile);
        }
}

}  // namespace

std::uint64_t view_tile_scratch_bytes() { return sizeof(Scratch); }

Status march_particles(const Context& context, const ParticleTree& tree,
                       const ParticleMarchParams& k, const ParticleMarchBuffers& buffers) {
    const CameraParams& c = k.camera;
    const Screen screen(c, tree.nodes[0]);
    Tiles tiles;
    const Span<const ParticleBall> balls = tree.balls.span();
    PILEUS_TRY(sort_things(context, balls, c, screen, tiles));
    Buffer<Scratch> scratch;
    PILEUS_TRY(scratch.resize(std::uint64_t(context.threads), "tiles of the picture"));
    const std::uint64_t floats = particle_scratch_floats(k.bins);
    Buffer<float> bins;
    PILEUS_TRY(allocate(arrays::particle_bins(std::uint64_t(context.threads), k.bins), bins));
    const auto march = context.kernels->particle_tiles;
    const DeviceTable* const device = context.kernels->device;
    ParticleTiles found;  // on a device
    const int threads = on_device(device) ? 1 : context.threads;
    parallel_for(threads, tiles.count(), [&](std::int64_t piece, int thread) {
        if (thread == 0) context.tell("march", double(piece) / double(tiles.count()));
        ParticleTileBuffers own{buffers, nullptr};
        own.march.scratch = bins.data() + std::uint64_t(thread) * floats;
        const auto draw = [&](const ParticleTile& block) {
            if (on_device(device)) return found.add(block);
            own.tiles = &block;
            march(k, own, 0, 1);
        };
        ParticleTile tile = tile_at(tiles, c, piece);
        const std::uint64_t first = tiles.begin[std::size_t(piece)];
        const std::uint64_t named = tiles.begin[std::size_t(piece) + 1] - first;
        if (named == 0 || named > kMaxSeen) {
            tile.count = named == 0 ? 0 : 1;
            return draw(tile);
        }
        draw_blocks(balls, screen, tiles.balls.data() + first, std::uint32_t(named), tile,
                    scratch[std::size_t(thread)], draw);
    });
    return on_device(device) ? launch_on_device(*device, k, buffers, found) : Status::ok();
}

Status blend_particles(const Context& context, const ParticleTree& tree,
                       const ParticleBoardParams& k, Span<ParticleBoard> given,
                       const ParticleBoardBuffers& buffers) {
    const CameraParams& c = k.camera;
    const Screen screen(c, tree.nodes[0]);
    parallel_each(context.threads, given.size, [&](std::size_t i) { screen.frame(given[i]); });
    const Span<const ParticleBoard> boards{given.data, given.size};
    Tiles tiles;
    PILEUS_TRY(sort_things(context, boards, c, screen, tiles));
    Buffer<Scratch> scratch;
    PILEUS_TRY(scratch.resize(std::uint64_t(context.threads), "tiles of the picture"));
    const auto blend = context.kernels->board_tiles;
    const DeviceTable* const device = context.kernels->device;
    const int threads = on_device(device) ? 1 : context.threads;
    std::vector<ParticleTiles> found;  // on a device, the nearest boards of each tile first
    const auto add_round = [&](std::uint64_t round, const ParticleTile& block) {
        if (found.size() <= round) found.resize(round + 1);
        found[round].add(block);
    };
    parallel_for(threads, tiles.count(), [&](std::int64_t piece, int thread) {
        if (thread == 0) context.tell("blend", double(piece) / double(tiles.count()));
        std::uint32_t* numbers = tiles.balls.data() + tiles.begin[std::size_t(piece)];
        const std::uint64_t named =
            tiles.begin[std::size_t(piece) + 1] - tiles.begin[std::size_t(piece)];
        // More than are at hand at once are sorted first and blended by and by.
        if (named > kMaxSeen)
            std::sort(numbers, numbers + named, [&](std::uint32_t a, std::uint32_t b) {
                return boards[a].distance != boards[b].distance
                           ? boards[a].distance < boards[b].distance
                           : a < b;
            });
        const ParticleTile tile = tile_at(tiles, c, piece);
        for (std::uint64_t from = 0; from < named; from += kMaxSeen)
            draw_blocks(boards, screen, numbers + from,
                        std::uint32_t(std::min<std::uint64_t>(kMaxSeen, named - from)), tile,
                        scratch[std::size_t(thread)], [&](const ParticleTile& block) {
                            if (on_device(device)) return add_round(from / kMaxSeen, block);
                            blend(k, {buffers, &block}, 0, 1);
                        });
    });
    if (!on_device(device)) return Status::ok();
    for (const ParticleTiles& round : found)
        PILEUS_TRY(launch_on_device(*device, k, buffers, boards.size, round));
    return Status::ok();
}

}  // namespace pileus
