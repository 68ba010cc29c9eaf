// SPDX-License-Identifier: Apache-2.0
// See sky_ordinates.h.
#include "src/picture/ordinates/sky_ordinates.h"

#include <algorithm>
#include <cmath>

#include "src/picture/ordinates/ordinate_half.h"
#include "src/picture/ordinates/ordinate_medium.h"
#include "src/picture/ordinates/sky_level.h"

namespace pileus {
namespace {

constexpr double kSkyReach = 40000;  // m that the coarsest level reaches at least
constexpr int kMaxAcross = 44, kMaxHeights = 20, kMinHeights = 16;
constexpr double kDepthOfHeight = 1.5;  // of a node, before the peak counts apart

/// Light falls off with height: of flat nodes most is seen there.
constexpr std::array<int, 3> kSkyWithin{2, 2, kMaxOrdinateSamples};

/// Memory of level `l`, and of the spare one with a ring.
Status make_level(const SkyOrdinates& of, const SkyParams& sky, std::size_t l, SkyLevel& level) {
    OrdinateNodes& own = level.nodes;
    const std::uint64_t nodes = of.sizes.nodes();
    own.media = 1;
    std::copy_n(of.front.optics[0], 3, own.optics[0]);
    own.within = kSkyWithin;
    own.ring = l + 1 < std::size_t(of.sizes.levels);
    own.periodic = !own.ring && of.sizes.wraps;
    for (std::size_t a = 0; a < 2; ++a) {
        own.grid.size[a] = of.sizes.size[a];
        level.step[a] = of.sizes.step[a] * double(1 << l);
        own.grid.per_metre[a] = float(1 / level.step[a]);
    }
    own.grid.size[2] = of.sizes.size[2];
    own.grid.per_metre[2] = float(of.sizes.size[2]) / sky.height_m;
    PILEUS_TRY(
        allocate(arrays::ordinate_densities(node_count(node_samples(own.grid, own.within).fine)),
                 own.samples));
    PILEUS_TRY(allocate(arrays::ordinate_nodes(nodes, Stage::kWrite), own.density));
    const std::uint64_t filled = nodes - (own.ring ? ring_count(own.grid) : 0);
    PILEUS_TRY(allocate(arrays::ordinate_places(filled, Stage::kWrite), own.filled));
    std::vector<char> of_ring(std::size_t(nodes), 0);
    if (own.ring) each_of_ring(own.grid, [&](std::size_t, std::size_t i) { of_ring[i] = 1; });
    std::size_t n = 0;
    for (std::size_t i = 0; i < of_ring.size(); ++i)
        if (of_ring[i] == 0) own.filled[n++] = std::int32_t(i);
    return make_half(own);
}

/// Gives the spare level the place and the width of another.
void shape_spare(const SkyLevel& like, SkyLevel& spare) {
    std::copy_n(like.step, 2, spare.step);
    spare.nodes.grid = like.nodes.grid;
    spare.nodes.half.nodes.grid = like.nodes.half.nodes.grid;
}

const SkyLevel* coarser_of(const SkyOrdinates& of, std::size_t l) {
    return l + 1 < of.levels.size() ? &of.levels[l + 1] : nullptr;
}

/// Whether a level holds solutions for the picture's lights, or for lights of the same kinds.
bool holds_kinds(const SkyLevel& level, const std::vector<OrdinateSet>& lights) {
    const std::vector<OrdinateSet>& sets = level.nodes.sets;
    bool same = level.solved && sets.size() == lights.size();
    for (std::size_t s = 0; s < lights.size() && same; ++s)
        same = sets[s].channel == lights[s].channel && (sets[s].beam > 0) == (lights[s].beam > 0);
    return same;
}
bool holds_lights(const SkyLevel& level, const std::vector<OrdinateSet>& lights) {
    bool same = holds_kinds(level, lights);
    for (std::size_t s = 0; s < lights.size() && same; ++s)
        same = level.nodes.sets[s].beam == lights[s].beam &&
               level.nodes.sets[s].enters == lights[s].enters;
    return same;
}

/// What a level needs: nothing, the sun's light, or all of it at another place.
enum class Need { kNothing, kSun, kAll };
Need need_of(const SkyOrdinates& of, std::size_t l, const Lighting& lighting,
             const SkyOrdinateAsk& ask) {
    const SkyLevel& level = of.levels[l];
    const SkyLevel* coarser = coarser_of(of, l);
    if (level.low != low_of(of, l, *ask.sky, ask.camera) || !holds_lights(level, of.lights) ||
        (coarser != nullptr && level.moves_from != coarser->moves))
        return Need::kAll;
    if (level.followed || level.to_sun != lighting.to_sun ||
        (coarser != nullptr && level.made_from != coarser->made))
        return Need::kSun;
    return Need::kNothing;
}

}  // namespace

SkyOrdinateSizes sky_ordinate_sizes(const SkyParams& sky, double extinction_per_m) {
    SkyOrdinateSizes out;
    const double height = double(sky.height_m);
    if (!(height > 0)) return out;
    const double by_depth = extinction_per_m > 0 ? kDepthOfHeight / extinction_per_m : height;
    const double tall = std::max(height / kMaxHeights, std::min(height / kMinHeights, by_depth));
    out.size[2] = std::max(1, std::min(kMaxHeights, int(height / tall + 0.5)));
    out.wraps = sky.boxed == 0;
    for (int a = 0; a < 2; ++a) out.size[a] = kMaxAcross, out.step[a] = tall;
    if (out.wraps) {
        for (double reach = 0.5 * kMaxAcross * tall; reach < kSkyReach; reach *= 2)
            if (out.levels < kMaxOrdinateLevels) ++out.levels;
        return out;
    }
    double widest = 0;
    for (int a = 0; a < 2; ++a) {
        out.size[a] = std::max(
            1, std::min(kMaxAcross, int(std::ceil(double(sky.extent_m[a]) / tall - 1e-3))));
        out.step[a] = double(sky.extent_m[a]) / out.size[a];
        widest = std::max(widest, out.step[a]);
    }
    for (; widest > 1.5 * tall && out.levels < kMaxOrdinateLevels; widest *= 0.5) ++out.levels;
    for (double& step : out.step) step /= double(1 << (out.levels - 1));
    return out;
}

std::uint64_t sky_ordinate_samples(const SkyOrdinateSizes& sizes) {
    std::uint64_t samples = sizes.nodes();
    for (const int n : kSkyWithin) samples *= std::uint64_t(n);
    return samples;
}

Status prepare_sky_ordinates(const Context& context, const Medium& medium, const SkyParams& sky,
                             bool spare, SkyOrdinates& out) {
    out.sizes = sky_ordinate_sizes(sky, max_extinction(medium));
    out.levels.clear();
    out.levels.resize(std::size_t(out.sizes.levels));
    out.next = out.sizes.levels - 1;
    out.building = -1;
    out.turned = 0;
    out.pause = 0;
    PILEUS_TRY(prepare_optics(context, medium, false, out.front));
    for (std::size_t l = 0; l < out.levels.size(); ++l)
        PILEUS_TRY(make_level(out, sky, l, out.levels[l]));
    out.front.grid = out.levels.front().nodes.grid;
    out.has_spare = spare && out.levels.size() > 1;
    return out.has_spare ? make_level(out, sky, 0, out.spare) : Status::ok();
}

Status reserve_sky_ordinates(SkyOrdinates& out) {
    std::uint64_t samples = 0;
    out.lights.reserve(kMaxOrdinateSets);
    out.front.sets.reserve(kMaxOrdinateSets);
    out.front.shown.reserve(kMaxOrdinateSets);
    const auto reserve = [&](SkyLevel& level) {
        level.nodes.sets.reserve(kMaxOrdinateSets);
        PILEUS_TRY(hold(arrays::ordinate_solution(level.nodes.filled.size(), kMaxSkySets),
                        level.nodes.solution));
        samples = std::max(samples, std::uint64_t(level.nodes.samples.size()));
        return reserve_half(kMaxSkySets, level.nodes);
    };
    for (SkyLevel& level : out.levels) PILEUS_TRY(reserve(level));
    if (out.has_spare) PILEUS_TRY(reserve(out.spare));
    PILEUS_TRY(out.depths.reserve(samples, "ordinates: sunlight within nodes"));
    const std::uint64_t nodes = out.sizes.nodes();
    PILEUS_TRY(
        hold(arrays::ordinate_light(nodes * out.levels.size(), kMaxSkySets, 1), out.front.light));
    return hold(arrays::ordinate_near(nodes, kMaxSkySets, true), out.front.near);
}

namespace {

/// One picture's work on levels.
class Following {
public:
    Following(const Context& context, const Medium& medium, const Majorants& majorants,
              const Lighting& lighting, const SkyOrdinateAsk& ask, SkyOrdinates& out)
        : context_(context),
          medium_(medium),
          majorants_(majorants),
          lighting_(lighting),
          ask_(ask),
          out_(out) {}

