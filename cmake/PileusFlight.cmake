# SPDX-License-Identifier: Apache-2.0
# The library of the flight profile: sessions over packed scenes, nothing else. docs/flight.md
# in: PILEUS_FLIGHT, PILEUS_FLIGHT_METHODS, PILEUS_FLIGHT_LEFT_OUT, kernels of PILEUS_KERNELS
# -> out: libpileus_flight.a, one object with the functions pileus_flight_* and pileus_session_*
if(NOT PILEUS_FLIGHT)
    return()
endif()
set(PILEUS_FLIGHT_METHODS "" CACHE STRING "Methods of the flight library; empty: all")
set(flight_methods collectors path raymarch optical-depth photon-grid particles)
if(PILEUS_FLIGHT_METHODS)
    foreach(method IN LISTS PILEUS_FLIGHT_METHODS)
        if(NOT method IN_LIST flight_methods)
            list(JOIN flight_methods ", " known)
            message(FATAL_ERROR "PILEUS_FLIGHT_METHODS: ${method}, allowed: ${known}")
        endif()
    endforeach()
    set(flight_methods ${PILEUS_FLIGHT_METHODS})
endif()
set(PILEUS_FLIGHT_LEFT_OUT "" CACHE STRING "Parts that no scene of a flight needs: lights, atmosphere")
foreach(part IN LISTS PILEUS_FLIGHT_LEFT_OUT)
    if(NOT part MATCHES "^(lights|atmosphere)$")
        message(FATAL_ERROR "PILEUS_FLIGHT_LEFT_OUT: ${part}, allowed: lights, atmosphere")
    endif()
endforeach()
if(NOT CMAKE_OBJCOPY OR NOT CMAKE_LINKER)
    message(FATAL_ERROR "PILEUS_FLIGHT: needs a linker and objcopy, allowed: GNU binutils")
endif()

include(src/flight/files.cmake)
add_library(pileus_flight_objects OBJECT ${flight_sources} kernels_cpu/isa/dispatch.cpp)
# Before the headers that they stand for.
target_include_directories(pileus_flight_objects BEFORE PRIVATE "${PROJECT_SOURCE_DIR}/src/flight/bare")
target_link_libraries(pileus_flight_objects PRIVATE pileus_flags pileus_headers pileus_nothrow)
target_compile_definitions(pileus_flight_objects PRIVATE PILEUS_FLIGHT=1 PILEUS_STATIC=1
    PILEUS_VERSION_TEXT="${PILEUS_VERSION}" ${PILEUS_ISA_DEFINITIONS})
if(CMAKE_SYSTEM_NAME STREQUAL "Generic")
    target_compile_definitions(pileus_flight_objects PRIVATE PILEUS_ONE_THREAD=1)
endif()
# One file knows the methods, so that another choice compiles little else.
set(flight_names)
foreach(method IN LISTS flight_methods)
    string(MAKE_C_IDENTIFIER "PILEUS_FLIGHT_${method}" name)
    string(TOUPPER ${name} name)
    list(APPEND flight_names ${name}=1)
endforeach()
set_source_files_properties(src/flight/bare/registry.cpp
    PROPERTIES COMPILE_DEFINITIONS "${flight_names}" SKIP_UNITY_BUILD_INCLUSION ON)
set(flight_options -fno-threadsafe-statics -fno-asynchronous-unwind-tables -fno-unwind-tables
    -fstack-usage)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    list(APPEND flight_options -fcallgraph-info=su)
endif()
target_compile_options(pileus_flight_objects PRIVATE ${flight_options} -Oz)
pileus_count_coverage(pileus_flight_objects)
# A compiler cache would not bring back what the compiler writes of stacks and calls.
set_target_properties(pileus_flight_objects PROPERTIES POSITION_INDEPENDENT_CODE OFF
    CXX_COMPILER_LAUNCHER "")
