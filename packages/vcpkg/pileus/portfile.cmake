# SPDX-License-Identifier: Apache-2.0
# Builds the library from the checkout that this port lies in.
# in: features of vcpkg.json -> out: the header, the library, CMake and pkg-config files. docs/packages.md
cmake_path(SET SOURCE_PATH NORMALIZE "${CMAKE_CURRENT_LIST_DIR}/../../..")
vcpkg_check_features(OUT_FEATURE_OPTIONS features
    FEATURES
        blosc PILEUS_BLOSC
        openexr PILEUS_OPENEXR
        png PILEUS_PNG
        zlib PILEUS_ZLIB)
string(COMPARE EQUAL "${VCPKG_LIBRARY_LINKAGE}" dynamic shared)
vcpkg_cmake_configure(
    SOURCE_PATH "${SOURCE_PATH}"
    OPTIONS
        ${features}
        -DPILEUS_SHARED=${shared}
        -DPILEUS_PROGRAM=OFF
        -DPILEUS_TESTS=OFF
        -DPILEUS_BENCHMARKS=OFF
        -DPILEUS_WERROR=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(PACKAGE_NAME pileus CONFIG_PATH lib/cmake/pileus)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
file(INSTALL "${CMAKE_CURRENT_LIST_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
