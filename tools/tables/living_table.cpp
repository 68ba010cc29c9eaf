// SPDX-License-Identifier: Apache-2.0
// Clouds whose density is replaced while they are drawn: errors and times of frames.
// in: [--only NAME] [--errors|--times] -> out: Markdown tables for docs/living.md.
// docs/living.md says what the columns are.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <pileus/pileus.hpp>
#include <string>
#include <vector>

#include "platform/clock.h"

namespace {

using namespace pileus::embed;
using Settings = std::vector<std::string>;

constexpr const char* kScene = R"(
seed = 3
[camera]
position_m = [0, -3000, 600]
target_m = [0, 0, 900]
fov_deg = 34
[sun]
azimuth_deg = 65
elevation_deg = 35
[sky]
radiance = [0.05, 0.07, 0.11]
[ground]
altitude_m = 0
albedo = 0.2
[[medium]]
density = "uniform:box"
bounds_m = [[-800, -800, 500], [800, 800, 1600]]
extinction_per_m = 0.05
phase = { type = "henyey-greenstein", g = 0.85 }
)";

struct Row {
    const char* name;
    Settings set;
};
const std::vector<Row>& rows() {
    static const std::vector<Row> all{
        {"collectors, march", {"method.name=\"collectors\"", "collectors.photons=1_000_000"}},
        {"collectors, quick march",
         {"method.name=\"collectors\"", "collectors.photons=1_000_000", "collectors.scale=4"}},
        {"collectors, billboards",
         {"method.name=\"collectors\"", "collectors.photons=1_000_000",
          "collectors.display=\"billboards\""}},
        {"photon-grid, ring",
         {"method.name=\"photon-grid\"", "photon_grid.ring=true", "photon_grid.photons=1_000_000",
          "photon_grid.scale=2"}},
        {"raymarch", {"method.name=\"raymarch\""}},
        {"raymarch, temporal = 4",
         {"method.name=\"raymarch\"", "raymarch.temporal=4", "raymarch.steps=96"}},
        {"optical-depth", {"method.name=\"optical-depth\""}},
        {"path, 32 samples", {"method.name=\"path\"", "path.samples_per_pixel=32"}}};
    return all;
}

/// How often a density comes, in frames, and over how many it fades in.
struct Pace {
    int every, over;
};
constexpr Pace kErrorPaces[] = {{1, 4}, {4, 4}, {10, 8}};
constexpr Pace kTimePaces[] = {{4, 4}, {10, 8}, {40, 8}};

template <class T>
T take(Result<T> result) {
    if (!result) {
        std::fprintf(stderr, "living_table: %s\n", result.message().c_str());
        std::exit(int(result.code()));
    }
    return std::move(*result);
}
void must(const Status& status) {
    if (status) return;
    std::fprintf(stderr, "living_table: %s\n", status.message().c_str());
    std::exit(int(status.code()));
}

/// A cloud of puffs that rise, drift and swell; `time` in frames.
std::vector<float> density_at(double time, const glm::uvec3& size) {
    constexpr int kPuffs = 24;
    std::vector<float> values(std::size_t(size.x) * size.y * size.z);
    struct Puff {
        double x, y, z, r;
    } puffs[kPuffs];
    std::uint32_t state = 7;
    const auto next = [&] {
        state = state * 1664525u + 1013904223u;
        return double(state >> 8) / double(1u << 24);
    };
    for (Puff& p : puffs) {
        const double turn = 6.28 * next(), out = 0.3 * std::sqrt(next()), up = next();
        p.r = 0.10 + 0.10 * next() + 0.02 * std::sin(turn + 0.05 * time);
        p.x = 0.5 + out * std::cos(turn) + 0.0006 * time;
        p.y = 0.5 + out * std::sin(turn);
        p.z = 0.2 + 0.45 * up * (1 - out) + 0.0008 * time * up;
    }
    for (std::uint32_t k = 0; k < size.z; ++k)
        for (std::uint32_t j = 0; j < size.y; ++j)
            for (std::uint32_t i = 0; i < size.x; ++i) {
                const double x = (i + 0.5) / size.x, y = (j + 0.5) / size.y, z = (k + 0.5) / size.z;
                double sum = 0;
                for (const Puff& p : puffs) {
                    const double d = (x - p.x) * (x - p.x) + (y - p.y) * (y - p.y) +
                                     (z - p.z) * (z - p.z) * 0.47;
                    sum += std::max(0.0, 1 - d / (p.r * p.r));
                }
                const double rough =
                    std::sin(41 * x + 3 * z) * std::sin(37 * y) * std::sin(43 * z + 0.05 * time);
                values[(std::size_t(k) * size.y + j) * size.x + i] =
                    float(std::min(1.0, std::max(0.0, 1.5 * sum - 0.35 + 0.25 * rough)));
            }
    return values;
}

/// One setting of a flight.
struct Flight {
    Settings set;
    glm::uvec3 cells;
    double turn_deg = 0;  ///< of the camera about the cloud, each frame

