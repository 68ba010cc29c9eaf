// SPDX-License-Identifier: Apache-2.0
// Every density that the program makes keeps what its row says.
// in: the table of densities -> out: pass or fail; a new row is tested by being there.
// docs/contributing.md, "Add a density".
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <set>
#include <string>

#include "src/base/digest.h"
#include "src/scene/read_scene.h"
#include "src/scene/rows/density_row.h"
#include "src/world/medium/medium.h"
#include "tests/support/keys_text.h"
#include "tests/support/sanitized.h"

#if defined(__GLIBC__)
#include <malloc.h>
#endif

using namespace pileus;

namespace {

using Size = std::array<int, 3>;

std::string text_of(const DensityRow& row, const std::string& lines = "") {
    return "[camera]\nposition_m = [0, -9000, 5000]\ntarget_m = [0, 0, 5000]\n[[medium]]\n"
           "extinction_per_m = 0.01\ndensity = \"" +
           std::string(row.name) + "\"\n" + lines;
}
const std::string kBox = "bounds_m = [[-1600, -1600, 1000], [1600, 1600, 3200]]\n";

MediumSettings settings_of(const DensityRow& row) {
    Scene scene;
    const Status status = read_scene_text(text_of(row, kBox), "s.toml", "", {}, scene);
    REQUIRE_MESSAGE(bool(status), status.message);
    return scene.media[0];
}

std::string fault(const DensityRow& row, const std::string& lines) {
    Scene scene;
    return read_scene_text(text_of(row, lines), "s.toml", "", {}, scene).message;
}

Volume made(const DensityRow& row, const MediumSettings& settings, const Size& size, int threads) {
    Volume volume;
    const Status status = row.make(settings, {size, threads, nullptr, nullptr}, volume);
    REQUIRE_MESSAGE(bool(status), status.message);
    CHECK(volume.size == size);
    CHECK(volume.density.size() ==
          std::size_t(size[0]) * std::size_t(size[1]) * std::size_t(size[2]));
    CHECK_FALSE(volume.knows_bounds);
    CHECK_FALSE(volume.in_extinction);
    bool within = true;
    // Particles lie upon each other.
    const float most = row.make_particles != nullptr ? 4.0f : 1.0f;
    for (const float v : volume.density.span()) within = within && v >= 0.0f && v <= most;
    CHECK(within);
    return volume;
}

std::string digest(const Volume& volume) {
    Digest digest;
    digest.floats(volume.density.span());
    return digest.hex();
}

double mean(const Volume& volume) {
    double sum = 0;
    for (const float v : volume.density.span()) sum += double(v);
    return sum / double(volume.density.size());
}

/// Bytes in memory now, or the most since `forget_peak`; 0 where the system does not say.
double resident(const char* line) {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        double kib = 0;
        if (word == line && status >> kib) return kib * 1024;
    }
    return 0;
}
bool forget_peak() {
#if defined(__GLIBC__)
    malloc_trim(0);
#endif
    std::ofstream file("/proc/self/clear_refs");
    file << "5" << std::flush;
    return bool(file);
}

}  // namespace

TEST_CASE("densities: a name is a kind and a word, and no two rows have the same") {
    std::set<std::string> names;
    for (const DensityRow* row : density_rows()) {
        const std::string name = row->name;
        CAPTURE(name);
        CHECK(names.insert(name).second);
        CHECK(std::count(name.begin(), name.end(), ':') == 1);
        CHECK(name.front() != ':');
        CHECK(name.back() != ':');
        CHECK(density_row(name) == row);
        CHECK(is_like_density_name(name + "x"));
        CHECK(density_row(name + "x") == nullptr);
        REQUIRE(bool(row->outline));
        REQUIRE(bool(row->make));
        CHECK(row->least_cells >= 1);
        CHECK(row->mean_within >= 1);
    }
    CHECK(names.size() >= 5);
    CHECK_FALSE(is_like_density_name("cloud.vdb"));
    CHECK(density_row("") == nullptr);
}

