// SPDX-License-Identifier: Apache-2.0
// See resample.h.
// in: weights along each axis -> out: densities, slice by slice.
// docs/methods.md 2, "Several media".
#include "src/world/medium/resample.h"

#include "platform/threads.h"

namespace pileus {
namespace {

/// sum = weighted sum of runs of `stride` numbers that lie `stride` apart.
template <class T>
void add_runs(const RowWeights& w, std::size_t cell, const T* source, std::size_t stride,
              double* sum) {
    for (std::size_t i = 0; i < stride; ++i) sum[i] = 0;
    for (std::size_t k = w.first[cell]; k < w.first[cell + 1]; ++k) {
        const T* from = source + (std::size_t(w.begin[cell]) + k - w.first[cell]) * stride;
        const double weight = w.weight[k];
        for (std::size_t i = 0; i < stride; ++i) sum[i] += weight * double(from[i]);
    }
}

bool reached(const RowWeights& w, std::size_t cell) { return w.first[cell] < w.first[cell + 1]; }

/// Adds slice z of one medium to the sum, axis after axis; `scratch` holds a plane and a row of it.
void add_slice(const Layer& layer, const std::array<int, 3>& size, std::size_t z, double* scratch,
               float* density) {
    if (!reached(layer.axis[2], z)) return;
    double* row = scratch + layer.plane();
    add_runs(layer.axis[2], z, layer.medium->volume.density.data(), layer.plane(), scratch);
    const std::size_t nx = std::size_t(size[0]), ny = std::size_t(size[1]);
    for (std::size_t y = 0; y < ny; ++y) {
        if (!reached(layer.axis[1], y)) continue;
        add_runs(layer.axis[1], y, scratch, layer.width(), row);
        for (std::size_t x = 0; x < nx; ++x) {
            double value = 0;
            add_runs(layer.axis[0], x, row, 1, &value);
            const float part = float(value * layer.scale);
            const std::size_t voxel = (z * ny + y) * nx + x;
            density[voxel] += part;
            if (layer.part != nullptr) layer.part[voxel] = part;
        }
    }
}

}  // namespace

Layer make_layer(const Medium& medium, const MixBox& target, float sigma, float* part) {
    Layer layer{&medium, {}, double(medium.sigma) / double(sigma), part};
    const MixBox source = box_of(medium);
    for (std::size_t a = 0; a < 3; ++a)
        layer.axis[a] = row_weights(row_of(target, a), row_of(source, a), medium.grid.constant);
    return layer;
}

Status add_layers(const std::vector<Layer>& layers, const MixBox& box, int threads, Medium& out) {
    std::size_t largest = 0;
    for (const Layer& layer : layers) {
        const std::size_t numbers = layer.plane() + layer.width();
        if (numbers > largest) largest = numbers;
    }
    largest = (largest + 31) / 16 * 16;
    Buffer<double> scratch;
    PILEUS_TRY(scratch.resize(std::uint64_t(largest) * std::uint64_t(threads), "mixing of media"));
    parallel_for(threads, box.size[2], [&](std::int64_t z, int thread) {
        for (const Layer& layer : layers)
            add_slice(layer, box.size, std::size_t(z),
                      scratch.data() + std::size_t(thread) * largest, out.volume.density.data());
    });
    return Status::ok();
}

Grid resampled_grid(const Medium& medium, const std::array<int, 3>& size) {
    Grid grid;
    grid.periodic = medium.grid.periodic;
    grid.constant = medium.grid.constant;
    for (std::size_t a = 0; a < 3; ++a) {
        grid.size[a] = size[a];
        grid.cell_m[a] = float(medium.extent_m[a] / size[a]);
    }
    return grid;
}

Status resample_medium(const Medium& medium, const std::array<int, 3>& size, int threads,
                       const Array<float>& density, Medium& out) {
    MixBox box = box_of(medium);
    box.size = size;
    out.low_m = medium.low_m;
    for (std::size_t a = 0; a < 3; ++a) out.extent_m[a] = medium.extent_m[a];
    out.grid = resampled_grid(medium, size);
    out.volume.size = size;
    out.sigma = medium.sigma;
    out.density_max = medium.density_max;
    PILEUS_TRY(allocate(density, out.volume.density));
    if (!(out.sigma > 0)) return Status::ok();
    return add_layers({make_layer(medium, box, out.sigma, nullptr)}, box, threads, out);
}

}  // namespace pileus
