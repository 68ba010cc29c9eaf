// SPDX-License-Identifier: Apache-2.0
// Statistics of clouds: generators by type and seed, today's cumulus, simulations, an artist's
// grid. in: [DATA_DIR] [key=value ...] for every generator -> out: Markdown rows for
// docs/generators.md. docs/generators.md, "Measured"; lab/statistics/cloud_statistics.h says what
// the columns are.
#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <vector>

#include "lab/statistics/cloud_statistics.h"
#include "platform/clock.h"
#include "src/scene/read_scene.h"
#include "src/world/medium/medium.h"

namespace {

using namespace pileus;

/// The first layer at or above a share of the cloud's height.
std::string water_at(const CloudStatistics& s, double share) {
    if (s.by_height.empty()) return "-";
    const double top = s.by_height.back().height_m;
    for (const HeightRow& row : s.by_height)
        if (row.height_m >= share * top) return fmt::format("{:.2f}", row.adiabatic);
    return "-";
}

/// One row; what cannot be read is a row that says why.
void print_row(const std::string& name, const std::string& medium,
               const std::vector<std::string>& set) {
    const std::string text =
        "[camera]\nposition_m = [0, -90000, 5000]\ntarget_m = [0, 0, 5000]\n[[medium]]\n" + medium;
    Scene scene;
    Medium made;
    Status status = read_scene_text(text, name, "", set, scene);
    const double start = wall_seconds();
    if (status) status = load_medium(scene, scene.media[0], 0, made);
    const double seconds = wall_seconds() - start;
    if (!status) {
        fmt::print("| {} | {} |\n", name, status.message);
        return;
    }
    ExtinctionGrid grid{};
    for (std::size_t a = 0; a < 3; ++a) {
        grid.size[a] = made.volume.size[a];
        grid.cell_m[a] = made.extent_m[a] / made.volume.size[a];
    }
    grid.value = made.volume.density.data(), grid.per_m = double(made.sigma);
    const CloudStatistics s = cloud_statistics(grid);
    fmt::print(
        "| {} | {}x{}x{}, {:.1f} m | {:.3f} | {:.3f} | {:.3f} | {:.2f} ({}) | {:.2f} | {:.2f} | "
        "{:.0f} | {} {} {} {} | {:.3f} |\n",
        name, grid.size[0], grid.size[1], grid.size[2], grid.cell_m[0], s.dimension[0],
        s.dimension[1], s.dimension[2], s.perimeter_area, s.patches, s.spectrum, s.cover,
        s.mean_depth, water_at(s, 0.1), water_at(s, 0.35), water_at(s, 0.65), water_at(s, 0.9),
        seconds);
    std::fflush(stdout);
}

}  // namespace

int main(int count, char** words) {
    const std::string root = count > 1 ? words[1] : "";
    const std::vector<std::string> set(words + (count > 1 ? 2 : 1), words + count);
    fmt::print(
        "| | grid | D 0.3 | D 1 | D 3 | perimeter-area D (patches) | spectrum | cover | mean "
        "depth | extinction over adiabatic at 0.1, 0.35, 0.65, 0.9 of the height | s |\n");
    const auto print_seeds = [&](const char* type, int seeds) {
        for (int seed = 1; seed <= seeds; ++seed)
            print_row(
                fmt::format("{}, seed {}", type, seed),
                fmt::format("density = \"procedural:cloud\"\ncloud = {{ type = \"{}\", seed = "
                            "{} }}\n",
                            type, seed),
                set);
    };
    for (const char* type : {"cumulus-humilis", "cumulus-mediocris", "cumulus-congestus"})
        print_seeds(type, 4);
    for (const char* type : {"cumulonimbus", "cumulus-field", "stratocumulus", "stratocumulus-open",
                             "altocumulus", "altocumulus-lenticularis", "stratus", "nimbostratus",
                             "fog", "cirrus", "cirrus-uncinus", "cirrostratus"})
        print_seeds(type, 2);
    print_row("cumulus-field, 18 km",
              "density = \"procedural:cloud\"\ncloud = { type = \"cumulus-field\" }\nbounds_m = "
              "[[-9000, -9000, 800], [9000, 9000, 2000]]\nresolution = [1200, 1200, 60]\n",
              set);
    for (int seed = 0; seed < 4; ++seed)
        print_row(
            fmt::format("procedural:cumulus, seed {}", seed),
            fmt::format("density = \"procedural:cumulus\"\nshape_seed = {}\nbounds_m = [[-800, "
                        "-800, 600], [800, 800, 1700]]\nresolution = [266, 266, "
                        "184]\nextinction_per_m = 0.1\n",
                        seed),
            {});
    if (root.empty()) return 0;
    for (const char* file : {"rico122x106x39.txt", "rico32x37x26.txt", "les_stcu.txt"})
        print_row(file, fmt::format("density = \"{}/data/les/{}\"\n", root, file), {});
    print_row(
        "cloud.vdb",
        fmt::format("density = {{ file = \"{}/data/vdb/cloud.vdb\", grid = \"density\" }}\ny_up = "
                    "true\nbounds_m = [[-450, -522, 600], [450, 522, 1206]]\n"
                    "extinction_per_m = 0.15\n",
                    root),
        {});
    return 0;
}
