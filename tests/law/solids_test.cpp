// SPDX-License-Identifier: Apache-2.0
// Rays against triangles: the tree changes no hit, closed meshes leak nowhere, all widths agree.
// in: random and hostile triangles and rays -> out: pass or fail.
// docs/solids.md, "Rays"; Woop, Benthin, Wald 2013.
#include "kernels_cpu/solids/solids.h"

#include "tests/support/solid_harness.h"
#include "tests/support/widths.h"

using namespace pileus;

namespace {

struct Hit {
    float distance = 3e38f;
    std::int32_t number = -1;

    bool operator==(const Hit& b) const {
        return bits_of_float(distance) == bits_of_float(b.distance) && number == b.number;
    }
};

/// Every triangle, one after the other.
Hit slow_hit(const Solids& s, const float (&o)[3], const float (&d)[3], float limit) {
    const SolidRay ray = solid_ray(s.view(), o, d);
    Hit best{limit, -1};
    for (const SolidTriangle& t : s.triangles.span()) {
        const float at = meets_triangle(t, ray);
        if (at < 0 || at > best.distance || (at == limit)) continue;
        if (at == best.distance && best.number >= 0 && t.number > best.number) continue;
        best = {at, t.number};
    }
    return best;
}

Hit fast_hit(const Solids& s, const float (&o)[3], const float (&d)[3], float limit) {
    Hit hit;
    const std::int32_t found = nearest_solid(s.view(), o, d, limit, hit.distance);
    hit.number = found < 0 ? -1 : s.triangles[std::size_t(found)].number;
    return hit;
}

void unit(Float3& v) {
    const float length = __builtin_sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (float& x : v) x /= length;
}

/// Triangles of all sizes, some without an area, some twice.
TestMesh soup(int count, std::uint64_t seed, float size) {
    Luck luck(seed);
    TestMesh mesh;
    for (int i = 0; i < count; ++i) {
        const Float3 a = luck.place(size);
        const float reach = size * luck.next() * luck.next() * luck.next();
        Float3 b = a, c = a;
        for (std::size_t k = 0; k < 3; ++k)
            b[k] += luck.both_ways(reach), c[k] += luck.both_ways(reach);
        if (i % 11 == 3) c = b;                                  // no area
        if (i % 13 == 5) c = {b[0], b[1], b[2] + size * 1e-6f};  // a needle
        mesh.add(a, b, c);
        if (i % 7 == 1) mesh.add(a, b, c);  // twice
    }
    return mesh;
}

void check_soup(const Solids& s, float size, int rays) {
    Luck luck(77);
    int met = 0;
    for (int i = 0; i < rays; ++i) {
        const Float3 from = luck.place(1.5f * size), to = luck.place(size);
        Float3 along{to[0] - from[0], to[1] - from[1], to[2] - from[2]};
        unit(along);
        if (i % 5 == 0) along = {0, i % 2 == 0 ? 1.0f : -1.0f, 0};  // along an axis
        const float o[3] = {from[0], from[1], from[2]}, d[3] = {along[0], along[1], along[2]};
        const float limit = i % 3 == 0 ? size : 3e38f;
        const Hit slow = slow_hit(s, o, d, limit), fast = fast_hit(s, o, d, limit);
        CHECK(slow == fast);
        CHECK(solid_between(s.view(), o, d, limit) == (slow.number >= 0));
        met += slow.number >= 0 ? 1 : 0;
    }
    CHECK(met > rays / 20);  // or the test has looked at nothing
    CHECK(met < rays);
}

template <int W>
void check_width() {
    const Solids s = make_solids(soup(200, 3, 8));
    Luck luck(5);
    for (int i = 0; i < 64; ++i) {
        Vec<F<W>> o, d;
        M<W> wanted = iota<I<W>>() != (i % W);
        F<W> limit = all<F<W>>(3e38f);
        float from[W][3], along[W][3];
        for (int l = 0; l < W; ++l) {
            const Float3 a = luck.place(10);
            Float3 b = luck.place(10);
            unit(b);
            for (std::size_t k = 0; k < 3; ++k) from[l][k] = a[k], along[l][k] = b[k];
            set_lane(o.x, l, a[0]), set_lane(o.y, l, a[1]), set_lane(o.z, l, a[2]);
            set_lane(d.x, l, b[0]), set_lane(d.y, l, b[1]), set_lane(d.z, l, b[2]);
        }
        const SolidHit<F<W>> hit = hit_solids(s.view(), o, d, limit, wanted);
        for (int l = 0; l < W; ++l) {
            float distance = 0;
            std::int32_t found = -1;
            if (l != i % W) found = nearest_solid(s.view(), from[l], along[l], 3e38f, distance);
            CHECK(lane(hit.triangle, l) == found);
            if (found >= 0) CHECK(bits_of_float(lane(hit.distance, l)) == bits_of_float(distance));
        }
    }
}

}  // namespace

TEST_CASE("solids: the tree finds what looking at every triangle finds, bit by bit") {
    const Solids s = make_solids(soup(700, 1, 100));
    CHECK(s.degenerate > 50);
    check_soup(s, 100, 4000);
}

TEST_CASE("solids: a billion metres away, and a millimetre small") {
    check_soup(make_solids(soup(300, 2, 1e9f)), 1e9f, 1500);
    check_soup(make_solids(soup(300, 4, 1e-3f)), 1e-3f, 1500);
}

