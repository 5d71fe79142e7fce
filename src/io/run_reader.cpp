// A run directory from the reader's side.

#include <carom/io/run_reader.hpp>

#include "core/nearest_image.hpp"
#include "io/finished_run.hpp"
#include "io/h5md_parts.hpp"
#include "io/hdf5_handle.hpp"
#include "scene/changes.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace carom {

namespace detail {

/// A trajectory file and those of its datasets that have been read.
struct OpenTrajectory {
  explicit OpenTrajectory(Hdf5Id opened) : file(std::move(opened)), datasets(file.get()) {}
  Hdf5Id file;
  Hdf5Datasets datasets;
};

}  // namespace detail

namespace fs = std::filesystem;

namespace {

using detail::Hdf5Error;

using detail::parameters;
using detail::particles;

}  // namespace

template <class Action>
auto RunReader::guarded(Action action) const -> decltype(action()) {
  return detail::reading_hdf5(path_, action);
}

RunReader::RunReader(const fs::path& directory) : path_(directory / "trajectory.h5md") {
  detail::require_finished_run(directory);
  read_summary(directory);
  if (!detail::has_trajectory(directory))
    throw OutputError(fmt::format(
        "{}: this run kept no trajectory.h5md; run the scene again with {}, and with --events for an exact replay",
        directory.string(),
        detail::summary_in(directory).value("samples", 0) > 0 ? "output.trajectory = true and not with --no-trajectory"
                                                              : "run.sample_every"));
  open();
}

RunReader RunReader::of_trajectory(const fs::path& file) {
  RunReader run;
  run.path_ = file;
  run.open();
  if (run.samples_ > 0) run.end_ = run.sample_times().back();
  return run;
}

void RunReader::open() {
  guarded([&] {
    open_ = std::make_shared<detail::OpenTrajectory>(detail::open_trajectory(path_));
    read_trajectory();
    read_scene();
  });
}

void RunReader::read_summary(const fs::path& directory) {
  const nlohmann::ordered_json json = detail::summary_in(directory);
  try {
    end_ = json.at("time").get<double>();
    if (json.at("pressure").at("Z").is_number()) Z_ = json.at("pressure").at("Z").get<double>();
    facts_.emplace_back("Stopped by", json.at("stopped").get<std::string>());
    pair_collisions_ = json.at("events").at("pair").get<std::uint64_t>();
    facts_.emplace_back("Pair collisions", std::to_string(pair_collisions_));
  } catch (const nlohmann::json::exception&) {
    throw detail::no_summary(directory);
  }
}

std::vector<double> RunReader::rows(const std::string& dataset, std::uint64_t first, std::uint64_t count,
                                    std::uint64_t row_size) const {
  std::vector<double> values = open_->datasets.rows(dataset, first, count);
  if (values.size() != count * row_size) throw Hdf5Error(dataset + " has another shape than it should");
  return values;
}

void RunReader::read_trajectory() {
  const std::vector<hsize_t> extents = open_->datasets.extents(particles + "/position/value");
  if (extents.size() != 3 || extents[2] != 3) throw Hdf5Error("there is no position/value of three dimensions");
  samples_ = std::min<std::uint64_t>(extents[0], open_->datasets.extents(particles + "/position/time").at(0));
  const std::uint64_t count = extents[1];
  disks_.radius = rows(particles + "/radius", 0, count, 1);
  disks_.mass = rows(particles + "/mass", 0, count, 1);
  for (const double species : rows(particles + "/species", 0, count, 1))
    disks_.species.push_back(static_cast<std::int32_t>(species));
  const std::vector<hsize_t> events = open_->datasets.extents("/events/time");
  has_event_log_ = !events.empty();
  if (has_event_log_) events_ = events[0];
}

/// The box and what acts, from the text that the run was made from.
void RunReader::read_scene() {
  const auto text = [&](const char* name) { return detail::read_string_attribute(open_->file.get(), parameters, name); };
  resolved_scene_ = text("resolved_scene");
  scene_ = detail::scene_of(resolved_scene_, path_);
  title_ = text("title");
  species_names_ = detail::read_strings_attribute(open_->file.get(), parameters, "species_names");
  for (const std::int32_t species : disks_.species)
    if (species < 0 || static_cast<std::size_t>(species) >= species_names_.size())
      throw Hdf5Error("a disk belongs to a species without a name");
  facts_.insert(facts_.begin(), {{"Scene", text("scene_source")},
                                 {"Seed", std::to_string(detail::read_unsigned_attribute(open_->file.get(), parameters, "seed"))},
                                 {"Engine", text("engine")},
                                 {"Command", text("command_line")},
                                 {"Carom", fmt::format("{} (commit {})", text("version"), text("commit"))}});
}