# Rows of what texts say, which nothing in a flight reads, each by itself: on 64-bit PowerPC the addresses that a
# file's functions use are kept or dropped as one.
file(GLOB flight_rows CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/src/world/phase/phase_*.cpp")
set_source_files_properties(${flight_rows} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
pileus_compile_together(pileus_flight_objects 12 flight)

# Kernels once more, of the groups (kernels_cpu/isa/kernel_list.h) that the chosen methods call. Solid meshes
# and marched detail are in no flight; an image of solids is what PathFull meets.
set(groups_of_collectors Photons March Billboards Upsampling Lamps)
set(groups_of_photon-grid Photons Cells March Upsampling Lamps)
set(groups_of_path Path PathFull March)
set(groups_of_raymarch Raymarch Sky Upsampling Sweep Lamps)
set(groups_of_optical-depth Raymarch Sweep Lamps)
set(groups_of_particles Particles Sweep Lamps)
set(groups_of_lights Lamps)
set(groups_of_atmosphere Air)
set(flight_groups Always Air)
foreach(method IN LISTS flight_methods)
    list(APPEND flight_groups ${groups_of_${method}})
endforeach()
set(flight_parts)
foreach(part IN LISTS PILEUS_FLIGHT_LEFT_OUT)
    string(TOUPPER ${part} name)
    list(APPEND flight_parts PILEUS_WITHOUT_${name})
    list(REMOVE_ITEM flight_groups ${groups_of_${part}})
endforeach()
set(flight_kernels ${PILEUS_ISA_SOURCES})
set(flight_without)
pileus_kernel_groups(kernel_groups)
foreach(group IN LISTS kernel_groups)
    if(NOT group IN_LIST flight_groups)
        list(APPEND flight_without PILEUS_WITHOUT_${group}=1)
        string(REGEX REPLACE "(.)([A-Z])" "\\1_\\2" name ${group})
        string(TOLOWER ${name} name)
        list(REMOVE_ITEM flight_kernels "${PROJECT_SOURCE_DIR}/kernels_cpu/isa/isa_${name}.cpp")
    endif()
endforeach()
target_compile_definitions(pileus_flight_objects PRIVATE ${flight_parts})
# For size all of them as one file: what two groups call is there once, a third less of them; and paths of every
# kind are traced by one kernel, another ninth of the library.
if(CMAKE_BUILD_TYPE STREQUAL "MinSizeRel" AND NOT PILEUS_COVERAGE)
    list(APPEND flight_parts PILEUS_ONE_PATH_KERNEL)
    set(headers)
    set(groups)
    foreach(source IN LISTS flight_kernels)
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${source}")
        file(READ "${source}" text)
        string(REGEX REPLACE "#include \"kernels_cpu/isa/.*" "" head "${text}")
        string(REGEX MATCHALL "#include [^\n]*\n" own "${head}")
        string(REGEX MATCHALL "#define PILEUS_GROUP_[^\n]*\n" group "${head}")
        list(APPEND headers ${own})
        list(APPEND groups ${group})
    endforeach()
    list(REMOVE_DUPLICATES headers)
    list(JOIN headers "" headers)
    list(JOIN groups "" groups)
    set(flight_kernels "${PROJECT_BINARY_DIR}/generated/flight/kernels.cpp")
    file(CONFIGURE OUTPUT "${flight_kernels}" CONTENT
        "${headers}${groups}#include \"kernels_cpu/isa/kernel_group.h\"\n#include \"kernels_cpu/isa/isa.cpp\"\n")
endif()
set(flight_isa_objects)
foreach(isa IN LISTS PILEUS_ISA_NAMES)
    add_library(pileus_flight_${isa} OBJECT ${flight_kernels})
    foreach(property COMPILE_DEFINITIONS COMPILE_OPTIONS)
        get_target_property(value pileus_isa_${isa} ${property})
        set_target_properties(pileus_flight_${isa} PROPERTIES ${property} "${value}")
    endforeach()
    target_compile_options(pileus_flight_${isa} PRIVATE ${flight_options})
    target_compile_definitions(pileus_flight_${isa} PRIVATE PILEUS_FLIGHT=1 ${flight_parts} ${flight_without})
    target_include_directories(pileus_flight_${isa} BEFORE PRIVATE "${PROJECT_SOURCE_DIR}/src/flight/bare")
    pileus_count_coverage(pileus_flight_${isa})
    target_link_libraries(pileus_flight_${isa} PRIVATE pileus_flags pileus_nothrow)
    set_target_properties(pileus_flight_${isa} PROPERTIES POSITION_INDEPENDENT_CODE OFF
        CXX_COMPILER_LAUNCHER "")
    list(APPEND flight_isa_objects $<TARGET_OBJECTS:pileus_flight_${isa}>)
endforeach()

# One object: of all that was compiled what the functions of the headers reach.
set(flight_functions init default version api_version orbit packed_read flight_open flight_close flight_usage)
foreach(name size set_camera set_matrices set_sun set_environment set_ground set_lamps set_placement set_depth
        set_frame set_work work govern most_units fit progress step render stats)
    list(APPEND flight_functions session_${name})
endforeach()
set(flight_roots)
set(flight_globals)
foreach(name IN LISTS flight_functions)
    list(APPEND flight_roots -u pileus_${name})
    list(APPEND flight_globals --keep-global-symbol=pileus_${name})
endforeach()
set(flight_object "${PROJECT_BINARY_DIR}/pileus_flight.o")
add_custom_command(OUTPUT "${flight_object}"
    COMMAND "${CMAKE_LINKER}" -r --gc-sections ${flight_roots} -o "${flight_object}.all"
        $<TARGET_OBJECTS:pileus_flight_objects> ${flight_isa_objects}
    COMMAND "${CMAKE_OBJCOPY}" ${flight_globals} --remove-section=.comment "${flight_object}.all"
        "${flight_object}.whole"
    COMMAND "${CMAKE_OBJCOPY}" --strip-unneeded "${flight_object}.whole" "${flight_object}"
    DEPENDS $<TARGET_OBJECTS:pileus_flight_objects> ${flight_isa_objects}
    COMMAND_EXPAND_LISTS VERBATIM)
add_custom_target(pileus_flight_object DEPENDS "${flight_object}")
add_library(pileus_flight STATIC "${flight_object}")
add_dependencies(pileus_flight pileus_flight_object)
set_target_properties(pileus_flight PROPERTIES LINKER_LANGUAGE CXX)
target_include_directories(pileus_flight INTERFACE
    "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
target_compile_definitions(pileus_flight INTERFACE PILEUS_STATIC=1)
add_library(pileus::flight ALIAS pileus_flight)
set_target_properties(pileus_flight PROPERTIES EXPORT_NAME flight)
if(PILEUS_INSTALL)
    install(TARGETS pileus_flight EXPORT pileusFlight COMPONENT flight)
    install(EXPORT pileusFlight NAMESPACE pileus:: DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/pileus"
        COMPONENT flight)
endif()

# The examples, which tools/flight flies with, and what it tries besides.
set(flight_programs
    "flight_loop tests/flight/examples/flight_loop.c"
    "flight_faults tests/flight/program/flight_faults.c"
    "flight_settings tests/flight/program/flight_settings.c"
    "flight_task tests/flight/program/fly_task.c tests/flight/examples/flight_task.c")
set(flight_board tests/flight/program/board_host.c)
set(flight_start)
if(CMAKE_SYSTEM_NAME STREQUAL "Generic")
    # Images. Only flight_task does without a C library: tests/flight/bare has all that it takes.
    enable_language(C)
    set(flight_board tests/flight/bare/semihosting.c tests/flight/bare/start.c tests/flight/bare/stubs.c)
    set(flight_start tests/flight/bare/start.c)
    set_source_files_properties(tests/flight/bare/stubs.c PROPERTIES COMPILE_OPTIONS -fno-builtin)
endif()
add_custom_target(flight_programs)
foreach(row IN LISTS flight_programs)
    separate_arguments(row)
    list(POP_FRONT row name)
    set(flight_links)
    if(name STREQUAL "flight_task")
        list(APPEND row ${flight_board})
        set(flight_links -nostdlib -nostartfiles)
        set(flight_runtime gcc)
    else()
        list(APPEND row ${flight_start})
        set(flight_links --specs=rdimon.specs)
        set(flight_runtime m)
    endif()
    add_executable(${name} EXCLUDE_FROM_ALL ${row})
    add_dependencies(flight_programs ${name})
    target_link_libraries(${name} PRIVATE pileus_flight)
    target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}")
    if(CMAKE_SYSTEM_NAME STREQUAL "Generic")
        set_target_properties(${name} PROPERTIES LINKER_LANGUAGE C POSITION_INDEPENDENT_CODE OFF
            COMPILE_OPTIONS "-std=c99;-Wall;-Wextra;-Wpedantic;-Werror"
            LINK_DEPENDS "${PROJECT_SOURCE_DIR}/tests/flight/bare/image.ld")
        target_link_options(${name} PRIVATE -T "${PROJECT_SOURCE_DIR}/tests/flight/bare/image.ld"
            -Wl,--gc-sections -Wl,--no-warn-rwx-segments ${flight_links})
        target_link_libraries(${name} PRIVATE ${flight_runtime})
    else()
        set_source_files_properties(${row} PROPERTIES LANGUAGE CXX)
    endif()
endforeach()
