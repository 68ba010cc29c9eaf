// SPDX-License-Identifier: Apache-2.0
// Pictures whose kernels run as a device would run them, and by a device where there is one.
// in: golden scenes -> out: the digests of every stage as the processor's kernels give them.
// docs/crosscheck.md
#include "platform/device.h"

#include <cstdio>

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
    std::vector<const char*> names = {"cumulus_billboards", "path_sky_map", "periodic"};
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

TEST_CASE("identity: a device has detail that lies on a grid, and refuses what is marched") {
    const device_test::Emulator emulator;
    std::vector<std::string> detail = {"medium.0.detail.tile_m=256"};
    RenderOptions options;
    options.kernels = &emulator.table;
    CHECK(render(scene_from(kSmallCumulus, detail), options,
                 [](int, Image&, Report&) { return Status::ok(); })
              .message ==
          "test.toml: medium.0.detail.refine: --isa emulated knows detail on a "
          "grid alone, 0, allowed: 1 to 16");
    detail.push_back("medium.0.detail.refine=2");
    const Scene scene = scene_from(kSmallCumulus, detail);
    CHECK(rendered_by(scene, &emulator.table) == rendered_by(scene, nullptr));
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
