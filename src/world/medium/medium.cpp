// SPDX-License-Identifier: Apache-2.0
// See medium.h.
#include "src/world/medium/medium.h"

#include <algorithm>
#include <cstring>
#include <string_view>

#include "kernels_cpu/core/profile.h"
#include "src/base/file.h"
#include "src/base/number_text.h"
#include "src/base/single.h"
#include "src/io/volumes/particle_volume.h"
#include "src/io/volumes/volume_file.h"
#include "src/io/volumes/weather_file.h"
#include "src/scene/read_scene.h"
#include "src/scene/rows/density_row.h"
#include "src/scene/rows/volume_format.h"
#include "src/scene/toml/toml_tree.h"
#include "src/world/medium/detail.h"
#include "src/world/phase/medium_phase.h"

namespace pileus {
namespace {

/// As of particles; what knows its place may lie farther out than keys can say.
constexpr double kMaxPlace = 1e12;

std::string density_key(const Scene& scene, const MediumSettings& settings) {
    return medium_key(scene, settings) + ".density";
}

/// Cells of a density that the program makes.
std::array<int, 3> made_size(const MediumSettings& settings, const DensityOutline& outline) {
    return settings.box.resolution[0] > 0 ? settings.box.resolution : outline.size;
}

/// Cells that a host has in memory.
Status copy_cells(const MediumValues& given, Volume& volume) {
    volume.size = given.size;
    std::uint64_t cells = 1;
    for (const int n : given.size) cells *= std::uint64_t(n);
    PILEUS_TRY(volume.density.resize(cells, "density"));
    std::memcpy(volume.density.data(), given.cells, std::size_t(cells) * sizeof(float));
    return Status::ok();
}

Status load_density(const Scene& scene, const MediumSettings& settings, int threads,
                    const KernelTable* kernels, SkyField* sky, const MediumValues& given,
                    Volume& volume) {
    if (given.cells != nullptr) return copy_cells(given, volume);
    if (const DensityRow* row = density_row(settings.density)) {
        const std::array<int, 3> size = made_size(settings, row->outline(settings));
        return row->make(settings, {size, threads, kernels, sky, scene.world.wind_s}, volume);
    }
    const std::string path = density_path(scene, settings);
    const bool particles = is_particle_format(settings.source.format);
    PILEUS_TRY(at_key(scene, density_key(scene, settings),
                      particles ? read_particle_volume(settings, path, threads, given, volume)
                                : read_volume(settings, path, volume, given.weather)));
    if (settings.source.y_up) PILEUS_TRY(permute_y_up(volume));
    return Status::ok();
}

/// Divides extinctions by the largest, so that densities end at exactly 1 and sigma is the largest
/// extinction; dark volumes stay as they are.
void set_peak_to_one(double scale, Medium& medium) {
    medium.sigma = float(std::min(scale * double(medium.density_max), 3e38));
    medium.volume.in_extinction = false;
    if (!(medium.density_max > 0)) return;
    for (float& value : medium.volume.density.span())
        value = single_or_0(value / medium.density_max);
    medium.density_max = 1;
}

/// Largest density; what a float cannot tell from 0 is 0.
float hold_densities(Volume& volume) {
    float most = 0;
    for (float& density : volume.density.span()) {
        density = single_or_0(density);
        if (density > most) most = density;
    }
    return most;
}

/// The two corners of a medium's box as floats must tell them apart.
Status check_box(const std::array<Double3, 2>& bounds_m) {
    for (std::size_t a = 0; a < 3; ++a) {
        const double low = bounds_m[0][int(a)], high = bounds_m[1][int(a)];
        const double least = least_width(low, high);
        if (high - low >= least && low >= -kMaxPlace && high <= kMaxPlace) continue;
        return Status::bad_input(std::string("a box along ") + "xyz"[a] + " from " +
                                 number_text(low) + " to " + number_text(high) +
                                 " m, allowed: at least " + number_text(least) +
                                 " m wide there, within 1e12 m of 0");
    }
    return Status::ok();
}

/// Everything about a medium but its values.
Status place_medium(const Scene& scene, const MediumSettings& settings, const VolumeHead& head,
                    Medium& out) {
    if (!settings.box.has_bounds && !head.knows_bounds)
        return Status::bad_input(scene.file + ": " + medium_key(scene, settings) +
                                 ".bounds_m: left out, and the file \"" + settings.source.file +
                                 "\" does not know its place");
    const auto& bounds = settings.box.has_bounds ? settings.box.bounds_m : head.bounds_m;
    const std::string box_key = settings.box.has_bounds ? ".bounds_m" : ".density";
    PILEUS_TRY(at_key(scene, medium_key(scene, settings) + box_key, check_box(bounds)));
    out.low_m = bounds[0];
    out.grid.periodic = settings.box.periodic;
    out.grid.constant = settings.box.constant;
    for (std::size_t a = 0; a < 3; ++a) {
        out.extent_m[a] = bounds[1][a] - bounds[0][a];
        out.grid.size[a] = head.size[a];
        out.grid.cell_m[a] = float(out.extent_m[a] / head.size[a]);
    }
    // A file's extinction is known only from its values; until then any but none stands for it.
    const DensityRow* row = density_row(settings.density);
    const bool scaled = row != nullptr && row->factor != nullptr;
    const double per_m = settings.optics.extinction_per_m * (scaled ? row->factor(settings) : 1);
    out.sigma = float(head.in_extinction ? settings.optics.extinction_scale : per_m);
    Optics& optics = out.optics[0];
    optics.albedo_max = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        optics.albedo[c] = settings.optics.albedo[c];
        if (optics.albedo[c] > optics.albedo_max) optics.albedo_max = optics.albedo[c];
        // Both keys belong to the same density: the values' own unit, or 1.
        const double unit = head.in_extinction ? settings.optics.extinction_scale
                                               : settings.optics.extinction_per_m;
        optics.emission[c] = unit > 0 ? float(double(settings.optics.emission[c]) / unit) : 0;
    }
    const bool grey = settings.optics.albedo[0] == settings.optics.albedo[1] &&
                      settings.optics.albedo[1] == settings.optics.albedo[2];
    out.channels = grey ? 1 : 3;
    PhaseStore store;
    PILEUS_TRY(at_key(scene, medium_key(scene, settings) + ".phase.file",
                      load_phase(scene.directory, settings.optics.phase, store, optics.phase)));
    out.phases.clear();
    if (!store.table.empty()) out.phases.push_back(std::move(store));
    return Status::ok();
}

/// Size, mean and work of a density that the program makes.
void outline_shape(const DensityRow& row, const MediumSettings& settings, VolumeHead& head,
                   MediumSource& source) {
    const DensityOutline outline = row.outline(settings);
    head.size = made_size(settings, outline);
    source.mean_density = outline.mean;
    if (row.working != nullptr)
        source.making = {{row.working, outline.bytes, outline.thread_bytes}};
}

/// Checks the file's length, and the size where the scene states it, before the file's own head.
Status outline_file(const Scene& scene, const MediumSettings& settings, const Limits& limits,
                    const MediumValues& given, VolumeHead& head, MediumSource& source) {
    const std::string path = density_path(scene, settings);
    const bool particles = is_particle_format(settings.source.format);
    const auto read_head = [&] {
        return particles ? read_particle_head(settings, path, given, head)
                         : read_volume_head(settings, path, head, given.weather);
    };
    if (given.particles != nullptr) {
        PILEUS_TRY(at_key(scene, density_key(scene, settings), read_head()));
        source.reading_bytes = head.unpacked_bytes;
        if (settings.source.y_up) turn_y_up(head.size, head.bounds_m);
        return Status::ok();
    }
    const bool raw = settings.source.raw_size[0] > 0;
    if (raw) PILEUS_TRY(check_voxels(scene.file, settings.source.raw_size, limits));
    const std::string key = density_key(scene, settings);
    std::uint64_t bytes = 0;
    PILEUS_TRY(at_key(scene, key, density_file_bytes(settings, path, bytes, given.weather)));
    PILEUS_TRY(at_key(scene, key, check_limit(limits, LimitId::kFile, bytes, path)));
    // Bare numbers pass through in pieces of 65536; every other form is held whole.
    constexpr std::uint64_t kPieceBytes = 65536 * sizeof(float);
    source.reading_bytes = raw ? kPieceBytes : bytes;
    PILEUS_TRY(at_key(scene, key, read_head()));
    if (head.in_pieces) source.reading_bytes = 0;
    source.reading_bytes += head.unpacked_bytes;
    if (settings.source.y_up) turn_y_up(head.size, head.bounds_m);
    return Status::ok();
}

}  // namespace

