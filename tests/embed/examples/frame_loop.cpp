// SPDX-License-Identifier: Apache-2.0
// A frame loop: camera and sun move over a cloud, which is blended over the program's own picture.
// in: a scene file, a method, frames, and "over", "plain" (without the picture) or "matrices" (over
// it, with GLM's camera and OpenGL's depth buffer)
// -> out: a line with the hash of each picture; without matrices those of frame_loop.c.
// docs/embedding.md explains each step. Needs pileus.hpp and GLM.
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <pileus/pileus.hpp>
#include <string>
#include <vector>

namespace {

using namespace pileus::embed;

constexpr unsigned kWidth = 160, kHeight = 90;
constexpr double kNear = 10, kFar = 50000, kFov = 40;

void check(const Status& status) {
    if (status) return;
    std::fprintf(stderr, "%s\n", status.message().c_str());
    std::exit(int(status.code()));
}

/// The value of a result, or the end of the program.
template <class T>
T take(Result<T> result) {
    check(result.status());
    return *std::move(result);
}

/// What the program itself would draw: a slope of blue, and a wall 3 km away.
struct OwnPicture {
    std::vector<unsigned char> colour = std::vector<unsigned char>(4 * kWidth * kHeight);
    std::vector<float> depth = std::vector<float>(kWidth * kHeight);

    void draw() {
        for (unsigned y = 0; y < kHeight; ++y)
            for (unsigned x = 0; x < kWidth; ++x) {
                unsigned char* pixel = &colour[4 * (y * kWidth + x)];
                const bool wall = x < kWidth / 4;
                pixel[0] = static_cast<unsigned char>(wall ? 90 : 40);
                pixel[1] = static_cast<unsigned char>(wall ? 80 : 90 + y / 2);
                pixel[2] = static_cast<unsigned char>(wall ? 70 : 200);
                pixel[3] = 255;
                depth[y * kWidth + x] = wall ? 3000.0f : 1e30f;
            }
    }

    /// The same distances as OpenGL's depth buffer would hold them.
    void to_buffer(const glm::dmat4& projection) {
        const glm::dmat4 back = glm::inverse(projection);
        for (unsigned y = 0; y < kHeight; ++y)
            for (unsigned x = 0; x < kWidth; ++x) {
                float& value = depth[y * kWidth + x];
                const glm::dvec4 on_ray = back * glm::dvec4((x + 0.5) * 2 / kWidth - 1,
                                                            1 - (y + 0.5) * 2 / kHeight, 0, 1);
                const glm::dvec3 direction = glm::normalize(glm::dvec3(on_ray));
                const glm::dvec4 clip = projection * glm::dvec4(direction * double(value), 1);
                value = value > 1e29f ? 1.0f : float(0.5 + 0.5 * clip.z / clip.w);
            }
    }
};

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fprintf(stderr, "usage: %s SCENE [METHOD [FRAMES [over|plain|matrices]]]\n", argv[0]);
        return 2;
    }
    const std::string method = argc > 2 ? argv[2] : "collectors";
    const int frames = argc > 3 ? std::atoi(argv[3]) : 10;
    const std::string mode = argc > 4 ? argv[4] : "over";
    const bool by_matrices = mode == "matrices", over = mode != "plain";

    // Once: the world is read and prepared.
    const Scene scene =
        take(Scene::read(argv[1], {"method.name=\"" + method + "\"", "collectors.photons=20000",
                                   "collectors.generations=10", "path.samples_per_pixel=2",
                                   "camera.resolution=[160,90]"}));
    const World world = take(World::create(scene));
    Session session = take(Session::create(world, scene));
    const Progress progress = take(session.progress());

    OwnPicture own;
    for (int number = 0; number < frames; ++number) {
        // What has moved.
        const double share = frames > 1 ? double(number) / (frames - 1) : 0;
        const glm::dvec3 target(0, 0, 900), eye = orbit({0, -3000, 600}, target, 90 * share);
        own.draw();
        DepthImage opaque;
        if (by_matrices) {
            const glm::dmat4 view = glm::lookAt(eye, target, glm::dvec3(0, 0, 1));
            const glm::dmat4 projection =
                glm::perspective(glm::radians(kFov), double(kWidth) / kHeight, kNear, kFar);
            check(session.set_camera(view, projection, Clip::kMinusOne, {kWidth, kHeight}));
            own.to_buffer(projection);
            opaque.kind = Depth::kBuffer;
        } else {
            Camera camera;
            camera.size = {kWidth, kHeight};
            camera.position_m = eye;
            camera.target_m = target;
            camera.fov_deg = kFov;
            check(session.set_camera(camera));
        }
        Sun sun;
        sun.azimuth_deg = 65;
        sun.elevation_deg = 20 + 30 * share;
        check(session.set_sun(sun));
        check(session.set_frame(number));

        // Light: photons stay for frames to come, paths belong to one camera.
        opaque.values = own.depth.data();
        if (over) check(session.set_depth(opaque));
        check(session.step(number == 0 || progress.unit != "generation" ? progress.whole : 1));

        // The cloud over the picture and behind the wall.
        std::uint64_t hash = 0;
        Frame frame;
        frame.colour = own.colour.data();
        frame.blend = over ? Blend::kOver : Blend::kReplace;
        frame.hash = &hash;
        check(session.render(frame));
        std::printf("%d %016llx\n", number, static_cast<unsigned long long>(hash));
    }
    return 0;
}
