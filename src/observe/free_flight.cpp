// Free flight between two collisions with other disks: mean time and path, and how they are distributed. Averages over
// collisions; flights that began before the run, or end after it, are left out, which shortens the means by about one flight in
// as many as a disk makes. Walls do not end a flight.
// In large systems every second, fourth, ... disk is followed, at most a thousand.

#include "core/instant.hpp"
#include "observe/blocking.hpp"
#include "observe/followed_disks.hpp"
#include "observe/followers.hpp"
#include "observe/observables.hpp"
#include "observe/saved_observable.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace carom {

namespace {

/// A histogram from 0 to `range`, gathered over some thousand flights before it counts as one sample.
class FlightHistogram {
 public:
  FlightHistogram(std::size_t bins, double range)
      : width_(range / static_cast<double>(bins)),
        per_width_(static_cast<double>(bins) / range),
        end_(static_cast<double>(bins)),
        counts_(bins + 1),
        shares_(bins) {}

  /// Anything: what is no number, infinite or beyond the range is not shown.
  void add(double x) {
    const double bin = x * per_width_;
    ++counts_[static_cast<std::size_t>(static_cast<std::int32_t>(bin < end_ ? bin : end_))];  // signed: converts much faster
  }
  void flush(double flights) {
    for (std::size_t b = 0; b < bins(); ++b) shares_.add(b, static_cast<double>(counts_[b]), flights);
    std::ranges::fill(counts_, 0);
  }
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

  double width_, per_width_, end_;
  std::vector<std::uint32_t> counts_;  ///< of the bins, and of all the rest
  BlockedColumn shares_;
};

class FreeFlight final : public SavedObservable<FreeFlight>, public NoteFollower {
 public:
  FreeFlight(const ObservableRequest& request, const ObservedRun& run)
      : times_(static_cast<std::size_t>(request.bins.value_or(100)), longest * scale(run)),
        paths_(static_cast<std::size_t>(request.bins.value_or(100)), longest * scale(run) * speed(run)),
        skip_(static_cast<std::uint32_t>(std::bit_ceil((run.disks.count() + most_disks - 1) / most_disks)) - 1),
        why_no_path_(why_no_path(run.scene.effects)) {
    for (std::size_t disk = 0; disk < run.disks.count(); disk += skip_ + 1) ids_.push_back(static_cast<std::int32_t>(disk));
    last_.assign(ids_.size(), never);
  }

  [[nodiscard]] std::string name() const override { return "free_flight"; }
  [[nodiscard]] bool follows_collisions() const override { return true; }

  void collisions(std::span<const PairCollision> collisions) override {
    for (; collisions.size() > piece; collisions = collisions.subspan(piece)) look_at(collisions.first(piece));
    look_at(collisions);
  }

  void read(const CollisionNotes& notes) override {
    if (notes.disks != noted_) follow_in(notes.disks);
    const Instant epoch{notes.epoch, notes.epoch_remainder};
    for (std::size_t begin = 0; begin < notes.notes.size(); begin += piece)
      look_at(epoch, notes.notes.subspan(begin, std::min(piece, notes.notes.size() - begin)));
  }

  [[nodiscard]] Measurement finish(double time, const Totals&) override {
    const double flushes = static_cast<double>(mean_time_.samples());
    const double step = flushes > 0.0 ? time / flushes : 0.0;
    if (sums_.flights > 0) end_sample(sums_);
    if (counted_ > 0) end_histograms();
    Measurement found{.name = name()};
    found.note = "over flights that began and ended within the run";
    put(found, "mean_free_time", "time", mean_time_, step);
    if (why_no_path_.empty()) {
      put(found, "mean_free_path", "length", mean_path_, step);
    } else {
      found.scalars.push_back({.name = "mean_free_path", .unit = "length", .average = Average::collisions, .note = why_no_path_});
    }
    found.tables.push_back(times_.table("free_times", "time"));
    if (why_no_path_.empty()) found.tables.push_back(paths_.table("free_paths", "length"));
    return found;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(times_, paths_, ids_, last_, sums_.flights, sums_.time, sums_.path, counted_, mean_time_, mean_path_);
  }

 private:
  /// Of the histograms, in mean free times: one flight in e^10 is longer.
  static constexpr double longest = 10.0;
  /// No more disks are followed: what all of them tell in a run would slow a large one down.
  static constexpr std::size_t most_disks = 1000;
  /// Flights that count as one sample of the means; a sample of the histograms has 16 times as many.
  static constexpr std::uint64_t batch = 256;
  static constexpr std::size_t piece = 128;  ///< collisions
  static constexpr double never = -std::numeric_limits<double>::infinity();

  /// A path is speed times time where nothing but collisions changes the speed.
  static std::string why_no_path(const Effects& effects) {
    if (effects.gravity && !effects.gravity->acceleration.isZero(0.0)) return "paths are parabolas under gravity";
    if (effects.square_well) return "speeds change at the edges of wells";
    const bool still = std::all_of(effects.walls.begin(), effects.walls.end(), [](const WallProperties& wall) {
      return !wall.temperature && !wall.mass && wall.velocity.value_or(0.0) == 0.0 && wall.restitution.value_or(1.0) == 1.0;
    });
    return still ? "" : "walls change speeds between two collisions";
  }
  static double scale(const ObservedRun& run) { return run.mean_free_time > 0.0 ? run.mean_free_time : run.step({}, 1.0); }
  static double speed(const ObservedRun& run) {
    double mass = 0.0;
    for (const double m : run.disks.mass) mass += m / static_cast<double>(run.disks.count());
    return run.temperature > 0.0 ? std::sqrt(run.temperature / mass) : 1.0;
  }

