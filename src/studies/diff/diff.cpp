#include "studies/diff/diff.hpp"

#include "io/finished_run.hpp"
#include "observe/geometry.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <deque>
#include <fstream>
#include <stdexcept>
#include <string_view>

namespace carom {

namespace fs = std::filesystem;

namespace {

bool same_bits(const Eigen::Matrix2Xd& a, const Eigen::Matrix2Xd& b) {
  return a.cols() == b.cols() && std::memcmp(a.data(), b.data(), sizeof(double) * static_cast<std::size_t>(a.size())) == 0;
}

bool same_bits(const State& a, const State& b) {
  return std::bit_cast<std::uint64_t>(a.time) == std::bit_cast<std::uint64_t>(b.time) && same_bits(a.positions, b.positions) &&
         same_bits(a.velocities, b.velocities) && a.images == b.images && a.scale == b.scale &&
         a.spins.size() == b.spins.size() && a.spins == b.spins;
}

/// The collisions of a log that have found no counterpart yet, with their numbers. It holds the next ones, up to the first at a
/// later time than the next.
class OpenCollisions {
 public:
  explicit OpenCollisions(const NextEvents& next_events) : next_events_(next_events) { refill(); }

  [[nodiscard]] bool at_end() const { return open_.empty(); }
  [[nodiscard]] const Numbered& next() const { return open_.front(); }
  /// Removes a collision of these partners at the time of the next one. Returns whether there is one.
  bool remove(const Event& like) {
    const double time = next().event.time;
    const auto found = std::find_if(open_.begin(), open_.end(), [&](const Numbered& one) {
      return one.event.time != time || (one.event.disk == like.disk && one.event.partner == like.partner);
    });
    if (found == open_.end() || found->event.time != time) return false;
    open_.erase(found);
    refill();
    return true;
  }

 private:
  void refill() {
    while (!ended_ && (open_.empty() || open_.front().event.time == open_.back().event.time)) {
      const std::vector<Event> more = next_events_();
      for (const Event& event : more) open_.push_back({++read_, event});
      ended_ = more.empty();
    }
  }

