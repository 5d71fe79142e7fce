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
using ::testing::HasSubstr;
using ::testing::Not;

/// A checkout that holds bootstrap alone, on a machine whose tools are these scripts. `packages` lists what is installed.
class Bootstrap : public ::testing::Test {
 protected:
  Bootstrap() {
    fs::create_directories(file("checkout"));
    fs::copy_file(CAROM_SOURCE_DIR "/bootstrap", file("checkout/bootstrap"));
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
    for (const char* name : {"ctest", "ninja", "g++", "sudo"}) tool(name, "");
  }

  /// How often and with what `./bootstrap verb` has called cmake.
  std::string calls(const std::string& verb) {
    fs::remove(file("called"));
    const std::string path = "PATH=" + file("tools").string() + ":/usr/bin:/bin";
    const Outcome outcome = run_program(file("checkout"), {"env", "-u", "CI", path, "bash", "bootstrap", verb});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return fs::exists(file("called")) ? text_of(file("called")) : "";
  }
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

}  // namespace
}  // namespace carom::test
