// SPDX-License-Identifier: Apache-2.0
// Fluxes by paths: flat detectors on the faces of the media's box.
// in: FluxTask -> out: shares of the incident flux, maps, sensors.
// docs/flux.md
#include <algorithm>

#include "src/session/flux/flux_meter.h"
#include "src/session/flux/flux_run.h"

namespace pileus {
namespace {

/// Pixels of a side's detector, where only the mean counts.
constexpr int kSidePixels = 8;

/// Paths of a side's pixel: of many no more than make as many as the top has in all.
std::uint64_t side_samples(std::uint64_t samples, const std::array<int, 2>& columns) {
    constexpr std::uint64_t kFew = 4096;
    const std::uint64_t alike = samples * std::uint64_t(columns[0]) * std::uint64_t(columns[1]) /
                                (kSidePixels * kSidePixels);
    return std::min(samples, std::max(kFew, alike));
}

/// Light that leaves a face, by column, north at the top: [channel][pixel].
struct Sheet {
    std::vector<double> mean[3], error[3];
    double straight[3] = {};  ///< mean of what nothing has turned, where parts are kept
};

/// What a measurement is made of.
struct Sums {
    MeteredLight up, down, into_top, into_bottom;  ///< diffuse
    std::vector<double> direct;                    ///< [column], rows from the south
    MeteredLight sides;                            ///< net into the box, of its level area
};

bool shines(const Lighting& light) {
    return light.map.columns > 0 || light.ground.present || light.sky[0] > 0 || light.sky[1] > 0 ||
           light.sky[2] > 0;
}

/// Net light into the box through one side, added as a share of its level area.
Status add_side(FluxMeter& meter, int axis, bool high, const Lighting& light, MeteredLight& sum) {
    const Medium& m = meter.medium();
    const std::array<int, 2> pixels{kSidePixels, kSidePixels};
    const FluxPlane face = box_face(m, axis, high);
    const int outward = high ? 1 : -1;
    const double area = m.extent_m[2] / m.extent_m[axis];  // of the side over the level area
    MeteredLight out, in;
    PILEUS_TRY(meter.diffuse(face, -outward, pixels, out));
    if (shines(light)) PILEUS_TRY(meter.diffuse(face, outward, pixels, in));
    const double slant = outward * double(light.to_sun[std::size_t(axis)]);
    double direct = light.sunlit ? slant : 0;
    if (direct < 0) {
        std::vector<double> share;
        PILEUS_TRY(meter.direct(face, pixels, share));
        direct *= mean_of(share);
    }
    for (std::size_t c = 0; c < 3; ++c) {
        sum.mean[c] += area * (in.mean[c] - out.mean[c] + direct * light.sun_irradiance[int(c)]);
        sum.square_error[c] += area * area * (in.square_error[c] + out.square_error[c]);
    }
    return Status::ok();
}

Status measure_sides(FluxMeter& meter, const Lighting& light, Sums& sums) {
    const Medium& m = meter.medium();
    if (shines(light)) {
        const std::array<int, 2> pixels{kSidePixels, kSidePixels};
        PILEUS_TRY(meter.diffuse(box_face(m, 2, true), 1, pixels, sums.into_top));
        PILEUS_TRY(meter.diffuse(box_face(m, 2, false), -1, pixels, sums.into_bottom));
    }
    if (m.grid.periodic) return Status::ok();
    for (int axis = 0; axis < 2; ++axis)
        for (const bool high : {false, true})
            PILEUS_TRY(add_side(meter, axis, high, light, sums.sides));
    return Status::ok();
}

/// The film's pixels; a film that looks up is mirrored.
void take_sheet(const Film& film, bool mirrored, Sheet& sheet) {
    const std::size_t width = std::size_t(film.width), n = film.pixels();
    for (int c = 0; c < 3; ++c) {
        sheet.straight[c] = 0;
        sheet.mean[c].resize(n);
        sheet.error[c].resize(n);
        for (std::size_t p = 0; p < n; ++p) {
            const std::size_t from = mirrored ? p / width * width + (width - 1 - p % width) : p;
            sheet.mean[c][p] = film_mean(film, 0, c, from);
            sheet.error[c][p] = film_error(film, c, from);
            if (film.parts > 1)
                sheet.straight[c] +=
                    (sheet.mean[c][p] - film_mean(film, kPathCloud, c, from)) / double(n);
        }
    }
}

/// `back` is what the lit face sends back, `through` what the other lets pass, turned or not.
void fill_maps(const FluxTask& task, const Sheet& back, const Sheet& through,
               const std::vector<double>& direct, Image& maps) {
    const std::size_t width = std::size_t(maps.width), height = std::size_t(maps.height);
    for (std::size_t p = 0; p < width * height; ++p) {
        // Rows of rays begin in the south, those of a map in the north.
        const std::size_t row = height - 1 - p / width;
        const double straight = direct.empty() ? 0 : direct[row * width + p % width];
        for (std::size_t c = 0; c < 3; ++c) {
            const double own = task.level[c] > 0 ? straight : 0;
            maps.channels[c].pixels[p] = float(task.share(back.mean[c][p], c));
            maps.channels[3 + c].pixels[p] = float(task.share(back.error[c][p], c));
            maps.channels[6 + c].pixels[p] = float(task.share(through.mean[c][p], c) + own);
            maps.channels[9 + c].pixels[p] = float(own);
        }
    }
}

/// One channel of the result: `straight` is the sun's own light through the bottom.
void take_shares(const FluxTask& task, const Sums& s, double straight, bool absorbs, std::size_t c,
                 FluxResult& out) {
    const auto put = [&](FluxShare& share, double mean, double square) {
        share.mean[c] = task.share(mean, c);
        share.standard_error[c] = task.share(__builtin_sqrt(square), c);
    };
    put(out.reflectance, s.up.mean[c], s.up.square_error[c]);
    put(out.transmittance, s.down.mean[c] + straight, s.down.square_error[c]);
    put(out.transmittance_direct, straight, 0);
    if (!absorbs) return;
    double net = s.sides.mean[c] + s.into_top.mean[c] + s.into_bottom.mean[c];
    if (!task.settings.from_below) net += task.level[c] - straight;
    double square = s.sides.square_error[c];
    for (const MeteredLight* light : {&s.up, &s.down, &s.into_top, &s.into_bottom})
        square += light->square_error[c];
    net -= s.up.mean[c] + s.down.mean[c];
    put(out.absorptance, net, square);
}

/// From below the roles of the faces are exchanged, and what went straight is counted, not marched:
/// each path of the top's detector brings all of it or nothing.
void turn_upside_down(const FluxTask& task, const Sheet& top, FluxResult& out) {
    const double paths = double(out.samples) * out.columns[0] * out.columns[1];
    FluxShare& direct = out.transmittance_direct;
    std::swap(out.reflectance, out.transmittance);
    for (std::size_t c = 0; c < 3; ++c) {
        const double share = task.share(top.straight[c], c);
        const double spread = share * (1 - share) / (paths > 1 ? paths - 1 : 1);
        direct.mean[c] = share;
        direct.standard_error[c] = spread > 0 ? __builtin_sqrt(spread) : 0;
    }
}

}  // namespace

Status flux_by_paths(const FluxTask& task, std::uint64_t samples, FluxResult& out, Image& maps) {
    const StageClock clock(task.context, "paths");
    const Lighting& light = task.scenery.lighting;
    FluxMeter meter(task.context, task.scenery, task.path, samples);
    const bool below = task.settings.from_below;
    if (below) meter.keep_parts();
    const FluxPlane top = box_face(meter.medium(), 2, true);
    const FluxPlane bottom = box_face(meter.medium(), 2, false);
    Sums sums;
    Sheet up, down;
    PILEUS_TRY(meter.diffuse(top, -1, out.columns, sums.up));
    take_sheet(meter.film(), false, up);
    if (light.sunlit) PILEUS_TRY(meter.direct(bottom, out.columns, sums.direct));
    PILEUS_TRY(meter.diffuse(bottom, 1, out.columns, sums.down));
    take_sheet(meter.film(), true, down);
    fill_maps(task, below ? down : up, below ? up : down, sums.direct, maps);
    const bool absorbs = !is_white(meter.medium());
    if (absorbs) {
        meter.set_samples(side_samples(samples, out.columns));
        PILEUS_TRY(measure_sides(meter, light, sums));
        meter.set_samples(samples);
    }
    for (std::size_t c = 0; c < 3; ++c)
        take_shares(task, sums, mean_of(sums.direct) * task.level[c], absorbs, c, out);
    if (below) turn_upside_down(task, up, out);
    if (task.last || !(flux_excess(task, out) > 1))
        PILEUS_TRY(read_flux_sensors(task.settings, task.scene, task.scenery, meter, out.sensors));
    out.paths = meter.paths();
    return Status::ok();
}

}  // namespace pileus
