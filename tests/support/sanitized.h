// SPDX-License-Identifier: Apache-2.0
// Whether this build runs under a sanitizer, whose own memory is no part of any plan.
// in: the compiler -> out: kSanitized.
// docs/testing.md
#pragma once

namespace pileus {
namespace test {

#if defined(__SANITIZE_ADDRESS__)
constexpr bool kSanitized = true;
#elif defined(__has_feature)
constexpr bool kSanitized = __has_feature(address_sanitizer);
#else
constexpr bool kSanitized = false;
#endif

}  // namespace test
}  // namespace pileus
