#pragma once
// The trials of `carom validate`: each runs a few systems and holds what it measures against theory.

#include "studies/validate/check.hpp"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace carom::validation {

/// The amount of work of a trial, and the seed of its random numbers.
struct Effort {
  bool full = false;
  std::uint64_t seed = 1;
  std::function<bool()> proceed = {};                             ///< false: stop
  std::function<void(double fraction)> has_done = [](double) {};  ///< is told, by any thread, how much of a long trial is done

  /// Returns the number of collisions: `quick` in a quick validation, twenty times as many in a full one.
  [[nodiscard]] double collisions(double quick) const { return full ? 20.0 * quick : quick; }
  /// Returns a seed for the k-th run of a trial. No two trials run the same system.
  [[nodiscard]] std::uint64_t seed_of(std::uint64_t k) const { return 1'000'003 * seed + k; }
};

/// Effort::proceed has said no.
struct Interrupted {};

struct Trial {
  std::string name;   ///< "pressure-0.30"
  std::string group;  ///< "equation of state"
  bool only_full = false;
  std::function<TrialResult(const Effort&)> run;
  bool on_all_processors = false;  ///< its runs share the processors
  double length = 1.0;             ///< processor time in a full validation over that of most trials: for progress
};

// One file each.
void add_maxwell_boltzmann(std::vector<Trial>& trials);
void add_reversal(std::vector<Trial>& trials);
void add_equation_of_state(std::vector<Trial>& trials);
void add_single_file(std::vector<Trial>& trials);
void add_collisions(std::vector<Trial>& trials);
void add_lorentz_paths(std::vector<Trial>& trials);
void add_transport(std::vector<Trial>& trials);
void add_sound(std::vector<Trial>& trials);
void add_lorentz_diffusion(std::vector<Trial>& trials);
void add_cooling_fields_walls(std::vector<Trial>& trials);
void add_flows(std::vector<Trial>& trials);
void add_rough_gas(std::vector<Trial>& trials);
void add_fluctuations(std::vector<Trial>& trials);
void add_percolation(std::vector<Trial>& trials);
void add_chaos(std::vector<Trial>& trials);
void add_fixed_steps(std::vector<Trial>& trials);

/// All, in the order in which they run.
[[nodiscard]] const std::vector<Trial>& all_trials();

}  // namespace carom::validation
