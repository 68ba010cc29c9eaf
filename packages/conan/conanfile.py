# SPDX-License-Identifier: Apache-2.0
"""Recipe for Conan 2: the library, from the checkout that this file lies in.

in: options shared, openexr, png, zlib -> out: a package with the CMake target pileus::pileus.
docs/packages.md
"""
import os
import re

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy


class Pileus(ConanFile):
    name = "pileus"
    description = "Physically based pictures of clouds and other participating media on the CPU"
    license = "Apache-2.0"
    topics = ("clouds", "rendering", "volumes")
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "openexr": [True, False], "png": [True, False], "zlib": [True, False]}
    default_options = {"shared": True, "openexr": True, "png": True, "zlib": True}

    def set_version(self):
        with open(os.path.join(self.recipe_folder, "..", "..", "CMakeLists.txt"), encoding="utf-8") as file:
            text = file.read()
        self.version = (re.search(r"project\(pileus VERSION ([0-9.]+)", text).group(1) +
                        re.search(r'PILEUS_VERSION_SUFFIX "([^"]*)"', text).group(1))

    def export_sources(self):
        root = os.path.join(self.recipe_folder, "..", "..")
        for pattern in ("CMakeLists.txt", "LICENSE", "cmake/*", "include/*", "kernels_cpu/*", "lab/*", "platform/*",
                        "src/*", "assets/scenes/fair_weather.toml", "tools/view/default_scene.h.in"):
            copy(self, pattern, root, self.export_sources_folder)

    def requirements(self):
        # Headers alone, within the library.
        for package in ("cli11/2.4.2", "fast_float/6.1.1", "fmt/10.2.1", "glm/1.0.1", "nlohmann_json/3.11.3", "tomlplusplus/3.4.0",
                        "xxhash/0.8.2"):
            self.requires(package, visible=False)
        if self.options.openexr:
            self.requires("openexr/3.2.4")
        if self.options.png:
            self.requires("libpng/[>=1.6 <2]")
        if self.options.zlib:
            self.requires("zlib/[>=1.2.11 <2]")

    def layout(self):
        cmake_layout(self)

    def generate(self):
        CMakeDeps(self).generate()
        toolchain = CMakeToolchain(self)
        values = toolchain.cache_variables
        for name in ("PROGRAM", "TESTS", "BENCHMARKS", "WERROR", "BLOSC"):
            values[f"PILEUS_{name}"] = False
        values["PILEUS_SHARED"] = bool(self.options.shared)
        for name in ("openexr", "png", "zlib"):
            values[f"PILEUS_{name.upper()}"] = bool(self.options.get_safe(name))
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))

    def package_info(self):
        self.cpp_info.set_property("cmake_file_name", "pileus")
        self.cpp_info.set_property("cmake_target_name", "pileus::pileus")
        self.cpp_info.libs = ["pileus"]
        if not self.options.shared:
            self.cpp_info.defines = ["PILEUS_STATIC=1"]
            self.cpp_info.system_libs = ["stdc++", "m", "pthread", "dl"]