  /// Who is followed nobody can guess: collisions that end flights are listed without a branch, and looked at then.
  struct Listed {
    std::array<std::uint32_t, piece> which;
    std::size_t count = 0;

    void add(std::uint32_t collision, bool ends_flights) {
      which[count] = collision;
      count += static_cast<std::size_t>(ends_flights);
    }
    [[nodiscard]] std::span<const std::uint32_t> all() const { return std::span(which).first(count); }
  };

  /// At most `piece` of them.
  void look_at(std::span<const PairCollision> collisions) {
    Listed listed;
    for (std::uint32_t n = 0; n < collisions.size(); ++n)
      listed.add(n, collisions[n].contact && (follows(collisions[n].disk) || follows(collisions[n].partner)));
    Sums sums = sums_;
    for (const std::uint32_t n : listed.all()) {
      const PairCollision& met = collisions[n];
      double nobody = never;
      end({follows(met.disk) ? &last_[row_by_id(met.disk)] : &nobody, met.velocity_before.data()},
          {follows(met.partner) ? &last_[row_by_id(met.partner)] : &nobody, met.partner_velocity_before.data()}, met.time, sums);
    }
    sums_ = sums;
  }

  /// The same, whichever of the two comes first.
  void look_at(const Instant& epoch, std::span<const CollisionNote> notes) {
    Listed listed;
    for (std::uint32_t n = 0; n < notes.size(); ++n)
      listed.add(n, skip_ == 0 || places_.has_either(notes[n].place, notes[n].partner));
    Sums sums = sums_;
    for (const std::uint32_t n : listed.all()) {
      const CollisionNote& note = notes[n];
      double nobody = never;
      end({last_of(note.place, nobody), note.before}, {last_of(note.partner, nobody), note.partner_before},
          epoch.plus(note.time).high, sums);
    }
    sums_ = sums;
  }
  [[nodiscard]] double* last_of(std::int32_t place, double& nobody) {
    if (skip_ == 0) return last_.data() + place;
    return places_.has(place) ? last_.data() + places_.row(place) : &nobody;
  }

  /// Rows are by id to begin with; from now on they are by place.
  void follow_in(const std::shared_ptr<const NotedDisks>& disks) {
    noted_ = disks;
    places_ = FollowedDisks(*disks, [this](std::int32_t disk) { return follows(disk); });
    std::vector<double> by_id(last_.size());
    for (std::size_t row = 0; row < last_.size(); ++row) by_id[row_by_id(ids_[row])] = last_[row];
    ids_ = places_.ids();
    for (std::size_t row = 0; row < last_.size(); ++row) last_[row] = by_id[row_by_id(ids_[row])];
  }

  [[nodiscard]] bool follows(std::int32_t disk) const { return (static_cast<std::uint32_t>(disk) & skip_) == 0; }
  [[nodiscard]] std::size_t row_by_id(std::int32_t disk) const {
    return static_cast<std::uint32_t>(disk) >> std::popcount(skip_);
  }

  struct Sums {  ///< since the last sample of the means
    std::uint64_t flights = 0;
    double time = 0.0, path = 0.0;
  };
  /// One of the two in a collision.
  struct Flier {
    double* last;            ///< collision
    const double* velocity;  ///< with which it came, and which it had all the way
  };
  /// Two flights end, or one where nobody follows the other disk or knows when its flight began. No branches, and the same bits
  /// in either order.
  void end(const Flier& a, const Flier& b, double time, Sums& sums) {
    const auto flight_of = [&](const Flier& flier) {
      const double flight = time - *flier.last;
      *flier.last = time;
      const double path = std::sqrt(flier.velocity[0] * flier.velocity[0] + flier.velocity[1] * flier.velocity[1]) * flight;
      times_.add(flight);
      paths_.add(path);
      const bool known = flight < std::numeric_limits<double>::infinity();
      return Sums{known, known ? flight : 0.0, known ? path : 0.0};
    };
    const Sums first = flight_of(a), second = flight_of(b);
    sums.flights += first.flights + second.flights;
    sums.time += first.time + second.time;
    sums.path += first.path + second.path;
    if (sums.flights < batch) return;  // after so many flights, however collisions are handed over
    end_sample(sums);
    if (counted_ >= 16 * batch) end_histograms();
  }
  void end_sample(Sums& sums) {
    const double flights = static_cast<double>(sums.flights);
    mean_time_.add(sums.time, flights);
    mean_path_.add(sums.path, flights);
    counted_ += sums.flights;
    sums = {};
  }
  void end_histograms() {
    const double flights = static_cast<double>(counted_);
    times_.flush(flights);
    paths_.flush(flights);
    counted_ = 0;
  }
  static void put(Measurement& found, const char* name, const char* unit, const Blocking& series, double step) {
    Scalar scalar{.name = name, .unit = unit, .average = Average::collisions};
    series.fill(scalar, step);
    if (!scalar.value) scalar.note = "no disk has collided twice";
    found.scalars.push_back(std::move(scalar));
  }

  FlightHistogram times_, paths_;
  std::uint32_t skip_;             ///< disks whose id has one of these bits are not followed
  std::vector<std::int32_t> ids_;  ///< of those who are followed, by row
  std::vector<double> last_;       ///< collision of each; `never` before the first
  std::shared_ptr<const NotedDisks> noted_;
  FollowedDisks places_;  ///< in noted_
  std::string why_no_path_;
  Sums sums_;
  std::uint64_t counted_ = 0;  ///< in samples since the last one of the histograms
  Blocking mean_time_, mean_path_;
};

}  // namespace

MadeObservable make_free_flight(const ObservableRequest& request, const ObservedRun& run) {
  return std::make_unique<FreeFlight>(request, run);
}

}  // namespace carom