    /// All that is needed, the coarser first.
    Status finish() {
        out_.building = -1;
        for (std::size_t l = out_.levels.size(); l-- > 0;) PILEUS_TRY(renew(l));
        return Status::ok();
    }

    /// A part of it: one light of a level that moves, or the sun's of one that stays.
    Status go_on() {
        // Lights that have become others begin anew.
        if (out_.built > 0 && !holds_lights(out_.spare, out_.lights)) out_.building = -1;
        if (out_.building >= 0) return build();
        for (std::size_t l = 0; l < out_.levels.size(); ++l) {
            if (need_of(out_, l, lighting_, ask_) != Need::kAll) continue;
            if (l + 1 == out_.levels.size() || !out_.has_spare) return renew(l);
            out_.building = int(l);
            out_.built = 0;
            shape_spare(out_.levels[l], out_.spare);
            place_level(context_, medium_, ask_, low_of(out_, l, *ask_.sky, ask_.camera),
                        out_.spare);
            return Status::ok();
        }
        // The sun reaches all levels within so many pictures, or one a picture.
        if (out_.pause > 0) {
            --out_.pause;
            return Status::ok();
        }
        for (std::size_t looked = 0; looked < out_.levels.size(); ++looked) {
            const auto l = std::size_t(out_.next);
            out_.next = out_.next == 0 ? int(out_.levels.size()) - 1 : out_.next - 1;
            if (need_of(out_, l, lighting_, ask_) != Need::kSun) continue;
            out_.pause = std::max(0, ask_.pictures / int(out_.levels.size()) - 1);
            return renew(l);
        }
        return Status::ok();
    }

private:
    Status renew(std::size_t l) {
        const Need need = need_of(out_, l, lighting_, ask_);
        if (need == Need::kNothing) return Status::ok();
        SkyLevel& level = out_.levels[l];
        if (need == Need::kAll)
            place_level(context_, medium_, ask_, low_of(out_, l, *ask_.sky, ask_.camera), level);
        // A sun that stands still again has the light that it has without following.
        const bool follows =
            ask_.pictures > 1 && need == Need::kSun && level.to_sun != lighting_.to_sun;
        PILEUS_TRY(solve(l, -1, follows ? kFollowedIterations : 0, level));
        if (need == Need::kAll) ++level.moves;
        ++level.made;
        return Status::ok();
    }

