# SPDX-License-Identifier: Apache-2.0
# Compiles kernels_cpu/isa/isa*.cpp once per instruction set the compiler knows.
# in: PILEUS_X86, PILEUS_KERNELS ("widest" among them: the widest that the machine at hand can run)
# -> out: PILEUS_ISA_OBJECTS, PILEUS_ISA_DEFINITIONS, PILEUS_ISA_NAMES
# kernels_cpu/isa/dispatch.cpp reads PILEUS_HAVE_<ISA> and chooses when the program starts;
# pileus_widest_isa(NAME) returns the widest of those built that the machine at hand can run.
include(CheckCXXCompilerFlag)
set(CMAKE_REQUIRED_QUIET ON)
set(PILEUS_ISA_OBJECTS)
set(PILEUS_ISA_DEFINITIONS)
set(PILEUS_ISA_NAMES)

file(GLOB PILEUS_ISA_SOURCES CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/kernels_cpu/isa/isa*.cpp")

# The groups of the rows of kernel_list.h; all but Always have a file isa_GROUP.cpp each.
function(pileus_kernel_groups result)
    set(list "${PROJECT_SOURCE_DIR}/kernels_cpu/isa/kernel_list.h")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${list}")
    file(READ "${list}" rows)
    string(REGEX MATCHALL "[A-Za-z]+, +(Device|Host)[)]" groups "${rows}")
    list(TRANSFORM groups REPLACE ",.*" "")
    list(REMOVE_DUPLICATES groups)
    set(${result} ${groups} PARENT_SCOPE)
endfunction()

# Checks of each pointer by itself take three quarters of the time to compile kernels with sanitizers.
# What they would find there the address sanitizer finds, too, or the vector loads themselves.
add_library(pileus_fewer_checks INTERFACE)
if(PILEUS_SANITIZE MATCHES "undefined")
    target_compile_options(pileus_fewer_checks INTERFACE
        -fno-sanitize=null,alignment,object-size,pointer-overflow)
endif()

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
        # The bits are the same at any level. -O2 is as fast as -O3 but for a few sources (below), a sixth smaller, and
        # quicker to compile. Where x86 and WebAssembly have vectors no program chooses the scalar kernels by itself:
        # they are there to compare with, and -O1 compiles soonest (-Os, a fifth smaller, leaves weak functions).
        set(level -O2)
        if(name STREQUAL "scalar" AND (PILEUS_X86 OR EMSCRIPTEN) AND NOT PILEUS_KERNELS STREQUAL "scalar")
            set(level -O1)
        endif()
        if(PILEUS_QUICK_KERNELS AND NOT name STREQUAL own_isa)
            set(level -O1)
        endif()
        target_compile_options(pileus_isa_${name} PRIVATE $<$<CONFIG:Release>:${level}> ${ARGN})
        target_link_libraries(pileus_isa_${name} PRIVATE pileus_flags pileus_nothrow
            pileus_fewer_checks)
        pileus_count_coverage(pileus_isa_${name})
        list(APPEND PILEUS_ISA_OBJECTS $<TARGET_OBJECTS:pileus_isa_${name}>)
        list(APPEND PILEUS_ISA_DEFINITIONS PILEUS_HAVE_${upper}=1)
        list(APPEND PILEUS_ISA_NAMES ${name})
    endif()
    foreach(result PILEUS_ISA_OBJECTS PILEUS_ISA_DEFINITIONS PILEUS_ISA_NAMES)
        set(${result} "${${result}}" PARENT_SCOPE)
    endforeach()
endfunction()

# Photons and marches take 4 % longer at -O2.
if(NOT EMSCRIPTEN AND NOT PILEUS_QUICK_KERNELS)
    foreach(source isa_photons isa_march)
        set_source_files_properties("${PROJECT_SOURCE_DIR}/kernels_cpu/isa/${source}.cpp"
            PROPERTIES COMPILE_OPTIONS "$<$<CONFIG:Release>:-O3>")
    endforeach()
endif()

# The last of the rows that `runs` here: a name and what dispatch.cpp asks the processor for.
function(pileus_widest_of result)
    set(flags "")
    if(NOT CMAKE_CROSSCOMPILING AND EXISTS /proc/cpuinfo)
        file(STRINGS /proc/cpuinfo flags REGEX "^flags" LIMIT_COUNT 1)
    endif()
    foreach(row "scalar" "sse2" "vec4" "avx2 avx2" "avx512 avx512f avx512vl avx512dq avx512bw")
        separate_arguments(row)
        list(POP_FRONT row name)
        if(NOT name IN_LIST ARGN)
            continue()
        endif()
        set(runs yes)
        foreach(flag IN LISTS row)
            if(NOT flags MATCHES " ${flag}( |$)")
                set(runs no)
            endif()
        endforeach()
        if(runs)
            set(widest ${name})
        endif()
    endforeach()
    set(${result} ${widest} PARENT_SCOPE)
endfunction()
function(pileus_widest_isa result)
    pileus_widest_of(widest ${PILEUS_ISA_NAMES})
    set(${result} ${widest} PARENT_SCOPE)
endfunction()

set(sets scalar vec4)
if(PILEUS_X86 AND CMAKE_SIZEOF_VOID_P EQUAL 8)
    set(sets scalar sse2 avx2 avx512)
elseif(PILEUS_X86)
    set(sets scalar sse2)
endif()
pileus_widest_of(own_isa ${sets})
list(TRANSFORM PILEUS_KERNELS REPLACE "^widest$" "${own_isa}")
pileus_add_isa(scalar 1)
if(PILEUS_X86)
    pileus_add_isa(sse2 4)
    if(CMAKE_SIZEOF_VOID_P EQUAL 8)
        set(fused -mno-fma)
        if(PILEUS_FREE_ARITHMETIC)
            set(fused -mfma)
        endif()
        set(moves)
        if(MINGW)
            # The stack of Windows is aligned to 16 bytes, and GCC takes it for more: its bug 54412.
            set(moves -Wa,-muse-unaligned-vector-move)
        endif()
        pileus_add_isa(avx2 8 -mavx2 ${fused} ${moves})
        pileus_add_isa(avx512 16 -mavx512f -mavx512vl -mavx512dq -mavx512bw ${fused}
            -mprefer-vector-width=512 ${moves})
    endif()
else()
    pileus_add_isa(vec4 4)
endif()
