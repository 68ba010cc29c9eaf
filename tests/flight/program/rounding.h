/* SPDX-License-Identifier: Apache-2.0
 * The caller's rounding, which calls give back: upwards, or to nearest.
 * in, out: the processor's mode, by <fenv.h> where the C library has it, else by ARM's own
 * register. */
#ifndef PILEUS_ROUNDING_H
#define PILEUS_ROUNDING_H
#include <fenv.h>

#ifdef FE_UPWARD
static void round_upwards(int up) { fesetround(up ? FE_UPWARD : FE_TONEAREST); }
static int rounds_upwards(void) { return fegetround() == FE_UPWARD; }
#else /* newlib for ARM */
static unsigned fp_mode(void) {
    unsigned mode;
    __asm__ volatile("vmrs %0, fpscr" : "=r"(mode));
    return mode;
}
static void round_upwards(int up) {
    const unsigned mode = (fp_mode() & ~(3u << 22)) | (up ? 1u << 22 : 0);
    __asm__ volatile("vmsr fpscr, %0" : : "r"(mode));
}
static int rounds_upwards(void) { return (fp_mode() >> 22 & 3) == 1; }
#endif

#endif