Status hold_extinction(const std::string& where, Medium& medium) {
    const double per_m = max_extinction(medium);
    if (!(per_m <= kMaxSigma))
        return Status::bad_input(where + ": " + number_text(per_m) +
                                 " per m where it is densest, allowed: at most " +
                                 number_text(kMaxSigma));
    double square = 0;
    for (const double e : medium.extent_m) square += e * e;
    if (per_m < kMinSigma || per_m * __builtin_sqrt(square) < kMinSigma) medium.sigma = 0;
    return Status::ok();
}

std::uint64_t phase_bytes(const Medium& medium) {
    std::uint64_t bytes = 0;
    for (const PhaseStore& store : medium.phases) bytes += store.bytes();
    return bytes;
}

bool is_white(const Medium& medium) {
    for (int i = 0; i < medium.count; ++i)
        for (float albedo : medium.optics[std::size_t(i)].albedo)
            if (albedo != 1) return false;
    return true;
}

bool emits(const Medium& medium) {
    if (!kLights) return false;
    for (int i = 0; i < medium.count; ++i)
        for (float emission : medium.optics[std::size_t(i)].emission)
            if (emission > 0) return true;
    return false;
}

float phase_peak(const Medium& medium) {
    float largest = 0;
    for (int i = 0; i < medium.count; ++i) {
        const float peak = phase_peak(medium.optics[std::size_t(i)].phase);
        if (peak > largest) largest = peak;
    }
    return largest;
}

