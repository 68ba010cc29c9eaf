// SPDX-License-Identifier: Apache-2.0
// Draws the ways of photons: the light's colour until the first scattering, then one of their own.
// in: a view with its majorants -> out: lines and dots over a veil of the cloud.
// docs/how-it-works.md
#include "lab/views/colours.h"
#include "lab/views/follow_photon.h"
#include "lab/views/views_draw.h"

namespace pileus {
namespace {

constexpr Float3 kSunlight{1.0f, 0.82f, 0.4f};
constexpr std::uint64_t kMaxFollowed = 4000, kShownPhotons = 40, kBrightScatterings = 20;
constexpr std::size_t kMaxPoints = 4096;  // of a path
constexpr double kTail = 0.12;            // of the box's diagonal, drawn before and after the box

/// A stretch of a path; nothing where the camera sees none of it.
void add_stretch(const Drawing& d, const float (&from)[3], const float (&to)[3], const Line& look,
                 std::vector<Line>& lines) {
    const double a[3] = {double(from[0]), double(from[1]), double(from[2])};
    const double b[3] = {double(to[0]), double(to[1]), double(to[2])};
    Line line = look;
    if (project_line(d.camera, a, b, line)) lines.push_back(line);
}

bool leaves_box(PathEvent event) {
    return event == PathEvent::kTop || event == PathEvent::kBottom || event == PathEvent::kSides;
}

/// Where the stretch from one point to the next ends: there, or beyond a periodic box's face where
/// the photon went on in the next period.
void stretch_end(const Drawing& d, const PathPoint& from, const PathPoint& to, float* end) {
    const float metres = to.path_m - from.path_m;
    for (int a = 0; a < 3; ++a)
        end[a] =
            d.world().medium.grid.periodic ? from.at_m[a] + metres * from.direction[a] : to.at_m[a];
}

/// A path from before the box to after it, and a dot for each scattering.
void add_path(const Drawing& d, const std::vector<PathPoint>& path, const Float3& colour,
              const Line& light, std::vector<Line>& lines, std::vector<Disc>& dots) {
    double diagonal = 0;
    for (double e : d.world().medium.extent_m) diagonal += e * e;
    const float tail = float(kTail * __builtin_sqrt(diagonal));
    float before[3], after[3];
    for (int a = 0; a < 3; ++a) {
        before[a] = path.front().at_m[a] - tail * path.front().direction[a];
        after[a] = path.back().at_m[a] + tail * path.back().direction[a];
    }
    // Until its first scattering a photon has the light's colour, then one of its own.
    Line look = light;
    add_stretch(d, before, path.front().at_m, look, lines);
    for (std::size_t i = 1; i < path.size(); ++i) {
        if (path[i - 1].order > 0) look.colour = colour;
        if (path[i].event != PathEvent::kGround) {
            float end[3];
            stretch_end(d, path[i - 1], path[i], end);
            add_stretch(d, path[i - 1].at_m, end, look, lines);
        }
        if (path[i].event != PathEvent::kScatter) continue;
        const double at[3] = {double(path[i].at_m[0]), double(path[i].at_m[1]),
                              double(path[i].at_m[2])};
        const Projected p = project_point(d.camera, at);
        const float radius = 1.4f * look.width;
        if (p.visible) dots.push_back({p.x, p.y, p.depth, radius, look.alpha, colour, false});
    }
    if (leaves_box(path.back().event)) add_stretch(d, path.back().at_m, after, look, lines);
}

struct Paths {
    std::vector<Line> lines, bright;
    std::vector<Disc> dots, bright_dots;
    std::uint64_t followed = 0, drawn = 0, scatterings = 0;
    std::uint64_t bright_number = 0, bright_scatterings = 0;
};

/// Follows photons of the first light until enough have scattered; the first that scattered ten
/// times is drawn over the others, in white.
void follow_some(const Drawing& d, Paths& out) {
    const TraceInput in = d.of.trace_input(d.context, d.view);
    const Line thin{0, 0, 0, 0, 0, d.pixels(1.2), 0.55f, kSunlight};
    const Line wide{0, 0, 0, 0, 0, d.pixels(2.4), 1.0f, kSunlight};
    std::vector<PathPoint> path;
    while (out.followed < kMaxFollowed && out.drawn < kShownPhotons) {
        const std::uint32_t number = std::uint32_t(out.followed++);
        follow_photon(in, d.state().lights.lighting.lights.front(), number, kMaxPoints, path);
        std::uint64_t scatterings = 0;
        for (const PathPoint& p : path) scatterings += p.event == PathEvent::kScatter ? 1 : 0;
        if (scatterings == 0) continue;
        ++out.drawn;
        out.scatterings += scatterings;
        if (scatterings < kBrightScatterings || out.bright_scatterings > 0) {
            add_path(d, path, name_colour(number), thin, out.lines, out.dots);
            continue;
        }
        out.bright_number = number;
        out.bright_scatterings = scatterings;
        add_path(d, path, {1, 1, 1}, wide, out.bright, out.bright_dots);
    }
}

}  // namespace

Status draw_photons(Drawing& d) {
    PILEUS_TRY(draw_veil(d));
    Paths paths;
    if (!d.state().lights.lighting.lights.empty()) follow_some(d, paths);
    for (auto* lines : {&paths.lines, &paths.bright}) {
        const Span<Line> all{lines->data(), lines->size()};
        sort_by_depth(all);
        draw_lines(all, d.context.threads, d.canvas);
        std::vector<Disc>& dots = lines == &paths.lines ? paths.dots : paths.bright_dots;
        const Span<Disc> marks{dots.data(), dots.size()};
        sort_by_depth(marks);
        draw_discs(marks, d.context.threads, d.canvas);
    }
    d.counters.emplace_back("photons_followed", paths.followed);
    d.counters.emplace_back("photons_drawn", paths.drawn);
    d.counters.emplace_back("scatterings_drawn", paths.scatterings);
    d.counters.emplace_back("bright_photon", paths.bright_number);
    d.counters.emplace_back("bright_photon_scatterings", paths.bright_scatterings);
    return Status::ok();
}

}  // namespace pileus
