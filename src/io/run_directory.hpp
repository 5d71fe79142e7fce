#pragma once
// The directory that a run writes into. Every product is written under a temporary name, DIR/NAME.partial, and takes its
// own name only when it is complete, so that a file with its own name is always whole.

#include "io/output_error.hpp"

#include <array>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace carom {

/// The names of all files that a run may write, and of the pages that `carom play` and `carom report` make of one: another run's
/// must not stay beside them. The summary comes last: where it is, the run is complete.
inline constexpr std::array<std::string_view, 31> run_products = {"checkpoint.h5",
                                                                  "checkpoint-previous.h5",
                                                                  "trajectory.h5md",
                                                                  "trajectory.xyz",
                                                                  "samples.csv",
                                                                  "observe_free_times.csv",
                                                                  "observe_free_paths.csv",
                                                                  "observe_speeds.csv",
                                                                  "observe_energies.csv",
                                                                  "observe_radial_distribution.csv",
                                                                  "observe_structure_factor.csv",
                                                                  "observe_hexatic_correlation.csv",
                                                                  "observe_voronoi_neighbours.csv",
                                                                  "observe_voronoi_areas.csv",
                                                                  "observe_clusters.csv",
                                                                  "observe_density_profile.csv",
                                                                  "observe_fields.csv",
                                                                  "observe_fields_in_time.csv",
                                                                  "observe_mean_square_displacement.csv",
                                                                  "observe_intermediate_scattering.csv",
                                                                  "observe_overlap.csv",
                                                                  "observe_non_gaussian.csv",
                                                                  "observe_van_hove.csv",
                                                                  "observe_velocity_autocorrelation.csv",
                                                                  "observe_viscosity.csv",
                                                                  "observe_heat_conductivity.csv",
                                                                  "observe_h_function.csv",
                                                                  "observe_work.csv",
                                                                  "player.html",
                                                                  "report.html",
                                                                  "summary.json"};

/// The names of checkpoints, from which a run can be continued: io/checkpoint.hpp.
inline constexpr std::string_view checkpoint_name = run_products[0], previous_checkpoint_name = run_products[1];

/// The holder of a directory's lock: the process that writes there, or that process and those that it starts, until the last of
/// them ends.
enum class LockHolder { process, process_and_children };

class RunDirectory {
 public:
  /// Creates the directory with its parents, or takes one that holds no results; other files in it are left alone. With `force`,
  /// results of an earlier run (a product, or the .partial of a run that did not end) are removed. `products` are the names that
  /// count as results; they must outlive this object. Throws OutputError where results are in the way without `force`, where
  /// `path` is not a directory or not writable, and where another process uses it; nothing has then been changed. Where children
  /// hold the lock too, waits up to two seconds for it, within which the children of a killed process disappear.
  RunDirectory(std::filesystem::path path, bool force, std::span<const std::string_view> products = run_products,
               LockHolder holder = LockHolder::process);

  /// Throws OutputError where the constructor would for what is in the way now. Makes, removes and keeps nothing.
  static void require_free(const std::filesystem::path& path, bool force);

  /// Returns the directory of a run that is to go on. Throws OutputError where there is none, or nothing can be written there.
  [[nodiscard]] static RunDirectory reopen(std::filesystem::path path);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::filesystem::path final_name(std::string_view product) const;    ///< DIR/trajectory.h5md
  [[nodiscard]] std::filesystem::path partial_name(std::string_view product) const;  ///< DIR/trajectory.h5md.partial

  /// Renames the files that grow with a run back to the names of unfinished files, and removes the results of the run's end.
  /// Throws OutputError.
  void take_back() const;
  /// Brings DIR/product.partial safely to the disk. Throws OutputError.
  void synchronise_partial(std::string_view product) const;
  /// Syncs the file to the disk, then renames it to DIR/product. Throws OutputError.
  void publish(std::string_view product) const;

  /// Removes the directory, and the parents that were made for it, where this object made them and they are empty.
  void discard_if_empty() const noexcept;

 private:
  explicit RunDirectory(std::filesystem::path path) : path_(std::move(path)), products_(run_products) {}
  /// Returns the error for a place where a run cannot begin or be continued.
  [[nodiscard]] OutputError refusal(const std::filesystem::path& path, std::string_view action, int error_number) const;
  /// Makes the directory this object's where nothing is in the way, and changes nothing in it.
  void take(bool force, LockHolder holder);
  void create();
  void lock(LockHolder holder);
  void check_for_results(bool force) const;
  void check_writable() const;

  std::filesystem::path path_;
  std::span<const std::string_view> products_;
  std::string otherwise_;                       ///< advice beside another's; empty for a run that goes on: it has no other place
  std::vector<std::filesystem::path> created_;  ///< the deepest last
  std::shared_ptr<const void> lock_;            ///< while it lives, no other process can take this directory
};

}  // namespace carom
