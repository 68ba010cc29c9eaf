// SPDX-License-Identifier: Apache-2.0
// Results of pileus.hpp that must be there, and a host that counts what it lends.
// in: results -> out: their values; faults end the test.
// docs/embedding.md
#pragma once
#include <doctest/doctest.h>

#include <atomic>
#include <cstdlib>
#include <memory>
#include <pileus/pileus.hpp>

namespace hpp_test {

namespace hpp = pileus::embed;

template <class T>
T take(hpp::Result<T> result) {
    REQUIRE_MESSAGE(bool(result), result.message());
    return *std::move(result);
}

inline void must(const hpp::Status& status) { REQUIRE_MESSAGE(bool(status), status.message()); }

/// `held`: pieces that are lent; `token` is kept as long as the host.
inline hpp::Host counting_host(std::atomic<long>& held, const std::shared_ptr<int>& token) {
    hpp::Host host;
    host.allocate = [&held, token](std::size_t bytes, std::size_t alignment) {
        ++held;
        return std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
    };
    host.release = [&held](void* memory) {
        if (memory != nullptr) --held;
        std::free(memory);
    };
    return host;
}

}  // namespace hpp_test