    Camera camera(int frame) const {
        Camera c;
        c.fov_deg = 34;
        c.target_m = {0, 0, 900};
        c.position_m = orbit({0, -3000, 600}, c.target_m, turn_deg * frame);
        return c;
    }
};

/// A session over the density of a frame, lit, that has drawn a picture: what a host's worker
/// makes.
Session lit_session(const Flight& flight, int time, int frame, std::uint32_t more,
                    std::vector<float>* picture = nullptr) {
    const Scene scene = take(Scene::parse(kScene, {}, flight.set));
    const std::vector<float> values = density_at(time, flight.cells);
    Density density;
    density.size = flight.cells;
    density.values = values.data();
    const World world = take(World::create(scene, {}, {density}));
    Session session = take(Session::create(world, scene));
    must(session.set_camera(flight.camera(frame)));
    must(session.set_frame(frame));
    const Progress progress = take(session.progress());
    must(session.step(progress.whole + (progress.unit == "generation" ? more : 0)));
    Frame drawn;
    if (picture != nullptr) {
        drawn.colour = picture->data();
        drawn.format = Format::kRgba32F;
    }
    must(session.render(drawn));
    return session;
}

/// Light of a frame: a generation, or all samples, which belong to one camera.
std::uint32_t units_of(const Session& session) {
    const Progress progress = take(session.progress());
    return progress.unit == "sample" ? progress.whole : 1;
}

// ---- Errors --------------------------------------------------------------------------------

constexpr glm::uvec2 kSmall{96, 54};
using Pixels = std::vector<float>;

Settings small(Settings set) {
    set.push_back(fmt::format("camera.resolution=[{},{}]", kSmall.x, kSmall.y));
    return set;
}

/// What a row is compared with: of photons many more of them, marched at every pixel, so that noise
/// and what a hand-over does are the error; else paths.
Settings converged(Settings set) {
    if (set[0].find("collectors") == std::string::npos &&
        set[0].find("photon-grid") == std::string::npos)
        return {"method.name=\"path\"", "path.samples_per_pixel=400", "seed=99"};
    for (const char* more : {"collectors.photons=6_000_000", "photon_grid.photons=6_000_000",
                             "collectors.scale=1", "photon_grid.scale=1", "seed=99"})
        set.emplace_back(more);
    return set;
}

/// Such a picture of a density, as seen by a frame's camera; kept, as other rows ask for the same.
const Pixels& reference(const Flight& flight, int time, int frame) {
    static std::map<std::string, Pixels> known;
    const int seen = flight.turn_deg != 0 ? frame : 0;
    Settings set = converged(flight.set);
    std::string key = fmt::format("{} {} {}", time, seen, flight.turn_deg);
    for (const std::string& text : set)
        if (text.find("scale") == std::string::npos) key += " " + text;
    Pixels& made = known[key];
    if (!made.empty()) return made;
    made.resize(std::size_t(kSmall.x) * kSmall.y * 4);
    Flight other = flight;
    other.set = small(set);
    lit_session(other, time, seen, 0, &made);
    return made;
}

double relmse(const Pixels& a, const Pixels& b) {
    pileus_picture own, other;
    pileus_figures figures;
    pileus_error error;
    PILEUS_INIT(own);
    PILEUS_INIT(other);
    PILEUS_INIT(figures);
    PILEUS_INIT(error);
    own.width = other.width = kSmall.x;
    own.height = other.height = kSmall.y;
    own.channels = other.channels = 4;
    own.values = a.data();
    other.values = b.data();
    if (pileus_compare(&own, &other, 0.02, 0, nullptr, &figures, &error) != PILEUS_OK) {
        std::fprintf(stderr, "living_table: %s\n", error.message);
        std::exit(2);
    }
    return figures.relmse;
}

struct Errors {
    double steady = 0, peak = 0;
};

/// Errors of pictures against paths of the densities that they are to show, by their weights.
Errors fly_errors(const Flight& flight, const Pace& pace, int frames) {
    Errors out;
    Pixels pixels(std::size_t(kSmall.x) * kSmall.y * 4);
    int lit = 1, fading = 0;
    Session session = lit_session(flight, 0, 0, 1, &pixels);
    out.steady += relmse(pixels, reference(flight, 0, 0));
    std::map<int, double> before{{0, 1.0}};
    int now = 0;
    for (int f = 0; f < frames; ++f) {
        if (f > 0 && f % pace.every == 0) {
            Session next = lit_session(flight, f, f, 1, &pixels);
            out.steady += relmse(pixels, reference(flight, f, f));
            ++lit;
            must(session.hand_over(next, std::uint32_t(pace.over)));
            // What is shown now fades.
            const double share = double(fading) / pace.over;
            if (now != 0 || fading > 0) {
                for (auto& row : before) row.second *= 1 - share;
                before[now] += share;
            }
            now = f;
            fading = 0;
        }
        must(session.set_camera(flight.camera(f)));
        must(session.set_frame(f));
        must(session.step(units_of(session)));
        Frame frame;
        frame.colour = pixels.data();
        frame.format = Format::kRgba32F;
        must(session.render(frame));
        if (now != 0 && fading < pace.over) ++fading;
        const double share = now != 0 ? double(fading) / pace.over : 0;
        Pixels wanted(pixels.size());
        const auto add = [&](int time, double weight) {
            if (weight <= 0) return;
            const Pixels& seen = reference(flight, time, f);
            for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] += float(weight) * seen[i];
        };
        for (const auto& row : before) add(row.first, (1 - share) * row.second);
        add(now, share);
        out.peak = std::max(out.peak, relmse(pixels, wanted));
    }
    out.steady /= lit;
    return out;
}

