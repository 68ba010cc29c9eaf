// SPDX-License-Identifier: Apache-2.0
// See cloud.h. Turrets beside turrets, balls upon balls: the skeleton of a heap of rising air.
// in: resolved settings -> out: balls in units of the cloud's height, generation by generation.
// docs/generators.md, "Balls"; Cotton, Bryan, van den Heever 2011, "Storm and cloud dynamics",
// ch. 7.
#include <algorithm>

#include "src/scene/media/cloud_types.h"
#include "src/world/density/cloud.h"
#include "src/world/density/draws.h"

namespace pileus {
namespace {

struct Tower {
    float x, y, height, radius, vigour;
};

constexpr double kLumpRise = 0.63;  // of lumps over the surface, in their width

float mix(float a, float b, float t) { return a + (b - a) * t; }

float gap(const CloudBall& a, const CloudBall& b) {
    const float x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
    return sqrt_(x * x + y * y + z * z);
}

class Growth {
public:
    Growth(const CloudSettings& s, CloudHeap& heap)
        : heap_(heap),
          draws_(std::uint64_t(s.seed), kCloudBallStream),
          radius_(float(s.radius_m / s.height_m)),
          slimness_(float(s.slimness)),
          turrets_(std::min(std::size_t(s.turrets), kMaxTurrets)),
          tall_(std::size_t(s.tall)),
          settings_(s) {
        const WindWay top = wind_at(s, 1);
        lean_x_ = float(s.shear) * top.x, lean_y_ = float(s.shear) * top.y;
    }

    void run() {
        place_towers();
        for (std::size_t i = 0; i < turrets_; ++i) {
            turret_ = std::uint8_t(i);
            stack(towers_[i]);
        }
        const std::size_t large = heap_.count;
        brood(0, large, {5, 8, 0.38f, 0.62f, 0.55f});
        brood(large, heap_.count, {4, 8, 0.34f, 0.60f, 0.50f});
    }

    /// After run(): it rains out of the tall turrets.
    void rain() {
        heap_.shafts =
            std::min({turrets_, std::max(tall_, std::size_t(1)), std::size_t(kMaxRainShafts)});
        for (std::size_t i = 0; i < heap_.shafts; ++i)
            heap_.shaft[i] = {towers_[i].x, towers_[i].y, 1.25f * towers_[i].radius};
    }

    /// After run(): where the balls are at the settings' age.
    void rise(const CloudSettings& s) {
        CloudFoot feet[kMaxTurrets];
        for (std::size_t i = 0; i < turrets_; ++i) feet[i] = {towers_[i].x, towers_[i].y};
        rise_turrets(s, of_ball_, feet, turrets_, heap_);
    }

private:
    void add(float x, float y, float z, float r, float vigour) {
        if (heap_.count == heap_.balls.size()) return;
        const float join = 0.05f * r;
        of_ball_[heap_.count] = turret_;
        heap_.balls[heap_.count++] = {
            x, y, z, r, std::min(std::max(vigour, 0.0f), 1.0f), join, 0.25f / join, 0};
    }

    /// The first in the middle; each next one beside an older one, as near the middle as tries
    /// find.
    void place_towers() {
        towers_[0] = {0, 0, 1, slimness_ * draws_.between(0.9f, 1.15f), draws_.between(0.8f, 1.0f)};
        for (std::size_t i = 1; i < turrets_; ++i) {
            Tower t{};
            const float low = mix(1.0f, 0.6f, float(i) / float(turrets_));
            t.height =
                i < tall_ ? draws_.between(0.72f, 0.97f) : draws_.between(0.25f, 0.75f) * low;
            t.radius = slimness_ * (0.35f + 0.65f * t.height) * draws_.between(0.8f, 1.2f);
            t.vigour = draws_.between(0.0f, 1.0f);
            place(i, t);
            towers_[i] = t;
        }
    }

