// The script bootstrap beside tools that only write down how they were called.

#include "support/child_process.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace carom::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// A checkout that holds bootstrap alone, on a machine whose tools are these scripts. `packages` lists what is installed.
class Bootstrap : public ::testing::Test {
 protected:
  Bootstrap() {
    for (const char* name : {"bootstrap", "cmake/debian-packages.txt", "python/requirements.txt", "python/wheel-requirements.txt",
                             "tests/python/requirements.txt"}) {
      fs::create_directories(file("checkout") / fs::path(name).parent_path());
      fs::copy_file(fs::path(CAROM_SOURCE_DIR) / name, file("checkout") / name);
    }
    write_text(file("packages"), "");
    tool("dpkg-query", R"(for word; do if grep -qx -- "$word" "$home/packages"; then
      case $* in *Package*) echo "$word 1 installed" ;; *) printf installed ;; esac; fi; done)");
    tool(
        "apt-get",
        R"(case " $* " in *" install "*) for word; do case $word in -* | install) ;; *) echo "$word" >>"$home/packages" ;; esac; done ;; esac)");
    tool("cmake", R"(echo "cmake $*" >>"$home/called"
      case $1 in --fresh)
        mkdir -p build/release
        echo >build/release/build.ninja
        echo "CMAKE_HOME_DIRECTORY:INTERNAL=$PWD" >build/release/CMakeCache.txt
        if grep -qx libopenmpi-dev "$home/packages"; then echo 'with MPI' >>"$home/called"; fi ;;
      --build) printf '#!/bin/sh\n' >build/release/carom; chmod +x build/release/carom ;; esac)");
    // What makes an environment is its interpreter too; it finds PyPI where there is a file of that name, and pip builds a wheel.
    tool("python3", R"(case "$1 $2 $*" in
      "-m venv "*) mkdir -p "$3/bin"; cp "$0" "$3/bin/python" ;;
      "-m pip "*)
        [[ -e $home/PyPI ]] && echo "pip $*" >>"$home/called" || exit 1
        for word; do
          if [[ $before == --wheel-dir ]]; then mkdir -p "$word" && echo bare >"$word/carom.whl"; fi
          before=$word
        done ;;
      "-c "*) echo "$home" ;;
      *) echo Python 3.11 ;; esac)");
    tool("auditwheel", R"([[ $1 == repair && $(<"$4") == bare ]] && echo "with libraries" >"$3/carom-manylinux.whl")");
    for (const char* name : {"ctest", "ninja", "g++", "sudo"}) tool(name, "");
  }

  /// How often and with what `./bootstrap verb` has called cmake and pip.
  std::string calls(const std::string& verb, int exit_code = 0) {
    fs::remove(file("called"));
    const std::string path = "PATH=" + file("tools").string() + ":/usr/bin:/bin";
    const std::string python = "PYTHON=" + file("tools/python3").string();
    outcome = run_program(file("checkout"), {"env", "-u", "CI", path, python, "bash", "bootstrap", verb});
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    return fs::exists(file("called")) ? text_of(file("called")) : "";
  }
  Outcome outcome;  ///< of the last `./bootstrap verb`

  [[nodiscard]] fs::path file(const std::string& name) const { return directory_.path() / name; }

 private:
  void tool(const std::string& name, const std::string& script) {
    fs::create_directories(file("tools"));
    write_text(file("tools/" + name), "#!/bin/bash\nhome=" + directory_.path().string() + "\n" + script + "\n");
    fs::permissions(file("tools/" + name), fs::perms::owner_all);
  }

  TemporaryDirectory directory_;
};

TEST_F(Bootstrap, ConfiguresAgainOnlyWherePackagesHaveComeSince) {
  const std::string run = calls("run");
  EXPECT_THAT(run, HasSubstr("cmake --fresh"));
  EXPECT_THAT(run, Not(HasSubstr("with MPI")));  // which only the tests ask for
  EXPECT_THAT(calls("run"), Not(HasSubstr("--fresh")));
  EXPECT_THAT(calls("test"), HasSubstr("with MPI"));
  EXPECT_THAT(calls("test"), Not(HasSubstr("--fresh")));
  EXPECT_THAT(calls("run"), Not(HasSubstr("--fresh")));
}

