// SPDX-License-Identifier: Apache-2.0
// What one frame costs after the other: sessions and animations over a scene, camera and sun
// moving. in: a scene, frames, threads, names of ways -> out: a table of ms per frame and shares of
// stages. docs/realtime.md
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "platform/clock.h"
#include "platform/team/teams.h"
#include "platform/threads.h"
#include "src/base/angles.h"
#include "src/scene/read_scene.h"
#include "src/session/session.h"

namespace {

using namespace pileus;
using Overrides = std::vector<std::string>;

constexpr double kOrbitDeg = 0.5, kSunDeg = 0.1;  // between two frames

struct Way {
    const char* name;
    Overrides overrides;
    const char* scene = nullptr;   ///< null: that of the arguments
    double orbit_deg = kOrbitDeg;  ///< between two frames
};

const std::vector<Way>& ways() {
    static const std::vector<Way> all{
        {"march", {"method.name=\"collectors\"", "collectors.display=\"march\""}},
        {"billboards", {"method.name=\"collectors\"", "collectors.display=\"billboards\""}},
        {"quick march",
         {"method.name=\"collectors\"", "collectors.scale=4", "collectors.light_refresh=8",
          "collectors.photons=1000000"}},
        {"quick billboards",
         {"method.name=\"collectors\"", "collectors.display=\"billboards\"",
          "collectors.light_refresh=8", "collectors.photons=1000000"}},
        {"octaves", {"method.name=\"raymarch\"", "raymarch.scattering=\"octaves\""}},
        {"temporal",
         {"method.name=\"raymarch\"", "raymarch.scattering=\"octaves\"", "raymarch.temporal=4",
          "raymarch.steps=96"}},
        // A broken sky, 13 m a frame (docs/upsampling.md).
        {"sky",
         {"raymarch.scattering=\"octaves\"", "raymarch.temporal=4", "raymarch.steps=96",
          "raymarch.stop_below=0.003", "raymarch.light=\"auto\"", "raymarch.light_steps=5",
          "raymarch.light_first_step_m=40", "raymarch.light_growth=2", "raymarch.light_refresh=8"},
         PILEUS_SCENES "/../studies/scenes/sky_flight.toml",
         0.1}};
    return all;
}

/// What drives the frames: a host's session, or the program's own animation, whose report hashes
/// each stage or does not.
enum class Driver { kSession, kAnimation, kDigests };
constexpr const char* kDriverNames[] = {"session", "animation", "animation, digests"};

struct Cost {
    double wall_ms = 0, cpu_ms = 0;
};

struct Frame {
    Cost total;
    std::uint32_t level = 0;  ///< of the governor's ladder
    std::map<std::string, Cost> stages;
};

struct Arguments {
    std::string scene = PILEUS_SCENES "/cumulus.toml";
    std::string only;  ///< part of a row's name
    int frames = 60, threads = 0;
    int fps = 0;  ///< > 0: the governor chooses each frame's work for so many frames a second
    bool small = false;  ///< a long flight through a small scene: memory and time of late frames
    Overrides overrides;
};

/// Stages add up over frames: what one frame brought is the difference.
class Stopwatch {
public:
    void start(const Report& report) {
        before_ = sums(report);
        wall_ = wall_seconds();
        cpu_ = cpu_seconds();
    }
    Frame stop(const Report& report) const {
        Frame frame;
        frame.total = {(wall_seconds() - wall_) * 1e3, (cpu_seconds() - cpu_) * 1e3};
        for (const auto& [name, cost] : sums(report)) {
            const auto found = before_.find(name);
            const Cost old = found == before_.end() ? Cost{} : found->second;
            frame.stages[name] = {cost.wall_ms - old.wall_ms, cost.cpu_ms - old.cpu_ms};
        }
        return frame;
    }

private:
    static std::map<std::string, Cost> sums(const Report& report) {
        std::map<std::string, Cost> out;
        for (const StageTime& s : report.clocks.stages)
            out[s.name] = {s.wall_s * 1e3, s.cpu_s * 1e3};
        return out;
    }
    std::map<std::string, Cost> before_;
    double wall_ = 0, cpu_ = 0;
};

/// The camera of frame f, turned by so much in each, and a sun so much higher than the scene's.
Status set_pose(const Scene& scene, int f, double orbit_deg, double higher_deg, Session& session) {
    const Double3 from = scene.camera.position_m, to = scene.camera.target_m;
    Camera camera = scene.camera;
    const auto turn = sincos_deg(std::fmod(orbit_deg * f, 360.0));
    const double x = from.x - to.x, y = from.y - to.y;
    camera.position_m = {to.x + x * turn.cosine - y * turn.sine,
                         to.y + x * turn.sine + y * turn.cosine, from.z};
    PILEUS_TRY(session.set_camera(camera));
    Sun sun = scene.sun;
    sun.elevation_deg += higher_deg;
    return session.set_sun(sun);
}

Status fly_session(const Scene& scene, const Arguments& arguments, double orbit_deg, bool sun_moves,
                   std::vector<Frame>& frames) {
    RenderOptions options;
    options.threads = arguments.threads;
    Session session;
    PILEUS_TRY(session.open(scene, options, true, nullptr));
    const auto& size = scene.camera.resolution;
    std::vector<unsigned char> colour(std::size_t(4) * std::size_t(size[0]) * std::size_t(size[1]));
    FrameTarget target;
    target.has_colour = true;
    target.colour.rows = {colour.data(), std::int64_t(4) * size[0], false};
    Stopwatch watch;
    const std::vector<FrameWork> ladder = session.work_levels();
    Governor governor;
    if (arguments.fps > 0) governor.target_s = 1.0 / arguments.fps;
    // Frame 0 makes what stays.
    for (int f = 0; f <= arguments.frames; ++f) {
        const double last_s = f > 1 ? frames.back().total.wall_ms * 1e-3 : 0;
        if (arguments.fps > 0) PILEUS_TRY(session.set_work(govern(ladder, last_s, governor)));
        watch.start(session.report());
        PILEUS_TRY(set_pose(scene, f, orbit_deg, sun_moves ? kSunDeg * f : 0, session));
        PILEUS_TRY(session.set_frame(f));
        const std::uint64_t units = f == 0 ? session.light().whole : sun_moves ? 1 : 0;
        std::uint64_t done = 0;
        PILEUS_TRY(session.step(units, done));
        PILEUS_TRY(session.render(target));
        if (f > 0) frames.push_back(watch.stop(session.report()));
        if (f > 0) frames.back().level = governor.level;
    }
    return Status::ok();
}

Status fly_animation(const Scene& still, const Arguments& arguments, double orbit_deg,
                     bool sun_moves, bool digests, std::vector<Frame>& frames) {
    Scene scene = still;
    const double last = arguments.frames, low = still.sun.elevation_deg;
    scene.animation.present = scene.animation.moves_camera = true;
    scene.animation.frames = arguments.frames + 1;
    scene.animation.camera_orbit_deg = {0, orbit_deg * last};
    scene.animation.moves_sun = sun_moves;
    scene.animation.sun_elevation_deg = {low, low + kSunDeg * last};
    RenderOptions options;
    options.threads = arguments.threads;
    options.digests = digests;
    options.last_frame = arguments.frames;
    Stopwatch watch;
    // From one frame's picture to the next one's: files are not written.
    return render(scene, options, [&](int f, Image&, Report& report) {
        if (f > 0) frames.push_back(watch.stop(report));
        watch.start(report);
        return Status::ok();
    });
}

/// MB that the process has in memory now; 0 where the system does not tell.
double resident_mb() {
    long pages = 0, ignored = 0;
    if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
        if (std::fscanf(file, "%ld %ld", &ignored, &pages) != 2) pages = 0;
        std::fclose(file);
    }
    return double(pages) * double(::sysconf(_SC_PAGESIZE)) * 1e-6;
}

