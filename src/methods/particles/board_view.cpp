// SPDX-License-Identifier: Apache-2.0
// A picture of lit particles as billboards: one colour each, sorted, blended front to back.
// in: an octree, light at its balls, a camera with a lens and a shutter -> out: planes of pixels.
// Monette and Whitehead 2014, 3.5; docs/particles.md, "Billboards".
#include "platform/threads.h"
#include "src/methods/particles/particles_state.h"
#include "src/methods/particles/view_tiles.h"
#include "src/run/device_launch.h"
#include "src/run/on_device.h"

namespace pileus {
namespace {

/// Of (1 - q^2)^power: that of a ball's chords.
constexpr double kChordPower = 2.5;
/// Depth of a ball on the ray through its middle, in extinction there times radius.
constexpr double kChord = 16.0 / 15;

/// What blurs a picture.
struct BoardLens {
    double radius = 0, focus = 1;  ///< m; 0: a pinhole
    double shutter = 0;            ///< s
};

class BoardMaker {
public:
    BoardMaker(const ParticlesState& state, const BoardLens& lens)
        : tree_(state.tree), c_(state.camera), s_(state.settings), lens_(lens) {}

    ParticleBoard board(std::size_t i) const {
        const ParticleBall& ball = tree_.balls[i];
        ParticleBoard o{};
        double p[3], square = 0;
        for (int a = 0; a < 3; ++a) {
            p[a] = 0;
            for (int n = 0; n < 3; ++n)
                p[a] += axis(a)[n] * (double(ball.centre[n]) - double(c_.origin[n]));
            o.at[a] = float(p[a]);
            square += p[a] * p[a];
        }
        if (!tree_.velocity.empty() && lens_.shutter > 0)
            for (int a = 0; a < 3; ++a) {
                double way = 0;
                for (std::size_t n = 0; n < 3; ++n)
                    way += double(axis(a)[n]) * double(tree_.velocity[3 * i + n]);
                o.way[a] = float(way * lens_.shutter);
            }
        const double own = 1 / double(ball.per_radius), shown = own * s_.display_scale;
        double radius = shown, power = s_.falloff;
        if (lens_.radius > 0) {
            // A disc of this radius is spread over the outline. Their second moments add up.
            const double blur = lens_.radius * __builtin_fabs(p[2] / lens_.focus - 1);
            radius = shown + blur;
            power = radius * radius / (shown * shown / (s_.falloff + 2) + 0.5 * blur * blur) - 2;
        }
        o.power = float(power);
        o.per_square = float(1 / (radius * radius));
        // The same integral over the picture, whatever the outline.
        const double share = own * own / (radius * radius) * (power + 1) / (kChordPower + 1);
        o.whole = float(kChord * double(ball.depth) * share);
        o.per_radius = ball.per_radius;
        o.distance = float(c_.orthographic != 0 ? p[2] : __builtin_sqrt(square));
        return o;
    }

private:
    const float* axis(int a) const { return a == 0 ? c_.right : a == 1 ? c_.up : c_.forward; }

    const ParticleTree& tree_;
    const CameraParams& c_;
    const ParticlesSettings& s_;
    const BoardLens lens_;
};

BoardLens lens_of(const Scene& scene) {
    const Camera& c = scene.camera;
    BoardLens lens;
    lens.radius = scene.lens.aperture_radius_m;
    lens.shutter = scene.lens.shutter_s;
    lens.focus = scene.lens.focus_distance_m;
    if (lens.focus == 0) {
        const Double3 way = c.target_m - c.position_m;
        lens.focus = __builtin_sqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
    }
    return lens;
}

/// Balls whose colours are made at once.
constexpr std::size_t kColoursAtOnce = 4096;

}  // namespace

bool moves(const FrameView& view, const ParticlesState& state) {
    return view.scene.lens.shutter_s > 0 && !state.tree.velocity.empty();
}

Status show_boards(const Context& context, const FrameView& view, const ParticleMarchParams& march,
                   ParticlesState& state) {
    const StageClock clock(context, "blend");
    const std::size_t count = state.tree.balls.size();
    Planes& planes = state.planes;
    for (float& v : planes.transmittance.span()) v = 1;
    for (float& v : planes.colour.span()) v = 0;
    for (float& v : planes.half_depth.span()) v = __builtin_inff();
    for (float& v : planes.optical_depth.span()) v = 0;
    Buffer<ParticleBoard> boards;
    PILEUS_TRY(allocate(arrays::particle_boards(count), boards));
    const BoardMaker maker(state, lens_of(view.scene));
    const ParticleColourBuffers colours{state.shade.data(),
                                        light_from_around(state),
                                        state.seen.data(),
                                        state.tree.colour.data(),
                                        count,
                                        boards.data()};
    const std::size_t pieces = (count - 1) / kColoursAtOnce + 1;
    parallel_for(context.threads, std::int64_t(pieces), [&](std::int64_t piece, int) {
        const std::size_t begin = std::size_t(piece) * kColoursAtOnce;
        const std::size_t end = std::min(begin + kColoursAtOnce, count);
        for (std::size_t i = begin; i < end; ++i) boards[i] = maker.board(i);
        if (on_device(context.kernels->device)) return;
        context.kernels->board_colours(march, colours, std::uint32_t(begin), std::uint32_t(end));
    });
    if (on_device(context.kernels->device))
        PILEUS_TRY(
            launch_on_device(*context.kernels->device, march, colours, std::uint32_t(count)));
    const Scene& scene = view.scene;
    ParticleBoardParams k{};
    k.camera = state.camera;
    k.boards = boards.data();
    k.moving = moves(view, state) ? 1 : 0;
    k.curved = scene.lens.aperture_radius_m > 0 || state.settings.falloff != kChordPower ? 1 : 0;
    k.cut = float(state.settings.stop_below);
    const ParticleBoardBuffers b{planes.opaque_depth.data(), planes.transmittance.data(),
                                 planes.colour.data(), planes.half_depth.data(),
                                 planes.optical_depth.data()};
    return blend_particles(context, state.tree, k, boards.span(), b);
}

}  // namespace pileus
