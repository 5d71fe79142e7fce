// Free flight between two collisions with other disks: mean time and path, and how they are distributed. Averages over
// collisions; flights that began before the run, or end after it, are left out, which shortens the means by about one flight in
// as many as a disk makes. Walls do not end a flight.
// In large systems a half, a fourth, ... of the disks are followed, at most a thousand.

#include "core/instant.hpp"
#include "observe/blocking.hpp"
#include "observe/ended_flights.hpp"
#include "observe/followers.hpp"
#include "observe/observables.hpp"
#include "observe/saved_observable.hpp"
#include "observe/tracked_disks.hpp"
#include "scene/effect_traits.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <vector>

namespace carom {

namespace {

/// A histogram from 0 to `range`, gathered over some thousand flights before it counts as one sample.
class FlightHistogram {
 public:
  FlightHistogram(std::size_t bins, double range) : width_(range / static_cast<double>(bins)), counts_(bins + 1), shares_(bins) {}

  /// The bin behind the last is not shown.
  void add(std::span<const std::int32_t> found) {
    std::uint32_t* counts = counts_.data();
    for (; found.size() >= 4; found = found.subspan(4))
      for (std::size_t k = 0; k < 4; ++k) ++counts[found[k]];
    for (const std::int32_t bin : found) ++counts[bin];
  }
  void flush(double flights) {
    for (std::size_t b = 0; b < bins(); ++b) shares_.add(b, static_cast<double>(counts_[b]), flights);
    std::ranges::fill(counts_, 0);
  }
  [[nodiscard]] double width() const { return width_; }
  [[nodiscard]] bool has_lower_bounds() const { return shares_.has_lower_bounds(); }
  [[nodiscard]] Table table(const std::string& name, const std::string& unit) const {
    Table table{.name = name, .average = Average::collisions};
    Column middles{"middle", unit, {}};
    for (std::size_t b = 0; b < bins(); ++b) middles.values.push_back((static_cast<double>(b) + 0.5) * width_);
    table.columns.push_back(std::move(middles));
    shares_.put(table, "density", "1 / " + unit, 1.0 / width_);
    return table;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(counts_, shares_);
  }

 private:
  [[nodiscard]] std::size_t bins() const { return counts_.size() - 1; }

  double width_;
  std::vector<std::uint32_t> counts_;  ///< counts of the bins, and of all values beyond them
  BlockedColumn shares_;
};

class FreeFlight final : public SavedObservable<FreeFlight>, public RecordFollower {
 public:
  FreeFlight(const ObservableRequest& request, const ObservedRun& run)
      : SavedObservable(request, run),
        times_(static_cast<std::size_t>(request.bins.value_or(100)), longest * scale(run)),
        paths_(static_cast<std::size_t>(request.bins.value_or(100)), longest * scale(run) * speed(run)),
        bins_{1.0 / times_.width(), 1.0 / paths_.width(), static_cast<double>(request.bins.value_or(100))},
        why_no_path_(why_no_path(run.scene.effects)) {
    std::vector<std::int32_t> all(run.disks.count());
    std::iota(all.begin(), all.end(), 0);
    const std::size_t share = std::bit_ceil((all.size() + most_disks - 1) / most_disks);
    ids_ = sampled_disks(all, (all.size() + share - 1) / share, run.scene.run.seed);
    rows_by_id_.assign(all.size(), static_cast<std::uint32_t>(ids_.size()));
    for (std::uint32_t row = 0; row < ids_.size(); ++row) rows_by_id_[static_cast<std::size_t>(ids_[row])] = row;
    last_.assign(ids_.size() + 1, never);
  }

  [[nodiscard]] bool follows_collisions() const override { return true; }

  void follow(const CollisionRecords& collisions) override {
    if (collisions.disks != table_) follow_in(collisions.disks);
    const Instant epoch{collisions.epoch, collisions.epoch_remainder};
    const std::span<const CollisionRecord> records = collisions.records;
    for (std::size_t begin = 0; begin < records.size(); begin += piece)
      look_at(epoch, records.subspan(begin, std::min(piece, records.size() - begin)));
  }

  [[nodiscard]] Measurement finish(double time, const Totals&) override {
    const double flushes = static_cast<double>(mean_time_.samples());
    const double step = flushes > 0.0 ? time / flushes : 0.0;
    if (count_ > 0) end_sample();
    if (counted_ > 0) end_histograms();
    Measurement found{.name = name()};
    found.note = "over flights that began and ended within the run";
    put(found, "mean_free_time", "time", mean_time_, step);
    if (why_no_path_.empty()) {
      put(found, "mean_free_path", "length", mean_path_, step);
    } else {
      found.scalars.push_back({.name = "mean_free_path", .unit = "length", .average = Average::collisions, .note = why_no_path_});
    }
    note_lower_bounds(found, times_.has_lower_bounds() || (why_no_path_.empty() && paths_.has_lower_bounds()));
    found.tables.push_back(times_.table("free_times", "time"));
    if (why_no_path_.empty()) found.tables.push_back(paths_.table("free_paths", "length"));
    return found;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(times_, paths_, ids_, last_, ended_.time, ended_.velocity, count_, counted_, samples_, histograms_, mean_time_,
            mean_path_);
  }

 private:
  /// Upper end of the histograms, in mean free times: one flight in e^10 is longer.
  static constexpr double longest = 10.0;
  /// Number of disks that are followed at most; following all would slow large runs down.
  static constexpr std::size_t most_disks = 1000;
  /// EndedFlights::most collisions count as one sample of the means; a sample of the histograms has so many times as many.
  /// Later on four times as many: its errors are known well enough by then, and all its bins have to be gone through.
  [[nodiscard]] std::uint64_t samples_of_histogram() const { return histograms_ < 64 ? 16 : 64; }
  static constexpr std::size_t piece = 64;  ///< records
  static constexpr double never = -std::numeric_limits<double>::infinity();