float mean_cosine(const Medium& medium) {
    float g = 0;
    for (int i = 0; i < medium.count; ++i)
        g += phase_moment(medium.optics[std::size_t(i)].phase, 1) / float(medium.count);
    return g;
}

std::string medium_key(const Scene& scene, const MediumSettings& settings) {
    std::size_t index = 0;
    while (index < scene.media.size() && &scene.media[index] != &settings) ++index;
    return "medium." + std::to_string(index);
}

Status check_voxels(const std::string& where, const std::array<int, 3>& size,
                    const Limits& limits) {
    std::uint64_t voxels = 1;
    for (const int n : size) {
        PILEUS_TRY(check_limit(limits, LimitId::kSide, std::uint64_t(n), where));
        voxels *= std::uint64_t(n);
    }
    return check_limit(limits, LimitId::kVoxels, voxels, where);
}

Status outline_medium(const Scene& scene, const MediumSettings& settings, const Limits& limits,
                      Medium& out, MediumSource& source, const MediumValues& given) {
    VolumeHead head;
    source = MediumSource{};
    if (given.cells != nullptr)
        head.size = given.size;
    else if (const DensityRow* row = density_row(settings.density))
        outline_shape(*row, settings, head, source);
    else
        PILEUS_TRY(outline_file(scene, settings, limits, given, head, source));
    PILEUS_TRY(check_voxels(scene.file, head.size, limits));
    if (settings.source.y_up)
        source.turned_voxels =
            std::uint64_t(head.size[0]) * std::uint64_t(head.size[1]) * std::uint64_t(head.size[2]);
    out.volume.size = head.size;
    out.volume.in_extinction = head.in_extinction;
    out.density_max = 1;
    // What a transfer function makes of the values is not known before them.
    if (!settings.optics.transfer.empty()) source.mean_density = -1;
    PILEUS_TRY(place_medium(scene, settings, head, out));
    return outline_detail(scene, settings, limits, out, source);
}

Status load_medium(const Scene& scene, const MediumSettings& settings, int threads, Medium& out,
                   const KernelTable* kernels, SkyField* sky, const MediumValues& given) {
    PILEUS_TRY(load_density(scene, settings, threads, kernels, sky, given, out.volume));
    VolumeHead head;
    head.size = out.volume.size;
    head.knows_bounds = out.volume.knows_bounds;
    head.bounds_m = out.volume.bounds_m;
    head.in_extinction = out.volume.in_extinction;
    PILEUS_TRY(place_medium(scene, settings, head, out));
    if (!settings.optics.transfer.empty()) return Status::ok();
    out.density_max = hold_densities(out.volume);
    if (out.volume.in_extinction) set_peak_to_one(settings.optics.extinction_scale, out);
    PILEUS_TRY(hold_extinction(medium_key(scene, settings), out));
    return add_detail(scene, settings, threads, kernels, out);
}

void keep_larger(const DensityWork& work, std::vector<DensityWork>& list) {
    for (DensityWork& known : list) {
        if (std::string_view(known.what) != work.what) continue;
        known.bytes = std::max(known.bytes, work.bytes);
        known.thread_bytes = std::max(known.thread_bytes, work.thread_bytes);
        return;
    }
    list.push_back(work);
}

float march_step(const Medium& medium) {
    const float cell = smallest_cell(medium.grid), detail = medium.detail.step_m;
    return medium.detail.present() && detail < cell ? detail : cell;
}

double mean_density(const Medium& medium) {
    double sum = 0;
    for (const float density : medium.volume.density.span()) sum += double(density);
    return sum / double(medium.volume.density.size());
}

}  // namespace pileus
