// SPDX-License-Identifier: Apache-2.0
// The kernels of one group as functions NAME_ISA of an object: all that isa_GROUP.cpp has but its
// headers. Compiled once per instruction set.
// in: PILEUS_GROUP_<Group> defined as 1, PILEUS_ISA (a name), PILEUS_WIDTH (lanes), the kernels'
// templates -> out: one exported function per row of the group, everything else internal.
// docs/architecture.md, "Kernels: written once"; tools/check_objects proves that nothing leaks.
#pragma once
#include "kernels_cpu/isa/kernels.h"

#ifndef PILEUS_WIDTH
#error "PILEUS_WIDTH is set by the build, one object per instruction set"
#endif
#ifdef __FAST_MATH__
#error "fast-math changes results; pileus needs IEEE arithmetic"
#endif

#define PILEUS_JOIN(a, b) PILEUS_JOIN_(a, b)
#define PILEUS_JOIN_(a, b) a##b
// trace_sse2 of trace
#define PILEUS_OF_ISA(name) PILEUS_JOIN(name##_, PILEUS_ISA)

// The code where `flag` is defined as 1, or where it is not. A flag that is defined brings a comma,
// which moves the choice on by one; one that is not stays a word that is dropped.
#define PILEUS_COMMA_1 ,
#define PILEUS_SECOND(first, second, ...) second
#define PILEUS_CHOICE(...) PILEUS_SECOND(__VA_ARGS__, ~)
#define PILEUS_SHOW(...) __VA_ARGS__
#define PILEUS_HIDE(...)
#define PILEUS_WHERE(flag, ...) \
    PILEUS_CHOICE(PILEUS_JOIN(PILEUS_COMMA_, flag) PILEUS_SHOW, PILEUS_HIDE)(__VA_ARGS__)
#define PILEUS_UNLESS(flag, ...) \
    PILEUS_CHOICE(PILEUS_JOIN(PILEUS_COMMA_, flag) PILEUS_HIDE, PILEUS_SHOW)(__VA_ARGS__)

namespace pileus {

static_assert(__FLT_EVAL_METHOD__ == 0, "floats must be computed as floats");

// Those of all groups, for the table of isa.cpp.
#define PILEUS_CALL(name, Result, parameters, names, group, where) \
    Result PILEUS_OF_ISA(name) parameters;
#define PILEUS_RANGE(name, Params, Buffers, group, where)                            \
    void PILEUS_OF_ISA(name)(const Params& k, const Buffers& b, std::uint32_t begin, \
                             std::uint32_t end);
#include "kernels_cpu/isa/kernel_list.h"

// Those of this group.
#define PILEUS_CALL(name, Result, parameters, names, group, where) \
    PILEUS_WHERE(                                                  \
        PILEUS_GROUP_##group,                                      \
        Result PILEUS_OF_ISA(name) parameters { return name<PILEUS_WIDTH> names; })
#define PILEUS_RANGE(name, Params, Buffers, group, where)                                \
    PILEUS_WHERE(                                                                        \
        PILEUS_GROUP_##group,                                                            \
        void PILEUS_OF_ISA(name)(const Params& k, const Buffers& b, std::uint32_t begin, \
                                 std::uint32_t end) { name<PILEUS_WIDTH>(k, b, begin, end); })
#include "kernels_cpu/isa/kernel_list.h"

}  // namespace pileus
