// SPDX-License-Identifier: Apache-2.0
// See particle_volume.h. Sums are whole numbers, so that they have no order.
#include "src/io/volumes/particle_volume.h"

#include <algorithm>

#include "platform/threads.h"
#include "src/base/number_text.h"
#include "src/io/volumes/volume_file.h"

namespace pileus {
namespace {

/// Along an axis, where the scene does not say and the method shows the particles themselves.
constexpr int kShadowCells = 96;
/// Samples along each axis of a cell are at most a quarter of a radius apart. Where that would be
/// more than two, places across the particle take theirs: so many, or half a cell apart.
constexpr int kMaxSamples = 2, kMaxAcross = 6;
/// Pieces of the grid for each thread.
constexpr int kSlabs = 4;
/// Of all particles, in quanta: nothing overflows.
constexpr double kAllQuanta = 0x1p62;
/// Radius of a particle that stands for a cell, over the cell's mean edge: neighbours overlap.
constexpr double kCellRadius = 1.5;

/// Integral of a particle's extinction over kBallMass.
double mass_of(const ParticleSet& set, std::size_t i) {
    const double r = double(set.radius[i]);
    return double(set.density[i]) * r * r * r;
}

/// Places within a ball of radius 1.
struct BallPlaces {
    struct Place {
        double at[3], weight;
    };
    Place place[kMaxAcross * kMaxAcross * kMaxAcross];
    int count = 0;
    double weights = 0;

    void lay(int across) {
        for (int k = 0; k < across; ++k)
            for (int j = 0; j < across; ++j)
                for (int i = 0; i < across; ++i) {
                    const double x = (2 * i + 1.0) / across - 1, y = (2 * j + 1.0) / across - 1,
                                 z = (2 * k + 1.0) / across - 1;
                    const double left = 1 - (x * x + y * y + z * z);
                    if (!(left > 0)) continue;
                    place[count++] = {{x, y, z}, left * left};
                    weights += left * left;
                }
    }
};

/// One particle over the cells that it touches.
class Stamp {
public:
    Stamp(const std::array<int, 3>& size, const Double3& low, const double (&cell)[3])
        : size_(size), low_(low) {
        for (int a = 0; a < 3; ++a) cell_[a] = cell[a];
        least_ = std::min(cell[0], std::min(cell[1], cell[2]));
        for (int n = 0; n < kMaxAcross; ++n) places_[n].lay(n + 1);
    }

    /// Looks at a particle; false: it touches no cell of layers [begin, end) along z.
    bool place(const ParticleSet& set, std::size_t i, int begin, int end) {
        radius_ = double(set.radius[i]);
        small_ = false;
        for (int a = 2; a >= 0; --a) {
            centre_[a] = set.origin[a] + double(set.position[3 * i + std::size_t(a)]) - low_[a];
            const double at = centre_[a] / cell_[a], reach = radius_ / cell_[a];
            first_[a] = cell_at(at - reach, a);
            last_[a] = cell_at(at + reach, a);
            if (a == 2 && (last_[2] < begin || first_[2] >= end)) return false;
            const double samples = 4 * cell_[a] / radius_;
            small_ = small_ || samples > kMaxSamples;
            samples_[a] = samples > 1 ? kMaxSamples : 1;
        }
        return true;
    }
    /// Calls use(cell, weight) for the particle's places of weight.
    template <class Use>
    void over(Use use) const {
        if (small_)
            over_ball(use);
        else
            over_cells(use);
    }
    double weights() const {
        if (small_) return ball().weights;
        double sum = 0;
        over_cells([&](std::size_t, double weight) { sum += weight; });
        return sum;
    }
    std::size_t own_cell() const {
        return index(cell_at(centre_[0] / cell_[0], 0), cell_at(centre_[1] / cell_[1], 1),
                     cell_at(centre_[2] / cell_[2], 2));
    }

private:
    template <class Use>
    void over_cells(Use use) const {
        for (int z = first_[2]; z <= last_[2]; ++z)
            for (int y = first_[1]; y <= last_[1]; ++y)
                for (int x = first_[0]; x <= last_[0]; ++x) {
                    const double weight = of_cell(x, y, z, radius_);
                    if (weight > 0) use(index(x, y, z), weight);
                }
    }
    /// Places within the ball, each in whatever cell it lies.
    template <class Use>
    void over_ball(Use use) const {
        const BallPlaces& ball = this->ball();
        double over[3], at[3];
        for (int a = 0; a < 3; ++a) over[a] = radius_ / cell_[a], at[a] = centre_[a] / cell_[a];
        for (int n = 0; n < ball.count; ++n) {
            const BallPlaces::Place& p = ball.place[n];
            use(index(cell_at(at[0] + p.at[0] * over[0], 0), cell_at(at[1] + p.at[1] * over[1], 1),
                      cell_at(at[2] + p.at[2] * over[2], 2)),
                p.weight);
        }
    }
    const BallPlaces& ball() const {
        const double wanted = 4 * radius_ / least_;
        return places_[wanted < kMaxAcross - 1 ? int(wanted) : kMaxAcross - 1];
    }
    int cell_at(double place, int axis) const {
        const int most = size_[std::size_t(axis)] - 1;
        return !(place > 0) ? 0 : (place >= most ? most : int(place));
    }
    std::size_t index(int x, int y, int z) const {
        return (std::size_t(z) * std::size_t(size_[1]) + std::size_t(y)) * std::size_t(size_[0]) +
               std::size_t(x);
    }
    double of_cell(int x, int y, int z, double radius) const {
        double sum = 0;
        const double over = 1 / (radius * radius);
        for (int k = 0; k < samples_[2]; ++k)
            for (int j = 0; j < samples_[1]; ++j)
                for (int i = 0; i < samples_[0]; ++i) {
                    const double dx = (x + (i + 0.5) / samples_[0]) * cell_[0] - centre_[0];
                    const double dy = (y + (j + 0.5) / samples_[1]) * cell_[1] - centre_[1];
                    const double dz = (z + (k + 0.5) / samples_[2]) * cell_[2] - centre_[2];
                    const double left = 1 - (dx * dx + dy * dy + dz * dz) * over;
                    if (left > 0) sum += left * left;
                }
        return sum / (samples_[0] * samples_[1] * samples_[2]);
    }

