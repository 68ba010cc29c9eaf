# SPDX-License-Identifier: Apache-2.0
# Prints what this build has and what was left out, and writes the same for scripts to read.
# in: PILEUS_<LIBRARY>, PILEUS_WITH_<LIBRARY>, PILEUS_ISA_NAMES -> out: a table, features.txt
# tools/quickstart and tools/check_objects read features.txt.
set(features "")
message(STATUS "pileus ${PILEUS_VERSION}: ${CMAKE_BUILD_TYPE}, ${CMAKE_CXX_COMPILER_ID} "
    "${CMAKE_CXX_COMPILER_VERSION}, ${CMAKE_SYSTEM_PROCESSOR}")
foreach(name OPENEXR PNG ZLIB BLOSC NETCDF ECCODES ASSIMP TIFF OIDN SDL2 OSMESA EGL THREADS OPENMP MPI CUDA TESTS BENCHMARKS)
    if(PILEUS_WITH_${name})
        set(state "yes")
    elseif(PILEUS_${name})
        set(state "no (not found)")
    else()
        set(state "no (switched off)")
    endif()
    string(TOLOWER "${name}" lower)
    string(APPEND features "${lower} ${PILEUS_WITH_${name}}\n")
    string(LENGTH "${lower}" length)
    math(EXPR gap "12 - ${length}")
    string(REPEAT " " ${gap} gap)
    message(STATUS "  ${lower}${gap}${state}")
endforeach()
list(JOIN PILEUS_ISA_NAMES " " isa_names)
message(STATUS "  kernels     ${isa_names}")

# A cross compiler's binutils share its prefix (aarch64-linux-gnu-).
cmake_path(GET CMAKE_CXX_COMPILER FILENAME compiler)
string(REGEX MATCH "^[A-Za-z0-9_]+-.*-" tool_prefix "${compiler}")
string(APPEND features "kernels ${isa_names}\ntool_prefix ${tool_prefix}\n")
file(WRITE "${PROJECT_BINARY_DIR}/features.txt" "${features}")
