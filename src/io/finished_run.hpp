#pragma once
// The common part of all readers of a run directory: is it a finished run, its summary, its trajectory, the scene in it. Every
// fault is an OutputError, one sentence that names the path.

#include "io/hdf5_handle.hpp"
#include "io/output_error.hpp"

#include <carom/scene.hpp>

#include <fmt/format.h>
#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <system_error>

namespace carom::detail {

/// Throws where `directory` is none that `carom run` has finished writing.
void require_finished_run(const std::filesystem::path& directory);
[[nodiscard]] bool has_trajectory(const std::filesystem::path& directory);

/// Returns summary.json. Its keys are not checked.
[[nodiscard]] nlohmann::ordered_json summary_in(const std::filesystem::path& directory);
/// Returns the error to throw where the keys are not those of a summary.
[[nodiscard]] OutputError no_summary(const std::filesystem::path& directory);

/// Does what may throw Hdf5Error, and says it of the file at `path`.
template <class Action>
auto reading_hdf5(const std::filesystem::path& path, Action action) {
  close_nothing_at_exit();
  const SilentHdf5 silent;
  try {
    return action();
  } catch (const Hdf5Error& error) {
    if (std::error_code ignored; std::filesystem::is_directory(path, ignored))
      throw OutputError(
          fmt::format("{}: this is a directory, and a file is to be there; move it away, or run again", path.string()));
    throw OutputError(fmt::format("{}: HDF5 cannot read this file ({}); {}", path.string(), error.what(), advice_on(error)));
  }
}

/// Opens a file that Carom wrote. Throws Hdf5Error too.
[[nodiscard]] Hdf5Id open_trajectory(const std::filesystem::path& path);

/// Returns the scene with every default that the file at `path` holds. Its species are not those of the run where a start file
/// that it names is gone.
[[nodiscard]] Scene scene_of(const std::string& resolved, const std::filesystem::path& path);
/// Returns the scene of a trajectory.
[[nodiscard]] Scene scene_in(hid_t file, const std::filesystem::path& path);

}  // namespace carom::detail