/// Prints memory and time of each tenth of a flight, the sun between its place and 30 degrees more.
Status fly_small(const Way& way, const Arguments& arguments) {
    Overrides overrides = way.overrides;
    for (const char* o : {"camera.resolution=[32,18]", "medium.0.resolution=[24,24,24]",
                          "collectors.photons=1600", "collectors.generations=8",
                          "collectors.samples=500", "output.layers=[\"radiance\",\"alpha\"]"})
        overrides.push_back(o);
    overrides.insert(overrides.end(), arguments.overrides.begin(), arguments.overrides.end());
    Scene scene;
    PILEUS_TRY(read_scene_file(arguments.scene, overrides, scene));
    RenderOptions options;
    options.threads = arguments.threads;
    Session session;
    PILEUS_TRY(session.open(scene, options, true, nullptr));
    std::vector<unsigned char> colour(4 * std::size_t(scene.camera.resolution[0]) *
                                      std::size_t(scene.camera.resolution[1]));
    FrameTarget target;
    target.has_colour = true;
    target.colour.rows = {colour.data(), std::int64_t(4) * scene.camera.resolution[0], false};
    const int part = arguments.frames < 10 ? 1 : arguments.frames / 10;
    double wall = wall_seconds(), cpu = cpu_seconds();
    for (int f = 0; f <= arguments.frames; ++f) {
        const int turn = f % 600;
        PILEUS_TRY(
            set_pose(scene, f, kOrbitDeg, kSunDeg * (turn < 300 ? turn : 600 - turn), session));
        PILEUS_TRY(session.set_frame(f));
        std::uint64_t done = 0;
        PILEUS_TRY(session.step(f == 0 ? session.light().whole : 1, done));
        PILEUS_TRY(session.render(target));
        if (f % part != 0) continue;
        const double frames = f == 0 ? 1 : part;
        std::printf("| %s | %d | %.3f | %.3f | %.2f |\n", way.name, f,
                    (wall_seconds() - wall) / frames * 1e3, (cpu_seconds() - cpu) / frames * 1e3,
                    resident_mb());
        std::fflush(stdout);
        wall = wall_seconds(), cpu = cpu_seconds();
    }
    return Status::ok();
}

