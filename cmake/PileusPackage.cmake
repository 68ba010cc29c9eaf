# SPDX-License-Identifier: Apache-2.0
# Debian packages and a tar that may lie anywhere, by cpack: the program, the shared library, what programs are built with.
# in: components program, library, dev -> out: pileus_*.deb, libpileus1_*.deb, libpileus-dev_*.deb; pileus-*.tar.gz
# docs/packages.md; tools/release builds and tries them. Libraries lie where Debian has them with -DCMAKE_INSTALL_PREFIX=/usr.
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/pileus" RENAME copyright COMPONENT program)
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/libpileus1" RENAME copyright COMPONENT library)
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/libpileus-dev" RENAME copyright COMPONENT dev)

set(CPACK_PACKAGE_NAME pileus)
set(CPACK_PACKAGE_VENDOR pileus)
set(CPACK_PACKAGE_CONTACT "pileus <pileus@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "physically based pictures of clouds and other participating media")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_PACKAGE_FILE_NAME "pileus-${PROJECT_VERSION}-${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR}")
set(CPACK_STRIP_FILES ON)
set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL program library dev)
if(NOT PILEUS_HAS_SHARED)
    list(REMOVE_ITEM CPACK_COMPONENTS_ALL library)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME pileus)
# Loaded when a scene asks for them.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "libnetcdf19, libeccodes0, libassimp5, libtiff6, libsdl2-2.0-0, libegl1")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libpileus1)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_RECOMMENDS "libnetcdf19, libeccodes0, libassimp5, libtiff6, libegl1")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA "${PROJECT_SOURCE_DIR}/cmake/debian/triggers")
set(CPACK_DEBIAN_DEV_PACKAGE_NAME libpileus-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libpileus1 (= ${PROJECT_VERSION})")
# For programs that take the static library.
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS "libopenexr-dev, libpng-dev, zlib1g-dev, libblosc-dev, libglm-dev")
foreach(name "PROGRAM pictures of clouds: the program" "LIBRARY pictures of clouds: the shared library"
        "DEV pictures of clouds: headers and libraries to build with")
    string(REGEX MATCH "^[A-Z]+" component "${name}")
    string(REGEX REPLACE "^[A-Z]+ " "" text "${name}")
    set(CPACK_COMPONENT_${component}_DESCRIPTION "${text}")
endforeach()
include(CPack)
