"""Conan 2 recipe of this repository: conan create packaging/conan"""

from pathlib import Path

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy


class NacreRecipe(ConanFile):
    name = "nacre"
    version = "0.1.0"
    description = "Real-time subsurface scattering and translucency for Vulkan"
    package_type = "library"
    settings = "os", "compiler", "build_type", "arch"
    options = {"shared": [True, False], "fPIC": [True, False], "files": [True, False]}
    default_options = {"shared": False, "fPIC": True, "files": False}

    def export_sources(self):
        root = Path(self.recipe_folder).parent.parent
        for pattern in ("CMakeLists.txt", "LICENSE", "cmake/*", "core/*", "effect/*", "include/*"):
            copy(self, pattern, root, self.export_sources_folder)

    def config_options(self):
        if self.settings.os == "Windows":
            del self.options.fPIC

    def requirements(self):
        self.requires("vulkan-headers/1.3.239.0", transitive_headers=True)
        if self.options.files:
            self.requires("nlohmann_json/3.11.2")

    def build_requirements(self):
        self.tool_requires("shaderc/2024.1")

    def layout(self):
        cmake_layout(self)

    def generate(self):
        CMakeDeps(self).generate()
        toolchain = CMakeToolchain(self)
        for option in ("APP", "TESTS", "BASELINES"):
            toolchain.variables[f"NACRE_BUILD_{option}"] = False
        toolchain.variables["NACRE_BUILD_FILES"] = bool(self.options.files)
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()

    def package_info(self):
        # The package's own configuration is found, targets nacre::nacre and nacre::core.
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs = ["lib/cmake/nacre"]
