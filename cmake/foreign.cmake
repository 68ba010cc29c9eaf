# SPDX-License-Identifier: Apache-2.0
# Toolchain: a foreign machine by Debian's cross compiler; programs run through qemu-user, those of Windows by Wine.
# in: PILEUS_TARGET, a row below -> out: a cross build on any host
# docs/determinism.md, "How it is checked"; presets of the same names; tools/check-isas

# Name, Debian's words for the machine, CMake's processor, the emulator.
set(rows
    "aarch64 aarch64-linux-gnu aarch64 qemu-aarch64"
    "armhf arm-linux-gnueabihf arm qemu-arm"
    "riscv64 riscv64-linux-gnu riscv64 qemu-riscv64"
    "ppc64le powerpc64le-linux-gnu ppc64le qemu-ppc64le"
    "ppc64 powerpc64-linux-gnu ppc64 qemu-ppc64"
    "ppc powerpc-linux-gnu ppc qemu-ppc"
    "s390x s390x-linux-gnu s390x qemu-s390x"
    "mips mips-linux-gnu mips qemu-mips"
    "mipsel mipsel-linux-gnu mipsel qemu-mipsel"
    "i386 i686-linux-gnu i686 qemu-i386"
    "mingw x86_64-w64-mingw32 AMD64 /usr/lib/wine/wine64")
# Trial compilations read this file too.
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES PILEUS_TARGET)
set(CMAKE_SYSTEM_NAME Linux)
foreach(row IN LISTS rows)
    separate_arguments(row)
    list(GET row 0 name)
    if(name STREQUAL PILEUS_TARGET)
        list(GET row 1 triplet)
        list(GET row 2 CMAKE_SYSTEM_PROCESSOR)
        list(GET row 3 CMAKE_CROSSCOMPILING_EMULATOR)
    endif()
endforeach()
if(NOT triplet)
    message(FATAL_ERROR "PILEUS_TARGET: unknown, \"${PILEUS_TARGET}\", allowed: see ${CMAKE_CURRENT_LIST_FILE}")
endif()
set(CMAKE_CXX_COMPILER ${triplet}-g++)
if(triplet MATCHES "mingw")
    # Windows, docs/windows.md: with POSIX threads, which std::thread needs.
    set(CMAKE_SYSTEM_NAME Windows)
    set(CMAKE_CXX_COMPILER ${triplet}-g++-posix)
    set(CMAKE_RC_COMPILER ${triplet}-windres)
    set(CMAKE_SHARED_LINKER_FLAGS_INIT -static)
endif()
set(CMAKE_FIND_ROOT_PATH /usr/${triplet})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
# A program with its libraries inside runs without a foreign root folder.
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