    const std::array<int, 3> size_;
    Double3 low_;
    double cell_[3], least_ = 0, centre_[3] = {}, radius_ = 0;
    int first_[3] = {}, last_[3] = {}, samples_[3] = {};
    bool small_ = false;
    BallPlaces places_[kMaxAcross];
};

/// Whole numbers alone have sums without an order.
double mean_radius(const ParticleSet& set) {
    float largest = 0;
    for (const float r : set.radius.span()) largest = std::max(largest, r);
    std::uint64_t sum = 0;
    for (const float r : set.radius.span())
        sum += std::uint64_t(double(r) / double(largest) * 0x1p32);
    return double(largest) * (double(sum) / 0x1p32 / double(set.count));
}

std::array<int, 3> cells_of(const MediumSettings& medium, const MediumValues& given,
                            const ParticleSet& set) {
    if (medium.box.resolution[0] > 0) return medium.box.resolution;
    return given.shadows_only ? particle_cells(set, kShadowCells) : particle_cells(set);
}

}  // namespace

std::array<int, 3> particle_cells(const ParticleSet& set, int most) {
    if (set.count == 0) return {1, 1, 1};
    const double edge = 0.5 * mean_radius(set);
    double longest = 0;
    for (int a = 0; a < 3; ++a) longest = std::max(longest, set.high[a] - set.low[a]);
    const double cell = std::max(edge, longest / most);
    std::array<int, 3> size{1, 1, 1};
    for (int a = 0; a < 3; ++a) {
        const double cells = (set.high[a] - set.low[a]) / cell;
        const int whole = int(cells);
        size[std::size_t(a)] = std::max(1, std::min(most, whole + (whole < cells ? 1 : 0)));
    }
    return size;
}

Status grid_particles(const ParticleSet& set, const std::array<int, 3>& size, int threads,
                      Volume& volume) {
    PILEUS_TRY(check_volume_size("resolution", {size[0], size[1], size[2]}));
    volume = Volume();
    volume.size = size;
    volume.knows_bounds = true;
    volume.in_extinction = true;
    volume.bounds_m = {set.low, set.high};
    double cell[3];
    for (int a = 0; a < 3; ++a) {
        if (!(set.high[a] > set.low[a])) volume.bounds_m[1][a] = set.low[a] + 1;  // no particle
        cell[a] = (volume.bounds_m[1][a] - volume.bounds_m[0][a]) / size[std::size_t(a)];
    }
    const std::uint64_t cells =
        std::uint64_t(size[0]) * std::uint64_t(size[1]) * std::uint64_t(size[2]);
    PILEUS_TRY(volume.density.resize(cells, "density"));
    double largest = 0;
    for (std::size_t i = 0; i < set.count; ++i) largest = std::max(largest, mass_of(set, i));
    if (!(largest > 0)) return Status::ok();
    Buffer<std::int64_t> sums;
    PILEUS_TRY(sums.resize(cells, "sums of particles"));
    const double quantum = largest * double(set.count) / kAllQuanta;
    const int slabs = std::min(size[2], threads > 1 ? kSlabs * threads : 1);
    const std::size_t layer = std::size_t(size[0]) * std::size_t(size[1]);
    parallel_for(threads, slabs, [&](std::int64_t slab, int) {
        const int low = int(size[2] * slab / slabs), high = int(size[2] * (slab + 1) / slabs);
        const std::size_t first = layer * std::size_t(low), end = layer * std::size_t(high);
        const auto add = [&](std::size_t at, std::int64_t part) {
            if (at >= first && at < end) sums[at] += part;
        };
        Stamp stamp(size, set.low, cell);
        for (std::size_t i = 0; i < set.count; ++i) {
            if (!stamp.place(set, i, low, high)) continue;
            const std::int64_t all = std::int64_t(mass_of(set, i) / quantum);
            const double weights = stamp.weights();
            std::int64_t left = all;
            if (weights > 0)
                stamp.over([&](std::size_t at, double weight) {
                    const std::int64_t part = std::int64_t(double(all) * (weight / weights));
                    add(at, part);
                    left -= part;
                });
            // What rounding leaves.
            add(stamp.own_cell(), left);
        }
    });
    const double per_cell = quantum * kBallMass / (cell[0] * cell[1] * cell[2]);
    for (std::size_t i = 0; i < cells; ++i)
        volume.density[i] = float(std::min(double(sums[i]) * per_cell, 3e38));
    return Status::ok();
}

Status particles_of_grid(const std::string& name, const Volume& volume, ParticleSet& set) {
    if (!volume.knows_bounds)
        return Status::bad_input(name + ": the grid does not know its place, allowed: bounds");
    set = ParticleSet();
    for (const float v : volume.density.span()) set.count += v > 0 ? 1u : 0u;
    PILEUS_TRY(set.position.resize(3 * set.count, "particles"));
    PILEUS_TRY(set.radius.resize(set.count, "particles"));
    PILEUS_TRY(set.density.resize(set.count, "particles"));
    PILEUS_TRY(set.id.resize(set.count, "particles"));
    double cell[3], volume_m3 = 1, edges = 0;
    for (int a = 0; a < 3; ++a) {
        cell[a] = (volume.bounds_m[1][a] - volume.bounds_m[0][a]) / volume.size[std::size_t(a)];
        volume_m3 *= cell[a];
        edges += cell[a];
        set.origin[a] =
            double(std::int64_t(0.5 * volume.bounds_m[0][a] + 0.5 * volume.bounds_m[1][a]));
    }
    const float radius = float(kCellRadius * edges / 3);
    const double share = volume_m3 / (kBallMass * double(radius) * double(radius) * double(radius));
    const std::size_t nx = std::size_t(volume.size[0]), ny = std::size_t(volume.size[1]);
    std::size_t to = 0;
    for (std::size_t i = 0; i < volume.density.size(); ++i) {
        if (!(volume.density[i] > 0)) continue;
        const std::size_t at[3] = {i % nx, i / nx % ny, i / nx / ny};
        for (int a = 0; a < 3; ++a) {
            const double place = volume.bounds_m[0][a] + (double(at[a]) + 0.5) * cell[a];
            set.position[3 * to + std::size_t(a)] = float(place - set.origin[a]);
        }
        set.radius[to] = radius;
        set.density[to] = float(double(volume.density[i]) * share);
        set.id[to++] = i;
    }
    return Status::ok();
}

Status read_particle_volume(const MediumSettings& medium, const std::string& path, int threads,
                            const MediumValues& given, Volume& volume) {
    if (given.placed != nullptr)
        return grid_particles(*given.placed, cells_of(medium, given, *given.placed), threads,
                              volume);
    ParticleSet set;
    PILEUS_TRY(read_placed_particles(medium, path, set, given.particles));
    PILEUS_TRY(grid_particles(set, cells_of(medium, given, set), threads, volume));
    if (!set.colour.empty() || !set.emission.empty()) volume.plain = set.count;
    return Status::ok();
}

Status read_particle_head(const MediumSettings& medium, const std::string& path,
                          const MediumValues& given, VolumeHead& head) {
    ParticleSet set;
    PILEUS_TRY(read_placed_particles(medium, path, set, given.particles));
    head = VolumeHead();
    head.size = cells_of(medium, given, set);
    PILEUS_TRY(check_volume_size(path, {head.size[0], head.size[1], head.size[2]}));
    head.knows_bounds = true;
    head.bounds_m = {set.low, set.high};
    for (int a = 0; a < 3; ++a)
        if (!(set.high[a] > set.low[a])) head.bounds_m[1][a] = set.low[a] + 1;
    head.in_extinction = true;
    head.unpacked_bytes = set.position.bytes() + set.radius.bytes() + set.density.bytes() +
                          set.colour.bytes() + set.id.bytes() + set.velocity.bytes() +
                          set.emission.bytes();
    head.unpacked_bytes += sizeof(std::int64_t) * std::uint64_t(head.size[0]) *
                           std::uint64_t(head.size[1]) * std::uint64_t(head.size[2]);
    head.kind = "particles";
    float least = 0, most = 0;
    for (const float r : set.radius.span()) {
        if (most == 0 || r < least) least = r;
        if (r > most) most = r;
    }
    head.detail = std::to_string(set.count) + " particles, radius " +
                  number_text(double(least), 6) + " to " + number_text(double(most), 6) + " m";
    return Status::ok();
}

Status write_particle_volume(const MediumSettings&, const std::string& path, const Volume& volume) {
    ParticleSet set;
    PILEUS_TRY(particles_of_grid(path, volume, set));
    return write_particle_ply(path, set);
}

}  // namespace pileus
