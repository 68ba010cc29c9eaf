// SPDX-License-Identifier: Apache-2.0
// See buffer.h. Once for the arrays of all types.
#include "src/base/buffer.h"

namespace pileus {
namespace {

constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 46;

}  // namespace

Status renew_memory(std::uint64_t count, std::uint64_t bytes, const char* what, void*& memory,
                    const Allocator*& from) {
    give_memory(memory, from);
    memory = nullptr;
    std::uint64_t all = 0;
    if (!checked_multiply(count, bytes, all) || all > kMaxBytes)
        return Status::limit(std::string(what) + ": more memory than can be addressed");
    if (count == 0) return Status::ok();
    const auto rounded = static_cast<std::size_t>((all + 63) / 64 * 64);
    memory = take_memory(rounded, from);
    if (memory == nullptr)
        return Status::limit(std::string(what) + ": out of memory, " + std::to_string(all) +
                             " bytes asked for");
    std::memset(memory, 0, rounded);
    return Status::ok();
}

}  // namespace pileus
