"""Kiri for Conan 2: `conan create bindings/conan`, and requires("kiri/[>=0.27]") in a project; kiri::kiri in CMake."""

import re

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain
from conan.tools.files import copy, load


class Kiri(ConanFile):
    name = "kiri"
    description = "Cuts thin sheets while they move, inside a game's fixed tick"
    license = "MIT"
    topics = ("cloth", "paper", "cutting", "physics", "games")
    package_type = "library"
    settings = "os", "compiler", "build_type", "arch"
    options = {"shared": [True, False], "fPIC": [True, False]}
    default_options = {"shared": False, "fPIC": True}
    implements = ["auto_shared_fpic"]

    def set_version(self):
        header = load(self, f"{self.recipe_folder}/../../include/kiri/kiri.h")
        self.version = ".".join(re.findall(r"define KIRI_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)", header))

    def export_sources(self):
        for pattern in ("LICENSE", "include/*", "src/*", "bindings/cmake/*"):
            copy(self, pattern, f"{self.recipe_folder}/../..", self.export_sources_folder)

    def requirements(self):
        self.requires("eigen/[>=3.3 <4]")

    def generate(self):
        CMakeDeps(self).generate()
        CMakeToolchain(self).generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure(build_script_folder="bindings/cmake")
        cmake.build()

    def package(self):
        copy(self, "LICENSE", self.source_folder, f"{self.package_folder}/licenses")
        CMake(self).install()

    def package_info(self):
        self.cpp_info.libs = ["kiri"]
        self.cpp_info.set_property("cmake_target_name", "kiri::kiri")
        if self.options.shared:
            self.cpp_info.defines = ["KIRI_SHARED"]
        elif self.settings.os != "Windows":
            self.cpp_info.system_libs = ["m", "c++" if self.settings.compiler.get_safe("libcxx") == "libc++" else "stdc++"]
