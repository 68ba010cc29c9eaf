// SPDX-License-Identifier: Apache-2.0
// See replicate.h.
#include "src/io/particles/replicate.h"

#include "kernels_cpu/core/math.h"
#include "kernels_cpu/core/rng.h"
#include "src/base/fnv1a64.h"
#include "src/base/random_streams.h"
#include "src/base/single.h"

namespace pileus {
namespace {

/// A place in the ball of radius 1, as likely as a particle's extinction is large there: the first
/// three of nine numbers on the sphere of nine dimensions have the density (1 - r^2)^2.
void draw_place(const Key& key, std::uint32_t child, double (&place)[3]) {
    double number[10], square = 0;
    for (std::uint32_t pair = 0; pair < 5; ++pair) {
        const auto words = threefry<std::uint32_t>(key.k0, key.k1, child, pair);
        const double length = __builtin_sqrt(-2.0 * double(log_(uniform_open(words.a))));
        const auto turn = sincos_turns(uniform(words.b));
        number[2 * pair] = length * double(turn.cosine);
        number[2 * pair + 1] = length * double(turn.sine);
    }
    for (int n = 0; n < 9; ++n) square += number[n] * number[n];
    const double per = square > 0 ? 1 / __builtin_sqrt(square) : 0;
    for (int a = 0; a < 3; ++a) place[a] = number[a] * per;
}

Status make_room(const ParticleSet& from, std::uint64_t count, ParticleSet& to) {
    const char* const name = "particles";
    PILEUS_TRY(to.position.resize(3 * count, name));
    PILEUS_TRY(to.radius.resize(count, name));
    PILEUS_TRY(to.density.resize(count, name));
    if (!from.colour.empty()) PILEUS_TRY(to.colour.resize(3 * count, name));
    if (!from.emission.empty()) PILEUS_TRY(to.emission.resize(3 * count, name));
    if (!from.velocity.empty()) PILEUS_TRY(to.velocity.resize(3 * count, name));
    if (!from.id.empty()) PILEUS_TRY(to.id.resize(count, name));
    to.count = count;
    to.origin = from.origin;
    to.low = from.low;
    to.high = from.high;
    return Status::ok();
}

}  // namespace

std::uint64_t mark_of(const ParticleSet& set, std::size_t i) {
    Fnv1a64 mark;
    if (!set.id.empty()) {
        mark.u64(set.id[i]);
    } else {
        mark.floats({set.position.data() + 3 * i, 3});
        mark.floats({set.radius.data() + i, 1});
        if (!set.density.empty()) mark.floats({set.density.data() + i, 1});
    }
    return mark.value();
}

Status replicate_particles(const std::string& name, const ParticleSettings& s, ParticleSet& set) {
    if (s.replicate <= 1) return Status::ok();
    const std::uint64_t times = std::uint64_t(s.replicate), most = ParticleReading().most;
    if (set.count > most / times)
        return Status::limit(name + ": replicate: too many particles, " +
                             std::to_string(set.count) + " times " + std::to_string(times) +
                             ", allowed: at most " + std::to_string(most) + " in all");
    ParticleSet out;
    PILEUS_TRY(make_room(set, set.count * times, out));
    const double share = s.replicate_radius;
    // Integrals of extinction go with density times radius^3. Spread by this, children have their
    // parent's second moment.
    const double denser = 1 / (double(times) * share * share * share);
    const double spread = __builtin_sqrt(1 - share * share);
    double beyond = 0;
    std::size_t to = 0;
    for (std::size_t i = 0; i < set.count; ++i) {
        const Key key = make_key(mark_of(set, i), kReplicaStream, 0);
        const double parent = double(set.radius[i]);
        const float radius = float(share * parent);
        const double past = (spread + share - 1) * parent;
        if (past > beyond) beyond = past;
        for (std::uint32_t child = 0; child < times; ++child, ++to) {
            double place[3];
            draw_place(key, child, place);
            for (std::size_t a = 0; a < 3; ++a)
                out.position[3 * to + a] =
                    float(double(set.position[3 * i + a]) + place[a] * spread * parent);
            out.radius[to] = radius;
            out.density[to] = float(single_or_0(double(set.density[i]) * denser));
            for (std::size_t a = 0; a < 3; ++a) {
                if (!out.colour.empty()) out.colour[3 * to + a] = set.colour[3 * i + a];
                if (!out.emission.empty()) out.emission[3 * to + a] = set.emission[3 * i + a];
                if (!out.velocity.empty()) out.velocity[3 * to + a] = set.velocity[3 * i + a];
            }
            if (!out.id.empty()) out.id[to] = set.id[i] * times + child;
        }
    }
    for (int a = 0; a < 3; ++a) {
        out.low[a] -= beyond;
        out.high[a] += beyond;
    }
    set = std::move(out);
    return Status::ok();
}

}  // namespace pileus
