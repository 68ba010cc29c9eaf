// SPDX-License-Identifier: Apache-2.0
// Writes the phase functions of water clouds that the program holds.
// in: nothing -> out: src/world/phase/mie_data.cpp on standard output; a minute or two of one
// processor. docs/phase.md, "Mie".
#include "lab/mie/mie.h"

#include <fmt/format.h>

#include <cstdio>
#include <string>

#include "src/world/phase/mie_data.h"

namespace {

constexpr double kRadii[pileus::kMieRadii] = {4, 5, 6, 7, 8.5, 10, 12, 14, 17, 20};

/// Numbers of one array, as many to a line as fit.
void print_numbers(const std::vector<std::string>& numbers, const char* indent) {
    std::string line = indent;
    for (const std::string& number : numbers) {
        if (line.size() + number.size() + 1 > 100) {
            std::fprintf(stdout, "%s\n", line.c_str());
            line = indent;
        }
        line += number + ",";
    }
    std::fprintf(stdout, "%s\n", line.c_str());
}

}  // namespace

int main() {
    using namespace pileus;
    const std::vector<double> angles = mie_table_angles();
    if (angles.size() != std::size_t(kMieAngles)) return 1;
    std::fputs(
        "// SPDX-License-Identifier: Apache-2.0\n"
        "// Phase functions of water clouds; written by tools/tables/mie.cpp, not by hand.\n"
        "// in: nothing -> out: see mie_data.h.\n"
        "// docs/phase.md, \"Mie\".\n"
        "#include \"src/world/phase/mie_data.h\"\n\n// clang-format off\nnamespace pileus {\n\n",
        stdout);
    std::vector<std::string> radii, efficiency, places;
    std::vector<std::vector<std::string>> densities;
    for (double angle : angles) places.push_back(std::to_string(int(angle * 100 + 0.5)));
    for (double radius : kRadii) {
        MieCloud cloud;
        cloud.effective_radius_um = radius;
        const MieResult result = mie_cloud(cloud, angles);
        radii.push_back(fmt::format("{:.1f}f", radius));
        efficiency.push_back(fmt::format("{:.5f}f", result.extinction_efficiency));
        densities.emplace_back();
        for (double v : result.density) densities.back().push_back(std::to_string(mie_stored(v)));
        std::fprintf(stderr, "radius %g um: efficiency %.4f, mean cosine %.5f\n", radius,
                     result.extinction_efficiency, result.mean_cosine);
    }
    std::fputs("const float kMieRadius[kMieRadii] = {\n", stdout);
    print_numbers(radii, "    ");
    std::fputs("};\nconst float kMieExtinction[kMieRadii] = {\n", stdout);
    print_numbers(efficiency, "    ");
    std::fputs("};\nconst std::uint16_t kMieAngle[kMieAngles] = {\n", stdout);
    print_numbers(places, "    ");
    std::fputs("};\nconst std::uint16_t kMieDensity[kMieRadii][kMieAngles] = {\n", stdout);
    for (const auto& row : densities) {
        std::fputs("    {\n", stdout);
        print_numbers(row, "    ");
        std::fputs("    },\n", stdout);
    }
    std::fputs("};\n\n}  // namespace pileus\n// clang-format on\n", stdout);
    return 0;
}
