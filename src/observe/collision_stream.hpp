#pragma once
// Collision records from the event log. The log holds the velocities after a collision; those before it come from a copy of every
// disk's motion that is kept here, exact straight flight (or a parabola) from event to event.
//
// The impulse of smooth disks is along the line of centres, so their velocities determine where they touched. Only where that
// does not hold (reversal, rough disks, stepped potentials) positions are followed too, and records come with their contacts.

#include "core/contact_scales.hpp"
#include "observe/observed_run.hpp"

#include <carom/changes.hpp>
#include <carom/observe.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace carom {

class CollisionStream {
 public:
  /// Requires that nothing but logged events and changes of the scene changes velocities: is_driven() is false.
  explicit CollisionStream(const ObservedRun& run);

  /// Follows where disks are from now on, beside what separations need. Requires that start() has not been called.
  void follow_places() { places_wanted_ = moves_between_ = true; }

  void start(const State& state);
  /// Returns the records of the collisions of pairs among `events`; slots are ids. They are valid until the next call. Requires
  /// events in order, none left out.
  [[nodiscard]] CollisionRecords follow(std::span<const Event> events);
  /// Makes a change of the scene, after which `acting` act. Requires that all events before it have been followed, and none
  /// after.
  void change(const Change& change, const Effects& acting);

  template <class Archive>
  void serialize(Archive& archive) {
    archive(velocity_, position_, since_);
  }

 private:
  void take(const Effects& acting);
  void meet(const Event& event);
  void move(std::int32_t disk, double time);
  [[nodiscard]] PairContact contact(std::int32_t disk, std::int32_t partner) const;
  [[nodiscard]] std::array<double, 2> place(std::int32_t disk) const;

  std::vector<double> radius_;
  ContactScales<double> scales_;
  Box box_;
  Eigen::Vector2d acceleration_ = Eigen::Vector2d::Zero();
  double edge_ = 0.0;   ///< distances above this many contact distances are edges of the potential; 0 without one
  bool smooth_;         ///< impulses are along the line of centres, all through the run
  bool moves_between_;  ///< positions or times of the last event are needed
  std::vector<Eigen::Vector2d> velocity_;
  std::vector<Eigen::Vector2d> position_;  ///< at since_
  std::vector<double> since_;              ///< the last event of each disk
  std::shared_ptr<const DiskTable> table_;
  std::vector<CollisionRecord> records_;
  std::vector<PairContact> contacts_;
  bool places_wanted_ = false;
  std::vector<std::array<double, 2>> places_;
};

}  // namespace carom
