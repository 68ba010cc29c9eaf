// SPDX-License-Identifier: Apache-2.0
// What every fuzz target shares: the list of them, and laws of results.
// in: arbitrary bytes -> out: nothing, or an abort that names the broken law.
// docs/testing.md, section Fuzzing.
#pragma once
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "src/base/span.h"
#include "src/base/status.h"
#include "src/io/images/image.h"
#include "src/io/volumes/vdb/vdb_file.h"
#include "src/io/volumes/volume.h"
#include "tests/fuzz/targets.h"

/// What libFuzzer or replay.cpp calls: the chosen target.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace fuzz {

/// Ends the process with the law's name: libFuzzer keeps the input that broke it.
inline void require(bool holds, const char* law) {
    if (holds) return;
    std::fprintf(stderr, "fuzz target: broken law: %s\n", law);
    std::abort();
}

inline pileus::Span<const char> text_of(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

/// A fault has a code of input or limits, and lines a terminal can show, each with its place.
inline void check_fault(const pileus::Status& status, const std::string& opening, bool one_line) {
    require(status.code == pileus::Code::kBadInput || status.code == pileus::Code::kLimit,
            "a fault of the input is kBadInput or kLimit");
    require(status.message.compare(0, opening.size(), opening) == 0, "a line opens with the name");
    for (const char c : status.message) {
        const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
        require(!control || (c == '\n' && !one_line), "a fault is one printable line");
    }
}

/// What every reader of densities promises.
inline void check_volume(const pileus::Volume& volume) {
    std::uint64_t cells = 1;
    for (const int side : volume.size) {
        require(side >= 1 && side <= 4096, "sides of a volume are 1 to 4096");
        cells *= std::uint64_t(side);
    }
    require(volume.density.size() == cells, "a volume has all its voxels");
    for (const float v : volume.density.span())
        require(v >= 0.0f && v <= 3.402823466e38f, "densities are finite and >= 0");
    for (std::size_t a = 0; a < 3 && volume.knows_bounds; ++a)
        require(volume.bounds_m[0][a] < volume.bounds_m[1][a], "a box has its corners in order");
}

/// What a reader of sparse grids promises: `decode` and `decode_head` take name, bytes, grid,
/// limits.
template <class Decode, class DecodeHead>
int check_sparse_grid(const char* name, pileus::Span<const char> bytes, Decode decode,
                      DecodeHead decode_head) {
    pileus::VdbLimits limits;
    limits.max_cells = limits.free_cells = std::uint64_t{1} << 16;
    pileus::Volume volume;
    pileus::VolumeHead head;
    const pileus::Status status = decode(name, bytes, "", limits, volume);
    const pileus::Status seen = decode_head(name, bytes, "", limits, head);
    if (!status) {
        check_fault(status, std::string(name) + ":", true);
        return 0;
    }
    check_volume(volume);
    require(bool(seen) && head.size == volume.size, "a head tells the size of the whole");
    return 0;
}

/// What every reader of pictures promises.
inline void check_picture(const pileus::Image& image, std::uint64_t most_pixels) {
    require(image.width >= 1 && image.height >= 1, "a picture has pixels");
    const std::uint64_t pixels = std::uint64_t(image.width) * std::uint64_t(image.height);
    require(pixels <= most_pixels, "a picture keeps to its limit");
    require(!image.channels.empty(), "a picture has channels");
    for (const pileus::Channel& channel : image.channels)
        require(channel.pixels.size() == pixels, "a channel has all its pixels");
}

}  // namespace fuzz
