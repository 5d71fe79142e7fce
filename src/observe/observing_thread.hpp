#pragma once
// Observables at work on a thread of their own, behind the run that feeds them: events and states are copied, collision records
// are written where they will be read, and all are handed over and processed in the order in which they came, so that results are
// the same to the last bit.

#include "observe/observable_group.hpp"

#include <carom/simulation.hpp>

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

namespace carom {

class ObservingThread {
 public:
  /// Requires that `group` outlives this object, and that nothing else uses it between two calls of finish().
  explicit ObservingThread(ObservableGroup& group);
  /// Does what was handed over, and forgets what an observable threw.
  ~ObservingThread();
  ObservingThread(const ObservingThread&) = delete;
  ObservingThread& operator=(const ObservingThread&) = delete;

  void follow(std::span<const Event> events);
  /// Returns memory for the next collision records; records written elsewhere are copied.
  [[nodiscard]] std::span<CollisionRecord> room();
  void follow(const CollisionRecords& collisions);
  void sample(const std::vector<Observable*>& observables, const State& state, const Totals& totals);
  /// Waits until all is done. Throws what an observable threw, as the functions above do.
  void finish();

 private:
  /// Events or records that came one after the other, and then perhaps a state; its memory is used again.
  struct Work {
    std::vector<Event> events;
    std::vector<CollisionRecord> records;  ///< the first `recorded` of them
    std::size_t recorded = 0;
    std::vector<CollisionRecords> collisions;               ///< parts of `records`
    const std::vector<Observable*>* observables = nullptr;  ///< of the state
    std::unique_ptr<State> state;                           ///< null where there is none
    Totals totals;
  };

  void hand_over();
  template <class Condition>
  void wait_until(std::unique_lock<std::mutex>& lock, Condition condition);
  void work();
  void rethrow();

  ObservableGroup& group_;
  const std::size_t most_states_;  ///< that are handed over and not yet processed
  Work gathered_;                  ///< of the run's thread, not handed over yet
  std::mutex mutex_;               ///< of all below
  std::condition_variable changed_;
  std::deque<Work> waiting_;  ///< the first of them in work
  std::vector<Work> spare_;
  std::size_t states_waiting_ = 0;
  std::vector<std::unique_ptr<State>> spare_states_;
  std::exception_ptr thrown_;
  bool ends_ = false;
  std::thread thread_;  // last: it needs all the others
};

}  // namespace carom
