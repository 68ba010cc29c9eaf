# SPDX-License-Identifier: Apache-2.0
# What others link: a static and a shared library that show pileus.h alone, and how they are found.
# in: object libraries, PILEUS_WITH_<LIBRARY> -> out: targets pileus::pileus, pileus::static, rules to install
# docs/embedding.md; tests/embed builds programs against an installed tree
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(objects $<TARGET_OBJECTS:pileus_objects> $<TARGET_OBJECTS:pileus_api> $<TARGET_OBJECTS:pileus_lab>
    $<TARGET_OBJECTS:pileus_dispatch> ${PILEUS_ISA_OBJECTS}
    ${PILEUS_CUDA_OBJECTS})
add_library(pileus_static STATIC ${objects})
set(libraries pileus_static)
set(PILEUS_HAS_SHARED FALSE)
# A foreign machine's programs are static, but for Windows, and sanitizers belong to programs.
if(PILEUS_SHARED AND (WIN32 OR NOT CMAKE_CROSSCOMPILING) AND NOT PILEUS_SANITIZE)
    set(PILEUS_SOVERSION ${PROJECT_VERSION_MAJOR})
    add_library(pileus_shared SHARED ${objects})
    target_link_libraries(pileus_shared PRIVATE ${PILEUS_LINK_LIBRARIES})
    target_link_options(pileus_shared PRIVATE -Wl,--no-undefined -Wl,--gc-sections)
    if(WIN32)
        # pileus.dll, libpileus.dll.a; what it shows the header says.
        set_target_properties(pileus_shared PROPERTIES PREFIX "")
    else()
        target_link_options(pileus_shared PRIVATE -Wl,--version-script=${PROJECT_SOURCE_DIR}/cmake/pileus.map)
        set_target_properties(pileus_shared PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION ${PILEUS_SOVERSION}
            LINK_DEPENDS "${PROJECT_SOURCE_DIR}/cmake/pileus.map")
    endif()
    list(APPEND libraries pileus_shared)
    set(PILEUS_HAS_SHARED TRUE)
endif()
set_target_properties(${libraries} PROPERTIES OUTPUT_NAME pileus LINKER_LANGUAGE CXX)

# What a static library's program needs besides, for CMake and for pkg-config.
set(PILEUS_DEPENDENCIES)
set(PILEUS_STATIC_LINKS stdc++ m)
set(PILEUS_PC_REQUIRES)
set(PILEUS_PC_LIBS "-lstdc++ -lm")
foreach(row "OPENEXR OpenEXR OpenEXR::OpenEXR OpenEXR" "PNG PNG PNG::PNG libpng"
        "ZLIB ZLIB ZLIB::ZLIB zlib")
    separate_arguments(row)
    list(POP_FRONT row name package target pc)
    if(PILEUS_WITH_${name})
        string(APPEND PILEUS_DEPENDENCIES "find_dependency(${package})\n")
        list(APPEND PILEUS_STATIC_LINKS ${target})
        string(APPEND PILEUS_PC_REQUIRES " ${pc}")
    endif()
endforeach()
if(PILEUS_WITH_BLOSC)
    list(APPEND PILEUS_STATIC_LINKS blosc)
    string(APPEND PILEUS_PC_LIBS " -lblosc")
endif()
if(PILEUS_WITH_OPENMP)
    list(APPEND PILEUS_STATIC_LINKS ${PILEUS_OPENMP_RUNTIME})
    string(APPEND PILEUS_PC_LIBS " ${PILEUS_OPENMP_RUNTIME}")
endif()
# The toolkit is not installed with pileus: its runtime is named where it stands.
if(PILEUS_WITH_CUDA)
    list(APPEND PILEUS_STATIC_LINKS "${PILEUS_CUDA_RUNTIME}" rt)
    string(APPEND PILEUS_PC_LIBS " ${PILEUS_CUDA_RUNTIME} -lrt")
endif()
if(NOT CMAKE_CROSSCOMPILING)
    list(APPEND PILEUS_STATIC_LINKS ${CMAKE_DL_LIBS} pthread)
    string(APPEND PILEUS_PC_LIBS " -ldl -lpthread")
endif()

foreach(library IN LISTS libraries)
    target_include_directories(${library} INTERFACE
        "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
endforeach()
target_compile_definitions(pileus_static INTERFACE PILEUS_STATIC)
target_link_libraries(pileus_static INTERFACE ${PILEUS_STATIC_LINKS})
# The names of an installed tree, for projects that have this one within them.
add_library(pileus::static ALIAS pileus_static)
set_target_properties(pileus_static PROPERTIES EXPORT_NAME static)
if(PILEUS_HAS_SHARED)
    add_library(pileus::pileus ALIAS pileus_shared)
    set_target_properties(pileus_shared PROPERTIES EXPORT_NAME pileus)
else()
    add_library(pileus::pileus ALIAS pileus_static)
endif()
if(NOT PILEUS_INSTALL)
    return()
endif()

set(package "${CMAKE_INSTALL_LIBDIR}/cmake/pileus")
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/pileusConfig.cmake.in"
    "${PROJECT_BINARY_DIR}/package/pileusConfig.cmake" INSTALL_DESTINATION "${package}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/package/pileusConfigVersion.cmake"
    COMPATIBILITY SameMajorVersion)
# The tree may be moved.
cmake_path(RELATIVE_PATH CMAKE_INSTALL_PREFIX BASE_DIRECTORY
    "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig" OUTPUT_VARIABLE PILEUS_PC_UP)
configure_file("${PROJECT_SOURCE_DIR}/cmake/pileus.pc.in" "${PROJECT_BINARY_DIR}/package/pileus.pc"
    @ONLY)
# Of each library a file of its own: those who take the shared one need none of what the static one links.
install(TARGETS pileus_static EXPORT pileusStatic COMPONENT dev)
install(EXPORT pileusStatic NAMESPACE pileus:: DESTINATION "${package}" COMPONENT dev)
if(PILEUS_HAS_SHARED)
    install(TARGETS pileus_shared EXPORT pileusShared RUNTIME COMPONENT library ARCHIVE COMPONENT dev
        LIBRARY COMPONENT library NAMELINK_COMPONENT dev)
    install(EXPORT pileusShared NAMESPACE pileus:: DESTINATION "${package}" COMPONENT dev)
endif()
install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/pileus" TYPE INCLUDE COMPONENT dev)
install(FILES "${PROJECT_BINARY_DIR}/package/pileusConfig.cmake"
    "${PROJECT_BINARY_DIR}/package/pileusConfigVersion.cmake" DESTINATION "${package}" COMPONENT dev)
install(FILES "${PROJECT_BINARY_DIR}/package/pileus.pc"
    DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig" COMPONENT dev)
