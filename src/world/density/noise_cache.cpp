// SPDX-License-Identifier: Apache-2.0
// See noise_cache.h. A file: 8 letters, the parameters, the payload's digest, the payload.
// in: NoiseParams, a folder -> out: bytes.
#include "src/world/density/noise_cache.h"

#include <cstdlib>
#include <cstring>

#include "src/base/digest.h"
#include "src/base/file.h"

namespace pileus {
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
    const char* value = std::getenv(variable);
    return value != nullptr && value[0] == '/' ? std::string(value) + behind : std::string();
}

}  // namespace

std::string cache_folder() {
    const std::string own = folder_in("PILEUS_CACHE_DIR", "");
    const std::string xdg = own.empty() ? folder_in("XDG_CACHE_HOME", "/pileus") : own;
    return xdg.empty() ? folder_in("HOME", "/.cache/pileus") : xdg;
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
