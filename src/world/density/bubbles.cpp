// SPDX-License-Identifier: Apache-2.0
// See cumulus.h. Turrets rise from one base, lean with the wind, carry bubbles that carry buds.
// in: a seed -> out: spheres, generation by generation.
// Cotton, Bryan, van den Heever 2011, "Storm and cloud dynamics", ch. 7.
#include "src/world/density/cumulus.h"
#include "src/world/density/draws.h"

namespace pileus {
namespace {

/// How far a point lies under the surface of the first `count` spheres; negative outside.
float depth_within(const BubbleList& list, std::size_t count, const Bubble& at) {
    float depth = -1e9f;
    for (std::size_t i = 0; i < count; ++i) {
        const Bubble& b = list.bubbles[i];
        const float dx = at.x - b.x, dy = at.y - b.y, dz = at.z - b.z;
        depth = max_(depth, b.r - sqrt_(dx * dx + dy * dy + dz * dz));
    }
    return depth;
}

struct Turret {
    float x, y;            ///< foot
    float height, radius;  ///< top, half width of the foot
    float lean_x, lean_y;  ///< drift of the top
};

/// A column of large spheres: wide foot, waist, bulging head.
void grow_turret(Draws& draws, const Turret& t, BubbleList& list) {
    const float head = min_(t.radius * draws.between(0.74f, 0.98f), t.height * 0.55f);
    const float top = t.height - head, foot = 0.3f * t.radius;
    const int steps = 2 + int(1.5f * t.height / t.radius);
    for (int i = 0; i <= steps; ++i) {
        const float s = float(i) / float(steps);
        const float waist = 1.0f - 0.7f * s * (1.0f - s);
        const float r = (t.radius * (1.0f - s) + head * s) * waist * draws.between(0.85f, 1.1f);
        const float drift = s * (0.4f + 0.6f * s);
        const float stray = s > 0.0f && i < steps ? 0.4f * r : 0.1f * r;
        const float x = t.x + t.lean_x * drift + draws.between(-stray, stray);
        const float y = t.y + t.lean_y * drift + draws.between(-stray, stray);
        list.add({x, y, foot + max_(top - foot, 0.0f) * s, i == steps ? head : r});
    }
}

/// The cloud's plan: a row of feet on the base plane, its half length and half width, the wind.
struct Plan {
    int turrets, tallest;
    float row_x, row_y;    ///< unit vector along the row
    float wind_x, wind_y;  ///< drift at height 1
    float reach, breadth;
    float stretch_x, stretch_y;
};

Plan draw_plan(Draws& draws, float stretch_x, float stretch_y) {
    Plan p{};
    p.turrets = 1 + int(draws.between(0.0f, 4.0f));
    p.tallest = int(draws.between(0.0f, float(p.turrets)));
    const auto row = sincos_turns(draws.between(0.0f, 1.0f));
    const auto wind = sincos_turns(draws.between(0.0f, 1.0f));
    const float lean = draws.between(0.05f, 0.32f);
    p.row_x = row.cosine, p.row_y = row.sine;
    p.wind_x = wind.cosine * lean, p.wind_y = wind.sine * lean;
    p.reach = 0.40f + 0.06f * float(p.turrets) * draws.between(0.7f, 1.2f);
    p.breadth = draws.between(0.34f, 0.46f);
    p.stretch_x = stretch_x, p.stretch_y = stretch_y;
    return p;
}

/// A turret whose foot lies at (along, across) in the plan, as shares of its half axes.
Turret place_turret(Draws& draws, const Plan& p, float along, float across, float height,
                    float radius) {
    const float u = along * p.reach, v = across * p.breadth;
    Turret t{};
    t.x = p.stretch_x * (p.row_x * u - p.row_y * v);
    t.y = p.stretch_y * (p.row_y * u + p.row_x * v);
    t.height = height;
    t.radius = radius;
    t.lean_x = height * (p.wind_x + draws.between(-0.08f, 0.08f));
    t.lean_y = height * (p.wind_y + draws.between(-0.08f, 0.08f));
    return t;
}

/// One to four tall turrets in a row, a crowd of lower ones around, all on one base.
void grow_turrets(Draws& draws, const Plan& p, BubbleList& list) {
    for (int i = 0; i < p.turrets; ++i) {
        const float middle = 0.5f * float(p.turrets - 1);
        const float along = p.turrets == 1 ? 0.0f : 0.62f * (float(i) - middle) / middle;
        const float across = draws.between(-0.35f, 0.35f);
        const float height = i == p.tallest ? 1.0f : draws.between(0.50f, 0.90f);
        const float share = p.turrets == 1 ? 0.30f : 0.25f;
        const float radius = 0.05f + height * share * draws.between(0.85f, 1.1f);
        grow_turret(draws, place_turret(draws, p, along, across, height, radius), list);
    }
    // Let the crowd get lower towards the rim, so that the heap thins out to all sides.
    const int crowd = 11 + int(draws.between(0.0f, 6.0f));
    for (int i = 0; i < crowd; ++i) {
        const auto turn = sincos_turns((float(i) + draws.between(0.0f, 0.9f)) / float(crowd));
        const float out = sqrt_(draws.between(0.15f, 0.95f));
        const float height = (0.56f - 0.32f * out * out) * draws.between(0.4f, 1.45f);
        const float radius = 0.06f + height * draws.between(0.25f, 0.38f);
        const Turret t = place_turret(draws, p, turn.cosine * out, turn.sine * out, height, radius);
        grow_turret(draws, t, list);
    }
}

struct Brood {
    int least, most;          ///< children per sphere
    float smallest, largest;  ///< radius, share of the parent's
    float lowest;             ///< lowest direction, sine of elevation
};

/// Puts children on the outer face of spheres [begin, end); buried ones are dropped.
void grow_brood(Draws& draws, std::size_t begin, std::size_t end, const Brood& brood,
                BubbleList& list) {
    for (std::size_t i = begin; i < end; ++i) {
        const Bubble parent = list.bubbles[i];
        const int children = int(draws.between(float(brood.least), float(brood.most) + 1.0f));
        for (int c = 0; c < children; ++c) {
            const Direction d = draw_direction(draws, brood.lowest);
            const float u = draws.between(0.0f, 1.0f);
            const float share = brood.smallest + (brood.largest - brood.smallest) * u * u;
            const float r = parent.r * share;
            const float out = parent.r * draws.between(0.92f, 1.04f) - 0.25f * r;
            const Bubble b{parent.x + d.x * out, parent.y + d.y * out, parent.z + d.z * out, r};
            const bool below = b.z < -0.3f * r;
            if (!below && depth_within(list, end, b) < 0.8f * r) list.add(b);
        }
    }
}

/// Scales and shifts the cloud into its limits; the base plane stays at 0.
void fit(float half_x, float half_y, float height, BubbleList& list) {
    float x0 = 1e9f, x1 = -1e9f, y0 = 1e9f, y1 = -1e9f, z1 = 0.0f;
    for (std::size_t i = 0; i < list.count; ++i) {
        const Bubble& b = list.bubbles[i];
        x0 = min_(x0, b.x - b.r), x1 = max_(x1, b.x + b.r);
        y0 = min_(y0, b.y - b.r), y1 = max_(y1, b.y + b.r);
        z1 = max_(z1, b.z + b.r);
    }
    const float wide = min_(2.0f * half_x / (x1 - x0), 2.0f * half_y / (y1 - y0));
    const float scale = min_(wide, height / z1);
    const float mx = 0.5f * (x0 + x1), my = 0.5f * (y0 + y1);
    for (std::size_t i = 0; i < list.count; ++i) {
        Bubble& b = list.bubbles[i];
        b = {(b.x - mx) * scale, (b.y - my) * scale, b.z * scale, b.r * scale};
    }
    list.top = z1 * scale;
}

}  // namespace

Status grow_bubbles(std::uint64_t seed, float half_x, float half_y, float height,
                    BubbleList& list) {
    PILEUS_TRY(list.bubbles.resize(kMaxBubbles, "cumulus bubbles"));
    list.count = 0;
    Draws draws(seed, kBubbleStream);
    // Spread the feet with the box, so that an elongated box holds an elongated cloud.
    const float mean = 0.5f * (half_x + half_y);
    grow_turrets(draws, draw_plan(draws, half_x / mean, half_y / mean), list);
    const std::size_t large = list.count;
    grow_brood(draws, 0, large, {12, 18, 0.30f, 0.66f, -0.35f}, list);
    const std::size_t middle = list.count;
    grow_brood(draws, large, middle, {12, 20, 0.26f, 0.58f, -0.45f}, list);
    fit(half_x, half_y, height, list);
    return Status::ok();
}

}  // namespace pileus
