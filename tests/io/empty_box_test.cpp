// A box without disks is a scene like any other: its trajectory has frames and no disks.

#include "app/info.hpp"
#include "io/run_directory.hpp"
#include "io/run_writer.hpp"

#include <carom/scene.hpp>
#include <carom/simulation.hpp>

#include <gtest/gtest.h>

#include <filesystem>

namespace carom::test {
namespace {

TEST(EmptyBox, WritesATrajectoryOfFramesWithoutDisks) {
  const Scene scene = parse_scene(
      "disks = []\n[box]\nx = [0, 1]\ny = [0, 1]\nboundary = \"walls\"\n[collision]\nrule = \"specular\"\n[run]\ntime = 1.0\n"
      "sample_every = 0.5\n[output]\nevents = true\nxyz = true\ncsv = true\n");
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "carom_empty_box";
  std::filesystem::remove_all(path);
  const RunDirectory directory(path, false);
  Simulation simulation = make_simulation(scene);
  RunWriter writer(directory, scene, simulation.disks(), {});
  RunHooks hooks;
  hooks.sample = [&](std::uint64_t k, const State& state) { writer.sample(k, state, simulation.totals()); };
  EXPECT_EQ(run_schedule(simulation, hooks).samples, 3u);
  writer.finish({});
  EXPECT_NE(describe_file(path / "trajectory.h5md").find("samples     3,"), std::string::npos);
  EXPECT_NE(describe_file(path / "trajectory.h5md").find("disks       none\n"), std::string::npos);
  std::filesystem::remove_all(path);
}

}  // namespace
}  // namespace carom::test
