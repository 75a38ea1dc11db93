"""A recipe of this folder's sources: conan create packaging/conan --build=missing"""
import os

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy

SOURCES = ("CMakeLists.txt", "LICENSE", "cmake/*", "include/*", "src/*", "apps/*", "share/*")


class Kte(ConanFile):
    name = "kte"
    version = "0.1.0"
    license = "MIT"
    author = "The kte contributors"
    description = "Multibody dynamics of chains composed at compile time or at run time"
    topics = ("multibody dynamics", "rigid-body dynamics", "robotics")
    settings = "os", "compiler", "build_type", "arch"
    package_type = "static-library"
    options = {"fPIC": [True, False]}
    default_options = {"fPIC": True}
    implements = ["auto_shared_fpic"]

    def requirements(self):
        self.requires("eigen/3.4.0", transitive_headers=True)
        self.requires("boost/1.83.0", transitive_headers=True, options={"header_only": True})
        self.requires("cereal/1.3.2", transitive_headers=True)
        self.requires("tinyxml2/10.0.0", transitive_headers=True)

    def export_sources(self):
        root = os.path.join(self.recipe_folder, "..", "..")
        for pattern in SOURCES:
            copy(self, pattern, src=root, dst=self.export_sources_folder)

    def layout(self):
        cmake_layout(self)

    def generate(self):
        CMakeDeps(self).generate()
        toolchain = CMakeToolchain(self)
        for part in ("TESTS", "BENCH", "EXAMPLES", "PROGRAM", "VIEW"):
            toolchain.cache_variables[f"KTE_BUILD_{part}"] = False
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", src=self.source_folder, dst=os.path.join(self.package_folder, "licenses"))
        CMake(self).install()

    def package_info(self):
        # the targets kte::kte, kte::compiled, ... are those of kte's own CMake package
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs.append(os.path.join("share", "cmake", "kte"))
        self.cpp_info.defines = ["KTE_COMPILED"]
        self.cpp_info.libs = ["kte"]
