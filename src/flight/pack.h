// SPDX-License-Identifier: Apache-2.0
// Packed scenes: a checked scene and its prepared world as bytes, for machines without files.
// in: Scene, World -> out: bytes, the same on every machine; in: bytes -> out: both again.
// docs/flight.md, "Packed scenes"
#pragma once
#include <memory>

#include "src/io/images/image.h"
#include "src/scene/scene.h"
#include "src/world/world.h"

namespace pileus {

/// What a packed scene begins with.
struct PackedHead {
    std::uint64_t width = 0, height = 0;  ///< of the camera, pixels
    std::uint64_t block_bytes = 0;        ///< that a session of it needs
    std::uint64_t in_place_bytes = 0;     ///< that one needs which reads arrays where they lie
    std::string method;                   ///< at most 23 bytes
};

/// A scene, and what it was made of.
struct Packed {
    PackedHead head;
    Scene scene;
    std::shared_ptr<World> world;
    Image sky;
    bool in_place = false;  ///< the world's arrays of floats lie in the bytes that it came from
};

/// Bytes of the scene, which is checked, and of its world. kBadInput: what sessions of a flight do
/// not have: meshes, a depth image from a file, a film. Errors of the reader of its sky map.
Status pack_scene(const Scene& scene, const World& world, std::string& bytes);

/// Writes into the head of packed bytes how large a block a session of them needs.
void tell_block(std::uint64_t block_bytes, std::uint64_t in_place_bytes, std::string& bytes);

/// What follows the head, behind one that has its length and digest; for tests.
std::string packed_bytes(const PackedHead& head, const std::string& payload);

/// The head alone; the digest of all bytes is compared. kBadInput: no packed scene, one of another
/// version, cut short or changed.
Status read_packed_head(const void* bytes, std::size_t size, PackedHead& head);

/// All of it. Sizes and numbers of tables are checked; that every value is in its range is the
/// packer's word, which the digest keeps. `in_place`: the world's arrays of floats are read where
/// they lie, if this machine is little-endian; `bytes` must outlive it. Errors: those of the head;
/// kBadInput: in place at no multiple of 64 bytes; kLimit: out of memory.
Status unpack_scene(const void* bytes, std::size_t size, bool in_place, Packed& out);

}  // namespace pileus
