// SPDX-License-Identifier: Apache-2.0
// A mesh out of a map of heights: two triangles between four samples, normals by differences.
// in: a grid without holes, its place -> out: corners and normals, metres.
// docs/solids.md, "Height maps".
#include <glm/geometric.hpp>

#include "src/io/heights/height_map.h"

namespace pileus {
namespace {

/// Samples of the mesh: their places along each side, their heights and normals.
struct Posts {
    int columns = 0, rows = 0;
    Buffer<double> x, y, z;  ///< z: [row][column]; y falls from row to row

    std::size_t at(int row, int column) const {
        return std::size_t(row) * std::size_t(columns) + std::size_t(column);
    }
    Double3 place(int row, int column) const {
        return {x[std::size_t(column)], y[std::size_t(row)], z[at(row, column)]};
    }
};

/// Samples closer together are not told apart: slopes between them would be no numbers.
constexpr double kMinApart = 1e-6;

/// Middles of groups of `every` out of `samples` that reach from `low` to `high`.
Status set_places(const std::string& name, int samples, int every, double low, double high,
                  Buffer<double>& to) {
    const int posts = height_posts(samples, every);
    PILEUS_TRY(to.resize(std::uint64_t(posts), "samples"));
    for (int i = 0; i < posts; ++i) {
        const int first = i * every, last = std::min(first + every, samples) - 1;
        const double middle = 0.5 * (double(first) + double(last)) / double(samples - 1);
        to[std::size_t(i)] = low * (1 - middle) + high * middle;
        const double step = i == 0 ? 0 : to[std::size_t(i)] - to[std::size_t(i - 1)];
        if (i > 0 && !((low < high ? step : -step) >= kMinApart))
            return Status::bad_input(name +
                                     ": place: samples too close together, allowed: 1e-06 m apart");
    }
    return Status::ok();
}

/// The mean of a group of samples.
double mean_height(const HeightGrid& grid, int row, int column, int every) {
    double sum = 0;
    const int below = std::min((row + 1) * every, grid.rows);
    const int beside = std::min((column + 1) * every, grid.columns);
    int count = 0;
    for (int r = row * every; r < below; ++r)
        for (int c = column * every; c < beside; ++c, ++count)
            sum += double(grid.height[std::size_t(r) * std::size_t(grid.columns) + std::size_t(c)]);
    return sum / count;
}

Status set_posts(const std::string& name, const SolidSettings& settings, const HeightGrid& grid,
                 Posts& posts) {
    const int every = settings.heights.every;
    const auto& given = settings.heights.bounds_m;
    const auto& bounds = given[0] == given[1] ? grid.bounds_m : given;
    PILEUS_TRY(set_places(name, grid.columns, every, bounds[0][0], bounds[1][0], posts.x));
    PILEUS_TRY(set_places(name, grid.rows, every, bounds[1][1], bounds[0][1], posts.y));
    posts.columns = int(posts.x.size()), posts.rows = int(posts.y.size());
    PILEUS_TRY(posts.z.resize(std::uint64_t(posts.columns) * std::uint64_t(posts.rows), "samples"));
    for (int r = 0; r < posts.rows; ++r)
        for (int c = 0; c < posts.columns; ++c)
            posts.z[posts.at(r, c)] = mean_height(grid, r, c, every);
    return Status::ok();
}

/// Central differences; at the rim to the one neighbour.
Double3 normal_of(const Posts& p, int row, int column) {
    const int west = std::max(column - 1, 0), east = std::min(column + 1, p.columns - 1);
    const int north = std::max(row - 1, 0), south = std::min(row + 1, p.rows - 1);
    const Double3 across = p.place(row, east) - p.place(row, west);
    const Double3 along = p.place(north, column) - p.place(south, column);
    return glm::normalize(Double3(-across.z / across.x, -along.z / along.y, 1));
}

struct Corner {
    int row, column;
};

void add_triangle(const Posts& posts, const Buffer<float>& normals, const Corner (&corners)[3],
                  std::size_t& used, Mesh& mesh) {
    for (const Corner& c : corners) {
        const Double3 place = posts.place(c.row, c.column);
        const float* normal = &normals[3 * posts.at(c.row, c.column)];
        for (int a = 0; a < 3; ++a, ++used) {
            mesh.corners[used] = place[a];
            mesh.normals[used] = normal[a];
        }
    }
}

}  // namespace

Status mesh_of_heights(const std::string& name, const SolidSettings& settings,
                       const HeightGrid& grid, Mesh& mesh) {
    if (!grid.placed && settings.heights.bounds_m[0] == settings.heights.bounds_m[1])
        return Status::bad_input(name + ": place: the file says none, allowed: bounds_m");
    Posts posts;
    PILEUS_TRY(set_posts(name, settings, grid, posts));
    Buffer<float> normals;
    PILEUS_TRY(normals.resize(3 * posts.z.size(), "normals"));
    for (int r = 0; r < posts.rows; ++r)
        for (int c = 0; c < posts.columns; ++c) {
            const Double3 n = normal_of(posts, r, c);
            for (int a = 0; a < 3; ++a) normals[3 * posts.at(r, c) + std::size_t(a)] = float(n[a]);
        }
    const std::uint64_t triangles =
        2 * std::uint64_t(posts.columns - 1) * std::uint64_t(posts.rows - 1);
    PILEUS_TRY(mesh.corners.resize(9 * triangles, "mesh"));
    PILEUS_TRY(mesh.normals.resize(9 * triangles, "mesh"));
    std::size_t used = 0;
    for (int r = 0; r + 1 < posts.rows; ++r)
        for (int c = 0; c + 1 < posts.columns; ++c) {
            const Corner a{r, c}, b{r, c + 1}, low_a{r + 1, c}, low_b{r + 1, c + 1};
            const auto height = [&](const Corner& at) {
                return posts.z[posts.at(at.row, at.column)];
            };
            // Along the diagonal that rises less: ridges and valleys keep their line.
            const double down = height(a) - height(low_b), up = height(low_a) - height(b);
            if (down * down < up * up) {
                add_triangle(posts, normals, {low_a, low_b, a}, used, mesh);
                add_triangle(posts, normals, {low_b, b, a}, used, mesh);
            } else {
                add_triangle(posts, normals, {low_a, low_b, b}, used, mesh);
                add_triangle(posts, normals, {low_a, b, a}, used, mesh);
            }
        }
    return Status::ok();
}

}  // namespace pileus
