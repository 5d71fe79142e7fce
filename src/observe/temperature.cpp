// kT of all disks, of each axis and of each species, over time.

#include "observe/blocking.hpp"
#include "observe/followers.hpp"
#include "observe/mechanics.hpp"
#include "observe/observables.hpp"
#include "observe/saved_observable.hpp"

#include <array>
#include <vector>

namespace carom {

namespace {

class Temperature final : public SavedObservable<Temperature>, public ChangeFollower {
 public:
  Temperature(const ObservableRequest& request, const ObservedRun& run)
      : SavedObservable(request, run), acting_(*run.acting), species_(run.species_count() > 1 ? run.species_count() : 0) {}

  [[nodiscard]] bool needs_positions() const override { return run_.has_flow(); }

  void pass(const Change& /*change*/, const Effects& acting) override { acting_ = acting; }

  void sample(const State& state, const Totals&) override {
    const Box& box = run_.scene.box;
    const Eigen::Matrix2Xd v = velocities_in_flow(box, acting_, run_.disks, state);
    const std::array<bool, 2> is_thermal = {centre_of_mass_is_thermal(box, acting_, 0),
                                            centre_of_mass_is_thermal(box, acting_, 1)};
    const double mass = run_.disks.total_mass();
    Eigen::Vector2d sum = Eigen::Vector2d::Zero(), freedom = Eigen::Vector2d::Zero();
    std::vector<double> sums(species_.size()), freedoms(species_.size());
    for (std::size_t i = 0; i < run_.disks.count(); ++i) {
      const double m = run_.disks.mass[i];
      const Eigen::Vector2d squares = m * v.col(static_cast<Eigen::Index>(i)).cwiseAbs2();
      Eigen::Vector2d share;  // what the common motion leaves a disk of its degrees of freedom
      for (int axis = 0; axis < 2; ++axis) share[axis] = is_thermal[static_cast<std::size_t>(axis)] ? 1.0 : 1.0 - m / mass;
      sum += squares;
      freedom += share;
      if (species_.empty()) continue;
      sums[static_cast<std::size_t>(run_.disks.species[i])] += squares.sum();
      freedoms[static_cast<std::size_t>(run_.disks.species[i])] += share.sum();
    }
    all_.add(sum.sum(), freedom.sum());
    x_.add(sum.x(), freedom.x());
    y_.add(sum.y(), freedom.y());
    for (std::size_t s = 0; s < species_.size(); ++s) species_[s].add(sums[s], freedoms[s]);
  }

  [[nodiscard]] Measurement finish(double, const Totals&) override {
    const char* const none = "there is no degree of freedom, or no sample";
    Measurement found{.name = name()};
    put(found, {.name = "kT", .unit = "energy"}, all_, none);
    put(found, {.name = "kT_x", .unit = "energy"}, x_, none);
    put(found, {.name = "kT_y", .unit = "energy"}, y_, none);
    for (std::size_t s = 0; s < species_.size(); ++s)
      put(found, {.name = "kT" + run_.suffix(s), .unit = "energy"}, species_[s], none);
    return found;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(all_, x_, y_, species_);
  }

 private:
  Effects acting_;
  Blocking all_, x_, y_;
  std::vector<Blocking> species_;
};

}  // namespace

MadeObservable make_temperature(const ObservableRequest& request, const ObservedRun& run) {
  return std::make_unique<Temperature>(request, run);
}

}  // namespace carom
