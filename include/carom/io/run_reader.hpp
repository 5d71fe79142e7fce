#pragma once
// Reads back what `carom run` has written: a finished run directory with its trajectory.h5md. Everything that can be wrong with
// it is said in one sentence that names the path.

#include <carom/io/output_error.hpp>
#include <carom/scene.hpp>
#include <carom/state.hpp>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace carom {

namespace detail {
struct OpenTrajectory;
}

class RunReader {
 public:
  /// Opens the trajectory of a run directory that is complete. Throws OutputError, as every function here.
  explicit RunReader(const std::filesystem::path& directory);
  /// Opens a trajectory file without its run directory. Then end() is the time of its last sample, and Z() is empty.
  [[nodiscard]] static RunReader of_trajectory(const std::filesystem::path& file);

  /// Box, effects and [run] are those of the run. The species are too, unless a start file that the scene names is gone.
  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] const Disks& disks() const { return disks_; }
  [[nodiscard]] const std::vector<std::string>& species_names() const { return species_names_; }
  [[nodiscard]] const std::string& title() const { return title_; }
  /// Returns names and values of the facts about this run, for the foot of a page.
  [[nodiscard]] const std::vector<std::pair<std::string, std::string>>& facts() const { return facts_; }

  [[nodiscard]] double end() const { return end_; }             ///< the time that the run reached
  [[nodiscard]] std::optional<double> Z() const { return Z_; }  ///< Z of the whole run, if it has one
  /// The collisions of pairs in the whole run; 0 for a trajectory without its run directory.
  [[nodiscard]] std::uint64_t pair_collisions() const { return pair_collisions_; }
  [[nodiscard]] std::uint64_t samples() const { return samples_; }  ///< 0 where it kept events alone
  [[nodiscard]] std::uint64_t events() const { return events_; }    ///< 0 without a log
  [[nodiscard]] bool has_event_log() const { return has_event_log_; }

  [[nodiscard]] std::vector<double> sample_times() const;  ///< times of all samples, in order
  /// Sample k with its time, to the last bit, but for positions of runs whose output was unwrapped: on periodic axes they are
  /// brought back into the box, whatever the file holds. No remainders, bonds, and velocities of walls.
  [[nodiscard]] State sample(std::uint64_t k) const;
  /// Collisions of pairs, virial, passages of wells, and what the walls took up to sample k; nothing else.
  [[nodiscard]] Totals totals(std::uint64_t k) const;
  /// Positions and velocities at the beginning of the event log. Requires a log.
  [[nodiscard]] State start() const;
  /// Returns the whole log, in order of time: ids are those of disks and of what this run has them hit, numbers are finite.
  [[nodiscard]] std::vector<Event> event_log() const { return event_log(0, events_, 0.0); }
  /// `count` events from `first` on, the one before which was at time `before`.
  [[nodiscard]] std::vector<Event> event_log(std::uint64_t first, std::uint64_t count, double before) const;
  /// Returns kT that observables refer to (ObservedRun::temperature).
  [[nodiscard]] double reference_temperature() const;
  /// Returns the scene with other values for some of its keys (load_scene). Throws SceneError for these.
  [[nodiscard]] Scene scene(const std::vector<std::string>& overrides) const;

 private:
  RunReader() = default;
  void open();
  template <class Action>
  auto guarded(Action action) const -> decltype(action());
  void read_summary(const std::filesystem::path& directory);
  void read_trajectory();
  void read_scene();
  void require_samples() const;
  void require_sample(std::uint64_t k) const;
  void require_event_log() const;
  [[nodiscard]] std::vector<double> rows(const std::string& dataset, std::uint64_t first, std::uint64_t count,
                                         std::uint64_t row_size) const;
  /// Row k of /observables/NAME; empty where the file has none.
  [[nodiscard]] std::vector<double> observable(const std::string& name, std::uint64_t k, std::uint64_t row_size) const;

  std::filesystem::path path_;  ///< path of the trajectory
  std::shared_ptr<detail::OpenTrajectory> open_;
  Scene scene_;
  std::string resolved_scene_;
  Disks disks_;
  std::vector<std::string> species_names_;
  std::string title_;
  std::vector<std::pair<std::string, std::string>> facts_;
  double end_ = 0.0;
  std::optional<double> Z_;
  std::uint64_t pair_collisions_ = 0, samples_ = 0, events_ = 0;
  bool has_event_log_ = false;
};

}  // namespace carom
