// SPDX-License-Identifier: Apache-2.0
// The grid's raw numbers as pictures: flux and anisotropy of each cell, slice beside slice.
// in: lit PhotonGridState -> out: an image of all level slices, the numbers themselves as `value`.
// docs/photon-grid.md, "Slices"; Märkl 2018, figure 5.6.
#include "lab/views/colours.h"
#include "lab/views/view_list.h"
#include "src/methods/photon_grid/photon_grid_method.h"
#include "src/photons/photon_report.h"
#include "src/photons/scatter.h"

namespace pileus {
namespace {

enum class GridSlices { kFlux, kAnisotropy };

/// Flux of a cell, and flux times the mean cosine to the first light's direction, green, per unit
/// of what the deposits stand for.
struct CellNumbers {
    double flux = 0, along = 0;
};

CellNumbers numbers_of(const GridLightInput& in, std::size_t cell, const float (&axis)[3]) {
    constexpr double kRootFourPi = 3.5449077018110320546;
    constexpr double kPerBandOne = 2.0466534158929769770;  // sqrt(4 pi / 3)
    const std::uint64_t channels = std::uint64_t(sum_channels(*in.medium, in.deposit));
    const std::uint64_t set = std::uint64_t(cell) * channels + (channels == 3 ? 1 : 0);
    const std::size_t slots = filled_slots(*in.photons);
    CellNumbers out;
    double sums[kMaxNumbers];
    for (std::size_t s = 0; s < slots; ++s)
        for (std::size_t l = 0; l < in.lighting->lights.size(); ++l) {
            slot_sums(in, in.photons->slots[s], l, set, sums);
            const double share = in.lighting->lights[l].colour[1] / double(slots) / in.unit_m2;
            if (in.deposit.mode == kDepositCosine) {
                out.flux += share * sums[0];
                // Of sky and ground the cosine is kept to their own axis, level up or down.
                out.along += share * sums[1] * (l == 0 ? 1.0 : 0.0);
                continue;
            }
            out.flux += share * sums[0] * kRootFourPi;
            if (in.deposit.bands < 2) continue;
            out.along +=
                share * kPerBandOne *
                (sums[3] * double(axis[0]) + sums[1] * double(axis[1]) + sums[2] * double(axis[2]));
        }
    return out;
}

/// Slices side by side, the lowest first, in rows of about the picture's shape; a pixel between.
struct Sheet {
    int across = 1, down = 1, zoom = 1, width = 1, height = 1;
};
Sheet sheet_of(const CellGrid& cells, const std::array<int, 2>& resolution) {
    const int nx = cells.size[0], ny = cells.size[1], nz = cells.size[2];
    Sheet s;
    const double shape = double(resolution[0]) / resolution[1];
    while (s.across < nz && double(s.across) * nx < shape * double((nz - 1) / s.across + 1) * ny)
        ++s.across;
    s.down = (nz - 1) / s.across + 1;
    s.zoom = resolution[0] / (s.across * (nx + 1));
    s.zoom = s.zoom < 1 ? 1 : s.zoom;
    s.width = s.across * (nx * s.zoom + 1) - 1;
    s.height = s.down * (ny * s.zoom + 1) - 1;
    return s;
}

Status add_slice_channels(Image& image) {
    const std::uint64_t pixels = std::uint64_t(image.width) * std::uint64_t(image.height);
    for (const char* name : {"R", "G", "B", "A", "value"}) {
        image.channels.emplace_back();
        image.channels.back().name = name;
        PILEUS_TRY(image.channels.back().pixels.resize(pixels, name));
    }
    return Status::ok();
}

/// What the slices show: a number for each cell near medium.
struct CellValues {
    std::vector<float> values;
    std::vector<bool> shown;
    float full = 0;  ///< the largest
};

/// Paints slice z; north is up.
void paint_slice(const Sheet& sheet, const CellGrid& cells, GridSlices what, int z,
                 const CellValues& of, Image& image) {
    const int nx = cells.size[0], ny = cells.size[1];
    const int left = z % sheet.across * (nx * sheet.zoom + 1);
    const int top = z / sheet.across * (ny * sheet.zoom + 1);
    for (int y = 0; y < ny * sheet.zoom; ++y)
        for (int x = 0; x < nx * sheet.zoom; ++x) {
            const int row = ny - 1 - y / sheet.zoom;
            const std::size_t cell =
                (std::size_t(z) * std::size_t(ny) + std::size_t(row)) * std::size_t(nx) +
                std::size_t(x / sheet.zoom);
            if (!of.shown[cell]) continue;
            const float v = of.values[cell];
            const Float3 colour = what == GridSlices::kFlux
                                      ? map_colour(ColourMap::kHeat, of.full > 0 ? v / of.full : 0)
                                      : map_colour(ColourMap::kSize, 0.5f + 0.5f * v);
            const std::size_t at =
                std::size_t(top + y) * std::size_t(image.width) + std::size_t(left + x);
            for (std::size_t c = 0; c < 3; ++c) image.channels[c].pixels[at] = colour[c];
            image.channels[3].pixels[at] = 1;
            image.channels[4].pixels[at] = v;
        }
}

/// All level slices of the grid beside one another: flux of the light in each cell that has been
/// scattered, or its mean cosine to the first light's direction; channel `value` holds the numbers.
Status show_slices(GridSlices what, const Context& context, const FrameView& view,
                   const PhotonGridState& state, Image& image) {
    const Lighting& lighting = state.lights.lighting;
    const GridLightInput in = grid_light_input(context, view, state);
    float axis[3] = {0, 0, -1};
    if (!lighting.lights.empty() && lighting.lights[0].beam)
        for (std::size_t a = 0; a < 3; ++a) axis[a] = lighting.lights[0].travel[a];
    const std::size_t count = std::size_t(state.cells.count());
    CellValues of{std::vector<float>(count), std::vector<bool>(count)};
    for (std::size_t i = 0; i < count; ++i) {
        if (in.marks[i] == kCellEmpty) continue;
        const CellNumbers n = numbers_of(in, i, axis);
        const double mean = n.flux > 0 ? n.along / n.flux : 0;
        of.values[i] = float(what == GridSlices::kFlux ? n.flux : mean);
        of.shown[i] = true;
        of.full = of.values[i] > of.full ? of.values[i] : of.full;
    }
    const Sheet sheet = sheet_of(state.cells, view.scene.camera.resolution);
    image.width = sheet.width;
    image.height = sheet.height;
    image.display_colours = true;
    PILEUS_TRY(add_slice_channels(image));
    for (int z = 0; z < state.cells.size[2]; ++z)
        paint_slice(sheet, state.cells, what, z, of, image);
    Report& report = *context.report;
    report.counters = {{"slices_across", std::uint64_t(sheet.across)},
                       {"slices_down", std::uint64_t(sheet.down)},
                       {"pixels_per_cell", std::uint64_t(sheet.zoom)}};
    return Status::ok();
}

class SlicesMethod final : public PhotonGridMethod {
public:
    using PhotonGridMethod::PhotonGridMethod;
    FrameWork full_work() const override { return {}; }  // a host has no views

protected:
    Status check(const Context& context, const FrameView& view) override {
        if (view.scene.photon_grid.closure == GridClosure::kCamera)
            return Status::bad_input(view.scene.file +
                                     ": photon_grid.closure: \"camera\" keeps neither flux nor "
                                     "directions to show, allowed: sh, published, mean");
        return PhotonGridMethod::check(context, view);
    }
};

class SlicesReport final : public PhotonGridReport {
public:
    SlicesReport(GridSlices what, PhotonGridMethod& of) : PhotonGridReport(of), what_(what) {}

    Status draw(const Context& context, const FrameView& view, Image& image) override {
        digest_photon_sums(context, of_, context.report->digests);
        return show_slices(what_, context, view, of_.state(), image);
    }

private:
    GridSlices what_;
};

template <GridSlices kWhat>
MadeMethod make_slices(const MethodInputs& inputs) {
    auto method = std::make_unique<SlicesMethod>(inputs);
    MadeMethod made;
    made.report = std::make_unique<SlicesReport>(kWhat, *method);
    made.method = std::move(method);
    return made;
}

}  // namespace

const ViewRow* photon_grid_views(int& count) {
    static constexpr ViewRow all[] = {
        {"flux-slices", false, make_slices<GridSlices::kFlux>},
        {"anisotropy-slices", false, make_slices<GridSlices::kAnisotropy>}};
    count = int(sizeof all / sizeof all[0]);
    return all;
}

}  // namespace pileus
