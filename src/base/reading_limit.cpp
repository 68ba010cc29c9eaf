// SPDX-License-Identifier: Apache-2.0
// See reading_limit.h.
#include "src/base/reading_limit.h"

namespace pileus {
namespace {

constexpr std::uint64_t kRoomWithoutGuard = std::uint64_t{1} << 34;

/// Hold something only below a guard, so that no state outlives a call.
thread_local const Limits* reading_limits = nullptr;
thread_local std::uint64_t held_bytes = 0;

}  // namespace

ReadingLimit::ReadingLimit(const Limits& limits) : before_(reading_limits) {
    reading_limits = &limits;
}
ReadingLimit::~ReadingLimit() { reading_limits = before_; }

ReadingHold::ReadingHold(std::uint64_t bytes) : bytes_(bytes) { held_bytes += bytes; }
ReadingHold::~ReadingHold() { held_bytes -= bytes_; }

std::uint64_t reading_room() {
    const std::uint64_t most =
        reading_limits != nullptr ? (*reading_limits)[LimitId::kMemory] : kRoomWithoutGuard;
    return most > held_bytes ? most - held_bytes : 0;
}

Status check_reading(const std::string& where, std::uint64_t bytes) {
    if (bytes <= reading_room()) return Status::ok();
    std::uint64_t needed = 0;
    if (__builtin_add_overflow(held_bytes, bytes, &needed)) needed = ~std::uint64_t{0};
    if (reading_limits != nullptr)
        return check_limit(*reading_limits, LimitId::kMemory, needed, where);
    return Status::limit(where + ": needs " + std::to_string(needed) +
                         " bytes of memory to be read, allowed: at most " +
                         std::to_string(kRoomWithoutGuard));
}

}  // namespace pileus
