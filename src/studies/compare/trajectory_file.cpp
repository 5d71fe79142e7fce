#include "studies/compare/trajectory_file.hpp"

#include "core/nearest_image.hpp"
#include "scene/csv_table.hpp"
#include "scene/document.hpp"
#include "scene/npy_file.hpp"
#include "studies/diff/diff.hpp"

#include <carom/io/run_reader.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string_view>

namespace carom {

namespace {

std::vector<State> read_npy(const std::string& path, std::optional<double> every) {
  const std::string text = detail::read_text_file(path);
  if (!every)
    throw std::invalid_argument(fmt::format("{}: an array has no times; give the time between frames, --every DT", path));
  if (!(*every > 0.0 && std::isfinite(*every)))
    throw std::invalid_argument(fmt::format("--every {:g}: the time between frames must be positive and finite", *every));
  const detail::NpyFrames file = detail::parse_npy_frames(text, path);
  std::vector<State> frames(file.frames);
  const auto disks = static_cast<Eigen::Index>(file.disks);
  const double* value = file.values.data();
  for (std::size_t k = 0; k < frames.size(); ++k) {
    frames[k].time = static_cast<double>(k) * *every;
    frames[k].positions.resize(2, disks);
    frames[k].velocities.resize(2, file.columns == 4 ? disks : 0);
    for (Eigen::Index i = 0; i < disks; ++i, value += file.columns) {
      frames[k].positions.col(i) << value[0], value[1];
      if (file.columns == 4) frames[k].velocities.col(i) << value[2], value[3];
    }
  }
  return frames;
}

/// A table of numbers below a row of names.
class FrameTable {
 public:
  FrameTable(const std::string& path, std::int64_t disks) : path_(path), text_(detail::read_text_file(path)), disks_(disks) {}

  std::vector<State> read() {
    detail::CsvTable table(text_);
    if (const std::optional<detail::CsvRow> header = table.header([](std::string_view name) { return name == "time"; }))
      name_columns(*header);
    while (const detail::CsvRow* row = table.next()) add_row(*row);
    if (!frames_.empty()) end_frame();
    return std::move(frames_);
  }

 private:
  [[noreturn]] void fail(const std::string& sentence) const { throw SceneError({path_, line_, 1}, sentence); }

  void name_columns(const detail::CsvRow& header) {
    line_ = header.line;
    for (const detail::CsvField& field : header.fields) names_.push_back(field.text == "id" ? "disk" : field.text);
    for (const std::string_view needed : {"time", "disk", "x", "y"})
      if (std::find(names_.begin(), names_.end(), needed) == names_.end())
        fail(fmt::format("there is no column {}; the first row must name the columns time,disk,x,y or time,disk,x,y,vx,vy",
                         needed));
  }
  [[nodiscard]] bool has(std::string_view name) const { return std::find(names_.begin(), names_.end(), name) != names_.end(); }

  [[nodiscard]] double number(const detail::CsvRow& row, std::string_view name) const {
    const auto place = static_cast<std::size_t>(std::find(names_.begin(), names_.end(), name) - names_.begin());
    const std::string_view text = row.fields[place].text;
    const std::optional<double> value = detail::finite_number_in(text);
    if (!value) fail(fmt::format("{} is \"{}\", which is no finite number", name, text));
    return *value;
  }

  void add_row(const detail::CsvRow& row) {
    line_ = row.line;
    if (row.fields.size() != names_.size())
      fail(fmt::format("the row has {} values for {} columns", row.fields.size(), names_.size()));
    const double time = number(row, "time"), disk = number(row, "disk");
    if (!(disk >= 0.0 && disk < static_cast<double>(disks_) && disk == std::floor(disk)))
      fail(fmt::format("disk {:g} is none of the scene's, which are numbered 0 to {}", disk, disks_ - 1));
    const bool moving = has("vx") && has("vy");
    if (frames_.empty() || time != frames_.back().time) {
      if (!frames_.empty()) end_frame();
      State& begun = frames_.emplace_back();
      begun.time = time;
      begun.positions.setConstant(2, disks_, NAN);
      begun.velocities.setZero(2, moving ? disks_ : 0);
    }
    const auto i = static_cast<Eigen::Index>(disk);
    State& frame = frames_.back();
    if (!std::isnan(frame.positions(0, i))) fail(fmt::format("disk {} stands twice in the frame at t = {:g}", i, time));
    frame.positions.col(i) = Eigen::Vector2d(number(row, "x"), number(row, "y"));
    if (moving) frame.velocities.col(i) = Eigen::Vector2d(number(row, "vx"), number(row, "vy"));
  }

  void end_frame() const {
    for (Eigen::Index i = 0; i < disks_; ++i)
      if (std::isnan(frames_.back().positions(0, i)))
        fail(fmt::format("the frame at t = {:g} ends without disk {} of the scene's {} disks", frames_.back().time, i, disks_));
  }

  const std::string& path_;
  std::string text_;
  std::int64_t disks_;
  std::vector<std::string_view> names_;
  std::vector<State> frames_;
  int line_ = 0;
};

std::vector<State> read_h5md(const std::string& path, const Scene& scene, const Disks& disks) {
  const RunReader run = RunReader::of_trajectory(path);
  if (const std::string other = different_system(run.scene().box, run.disks(), scene.box, disks); !other.empty())
    throw std::invalid_argument(fmt::format("{} (the first) and {} (the second) differ: {}", path, scene.source, other));
  std::vector<State> frames;
  for (std::uint64_t k = 0; k < run.samples(); ++k) frames.push_back(run.sample(k));
  return frames;
}

void require_frames_of(const Disks& disks, const std::vector<State>& frames, const std::string& path) {
  if (frames.empty()) throw std::invalid_argument(fmt::format("{}: there are no frames in this file", path));
  const auto count = static_cast<std::size_t>(frames.front().positions.cols());
  if (count != disks.count())
    throw std::invalid_argument(fmt::format("{}: its frames have {} disks and the scene has {}", path, count, disks.count()));
  if (!(frames.front().time >= 0.0))
    throw std::invalid_argument(fmt::format("{}: its first frame is at t = {:g}, before the scene begins", path, frames[0].time));
  for (std::size_t k = 1; k < frames.size(); ++k)
    if (!(frames[k].time > frames[k - 1].time))
      throw std::invalid_argument(fmt::format("{}: frame {} is at t = {:g} and the one before at t = {:g}; times must increase",
                                              path, k, frames[k].time, frames[k - 1].time));
}

}  // namespace

std::vector<State> read_trajectory_file(const std::string& path, const Scene& scene, const Disks& disks,
                                        std::optional<double> every) {
  const std::string ending = std::filesystem::path(path).extension().string();
  if (ending != ".npy" && ending != ".csv" && ending != ".h5md")
    throw std::invalid_argument(fmt::format("{}: a trajectory ends in .npy, .csv or .h5md", path));
  if (every && ending != ".npy") throw std::invalid_argument(fmt::format("--every: {} has times of its own; leave it out", path));
  std::vector<State> frames = ending == ".npy"   ? read_npy(path, every)
                              : ending == ".csv" ? FrameTable(path, static_cast<std::int64_t>(disks.count())).read()
                                                 : read_h5md(path, scene, disks);
  require_frames_of(disks, frames, path);
  for (State& frame : frames) bring_into_box(scene.box, frame.positions);
  return frames;
}

}  // namespace carom
