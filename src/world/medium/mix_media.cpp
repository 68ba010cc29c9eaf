// SPDX-License-Identifier: Apache-2.0
// See mix_media.h.
// in: media with boxes and voxels of their own -> out: the sum of their extinctions, and its parts.
// docs/methods.md 2, "Several media".
#include "src/world/medium/mix_media.h"

#include "src/base/number_text.h"
#include "src/base/powers.h"
#include "src/io/volumes/volume_file.h"
#include "src/world/medium/detail.h"
#include "src/world/medium/resample.h"

namespace pileus {
namespace {

/// Cells of `edge` along `extent`; one that is there but for rounding counts.
int cells_along(double extent, double edge) {
    const double cells = extent / edge - 1e-6;
    if (!(cells > 1)) return 1;
    if (cells >= kMaxVolumeSide) return kMaxVolumeSide;
    const int whole = int(cells);
    return double(whole) < cells ? whole + 1 : whole;
}

/// Media 1, 2 ... and then 0: the order in which the kernels add them up again.
std::vector<Layer> make_layers(const std::vector<Medium>& media, const MixBox& box, Medium& out) {
    const std::size_t voxels = out.volume.density.size();
    std::vector<Layer> layers;
    for (std::size_t i = 1; i < media.size(); ++i)
        layers.push_back(make_layer(media[i], box, out.sigma, out.parts.data() + (i - 1) * voxels));
    layers.push_back(make_layer(media[0], box, out.sigma, nullptr));
    return layers;
}

/// The smallest diagonal of the media, but not so small that cubes of a 24th of it (the longest
/// leaves) would be more than 2^17 in the common box.
double detail_of(const std::vector<Medium>& media, const MixBox& box) {
    double least = 0;
    for (const Medium& m : media) {
        double square = 0;
        for (double e : m.extent_m) square += e * e;
        const double diagonal = __builtin_sqrt(square);
        if (!(least > 0) || diagonal < least) least = diagonal;
    }
    const double volume = box.extent_m.x * box.extent_m.y * box.extent_m.z;
    const double floor = 24 * cube_root(volume / 131072);
    return least > floor ? least : floor;
}

/// The common medium but for its values; takes over the tables of phase functions.
void join_media(std::vector<Medium>& media, const MixBox& box, Medium& out) {
    out = Medium{};
    out.low_m = box.low_m;
    out.volume.size = box.size;
    out.grid.periodic = media[0].grid.periodic;
    out.grid.constant = media[0].grid.constant;
    for (std::size_t a = 0; a < 3; ++a) {
        out.extent_m[a] = box.extent_m[a];
        out.grid.size[a] = box.size[a];
        out.grid.cell_m[a] = float(box.extent_m[a] / box.size[a]);
    }
    out.count = int(media.size());
    out.detail_m = detail_of(media, box);
    for (std::size_t i = 0; i < media.size(); ++i) {
        out.optics[i] = media[i].optics[0];
        for (PhaseStore& store : media[i].phases) out.phases.push_back(std::move(store));
        media[i].phases.clear();
        if (media[i].channels > out.channels) out.channels = media[i].channels;
        if (media[i].sigma > out.sigma) out.sigma = media[i].sigma;
    }
}

/// Four digits are enough to tell.
std::string short_number(double value) { return number_text(value, 4); }

std::string told_voxels(const MixBox& box) {
    std::string size, edge;
    for (std::size_t a = 0; a < 3; ++a) {
        const double metres = box.extent_m[a] / box.size[a];
        size += (a > 0 ? "x" : "") + std::to_string(box.size[a]);
        edge += (a > 0 ? " x " : "") + short_number(metres);
    }
    return size + " voxels of " + edge + " m";
}

/// What the plan says of the common grid.
std::string told_mix(const std::vector<MixBox>& boxes, const std::vector<std::size_t>& names,
                     const MixGrid& grid) {
    std::string text = "media laid on one grid: " + told_voxels(grid.box);
    if (grid.coarsened) text += ", coarsened to keep the limit";
    const std::vector<bool> resampled = resampled_media(boxes, grid);
    for (std::size_t i = 0; i < boxes.size(); ++i)
        if (resampled[i] && (i == 0 || names[i] != names[i - 1]))
            text += "; medium " + std::to_string(names[i]) + " resampled";
    return text;
}

}  // namespace

MixGrid plan_mix(const std::vector<MixBox>& boxes, std::uint64_t most) {
    MixGrid grid;
    grid.box = boxes[0];
    Double3 edge = {0, 0, 0};
    for (std::size_t a = 0; a < 3; ++a) {
        double& low = grid.box.low_m[a];
        for (const MixBox& b : boxes) {
            low = b.low_m[a] < low ? b.low_m[a] : low;
            const double cell = b.extent_m[a] / b.size[a];
            if (!(edge[a] > 0) || cell < edge[a]) edge[a] = cell;
        }
        // Equal boxes must give exactly their extent.
        double extent = 0;
        for (const MixBox& b : boxes) {
            const double reach = (b.low_m[a] - low) + b.extent_m[a];
            extent = reach > extent ? reach : extent;
        }
        grid.box.extent_m[a] = extent;
    }
    // Every turn makes the voxels coarser, down to one along each axis.
    for (double factor = 1;; factor *= 1.01) {
        std::uint64_t voxels = 1;
        for (std::size_t a = 0; a < 3; ++a) {
            grid.box.size[a] = cells_along(grid.box.extent_m[a], edge[a] * factor);
            voxels *= std::uint64_t(grid.box.size[a]);
            grid.coarsened |= grid.box.extent_m[a] / grid.box.size[a] > edge[a] * (1 + 1e-6);
        }
        if (voxels <= most || voxels == 1) return grid;
    }
}

std::vector<bool> resampled_media(const std::vector<MixBox>& boxes, const MixGrid& grid) {
    std::vector<bool> resampled;
    for (const MixBox& b : boxes) {
        bool any = false;
        for (std::size_t a = 0; a < 3; ++a)
            any |= row_weights(row_of(grid.box, a), row_of(b, a)).resampled;
        resampled.push_back(any);
    }
    return resampled;
}

Status mix_media(std::vector<Medium>& media, const MixGrid& grid, int threads, Medium& out) {
    if (media.size() == 1) {
        out = std::move(media[0]);
        return Status::ok();
    }
    const MixBox& box = grid.box;
    join_media(media, box, out);
    PILEUS_TRY(allocate(arrays::density(out.grid), out.volume.density));
    PILEUS_TRY(allocate(arrays::media_parts(out.grid, media.size()), out.parts));
    // Without any extinction there is nothing to add up.
    if (out.sigma > 0) PILEUS_TRY(add_layers(make_layers(media, box, out), box, threads, out));
    for (float density : out.volume.density.span())
        if (density > out.density_max) out.density_max = density;
    media.clear();
    return Status::ok();
}

namespace {

/// The media of a scene that count, one after the other, and which they are.
struct MediaList {
    std::vector<Medium> media;
    std::vector<MixBox> boxes;
    std::vector<std::size_t> names;

