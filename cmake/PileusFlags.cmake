# SPDX-License-Identifier: Apache-2.0
# Compiler flags under which the same source gives the same bits everywhere.
# in: compiler, PILEUS_WERROR, PILEUS_SANITIZE -> out: targets pileus_flags (all), pileus_strict
# docs: README.md; tools/check_objects proves the result on the object files

# Refuse flags that let the compiler change results.
set(given_flags "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_RELEASE} ${CMAKE_CXX_FLAGS_DEBUG}")
string(APPEND given_flags " ${CMAKE_CXX_FLAGS_RELWITHDEBINFO} ${CMAKE_CXX_FLAGS_MINSIZEREL}")
set(unsafe "fast-math|unsafe-math-optimizations|associative-math|reciprocal-math|finite-math-only")
if(given_flags MATCHES "(^| )(-f(${unsafe})|-Ofast)( |$)")
    message(FATAL_ERROR
        "CMAKE_CXX_FLAGS: ${CMAKE_MATCH_2} changes results, allowed: any flag but fast-math ones")
endif()
if(NOT CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
    message(FATAL_ERROR "compiler: needs vector extensions, ${CMAKE_CXX_COMPILER_ID}, "
        "allowed: GCC 12 or newer, Clang 14 or newer")
endif()

# Let the release build optimise as the house measures it.
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")

# Turn on for every file: warnings, and arithmetic exactly as written.
set(contract off)
if(PILEUS_FREE_ARITHMETIC)
    # What the promise of equal bits forbids: docs/performance.md, "What determinism costs".
    message(WARNING "PILEUS_FREE_ARITHMETIC: for timing only, the bits are not those of pileus")
    set(contract fast)
endif()
add_library(pileus_flags INTERFACE)
target_include_directories(pileus_flags INTERFACE "${PROJECT_SOURCE_DIR}")
target_compile_options(pileus_flags INTERFACE
    -Wall -Wextra -Wpedantic -Wshadow -Wno-psabi
    -ffp-contract=${contract} -fno-math-errno -fno-trapping-math)

# Sanitizers confuse GCC's flow analysis, so their build reports warnings without stopping. An object
# that the library makes has no type information, which tests with it would take for a broken one.
if(PILEUS_SANITIZE)
    target_compile_options(pileus_flags INTERFACE
        -fsanitize=${PILEUS_SANITIZE} -fno-sanitize=vptr -fno-sanitize-recover=all
        -fno-omit-frame-pointer)
    target_link_options(pileus_flags INTERFACE -fsanitize=${PILEUS_SANITIZE})
elseif(PILEUS_WERROR)
    target_compile_options(pileus_flags INTERFACE -Werror)
endif()

# Let libFuzzer see which edges an input reaches; its main program is linked by the targets only.
if(PILEUS_FUZZ)
    if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
        message(FATAL_ERROR
            "PILEUS_FUZZ: needs libFuzzer, ${CMAKE_CXX_COMPILER_ID}, allowed: Clang")
    endif()
    target_compile_options(pileus_flags INTERFACE -fsanitize=fuzzer-no-link)
endif()

# Keep 32-bit x86 off the x87 registers, whose extra bits depend on spilling.
set(PILEUS_X86 OFF)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64|i[3-6]86)$")
    set(PILEUS_X86 ON)
    if(CMAKE_SIZEOF_VOID_P EQUAL 4)
        target_compile_options(pileus_flags INTERFACE -msse2 -mfpmath=sse)
    endif()
endif()

# The library itself neither throws nor asks for types at run time. What a host may call is unwound
# where the C++ runtime finds no memory, so that nothing leaks; kernels never throw.
add_library(pileus_strict INTERFACE)
# What it shows of itself is the functions of pileus.h; sections of their own let a linker drop the rest.
target_compile_options(pileus_strict INTERFACE -fno-rtti -fvisibility=hidden
    -fvisibility-inlines-hidden -ffunction-sections -fdata-sections)
add_library(pileus_nothrow INTERFACE)
target_compile_options(pileus_nothrow INTERFACE -fno-exceptions)
target_link_libraries(pileus_nothrow INTERFACE pileus_strict)

# Counts what runs. Last of all options, so that nothing is left out of the count or moved about; without
# exceptions, which no flight has, for else every call would be a branch.
if(PILEUS_COVERAGE)
    if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        message(FATAL_ERROR "PILEUS_COVERAGE: needs gcov, ${CMAKE_CXX_COMPILER_ID}, allowed: GNU")
    endif()
    add_link_options(--coverage)
endif()
function(pileus_count_coverage)
    if(PILEUS_COVERAGE)
        foreach(target IN LISTS ARGN)
            target_compile_options(${target} PRIVATE --coverage -O0 -fno-exceptions -fno-threadsafe-statics)
            target_compile_definitions(${target} PRIVATE PILEUS_COVERAGE=1
                DOCTEST_CONFIG_NO_EXCEPTIONS_BUT_WITH_ALL_ASSERTS=1)
        endforeach()
    endif()
endfunction()
