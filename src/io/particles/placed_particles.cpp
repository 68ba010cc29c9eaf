// SPDX-License-Identifier: Apache-2.0
// See placed_particles.h.
#include "src/io/particles/placed_particles.h"

#include <cstring>

#include "kernels_cpu/core/math.h"
#include "kernels_cpu/core/rng.h"
#include "src/base/file.h"
#include "src/base/fnv1a64.h"
#include "src/base/number_text.h"
#include "src/base/random_streams.h"
#include "src/base/single.h"
#include "src/io/particles/particle_rows.h"
#include "src/scene/toml/toml_tree.h"

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

/// The same number for a particle wherever it stands in its file.
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

/// More particles than a file has: puts s.replicate children of the same mass in all in place of
/// each particle, by its id or its own numbers, wherever it stands in `set`. Monette and Whitehead
/// 2014, 5.4. kLimit: more than all readers allow, or out of memory.
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

constexpr double kMaxOfParticle = 1e12;

void move(ParticleSet& set, std::size_t from, std::size_t to) {
    for (std::size_t a = 0; a < 3; ++a) set.position[3 * to + a] = set.position[3 * from + a];
    set.radius[to] = set.radius[from];
    set.density[to] = set.density[from];
    for (Buffer<float>* vectors : {&set.colour, &set.emission, &set.velocity})
        for (std::size_t a = 0; a < 3 && !vectors->empty(); ++a)
            (*vectors)[3 * to + a] = (*vectors)[3 * from + a];
    if (!set.id.empty()) set.id[to] = set.id[from];
}

/// Drops particles by lot.
void thin(double share, ParticleSet& set) {
    const std::uint64_t below = std::uint64_t(share * 0x1p32);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < set.count; ++i)
        if (lot_of(mark_of(set, i)) < below) move(set, i, kept++);
    set.count = kept;
    set.position.truncate(3 * kept);
    set.radius.truncate(kept);
    set.density.truncate(kept);
    for (Buffer<float>* vectors : {&set.colour, &set.emission, &set.velocity})
        if (!vectors->empty()) vectors->truncate(3 * kept);
    if (!set.id.empty()) set.id.truncate(kept);
}

template <class T>
const unsigned char* at(const T* first, std::uint64_t i, std::size_t stride) {
    return reinterpret_cast<const unsigned char*>(first) + i * stride;
}
template <class T>
T one(const T* first, std::uint64_t i, std::size_t stride) {
    T value;
    std::memcpy(&value, at(first, i, stride), sizeof value);
    return value;
}

}  // namespace

Status place_particles(const std::string& name, const ParticleSettings& s, ParticleSet& set) {
    if (set.density.empty()) {
        PILEUS_TRY(set.density.resize(set.count, "particles"));
        for (float& v : set.density.span()) v = 1.0f;
    }
    // Of what stands for each.
    const bool parts = s.replicate > 1;
    const double smallest = parts ? s.replicate_radius : 1;
    const double denser = parts ? 1 / (double(s.replicate) * smallest * smallest * smallest) : 1;
    double largest = 0;
    for (std::size_t i = 0; i < set.count; ++i) {
        const double own = double(set.radius[i]) * s.unit_m;
        const double radius = own * s.radius_scale;
        if (radius - own > largest) largest = radius - own;
        double density = double(set.density[i]) / s.share;
        if (s.cross_section) density /= kBallMass * radius * radius * radius;
        if (!(float(radius * smallest) >= float(kMinPositive)) || !(radius <= kMaxParticlePlace) ||
            !(density <= kMaxOfParticle) || !(density * denser <= kMaxSigma))
            return Status::bad_input(
                name + ": particle " + std::to_string(i) + ": radius or extinction out of range, " +
                number_text(radius * smallest) + " m and " + number_text(density * denser) +
                " per m, allowed: 1e-9 to 1e12 m, up to 1e12 per m");
        set.radius[i] = float(radius);
        set.density[i] = float(single_or_0(density));
    }
    for (int a = 0; a < 3; ++a) {
        set.origin[a] *= s.unit_m;
        set.low[a] = set.low[a] * s.unit_m - largest;
        set.high[a] = set.high[a] * s.unit_m + largest;
        if (!(set.low[a] >= -kMaxParticlePlace && set.high[a] <= kMaxParticlePlace))
            return Status::bad_input(
                name + ": particles: too far out, " + std::to_string(set.low[a]) + " to " +
                std::to_string(set.high[a]) + " m, allowed: within -1e12 to 1e12 m");
    }
    const float unit = float(s.unit_m);
    if (unit != 1.0f) {
        for (float& v : set.position.span()) v *= unit;
        for (float& v : set.velocity.span()) v *= unit;
    }
    if (s.share < 1) thin(s.share, set);
    return replicate_particles(name, s, set);
}