    void place(std::size_t older, Tower& t) {
        constexpr int kTries = 24;
        float best = 1e9f;
        for (int k = 0; k < kTries; ++k) {
            const std::size_t at =
                std::min(std::size_t(draws_.between(0.0f, float(older))), older - 1);
            const Tower& beside = towers_[at];
            const auto turn = sincos_turns(draws_.between(0.0f, 1.0f));
            const float far = (beside.radius + t.radius) * draws_.between(0.62f, 0.95f);
            const float x = beside.x + far * turn.cosine, y = beside.y + far * turn.sine;
            // Faults: what reaches beyond the foot, and turrets within one another.
            float fault = std::max(sqrt_(x * x + y * y) + 0.8f * t.radius - radius_, 0.0f);
            for (std::size_t i = 0; i < older; ++i) {
                const float dx = x - towers_[i].x, dy = y - towers_[i].y;
                const float least = 0.6f * (towers_[i].radius + t.radius);
                fault += 2 * std::max(least - sqrt_(dx * dx + dy * dy), 0.0f);
            }
            if (!(fault < best)) continue;
            best = fault, t.x = x, t.y = y;
            if (best == 0) return;
        }
    }

    /// A column of balls, bulging at its head, strewn and leaning; low ones around its foot.
    void stack(const Tower& t) {
        const float head = std::min(t.radius * draws_.between(0.78f, 1.0f), 0.5f * t.height);
        const float foot = 0.3f * t.radius, top = std::max(t.height - head, foot);
        const int steps = std::min(2 + int(1.1f * t.height / t.radius), 24);
        for (int i = 0; i < steps; ++i) {
            const float s = float(i) / float(steps - 1);
            const float waist = 1.0f - 0.72f * s * (1.0f - s);
            const float r = mix(1.1f * t.radius, head, s) * waist;
            const float stray = i + 1 < steps && i > 0 ? 0.38f * r : 0.12f * r;
            const float z = mix(foot, top, s), drift = z * (0.4f + 0.6f * s);
            turn(double(z));
            const float x = t.x + lean_x_ * drift + draws_.between(-stray, stray);
            const float y = t.y + lean_y_ * drift + draws_.between(-stray, stray);
            add(x, y, z, r, t.vigour * mix(0.4f, 1.0f, s));
        }
        for (int i = 0; i < 2; ++i) {
            const auto turn = sincos_turns(draws_.between(0.0f, 1.0f));
            const float r = t.radius * draws_.between(0.55f, 1.0f);
            const float far = t.radius * draws_.between(0.5f, 1.1f);
            const float z = t.radius * draws_.between(0.05f, 0.35f);
            add(t.x + far * turn.cosine, t.y + far * turn.sine, z, r, 0.4f * t.vigour);
        }
    }

    /// The lean of balls at that height, where the wind turns.
    void turn(double z) {
        if (settings_.turn_deg == 0) return;
        const WindWay way = wind_at(settings_, z);
        lean_x_ = float(settings_.shear) * way.x, lean_y_ = float(settings_.shear) * way.y;
    }

    struct Brood {
        int least, most;          ///< children of a ball
        float smallest, largest;  ///< radius, share of the parent's
        float buried;             ///< depth under others' surface at which one is dropped, radii
    };

    /// Children on balls [begin, end), apart from their siblings.
    void brood(std::size_t begin, std::size_t end, const Brood& b) {
        for (std::size_t i = begin; i < end; ++i) {
            const CloudBall parent = heap_.balls[i];
            turret_ = of_ball_[i];
            const int children =
                b.least + int(draws_.between(0.0f, float(b.most - b.least) + 1.0f));
            const std::size_t first = heap_.count;
            for (int c = 0; c < children; ++c) {
                const Direction d = draw_direction(draws_, -0.3f);
                const float r = parent.r * draws_.between(b.smallest, b.largest);
                const float out = parent.r * draws_.between(0.9f, 1.08f) - 0.25f * r;
                const float vigour = parent.vigour + draws_.between(-0.25f, 0.25f);
                const CloudBall at{parent.x + d.x * out,
                                   parent.y + d.y * out,
                                   parent.z + d.z * out,
                                   r,
                                   0,
                                   0,
                                   0,
                                   0};
                if (!is_crowded(at, first) && !is_buried(at, end, i, b.buried))
                    add(at.x, at.y, at.z, r, vigour);
            }
        }
    }

