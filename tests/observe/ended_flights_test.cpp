// Flights looked at together, against each by itself; the same bits whichever disk comes first, with every instruction set.

#include "observe/ended_flights.hpp"
#include "support/instructions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string_view>
#include <vector>

namespace carom::test {
namespace {

constexpr FlightBins bins{4.0, 3.0, 20.0};

/// A quarter of the flights is unknown, some are beyond the range.
EndedFlights random_flights(std::size_t collisions) {
  std::mt19937_64 engine(11);
  const auto random = [&] { return static_cast<double>(engine() >> 11U) * 0x1p-53; };
  EndedFlights ended;
  for (std::size_t n = 0; n < collisions; ++n)
    for (std::size_t k = 0; k < 2; ++k) {
      ended.time[k][n] = random() < 0.25 ? EndedFlights::unknown : 6.0 * random();
      for (std::size_t axis = 0; axis < 2; ++axis) ended.velocity[n][2 * k + axis] = n == 3 ? 0.0 : 2.0 * random() - 1.0;
    }
  ended.time[0][3] = EndedFlights::unknown;  // of a disk at rest: zero times infinity
  return ended;
}

TalliedFlights tallied(const EndedFlights& ended, std::size_t fours) {
  TalliedFlights found{};
  ended_flights_kernel().tally(ended, fours, bins, found);
  return found;
}

std::vector<double> numbers(const TalliedFlights& found) {
  std::vector<double> all = {found.flights, found.time, found.path};
  for (std::size_t k = 0; k < 2; ++k) {
    all.insert(all.end(), std::begin(found.time_bin[k]), std::end(found.time_bin[k]));
    all.insert(all.end(), std::begin(found.path_bin[k]), std::end(found.path_bin[k]));
  }
  return all;
}

TEST(EndedFlights, AreTalliedAsEachByItself) {
  for (const std::size_t fours : {std::size_t{1}, std::size_t{7}, EndedFlights::most / 4}) {
    const EndedFlights ended = random_flights(4 * fours);
    const TalliedFlights found = tallied(ended, fours);
    double flights = 0.0, time = 0.0, path = 0.0;
    for (std::size_t n = 0; n < 4 * fours; ++n)
      for (std::size_t k = 0; k < 2; ++k) {
        const double flight = ended.time[k][n];
        const double length = flight * std::hypot(ended.velocity[n][2 * k], ended.velocity[n][2 * k + 1]);
        const auto bin_of = [](double x, double per_unit) {
          return std::isnan(x) || x * per_unit >= 20.0 ? 20 : static_cast<std::int32_t>(x * per_unit);
        };
        EXPECT_EQ(found.time_bin[k][n], bin_of(flight, 4.0));
        EXPECT_EQ(found.path_bin[k][n], bin_of(length, 3.0));
        if (std::isinf(flight)) continue;
        flights += 1.0;
        time += flight;
        path += length;
      }
    EXPECT_EQ(found.flights, flights);
    EXPECT_NEAR(found.time, time, 1e-12);
    EXPECT_NEAR(found.path, path, 1e-12);
  }
}

TEST(EndedFlights, DoNotDependOnWhichDiskComesFirst) {
  EndedFlights ended = random_flights(EndedFlights::most);
  const TalliedFlights before = tallied(ended, EndedFlights::most / 4);
  for (std::size_t n = 0; n < EndedFlights::most; n += 3) {
    std::swap(ended.time[0][n], ended.time[1][n]);
    std::swap_ranges(ended.velocity[n], ended.velocity[n] + 2, ended.velocity[n] + 2);
  }
  const TalliedFlights after = tallied(ended, EndedFlights::most / 4);
  EXPECT_EQ(after.flights, before.flights);
  EXPECT_EQ(after.time, before.time);
  EXPECT_EQ(after.path, before.path);
}

TEST(EndedFlights, AreTheSameBitsWithEveryInstructionSet) {
  const EndedFlights ended = random_flights(EndedFlights::most);
  std::vector<std::vector<double>> found;
  for (const std::string_view set : instruction_sets) {
    const WithInstructions with(set);
    found.push_back(numbers(tallied(ended, EndedFlights::most / 4)));
  }
  EXPECT_EQ(found[0], found[1]);
  EXPECT_EQ(found[0], found[2]);
}

}  // namespace
}  // namespace carom::test
