# SPDX-License-Identifier: Apache-2.0
# Compiles kernels_cpu/isa/*.cu by nvcc: the kernels' own sources, for NVIDIA's devices.
# in: PILEUS_CUDA, PILEUS_CUDA_ARCHITECTURE, CMAKE_CUDA_COMPILER -> out: PILEUS_CUDA_OBJECTS, the
# runtime in PILEUS_LINK_LIBRARIES, <build>/cuda/*.ptx for tools/check_objects. docs/crosscheck.md
set(PILEUS_CUDA_OBJECTS)
set(PILEUS_WITH_CUDA 0)
if(NOT PILEUS_CUDA)
    return()
endif()
find_program(PILEUS_NVCC NAMES "${CMAKE_CUDA_COMPILER}" nvcc
    HINTS /usr/local/cuda/bin "$ENV{CUDA_PATH}/bin")
if(NOT PILEUS_NVCC)
    message(FATAL_ERROR "PILEUS_CUDA: needs nvcc, not found, "
        "allowed: -DCMAKE_CUDA_COMPILER=FILE, or nvcc below /usr/local/cuda/bin")
endif()
cmake_path(GET PILEUS_NVCC PARENT_PATH cuda_bin)
cmake_path(GET cuda_bin PARENT_PATH cuda_root)
find_path(PILEUS_CUDA_INCLUDE cuda_runtime_api.h
    HINTS "${cuda_root}/include" "${cuda_root}/targets/x86_64-linux/include")
find_library(PILEUS_CUDA_RUNTIME cudart_static
    HINTS "${cuda_root}/lib64" "${cuda_root}/targets/x86_64-linux/lib")
mark_as_advanced(PILEUS_NVCC PILEUS_CUDA_INCLUDE PILEUS_CUDA_RUNTIME)
if(NOT PILEUS_CUDA_INCLUDE OR NOT PILEUS_CUDA_RUNTIME)
    message(FATAL_ERROR "PILEUS_CUDA: needs the CUDA runtime, not found beside ${PILEUS_NVCC}, "
        "allowed: a whole CUDA toolkit")
endif()

# One kind of machine code, and PTX from which a driver makes that of any later device.
set(PILEUS_CUDA_ARCHITECTURE 80 CACHE STRING "Compute capability to compile for, without its dot")
set(cuda_flags -std=c++17 -O3 -fmad=false -ftz=false -prec-div=true -prec-sqrt=true
    --expt-relaxed-constexpr -diag-suppress=1675
    -Xcompiler=-fPIC -DPILEUS_ISA=cuda "-I${PROJECT_SOURCE_DIR}")
file(GLOB cuda_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/kernels_cpu/isa/*.cu")
file(GLOB_RECURSE cuda_headers CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/kernels_cpu/*.h")
file(MAKE_DIRECTORY "${PROJECT_BINARY_DIR}/cuda")
foreach(source IN LISTS cuda_sources)
    cmake_path(GET source STEM stem)
    set(object "${PROJECT_BINARY_DIR}/cuda/${stem}.o")
    add_custom_command(OUTPUT "${object}"
        COMMAND "${PILEUS_NVCC}" ${cuda_flags}
            -gencode "arch=compute_${PILEUS_CUDA_ARCHITECTURE},code=[compute_${PILEUS_CUDA_ARCHITECTURE},sm_${PILEUS_CUDA_ARCHITECTURE}]"
            -keep "-keep-dir=${PROJECT_BINARY_DIR}/cuda"
            -c "${source}" -o "${object}"
        DEPENDS "${source}" ${cuda_headers}
        COMMENT "Building CUDA object ${stem}.o" VERBATIM)
    list(APPEND PILEUS_CUDA_OBJECTS "${object}")
    # Without the device's assembler, which takes as long again: tools/check_objects --ptx reads it.
    add_custom_command(OUTPUT "${PROJECT_BINARY_DIR}/cuda/${stem}.alone.ptx"
        COMMAND "${PILEUS_NVCC}" ${cuda_flags} -ptx
            -arch=compute_${PILEUS_CUDA_ARCHITECTURE} "${source}"
            -o "${PROJECT_BINARY_DIR}/cuda/${stem}.alone.ptx"
        DEPENDS "${source}" ${cuda_headers}
        COMMENT "Building ${stem}.alone.ptx" VERBATIM)
    list(APPEND ptx_files "${PROJECT_BINARY_DIR}/cuda/${stem}.alone.ptx")
endforeach()
add_custom_target(pileus_ptx DEPENDS ${ptx_files})
set_source_files_properties(${PILEUS_CUDA_OBJECTS} PROPERTIES EXTERNAL_OBJECT ON GENERATED ON)
set_source_files_properties(platform/cuda_device.cpp src/run/find_kernels.cpp PROPERTIES
    COMPILE_DEFINITIONS PILEUS_WITH_CUDA=1)
set_source_files_properties(platform/cuda_device.cpp PROPERTIES
    COMPILE_OPTIONS "-isystem;${PILEUS_CUDA_INCLUDE}")
list(APPEND PILEUS_LINK_LIBRARIES "${PILEUS_CUDA_RUNTIME}" Threads::Threads ${CMAKE_DL_LIBS} rt)
find_package(Threads REQUIRED)
set(PILEUS_WITH_CUDA 1)
