// No two numbers of an observable have one name, and no two columns of a table, whatever species are called: of two members of a
// JSON object with one name, readers keep one.

#include "observed_system.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <string>

namespace carom::test {
namespace {

Observed mixture_of(const std::array<std::string, 2>& names) {
  std::string scene = "[box]\nx = [0.0, 12.0]\ny = [0.0, 12.0]\nboundary = \"periodic\"\n";
  for (const std::string& name : names)
    scene += "[[disks]]\nname = \"" + name + "\"\ncount = 12\nradius = 0.4\nmass = 1.0\npositions = \"square\"\n" +
             "velocities = { temperature = 1.0 }\n";
  scene +=
      "[collision]\nrule = \"specular\"\n[run]\ntime = 2.0\n[observe]\n"
      "contact_values = true\ntemperature = { every = 0.1 }\nvelocity_moments = { every = 0.1 }\ncollision_rate = { every = 0.1 "
      "}\n"
      "mean_square_displacement = { every = 0.1 }\nvelocity_autocorrelation = { every = 0.1 }\noverlap = { every = 0.1 }\n"
      "intermediate_scattering = { every = 0.1, k = [1.0, 2.0] }\nradial_distribution = { every = 0.1 }\n"
      "van_hove = { every = 0.1 }\nspeeds = { every = 0.1 }\ndensity_profile = { every = 0.1 }\n";
  return observe(parse_scene(scene), 2.0);
}

TEST(NamesOfResults, DifferWhateverSpeciesAreCalled) {
  const std::array<std::string, 2> names[] = {{"a", "b"},           {"x", "y"}, {"error", "a"}, {"rate_a", "a"},
                                              {"small", "small_2"}, {"1", "2"}, {"self", "a"},  {"a_error", "a"}};
  for (const auto& species : names) {
    SCOPED_TRACE(species[0] + " and " + species[1]);
    const Observed o = mixture_of(species);
    for (const Measurement& measured : o.measurements) {
      std::set<std::string> numbers;
      for (const Scalar& scalar : measured.scalars) {
        EXPECT_TRUE(numbers.insert(scalar.name).second) << measured.name << "." << scalar.name;
      }
      for (const Table& table : measured.tables) {
        std::set<std::string> columns;
        for (const Column& column : table.columns)
          EXPECT_TRUE(columns.insert(column.name).second) << table.name << "." << column.name;
      }
    }
  }
}

}  // namespace
}  // namespace carom::test