Status fly_all_small(const Arguments& arguments) {
    std::printf(
        "| frames | up to frame | wall ms | CPU ms | resident MB |\n|---|---|---|---|---|\n");
    for (const Way& way : ways())
        if (std::string(way.name).find(arguments.only) != std::string::npos)
            PILEUS_TRY(fly_small(way, arguments));
    return Status::ok();
}

/// Of numbers sorted by this: the one below which that share of them lies.
double quantile(std::vector<double> values, double share) {
    std::sort(values.begin(), values.end());
    return values[std::size_t(share * double(values.size() - 1) + 0.5)];
}

template <class Number>
double quantile_of(const std::vector<Frame>& frames, double share, Number number) {
    std::vector<double> values;
    for (const Frame& frame : frames) values.push_back(number(frame));
    return quantile(values, share);
}

void print_row(const std::string& name, const std::vector<Frame>& frames) {
    Cost all, staged;
    std::map<std::string, double> stages;
    for (const Frame& frame : frames) {
        all.wall_ms += frame.total.wall_ms;
        all.cpu_ms += frame.total.cpu_ms;
        for (const auto& [stage, cost] : frame.stages) {
            staged.wall_ms += cost.wall_ms;
            staged.cpu_ms += cost.cpu_ms;
            stages[stage] += cost.cpu_ms;
        }
    }
    std::vector<std::pair<double, std::string>> sorted;
    for (const auto& [stage, cpu] : stages) sorted.emplace_back(cpu / all.cpu_ms, stage);
    std::sort(sorted.rbegin(), sorted.rend());
    std::string shares;
    for (const auto& [share, stage] : sorted)
        if (share >= 0.005) {
            char text[80];
            std::snprintf(text, sizeof text, "%s%s %.0f", shares.empty() ? "" : ", ", stage.c_str(),
                          100 * share);
            shares += text;
        }
    const auto wall = [](const Frame& f) { return f.total.wall_ms; };
    const auto cpu = [](const Frame& f) { return f.total.cpu_ms; };
    std::printf("| %s | %.1f | %.1f | %.1f | %.1f | %s | %.1f |\n", name.c_str(),
                quantile_of(frames, 0.5, wall), quantile_of(frames, 0.99, wall),
                quantile_of(frames, 0.5, cpu), quantile_of(frames, 0.99, cpu), shares.c_str(),
                100 * (1 - staged.wall_ms / all.wall_ms));
    std::fflush(stdout);
}

