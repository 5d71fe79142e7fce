#pragma once
// An engine that something drives from outside, between events: a thermostat, tumbles or Brownian redraws that give disks new
// velocities, of which one acts at most, and the schedule by which disks grow (Lubachevsky & Stillinger 1990), which rescales
// velocities and says when to stop. Both are so rare that the loop need not know of them: it runs to the time, or the number of
// collisions, at which the next of them is due. Where the disks are shared out to several cores, these redraw velocities
// themselves (parallel/domains.hpp), and all that is left to do here is what comes at the end of a stretch.

#include "core/exact_sum.hpp"
#include "effects/growing_scale.hpp"
#include "effects/redraws.hpp"
#include "simulation/pressure_window.hpp"
#include "simulation/wrapped_engine.hpp"

#include <carom/scene.hpp>
#include <carom/state.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace carom::detail {

class DrivenEngine final : public WrappedEngine {
 public:
  /// Whether anything in the scene drives an engine; what has the rate 0 does not.
  [[nodiscard]] static bool needed_by(const Effects& effects);

  /// `engine` runs the scene with these disks and knows by itself how they grow.
  DrivenEngine(std::unique_ptr<AnyEngine> engine, const Scene& scene, Disks disks);

  bool run_until(const Instant& target, std::uint64_t pair_limit, std::uint64_t event_limit) override {
    return run(target, pair_limit, event_limit, true);
  }
  bool run_about(const Instant& target, std::uint64_t pair_limit, std::uint64_t event_limit) override {
    return run(target, pair_limit, event_limit, false);
  }
  [[nodiscard]] bool idle() const override;
  /// Returns whether the engine has stalled, or a disk fills the box.
  [[nodiscard]] bool is_stalled() const override { return filled_ || engine_->is_stalled(); }
  [[nodiscard]] std::optional<StopReason> ended() const override {
    return grown_ ? std::optional(StopReason::grown) : std::nullopt;
  }
  [[nodiscard]] Instant grown_at() const override { return std::min(end_, full_); }
  [[nodiscard]] Totals totals() const override;
  [[nodiscard]] const Counts& counts() const override { return counts_; }
  using AnyEngine::state;
  void state(State& state) const override;
  void store_velocities(State& state) const override;
  void reset_clock() override;
  void leave(Continuation& continuation) const override;
  void take_over(const Continuation& continuation) override;
  [[nodiscard]] Event last_thermostat_event() const override { return last_thermostat_event_; }
  [[nodiscard]] std::size_t bytes() const override;
  void save(SavingArchive& archive) const override;
  void load(LoadingArchive& archive) override;

 private:
  template <class Self, class Archive>
  static void archive_all(Self& self, Archive& archive);

  static constexpr auto never = std::numeric_limits<std::uint64_t>::max();

  /// Sums over all disks, in the order of their ids.
  struct Energy {
    double translation = 0.0;
    double rotation = 0.0;
    [[nodiscard]] double total() const { return translation + rotation; }
  };
  [[nodiscard]] Energy energy() const;
  [[nodiscard]] double scale() const { return scale_.at(now()); }
  [[nodiscard]] double moment_of_inertia(std::size_t i) const;

  bool run(const Instant& target, std::uint64_t pair_limit, std::uint64_t event_limit, bool exact_events);
  void begin();
  /// All that is counted without keeping books.
  [[nodiscard]] std::uint64_t happened() const;
  void redraw_velocities();
  void measure_and_rescale();
  void measure_pressure(const Energy& energy);
  void rescale(const Energy& energy);
  void count();

  Disks disks_;
  Redraws redraws_;
  bool spinning_;
  Event last_thermostat_event_;

  GrowingScale scale_;         ///< since when disks grow and energy is kept: the zero of time, or the last change from outside
  double end_scale_ = 0.0;     ///< at which disks have grown enough; 0 where no packing fraction is asked for
  double end_pressure_ = 0.0;  ///< the same for the reduced pressure
  double packing_fraction_;    ///< at scale 1
  Instant end_ = forever;      ///< when end_scale_ is reached
  double full_scale_ = 0.0;    ///< at which the largest disk fills the box
  Instant full_ = forever;     ///< time at which a disk fills the box
  bool filled_ = false;        ///< a disk fills the box
  bool grown_ = false;         ///< the packing fraction or pressure of growth.until is reached
  bool at_end_scale_ = false;  ///< that was the packing fraction
  bool keeps_energy_;          ///< velocities are rescaled
  std::uint64_t between_measurements_;  ///< collisions of pairs from one look at the gas to the next
  std::uint64_t measure_at_ = never;    ///< Totals::pair at which velocities are rescaled and the pressure is measured
  PressureWindow window_;
  double energy_at_start_ = 0.0;  ///< kinetic, at scale_.start

  /// Where the current stretch of the pressure's window began.
  Instant stretch_start_{};
  std::uint64_t stretch_pairs_ = 0;
  double stretch_virial_ = 0.0;
  double stretch_energy_ = 0.0;  ///< of translation

  Counts counts_;  ///< the engine's, with what came from outside
  ExactSum rescaling_energy_;
};

}  // namespace carom::detail
