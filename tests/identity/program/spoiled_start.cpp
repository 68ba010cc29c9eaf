// SPDX-License-Identifier: Apache-2.0
// Starts the program in a state that no one wants: rounding, flushing, traps, precision, locale.
// in: environment variable PILEUS_SPOIL, words between spaces -> out: the state before main; exit
// status 77 where this machine has no such state. docs/determinism.md, "How it is checked".
#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
#include <unistd.h>

#include <cfenv>
#include <clocale>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace {

constexpr int kNotHere = 77;

bool round_to(int mode) { return std::fesetround(mode) == 0; }

/// Results and operands too small for a full mantissa become 0.
bool flush_to_zero() {
#if defined(__SSE2__)
    _mm_setcsr(_mm_getcsr() | 0x8040u);
    return true;
#elif defined(__aarch64__)
    std::uint64_t word;
    __asm__ volatile("mrs %0, fpcr" : "=r"(word));
    __asm__ volatile("msr fpcr, %0" : : "r"(word | 1u << 24));
    return true;
#elif defined(__arm__) && defined(__ARM_FP)
    std::uint32_t word;
    __asm__ volatile("vmrs %0, fpscr" : "=r"(word));
    __asm__ volatile("vmsr fpscr, %0" : : "r"(word | 1u << 24));
    return true;
#elif defined(__mips_hard_float)
    std::uint32_t word;
    __asm__ volatile("cfc1 %0, $31" : "=r"(word));
    __asm__ volatile("ctc1 %0, $31" : : "r"(word | 1u << 24));
    return true;
#else
    return false;
#endif
}

bool unmask_traps() {
#ifdef _WIN32
    return false;
#else
    return ::feenableexcept(FE_ALL_EXCEPT) != -1;
#endif
}

/// The x87 registers of old round to floats instead of their 64 bits.
bool cut_x87() {
#if defined(__i386__) || defined(__x86_64__)
    std::uint16_t word;
    __asm__ volatile("fnstcw %0" : "=m"(word));
    word = std::uint16_t(word & ~0x0300u);
    __asm__ volatile("fldcw %0" : : "m"(word));
    return true;
#else
    return false;
#endif
}

/// One word of PILEUS_SPOIL; `locale` takes what the environment says.
bool spoil(const char* word) {
    if (std::strcmp(word, "up") == 0) return round_to(FE_UPWARD);
    if (std::strcmp(word, "down") == 0) return round_to(FE_DOWNWARD);
    if (std::strcmp(word, "zero") == 0) return round_to(FE_TOWARDZERO);
    if (std::strcmp(word, "flush") == 0) return flush_to_zero();
    if (std::strcmp(word, "traps") == 0) return unmask_traps();
    if (std::strcmp(word, "x87") == 0) return cut_x87();
    if (std::strcmp(word, "locale") == 0) return std::setlocale(LC_ALL, "") != nullptr;
    return false;
}

[[gnu::constructor]] void start() {
    const char* words = std::getenv("PILEUS_SPOIL");
    char word[16];
    while (words != nullptr && *words != '\0') {
        const std::size_t length = std::strcspn(words, " ");
        if (length >= sizeof word) ::_exit(kNotHere);
        std::memcpy(word, words, length);
        word[length] = '\0';
        if (length > 0 && !spoil(word)) ::_exit(kNotHere);
        words += length + (words[length] == ' ');
    }
}

}  // namespace