/// How many frames had which of the governor's levels, and which were late.
void print_levels(int fps, const std::vector<Frame>& frames) {
    std::map<std::uint32_t, int> levels;
    int late = 0;
    for (const Frame& frame : frames) {
        ++levels[frame.level];
        late += frame.total.wall_ms > 1e3 / fps;
    }
    std::string text;
    for (const auto& [level, count] : levels)
        text += " " + std::to_string(level) + " (" + std::to_string(count) + " frames)";
    std::printf("governed for %d frames a second: %d late; levels%s\n", fps, late, text.c_str());
}

Status fly(const Arguments& arguments) {
    std::printf(
        "| frames | wall ms | 99th | CPU ms | 99th | %% of CPU in stages | %% of wall in "
        "none |\n|---|---|---|---|---|---|---|\n");
    for (const Way& way : ways())
        for (const Driver driver : {Driver::kSession, Driver::kAnimation, Driver::kDigests})
            for (const bool sun_moves : {false, true}) {
                const std::string name = std::string(way.name) + ", " + kDriverNames[int(driver)] +
                                         (sun_moves ? ", sun moves" : "");
                if (name.find(arguments.only) == std::string::npos) continue;
                Overrides overrides = way.overrides;
                overrides.push_back("camera.resolution=[1280,720]");
                overrides.push_back("output.layers=[\"radiance\",\"alpha\"]");
                overrides.insert(overrides.end(), arguments.overrides.begin(),
                                 arguments.overrides.end());
                Scene scene;
                PILEUS_TRY(read_scene_file(way.scene != nullptr ? way.scene : arguments.scene,
                                           overrides, scene));
                std::vector<Frame> frames;
                PILEUS_TRY(driver == Driver::kSession
                               ? fly_session(scene, arguments, way.orbit_deg, sun_moves, frames)
                               : fly_animation(scene, arguments, way.orbit_deg, sun_moves,
                                               driver == Driver::kDigests, frames));
                print_row(name, frames);
                if (arguments.fps > 0 && driver == Driver::kSession)
                    print_levels(arguments.fps, frames);
            }
    return Status::ok();
}

bool read_count(const char* text, int& count) {
    char* end = nullptr;
    const long value = std::strtol(text, &end, 10);
    count = int(value);
    return *end == 0 && value >= 1 && value <= 100000;
}

bool read_arguments(int count, char** words, Arguments& out) {
    for (int i = 1; i < count; i += 2) {
        const std::string word = words[i];
        if (word == "--small") {
            out.small = true;
            --i;
            continue;
        }
        if (i + 1 >= count) return false;
        const char* value = words[i + 1];
        if (word == "--scene")
            out.scene = value;
        else if (word == "--only")
            out.only = value;
        else if (word == "--set")
            out.overrides.push_back(value);
        else if (word == "--frames" || word == "--threads" || word == "--fps") {
            int& count_of = word == "--frames"    ? out.frames
                            : word == "--threads" ? out.threads
                                                  : out.fps;
            if (!read_count(value, count_of)) return false;
        } else
            return false;
    }
    return true;
}

}  // namespace

int main(int count, char** words) {
    const TeamChoice team = start_team(words);
    Arguments arguments;
    if (!read_arguments(count, words, arguments)) {
        std::fprintf(
            stderr,
            "usage: pileus_realtime [--frames 1-100000] [--threads 1-100000] [--fps 1-100000] "
            "[--scene FILE] [--only PART-OF-A-NAME] [--small] [--set KEY=VALUE]...\n");
        return 2;
    }
    ThreadPool threads(team.kind);
    const PoolGuard lent(threads);
    std::printf("%d frames after the first, threads: %s\n\n", arguments.frames, threads.name());
    const Status status = arguments.small ? fly_all_small(arguments) : fly(arguments);
    if (!status) std::fprintf(stderr, "%s\n", status.message.c_str());
    return int(status.code);
}
