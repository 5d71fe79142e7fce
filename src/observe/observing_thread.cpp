#include "observe/observing_thread.hpp"

#include "core/copy_past_caches.hpp"

#include <span>
#include <utility>

namespace carom {

namespace {

/// Handed over together: enough that waking a thread, some microseconds, is nothing beside them.
constexpr std::size_t most_together = 16'384;
/// That may wait; then the run waits. A megabyte of events or of notes, or a state, of which a large system keeps two at a
/// time.
std::size_t most_waiting(std::size_t disks) { return disks > 100'000 ? 1 : 4; }

}  // namespace

ObservingThread::ObservingThread(ObservableGroup& group)
    : group_(group), most_waiting_(most_waiting(group.run().disks.count())), thread_([this] { work(); }) {}

ObservingThread::~ObservingThread() {
  try {
    finish();
  } catch (...) {
    // nobody is left to hear of it
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

void ObservingThread::hear(const CollisionNotes& notes) {
  if (gathered_.noted + notes.notes.size() > most_together) hand_over();
  if (gathered_.notes.empty()) gathered_.notes.resize(most_together);
  CollisionNote* to = gathered_.notes.data() + gathered_.noted;
  copy_past_caches(notes.notes, to);
  gathered_.heard.push_back(notes);
  gathered_.heard.back().notes = {to, notes.notes.size()};
  gathered_.noted += notes.notes.size();
}

void ObservingThread::sample(const std::vector<Observable*>& observables, const State& state, const Totals& totals) {
  gathered_.observables = &observables;
  gathered_.state = state;
  gathered_.totals = totals;
  hand_over();
}

void ObservingThread::hand_over() {
  end_of_copies();
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return waiting_.size() < most_waiting_; });
  rethrow();
  waiting_.push_back(std::move(gathered_));
  gathered_ = {};
  if (!spare_.empty()) {
    gathered_ = std::move(spare_.back());
    spare_.pop_back();
  }
  lock.unlock();
  changed_.notify_all();
}

void ObservingThread::finish() {
  if (!gathered_.events.empty() || gathered_.noted > 0) hand_over();
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return waiting_.empty(); });
  rethrow();
}

/// After the first error nothing more is looked at.
void ObservingThread::work() {
  for (;;) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return ends_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    Work& first = waiting_.front();  // stays where it is: only this thread takes it away
    const bool goes_on = !thrown_;
    lock.unlock();
    std::exception_ptr thrown;
    try {
      if (goes_on && !first.events.empty()) group_.follow(first.events);
      if (goes_on)
        for (const CollisionNotes& notes : first.heard) group_.hear(notes);
      if (goes_on && first.observables != nullptr)
        for (Observable* observable : *first.observables) observable->sample(first.state, first.totals);
    } catch (...) {
      thrown = std::current_exception();
    }
    first.events.clear();
    first.heard.clear();
    first.noted = 0;
    first.observables = nullptr;
    lock.lock();
    if (thrown) thrown_ = thrown;
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
