// A horizon as JSON and back.

#include "studies/horizon/json.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace carom::test {
namespace {

Horizon known() {
  Horizon horizon;
  horizon.tolerance = 1e-3;
  horizon.sigma = 0.75;
  horizon.resolution = 0.125;
  horizon.engine = "fast";
  horizon.rows = {{"fast", 53, "textbook-quad", 12.5, 40.25, true, FirstDifference{1234, 11.5, 3, -2, 4, 5}, 0.5, 2.0},
                  {"textbook-quad", 113, "", std::nullopt, std::nullopt, false, std::nullopt, 0.0, 0.0}};
  horizon.lyapunov = Lyapunov{2.5, 0.25, 1.25, std::nullopt, 2.0, 500'000};
  horizon.time = 20.0;
  horizon.collisions_per_disk = 64.0;
  horizon.collisions = 3200;
  horizon.timed_until = 4.0;
  horizon.ended = HorizonEnd::limit;
  return horizon;
}

TEST(HorizonJson, ReadBackIsWhatWasWritten) {
  const Horizon read = horizon_of(horizon_json(known()));
  EXPECT_EQ(read.sigma, 0.75);
  EXPECT_EQ(read.engine, "fast");
  ASSERT_EQ(read.rows.size(), 2U);
  EXPECT_EQ(read.rows[0].time, 12.5);
  EXPECT_TRUE(read.rows[0].estimated);
  ASSERT_TRUE(read.rows[0].first_difference);
  EXPECT_EQ(read.rows[0].first_difference->partner, -2);
  EXPECT_EQ(read.rows[1].against, "");
  EXPECT_FALSE(read.rows[1].time);
  EXPECT_EQ(read.rows[1].seconds, 0.0);
  ASSERT_TRUE(read.lyapunov);
  EXPECT_FALSE(read.lyapunov->per_collision_error);
  EXPECT_EQ(horizon_json(read), horizon_json(known()));
  Horizon empty;
  EXPECT_EQ(horizon_json(horizon_of(horizon_json(empty))), horizon_json(empty));
  for (const HorizonEnd end :
       {HorizonEnd::parted, HorizonEnd::run, HorizonEnd::limit, HorizonEnd::interrupted, HorizonEnd::stuck}) {
    empty.ended = end;
    EXPECT_EQ(horizon_of(horizon_json(empty)).ended, end);
  }
}

TEST(HorizonJson, WhatIsNoHorizonIsRefused) {
  nlohmann::ordered_json written = horizon_json(known());
  written["ended"] = "somehow";
  EXPECT_THROW((void)horizon_of(written), nlohmann::json::exception);
  EXPECT_THROW((void)horizon_of(nlohmann::ordered_json::object()), nlohmann::json::exception);
}

}  // namespace
}  // namespace carom::test