Status read_host_particles(const HostParticles& host, const ParticleReading& reading,
                           ParticleSet& set) {
    set = ParticleSet();
    const std::string name = "particles";
    std::vector<ParticleColumn> columns = {{"x"}, {"y"}, {"z"}};
    if (host.radius != nullptr) columns.push_back({"radius"});
    if (host.density != nullptr) columns.push_back({"density"});
    if (host.id != nullptr) columns.push_back({"id"});
    const auto name_three = [&](const float* first, std::initializer_list<const char*> names) {
        for (const char* own : names)
            if (first != nullptr) columns.push_back({own});
    };
    name_three(host.velocity, {"vx", "vy", "vz"});
    name_three(host.colour, {"red", "green", "blue"});
    name_three(host.emission, {"emission_red", "emission_green", "emission_blue"});
    ParticleRows rows(name, set);
    PILEUS_TRY(rows.begin(columns, host.count, reading));
    double row[15];
    const Span<const double> numbers{row, columns.size()};
    const auto look = [&](std::uint64_t i) {
        std::size_t to = 0;
        const auto three = [&](const float* first, std::size_t stride) {
            float own[3];
            std::memcpy(own, at(first, i, stride), sizeof own);
            for (const float v : own) row[to++] = double(v);
        };
        three(host.position, host.position_stride);
        if (host.radius != nullptr) row[to++] = double(one(host.radius, i, host.radius_stride));
        if (host.density != nullptr) row[to++] = double(one(host.density, i, host.density_stride));
        if (host.id != nullptr) row[to++] = double(one(host.id, i, host.id_stride));
        if (host.velocity != nullptr) three(host.velocity, host.velocity_stride);
        if (host.colour != nullptr) three(host.colour, host.colour_stride);
        if (host.emission != nullptr) three(host.emission, host.emission_stride);
    };
    for (std::uint64_t i = 0; i < host.count; ++i) {
        look(i);
        PILEUS_TRY(rows.measure(i, numbers));
    }
    rows.measured();
    for (std::uint64_t i = 0; i < host.count; ++i) {
        look(i);
        PILEUS_TRY(rows.keep(i, numbers));
    }
    return Status::ok();
}

Status read_placed_particles(const MediumSettings& medium, const std::string& path,
                             ParticleSet& set, const HostParticles* host,
                             const std::function<void(double share)>& progress) {
    const ParticleSettings& s = medium.particles;
    ParticleReading reading;
    reading.progress = progress;
    reading.radius = s.radius_m / s.unit_m;
    if (host != nullptr) {
        PILEUS_TRY(read_host_particles(*host, reading, set));
        return place_particles("particles", s, set);
    }
    const std::string extension =
        medium.source.format.empty() ? packed_extension(path) : '.' + medium.source.format;
    PILEUS_TRY(read_particles(path, extension, reading, set));
    return place_particles(path, s, set);
}

void turn_particles_y_up(ParticleSet& set) {
    // (x, y, z) -> (x, -z, y)
    const auto turn = [](Buffer<float>& vectors) {
        for (std::size_t i = 0; i + 2 < vectors.size(); i += 3) {
            const float y = vectors[i + 1];
            vectors[i + 1] = -vectors[i + 2];
            vectors[i + 2] = y;
        }
    };
    turn(set.position);
    turn(set.velocity);
    set.origin = {set.origin[0], -set.origin[2], set.origin[1]};
    const Double3 low = set.low, high = set.high;
    set.low = {low[0], -high[2], low[1]};
    set.high = {high[0], -low[2], high[1]};
}

}  // namespace pileus