    bool is_crowded(const CloudBall& at, std::size_t first) const {
        for (std::size_t i = first; i < heap_.count; ++i)
            if (gap(at, heap_.balls[i]) < 0.62f * (at.r + heap_.balls[i].r)) return true;
        return false;
    }

    bool is_buried(const CloudBall& at, std::size_t end, std::size_t parent, float share) const {
        for (std::size_t i = 0; i < end; ++i)
            if (i != parent && heap_.balls[i].r - gap(at, heap_.balls[i]) > share * at.r)
                return true;
        // Below the base there is no cloud.
        return at.z < -at.r;
    }

    CloudHeap& heap_;
    Draws draws_;
    float radius_, slimness_;
    std::size_t turrets_, tall_;
    const CloudSettings& settings_;
    float lean_x_ = 0, lean_y_ = 0;
    Tower towers_[kMaxTurrets]{};
    std::uint8_t turret_ = 0, of_ball_[kMaxCloudBalls]{};
};

/// What the balls take up, with what bends, the outline in plan and lumps add.
void measure(const CloudSettings& s, CloudHeap& heap) {
    const double side = 0.55 * s.outline * s.radius_m / s.height_m + 0.1;
    Double3 low{0, 0, -0.03 - 0.06 * s.shelf}, high{0, 0, 0};
    for (std::size_t i = 0; i < heap.count; ++i) {
        const CloudBall& b = heap.balls[i];
        const double r = double(b.r);
        low.x = std::min(low.x, double(b.x) - r), high.x = std::max(high.x, double(b.x) + r);
        low.y = std::min(low.y, double(b.y) - r), high.y = std::max(high.y, double(b.y) + r);
        high.z = std::max(high.z, double(b.z) + r);
    }
    if (s.anvil > 0) {
        const AnvilPlace a = anvil_place(s);
        const double x = double(a.x), y = double(a.y), r = 1.2 * s.anvil, lee = 0.5 * s.anvil;
        low.x = std::min(low.x, x - r + std::min(0.0, lee * double(a.wind_x)));
        low.y = std::min(low.y, y - r + std::min(0.0, lee * double(a.wind_y)));
        high.x = std::max(high.x, x + r + std::max(0.0, lee * double(a.wind_x)));
        high.y = std::max(high.y, y + r + std::max(0.0, lee * double(a.wind_y)));
    }
    // Lumps of 0.16 rise by 0.1 at most.
    const double over = 0.1 + kLumpRise * std::max(0.0, cloud_type(s.type).lump - 0.16);
    heap.extent = {low - Double3{side, side, 0}, high + Double3{side, side, over}};
}

}  // namespace

WindWay wind_at(const CloudSettings& s, double height) {
    // The cosine and sine of twice the half angle: sincos_turns takes turns in [0, 1].
    const double turns = (s.wind_deg + s.turn_deg * (1 - height)) / 360;
    const auto half = sincos_turns(float(turns - double(std::int64_t(turns)) + 1) * 0.5f);
    return {half.cosine * half.cosine - half.sine * half.sine, 2 * half.cosine * half.sine};
}

AnvilPlace anvil_place(const CloudSettings& s) {
    const WindWay wind = wind_at(s, 1);
    AnvilPlace out{};
    out.wind_x = wind.x, out.wind_y = wind.y;
    out.top = 0.94f, out.depth = 0.15f;
    out.x = float(s.shear) * out.top * out.wind_x, out.y = float(s.shear) * out.top * out.wind_y;
    return out;
}

Status grow_cloud(const CloudSettings& settings, CloudHeap& heap) {
    PILEUS_TRY(heap.balls.resize(kMaxCloudBalls, "balls of a cloud"));
    heap.count = 0;
    Growth growth(settings, heap);
    growth.run();
    growth.rain();
    // The box holds it at any age.
    measure(settings, heap);
    if (settings.lives()) growth.rise(settings);
    return Status::ok();
}

}  // namespace pileus
