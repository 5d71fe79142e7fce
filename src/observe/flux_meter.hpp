#pragma once
// Adds up the fluxes of collisions, from the simulation's records or from the event log: to the same bits, however they are
// divided among calls.

#include "core/contact_scales.hpp"
#include "observe/collision_fluxes.hpp"
#include "observe/followers.hpp"

#include <carom/collisions.hpp>
#include <carom/scene.hpp>
#include <carom/state.hpp>

#include <limits>
#include <span>
#include <vector>

namespace carom {

class FluxMeter {
 public:
  /// Requires both to live as long as this.
  FluxMeter(const Scene& scene, const Disks& disks);

  /// Requires it to live as long as this, and to be where it is.
  void add(FluxFollower& follower);
  [[nodiscard]] bool has_followers() const { return !followers_.empty(); }

  /// Begins with the common velocity, relative to which the carried fluxes are counted.
  void start(const Eigen::Vector2d& common);
  /// Adds collisions that come after all before. Requires smooth disks, whose velocities determine where they touched.
  void follow(const CollisionRecords& collisions);

  template <class Archive>
  void serialize(Archive& archive) {
    archive(batch_.common, batch_.lane);
  }

 private:
  struct Together {  ///< sums of different kinds, for as many followers as it takes
    FluxSums sums;
    FluxKernel::Function* kernel = nullptr;
  };

  template <class TimeOf, class Add>
  void follow(std::size_t count, TimeOf time_of, Add add);
  void reach(double time);
  void add(std::span<const CollisionRecord> records);
  void put_contacts(const CollisionRecords& collisions, std::size_t begin, std::size_t count);
  void meet(std::size_t row, std::size_t disk, std::size_t partner);

  const Disks& disks_;
  ContactScales<double> scales_;
  bool smooth_;  ///< whether velocities determine where disks touched
  bool equal_;   ///< all disks are, and touch at one distance
  std::vector<FluxFollower*> followers_;
  double until_ = -std::numeric_limits<double>::infinity();  ///< that of all followers
  std::vector<Together> sums_;
  CollisionContacts contacts_{};
  FluxBatch batch_{};
};

}  // namespace carom
