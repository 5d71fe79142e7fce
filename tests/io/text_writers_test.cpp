// trajectory.xyz and samples.csv read back bit for bit.

#include "io/csv_writer.hpp"
#include "io/hand_made_run.hpp"
#include "io/xyz_writer.hpp"
#include "support/refusal.hpp"
#include "support/temporary_directory.hpp"

#include <gtest/gtest.h>

#include <charconv>
#include <fstream>
#include <sstream>

namespace carom::test {
namespace {

double exact(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  EXPECT_EQ(end, text.data() + text.size()) << text;
  EXPECT_EQ(error, std::errc()) << text;
  return value;
}

std::vector<std::string> split(const std::string& line, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(line);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

TEST(CsvWriter, EveryNumberReadsBackAsTheSameDouble) {
  const TemporaryDirectory temporary;
  const Scene scene = scene_of(3, 4);
  CsvWriter writer(temporary.path() / "samples.csv");
  for (std::uint64_t k = 0; k < 5; ++k) writer.sample(state_at(k, scene));
  writer.close();

  std::ifstream file(temporary.path() / "samples.csv");
  std::string line;
  ASSERT_TRUE(std::getline(file, line));
  EXPECT_EQ(line, "time,id,x,y,vx,vy");
  for (std::uint64_t k = 0; k < 5; ++k) {
    const State state = state_at(k, scene);
    for (Eigen::Index i = 0; i < 7; ++i) {
      ASSERT_TRUE(std::getline(file, line));
      const std::vector<std::string> fields = split(line, ',');
      ASSERT_EQ(fields.size(), 6u);
      EXPECT_EQ(exact(fields[0]), state.time);
      EXPECT_EQ(fields[1], std::to_string(i));
      EXPECT_EQ(exact(fields[2]), state.positions(0, i));
      EXPECT_EQ(exact(fields[3]), state.positions(1, i));
      EXPECT_EQ(exact(fields[4]), state.velocities(0, i));
      EXPECT_EQ(exact(fields[5]), state.velocities(1, i));
    }
  }
  EXPECT_FALSE(std::getline(file, line));
}

TEST(CsvWriter, TheLargestAndTheSmallestNumbersReadBack) {
  const TemporaryDirectory temporary;
  State state;
  state.time = 0.1 + 0.2;
  state.positions.resize(2, 2);
  state.velocities.resize(2, 2);
  state.positions << std::numeric_limits<double>::max(), std::numeric_limits<double>::denorm_min(), -0.0, 1e22;
  state.velocities << 5e-324, -1.7976931348623157e308, 123456789.12345679, 1.0;
  CsvWriter writer(temporary.path() / "samples.csv");
  writer.sample(state);
  writer.close();
  std::ifstream file(temporary.path() / "samples.csv");
  std::string line;
  std::getline(file, line);
  for (Eigen::Index i = 0; i < 2; ++i) {
    ASSERT_TRUE(std::getline(file, line));
    const std::vector<std::string> fields = split(line, ',');
    for (std::size_t c = 0; c < 2; ++c) {
      const double position = exact(fields[2 + c]);
      EXPECT_EQ(position, state.positions(static_cast<Eigen::Index>(c), i));
      EXPECT_EQ(std::signbit(position), std::signbit(state.positions(static_cast<Eigen::Index>(c), i)));
      EXPECT_EQ(exact(fields[4 + c]), state.velocities(static_cast<Eigen::Index>(c), i));
    }
  }
}

TEST(XyzWriter, EveryFrameIsExtendedXyzAndReadsBackBitForBit) {
  const TemporaryDirectory temporary;
  const Scene scene = scene_of(2, 3);
  const Disks disks = hand_made_disks(scene);
  XyzWriter writer(temporary.path() / "trajectory.xyz", scene, disks);
  for (std::uint64_t k = 0; k < 3; ++k) writer.sample(state_at(k, scene));
  writer.close();

  std::ifstream file(temporary.path() / "trajectory.xyz");
  std::string line;
  for (std::uint64_t k = 0; k < 3; ++k) {
    const State state = state_at(k, scene);
    ASSERT_TRUE(std::getline(file, line));
    EXPECT_EQ(line, "5");
    ASSERT_TRUE(std::getline(file, line));
    const std::string head =
        "Lattice=\"4 0 0 0 2.5 0 0 0 0.06\" Origin=\"-1 10 -0.03\" pbc=\"T F F\" "
        "Properties=species:S:1:pos:R:3:velo:R:3:radius:R:1:mass:R:1:id:I:1 Time=";
    ASSERT_EQ(line.substr(0, head.size()), head);
    EXPECT_EQ(exact(line.substr(head.size())), state.time);
    for (Eigen::Index i = 0; i < 5; ++i) {
      ASSERT_TRUE(std::getline(file, line));
      const std::vector<std::string> fields = split(line, ' ');
      ASSERT_EQ(fields.size(), 10u) << line;
      EXPECT_EQ(fields[0], i < 2 ? "H" : "He");
      EXPECT_EQ(exact(fields[1]), state.positions(0, i));
      EXPECT_EQ(exact(fields[2]), state.positions(1, i));
      EXPECT_EQ(exact(fields[3]), 0.0);
      EXPECT_EQ(exact(fields[4]), state.velocities(0, i));
      EXPECT_EQ(exact(fields[5]), state.velocities(1, i));
      EXPECT_EQ(exact(fields[6]), 0.0);
      EXPECT_EQ(exact(fields[7]), disks.radius[static_cast<std::size_t>(i)]);
      EXPECT_EQ(exact(fields[8]), disks.mass[static_cast<std::size_t>(i)]);
      EXPECT_EQ(fields[9], std::to_string(i));
    }
  }
  EXPECT_FALSE(std::getline(file, line));
}

TEST(XyzWriter, SpeciesAreChemicalSymbolsThatBeginAgainAfterTheLastElement) {
  EXPECT_EQ(chemical_symbol(0), "H");
  EXPECT_EQ(chemical_symbol(2), "Li");
  EXPECT_EQ(chemical_symbol(25), "Fe");
  EXPECT_EQ(chemical_symbol(117), "Og");
  EXPECT_EQ(chemical_symbol(118), "H");
}

TEST(XyzWriter, DisksOfManySizesKeepTheirOwnRadiusAndMass) {
  const TemporaryDirectory temporary;
  Scene scene = scene_of(3, 0);
  scene.species.pop_back();
  scene.species[0].radii = {0.125, 0.25, 0.125};
  scene.species[0].masses = {1.0, 1.0, 3.0};
  XyzWriter writer(temporary.path() / "t.xyz", scene, hand_made_disks(scene));
  writer.sample(state_at(0, scene));
  writer.close();
  std::ifstream file(temporary.path() / "t.xyz");
  std::string line;
  std::getline(file, line);
  std::getline(file, line);
  for (std::size_t i = 0; i < 3; ++i) {
    std::getline(file, line);
    const std::vector<std::string> fields = split(line, ' ');
    ASSERT_EQ(fields.size(), 10u);
    EXPECT_EQ(exact(fields[7]), scene.species[0].radii[i]);
    EXPECT_EQ(exact(fields[8]), scene.species[0].masses[i]);
  }
}

TEST(CsvWriter, RoughDisksHaveAColumnOfSpins) {
  const TemporaryDirectory temporary;
  const Scene scene = scene_with_effects(2, 1);
  CsvWriter writer(temporary.path() / "samples.csv", true);
  writer.sample(state_with_effects_at(1, scene));
  State smooth = state_at(2, scene);  // an engine that keeps no spins
  writer.sample(smooth);
  writer.close();
  std::ifstream file(temporary.path() / "samples.csv");
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line, "time,id,x,y,vx,vy,spin");
  for (Eigen::Index i = 0; i < 6; ++i) {
    ASSERT_TRUE(std::getline(file, line));
    const std::vector<std::string> fields = split(line, ',');
    ASSERT_EQ(fields.size(), 7u);
    EXPECT_EQ(exact(fields[6]), i < 3 ? state_with_effects_at(1, scene).spins[i] : 0.0);
  }
}

TEST(XyzWriter, TheLatticeLeansWithTheImagesOfAShearedBox) {
  const TemporaryDirectory temporary;
  const Scene scene = scene_of(1, 1);  // 4 long
  XyzWriter writer(temporary.path() / "t.xyz", scene, hand_made_disks(scene));
  for (const double displacement : {0.5, 3.5, 0.0}) {
    State state = state_at(0, scene);
    state.shear_displacement = displacement;
    writer.sample(state);
  }
  writer.close();
  const std::string text = text_of(temporary.path() / "t.xyz");
  std::vector<std::string> lattices;
  for (std::size_t at = text.find("Lattice="); at != std::string::npos; at = text.find("Lattice=", at + 1))
    lattices.push_back(text.substr(at, text.find(" Origin", at) - at));
  EXPECT_THAT(lattices, testing::ElementsAre("Lattice=\"4 0 0 0.5 2.5 0 0 0 0.06\"", "Lattice=\"4 0 0 -0.5 2.5 0 0 0 0.06\"",
                                             "Lattice=\"4 0 0 0 2.5 0 0 0 0.06\""));
}

TEST(XyzWriter, RadiiGrowAndTheLatticeFollowsTheWalls) {
  const TemporaryDirectory temporary;
  const Scene scene = scene_with_effects(1, 1);
  XyzWriter writer(temporary.path() / "t.xyz", scene, hand_made_disks(scene));
  writer.sample(state_with_effects_at(0, scene));
  writer.sample(state_with_effects_at(4, scene));  // scale 1.25, from 9 to 14.5
  writer.sample(state_at(5, scene));               // back in the scene's own box
  writer.close();
  std::ifstream file(temporary.path() / "t.xyz");
  std::string line;
  for (const bool moved : {false, true, false}) {
    std::getline(file, line);
    std::getline(file, line);
    const std::string lattice = moved ? "Lattice=\"4 0 0 0.5 5.5 0 0 0 0.075\" Origin=\"-1 9 -0.0375\" "
                                      : "Lattice=\"4 0 0 0 2.5 0 0 0 0.06\" Origin=\"-1 10 -0.03\" ";
    EXPECT_EQ(line.substr(0, lattice.size()), lattice);
    for (const double radius : {0.03, 0.01}) {
      std::getline(file, line);
      EXPECT_EQ(exact(split(line, ' ').at(7)), moved ? 1.25 * radius : radius);
    }
  }
}

TEST(TextWriters, AFileThatCannotBeCreatedIsNamed) {
  EXPECT_THAT(refusal<OutputError>([] { const CsvWriter writer("/proc/samples.csv"); }),
              ::testing::HasSubstr("/proc/samples.csv: cannot create it"));
}

TEST(TextWriters, MemoryDoesNotGrowWithTheNumberOfSamples) {
  const TemporaryDirectory temporary;
  const Scene scene = scene_of(500, 500);
  CsvWriter writer(temporary.path() / "samples.csv");
  writer.sample(state_at(0, scene));
  const std::size_t after_one = writer.buffered_bytes();
  for (std::uint64_t k = 1; k < 40; ++k) writer.sample(state_at(k, scene));
  EXPECT_EQ(writer.buffered_bytes(), after_one);
  EXPECT_GT(std::filesystem::file_size(temporary.path() / "samples.csv"), 4 * after_one);
}

}  // namespace
}  // namespace carom::test