TEST_CASE("densities: scenes may say of each what its row takes, and nothing else") {
    for (const DensityRow* row : density_rows()) {
        const std::string name = row->name;
        CAPTURE(name);
        CHECK(fault(*row, kBox) == "");
        Scene scene;
        REQUIRE(read_scene_text(text_of(*row, kBox), "s.toml", "", {}, scene));
        CHECK(scene.media[0].density == row->name);
        CHECK(dump_scene(scene).find("density = \"" + std::string(row->name) + "\"") !=
              std::string::npos);
        CHECK(bool(check_scene(scene)));

        CHECK((fault(*row, "").find("bounds_m: missing") != std::string::npos) ==
              (row->needs_bounds || row->has_field));
        CHECK((fault(*row, kBox + "shape_seed = 7\n") == "") == row->takes_seed);
        for (const DensityRow* other : density_rows())
            if (other->table != nullptr && other != row)
                CHECK(fault(*row, kBox + other->table + " = {}\n").find("for ") !=
                      std::string::npos);
        const std::string least = std::to_string(row->least_cells);
        CHECK(fault(*row, kBox + "resolution = [" + least + ", " + least + ", 9]\n") == "");
        if (row->least_cells > 1)
            CHECK(fault(*row, kBox + "resolution = [" + std::to_string(row->least_cells - 1) +
                                  ", 9, 9]\n")
                      .find("too coarse for " + std::string(row->name)) != std::string::npos);
    }
}

TEST_CASE("densities: an outline tells size and mean, and a plan lists what making takes") {
    for (const DensityRow* row : density_rows()) {
        const std::string name = row->name;
        CAPTURE(name);
        const MediumSettings settings = settings_of(*row);
        const DensityOutline outline = row->outline(settings);
        CHECK((row->working != nullptr) == (outline.bytes + outline.thread_bytes > 0));
        Scene scene;
        scene.media.push_back(settings);
        Medium medium;
        MediumSource source;
        REQUIRE(outline_medium(scene, scene.media[0], Limits{}, medium, source));
        CHECK(medium.volume.size == outline.size);
        CHECK(source.mean_density == outline.mean);
        REQUIRE(source.making.size() == (row->working != nullptr ? 1 : 0));
        if (row->working != nullptr) CHECK(source.making[0].bytes == outline.bytes);
        scene.media[0].box.resolution = {11, 12, 13};
        REQUIRE(outline_medium(scene, scene.media[0], Limits{}, medium, source));
        CHECK(medium.volume.size == Size{11, 12, 13});
    }
}

TEST_CASE("densities: any size that is allowed, the same bits for any number of threads") {
    for (const DensityRow* row : density_rows()) {
        const std::string name = row->name;
        CAPTURE(name);
        const MediumSettings settings = settings_of(*row);
        const int least = row->least_cells;
        for (const Size& asked : {Size{1, 1, 1}, Size{1, 2, 9}, Size{7, 5, 3}, Size{33, 1, 17}}) {
            Size size;
            for (std::size_t a = 0; a < 3; ++a) size[a] = std::max(asked[a], least);
            CAPTURE(size[0]);
            CAPTURE(size[1]);
            CAPTURE(size[2]);
            const std::string one = digest(made(*row, settings, size, 1));
            CHECK(digest(made(*row, settings, size, 3)) == one);
            CHECK(digest(made(*row, settings, size, 0)) == one);
        }
    }
}

TEST_CASE("densities: another seed is another density") {
    for (const DensityRow* row : density_rows()) {
        if (!row->takes_seed) continue;
        const std::string name = row->name;
        CAPTURE(name);
        MediumSettings settings = settings_of(*row);
        const std::string first = digest(made(*row, settings, {24, 24, 24}, 1));
        settings.shape_seed = 5;
        CHECK(digest(made(*row, settings, {24, 24, 24}, 1)) != first);
    }
}

TEST_CASE("densities: the mean of what is made is the outline's, as near as the row says") {
    constexpr double kSlack = 1 << 20;  // pages, stacks, what the allocator keeps
    constexpr int kThreads = 2;
    // Noise is made, not read; the last case, as this holds for those that follow.
    unsetenv("HOME"), unsetenv("PILEUS_CACHE_DIR"), unsetenv("XDG_CACHE_HOME");
    for (const DensityRow* row : density_rows()) {
        const std::string name = row->name;
        CAPTURE(name);
        const MediumSettings settings = settings_of(*row);
        const DensityOutline outline = row->outline(settings);
        const int least = row->least_cells;
        made(*row, settings, {least, least, least}, kThreads);  // threads have their stacks
        const bool told = forget_peak();
        const double before = resident("VmRSS:");
        const Volume volume = made(*row, settings, outline.size, kThreads);
        const double taken = resident("VmHWM:") - before;
        const double planned = double(volume.density.bytes()) + double(outline.bytes) +
                               kThreads * double(outline.thread_bytes);
        const double share = mean(volume) / outline.mean;
        std::printf("density: mean %.4f, %.4f of the outline's; %.2f MiB of %.2f  %s\n",
                    mean(volume), share, taken / 1048576, planned / 1048576, row->name);
        CHECK(share <= row->mean_within);
        CHECK(share >= 1 / row->mean_within);
        // The sanitizers' own memory is no part of any plan.
        if (told && before > 0 && !test::kSanitized) CHECK(taken <= planned + kSlack);
    }
}
