#pragma once
// An engine whose speed is measured on one scene, after a warm-up, with a check of energy, plan and pressure.

#include <carom/simulation.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace carom::cli {

/// Equal disks of diameter and mass 1 at kT = 1 in a periodic box, from a hexagonal lattice whose sides fit as well as they
/// can: nearly square.
Scene bench_scene(std::int64_t disks, double packing_fraction);

class TimedEngine {
 public:
  /// Brings the engine of that name to life, and lets it run for so many pair collisions before anything is measured.
  TimedEngine(const Scene& scene, const std::string& engine, std::uint64_t run_up);

  /// Times so many pair collisions more, in seconds of this program's processor time: what other programs take does not count.
  void take_turn(std::uint64_t collisions);

  /// Returns what is wrong with the present state, in one sentence; empty where energy, plan and (where it is known) pressure are
  /// right. All collisions since the run-up count.
  [[nodiscard]] std::string fault() const;

  [[nodiscard]] const std::string& engine() const { return simulation_.engine(); }
  [[nodiscard]] Totals totals() const { return simulation_.totals(); }
  [[nodiscard]] State state() const { return simulation_.state(); }
  [[nodiscard]] const std::vector<double>& rates() const { return rates_; }  ///< collisions per second, turn by turn
  [[nodiscard]] double median_rate() const;
  [[nodiscard]] double energy_drift() const;  ///< relative; beyond what effects have given and taken
  [[nodiscard]] double compressibility() const;
  [[nodiscard]] std::optional<double> bytes_per_disk() const;

 private:
  /// Returns the energy of disks and pistons, less what was supplied and plus what was lost since the clock stood at 0.
  [[nodiscard]] double energy_balance() const;
  [[nodiscard]] double disks() const { return static_cast<double>(simulation_.disks().count()); }

  std::optional<std::size_t> memory_before_;
  Simulation simulation_;
  double energy_;  ///< when the clock stood at 0
  double run_up_drift_ = 0.0;
  std::optional<std::size_t> memory_;
  bool stopped_ = false;  ///< there were no more collisions to be had
  std::vector<double> rates_;
};

}  // namespace carom::cli
