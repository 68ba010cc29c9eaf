// SPDX-License-Identifier: Apache-2.0
// See noise_volume.h. Mean and deviation are sums of integers, so that any order gives them.
// in: NoiseParams -> out: bytes.
#include "src/world/density/noise_volume.h"

#include <cmath>
#include <cstring>

#include "platform/path.h"
#include "platform/threads.h"
#include "src/base/digest.h"
#include "src/base/file.h"
#include "src/run/device_launch.h"
#include "src/run/on_device.h"

namespace pileus {

namespace {

constexpr std::int64_t kPieces = 64;  // of the texels, each summed on its own
constexpr double kQuanta = 0x1p20;    // values are below 8: their squares fit 46 bits
constexpr double kDeviations = 7;     // standard deviations from 0 to 255

struct Sums {
    std::int64_t one = 0, square = 0;  // of values and of squares, in quanta and quanta^2 / 2^20
};

Sums add_up(Span<const float> values) {
    Sums sums;
    for (const float value : values) {
        const std::int64_t quanta = std::int64_t(double(value) * kQuanta);
        sums.one += quanta;
        sums.square += quanta * quanta >> 20;
    }
    return sums;
}

std::uint8_t byte_of(float value, double mean, double per_value) {
    const double v = 127.5 + (double(value) - mean) * per_value;
    return std::uint8_t(v < 0 ? 0 : v > 255 ? 255 : v + 0.5);
}

}  // namespace

int most_octaves(int size, int cells) {
    int octaves = 1;
    while (cells * kTexelsPerCell * 2 <= size) cells *= 2, ++octaves;
    return octaves;
}

Status make_noise(const NoiseParams& params, const KernelTable& kernels, int threads,
                  Buffer<std::uint8_t>& texels) {
    const std::uint64_t size = std::uint64_t(params.size), count = size * size * size;
    Buffer<float> values;
    PILEUS_TRY(texels.resize(count, "noise volume"));
    PILEUS_TRY(values.resize(count, "noise volume, unscaled"));
    const std::int64_t rows = std::int64_t(size * size);
    const NoiseBuffers b{values.data()};
    if (on_device(kernels.device))
        PILEUS_TRY(launch_on_device(*kernels.device, params, b, std::uint32_t(rows)));
    else
        parallel_for(threads, rows / params.size, [&](std::int64_t slice, int) {
            kernels.noise_rows(params, b, std::uint32_t(slice * params.size),
                               std::uint32_t((slice + 1) * params.size));
        });
    Sums parts[kPieces];
    const std::size_t piece_texels = std::size_t(count) / kPieces;
    parallel_for(threads, kPieces, [&](std::int64_t i, int) {
        parts[i] = add_up({values.data() + std::size_t(i) * piece_texels, piece_texels});
    });
    Sums all;
    for (const Sums& part : parts) all.one += part.one, all.square += part.square;
    const double mean = double(all.one) / double(count) / kQuanta;
    const double variance = double(all.square) / double(count) / kQuanta - mean * mean;
    // A volume without variation cannot come from noise; should it, it is flat.
    const double per_value = variance > 1e-12 ? 255 / (kDeviations * std::sqrt(variance)) : 0;
    parallel_for(threads, kPieces, [&](std::int64_t i, int) {
        const std::size_t begin = std::size_t(i) * piece_texels;
        for (std::size_t t = begin; t < begin + piece_texels; ++t)
            texels[t] = byte_of(values[t], mean, per_value);
    });
    return Status::ok();
}

// Kept in a file: 8 letters, the parameters, the payload's digest, the payload.

namespace {

constexpr char kMagic[9] = "PLNOISE2";  // changes with the noise and with what its file holds
constexpr std::size_t kHeadBytes = 40;

void put_number(char* to, std::uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) to[i] = char(value >> (8 * i) & 255);
}

std::uint32_t bits_of_float(float value) {
    std::uint32_t bits;
    std::memcpy(&bits, &value, 4);
    return bits;
}

/// The head without the payload's digest.
void write_head(const NoiseParams& p, char (&head)[kHeadBytes]) {
    std::memset(head, 0, sizeof head);
    std::memcpy(head, kMagic, 8);
    put_number(head + 8, std::uint32_t(p.kind), 4);
    put_number(head + 12, std::uint32_t(p.size), 4);
    put_number(head + 16, std::uint32_t(p.cells), 4);
    put_number(head + 20, std::uint32_t(p.octaves), 4);
    put_number(head + 24, bits_of_float(p.gain), 4);
    put_number(head + 28, p.seed, 4);
}

std::uint64_t payload_digest(Span<const std::uint8_t> texels) {
    Digest digest;
    digest.bytes(texels.data, texels.size);
    return digest.value();
}

/// Whether the file is there, whole and of these parameters; `texels` then holds its payload.
bool read_noise(const NoiseParams& params, const std::string& path, Buffer<std::uint8_t>& texels) {
    InputFile file;
    char head[kHeadBytes], wanted[kHeadBytes];
    const std::uint64_t count =
        std::uint64_t(params.size) * std::uint64_t(params.size) * std::uint64_t(params.size);
    if (!open_file(path, file) || file.size() != count + kHeadBytes) return false;
    if (!file.read(head, kHeadBytes)) return false;
    write_head(params, wanted);
    if (std::memcmp(head, wanted, 32) != 0) return false;
    if (!texels.resize(count, "noise volume")) return false;
    if (!file.read(texels.data(), std::size_t(count))) return false;
    put_number(wanted + 32, payload_digest(texels.span()), 8);
    return std::memcmp(head + 32, wanted + 32, 8) == 0;
}

bool keep_noise(const NoiseParams& params, const std::string& path,
                const Buffer<std::uint8_t>& texels) {
    char head[kHeadBytes];
    write_head(params, head);
    put_number(head + 32, payload_digest(texels.span()), 8);
    Buffer<char> bytes;
    if (!bytes.resize(kHeadBytes + texels.size(), "noise volume's file")) return false;
    std::memcpy(bytes.data(), head, kHeadBytes);
    std::memcpy(bytes.data() + kHeadBytes, texels.data(), texels.size());
    return bool(write_file(path, bytes.span()));
}

/// A folder out of an environment variable; relative ones are no folder for a cache.
std::string folder_in(const char* variable, const char* behind) {
    const std::string value = environment_text(variable);
    return is_absolute_path(value) ? value + behind : std::string();
}

}  // namespace

