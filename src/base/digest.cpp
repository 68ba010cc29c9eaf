// SPDX-License-Identifier: Apache-2.0
// See digest.h. The only file that includes xxHash.
#include "src/base/digest.h"

#include <cstring>
#include <new>

#define XXH_INLINE_ALL
#include <xxhash.h>

#if XXH_VERSION_NUMBER < 800
#error "xxHash: needs XXH3 as it was fixed in 0.8.0"
#endif

namespace pileus {
namespace {

static_assert(sizeof(XXH3_state_t) <= sizeof(Digest) && alignof(XXH3_state_t) <= alignof(Digest),
              "the state of another version of xxHash");

XXH3_state_t& state_at(unsigned char* bytes) {
    return *std::launder(reinterpret_cast<XXH3_state_t*>(bytes));
}

}  // namespace

Digest::Digest() { XXH3_64bits_reset(new (state_) XXH3_state_t); }

void Digest::bytes(const void* data, std::size_t count) {
    // An empty span has no address.
    if (count > 0) XXH3_64bits_update(&state_at(state_), data, count);
}

#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
void Digest::numbers(const void* data, std::size_t count, std::size_t width) {
    bytes(data, count * width);
}
#else
void Digest::numbers(const void* data, std::size_t count, std::size_t width) {
    const auto* from = static_cast<const unsigned char*>(data);
    unsigned char block[1024];
    for (std::size_t left = count * width; left > 0;) {
        const std::size_t now = left < sizeof block ? left : sizeof block;
        for (std::size_t i = 0; i < now; i += width)
            for (std::size_t b = 0; b < width; ++b) block[i + b] = from[i + width - 1 - b];
        bytes(block, now);
        from += now;
        left -= now;
    }
}
#endif

std::uint64_t Digest::value() const {
    return XXH3_64bits_digest(std::launder(reinterpret_cast<const XXH3_state_t*>(state_)));
}

}  // namespace pileus
