// SPDX-License-Identifier: Apache-2.0
// The way out of a call whose small objects find no room: a jump that the compiler makes itself.
// in: a place of the calling thread -> out: back there, by nothing of a C library.
// docs/flight.md, "Memory"
#pragma once

namespace pileus {

/// What the compiler keeps of a place: its frame, its stack, where to go on.
struct JumpPlace {
    void* words[5];
};

#ifdef PILEUS_FLIGHT
/// Leaves the call that is under way on this thread; it and all later ones of the session return
/// kLimit. src/flight/bare/memory.cpp
[[noreturn]] void leave_call();
#endif

}  // namespace pileus

// Whether somebody jumped here; 0 when it is reached in order. Libraries that throw have no need of
// it.
#ifdef PILEUS_FLIGHT
#define PILEUS_SET_JUMP(place) __builtin_setjmp((place).words)
#else
#define PILEUS_SET_JUMP(place) 0
#endif