void RunReader::require_samples() const {
  if (samples_ == 0)
    throw OutputError(fmt::format(
        "{}: this run kept no samples, so it is not known where its disks were; run it with run.sample_every and its trajectory",
        path_.string()));
}

std::vector<double> RunReader::sample_times() const {
  require_samples();
  return guarded([&] {
    std::vector<double> times = rows(particles + "/position/time", 0, samples_, 1);
    if (!std::is_sorted(times.begin(), times.end()) || !std::isfinite(times.front()) || !std::isfinite(times.back()))
      throw Hdf5Error("the samples are not in order of time");
    return times;
  });
}

void RunReader::require_sample(std::uint64_t k) const {
  require_samples();
  if (k >= samples_)
    throw OutputError(fmt::format("{}: there is no sample {}; the last one is {}", path_.string(), k, samples_ - 1));
}

State RunReader::sample(std::uint64_t k) const {
  require_sample(k);
  return guarded([&] {
    const std::uint64_t count = disks_.count();
    State state;
    state.time = rows(particles + "/position/time", k, 1, 1)[0];
    const std::vector<double> position = rows(particles + "/position/value", k, 1, 3 * count);
    const std::vector<double> velocity = rows(particles + "/velocity/value", k, 1, 3 * count);
    state.positions.resize(2, static_cast<Eigen::Index>(count));
    state.velocities.resize(2, static_cast<Eigen::Index>(count));
    for (std::size_t i = 0; i < count; ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      state.positions.col(column) << position[3 * i], position[3 * i + 1];
      state.velocities.col(column) << velocity[3 * i], velocity[3 * i + 1];
    }
    if (!state.positions.allFinite() || !state.velocities.allFinite()) throw Hdf5Error("a sample holds what is no number");
    bring_into_box(scene_.box, state.positions);
    const std::vector<double> images = rows(particles + "/image/value", k, 1, 3 * count);
    state.images.resize(2, static_cast<Eigen::Index>(count));
    for (std::size_t i = 0; i < count; ++i)
      for (int axis = 0; axis < 2; ++axis)
        state.images(axis, static_cast<Eigen::Index>(i)) =
            static_cast<std::int64_t>(images[3 * i + static_cast<std::size_t>(axis)]);
    for (const double wall : observable("walls", k, 4)) state.walls.push_back({wall, 0.0});
    const std::vector<double> of_walls = observable("wall_velocity", k, 4);
    for (std::size_t side = 0; side < std::min(of_walls.size(), state.walls.size()); ++side)
      state.walls[side].velocity = of_walls[side];
    for (const double bonds : observable("bonds", k, 1)) state.bonds = static_cast<std::uint64_t>(bonds);
    if (const auto extents = open_->datasets.extents("/observables/pairs_in_steps/value"); extents.size() == 2) {
      for (const double pairs : observable("pairs_in_steps", k, extents[1]))  // in all steps that changes may bring in
        state.pairs_in_steps.push_back(static_cast<std::uint64_t>(pairs));
    } else if (scene_.effects.square_well) {
      state.pairs_in_steps = {state.bonds};
    }
    for (const double scale : observable("scale", k, 1)) state.scale = scale;
    for (const double displacement : observable("shear_displacement", k, 1)) state.shear_displacement = displacement;
    if (const std::vector<double> spins = observable("spin", k, count); !spins.empty())
      state.spins = Eigen::Map<const Eigen::VectorXd>(spins.data(), static_cast<Eigen::Index>(count));
    return state;
  });
}

std::vector<double> RunReader::observable(const std::string& name, std::uint64_t k, std::uint64_t row_size) const {
  const std::string dataset = "/observables/" + name + "/value";
  if (open_->datasets.extents(dataset).empty()) return {};
  return rows(dataset, k, 1, row_size);
}

Totals RunReader::totals(std::uint64_t k) const {
  require_sample(k);
  return guarded([&] {
    const std::vector<double> pairs = observable("pair_collisions", k, 1), virial = observable("virial", k, 1);
    if (pairs.empty() || virial.empty())
      throw OutputError(
          fmt::format("{}: an earlier version wrote this file, without the collisions up to each sample; run the scene again",
                      path_.string()));
    const auto number = [](double count) {
      if (!(count >= 0.0 && count <= 0x1p53)) throw Hdf5Error("a number of collisions is none");
      return static_cast<std::uint64_t>(count);
    };
    Totals totals;
    totals.pair = number(pairs[0]);
    for (const double passages : observable("well_passages", k, 1)) totals.well = number(passages);
    totals.virial = virial[0];
    const auto copy = [&](const char* name, std::array<double, 4>& sides) {
      const std::vector<double> values = observable(name, k, 4);
      std::copy(values.begin(), values.end(), sides.begin());
    };
    copy("wall_impulse", totals.wall_impulse);
    for (const double impulse : observable("circle_impulse", k, 1)) totals.circle_impulse = impulse;
    copy("wall_shear", totals.wall_shear);
    copy("wall_energy", totals.wall_energy);
    return totals;
  });
}