void print_errors(const std::string& only) {
    std::printf("| error, peak over steady | steady relMSE | camera still:");
    for (const Pace& p : kErrorPaces) std::printf(" every %d over %d |", p.every, p.over);
    std::printf(" camera moves: every 4 over 4 |\n|---|---|---|---|---|---|\n");
    for (const Row& row : rows()) {
        if (std::string(row.name).find(only) == std::string::npos) continue;
        Flight flight{small(row.set), {64, 64, 44}, 0};
        std::string line;
        double steady = 0;
        for (const Pace& pace : kErrorPaces) {
            const Errors e = fly_errors(flight, pace, pace.every == 1 ? 10 : 2 * pace.every + 5);
            steady = e.steady;
            line += fmt::format(" {:.2f} |", e.peak / e.steady);
        }
        flight.turn_deg = 0.5;
        const Errors moved = fly_errors(flight, {4, 4}, 9);
        std::printf("| %s | %.4f |%s %.2f |\n", row.name, steady, line.c_str(),
                    moved.peak / moved.steady);
        std::fflush(stdout);
    }
}

// ---- Times ---------------------------------------------------------------------------------

constexpr glm::uvec2 kLarge{1280, 720};

/// CPU seconds of each frame: what a host does between two pictures, without lighting the next.
std::vector<double> fly_times(const Flight& flight, const Pace& pace, int frames) {
    std::vector<double> out;
    std::vector<unsigned char> pixels(std::size_t(kLarge.x) * kLarge.y * 4);
    Session session = lit_session(flight, 0, 0, 1);
    for (int f = 0; f < frames; ++f) {
        Session next;
        const bool comes = f > 0 && f % pace.every == 0;
        if (comes) next = lit_session(flight, f, f, 1);
        const double start = pileus::cpu_seconds();
        if (comes) must(session.hand_over(next, std::uint32_t(pace.over)));
        must(session.set_camera(flight.camera(f)));
        must(session.set_frame(f));
        must(session.step(1));
        Frame frame;
        frame.colour = pixels.data();
        must(session.render(frame));
        out.push_back(pileus::cpu_seconds() - start);
    }
    return out;
}

/// The slowest frame after the first over the median; of each frame the quickest of some flights,
/// which others on the machine held up least.
double slowest_over_median(const Flight& flight, const Pace& pace, double& median) {
    constexpr int kFlights = 3;
    const int frames = pace.every == 40 ? 61 : 25;
    std::vector<double> least;
    for (int i = 0; i < kFlights; ++i) {
        const std::vector<double> took = fly_times(flight, pace, frames);
        if (least.empty()) least = took;
        for (std::size_t f = 0; f < took.size(); ++f) least[f] = std::min(least[f], took[f]);
    }
    std::vector<double> sorted(least.begin() + 1, least.end());
    std::sort(sorted.begin(), sorted.end());
    median = sorted[sorted.size() / 2];
    return sorted.back() / median;
}

void print_times(const std::string& only) {
    std::printf("\n| CPU time, slowest over median | median ms |");
    for (const Pace& p : kTimePaces) std::printf(" every %d over %d |", p.every, p.over);
    std::printf(" camera still: every 40 over 8 |\n|---|---|---|---|---|---|\n");
    for (const Row& row : rows()) {
        const std::string name = row.name;
        // A frame of paths takes what its host steps: seconds, beside which no mixture shows.
        if (name.find(only) == std::string::npos || name.find("path") == 0) continue;
        Flight flight{row.set, {128, 128, 88}, 0.5};
        flight.set.push_back(fmt::format("camera.resolution=[{},{}]", kLarge.x, kLarge.y));
        std::string line;
        double median = 0;
        for (const Pace& pace : kTimePaces)
            line += fmt::format(" {:.2f} |", slowest_over_median(flight, pace, median));
        const double steady = median;
        flight.turn_deg = 0;
        line += fmt::format(" {:.2f} |", slowest_over_median(flight, {40, 8}, median));
        std::printf("| %s | %.1f |%s\n", row.name, 1e3 * steady, line.c_str());
        std::fflush(stdout);
    }
}

}  // namespace

int main(int argc, char** argv) {
    std::string only;
    bool errors = true, times = true;
    for (int i = 1; i < argc; ++i) {
        const std::string a = argv[i];
        if (a == "--only" && i + 1 < argc)
            only = argv[++i];
        else if (a == "--errors")
            times = false;
        else if (a == "--times")
            errors = false;
        else
            return std::fprintf(stderr, "usage: living_table [--only NAME] [--errors|--times]\n"),
                   2;
    }
    if (errors) print_errors(only);
    if (times) print_times(only);
    return 0;
}
