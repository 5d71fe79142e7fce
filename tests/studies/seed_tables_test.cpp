// Tables averaged over seeds.

#include "studies/sweep/seed_tables.hpp"
#include "studies/sweep/products.hpp"

#include "support/refusal.hpp"
#include "support/sweep_files.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <variant>

namespace carom::test {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Table seed_table(const std::vector<double>& lag, const std::vector<double>& x) {
  return {.name = "t",
          .columns = {
              {"lag", "time", lag}, {"window", "time", lag}, {"x", "", x}, {"x_error", "", std::vector<double>(x.size(), 9.0)}}};
}

TEST(MeanOfTables, HasTheScatterOfSeedsInPlaceOfTheirErrors) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const Table mean = mean_of_tables(
      {seed_table({1, 2, 3}, {1, 5, none}), seed_table({1, 2, 3, 4}, {3, 5, 2, 7}), seed_table({1, 2, 3}, {8, 5, 4})});
  ASSERT_EQ(mean.columns.size(), 4U);
  EXPECT_THAT(mean.columns[0].values, ElementsAre(1, 2, 3));
  EXPECT_EQ(mean.columns[1].name, "window") << "the same in all, and without an error";
  EXPECT_THAT(mean.columns[2].values, ElementsAre(4, 5, 3));
  EXPECT_EQ(mean.columns[3].name, "x_error");
  EXPECT_DOUBLE_EQ(mean.columns[3].values[0], std::sqrt((9.0 + 1.0 + 16.0) / 2.0 / 3.0));
  EXPECT_EQ(mean.columns[3].values[1], 0.0);
  EXPECT_DOUBLE_EQ(mean.columns[3].values[2], 1.0) << "of two numbers half their distance";
}

TEST(MeanOfTables, HasTheRowsThatAllHave) {
  const Table mean = mean_of_tables({seed_table({1, 2, 3}, {1, 5, 6}), seed_table({1, 2}, {3, 7})});
  EXPECT_THAT(mean.columns[0].values, ElementsAre(1, 2));
  EXPECT_THAT(mean.columns[2].values, ElementsAre(2, 6));
}

TEST(MeanOfTables, ANumberThatOneSeedHasNotDiffersFromThatOfAnother) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const auto one = [](double x) { return Table{.name = "t", .columns = {{"lag", "time", {1}}, {"x", "", {x}}}}; };
  for (const auto& [first, second] : {std::pair{2.0, none}, std::pair{none, 2.0}}) {
    const Table mean = mean_of_tables({one(first), one(second)});
    ASSERT_EQ(mean.columns.size(), 3U);
    EXPECT_THAT(mean.columns[1].values, ElementsAre(2));
    EXPECT_EQ(mean.columns[2].name, "x_error");
  }
  EXPECT_EQ(mean_of_tables({one(none), one(none)}).columns.size(), 2U) << "the same in all, and without an error";
}

TEST(ValueAt, IsOnAStraightLineBetweenTheRowsAround) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const Table table = seed_table({1, 2, 4, 8}, {1, 5, none, 7});
  EXPECT_EQ(value_at(table, "x", {1.0}), 1.0);
  EXPECT_EQ(value_at(table, "x", {1.25}), 2.0);
  EXPECT_EQ(value_at(table, "x_error", {3.0}), 9.0);
  EXPECT_EQ(value_at(table, "x", {8.0}), 7.0);
  EXPECT_EQ(value_at(seed_table({3 * 0.1, 0.4}, {2, 6}), "x", {0.3}), 2.0) << "0.1 + 0.1 + 0.1 is not 0.3 in binary";
  for (const double absent : {0.5, 3.0, 6.0, 9.0}) EXPECT_EQ(value_at(table, "x", {absent}), std::nullopt) << absent;
  EXPECT_EQ(value_at(table, "y", {1.0}), std::nullopt);
  EXPECT_EQ(value_at(seed_table({1, 1, 2}, {1, 2, 3}), "x", {1.5}), std::nullopt) << "cells of a grid are no curve";
}

TEST(ValueAt, OfSizesIsThatOfTheRowThatContainsTheSize) {
  const Table table = {
      .name = "clusters",
      .columns = {{"size", "", {1, 2, 4}}, {"size_to", "", {1, 3, 6}}, {"clusters_per_disk", "", {0.5, 0.2, 0.1}}}};
  const std::vector<double> of_sizes = {0.5, 0.2, 0.2, 0.1, 0.1, 0.1};
  for (std::size_t k = 0; k < of_sizes.size(); ++k)
    EXPECT_EQ(value_at(table, "clusters_per_disk", {static_cast<double>(k + 1)}), of_sizes[k]) << k + 1;
  for (const double absent : {0.0, 7.0}) EXPECT_EQ(value_at(table, "clusters_per_disk", {absent}), std::nullopt) << absent;
}

