// SPDX-License-Identifier: Apache-2.0
// See follow_photon.h.
// in: TraceParams as the tracer launches it -> out: a list of events.
// docs/methods.md 3, "Track".
#include "lab/views/follow_photon.h"

#include "kernels_cpu/photons/trace.h"

namespace pileus {
namespace {

PathEvent fate_of(const TraceTally& t) {
    const Fates& f = t.light;
    if (f.absorbed[0] != 0) return PathEvent::kAbsorbed;
    if (f.top[0] != 0) return PathEvent::kTop;
    if (f.bottom[0] != 0) return PathEvent::kBottom;
    if (f.sides[0] != 0) return PathEvent::kSides;
    if (f.terminated[0] != 0) return PathEvent::kTerminated;
    return PathEvent::kLost;
}

template <int NC>
PathPoint point_of(const Photon<1, NC, false>& s, const TraceParams& k, PathEvent event) {
    PathPoint p;
    p.event = event;
    const float at[3] = {s.p.x, s.p.y, s.p.z}, d[3] = {s.d.x, s.d.y, s.d.z};
    for (int a = 0; a < 3; ++a) {
        p.at_m[a] = at[a] * k.grid.cell[a];
        p.direction[a] = d[a];
    }
    p.path_m = s.path;
    p.order = s.order;
    return p;
}

void keep(const PathPoint& point, std::size_t most, std::vector<PathPoint>& path) {
    if (path.size() < most || path.empty())
        path.push_back(point);
    else
        path.back() = point;
}

template <int NC>
void follow(const TraceParams& k, TraceBuffers b, std::uint32_t number, std::size_t most,
            std::vector<PathPoint>& path) {
    TraceTally tally{};
    b.tally = &tally;
    Group<1, NC, false> g = {};
    Queues<1, NC, false> queues = {};
    Photon<1, NC, false>& s = g.s;
    s.index = number;
    start_photons(s, k, true);
    keep(point_of(s, k, PathEvent::kStart), most, path);
    while (s.alive) {
        const int before = s.order;
        const std::uint32_t event = s.event;
        advance(g, k, b);
        leave(g, k, b);
        if (s.alive && !g.hits && s.event != event)
            keep(point_of(s, k, PathEvent::kGround), most, path);
        if (!g.hits) continue;
        collide(g, k, b, 0, queues);
        if (!s.alive) break;
        turn_queued(&g, k, b, queues, true);
        PathPoint p = point_of(s, k, s.order != before ? PathEvent::kScatter : PathEvent::kNull);
        p.density_bound = s.bound;
        keep(p, most, path);
    }
    keep(point_of(s, k, fate_of(tally)), most, path);
}

}  // namespace

const char* path_event_name(PathEvent event) {
    static const char* const names[] = {"start", "null",   "scatter", "absorbed", "ground",
                                        "top",   "bottom", "sides",   "lost",     "terminated"};
    return names[int(event)];
}

void follow_photon(const TraceInput& in, const Light& light, std::uint32_t number, std::size_t most,
                   std::vector<PathPoint>& path) {
    path.clear();
    TraceParams k = launch_params(in, light, 0);
    k.key = make_key(in.seed, light.stream, 0);
    k.mode = kDepositNone;
    k.ground_cells[0] = k.ground_cells[1] = 0;
    TraceBuffers b{};
    b.parts = in.medium->parts.data();
    if (k.channels == 1)
        follow<1>(k, b, number, most, path);
    else
        follow<3>(k, b, number, most, path);
}

}  // namespace pileus
