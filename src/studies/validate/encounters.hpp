#pragma once
// Statistics of collisions for trials of one species of diameter 1: impact parameters, rates by speed, free times.

#include "studies/validate/check.hpp"

#include <carom/blocking.hpp>
#include <carom/observe.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace carom::validation {

class Encounters final : public Observable {
 public:
  static constexpr std::size_t parameters = 20;  ///< bins of the impact parameter, from 0 to 1
  static constexpr std::size_t speeds = 12;      ///< bins of the speed, of width speed_width
  static constexpr double speed_width = 0.25;
  static constexpr std::array<double, 4> flights = {0.5, 1.0, 2.0, 4.0};  ///< in mean free times

  struct Seen {
    std::array<std::uint64_t, parameters> impact = {};
    Blocking impact_square;                            ///< b^2 of each collision
    std::array<Blocking, speeds> rate = {};            ///< collisions of disks of this speed over the time that disks had it
    std::array<Blocking, flights.size()> longer = {};  ///< share of the flights that last longer
    std::uint64_t collisions = 0;
  };

  /// `step`: time between two counts of disks by speed.
  Encounters(double step, double mean_free_time, Seen& seen) : step_(step), mean_free_time_(mean_free_time), seen_(seen) {}

  [[nodiscard]] std::string name() const override { return "encounters"; }
  [[nodiscard]] double step() const override { return step_; }
  [[nodiscard]] bool follows_collisions() const override { return true; }
  void start(const State& state) override;
  void sample(const State& state, const Totals& totals) override;
  void collisions(std::span<const PairCollision> collisions) override;
  [[nodiscard]] Measurement finish(double, const Totals&) override { return {.name = name()}; }

 private:
  void land(std::int32_t disk, double speed, double time);

  double step_, mean_free_time_;
  Seen& seen_;
  std::vector<double> since_;              ///< time of each disk's last collision; negative before the first
  std::array<double, speeds> met_ = {};    ///< collisions since the last sample
  std::array<double, speeds> dwelt_ = {};  ///< disks of this speed at the last sample
  bool begun_ = false;
};

}  // namespace carom::validation
