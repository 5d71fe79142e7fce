// The program's samples are the library's, bit for bit.

#include "support/scene_files.hpp"

#include <carom/simulation.hpp>

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace carom::test {
namespace {

TEST(SameBits, TheProgramsLastSampleIsTheLibrarys) {
  const std::filesystem::path out = std::filesystem::path(testing::TempDir()) / "carom_same_bits";
  std::filesystem::remove_all(out);
  const std::string command =
      std::string("\"") + CAROM_PROGRAM + "\" run \"" + example_path("from_file") + "\" --csv -q --out \"" + out.string() + "\"";
  ASSERT_EQ(std::system(command.c_str()), 0);

  Simulation simulation = make_simulation(load_scene(example_path("from_file")));
  State last;
  RunHooks hooks;
  hooks.sample = [&](std::uint64_t, const State& state) { last = state; };
  const RunResult result = run_schedule(simulation, hooks);
  ASSERT_GT(result.samples, 1u);
  EXPECT_EQ(last.time, *simulation.scene().run.sample_every * static_cast<double>(result.samples - 1)) << "the product itself";

  std::vector<std::string> lines;
  std::ifstream file(out / "samples.csv");
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  const auto disks = static_cast<std::size_t>(last.positions.cols());
  ASSERT_GT(lines.size(), disks);
  for (std::size_t i = 0; i < disks; ++i) {
    std::stringstream row(lines[lines.size() - disks + i]);
    std::vector<double> numbers;
    for (std::string field; std::getline(row, field, ',');) numbers.push_back(std::strtod(field.c_str(), nullptr));
    const auto column = static_cast<Eigen::Index>(i);
    EXPECT_EQ(numbers, (std::vector<double>{last.time, static_cast<double>(i), last.positions(0, column),
                                            last.positions(1, column), last.velocities(0, column), last.velocities(1, column)}));
  }
  std::filesystem::remove_all(out);
}

TEST(Seed, IsTakenAsTypedOrRefused) {
  const std::string check = std::string("\"") + CAROM_PROGRAM + "\" check \"" + example_path("box") + "\" ";
  EXPECT_EQ(std::system((check + "--seed 9223372036854775807 > /dev/null 2>&1").c_str()), 0);
  for (const char* seed : {"-1", "9223372036854775808", "18446744073709551617", "1.5", "\"\"", "0x10", "1 "})
    EXPECT_NE(std::system((check + "--seed '" + seed + "' > /dev/null 2>&1").c_str()), 0) << seed;
}

}  // namespace
}  // namespace carom::test
