// Describes an HDF5 file of Carom: a trajectory.h5md, or the sweep.h5 of a sweep.

#include "app/info_parts.hpp"
#include "io/h5md_parts.hpp"
#include "io/hdf5_handle.hpp"
#include "io/output_error.hpp"
#include "text/numbers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <carom/state.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace carom::detail {

namespace {

std::string species_line(hid_t file, hsize_t disks) {
  const std::vector<std::string> names = read_strings_attribute(file, parameters, "species_names");
  const std::vector<double> species = read_rows(file, particles + "/species", 0, disks);
  std::vector<std::string> parts;
  for (std::size_t s = 0; s < names.size(); ++s)
    parts.push_back(fmt::format("{} {}", std::count(species.begin(), species.end(), static_cast<double>(s)), names[s]));
  if (parts.empty()) return "none";
  return parts.size() == 1 ? parts.front() : fmt::format("{}: {}", disks, fmt::join(parts, ", "));
}

std::string box_line(hid_t file, hsize_t samples) {
  const std::vector<std::string> boundary = read_strings_attribute(file, particles + "/box", "boundary");
  const std::vector<double> origin = read_numbers_attribute(file, particles + "/box", "origin");
  if (boundary.size() != 3 || origin.size() != 3) throw Hdf5Error("the box has no boundary or no origin");
  std::string text = "x ";
  text += boundary[0] == "none" ? "walls" : boundary[0];
  text += ", y ";
  text += boundary[1] == "none" ? "walls" : boundary[1];
  if (samples == 0) return text;
  const std::vector<double> edges = read_rows(file, particles + "/box/edges/value", 0, 1);
  const std::vector<double> last = read_rows(file, particles + "/box/edges/value", samples - 1, 1);
  if (edges.at(0) != last.at(0) || edges.at(4) != last.at(4))
    text += fmt::format("; at the end {:.6g} x {:.6g}", last.at(0), last.at(4));
  return fmt::format("{:.6g} x {:.6g} from ({:.6g}, {:.6g}); {}", edges.at(0), edges.at(4), origin[0], origin[1], text);
}

/// Returns text such as ", every 0.5"
std::string sampling(hid_t file) {
  const auto numbers = [&](const char* name) { return read_numbers_attribute(file, parameters, name); };
  if (const std::vector<double> step = numbers("sample_every"); step.size() == 1) return fmt::format(", every {}", step[0]);
  if (const std::vector<double> step = numbers("sample_every_collisions"); step.size() == 1)
    return fmt::format(", every {} collisions", step[0]);
  if (const std::vector<double> log = numbers("sample_log"); log.size() == 3)
    return fmt::format(", {} in each block of {}, spaced by powers of {}", log[1], log[2], log[0]);
  return {};
}

/// Returns the state hash of the last sample, which is that of the run where it ended with a sample. Empty for positions that
/// were unwrapped: they are other bits than those of the state.
std::string last_state_hash(hid_t file, hsize_t samples, hsize_t disks) {
  if (samples == 0 || read_string_attribute(file, parameters, "positions") != "wrapped") return {};
  const auto last = [&](const std::string& dataset) { return read_rows(file, dataset, samples - 1, 1); };
  const std::vector<double> position = last(particles + "/position/value"), velocity = last(particles + "/velocity/value");
  State state;
  state.time = last(particles + "/position/time").at(0);
  state.positions.resize(2, static_cast<Eigen::Index>(disks));
  state.velocities.resize(2, static_cast<Eigen::Index>(disks));
  for (std::size_t i = 0; i < disks; ++i) {
    state.positions.col(static_cast<Eigen::Index>(i)) << position.at(3 * i), position.at(3 * i + 1);
    state.velocities.col(static_cast<Eigen::Index>(i)) << velocity.at(3 * i), velocity.at(3 * i + 1);
  }
  if (!extents_of(file, "/observables/spin/value").empty()) {
    const std::vector<double> spins = last("/observables/spin/value");
    if (spins.size() != disks) throw Hdf5Error("there is not one spin per disk");
    state.spins = Eigen::Map<const Eigen::VectorXd>(spins.data(), static_cast<Eigen::Index>(disks));
  }
  return state_hash(state);
}

/// Returns text such as "kinetic_energy, temperature, spin", by name
std::string observables_line(hid_t file) { return fmt::format("{}", fmt::join(members_of(file, "/observables"), ", ")); }

std::string described(hid_t file) {
  const std::vector<hsize_t> extents = extents_of(file, particles + "/position/value");
  if (extents.size() != 3) throw Hdf5Error("there is no position/value of three dimensions");
  const hsize_t samples = extents_of(file, particles + "/position/step").at(0);
  const hsize_t disks = extents[1];

  std::string text = info_line("written by", fmt::format("carom {} ({})", read_string_attribute(file, parameters, "version"),
                                                         read_string_attribute(file, parameters, "commit")));
  const std::string title = read_string_attribute(file, parameters, "title");
  const std::string source = read_string_attribute(file, parameters, "scene_source");
  text += info_line("scene", title.empty() ? source : fmt::format("{} ({})", title, source));
  text += info_line("seed", fmt::format("{}", read_unsigned_attribute(file, parameters, "seed")));
  const auto number = [&](const char* name) -> std::optional<double> {
    const std::vector<double> values = read_numbers_attribute(file, parameters, name);
    return values.size() == 1 ? std::optional(values.front()) : std::nullopt;
  };
  text += engine_line(read_string_attribute(file, parameters, "engine"), number("dt"), number("stiffness"));
  const std::vector<std::string> effects = read_strings_attribute(file, parameters, "effects");
  if (!effects.empty()) text += info_line("effects", fmt::format("{}", fmt::join(effects, ", ")));
  text += info_line("disks", species_line(file, disks));
  text += info_line("box", box_line(file, samples));

  std::string line = "none";
  if (samples > 0) {
    const double first = read_rows(file, particles + "/position/time", 0, 1).at(0);
    line = samples_text(samples, first, read_rows(file, particles + "/position/time", samples - 1, 1).at(0));
    line += sampling(file);
  }
  text += info_line("samples", line);
  if (const std::string hash = last_state_hash(file, samples, disks); !hash.empty())
    text += info_line("state hash", hash + ", of the last sample");
  text += info_line("observables", observables_line(file));
  if (samples > 0 && !extents_of(file, "/observables/scale/value").empty())
    text += info_line("radii", fmt::format("{:.6g} times those in the file",
                                           read_rows(file, "/observables/scale/value", samples - 1, 1).at(0)));
  const std::vector<hsize_t> events = extents_of(file, "/events/time");
  if (!events.empty()) text += info_line("events", fmt::format("{} in /events", counted(events[0], "collision")));
  return text;
}

}  // namespace

std::string describe_hdf5(const std::filesystem::path& path) {
  close_nothing_at_exit();
  const SilentHdf5 silent;
  try {
    const Hdf5Id file = [&] {
      try {
        return Hdf5Id(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
      } catch (const Hdf5Error& error) {
        throw OutputError(fmt::format("{}: HDF5 cannot open this file ({}); {}", path.string(), error.what(), advice_on(error)));
      }
    }();
    if (is_sweep(file.get())) return fmt::format("{}: results of a sweep\n{}", path.string(), sweep_lines(file.get()));
    const std::string creator = read_string_attribute(file.get(), "/h5md/creator", "name");
    if (creator != "carom")
      throw OutputError(fmt::format("{}: an HDF5 file that Carom did not write{}; look at it with h5dump or h5py", path.string(),
                                    creator.empty() ? "" : fmt::format(" (but {})", creator)));
    return fmt::format("{}: trajectory, H5MD 1.1\n{}", path.string(), described(file.get()));
  } catch (const Hdf5Error& error) {
    throw OutputError(fmt::format("{}: HDF5 cannot read this file to its end ({}); it is damaged, copy it anew or run again",
                                  path.string(), error.what()));
  }
}

}  // namespace carom::detail
