// SPDX-License-Identifier: Apache-2.0
// Round to nearest, keep denormals, mask traps while we compute; give the caller's mode back.
// in: whatever mode the host program left -> out: IEEE defaults for the guard's lifetime.
#pragma once
#include <cfenv>

namespace pileus {

class FpModeGuard {
public:
    FpModeGuard();
    ~FpModeGuard();
    FpModeGuard(const FpModeGuard&) = delete;
    FpModeGuard& operator=(const FpModeGuard&) = delete;

private:
    std::fenv_t saved_;
};

}  // namespace pileus