TEST(ValueAt, OfCellsIsThatOfTheCellThatContainsThePlace) {
  // Three cells along x from 0 to 0.3, two along y from 0 to 2.
  const Table cells = {.name = "cells",
                       .columns = {{"x", "length", {0.05, 0.15, 0.25, 0.05, 0.15, 0.25}},
                                   {"y", "length", {0.5, 0.5, 0.5, 1.5, 1.5, 1.5}},
                                   {"density", "", {1, 2, 3, 4, 5, 6}}}};
  const auto density = [&](double x, double y) { return value_at(cells, "density", {x, y}); };
  EXPECT_EQ(density(0.01, 0.1), 1.0);
  EXPECT_EQ(density(0.19, 0.9), 2.0);
  EXPECT_EQ(density(0.25, 1.5), 6.0);
  EXPECT_EQ(density(0.1, 1.0), 5.0) << "an edge belongs to the cell right of and above it";
  EXPECT_EQ(density(0.0, 0.0), 1.0);
  EXPECT_EQ(density(0.3, 2.0), 6.0) << "the edge of the last cell is its own";
  for (const double outside : {-0.01, 0.31}) EXPECT_EQ(density(outside, 0.5), std::nullopt);
  EXPECT_EQ(density(0.1, 2.1), std::nullopt);
  EXPECT_EQ(value_at(cells, "density", {0.1}), std::nullopt);
  EXPECT_THAT(key_columns(cells), ElementsAre("x", "y"));
  const Table column = {.name = "cells", .columns = {{"x", "", {1, 1}}, {"y", "", {1, 3}}, {"density", "", {7, 8}}}};
  EXPECT_EQ(value_at(column, "density", {0.5, 2.5}), 8.0) << "one cell alone is as wide as the box";
}

TEST(MeanOfTables, OfOtherLagsIsRefused) {
  EXPECT_THAT(refusal<std::runtime_error>([] {
                return mean_of_tables({seed_table({1, 2}, {1, 5}), seed_table({1, 2.5}, {1, 5})});
              }),
              HasSubstr("its lag differs from seed to seed"));
}

TEST(SeedTables, OfRadiiDrawnWithEachSeedSayThatTheseDiffer) {
  const SweepFiles files;
  const fs::path out = files.directory().path() / "out";
  const auto fault = [&](const std::string& radius, const std::string& first_column) {
    const Sweep sweep = files.load("scene = \"gas.toml\"\nseeds = 2\n[set]\ndisks.0.radius = " + radius + "\n");
    SweepResults results;
    for (std::size_t run = 0; run < sweep.run_count(); ++run) {
      results.runs.push_back({.state = RunState::finished});
      fs::create_directories(out / sweep.directory_of(run));
      write_text(out / sweep.directory_of(run) / "observe_x.csv",
                 "# averages over time; units: " + first_column + ",x\n0.5,1\n" + std::to_string(run + 1) + ",2\n");
    }
    return seed_tables_of(sweep, results, out).at(0).fault;
  };
  const std::string law = "{ uniform = [0.01, 0.02] }";
  EXPECT_THAT(fault(law, "length, 1\nr"), HasSubstr("its r differs from seed to seed, because it follows the radii"));
  EXPECT_THAT(fault(law, "1 / length, 1\nk"), HasSubstr("give the radii as a list"));
  EXPECT_THAT(fault(law, "time, 1\nlag"), HasSubstr("give the observable a step"));
  EXPECT_THAT(fault("0.01", "length, 1\nr"), HasSubstr("give the observable a step"));
}