    /// The next light of the spare level, which takes its place with the last one.
    Status build() {
        const auto l = std::size_t(out_.building);
        SkyLevel& level = out_.levels[l];
        PILEUS_TRY(solve(l, out_.built, 0, out_.spare));
        if (++out_.built < int(out_.lights.size())) return Status::ok();
        out_.spare.made = level.made + 1;
        out_.spare.moves = level.moves + 1;
        std::swap(level, out_.spare);
        out_.building = -1;
        return Status::ok();
    }

    Status solve(std::size_t l, int only, int iterations, SkyLevel& level) {
        return solve_level(context_, medium_, majorants_, lighting_, ask_, coarser_of(out_, l),
                           out_.lights, only, iterations, out_.depths, level);
    }

    const Context& context_;
    const Medium& medium_;
    const Majorants& majorants_;
    const Lighting& lighting_;
    const SkyOrdinateAsk& ask_;
    SkyOrdinates& out_;
};

}  // namespace

Status follow_sky_ordinates(const Context& context, const Medium& medium,
                            const Majorants& majorants, const Lighting& lighting,
                            const SkyOrdinateAsk& ask, SkyOrdinates& out) {
    set_ordinate_lights(medium, lighting, OrdinateAsk{}, false, out.lights);
    bool whole = ask.pictures <= 1;
    for (const SkyLevel& level : out.levels) whole |= !holds_kinds(level, out.lights);
    Following following(context, medium, majorants, lighting, ask, out);
    PILEUS_TRY(whole ? following.finish() : following.go_on());
    // Colours are the picture's; of the sun at 1 or the sky there is one solution for all.
    out.front.sets.assign(out.lights.begin(), out.lights.end());
    show_each(out.front);
    set_levels_view(ask, out);
    return turn_levels(context, ask, out);
}

}  // namespace pileus