    /// Leaves out what has no extinction, unless it is all there is.
    void add(Medium medium, std::size_t name, bool last, Plan& plan) {
        const bool dark = !(medium.sigma > 0 && medium.density_max > 0);
        if (dark && !(last && media.empty())) {
            plan.leave_out(("medium " + std::to_string(name)).c_str(),
                           "no extinction that single precision shows");
            return;
        }
        boxes.push_back(box_of(medium));
        names.push_back(name);
        media.push_back(std::move(medium));
    }

    /// One of the scene, as it is or colour by colour.
    Status add_all(const Scene& scene, std::size_t name, Medium medium, Plan& plan) {
        const bool last = name + 1 == scene.media.size();
        const std::vector<TransferRow>& rows = scene.media[name].optics.transfer;
        const std::string detail = told_detail(name, scene.media[name].detail);
        if (!detail.empty()) plan.need(detail.c_str());
        if (rows.empty()) {
            add(std::move(medium), name, last, plan);
            return Status::ok();
        }
        plan.need(told_transfer(name, rows).c_str());
        std::vector<Medium> colours;
        PILEUS_TRY(split_by_transfer(rows, medium, colours));
        for (std::size_t c = 0; c < colours.size(); ++c) {
            PILEUS_TRY(hold_extinction("medium." + std::to_string(name), colours[c]));
            add(std::move(colours[c]), name, last && c + 1 == colours.size(), plan);
        }
        return Status::ok();
    }

