// SPDX-License-Identifier: Apache-2.0
// Pictures whose kernels run as a device would run them, and by a device where there is one.
// in: golden scenes -> out: the digests of every stage as the processor's kernels give them.
// docs/crosscheck.md
#include "platform/device.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "src/clouds/render_clouds.h"
#include "src/run/device_launch.h"
#include "src/run/find_kernels.h"
#include "tests/support/device_emulator.h"
#include "tests/support/long_tests.h"
#include "tests/support/render_harness.h"

using namespace render_test;

namespace {

std::string digests_of(const Picture& picture) {
    std::string all = "image " + picture.report.hash;
    for (const auto& digest : picture.report.digests)
        all += "\n" + digest.first + " " + digest.second;
    for (const auto& counter : picture.report.executed)
        all += "\n" + std::string(counter.first) + " " + std::to_string(counter.second);
    all += "\nscatterings " + std::to_string(picture.report.events.scatterings);
    return all + "\ncrossings " + std::to_string(picture.report.events.crossings);
}

std::string rendered_by(const Scene& scene, const KernelTable* kernels) {
    RenderOptions options;
    options.kernels = kernels;
    options.threads = 2;
    return digests_of(render_one(scene, options));
}

/// Scenes of a folder, in order of their names.
std::vector<std::string> scenes_in(const char* folder) {
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".toml") files.push_back(entry.path().string());
    std::sort(files.begin(), files.end());
    return files;
}

/// A film is compared picture by picture.
Status films_by(const Scene& scene, const KernelTable* kernels, std::string& all) {
    RenderOptions options;
    options.kernels = kernels;
    options.threads = 2;
    const auto draw = scene.clouds.present() ? render_clouds : render;
    return draw(scene, options, [&](int, Image&, Report& report) {
        Picture picture;
        picture.report = report;
        all += digests_of(picture) + "\n";
        return Status::ok();
    });
}

/// Every scene of a folder on a device, all stages.
void compare_folder(const char* folder, const KernelTable* device) {
    const std::vector<std::string> few = {"collectors.photons=4000", "photon_grid.photons=4000",
                                          "path.target_error=0", "path.samples_per_pixel=3"};
    for (const std::string& file : scenes_in(folder)) {
        CAPTURE(file);
        Scene scene;
        const Status read = read_scene_file(file, few, scene);
        REQUIRE_MESSAGE(read, read.message);
        std::string there, here;
        const Status drawn = films_by(scene, device, there);
        CHECK_MESSAGE(drawn, drawn.message);
        REQUIRE(films_by(scene, nullptr, here));
        CHECK(there == here);
    }
}

Scene golden_scene(const std::string& name, const std::vector<std::string>& overrides) {
    Scene scene;
    const Status status =
        read_scene_file("assets/scenes/golden/" + name + ".toml", overrides, scene);
    REQUIRE_MESSAGE(status, status.message);
    return scene;
}

/// The same on any device: whatever a scene needs of each kernel.
void compare_with(const KernelTable* device) {
    const std::vector<std::string> few = {"collectors.photons=8000", "path.samples_per_pixel=3"};
    std::vector<const char*> names = {"cumulus_billboards", "path_sky_map", "periodic",
                                      "ordinates_cumulus", "ordinates_sky"};
    if (long_tests())
        for (const char* name : {"box_ground", "cumulus_paper", "sky_map", "sphere_chromatic",
                                 "two_media_billboards", "cumulus_lobe", "path_cumulus"})
            names.push_back(name);
    for (const char* name : names) {
        CAPTURE(name);
        const Scene scene = golden_scene(name, few);
        CHECK(rendered_by(scene, device) == rendered_by(scene, nullptr));
    }
    // A phase function in tables, in colours, by either method, and light towards the camera.
    const std::string cloud = "medium.0.phase={type=\"cloud\",effective_radius_um=10}";
    for (const char* method : {"method.name=path", "collectors.closure=camera"}) {
        CAPTURE(method);
        const Scene scene = scene_from(kSmallCumulus, {cloud, method, "path.samples_per_pixel=3"});
        CHECK(rendered_by(scene, device) == rendered_by(scene, nullptr));
    }
}

}  // namespace

TEST_CASE("identity: a device's launches, emulated in shuffled order, every stage the same bits") {
    const device_test::Emulator emulator;
    REQUIRE(test_kernels(emulator.table));
    compare_with(&emulator.table);
}

TEST_CASE("identity: a device's launches, emulated, in every scene of the identity set") {
    const device_test::Emulator emulator;
    compare_folder("assets/scenes/identity", &emulator.table);
    if (long_tests()) compare_folder("assets/scenes/golden", &emulator.table);
}

TEST_CASE("identity: a device, the same bits in every stage") {
    const KernelTable* device = nullptr;
    std::string why;
    if (!has_cuda_device(why)) {
        std::printf("skipped: no device: %s\n", why.c_str());
        CHECK(find_kernels("cuda", device).code == Code::kBadInput);
        return;
    }
    REQUIRE(find_kernels("cuda", device));
    REQUIRE(test_kernels(*device));
    compare_with(device);
}

TEST_CASE("identity: a device has detail on a grid and detail that is marched") {
    const device_test::Emulator emulator;
    std::vector<std::string> detail = {"medium.0.detail.tile_m=256"};
    for (const char* where : {"medium.0.detail.refine=0", "medium.0.detail.refine=2"}) {
        detail.resize(1);
        detail.push_back(where);
        const Scene scene = scene_from(kSmallCumulus, detail);
        CHECK(rendered_by(scene, &emulator.table) == rendered_by(scene, nullptr));
    }
}

TEST_CASE("identity: what fails on a device ends the rendering with its words") {
    device_test::Emulator emulator;
    const Scene scene = scene_from(kSmallCumulus);
    RenderOptions options;
    options.kernels = &emulator.table;
    const auto failing = [&](Code code, const char* words) {
        const Status status =
            render(scene, options, [](int, Image&, Report&) { return Status::ok(); });
        CHECK(status.code == code);
        CHECK_MESSAGE(status.message.find(words) != std::string::npos, status.message);
    };
    emulator.device.launch = [](const void*, const void*, const void*, std::uint32_t,
                                std::uint32_t) { return false; };
    failing(Code::kIo, "device emulated: launch failed: made to fail");
    emulator.device.launch = device_test::launch;
    emulator.device.upload = [](void*, const void*, std::uint64_t) { return false; };
    failing(Code::kIo, "device emulated: copy to it failed: made to fail");
    emulator.device.upload = device_test::copy;
    emulator.device.download = [](void*, const void*, std::uint64_t) { return false; };
    failing(Code::kIo, "device emulated: copy from it failed: made to fail");
    emulator.device.download = device_test::copy;
    emulator.device.allocate = [](std::uint64_t) -> void* { return nullptr; };
    failing(Code::kLimit, "device emulated: out of memory, 8 bytes asked for");

    // A device that computes otherwise is found before it paints.
    emulator.device.allocate = device_test::allocate;
    emulator.kernels.self_test =
        device_test::address([](const void*, const void* buffers, std::uint32_t, std::uint32_t) {
            *static_cast<const SelfTestBuffers*>(buffers)->digest = 1;
        });
    failing(Code::kCheckFailed, "self test");
}
