// SPDX-License-Identifier: Apache-2.0
// A cloud that lives: a worker prepares and lights the next density while the loop draws.
// in: a scene file, frames, a file for the last picture -> out: a line with the hash of each
// picture, a PPM file docs/living.md explains each step. Needs pileus.hpp, GLM's headers and
// threads.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <pileus/pileus.hpp>
#include <string>
#include <thread>
#include <vector>

namespace {

using namespace pileus::embed;

constexpr glm::uvec2 kSize{160, 90};
constexpr glm::uvec3 kCells{48, 48, 32};
constexpr int kEvery = 6;           // frames from one density to the next
constexpr std::uint32_t kOver = 4;  // pictures over which it comes in

void must(const Status& status) {
    if (status) return;
    std::fprintf(stderr, "%s\n", status.message().c_str());
    std::exit(int(status.code()));
}

template <class T>
T must(Result<T> result) {
    must(result.status());
    return std::move(*result);
}

// What a simulation would give: three puffs that rise.
std::vector<float> density_at(double time) {
    std::vector<float> values;
    values.reserve(std::size_t(kCells.x) * kCells.y * kCells.z);
    for (unsigned k = 0; k < kCells.z; ++k)
        for (unsigned j = 0; j < kCells.y; ++j)
            for (unsigned i = 0; i < kCells.x; ++i) {
                const glm::dvec3 at{(i + 0.5) / kCells.x, (j + 0.5) / kCells.y,
                                    (k + 0.5) / kCells.z};
                double sum = 0;
                for (int puff = 0; puff < 3; ++puff) {
                    const glm::dvec3 middle{0.3 + 0.2 * puff, 0.5,
                                            0.35 + 0.1 * puff + 0.004 * time};
                    const glm::dvec3 d = at - middle;
                    sum += 1 - (d.x * d.x + d.y * d.y + d.z * d.z) / 0.05;
                }
                values.push_back(float(sum > 1 ? 1 : sum > 0 ? sum : 0));
            }
    return values;
}

Camera camera_at(int frame) {
    Camera camera;
    camera.size = kSize;
    camera.fov_deg = 40;
    camera.target_m = {0, 0, 900};
    camera.position_m = orbit({0, -3000, 600}, camera.target_m, 0.5 * frame);
    return camera;
}

Sun sun_at(int frame) {
    Sun sun;
    sun.azimuth_deg = 65;
    sun.elevation_deg = 30 + 0.1 * frame;
    return sun;
}

// All that is made before a density is shown, its light and a first picture included.
Session prepared(const Scene& scene, int frame) {
    const std::vector<float> values = density_at(frame);
    Density density;
    density.size = kCells;
    density.values = values.data();
    Session session = must(Session::create(must(World::create(scene, {}, {density})), scene));
    must(session.set_camera(camera_at(frame)));
    must(session.set_sun(sun_at(frame)));
    must(session.set_frame(frame));
    must(session.step(must(session.progress()).whole));
    must(session.render({}));
    return session;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fprintf(stderr, "usage: %s SCENE [FRAMES [PICTURE.ppm]]\n", argv[0]);
        return 2;
    }
    const int frames = argc > 2 ? std::atoi(argv[2]) : 20;
    const Scene scene = must(
        Scene::read(argv[1], {"collectors.photons=20000", "collectors.generations=10",
                              "medium.0.density=\"uniform:box\"", "camera.resolution=[160,90]"}));
    Session session = prepared(scene, 0), next;
    std::thread worker;
    std::vector<unsigned char> colour(std::size_t(kSize.x) * kSize.y * 4);
    for (int frame = 0; frame < frames; ++frame) {
        // A host that may not wait asks whether the worker is done, and hands over when it is; here
        // the frame is fixed, so that the pictures are.
        if (worker.joinable() && frame % kEvery == 0) {
            worker.join();
            must(session.hand_over(next, kOver));
            next = Session();
        }
        if (!worker.joinable()) {
            const int coming = (frame / kEvery + 1) * kEvery;
            worker = std::thread([&scene, &next, coming] { next = prepared(scene, coming); });
        }
        must(session.set_camera(camera_at(frame)));
        must(session.set_sun(sun_at(frame)));
        must(session.set_frame(frame));
        must(session.step(1));
        std::uint64_t hash = 0;
        Frame picture;
        picture.colour = colour.data();
        picture.hash = &hash;
        must(session.render(picture));
        std::printf("%d %016llx\n", frame, static_cast<unsigned long long>(hash));
    }
    if (worker.joinable()) worker.join();
    if (argc > 3) {
        std::FILE* const file = std::fopen(argv[3], "wb");
        if (file == nullptr) return 4;
        std::fprintf(file, "P6\n%u %u\n255\n", kSize.x, kSize.y);
        for (std::size_t i = 0; i < colour.size(); i += 4) std::fwrite(&colour[i], 1, 3, file);
        std::fclose(file);
    }
    return 0;
}
