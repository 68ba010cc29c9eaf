// SPDX-License-Identifier: Apache-2.0
// See fp_mode.h.
#include "platform/fp_mode.h"

namespace pileus {

// The default environment is IEEE on every target: nearest, gradual underflow, traps masked.
FpModeGuard::FpModeGuard() {
    std::fegetenv(&saved_);
    std::fesetenv(FE_DFL_ENV);
}

FpModeGuard::~FpModeGuard() { std::fesetenv(&saved_); }

}  // namespace pileus
