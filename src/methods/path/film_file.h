// SPDX-License-Identifier: Apache-2.0
// A film on disk, so that a rendering can go on where an earlier one ended.
// in: a Film -> out: a file; in: a file of the same scene and settings -> out: the Film, bit by
// bit. docs/formats.md, "State of a path tracing"
#pragma once
#include "src/methods/path/trace_paths.h"

namespace pileus {

/// Digest of all that the samples depend on: medium, light, camera, seed, settings, the program's
/// version; not of threads, instruction set or the number of samples.
std::uint64_t path_state_digest(const PathInput& in, const std::string& version);

/// Replaces or makes `path` in one step. kIo, kLimit (memory).
Status write_path_state(const std::string& path, std::uint64_t digest, const Film& film);

/// Fills a film as make_film left it; a file that is not there leaves it empty. kBadInput: cut,
/// damaged, another version's, or of another digest.
Status read_path_state(const std::string& path, std::uint64_t digest, Film& film);

/// Bytes of such a file.
std::uint64_t path_state_bytes(std::uint64_t film_bytes);

}  // namespace pileus
