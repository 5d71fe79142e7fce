#pragma once
// Reads back what `carom run` has written: a finished run directory with its trajectory.h5md. Everything that can be wrong with
// it is said in one sentence that names the path.

#include "io/hdf5_handle.hpp"
#include "io/output_error.hpp"

#include <carom/scene.hpp>
#include <carom/state.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace carom {

class RunReader {
 public:
  /// Opens the trajectory of a run directory that is complete. Throws OutputError, as every function here.
  explicit RunReader(const std::filesystem::path& directory);

  /// Box, effects and [run] are those of the run. The species are too, unless a start file that the scene names is gone.
  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] const Disks& disks() const { return disks_; }
  [[nodiscard]] const std::vector<std::string>& species_names() const { return species_names_; }
  [[nodiscard]] const std::string& title() const { return title_; }
  /// Who ran what, for the foot of a page: names and values.
  [[nodiscard]] const std::vector<std::pair<std::string, std::string>>& facts() const { return facts_; }

  [[nodiscard]] double end() const { return end_; }                 ///< the time that the run reached
  [[nodiscard]] std::optional<double> Z() const { return Z_; }      ///< of the whole run, where it has one
  [[nodiscard]] std::uint64_t samples() const { return samples_; }  ///< at least one
  [[nodiscard]] std::uint64_t events() const { return events_; }    ///< 0 without a log
  [[nodiscard]] bool has_event_log() const { return has_event_log_; }

  [[nodiscard]] std::vector<double> sample_times() const;  ///< in order
  /// Sample k with its time; positions on periodic axes are inside the box, whatever the file holds. No images, no spins.
  [[nodiscard]] State sample(std::uint64_t k) const;
  /// The whole log, in order of time: ids are those of disks, walls and obstacles of this run, numbers are finite.
  [[nodiscard]] std::vector<Event> event_log() const;

 private:
  template <class Action>
  auto guarded(Action action) const -> decltype(action());
  void read_summary(const std::filesystem::path& directory);
  void read_trajectory();
  void read_scene();
  [[nodiscard]] std::vector<double> rows(const std::string& dataset, std::uint64_t first, std::uint64_t count,
                                         std::uint64_t row_size) const;

  std::filesystem::path path_;  ///< of the trajectory
  detail::Hdf5Id file_;
  Scene scene_;
  Disks disks_;
  std::vector<std::string> species_names_;
  std::string title_;
  std::vector<std::pair<std::string, std::string>> facts_;
  double end_ = 0.0;
  std::optional<double> Z_;
  std::uint64_t samples_ = 0, events_ = 0;
  bool has_event_log_ = false;
};

}  // namespace carom
