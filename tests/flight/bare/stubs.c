/* SPDX-License-Identifier: Apache-2.0
 * All that the flight library asks of a C library, for boards that have none; whoever has one leaves
 * this out. in, out: ISO C's functions of these names. docs/flight.md, "Bare metal"
 * To be compiled with -fno-builtin, or a compiler takes these loops for the functions themselves. */
#include <math.h>
#include <stdint.h>
#include <string.h>

void* memcpy(void* restrict to, const void* restrict from, size_t size) {
    unsigned char* t = to;
    const unsigned char* f = from;
    /* Most of what is copied lies at multiples of 4. */
    if ((((uintptr_t)t | (uintptr_t)f) & 3) == 0)
        for (; size >= 4; size -= 4, t += 4, f += 4) *(uint32_t*)t = *(const uint32_t*)f;
    while (size-- > 0) *t++ = *f++;
    return to;
}

void* memmove(void* to, const void* from, size_t size) {
    unsigned char* t = to;
    const unsigned char* f = from;
    if ((uintptr_t)t <= (uintptr_t)f || (uintptr_t)t >= (uintptr_t)f + size)
        while (size-- > 0) *t++ = *f++;
    else
        while (size-- > 0) t[size] = f[size];
    return to;
}

void* memset(void* to, int byte, size_t size) {
    unsigned char* t = to;
    while (size-- > 0) *t++ = (unsigned char)byte;
    return to;
}

int memcmp(const void* one, const void* other, size_t size) {
    const unsigned char *a = one, *b = other;
    for (; size > 0; --size, ++a, ++b)
        if (*a != *b) return *a < *b ? -1 : 1;
    return 0;
}

void* memchr(const void* in, int byte, size_t size) {
    const unsigned char* at = in;
    for (; size > 0; --size, ++at)
        if (*at == (unsigned char)byte) return (void*)(uintptr_t)at;
    return NULL;
}

size_t strlen(const char* text) {
    size_t length = 0;
    while (text[length] != 0) ++length;
    return length;
}

/* From 2^52 on, and for what is no number, a double is whole; the sign of 0 stays. */
double floor(double x) {
    double whole;
    if (!(x > -4503599627370496.0 && x < 4503599627370496.0) || x == 0) return x;
    whole = (double)(int64_t)x;
    if (whole > x) whole -= 1;
    return whole;
}

double ceil(double x) { return -floor(-x); }