TEST_CASE("solids: one place for all, and one line of places") {
    TestMesh same;
    for (int i = 0; i < 5000; ++i) same.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const Solids s = make_solids(same);
    CHECK(s.nodes.size() <= 2 * s.triangles.size());
    const float o[3] = {0.25f, 0.25f, 3}, down[3] = {0, 0, -1}, level[3] = {1, 0, 0};
    const Hit hit = fast_hit(s, o, down, 3e38f);
    CHECK(hit.distance == 3.0f);
    CHECK(hit.number == 0);
    // In the plane of all of them: nothing to see from there.
    const float beside[3] = {-1, 0.25f, 0};
    CHECK(fast_hit(s, beside, level, 3e38f).number == -1);

    // Each twice as far as the one before: halves by number, where no plane parts them well.
    TestMesh far;
    for (int i = 0; i < 1200; ++i) {
        const float x = 1e-20f * __builtin_powif(1.05f, i);
        far.add({x, 0, 0}, {x, 1, 0}, {x, 0, 1});
    }
    const Solids t = make_solids(far);
    const float before[3] = {-1, 0.25f, 0.25f};
    CHECK(fast_hit(t, before, level, 3e38f).number == 0);
    const float behind[3] = {1e9f, 0.25f, 0.25f}, back[3] = {-1, 0, 0};
    CHECK(fast_hit(t, behind, back, 3e38f).number >= 0);
}

TEST_CASE("solids: of triangles at one distance the first is hit") {
    for (bool turned : {false, true}) {
        TestMesh mesh;
        const Float3 a{0, 0, 0}, b{4, 0, 0}, c{4, 4, 0}, e{0, 4, 0};
        if (turned) mesh.add(a, c, e);
        mesh.add(a, b, c);
        if (!turned) mesh.add(a, c, e);
        const float o[3] = {2, 2, 8}, d[3] = {0, 0, -1};  // at the diagonal that both share
        CHECK(fast_hit(make_solids(mesh), o, d, 3e38f).number == 0);
    }
}

TEST_CASE("solids: no ray of a million leaves a closed ball") {
    const TestMesh mesh = ball_mesh(12, 3);
    const Solids s = make_solids(mesh);
    Luck luck(9);
    int out = 0;
    for (int i = 0; i < 1'000'000; ++i) {
        const Float3 from = luck.place(1);
        Float3 to = luck.place(3);
        // Every third at a corner, every third at an edge of the mesh.
        const std::size_t t = std::size_t(luck.next() * float(mesh.corners.size() / 9)) * 9;
        float p[9];
        for (std::size_t k = 0; k < 9; ++k) p[k] = float(mesh.corners[t + k]);
        const float along_edge = i % 3 == 1 ? 0.0f : luck.next();
        if (i % 3 != 0)
            for (std::size_t k = 0; k < 3; ++k) to[k] = p[k] + (p[3 + k] - p[k]) * along_edge;
        Float3 d{to[0] - from[0], to[1] - from[1], to[2] - from[2]};
        unit(d);
        const float o[3] = {from[0], from[1], from[2]}, dir[3] = {d[0], d[1], d[2]};
        if (!solid_between(s.view(), o, dir, 3e38f)) ++out;
    }
    CHECK(out == 0);
}

TEST_CASE("solids: lanes of any width") { PILEUS_EACH_WIDTH(check_width); }

TEST_CASE("solids: a mesh on a map is moved before it is rounded") {
    // A metre is two steps of a float at 5 400 000; taken off in doubles it stays a metre.
    TestMesh mesh;
    mesh.corners = {500000.25, 5400000.125, 0,           500001.25, 5400000.125,
                    0,         500000.25,   5400000.875, 0};
    SolidSettings settings;
    settings.position_m = {-500000, -5400000, 0};
    const Solids s = make_solids(mesh, settings);
    REQUIRE(s.triangles.size() == 1);
    const float expected[3][3] = {{0.25f, 0.125f, 0}, {1.25f, 0.125f, 0}, {0.25f, 0.875f, 0}};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t a = 0; a < 3; ++a) CHECK(s.triangles[0].corner[i][a] == expected[i][a]);
}

TEST_CASE("solids: turned about x, then y, then z; y up; scaled; placed") {
    TestMesh mesh;
    mesh.add({1, 2, 3}, {1, 3, 3}, {1, 2, 5});
    SolidSettings settings;
    settings.rotation_deg = {90, 90, 90};
    settings.scale = 2;
    settings.position_m = {100, 0, 0};
    const Solids s = make_solids(mesh, settings);
    // (1,2,3): about x -> (1,-3,2), about y -> (2,-3,-1), about z -> (3,2,-1).
    CHECK(s.triangles[0].corner[0][0] == 106.0f);
    CHECK(s.triangles[0].corner[0][1] == 4.0f);
    CHECK(s.triangles[0].corner[0][2] == -2.0f);
    settings = SolidSettings();
    settings.y_up = true;
    const Solids up = make_solids(mesh, settings);
    CHECK(up.triangles[0].corner[0][1] == -3.0f);
    CHECK(up.triangles[0].corner[0][2] == 2.0f);
}
