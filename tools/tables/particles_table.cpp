// SPDX-License-Identifier: Apache-2.0
// The measurements of Monette and Whitehead 2014 on this machine: times of light and pictures of
// particles against their number, lights, size of picture, coarseness, share that casts shadows;
// how much pictures flicker.
// in: a folder for pictures -> out: Markdown tables for docs/particles-table.md, PNG files.
#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <vector>

#include "kernels_cpu/core/rng.h"
#include "platform/threads.h"
#include "src/io/images/image_file.h"
#include "src/scene/media/host_media.h"
#include "src/scene/read_scene.h"
#include "src/session/render.h"
#include "tools/tables/particle_weights.h"

namespace {

using namespace pileus;
using Settings = std::vector<std::string>;

constexpr const char* kScene = R"(
[camera]
position_m = [0, -1800, 900]
target_m = [0, 0, 900]
fov_deg = 30
resolution = [1280, 720]
[sun]
azimuth_deg = 65
elevation_deg = 38
[[medium]]
density = "host.ply"
phase = { type = "henyey-greenstein", g = 0.6 }
[method]
name = "particles"
[particles]
light = "centre"
)";

/// An ellipsoid of 600 x 600 x 400 m, filled evenly, about 12 particles over each other at every
/// place; they move outwards and up.
struct Cloud {
    std::vector<float> position, velocity, radius, density;
    std::vector<std::uint64_t> id;

    explicit Cloud(std::uint64_t count) {
        double spacing = 1;
        while (spacing * spacing * spacing * double(count) > 8) spacing *= 0.999;
        const Key key = make_key(3, 1, 0);
        std::uint32_t drawn = 0;
        const auto draw = [&] {
            const auto words = threefry<std::uint32_t>(key.k0, key.k1, drawn / 2, 0);
            return double(uniform(drawn++ % 2 == 0 ? words.a : words.b));
        };
        while (radius.size() < count) {
            const double p[3] = {2 * draw() - 1, 2 * draw() - 1, 2 * draw() - 1};
            const double size = 0.7 + 0.6 * draw();
            if (p[0] * p[0] + p[1] * p[1] + p[2] * p[2] >= 1) continue;
            for (const double v : {300 * p[0], 300 * p[1], 200 * p[2] + 900})
                position.push_back(float(v));
            for (const double v : {20 * p[0], 20 * p[1], 25 + 10 * p[2]})
                velocity.push_back(float(v));
            radius.push_back(float(300 * spacing * size));
            density.push_back(0.02f);
        }
    }
    /// Numbers, and all of it after so many seconds: moved along, and grown by a tenth a second.
    Cloud after(double seconds, bool numbered) const {
        Cloud moved = *this;
        for (std::size_t i = 0; i < position.size(); ++i)
            moved.position[i] = float(double(position[i]) + seconds * double(velocity[i]));
        for (float& r : moved.radius) r = float(double(r) * (1 + 0.1 * seconds));
        for (std::uint64_t i = 0; i < radius.size() && numbered; ++i) moved.id.push_back(i);
        return moved;
    }
    HostParticles host() const {
        HostParticles h;
        h.count = radius.size();
        h.position = position.data(), h.position_stride = 3 * sizeof(float);
        h.velocity = velocity.data(), h.velocity_stride = 3 * sizeof(float);
        h.radius = radius.data(), h.radius_stride = sizeof(float);
        h.density = density.data(), h.density_stride = sizeof(float);
        if (!id.empty()) h.id = id.data(), h.id_stride = sizeof(std::uint64_t);
        return h;
    }
};

/// In place of the file of a scene's one medium; `host` outlives it.
HostMedia in_place_of(const HostParticles& host) {
    MediumValues own;
    own.particles = &host;
    return {{own}};
}

constexpr std::uint64_t kFlickering = 20'000;
constexpr int kFlickerFrames = 12;

struct Times {
    double tree_s = 0, light_s = 0, lights_s = 0, show_s = 0;
};

class Tables {
public:
    Tables(std::string folder, int threads) : folder_(std::move(folder)), threads_(threads) {}