TEST_F(Bootstrap, TakesPythonPackagesFromPyPIOnce) {
  write_text(file("PyPI"), "");
  const std::string run = calls("run");
  EXPECT_THAT(run, AllOf(HasSubstr("CAROM_PYTHON=OFF"), Not(HasSubstr("pip"))));
  const std::string python = calls("python");
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("build/python/bin/activate"), HasSubstr("import carom")));
  EXPECT_EQ(fs::read_symlink(file("checkout/build/python/bin/carom")), fs::canonical(file("checkout")) / "build/release/carom");
  EXPECT_EQ(text_of(file("carom.pth")), (fs::canonical(file("checkout")) / "build/release/python\n").string());
  // What is compiled already stays.
  EXPECT_THAT(python,
              AllOf(HasSubstr("python/requirements.txt"), HasSubstr("build/python/bin/python"), Not(HasSubstr("--fresh"))));
  EXPECT_THAT(calls("python"), AllOf(Not(HasSubstr("pip")), Not(HasSubstr("--preset"))));
  EXPECT_THAT(calls("test"), AllOf(HasSubstr("tests/python/requirements.txt"), HasSubstr("--fresh")));
  for (const char* verb : {"test", "python", "run"})
    EXPECT_THAT(calls(verb), AllOf(Not(HasSubstr("pip")), Not(HasSubstr("--preset"))));
}

TEST_F(Bootstrap, MakesAWheelThatBringsItsLibraries) {
  calls("wheel", 1);
  EXPECT_THAT(outcome.err, HasSubstr("pip could not install these packages from PyPI"));
  write_text(file("PyPI"), "");
  fs::create_directories(file("checkout/build/wheels"));
  write_text(file("checkout/build/wheels/carom-of-yesterday.whl"), "");
  EXPECT_THAT(calls("wheel"), AllOf(HasSubstr("python/wheel-requirements.txt"), Not(HasSubstr("tests/python/requirements.txt"))));
  const fs::path wheels = fs::canonical(file("checkout")) / "build/wheels";
  EXPECT_EQ(outcome.out, (wheels / "carom-manylinux.whl\n").string());  // the bare one and that of yesterday are gone
  EXPECT_EQ(text_of(wheels / "carom-manylinux.whl"), "with libraries\n");
}

TEST_F(Bootstrap, MakesTheSiteOfProgramAndPackageAndOfThePlaygroundWhereThatIsBuilt) {
  calls("site", 1);
  EXPECT_THAT(outcome.err, HasSubstr("pip could not install these packages from PyPI"));
  write_text(file("PyPI"), "");
  EXPECT_THAT(calls("site"), AllOf(HasSubstr("tests/python/requirements.txt"), HasSubstr("--target carom_cli carom_python")));
  EXPECT_THAT(outcome.err, HasSubstr("the playground is not built, and left out"));
  EXPECT_THAT(text_of(file("packages")), HasSubstr("doxygen"));
  fs::create_directories(file("checkout/build/playground"));
  write_text(file("checkout/build/playground/playground.html"), "");
  EXPECT_THAT(calls("site"), Not(HasSubstr("--preset")));
  EXPECT_THAT(outcome.err, Not(HasSubstr("left out")));
}

TEST_F(Bootstrap, TestsWithoutPythonWherePyPIIsNotReached) {
  EXPECT_THAT(calls("test"), HasSubstr("CAROM_PYTHON=OFF"));
  EXPECT_THAT(outcome.err, HasSubstr("going on without: the Python package will not be tested"));
  calls("python", 1);
  EXPECT_THAT(outcome.err, HasSubstr("pip could not install these packages from PyPI"));
}

}  // namespace
}  // namespace carom::test