std::string cache_folder() {
    std::string folder = folder_in("PILEUS_CACHE_DIR", "");
    if (folder.empty()) folder = folder_in("XDG_CACHE_HOME", "/pileus");
    if (folder.empty()) folder = folder_in("HOME", "/.cache/pileus");
    // Windows has none of these.
    return folder.empty() ? folder_in("LOCALAPPDATA", "/pileus") : folder;
}

std::string noise_file_name(const NoiseParams& params) {
    char head[kHeadBytes];
    write_head(params, head);
    Digest digest;
    digest.bytes(head, 32);
    const char* kind = params.kind == kNoisePerlin ? "perlin-" : "worley-";
    return kind + std::to_string(params.size) + "-" + digest.hex() + ".noise";
}

Status load_noise(const NoiseParams& params, const std::string& folder, const KernelTable& kernels,
                  int threads, Buffer<std::uint8_t>& texels, NoiseOrigin& origin) {
    const std::string path = folder.empty() ? "" : folder + "/" + noise_file_name(params);
    origin = NoiseOrigin::kRead;
    if (!path.empty() && read_noise(params, path, texels)) return Status::ok();
    PILEUS_TRY(make_noise(params, kernels, threads, texels));
    const bool kept = !path.empty() && keep_noise(params, path, texels);
    origin = kept ? NoiseOrigin::kMade : NoiseOrigin::kMadeUnkept;
    return Status::ok();
}

}  // namespace pileus