    Status run() {
        by_weights();
        PILEUS_TRY(by_particles());
        PILEUS_TRY(by_lights());
        PILEUS_TRY(by_frame());
        PILEUS_TRY(by_coarseness());
        PILEUS_TRY(by_occluders());
        PILEUS_TRY(by_display());
        PILEUS_TRY(flicker());
        return pictures();
    }

private:
    /// Depths of segments by the paper's weighting against exact ones.
    static void by_weights() {
        const Cloud cloud(20'000);
        std::vector<WeighedBall> balls;
        std::vector<WeighedRay> to_sun, eye;
        for (std::size_t i = 0; i < cloud.radius.size(); ++i) {
            const float* p = cloud.position.data() + 3 * i;
            balls.push_back({{double(p[0]), double(p[1]), double(p[2])},
                             double(cloud.radius[i]),
                             double(cloud.density[i])});
            if (i >= 1000) continue;
            to_sun.push_back({{double(p[0]), double(p[1]), double(p[2])}, {0.72, 0.33, 0.61}});
            eye.push_back({{double(p[0]), -1800, double(p[2])}, {0, 1, 0}});
            WeighedRay& r = to_sun.back();
            double square = 0;
            for (const double v : r.way) square += v * v;
            for (double& v : r.way) v /= std::sqrt(square);
        }
        fmt::print("\n## The paper's own weighting, 20 000 particles, 1000 segments\n");
        fmt::print(
            "| segments | spread, radii | bias | rms error | largest | rms error of e^-depth ");
        fmt::print("|\n|---|---|---|---|---|---|\n");
        weigh("from particles' middles", balls, to_sun);
        weigh("through all", balls, eye);
        std::fflush(stdout);
    }

    Status measure(const Cloud& cloud, const Settings& set, const std::string& lights,
                   const std::string& picture, Times& t) {
        Scene scene;
        PILEUS_TRY(read_scene_text(kScene + lights, "table", "", set, scene));
        const HostParticles host = cloud.host();
        const HostMedia media = in_place_of(host);
        RenderOptions options;
        options.media = &media;
        options.threads = threads_;
        t = Times{};
        return render(scene, options, [&](int, Image& image, Report& report) {
            for (const StageTime& s : report.clocks.stages) {
                const std::string name = s.name;
                if (name == "octree") t.tree_s += s.wall_s;
                if (name == "light") t.light_s += s.wall_s;
                if (name == "lights" || name == "light of lights") t.lights_s += s.wall_s;
                if (name == "march" || name == "blend") t.show_s += s.wall_s;
            }
            return picture.empty() ? Status::ok() : write_image(image, folder_ + picture, {});
        });
    }
    static void head(const char* title, const char* columns) {
        int count = 0;
        for (const char* c = columns; *c != 0; ++c) count += *c == '|' ? 1 : 0;
        fmt::print("\n## {}\n\n{}\n|", title, columns);
        for (int i = 1; i < count; ++i) fmt::print("---|");
        fmt::print("\n");
    }
    static const char* boards() { return "particles.display=billboards"; }

    Status by_particles() {
        head("Particles, one light (figure 7a)",
             "| particles | octree | light, one place | light, four places | march | billboards |");
        for (const std::uint64_t n :
             {10'000u, 50'000u, 100'000u, 250'000u, 500'000u, 1'000'000u, 3'000'000u}) {
            const Cloud cloud(n);
            Times centre, linear;
            PILEUS_TRY(measure(cloud, {boards()}, "", "", centre));
            PILEUS_TRY(measure(cloud, {"particles.light=linear"}, "",
                               fmt::format("/particles_{}.png", n), linear));
            fmt::print("| {} | {:.3f} | {:.3f} | {:.3f} | {:.3f} | {:.3f} |\n", n, centre.tree_s,
                       centre.light_s, linear.light_s, linear.show_s, centre.show_s);
            std::fflush(stdout);
        }
        return Status::ok();
    }
    Status by_lights() {
        head("Lights, 250 000 particles (figure 7b)", "| lights | parallel | points |");
        const Cloud cloud(250'000);
        for (const int n : {1, 2, 4, 8, 16}) {
            std::string parallel, points;
            for (int i = 0; i < n; ++i) {
                parallel += fmt::format(
                    "[[light]]\ntype = \"directional\"\nazimuth_deg = {}\nelevation_deg = "
                    "30\nirradiance = 0.2\n",
                    360 * i / n);
                points += fmt::format(
                    "[[light]]\ntype = \"point\"\nposition_m = [{}, -500, {}]\nintensity = 1e5\n",
                    60 * i - 400, 700 + 30 * i);
            }
            Times a, b;
            const Settings set = {boards(), "camera.resolution=[320, 180]", "sun.irradiance=0"};
            PILEUS_TRY(measure(cloud, set, parallel, "", a));
            PILEUS_TRY(measure(cloud, set, points, fmt::format("/lights_{}.png", n), b));
            fmt::print("| {} | {:.3f} | {:.3f} |\n", n, a.lights_s, b.lights_s);
            std::fflush(stdout);
        }
        return Status::ok();
    }
    Status by_frame() {
        head("Size of the picture, 250 000 particles (figure 8a)",
             "| pixels | march | billboards |");
        const Cloud cloud(250'000);
        for (const int height : {180, 360, 720, 1080}) {
            Times a, b;
            const std::string size =
                fmt::format("camera.resolution=[{}, {}]", height * 16 / 9, height);
            PILEUS_TRY(measure(cloud, {size}, "", "", a));
            PILEUS_TRY(measure(cloud, {size, boards()}, "", "", b));
            fmt::print("| {} x {} | {:.3f} | {:.3f} |\n", height * 16 / 9, height, a.show_s,
                       b.show_s);
            std::fflush(stdout);
        }
        return Status::ok();
    }
    Status by_coarseness() {
        head("Particles of a leaf, 1 000 000 particles (figure 8b)",
             "| most in a leaf | octree | sun, by tiles | point light, by walks |");
        const Cloud cloud(1'000'000);
        const std::string lamp =
            "[[light]]\ntype = \"point\"\nposition_m = [300, -500, 1200]\nintensity = 1e5\n";
        for (const int leaf : {2, 4, 8, 16, 32, 64, 128}) {
            Times t;
            PILEUS_TRY(measure(
                cloud,
                {fmt::format("particles.leaf={}", leaf), boards(), "camera.resolution=[320, 180]"},
                lamp, "", t));
            fmt::print("| {} | {:.3f} | {:.3f} | {:.3f} |\n", leaf, t.tree_s, t.light_s,
                       t.lights_s);
            std::fflush(stdout);
        }
        return Status::ok();
    }
    Status by_occluders() {
        head("Share that casts shadows, 3 000 000 particles, all lit (table 3)",
             "| share | paper, s | Krakatoa, s | here, s |");
        const Cloud cloud(3'000'000);
        struct Row {
            double share, paper_s, krakatoa_s;
        };
        for (const Row& row : {Row{1, 10.4, 17.8}, Row{0.5, 5.5, 9.0}, Row{0.1, 3.5, 2.2}}) {
            Times t;
            PILEUS_TRY(measure(cloud, {fmt::format("particles.occluders={}", row.share), boards()},
                               "", fmt::format("/occluders_{}.png", row.share), t));
            fmt::print("| {} | {} | {} | {:.2f} |\n", row.share, row.paper_s, row.krakatoa_s,
                       t.light_s);
            std::fflush(stdout);
        }
        return Status::ok();
    }
    Status by_display() {
        head("Shown size, 250 000 particles as billboards (figures 11, 12)",
             "| display_scale | light | picture |");
        const Cloud cloud(250'000);
        for (const double scale : {0.5, 1.0, 1.5, 2.0, 3.0}) {
            Times t;
            PILEUS_TRY(measure(cloud, {fmt::format("particles.display_scale={}", scale), boards()},
                               "", fmt::format("/display_{}.png", scale), t));
            fmt::print("| {} | {:.3f} | {:.3f} |\n", scale, t.light_s, t.show_s);
            std::fflush(stdout);
        }
        return Status::ok();
    }
    /// A sequence of pictures, green, one behind the other.
    Status film(const Settings& set, bool numbered, std::vector<std::vector<float>>& frames) {
        const Cloud cloud(kFlickering);
        frames.clear();
        for (int f = 0; f < kFlickerFrames; ++f) {
            const Cloud now = cloud.after(f / 25.0, numbered);
            Scene scene;
            PILEUS_TRY(read_scene_text(kScene, "table", "", set, scene));
            const HostParticles host = now.host();
            const HostMedia media = in_place_of(host);
            RenderOptions options;
            options.media = &media;
            options.threads = threads_;
            PILEUS_TRY(render(scene, options, [&](int, Image& image, Report&) {
                const Channel* green = image.find("G");
                frames.emplace_back(green->pixels.data(),
                                    green->pixels.data() + green->pixels.size());
                return Status::ok();
            }));
        }
        return Status::ok();
    }
    /// What flickers of the difference from a converged sequence: its second difference from frame
    /// to frame, over the mean radiance of the cloud's pixels.
    static double flicker_of(const std::vector<std::vector<float>>& own,
                             const std::vector<std::vector<float>>& truth) {
        double sum = 0, light = 0, pixels = 0;
        for (std::size_t f = 1; f + 1 < own.size(); ++f)
            for (std::size_t i = 0; i < own[f].size(); ++i) {
                if (!(truth[f][i] > 0)) continue;
                const auto error = [&](std::size_t at) {
                    return double(own[at][i]) - double(truth[at][i]);
                };
                const double change = error(f - 1) - 2 * error(f) + error(f + 1);
                sum += change * change, light += double(truth[f][i]), pixels += 1;
            }
        return __builtin_sqrt(sum / pixels) / (light / pixels);
    }
    Status flicker() {
        head("Flicker, 20 000 particles that move and grow, 12 frames of 1/25 s",
             "| settings | flicker | relMSE |");
        const Settings small = {"camera.resolution=[320, 180]"};
        const auto with = [&](std::initializer_list<const char*> keys) {
            Settings own = small;
            own.insert(own.end(), keys.begin(), keys.end());
            return own;
        };
        std::vector<std::vector<float>> truth, own;
        PILEUS_TRY(film(with({"particles.light=exact", "particles.bins=512"}), false, truth));
        struct Row {
            const char* name;
            Settings set;
            bool numbered;
        };
        const Row rows[] = {
            {"exact, 64 bins", with({"particles.light=exact", "particles.bins=64"}), false},
            {"linear, 256 bins", with({"particles.light=linear"}), false},
            {"linear, 64 bins", with({"particles.light=linear", "particles.bins=64"}), false},
            {"centre, 256 bins", small, false},
            {"billboards, linear", with({boards(), "particles.light=linear"}), false},
            {"billboards, centre", with({boards()}), false},
            {"a half casts shadows, chosen anew each frame",
             with({"particles.light=linear", "particles.occluders=0.5"}), false},
            {"a half casts shadows, chosen by numbers",
             with({"particles.light=linear", "particles.occluders=0.5"}), true},
            {"a half is there, chosen by numbers",
             with({"particles.light=linear", R"(medium.0.density={file="host.ply",share=0.5})"}),
             true},
            {"a half is there, chosen anew each frame",
             with({"particles.light=linear", R"(medium.0.density={file="host.ply",share=0.5})"}),
             false},
        };
        for (const Row& row : rows) {
            PILEUS_TRY(film(row.set, row.numbered, own));
            double error = 0, light = 0;
            for (std::size_t f = 0; f < own.size(); ++f)
                for (std::size_t i = 0; i < own[f].size(); ++i) {
                    const double d = double(own[f][i]) - double(truth[f][i]);
                    error += d * d, light += double(truth[f][i]) * double(truth[f][i]);
                }
            fmt::print("| {} | {:.5f} | {:.4f} |\n", row.name, flicker_of(own, truth),
                       error / light);
            std::fflush(stdout);
        }
        return Status::ok();
    }
    /// Sharp, blurred, focused (figure 6).
    Status pictures() {
        const Cloud cloud(20'000);
        Times t;
        const Settings set = {boards(), "camera.resolution=[480, 360]",
                              "particles.scattering=octaves"};
        const auto with = [&](const char* key) {
            Settings own = set;
            own.emplace_back(key);
            return own;
        };
        PILEUS_TRY(measure(cloud, set, "", "/sharp.png", t));
        PILEUS_TRY(measure(cloud, with("camera.shutter_s=2"), "", "/blurred.png", t));
        Settings lens = with("camera.aperture_radius_m=60");
        lens.emplace_back("camera.focus_distance_m=1500");
        return measure(cloud, lens, "", "/focused.png", t);
    }

    std::string folder_;
    int threads_;
};

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        fmt::print(stderr, "usage: pileus_particles_table FOLDER\n");
        return 2;
    }
    const Status status = Tables(argv[1], hardware_threads()).run();
    if (!status) fmt::print(stderr, "{}\n", status.message);
    return int(status.code);
}
