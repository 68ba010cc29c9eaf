// SPDX-License-Identifier: Apache-2.0
// See placed_particles.h.
#include "src/io/particles/placed_particles.h"

#include <cstring>

#include "src/base/file.h"
#include "src/base/fnv1a64.h"
#include "src/base/single.h"
#include "src/io/particles/particle_rows.h"
#include "src/io/particles/replicate.h"
#include "src/scene/toml/toml_tree.h"

namespace pileus {
namespace {

constexpr double kMostOfParticle = 1e12;

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
        if (!(float(radius * smallest) >= float(kLeastPositive)) ||
            !(radius <= kMostParticlePlace) || !(density <= kMostOfParticle) ||
            !(density * denser <= kMostSigma))
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
        if (!(set.low[a] >= -kMostParticlePlace && set.high[a] <= kMostParticlePlace))
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
                             ParticleSet& set, const std::function<void(double share)>& progress) {
    const ParticleSettings& s = medium.particles;
    ParticleReading reading;
    reading.progress = progress;
    reading.radius = s.radius_m / s.unit_m;
    if (s.host != nullptr) {
        PILEUS_TRY(read_host_particles(*s.host, reading, set));
        return place_particles("particles", s, set);
    }
    const std::string extension =
        medium.format.empty() ? packed_extension(path) : '.' + medium.format;
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
