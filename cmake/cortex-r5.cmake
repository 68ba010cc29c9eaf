# SPDX-License-Identifier: Apache-2.0
# Toolchain: ARM Cortex-R5 without an operating system, by Debian's gcc-arm-none-eabi and newlib.
# in: nothing -> out: a build of the flight library for bare metal, of examples that run in qemu-system-arm
# docs/flight.md, "Bare metal"; preset cortex-r5
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CMAKE_CROSSCOMPILING_EMULATOR "${CMAKE_CURRENT_LIST_DIR}/../tools/isas/run_cortex_r5")
# Nothing is linked before there is a start and a map of memory.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_FIND_ROOT_PATH /usr/lib/arm-none-eabi)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
# Headers alone are the host's (pileus_find_headers); such a system knows no folders of its own.
set(CMAKE_INCLUDE_PATH /usr/local/include /usr/include)
# Doubles are computed by the processor; libraries of the C runtime are those of ARMv7 with it.
foreach(language C CXX)
    set(CMAKE_${language}_FLAGS_INIT "-mcpu=cortex-r5 -mthumb -mfloat-abi=hard -mfpu=vfpv3-d16")
endforeach()