  /// A path is speed times time where nothing but collisions changes the speed.
  static std::string why_no_path(const Effects& effects) {
    return std::string(detail::first_reason(effects, &detail::EffectTraits::why_no_path));
  }
  static double scale(const ObservedRun& run) { return run.mean_free_time > 0.0 ? run.mean_free_time : run.step_of(1.0); }
  static double speed(const ObservedRun& run) {
    const double mass = run.disks.total_mass() / static_cast<double>(run.disks.count());
    return run.energy_scale() > 0.0 ? std::sqrt(run.energy_scale() / mass) : 1.0;
  }

  /// Processes at most `piece` collisions. Which disks are followed is unpredictable, so collisions that end flights are listed
  /// without a branch.
  void look_at(const Instant& epoch, std::span<const CollisionRecord> records) {
    if (ids_.size() < rows_by_id_.size()) {
      std::array<std::uint32_t, piece> which;
      for (const std::uint32_t n : std::span(which).first(places_.find(records, which.data()))) {
        end(last_.data() + places_.row(records[n].slot_i), last_.data() + places_.row(records[n].slot_j),
            epoch.plus(records[n].time).high);
        last_.back() = never;
        keep_velocities(records[n]);
      }
      return;
    }
    while (!records.empty()) {
      const std::size_t count = std::min<std::size_t>(records.size(), EndedFlights::most - count_);
      kernel_.gather(epoch, records.data(), count, last_.data(), ended_, count_);
      records = records.subspan(count);
      if ((count_ += count) == EndedFlights::most) end_sample();
    }
  }
  void keep_velocities(const CollisionRecord& record) {
    std::memcpy(ended_.velocity[count_], record.before_i, sizeof record.before_i);
    std::memcpy(ended_.velocity[count_] + 2, record.before_j, sizeof record.before_j);
    if (++count_ == EndedFlights::most) end_sample();
  }

  /// Rows are by id to begin with; from now on they are by place.
  void follow_in(const std::shared_ptr<const DiskTable>& disks) {
    table_ = disks;
    places_ = FollowedDisks(*disks, [this](std::int32_t disk) { return follows(disk); });
    std::vector<double> by_id(last_.size());
    for (std::size_t row = 0; row < ids_.size(); ++row) by_id[row_by_id(ids_[row])] = last_[row];
    ids_ = places_.ids();
    for (std::size_t row = 0; row < ids_.size(); ++row) last_[row] = by_id[row_by_id(ids_[row])];
  }

  [[nodiscard]] std::size_t row_by_id(std::int32_t disk) const { return rows_by_id_[static_cast<std::size_t>(disk)]; }
  [[nodiscard]] bool follows(std::int32_t disk) const { return row_by_id(disk) < ids_.size(); }

  /// Ends two flights, or one where the other disk is not followed or the beginning of its flight is unknown.
  void end(double* last, double* partner_last, double time) {
    ended_.time[0][count_] = time - *last;
    ended_.time[1][count_] = time - *partner_last;
    *last = *partner_last = time;
  }
  /// Ends a sample, after a fixed number of collisions however they are divided among calls.
  void end_sample() {
    const std::size_t fours = (count_ + 3) / 4;
    for (std::size_t n = count_; n < 4 * fours; ++n) ended_.time[0][n] = ended_.time[1][n] = EndedFlights::unknown;
    TalliedFlights found;
    kernel_.tally(ended_, fours, bins_, found);
    for (std::size_t k = 0; k < 2; ++k) {
      times_.add(std::span(found.time_bin[k]).first(count_));
      paths_.add(std::span(found.path_bin[k]).first(count_));
    }
    count_ = 0;
    if (found.flights == 0.0) return;
    mean_time_.add(found.time, found.flights);
    mean_path_.add(found.path, found.flights);
    counted_ += static_cast<std::uint64_t>(found.flights);
    if (++samples_ >= samples_of_histogram()) end_histograms();
  }
  void end_histograms() {
    const double flights = static_cast<double>(counted_);
    times_.flush(flights);
    paths_.flush(flights);
    counted_ = samples_ = 0;
    ++histograms_;
  }
  static void put(Measurement& found, const char* name, const char* unit, const Blocking& series, double step) {
    Scalar scalar{.name = name, .unit = unit, .average = Average::collisions};
    series.fill(scalar, step);
    if (!scalar.value) scalar.note = "no disk has collided twice";
    found.scalars.push_back(std::move(scalar));
  }

  FlightHistogram times_, paths_;
  FlightBins bins_;
  std::vector<std::int32_t> ids_;          ///< ids of the followed disks, by row
  std::vector<std::uint32_t> rows_by_id_;  ///< row of each disk at the start; one behind the last for disks that are not followed
  std::vector<double> last_;               ///< collision of each, `never` before the first; the last is that of all others
  std::shared_ptr<const DiskTable> table_;
  FollowedDisks places_;  ///< in table_
  std::string why_no_path_;
  EndedFlights ended_;
  std::uint64_t count_ = 0;                  ///< number of collisions in it
  std::uint64_t counted_ = 0, samples_ = 0;  ///< flights, and samples, since the last one of the histograms
  std::uint64_t histograms_ = 0;             ///< that were examined
  const EndedFlightsKernel& kernel_ = ended_flights_kernel();
  Blocking mean_time_, mean_path_;
};

}  // namespace

MadeObservable make_free_flight(const ObservableRequest& request, const ObservedRun& run) {
  return std::make_unique<FreeFlight>(request, run);
}

}  // namespace carom
