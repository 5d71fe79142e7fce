#include "observe/observing_thread.hpp"

#include <algorithm>
#include <chrono>
#include <span>
#include <utility>

namespace carom {

namespace {

/// Events or records handed over together. What may wait of them, some 1.5 MB, stays in the second-level cache.
constexpr std::size_t most_together = 4'096;
/// The most pieces of work that may wait; then the run waits.
constexpr std::size_t most_waiting = 4;
/// Returns the number of states that may wait: states of large systems take much memory.
std::size_t most_states(std::size_t disks) { return disks > 100'000 ? 2 : 4; }
/// The time between two wake-ups of the thread. Waking it from the run would take the run some ten microseconds.
constexpr std::chrono::milliseconds nap{1};

}  // namespace

ObservingThread::ObservingThread(ObservableGroup& group) : group_(group), most_states_(most_states(group.run().disks.count())) {
  spare_.reserve(most_waiting + 2), spare_states_.reserve(most_states_ + 1);  // the thread itself asks for no memory
  thread_ = std::thread([this] { work(); });
}

ObservingThread::~ObservingThread() {
  try {
    finish();
  } catch (...) {
    // a destructor cannot report the error
  }
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void ObservingThread::follow(std::span<const Event> events) {
  gathered_.events.insert(gathered_.events.end(), events.begin(), events.end());
  if (gathered_.events.size() >= most_together) hand_over();
}

std::span<CollisionRecord> ObservingThread::room() {
  if (gathered_.recorded == most_together) hand_over();
  gathered_.records.resize(most_together);
  return std::span(gathered_.records).subspan(gathered_.recorded);
}

void ObservingThread::follow(const CollisionRecords& collisions) {
  for (std::span<const CollisionRecord> left = collisions.records; !left.empty();) {
    const std::span<CollisionRecord> to = room();
    const std::span<const CollisionRecord> part = left.first(std::min(left.size(), to.size()));
    if (part.data() != to.data()) std::ranges::copy(part, to.begin());
    gathered_.collisions.push_back(collisions);
    gathered_.collisions.back().records = to.first(part.size());
    gathered_.recorded += part.size();
    left = left.subspan(part.size());
  }
}

void ObservingThread::sample(const std::vector<Observable*>& observables, const State& state, const Totals& totals) {
  std::unique_ptr<State> copy;
  {
    std::unique_lock lock(mutex_);
    wait_until(lock, [this] { return states_waiting_ < most_states_; });
    if (!spare_states_.empty()) {
      copy = std::move(spare_states_.back());
      spare_states_.pop_back();
    }
  }
  if (!copy) copy = std::make_unique<State>();
  *copy = state;
  gathered_.state = std::move(copy);
  gathered_.observables = &observables;
  gathered_.totals = totals;
  hand_over();
}

void ObservingThread::hand_over() {
  std::unique_lock lock(mutex_);
  wait_until(lock, [this] { return waiting_.size() < most_waiting; });
  rethrow();
  const bool with_state = gathered_.state != nullptr;
  waiting_.push_back(std::move(gathered_));
  states_waiting_ += with_state ? 1U : 0U;
  gathered_ = {};
  if (!spare_.empty()) {
    gathered_ = std::move(spare_.back());
    spare_.pop_back();
  }
  if (2 * waiting_.size() > most_waiting) changed_.notify_all();  // else it has time to wake up by itself
}

void ObservingThread::finish() {
  if (!gathered_.events.empty() || gathered_.recorded > 0) hand_over();
  std::unique_lock lock(mutex_);
  wait_until(lock, [this] { return waiting_.empty(); });
  rethrow();
}

/// The other thread may be asleep, with work to do.
template <class Condition>
void ObservingThread::wait_until(std::unique_lock<std::mutex>& lock, Condition condition) {
  if (condition()) return;
  changed_.notify_all();
  changed_.wait(lock, condition);
}

/// After the first error no further work is done.
void ObservingThread::work() {
  for (;;) {
    std::unique_lock lock(mutex_);
    while (!ends_ && waiting_.empty()) changed_.wait_for(lock, nap);
    if (waiting_.empty()) return;
    Work& first = waiting_.front();  // stays where it is: only this thread takes it away
    const bool goes_on = !thrown_;
    lock.unlock();
    std::exception_ptr thrown;
    try {
      if (goes_on && !first.events.empty()) group_.follow(first.events);
      if (goes_on)
        for (const CollisionRecords& collisions : first.collisions) group_.follow(collisions);
      if (goes_on && first.state)
        for (Observable* observable : *first.observables) observable->sample(*first.state, first.totals);
    } catch (...) {
      thrown = std::current_exception();
    }
    first.events.clear();
    first.collisions.clear();
    first.recorded = 0;
    lock.lock();
    if (thrown) thrown_ = thrown;
    if (first.state) {
      --states_waiting_;
      spare_states_.push_back(std::move(first.state));
    }
    spare_.push_back(std::move(first));
    waiting_.pop_front();
    lock.unlock();
    changed_.notify_all();
  }
}

void ObservingThread::rethrow() {
  if (thrown_) std::rethrow_exception(thrown_);
}

}  // namespace carom
