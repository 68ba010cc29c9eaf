// SPDX-License-Identifier: Apache-2.0
// See fp_mode.h.
#include "platform/fp_mode.h"

#include <cstdint>

namespace pileus {

#ifdef __powerpc__
// glibc's fesetenv has an instruction of Power ISA 3.0 that older processors are to take for
// `mffs`; emulators of them refuse it. fenv_t is the register: all 0 is IEEE.
FpModeGuard::FpModeGuard() {
    static_assert(sizeof saved_ == sizeof(double));
    asm volatile("mffs %0" : "=d"(saved_));
    asm volatile("mtfsf 255,%0" : : "d"(0.0));
}

FpModeGuard::~FpModeGuard() { asm volatile("mtfsf 255,%0" : : "d"(saved_)); }
#elif defined(__arm__) && defined(__ARM_FP)
// Without a C library, too: rounding, what is flushed and which NaN is made are bits of one
// register; all 0 is IEEE.
FpModeGuard::FpModeGuard() {
    static_assert(sizeof saved_ == sizeof(std::uint32_t));
    asm volatile("vmrs %0, fpscr" : "=r"(saved_));
    asm volatile("vmsr fpscr, %0" : : "r"(0));
}

FpModeGuard::~FpModeGuard() { asm volatile("vmsr fpscr, %0" : : "r"(saved_)); }
#else
// The default environment is IEEE on every target: nearest, gradual underflow, traps masked.
FpModeGuard::FpModeGuard() {
    std::fegetenv(&saved_);
    std::fesetenv(FE_DFL_ENV);
}

FpModeGuard::~FpModeGuard() { std::fesetenv(&saved_); }
#endif

}  // namespace pileus