void RunReader::require_event_log() const {
  if (!has_event_log_)
    throw OutputError(fmt::format("{}: this run kept no events; run it with output.events = true", path_.string()));
}

State RunReader::start() const {
  require_event_log();
  return guarded([&] {
    const auto count = static_cast<Eigen::Index>(disks_.count());
    const auto columns = [&](const std::string& dataset) {
      if (open_->datasets.extents(dataset).empty())
        throw OutputError(fmt::format(
            "{}: an earlier version wrote this file, without the start of its event log; run the scene again", path_.string()));
      const std::vector<double> values = rows(dataset, 0, disks_.count(), 2);
      return Eigen::Matrix2Xd(Eigen::Map<const Eigen::Matrix2Xd>(values.data(), 2, count));
    };
    State state;
    state.positions = columns("/events/start/position");
    state.velocities = columns("/events/start/velocity");
    state.images = Images::Zero(2, count);
    if (!state.positions.allFinite() || !state.velocities.allFinite()) throw Hdf5Error("the start holds what is no number");
    return state;
  });
}

double RunReader::reference_temperature() const {
  return guarded([&] {
    const std::vector<double> kT = detail::read_numbers_attribute(open_->file.get(), parameters, "reference_temperature");
    if (kT.size() != 1)
      throw OutputError(fmt::format(
          "{}: an earlier version wrote this file, without the temperature that observables refer to; run the scene again",
          path_.string()));
    return kT[0];
  });
}

Scene RunReader::scene(const std::vector<std::string>& overrides) const {
  Scene scene = parse_scene(resolved_scene_, "resolved_scene", overrides);
  if (scene.disk_count() != static_cast<std::int64_t>(disks_.count()))
    throw OutputError(fmt::format("{}: the scene's start file has changed since the run: it has {} disks now, and the run had {}",
                                  path_.string(), scene.disk_count(), disks_.count()));
  return scene;
}

std::vector<Event> RunReader::event_log(std::uint64_t first, std::uint64_t number, double before) const {
  if (number == 0) return {};
  require_event_log();
  if (first > events_ || number > events_ - first)
    throw OutputError(fmt::format("{}: there are no events {} to {}; the number of events is {}", path_.string(), first,
                                  first + (number - 1), events_));
  return guarded([&] {
    const auto column = [&](const char* name, std::uint64_t row) {
      return rows(std::string("/events/") + name, first, number, row);
    };
    std::vector<Event> events(number);
    const std::vector<double> time = column("time", 1), remainder = column("time_remainder", 1), disk = column("disk", 1),
                              partner = column("partner", 1);
    const std::vector<double> velocity = column("velocity", 2), partner_velocity = column("partner_velocity", 2);
    const auto count = static_cast<double>(disks_.count());
    const double last_shape = first_obstacle + 1.0 - static_cast<double>(most_fixed_shapes(scene_));
    for (std::size_t e = 0; e < events.size(); ++e) {
      const double p = partner[e];
      const bool known = p >= 0.0 ? p < count && p != disk[e]
                                  : (p >= double{wall_top} && p <= double{wall_left}) || (p <= first_obstacle && p >= last_shape);
      if (!known || !(disk[e] >= 0.0 && disk[e] < count)) throw Hdf5Error("an event names a disk or wall that is not there");
      if (!(time[e] >= before)) throw Hdf5Error("the events are not in order of time");
      before = time[e];
      events[e] = {.time = time[e],
                   .time_remainder = remainder[e],
                   .disk = static_cast<std::int32_t>(disk[e]),
                   .partner = static_cast<std::int32_t>(p),
                   .velocity = {velocity[2 * e], velocity[2 * e + 1]},
                   .partner_velocity = {partner_velocity[2 * e], partner_velocity[2 * e + 1]}};
      if (!events[e].velocity.allFinite() || !events[e].partner_velocity.allFinite() || !std::isfinite(before) ||
          !std::isfinite(remainder[e]))
        throw Hdf5Error("an event holds what is no number");
    }
    return events;
  });
}

}  // namespace carom
