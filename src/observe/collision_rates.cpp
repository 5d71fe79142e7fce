// Collision rates of a disk: with all disks, and by pairs of species. Averages over time.

#include "observe/blocking.hpp"
#include "observe/observables.hpp"
#include "observe/saved_observable.hpp"

#include <fmt/format.h>

#include <vector>

namespace carom {

namespace {

class CollisionRate final : public SavedObservable<CollisionRate> {
 public:
  CollisionRate(const ObservableRequest& request, const ObservedRun& run)
      : SavedObservable(request, run), kinds_(run.species_count()) {
    by_species_ = kinds_ > 1 && run.collisions_known && !is_driven(run.scene.effects);
    if (!by_species_) return;
    counts_.assign(kinds_ * kinds_, 0.0);
    before_ = counts_;
    rates_.resize(kinds_ * kinds_);
  }

  [[nodiscard]] bool needs_positions() const override { return false; }
  [[nodiscard]] bool follows_collisions() const override { return by_species_; }

  void collisions(std::span<const PairCollision> collisions) override {
    for (const PairCollision& met : collisions) {
      if (!met.contact) continue;
      const std::size_t a = species(met.disk), b = species(met.partner);
      counts_[a * kinds_ + b] += 1.0;
      counts_[b * kinds_ + a] += 1.0;
    }
  }

  void sample(const State& state, const Totals& totals) override {
    const double dt = state.time - time_;
    if (dt > 0.0) {
      all_.add(2.0 * static_cast<double>(totals.pair - pairs_), dt);
      for (std::size_t k = 0; k < rates_.size(); ++k) rates_[k].add(counts_[k] - before_[k], dt);
    }
    before_ = counts_;
    pairs_ = totals.pair;
    time_ = state.time;
  }

  [[nodiscard]] Measurement finish(double, const Totals&) override {
    Measurement found{.name = name()};
    put(found, "rate", all_, run_.scene.disk_count());
    if (kinds_ > 1 && !by_species_)
      found.note = run_.collisions_known
                       ? fmt::format("there are no rates by species where {} acts", what_drives(run_.scene.effects))
                       : "there are no rates by species, since the run stored no collisions (--events)";
    for (std::size_t k = 0; k < rates_.size(); ++k) {
      put(found, "rate" + run_.suffix(k / kinds_) + run_.suffix(k % kinds_), rates_[k], run_.scene.species[k / kinds_].count);
    }
    return found;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(counts_, before_, pairs_, time_, all_, rates_);
  }

 private:
  [[nodiscard]] std::size_t species(std::int32_t disk) const {
    return static_cast<std::size_t>(run_.disks.species[static_cast<std::size_t>(disk)]);
  }
  void put(Measurement& found, std::string name, const Blocking& series, std::int64_t disks) const {
    Scalar scalar{.name = std::move(name), .unit = "1 / time"};
    if (disks > 0) series.fill(scalar, step_, 1.0 / static_cast<double>(disks));
    if (!scalar.value) {
      scalar.note = disks > 0 ? "nothing was measured" : "this species has no disks";
    } else if (*scalar.value == 0.0) {  // of which the error is not zero, but unknown
      scalar.error.reset();
      scalar.integrated_correlation_time.reset();
      scalar.note = "no such pair of disks has collided";
    }
    found.scalars.push_back(std::move(scalar));
  }

  std::size_t kinds_;
  bool by_species_;
  std::vector<double> counts_, before_;  ///< number of collisions of one disk of the first species with one of the second
  std::uint64_t pairs_ = 0;
  double time_ = 0.0;
  Blocking all_;
  std::vector<Blocking> rates_;
};

}  // namespace

MadeObservable make_collision_rate(const ObservableRequest& request, const ObservedRun& run) {
  return std::make_unique<CollisionRate>(request, run);
}

}  // namespace carom
