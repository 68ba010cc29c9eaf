// SPDX-License-Identifier: Apache-2.0
// The six measurements of Palenik's thesis, appendix B, on this machine: time of a picture against
// texture size, integrator, powder, steps, resolution, coverage.
// in: a scene of a procedural sky, a folder, seconds -> out: Markdown, plots;
// docs/raymarch-table.md. What was measured is kept in the folder, so that a run goes on where one
// before it stopped.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "platform/threads.h"
#include "src/scene/read_scene.h"
#include "src/session/render.h"
#include "tools/study/plot.h"

namespace {

using namespace pileus;

constexpr int kRepeats = 2;

/// One setting of a chart: what it is called, where it stands on the x axis (0: nowhere).
struct Setting {
    std::string name;
    double x;
    std::vector<std::string> set;
};
struct Chart {
    const char *file, *title, *x_label, *found;  ///< what the thesis found, in words
    std::vector<Setting> settings;
};

std::string of(const char* key, const std::string& value) {
    return fmt::format("{}={}", key, value);
}

Chart texture_chart() {
    Chart c{"texture",
            "B.1 texture size",
            "texture edge, cells",
            "no noticeable impact up to two textures of 256 x 256 x 256",
            {}};
    for (int n : {32, 64, 128, 256})
        c.settings.push_back(
            {std::to_string(n), double(n), {of("medium.0.sky.size", std::to_string(n))}});
    return c;
}
Chart choice_chart(const char* file, const char* title, const char* found, const char* key,
                   const std::vector<std::string>& choices) {
    Chart c{file, title, "", found, {}};
    for (const std::string& choice : choices) c.settings.push_back({choice, 0, {of(key, choice)}});
    return c;
}
Chart number_chart(const char* file, const char* title, const char* x_label, const char* found,
                   const char* key, const std::vector<double>& values) {
    Chart c{file, title, x_label, found, {}};
    for (double v : values)
        c.settings.push_back({fmt::format("{}", v), v, {of(key, fmt::format("{}", v))}});
    return c;
}
Chart resolution_chart() {
    Chart c{"resolution", "B.5 resolution", "pixels", "grows with the number of pixels", {}};
    constexpr int kSizes[][2] = {{477, 247}, {953, 494}, {1280, 720}, {1906, 987}, {2560, 1440}};
    for (const auto& s : kSizes)
        c.settings.push_back({fmt::format("{}x{}", s[0], s[1]),
                              double(s[0]) * s[1],
                              {fmt::format("camera.resolution=[{},{}]", s[0], s[1])}});
    return c;
}

std::vector<Chart> all_charts() {
    return {
        texture_chart(),
        choice_chart("integrator", "B.2 integrator", "no relevant difference",
                     "raymarch.integrator",
                     {"riemann", "trapezoid", "simpson", "simpson38", "closed"}),
        choice_chart("powder", "B.3 powder variant", "no difference", "raymarch.powder",
                     {"none", "powder", "beer-powder", "directional"}),
        number_chart("steps", "B.4 steps", "steps", "linear in the number of steps",
                     "raymarch.steps", {16, 32, 64, 128, 256, 512}),
        resolution_chart(),
        number_chart("coverage", "B.6 coverage", "coverage", "depends strongly on the coverage",
                     "medium.0.sky.coverage", {0, 0.25, 0.5, 0.75, 1}),
    };
}

/// Of a picture, without what is made once for a scene: reading, textures, majorants.
struct Measured {
    double wall_ms = 0, cpu_ms = 0, samples = 0;
};

/// Stages that every picture of a flight pays again.
bool each_frame(const std::string& stage) {
    return stage == "march" || stage == "background" || stage == "layers";
}

Status measure(const std::string& file, std::vector<std::string> set, const Setting& setting,
               Measured& least) {
    set.insert(set.end(), setting.set.begin(), setting.set.end());
    Scene scene;
    PILEUS_TRY(read_scene_file(file, set, scene));
    for (int i = 0; i < kRepeats; ++i)
        PILEUS_TRY(render(scene, {}, [&](int, Image&, Report& report) {
            Measured m;
            for (const StageTime& s : report.clocks.stages)
                if (each_frame(s.name)) m.wall_ms += 1000 * s.wall_s, m.cpu_ms += 1000 * s.cpu_s;
            for (const auto& [name, count] : report.executed)
                if (name == "ray_samples" || name == "light_samples") m.samples += double(count);
            if (i == 0 || m.cpu_ms < least.cpu_ms) least = m;
            return Status::ok();
        }));
    return Status::ok();
}

/// Rows that earlier runs with the same keys have left, a line each; new ones are added.
class Kept {
public:
    Kept(const std::string& folder, const std::vector<std::string>& more)
        : file_(folder + "/rows.txt"), keys_("keys:") {
        for (const std::string& key : more) keys_ += " " + key;
        std::ifstream in(file_);
        std::string line;
        if (!std::getline(in, line) || line != keys_) return;
        while (std::getline(in, line)) {
            std::istringstream words(line);
            std::string chart, setting;
            Measured m;
            if (words >> chart >> setting >> m.wall_ms >> m.cpu_ms >> m.samples)
                rows_[chart + " " + setting] = m;
        }
    }
    const Measured* find(const Chart& chart, const Setting& setting) const {
        const auto found = rows_.find(std::string(chart.file) + " " + setting.name);
        return found == rows_.end() ? nullptr : &found->second;
    }
    /// False where the file cannot be written.
    bool add(const Chart& chart, const Setting& setting, const Measured& m) {
        rows_[std::string(chart.file) + " " + setting.name] = m;
        std::ofstream out(file_);
        out << keys_ << "\n";
        for (const auto& [name, row] : rows_)
            out << fmt::format("{} {} {} {}\n", name, row.wall_ms, row.cpu_ms, row.samples);
        out.flush();
        return bool(out);
    }

private:
    std::string file_, keys_;
    std::map<std::string, Measured> rows_;
};

void print_chart(const Chart& chart, const std::vector<Measured>& measured) {
    fmt::print("## {}\n\nThe thesis: {}.\n\n", chart.title, chart.found);
    fmt::print(
        "| setting | wall ms | CPU ms | million samples | CPU ns a sample "
        "|\n|---|---|---|---|---|\n");
    for (std::size_t i = 0; i < measured.size(); ++i) {
        const Measured& m = measured[i];
        fmt::print("| {} | {:.0f} | {:.0f} | {:.1f} | {} |\n", chart.settings[i].name, m.wall_ms,
                   m.cpu_ms, 1e-6 * m.samples,
                   m.samples > 0 ? fmt::format("{:.1f}", 1e6 * m.cpu_ms / m.samples) : "-");
    }
    fmt::print("\n");
}

Status plot_chart(const Chart& chart, const std::vector<Measured>& measured,
                  const std::string& folder) {
    Plot plot;
    plot.title = chart.title;
    plot.x_label = chart.x_label, plot.y_label = "CPU milliseconds of a picture";
    PlotSeries series;
    series.label = "here";
    for (std::size_t i = 0; i < measured.size(); ++i) {
        const double y = measured[i].cpu_ms;
        series.points.push_back({chart.settings[i].x, y, y, y, false});
    }
    plot.series.push_back(series);
    return write_drawing(folder + "/raymarch_" + chart.file, draw_plot(plot));
}

/// Measures what `kept` lacks; `done` is false where the seconds ended it.
Status measure_all(const std::string& scene, const std::vector<std::string>& more, double seconds,
                   Kept& kept, bool& done) {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    done = false;
    for (const Chart& chart : all_charts())
        for (const Setting& setting : chart.settings) {
            if (kept.find(chart, setting) != nullptr) continue;
            if (std::chrono::duration<double>(Clock::now() - begin).count() > seconds)
                return Status::ok();
            Measured m;
            PILEUS_TRY(measure(scene, more, setting, m));
            fmt::print(stderr, "{}: {}\n", chart.title, setting.name);
            if (!kept.add(chart, setting, m))
                return {Code::kIo, "raymarch_table: rows.txt cannot be written"};
        }
    done = true;
    return Status::ok();
}

Status run(const std::string& scene, const std::string& folder, double seconds,
           const std::vector<std::string>& more) {
    Kept kept(folder, more);
    bool done = false;
    PILEUS_TRY(measure_all(scene, more, seconds, kept, done));
    if (!done) {
        fmt::print(stderr, "not done: call again to go on\n");
        return Status::ok();
    }
    fmt::print("{} threads; the least of {} runs.\n\n", hardware_threads(), kRepeats);
    for (const Chart& chart : all_charts()) {
        std::vector<Measured> measured;
        for (const Setting& setting : chart.settings)
            measured.push_back(*kept.find(chart, setting));
        print_chart(chart, measured);
        // Choices have no place on an axis.
        if (chart.x_label[0] != '\0') PILEUS_TRY(plot_chart(chart, measured, folder));
    }
    return Status::ok();
}

}  // namespace

int main(int argc, char** argv) {
    const double seconds = argc < 4 ? 0 : std::atof(argv[3]);
    if (!(seconds > 0)) {
        fmt::print(stderr, "usage: pileus_raymarch_table SCENE FOLDER SECONDS [key=value ...]\n");
        return 2;
    }
    const Status status = run(argv[1], argv[2], seconds, {argv + 4, argv + argc});
    if (!status) fmt::print(stderr, "{}\n", status.message);
    return int(status.code);
}
