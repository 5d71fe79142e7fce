// What h5py and MDAnalysis make of a trajectory, where they are installed.

#include "io/hand_made_run.hpp"
#include "io/run_writer.hpp"
#include "support/temporary_directory.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include <sys/wait.h>

namespace carom::test {
namespace {

/// The exit code of the script, 77 where no Python has the packages.
int run_script(const std::string& arguments) {
  for (const std::string python : {"/usr/bin/python3", "python3"}) {
    const std::string command = python + " " + CAROM_SOURCE_DIR "/tests/io/open_trajectory.py " + arguments + " 2>&1";
    const int status = std::system(command.c_str());
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 99;
    if (code != 77 && code != 127) return code;
  }
  return 77;
}

TEST(PythonReaders, H5pyAndMdanalysisSeeTheSamplesThatWereWritten) {
  const TemporaryDirectory temporary;
  Scene scene = scene_of(7, 4);
  scene.output.csv = true;
  scene.output.events = true;
  RunWriter writer(RunDirectory(temporary.path(), false), scene, hand_made_disks(scene), provenance());
  for (std::uint64_t k = 0; k < 23; ++k) writer.sample(k, state_at(k, scene), {});
  writer.events(events_up_to(100));
  writer.finish(hand_made_report(scene));
  const int code = run_script(temporary.path().string() + " 23 11 4 2.5");
  if (code == 77) GTEST_SKIP() << "python3-h5py, python3-numpy or python3-mdanalysis is not installed";
  EXPECT_EQ(code, 0);
}

TEST(PythonReaders, H5pyAndMdanalysisFollowABoxThatMovesAndDisksThatSpinAndGrow) {
  const TemporaryDirectory temporary;
  Scene scene = scene_with_effects(7, 4);
  scene.output.csv = true;
  scene.output.events = true;
  RunWriter writer(RunDirectory(temporary.path(), false), scene, hand_made_disks(scene), provenance());
  for (std::uint64_t k = 0; k < 23; ++k) writer.sample(k, state_with_effects_at(k, scene), {});
  writer.events(events_up_to(100));
  writer.finish(hand_made_report(scene));
  const int code = run_script(temporary.path().string() + " 23 11 4 2.5 effects");
  if (code == 77) GTEST_SKIP() << "python3-h5py, python3-numpy or python3-mdanalysis is not installed";
  EXPECT_EQ(code, 0);
}

}  // namespace
}  // namespace carom::test
