// SPDX-License-Identifier: Apache-2.0
// What a host program lends for the time of a call: memory and threads of its own.
// in: functions of the host, or nothing -> out: used by every array and every parallel loop below
// the guard; what is kept afterwards remembers whom to give it back to. docs/embedding.md
#pragma once
#include <cstddef>
#include <cstdint>

namespace pileus {

/// Arrays from a host's memory. Both may be called by several threads at once.
struct Allocator {
    /// At least `bytes` at a multiple of `alignment`, or null.
    void* (*allocate)(void* user, std::size_t bytes, std::size_t alignment) = nullptr;
    void (*release)(void* user, void* memory) = nullptr;
    void* user = nullptr;
    /// Arrays keep memory that is larger than they need: what was once as large finds it there.
    bool keeps = false;
};

/// Threads of a host: calls body(data, index) once for each index in [0, count), at once or one
/// after the other, in any order, and returns when all have returned.
struct Executor {
    void (*run)(void* user, std::uint32_t count, void (*body)(void* data, std::uint32_t index),
                void* data) = nullptr;
    void* user = nullptr;
};

class ThreadPool;

/// Null members: the C++ runtime's memory, threads for each loop anew.
struct Host {
    const Allocator* allocator = nullptr;
    const Executor* executor = nullptr;
    ThreadPool* pool = nullptr;  ///< threads of our own, used where there is no executor
};

/// The host of this thread's innermost guard.
const Host& current_host();

/// Lends `host` to this thread while it lives; guards nest. Nothing stays behind.
class HostGuard {
public:
    explicit HostGuard(const Host& host);
    ~HostGuard();
    HostGuard(const HostGuard&) = delete;
    HostGuard& operator=(const HostGuard&) = delete;

private:
    Host before_;
};

/// Memory of the current host at a multiple of 64, a multiple of 64 bytes, or null. `from` is to be
/// handed to give_memory.
void* take_memory(std::size_t bytes, const Allocator*& from);
void give_memory(void* memory, const Allocator* from);

// The C runtime's; null where there is none left.
void* take_aligned(std::size_t alignment, std::size_t bytes);
void give_aligned(void* memory);

/// Of memory that stays the caller's: given back to it, nothing happens.
extern const Allocator kCallersMemory;

}  // namespace pileus