TEST(SeedTables, OfAPointAreThoseOfItsRuns) {
  const SweepFiles files;
  const Sweep sweep = files.load("scene = \"gas.toml\"\nseeds = 3\n[grid]\nrun.time = [1.0, 2.0]\n");
  const fs::path out = files.directory().path() / "out";
  SweepResults results;
  for (std::size_t run = 0; run < sweep.run_count(); ++run) {
    results.runs.push_back({.state = run < 3 || run == 4 ? RunState::finished : RunState::missing});
    if (results.runs[run].state != RunState::finished) continue;
    fs::create_directories(out / sweep.directory_of(run));
    write_text(out / sweep.directory_of(run) / "observe_msd.csv",
               "# averages over time; units: time, length^2, length^2\nlag,msd,msd_error\n0.5," + std::to_string(run + 1) +
                   ",0.1\n1,nan,nan\n");
  }
  const std::vector<SeedTable> tables = seed_tables_of(sweep, results, out);
  ASSERT_EQ(tables.size(), 1U) << "the second point has one finished seed";
  EXPECT_EQ(tables[0].seeds, 3U);
  EXPECT_THAT(tables[0].fault, IsEmpty());
  EXPECT_EQ(seed_table_csv(tables[0]),
            "# means over 3 seeds; errors are those of independent seeds; units: time, length^2, "
            "length^2\nlag,msd,msd_error\n0.5,2.0," +
                fmt::format("{}", std::sqrt(1.0 / 3.0)) + "\n1.0,NaN,NaN\n");
  const Page page = sweep_page(sweep, results, tables);
  bool drawn = false;
  for (const Section& section : page.sections)
    for (const Block& block : section.blocks)
      if (const Plot* plot = std::get_if<Plot>(&block); plot != nullptr && plot->title == "msd: msd")
        drawn = plot->series.size() == 1;
  EXPECT_TRUE(drawn);
}

TEST(SeedTables, NeedTheTableOfTwoSeeds) {
  const SweepFiles files;
  const Sweep sweep = files.load("scene = \"gas.toml\"\nseeds = 2\n");
  const fs::path out = files.directory().path() / "out";
  SweepResults results;
  for (std::size_t run = 0; run < sweep.run_count(); ++run) {
    results.runs.push_back({.state = RunState::finished});
    fs::create_directories(out / sweep.directory_of(run));
  }
  write_text(out / sweep.directory_of(0) / "observe_x.csv", "# averages over time; units: time, 1\nlag,x\n0.5,1\n");
  EXPECT_THAT(seed_tables_of(sweep, results, out), IsEmpty());
}

/// Averages of fields in so many cells, of which each is the number of the cell.
SeedTable fields_of(const std::vector<double>& x, const std::vector<double>& y) {
  SeedTable fields{.seeds = 2, .table = {.name = "fields", .columns = {{"x", "length", x}, {"y", "length", y}}}};
  std::vector<double> numbers(x.size());
  std::iota(numbers.begin(), numbers.end(), 0.0);
  for (const char* name :
       {"density", "velocity_x", "velocity_y", "temperature", "heat_flux_x", "heat_flux_y", "stress_xx", "stress_yy"}) {
    fields.table.columns.push_back({name, "", numbers});
    fields.table.columns.push_back({std::string(name) + "_error", "", std::vector<double>(x.size(), 0.5)});
  }
  return fields;
}

Section section_of_tables(const SeedTable& table) {
  const SweepFiles files;
  const Sweep sweep = files.load("scene = \"gas.toml\"\nseeds = 2\n");
  SweepResults results;
  results.runs.resize(sweep.run_count());
  return sweep_page(sweep, results, {table}).sections.front();
}

TEST(SeedTables, FieldsOnAGridAreMaps) {
  const Section section = section_of_tables(fields_of({1, 3, 1, 3}, {2, 2, 6, 6}));
  ASSERT_EQ(section.blocks.size(), 2U);
  EXPECT_EQ(std::get<Paragraph>(section.blocks[0]).text, "`fields` of scene, means over seeds:");
  EXPECT_THAT(std::get<EmbeddedPage>(section.blocks[1]).html, HasSubstr("aria-label=\"Temperature\""));
}

TEST(SeedTables, FieldsOnALineAreProfilesAlongIt) {
  const Section section = section_of_tables(fields_of({1, 1, 1}, {2, 4, 6}));
  ASSERT_EQ(section.blocks.size(), 8U) << "a plot for each field";
  const Plot& plot = std::get<Plot>(section.blocks[0]);
  EXPECT_EQ(plot.title, "fields: density");
  EXPECT_THAT(plot.x.title, HasSubstr("y (length"));
  ASSERT_EQ(plot.series.size(), 1U);
  EXPECT_THAT(plot.series[0].x, ElementsAre(2, 4, 6));
  EXPECT_THAT(plot.series[0].y_high, ElementsAre(0.5, 1.5, 2.5));
}

}  // namespace
}  // namespace carom::test
