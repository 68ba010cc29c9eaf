// SPDX-License-Identifier: Apache-2.0
// See oidn.h. The only file that touches the library, which is loaded when a scene asks for it.
// What is called of it is declared here, so that no header is needed to build.
// Open Image Denoise 2, include/OpenImageDenoise/oidn.h
#include "src/picture/filter/oidn.h"

#ifdef PILEUS_WITH_OIDN
#include <cstdlib>

#include "platform/fp_mode.h"
#include "src/base/dynamic_library.h"
#include "src/base/printable.h"
#endif

namespace pileus {

#ifdef PILEUS_WITH_OIDN
namespace {

constexpr const char* kVariable = "PILEUS_OIDN";
constexpr int kProcessor = 1;      // OIDN_DEVICE_TYPE_CPU
constexpr int kThreeFloats = 3;    // OIDN_FORMAT_FLOAT3
constexpr int kNoDeviceError = 0;  // OIDN_ERROR_NONE

struct Device;
struct Filter;

struct Denoiser {
    Device* (*new_device)(int type) = nullptr;
    void (*set_device_int)(Device*, const char* name, int value) = nullptr;
    void (*set_device_bool)(Device*, const char* name, bool value) = nullptr;
    void (*commit_device)(Device*) = nullptr;
    int (*device_error)(Device*, const char** message) = nullptr;
    void (*release_device)(Device*) = nullptr;
    Filter* (*new_filter)(Device*, const char* type) = nullptr;
    void (*set_image)(Filter*, const char* name, void* pixels, int format, std::size_t width,
                      std::size_t height, std::size_t offset, std::size_t pixel_stride,
                      std::size_t row_stride) = nullptr;
    void (*set_filter_bool)(Filter*, const char* name, bool value) = nullptr;
    void (*commit_filter)(Filter*) = nullptr;
    void (*execute_filter)(Filter*) = nullptr;
    void (*release_filter)(Filter*) = nullptr;

    bool load(const char* file) {
        DynamicLibrary library(file);
        library.find("oidnNewDevice", new_device);
        library.find("oidnSetDeviceInt", set_device_int);
        library.find("oidnSetDeviceBool", set_device_bool);
        library.find("oidnCommitDevice", commit_device);
        library.find("oidnGetDeviceError", device_error);
        library.find("oidnReleaseDevice", release_device);
        library.find("oidnNewFilter", new_filter);
        library.find("oidnSetSharedFilterImage", set_image);
        library.find("oidnSetFilterBool", set_filter_bool);
        library.find("oidnCommitFilter", commit_filter);
        library.find("oidnExecuteFilter", execute_filter);
        library.find("oidnReleaseFilter", release_filter);
        return library.is_whole();
    }
};

Status load_denoiser(const std::string& key, Denoiser& to) {
    const char* named = std::getenv(kVariable);
    if (named != nullptr && named[0] != 0) {
        if (to.load(named)) return Status::ok();
        return Status::bad_input(key + "no Open Image Denoise 2 where " + kVariable + " says, \"" +
                                 printable_line(named) + "\", allowed: libOpenImageDenoise.so.2");
    }
    if (to.load("libOpenImageDenoise.so.2") || to.load("libOpenImageDenoise.so"))
        return Status::ok();
    return Status::bad_input(key +
                             "libOpenImageDenoise.so.2 is not installed, \"oidn\", allowed: "
                             "install it, its path in " +
                             kVariable + ", regression, none");
}

/// Runs the filter over pixels of three floats, in place.
Status run_denoiser(const std::string& key, const Denoiser& library, int width, int height,
                    int threads, float* pixels) {
    const FpModeGuard guard;  // whatever mode the library leaves
    Device* device = library.new_device(kProcessor);
    if (device == nullptr)
        return Status::bad_input(key +
                                 "Open Image Denoise runs on no processor of this machine, "
                                 "\"oidn\", allowed: regression, none");
    library.set_device_int(device, "numThreads", threads);
    library.set_device_bool(device, "setAffinity", false);
    library.commit_device(device);
    Filter* filter = library.new_filter(device, "RT");
    if (filter != nullptr) {
        const std::size_t w = std::size_t(width), h = std::size_t(height);
        library.set_image(filter, "color", pixels, kThreeFloats, w, h, 0, 0, 0);
        library.set_image(filter, "output", pixels, kThreeFloats, w, h, 0, 0, 0);
        library.set_filter_bool(filter, "hdr", true);
        library.commit_filter(filter);
        library.execute_filter(filter);
        library.release_filter(filter);
    }
    const char* text = nullptr;
    const int error = library.device_error(device, &text);
    Status status = Status::ok();
    if (error != kNoDeviceError || filter == nullptr)
        status = Status::bad_input(key + "Open Image Denoise fails, " +
                                   printable_line(text != nullptr ? text : "") +
                                   ", allowed: another filter");
    library.release_device(device);
    return status;
}

}  // namespace

Status check_oidn(const std::string& key) {
    Denoiser library;
    return load_denoiser(key, library);
}

Status denoise_by_oidn(const std::string& key, int width, int height, int threads, float* colour) {
    Denoiser library;
    PILEUS_TRY(load_denoiser(key, library));
    const std::size_t pixels = std::size_t(width) * std::size_t(height);
    Buffer<float> mixed;
    PILEUS_TRY(allocate(arrays::oidn_pixels(pixels), mixed));
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < pixels; ++i) mixed[3 * i + c] = colour[c * pixels + i];
    PILEUS_TRY(run_denoiser(key, library, width, height, threads, mixed.data()));
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < pixels; ++i) colour[c * pixels + i] = mixed[3 * i + c];
    return Status::ok();
}
#else
Status check_oidn(const std::string& key) {
    return Status::bad_input(key +
                             "this build loads no Open Image Denoise (PILEUS_OIDN), \"oidn\", "
                             "allowed: regression, none");
}

Status denoise_by_oidn(const std::string& key, int, int, int, float*) { return check_oidn(key); }
#endif

}  // namespace pileus
