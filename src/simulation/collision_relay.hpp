#pragma once
// Hands the engine's records of collisions on to the hooks of a schedule.

#include "core/instant.hpp"
#include "engine/collision_listener.hpp"
#include "simulation/any_engine.hpp"

#include <carom/collisions.hpp>
#include <carom/simulation.hpp>

#include <exception>
#include <memory>
#include <span>
#include <utility>

namespace carom::detail {

/// Calls RunHooks::collisions and room_for_records. The engine is in the middle of an event then, so that what they throw has to
/// wait for hand_over().
class CollisionRelay {
 public:
  explicit CollisionRelay(const RunHooks& hooks) : hooks_(hooks) {}
  CollisionRelay(const CollisionRelay&) = delete;
  CollisionRelay& operator=(const CollisionRelay&) = delete;

  /// Listens to an engine that moves these disks, as long as this object lives or until the engine listens to something else.
  void listen_to(AnyEngine& engine, std::shared_ptr<const DiskTable> disks) {
    CollisionListener listener;
    listener.on_collisions = [this, taken = CollisionRecords{std::move(disks), 0.0, 0.0, {}}](
                                 const Instant& epoch, std::span<const CollisionRecord> records) mutable {
      taken.epoch = epoch.high;
      taken.epoch_remainder = epoch.low;
      taken.records = records;
      keep_thrown([&] { hooks_.collisions(taken); });
    };
    if (hooks_.room_for_records)
      listener.room = [this] {
        std::span<CollisionRecord> room;
        keep_thrown([&] { room = hooks_.room_for_records(); });
        return room;
      };
    engine.listen(std::move(listener));
  }

  /// Has the engine hand over what it still holds. Throws what a hook has thrown since the last call.
  void hand_over(AnyEngine& engine) {
    engine.hand_over_records();
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  template <class Call>
  void keep_thrown(Call&& call) {
    try {
      if (!thrown_) call();
    } catch (...) {
      thrown_ = std::current_exception();
    }
  }

  const RunHooks& hooks_;
  std::exception_ptr thrown_;
};

}  // namespace carom::detail
