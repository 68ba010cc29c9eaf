# SPDX-License-Identifier: Apache-2.0
# Compiles kernels_cpu/isa*.cpp once per instruction set the compiler knows.
# in: PILEUS_X86, PILEUS_KERNELS -> out: PILEUS_ISA_OBJECTS, PILEUS_ISA_DEFINITIONS, PILEUS_ISA_NAMES
# kernels_cpu/dispatch.cpp reads PILEUS_HAVE_<ISA> and chooses when the program starts.
include(CheckCXXCompilerFlag)
set(CMAKE_REQUIRED_QUIET ON)
set(PILEUS_ISA_OBJECTS)
set(PILEUS_ISA_DEFINITIONS)
set(PILEUS_ISA_NAMES)

file(GLOB PILEUS_ISA_SOURCES CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/kernels_cpu/isa*.cpp")

# One object per source: the namespace and the number of lanes come in as definitions.
function(pileus_add_isa name width)
    if(PILEUS_KERNELS AND NOT name IN_LIST PILEUS_KERNELS)
        return()
    endif()
    string(TOUPPER "${name}" upper)
    foreach(flag IN LISTS ARGN)
        string(MAKE_C_IDENTIFIER "PILEUS_TAKES${flag}" known)
        check_cxx_compiler_flag("${flag}" ${known})
        if(NOT ${known})
            return()
        endif()
    endforeach()
    if(PILEUS_ISA_SOURCES)
        add_library(pileus_isa_${name} OBJECT ${PILEUS_ISA_SOURCES})
        target_compile_definitions(pileus_isa_${name} PRIVATE
            PILEUS_ISA=${name} PILEUS_WIDTH=${width})
        target_compile_options(pileus_isa_${name} PRIVATE $<$<CONFIG:Release>:-O3> ${ARGN})
        target_link_libraries(pileus_isa_${name} PRIVATE pileus_flags pileus_strict)
        list(APPEND PILEUS_ISA_OBJECTS $<TARGET_OBJECTS:pileus_isa_${name}>)
        list(APPEND PILEUS_ISA_DEFINITIONS PILEUS_HAVE_${upper}=1)
        list(APPEND PILEUS_ISA_NAMES ${name})
    endif()
    foreach(result PILEUS_ISA_OBJECTS PILEUS_ISA_DEFINITIONS PILEUS_ISA_NAMES)
        set(${result} "${${result}}" PARENT_SCOPE)
    endforeach()
endfunction()

pileus_add_isa(scalar 1)
if(PILEUS_X86)
    pileus_add_isa(sse2 4)
    if(CMAKE_SIZEOF_VOID_P EQUAL 8)
        pileus_add_isa(avx2 8 -mavx2 -mno-fma)
        pileus_add_isa(avx512 16 -mavx512f -mavx512vl -mavx512dq -mavx512bw -mno-fma
            -mprefer-vector-width=512)
    endif()
else()
    pileus_add_isa(vec4 4)
endif()
