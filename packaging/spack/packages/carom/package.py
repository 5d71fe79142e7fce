# Not run yet: written from Spack's documentation, and to be tried on the first machine that has Spack.
"""Carom as a Spack package. The address of the sources is that of the checkout from which it is installed:

    spack repo add packaging/spack
    spack dev-build carom@main
"""

from spack.package import *


class Carom(CMakePackage):
    """Event-driven molecular dynamics of hard disks: a program, a C++ library and a Python package."""

    license("MIT")
    version("main")
    version("0.2.0")

    variant("mpi", default=False, description="carom run and carom sweep on many machines")
    variant("python", default=False, description="The Python package")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("boost@1.74:+headers", type="build")
    depends_on("cereal", type="build")
    depends_on("cli11", type="build")
    depends_on("nlohmann-json", type="build")
    depends_on("random123", type="build")
    depends_on("xxhash", type="build")
    depends_on("eigen@3.4:3")
    depends_on("fmt@9:")
    depends_on("tomlplusplus@3:")
    depends_on("hdf5~mpi")
    depends_on("cairo")
    depends_on("mpi", when="+mpi")
    depends_on("python@3.11:", when="+python", type=("build", "run"))
    depends_on("py-nanobind@2.5:", when="+python", type="build")
    depends_on("py-numpy@1.24:", when="+python", type=("build", "run"))

    generator("ninja")

    # The bits of trajectories are promised by these compilers.
    conflicts("%gcc@:11", msg="Carom needs C++20 as g++ 12 has it")
    conflicts("%clang@:13", msg="Carom needs C++20 as clang 14 has it")

    def cmake_args(self):
        return [
            self.define("CAROM_BUILD_TESTS", False),
            self.define("CAROM_BUILD_BENCH", False),
            self.define("CAROM_MPI", "ON" if self.spec.satisfies("+mpi") else "OFF"),
            self.define("CAROM_PYTHON", "ON" if self.spec.satisfies("+python") else "OFF"),
        ]

    @run_after("install")
    def install_python(self):
        """The Python package is a component of its own, which a plain installation leaves out."""
        if self.spec.satisfies("+python"):
            Executable("cmake")("--install", self.build_directory, "--component", "python", "--prefix", python_platlib)