  NextEvents next_events_;
  std::deque<Numbered> open_;
  std::uint64_t read_ = 0;
  bool ended_ = false;
};

NextEvents events_of(const RunReader& run) {
  return [&run, first = std::uint64_t{0}, before = 0.0]() mutable {
    const std::uint64_t count = std::min<std::uint64_t>(run.events() - first, 65536);
    std::vector<Event> events = run.event_log(first, count, before);
    first += count;
    if (count > 0) before = events.back().time;
    return events;
  };
}

SampledOverlap overlap_of(const RunReader& run, const State& state) {
  const DeepestOverlap deepest = deepest_overlap(run.scene().box, run.scene().effects, run.disks(), state);
  return {deepest.relative, state.time, deepest.first, deepest.second};
}

std::string first_other(const char* what, const std::vector<double>& a, const std::vector<double>& b) {
  const auto [in_a, in_b] = std::mismatch(a.begin(), a.end(), b.begin());
  if (in_a == a.end()) return {};
  return fmt::format("disk {} has {} {} in the first and {} in the second", in_a - a.begin(), what, *in_a, *in_b);
}

/// Whether a file begins as all HDF5 files do, or cannot be read at all, which HDF5 will say.
bool begins_as_hdf5(const fs::path& path) {
  std::array<char, 4> first{};
  std::ifstream file(path, std::ios::binary);
  if (!file) return true;
  file.read(first.data(), first.size());
  return std::string_view(first.data(), first.size()) == "\x89HDF";
}

}  // namespace

DiffRun open_diff_run(const fs::path& path) {
  std::error_code error;
  const bool alone = fs::is_regular_file(path, error);
  if (alone && !begins_as_hdf5(path))
    throw std::runtime_error(fmt::format(
        "{}: this is no trajectory.h5md; give the directory of a run or that file of it, and a trajectory of your own "
        "to carom compare SCENE --trajectory FILE",
        path.string()));
  DiffRun run{path.string(), alone ? RunReader::of_trajectory(path) : RunReader(path), ""};
  if (!alone)
    if (const auto json = detail::summary_in(path); json.contains("state_hash") && json.at("state_hash").is_string())
      run.state_hash = json.at("state_hash").get<std::string>();
  return run;
}

bool same_time(double a, double b) { return std::abs(a - b) <= 1e-12 * std::max(std::abs(a), std::abs(b)); }

std::string different_system(const Box& box_a, const Disks& a, const Box& box_b, const Disks& b) {
  if (a.count() != b.count()) return fmt::format("the first has {} disks and the second {}", a.count(), b.count());
  if (const std::string radius = first_other("radius", a.radius, b.radius); !radius.empty()) return radius;
  if (const std::string mass = first_other("mass", a.mass, b.mass); !mass.empty()) return mass;
  for (int axis = 0; axis < 2; ++axis) {
    const char* const name = axis == 0 ? "x" : "y";
    if (box_a.lower[axis] != box_b.lower[axis] || box_a.upper[axis] != box_b.upper[axis])
      return fmt::format("the box is [{}, {}] along {} in the first and [{}, {}] in the second", box_a.lower[axis],
                         box_a.upper[axis], name, box_b.lower[axis], box_b.upper[axis]);
    if (box_a.periodic(axis) != box_b.periodic(axis))
      return fmt::format("along {} the first has {} and the second {}", name, box_a.periodic(axis) ? "periodic edges" : "walls",
                         box_b.periodic(axis) ? "periodic edges" : "walls");
  }
  return {};
}

LogDifference first_different_collision(const NextEvents& a, const NextEvents& b) {
  LogDifference result;
  OpenCollisions in_a(a), in_b(b);
  while (!in_a.at_end() && !in_b.at_end()) {
    const Numbered of_a = in_a.next(), of_b = in_b.next();
    const bool both = in_b.remove(of_a.event) ? in_a.remove(of_a.event) : in_a.remove(of_b.event) && in_b.remove(of_b.event);
    if (!both) {
      result.first = {of_a, of_b};
      break;
    }
    ++result.equal;
  }
  return result;
}

bool RunDifference::same() const {
  const bool hashes = state_hash[0].empty() || state_hash[1].empty() || state_hash[0] == state_hash[1];
  return hashes && samples[0] == samples[1] && equal_samples == samples[0];
}

RunDifference difference_of(const DiffRun& a, const DiffRun& b) {
  const std::array<const DiffRun*, 2> runs = {&a, &b};
  const Box& box = a.reader.scene().box;
  if (const std::string found = different_system(box, a.reader.disks(), b.reader.scene().box, b.reader.disks()); !found.empty())
    throw OutputError(fmt::format("{} and {} are no runs of the same disks in the same box: {}", a.name, b.name, found));
  RunDifference result;
  if (a.reader.disks().count() > 0) result.diameter = a.reader.disks().mean_diameter();
  std::array<std::vector<double>, 2> times;
  for (std::size_t r = 0; r < 2; ++r) {
    result.names[r] = runs[r]->name;
    result.state_hash[r] = runs[r]->state_hash;
    result.samples[r] = runs[r]->reader.samples();
    result.has_events[r] = runs[r]->reader.has_event_log();
    times[r] = runs[r]->reader.sample_times();
  }
  const auto look = [&](std::size_t r, std::size_t k) {
    State state = runs[r]->reader.sample(k);
    const SampledOverlap found = overlap_of(runs[r]->reader, state);
    if (found.relative > result.overlap[r].relative) result.overlap[r] = found;
    return state;
  };
  for (std::size_t k = 0, l = 0; k < times[0].size() || l < times[1].size();) {
    const bool has_a = k < times[0].size(), has_b = l < times[1].size();
    if (has_a && has_b && same_time(times[0][k], times[1][l])) {
      const State of_a = look(0, k), of_b = look(1, l);
      result.distances.push_back(distance_at(box, of_a, of_b));
      if (k == l && result.equal_samples == k && same_bits(of_a, of_b)) ++result.equal_samples;
      ++k;
      ++l;
    } else if (has_a && (!has_b || times[0][k] < times[1][l])) {
      (void)look(0, k++);
    } else {
      (void)look(1, l++);
    }
  }
  if (result.distances.empty())
    throw OutputError(
        fmt::format("{} and {} have no sample time in common: the first has t = {:g} to {:g}, the second {:g} to {:g}", a.name,
                    b.name, times[0].front(), times[0].back(), times[1].front(), times[1].back()));
  if (result.has_events[0] && result.has_events[1])
    result.log = first_different_collision(events_of(a.reader), events_of(b.reader));
  return result;
}

}  // namespace carom
