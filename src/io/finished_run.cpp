#include "io/finished_run.hpp"

#include "io/h5md_parts.hpp"

#include <nlohmann/json.hpp>

#include <fstream>
#include <string>
#include <system_error>

namespace carom::detail {

namespace fs = std::filesystem;

void require_finished_run(const fs::path& directory) {
  const std::string name = directory.string();
  std::error_code error;
  const fs::file_status status = fs::status(directory, error);
  if (!fs::exists(status))
    throw OutputError(fmt::format("{}: there is no such directory; name one that carom run has written", name));
  if (!fs::is_directory(status))
    throw OutputError(
        fmt::format("{}: this is a file; name the run directory, the one that holds summary.json and trajectory.h5md", name));
  const auto has = [&](const char* file) { return fs::exists(directory / file, error); };
  if (has("trajectory.h5md.partial") || has("summary.json.partial"))
    throw OutputError(fmt::format(
        "{}: this run still goes on, or was ended from outside (there are .partial files); wait for its end, or run it again",
        name));
  if (!has("summary.json"))
    throw OutputError(
        fmt::format("{}: this directory holds no finished run (no summary.json); name one that carom run has written", name));
}

bool has_trajectory(const fs::path& directory) {
  std::error_code error;
  return fs::exists(directory / "trajectory.h5md", error);
}

OutputError no_summary(const fs::path& directory) {
  return OutputError(fmt::format("{}: this is not the summary of a run; it is damaged or cut short, copy it anew or run again",
                                 (directory / "summary.json").string()));
}

nlohmann::ordered_json summary_in(const fs::path& directory) {
  try {
    return nlohmann::ordered_json::parse(std::ifstream(directory / "summary.json"));
  } catch (const nlohmann::json::exception&) {
    throw no_summary(directory);
  }
}

Hdf5Id open_trajectory(const fs::path& path) {
  Hdf5Id file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (read_string_attribute(file.get(), "/h5md/creator", "name") != "carom")
    throw OutputError(fmt::format("{}: an HDF5 file that Carom did not write", path.string()));
  return file;
}

Scene scene_in(hid_t file, const fs::path& path) {
  return scene_of(read_string_attribute(file, detail::parameters, "resolved_scene"), path);
}

Scene scene_of(const std::string& resolved, const fs::path& path) {
  try {
    return parse_scene(resolved, "resolved_scene");
  } catch (const SceneError&) {
    // The start file may be gone: the disks are in the trajectory, and two of any kind let the rest of the scene be read.
    try {
      return parse_scene(resolved, "resolved_scene",
                         {"disks=[{count=2,radius=1e-12,mass=1.0,positions=\"random\",velocities=\"rest\"}]"});
    } catch (const SceneError& error) {
      throw OutputError(fmt::format("{}: the scene in this file cannot be read ({})", path.string(), error.what()));
    }
  }
}

}  // namespace carom::detail
