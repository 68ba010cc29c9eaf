// SPDX-License-Identifier: Apache-2.0
// Normals of light on smooth solids: of a ball close to the ball's own, of flat ones their own.
// in: balls, plates and rays -> out: pass or fail, for all widths.
// docs/solids.md, "Smooth normals".
#include <cmath>
#include <cstring>

#include "kernels_cpu/solids/solids.h"
#include "tests/support/solid_harness.h"
#include "tests/support/widths.h"

using namespace pileus;

namespace {

SolidSettings smooth() {
    SolidSettings s;
    s.smooth = SmoothUse::kYes;
    return s;
}

struct Seen {
    bool met = false;
    Vec<float> at{}, normal{};
};

template <bool Smooth = true>
Seen look(const Solids& s, const Vec<float>& o, const Vec<float>& d) {
    const SolidHit<float> hit = hit_solids(s.view(), o, d, 3e38f, true);
    if (hit.triangle < 0) return {};
    const SolidPlace<float> p = place_on_solid<Smooth>(s.view(), o, d, hit);
    return {true, p.at, p.normal};
}

Vec<float> unit_vector(Luck& luck) {
    for (;;) {
        const Float3 p = luck.place(1);
        const Vec<float> v{p[0], p[1], p[2]};
        if (dot(v, v) < 1 && dot(v, v) > 0.01f) return normalized(v);
    }
}

bool same(const Vec<float>& a, const Vec<float>& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

/// Root mean square of the cosine towards a light less that of the ball itself.
template <bool Smooth>
double cosine_error(const Solids& s) {
    Luck luck(4);
    double sum = 0;
    int count = 0;
    for (int i = 0; i < 20000; ++i) {
        const Vec<float> from = unit_vector(luck), sun = unit_vector(luck);
        const Seen seen =
            look<Smooth>(s, {10 * from.x, 10 * from.y, 10 * from.z}, {-from.x, -from.y, -from.z});
        if (!seen.met) continue;
        // The ray goes through the middle: the ball's normal is the way back.
        const double truth = std::fmax(double(dot(from, sun)), 0.0);
        const double error = std::fmax(double(dot(seen.normal, sun)), 0.0) - truth;
        sum += error * error, ++count;
    }
    REQUIRE(count > 15000);
    return std::sqrt(sum / count);
}

template <int W>
void check_width() {
    const Solids s = make_solids(ball_mesh(6, 3), smooth());
    Luck luck(8);
    for (int i = 0; i < 64; ++i) {
        Vec<F<W>> o{}, d{};
        Vec<float> from[W], along[W];
        for (int l = 0; l < W; ++l) {
            const Float3 p = luck.place(6);
            from[l] = {p[0], p[1], p[2]}, along[l] = unit_vector(luck);
            set_lane(o.x, l, from[l].x), set_lane(o.y, l, from[l].y), set_lane(o.z, l, from[l].z);
            set_lane(d.x, l, along[l].x), set_lane(d.y, l, along[l].y);
            set_lane(d.z, l, along[l].z);
        }
        const M<W> every = iota<I<W>>() >= 0;
        const SolidHit<F<W>> hit = hit_solids(s.view(), o, d, all<F<W>>(3e38f), every);
        const SolidPlace<F<W>> place = place_on_solid(s.view(), o, d, hit);
        for (int l = 0; l < W; ++l) {
            const Seen seen = look(s, from[l], along[l]);
            CHECK(seen.met == (lane(hit.triangle, l) >= 0));
            if (!seen.met) continue;
            CHECK(same(seen.normal, {lane(place.normal.x, l), lane(place.normal.y, l),
                                     lane(place.normal.z, l)}));
        }
    }
}

}  // namespace

TEST_CASE("smooth solids: a ball is lit as a ball, five times closer than in facets") {
    const TestMesh mesh = ball_mesh(12, 3);
    const Solids s = make_solids(mesh, smooth());
    const double curved = cosine_error<true>(s), flat = cosine_error<false>(s);
    MESSAGE("error of the cosine: smooth " << curved << ", flat " << flat);
    CHECK(curved < 0.01);
    CHECK(curved < flat / 5);
}

TEST_CASE("smooth solids: unit normals that face the viewer, off the triangle's own plane") {
    const Solids s = make_solids(ball_mesh(5, 3), smooth());
    Luck luck(3);
    int met = 0;
    for (int i = 0; i < 20000; ++i) {
        const Float3 p = luck.place(5);
        const Vec<float> o{p[0], p[1], p[2]}, d = unit_vector(luck);
        const Seen seen = look(s, o, d), flat = look<false>(s, o, d);
        if (!seen.met) continue;
        ++met;
        CHECK(std::fabs(double(dot(seen.normal, seen.normal)) - 1) < 1e-5);
        CHECK(dot(seen.normal, d) < 1e-5f);
        CHECK(same(seen.at, flat.at));  // rays begin where they do on facets
    }
    CHECK(met > 2000);
}

TEST_CASE("smooth solids: a plane, an edge by itself and both sides of a plate stay as they are") {
    TestMesh mesh;
    mesh.add({0, 0, 0}, {4, 0, 0}, {4, 4, 0});
    mesh.add({0, 0, 0}, {4, 4, 0}, {0, 4, 0});
    mesh.add({9, 0, 0}, {9, 4, 0}, {9, 0, 4});
    mesh.add({20, 0, 0}, {24, 0, 0}, {20, 4, 0});  // both ways round: nothing is left of the mean
    mesh.add({20, 0, 0}, {20, 4, 0}, {24, 0, 0});
    const Solids s = make_solids(mesh, smooth());
    for (const float side : {1.0f, -1.0f}) {
        const Seen level = look(s, {2, 1, 5 * side}, {0, 0, -side});
        CHECK(same(level.normal, {level.normal.x, level.normal.y, side}));
        const Seen plate = look(s, {21, 1, 5 * side}, {0, 0, -side});
        CHECK(plate.normal.z == side);
        const Seen wall = look(s, {9 + side, 1, 1}, {-side, 0, 0});
        CHECK(wall.normal.x == side);
    }
}

TEST_CASE("smooth solids: flat ones have no normals of their own") {
    const Solids s = make_solids(ball_mesh(5, 3));
    CHECK(s.view().normals == nullptr);
    for (const SolidTriangle& t : s.triangles.span()) CHECK(t.smooth == 0);
}

TEST_CASE("smooth solids: copies in a periodic medium have the normals of the first") {
    Solids s = make_solids(ball_mesh(6, 3), smooth());
    s.period[0] = s.period[1] = 8;
    Luck luck(5);
    int met = 0;
    for (int i = 0; i < 2000; ++i) {
        const Float3 p = luck.place(2.5f);
        const Vec<float> d{0, 0, -1};
        const Seen first = look(s, {p[0], p[1], 9}, d);
        const Seen far = look(s, {p[0] + 24, p[1] - 40, 9}, d);
        if (!first.met || !far.met) continue;
        ++met;
        CHECK(dot(first.normal, far.normal) > 1 - 1e-5f);
    }
    CHECK(met > 1000);
}

TEST_CASE("smooth solids: lanes of any width") { PILEUS_EACH_WIDTH(check_width); }
