#pragma once
// A run that goes on from its checkpoint, perhaps to a later end.

#include "io/checkpoint.hpp"
#include "io/provenance.hpp"
#include "io/run_directory.hpp"

#include <carom/scene.hpp>
#include <carom/simulation.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>

namespace carom {

/// A later end than that of the run, or none: the run then goes on to its own.
struct LaterEnd {
  std::optional<double> time = {};
  std::optional<std::uint64_t> collisions = {};

  [[nodiscard]] bool given() const { return time || collisions; }
};

/// A run directory with its newest checkpoint that is sound, open to go on.
struct ResumedRun {
  RunDirectory directory;
  Checkpoint from;
  Scene scene;  ///< with the end that was asked for

  /// Opens the directory. Throws OutputError where nothing can go on from there.
  ResumedRun(const std::filesystem::path& path, const LaterEnd& end);

  /// Throws std::invalid_argument where the end does not lie ahead, or the scene cannot bear it. what() does not name the option
  /// that gave it.
  void check_end(const LaterEnd& end) const;

  /// Whether the run has come to its own end, with all its files.
  [[nodiscard]] bool complete() const;
  /// Returns the simulation as it was saved, once all files are found to be there. Throws OutputError.
  [[nodiscard]] Simulation simulation() const;
  [[nodiscard]] Provenance provenance() const;
};

}  // namespace carom
