# SPDX-License-Identifier: Apache-2.0
# Toolchain: Clang and libc++ of Zig, which has a C library for every system: PyPI's ziglang.
# in: PILEUS_TARGET, a row below; PILEUS_ZIG, the command -> out: a cross build on any host
# docs/packages.md, "Static programs"
set(rows
    "musl x86_64-linux-musl Linux x86_64"
    "macos-arm64 aarch64-macos Darwin arm64")
set(PILEUS_ZIG "python3;-m;ziglang" CACHE STRING "Zig, as a command")
# Trial compilations read this file too.
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES PILEUS_TARGET PILEUS_ZIG)
foreach(row IN LISTS rows)
    separate_arguments(row)
    list(GET row 0 name)
    if(name STREQUAL PILEUS_TARGET)
        list(GET row 1 triplet)
        list(GET row 2 CMAKE_SYSTEM_NAME)
        list(GET row 3 CMAKE_SYSTEM_PROCESSOR)
    endif()
endforeach()
if(NOT triplet)
    message(FATAL_ERROR "PILEUS_TARGET: unknown, \"${PILEUS_TARGET}\", allowed: see ${CMAKE_CURRENT_LIST_FILE}")
endif()
# CMake takes a compiler by one word, so that a script stands for several.
set(tools "${CMAKE_BINARY_DIR}/zig")
if(NOT EXISTS "${tools}/c++")
    list(JOIN PILEUS_ZIG " " zig)
    foreach(row "c++ c++;-target;${triplet}" "ar ar" "ranlib ranlib")
        separate_arguments(row)
        list(POP_FRONT row name)
        list(JOIN row " " words)
        string(REPLACE ";" " " words "${words}")
        file(WRITE "${tools}/${name}" "#!/bin/sh\nexec ${zig} ${words} \"$@\"\n")
        file(CHMOD "${tools}/${name}" PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
    endforeach()
endif()
# Without -O, as in trial compilations, Zig adds a sanitizer.
set(CMAKE_CXX_FLAGS_INIT "-fno-sanitize=undefined")
set(CMAKE_CXX_COMPILER "${tools}/c++")
set(CMAKE_AR "${tools}/ar" CACHE FILEPATH "")
set(CMAKE_RANLIB "${tools}/ranlib" CACHE FILEPATH "")
set(CMAKE_FIND_ROOT_PATH "${tools}")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