    MixGrid plan_grid(const Limits& limits, Plan& plan) const {
        const std::uint64_t most = limits[LimitId::kVoxels];
        const MixGrid grid = plan_mix(boxes, most < kMaxMixedVoxels ? most : kMaxMixedVoxels);
        if (media.size() == 1)
            plan.leave_out("mixing of media", "one medium");
        else
            plan.need(told_mix(boxes, names, grid).c_str());
        return grid;
    }
};

/// Media of one grid are read in one way. Periodic ones share one period and one place of it in x
/// and y; open ones stay among themselves.
Status check_alike(const Scene& scene, const MediaList& list) {
    const auto line = [&](std::size_t i, const std::string& rest) {
        return Status::bad_input(scene.file + ": medium." + std::to_string(list.names[i]) + rest);
    };
    for (std::size_t i = 1; i < list.media.size(); ++i) {
        const std::string first = " medium." + std::to_string(list.names[0]) + " has";
        const bool periodic = list.media[0].grid.periodic, constant = list.media[0].grid.constant;
        if (list.media[i].grid.constant != constant)
            return line(i, std::string(".interpolation: differs, \"") +
                               (constant ? "linear" : "constant") + "\", allowed: what" + first);
        if (list.media[i].grid.periodic != periodic)
            return line(i, std::string(".boundary: differs, \"") +
                               (periodic ? "open" : "periodic") + "\", allowed: what" + first);
        for (std::size_t a = 0; periodic && a < 2; ++a) {
            const MixBox &one = list.boxes[0], &other = list.boxes[i];
            const double most = 1e-9 * one.extent_m[a];
            if (!(__builtin_fabs(other.low_m[a] - one.low_m[a]) <= most) ||
                !(__builtin_fabs(other.extent_m[a] - one.extent_m[a]) <= most))
                return line(i, std::string(".bounds_m: another period along ") + "xy"[a] + ", " +
                                   number_text(other.low_m[a]) + " to " +
                                   number_text(other.low_m[a] + other.extent_m[a]) +
                                   ", allowed: the box that" + first + ", " +
                                   number_text(one.low_m[a]) + " to " +
                                   number_text(one.low_m[a] + one.extent_m[a]));
        }
    }
    return Status::ok();
}

std::uint64_t cells_of(const MixBox& box) {
    return std::uint64_t(box.size[0]) * std::uint64_t(box.size[1]) * std::uint64_t(box.size[2]);
}

/// Scratch of mixing: a plane and a row of each thread; and along each axis a weight for each cell
/// of the source and three for each of the target, with their places, less than 64 bytes a cell.
std::uint64_t mixing_bytes(const MediaList& list, const MixBox& box, std::uint64_t threads) {
    std::uint64_t largest = 0, rows = 0;
    for (const MixBox& b : list.boxes) {
        const std::uint64_t numbers = std::uint64_t(b.size[0]) * (std::uint64_t(b.size[1]) + 1);
        largest = numbers > largest ? numbers : largest;
        for (std::size_t a = 0; a < 3; ++a)
            rows += std::uint64_t(b.size[a]) + std::uint64_t(box.size[a]);
    }
    return 8 * threads * (largest + 31) + 64 * rows;
}

/// Mean of the common density from the means of its parts; below 0 where one is not known.
double mixed_mean(const MediaList& list, const std::vector<double>& means, const Medium& out) {
    double sum = 0, volume = 1;
    for (double e : out.extent_m) volume *= e;
    for (std::size_t i = 0; i < list.media.size(); ++i) {
        if (means[i] < 0 || list.media[i].volume.in_extinction) return -1;
        double part = means[i] * double(list.media[i].sigma);
        for (double e : list.media[i].extent_m) part *= e;
        sum += part;
    }
    return out.sigma > 0 ? sum / (volume * double(out.sigma)) : 0;
}

}  // namespace

Status outline_media(const Scene& scene, const Limits& limits, std::uint64_t threads, Plan& plan,
                     Medium& out, MediumSource& source, const HostMedia& given) {
    MediaList list;
    std::vector<double> means;
    source = MediumSource{};
    for (std::size_t i = 0; i < scene.media.size(); ++i) {
        Medium medium;
        MediumSource own;
        PILEUS_TRY(outline_medium(scene, scene.media[i], limits, medium, own, given.of(i)));
        const auto larger = [](std::uint64_t a, std::uint64_t b) { return a > b ? a : b; };
        source.reading_bytes = larger(source.reading_bytes, own.reading_bytes);
        source.turned_voxels = larger(source.turned_voxels, own.turned_voxels);
        for (const DensityWork& work : own.making) keep_larger(work, source.making);
        // Where it is marched there is one medium.
        source.tile_cells = own.tile_cells;
        PILEUS_TRY(list.add_all(scene, i, std::move(medium), plan));
        means.resize(list.media.size(), own.mean_density);
    }
    PILEUS_TRY(check_alike(scene, list));
    const MixGrid grid = list.plan_grid(limits, plan);
    if (list.media.size() == 1) {
        source.mean_density = means[0];
        out = std::move(list.media[0]);
        return Status::ok();
    }
    for (const MixBox& box : list.boxes) source.apart_voxels += cells_of(box);
    source.mixing_bytes = mixing_bytes(list, grid.box, threads);
    join_media(list.media, grid.box, out);
    out.density_max = 1;
    source.mean_density = mixed_mean(list, means, out);
    return Status::ok();
}

Status load_media(const Scene& scene, const Limits& limits, int threads, Plan& plan, Medium& out,
                  const KernelTable* kernels, const HostMedia& given) {
    MediaList list;
    std::uint64_t missing = 0, clamped = 0, blank = 0, capped = 0, plain = 0;
    for (std::size_t i = 0; i < scene.media.size(); ++i) {
        Medium medium;
        PILEUS_TRY(
            load_medium(scene, scene.media[i], threads, medium, kernels, nullptr, given.of(i)));
        missing += medium.volume.missing;
        clamped += medium.volume.clamped;
        blank += medium.volume.blank;
        capped += medium.volume.capped;
        plain += medium.volume.plain;
        PILEUS_TRY(list.add_all(scene, i, std::move(medium), plan));
    }
    const MixGrid grid = list.plan_grid(limits, plan);
    PILEUS_TRY(mix_media(list.media, grid, threads, out));
    out.volume.missing = missing;
    out.volume.clamped = clamped;
    out.volume.blank = blank;
    out.volume.capped = capped;
    out.volume.plain = plain;
    return Status::ok();
}

}  // namespace pileus
