#pragma once
// The future event list: the next event of every disk, and which of them comes first. A d-ary heap of Boost with
// handles, so that an event can be changed in place; nothing is ever left behind in the queue.
//
// Ties: events at the same time are ordered by the lower id of the disks they concern, then by the other id. A wall
// has a negative id, so a disk meets a wall before it meets a higher disk. The plans of two disks for one collision come in the
// order of the disks: else the shape of the heap, which is another after a resume, would say which of them is stale.

#include <boost/heap/d_ary_heap.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace carom {

template <class Real>
struct QueuedEvent {
  Real time;
  std::int32_t lower;   ///< lower id of the partners
  std::int32_t higher;  ///< higher id, or a negative code (a wall, a cell crossing)
  std::int32_t disk;    ///< whose plan it is

  [[nodiscard]] bool before(const QueuedEvent& other) const {
    if (time != other.time) return time < other.time;
    if (lower != other.lower) return lower < other.lower;
    if (higher != other.higher) return higher < other.higher;
    return disk < other.disk;
  }
};

template <class Real>
class EventQueue {
 public:
  /// Forgets everything and takes one event per disk; events[i].disk == i.
  void assign(const std::vector<QueuedEvent<Real>>& events) {
    heap_.clear();
    handles_.clear();
    heap_.reserve(events.size());
    handles_.reserve(events.size());
    for (const auto& event : events) handles_.push_back(heap_.push(event));
  }

  /// Replaces the event of event.disk. O(log N).
  void update(const QueuedEvent<Real>& event) { heap_.update(handles_[static_cast<std::size_t>(event.disk)], event); }

  [[nodiscard]] bool empty() const { return heap_.empty(); }
  [[nodiscard]] const QueuedEvent<Real>& next() const { return heap_.top(); }
  /// Boost keeps each event, with its place in the heap, in the node of a list, and the heap is of pointers to nodes.
  [[nodiscard]] std::size_t bytes() const {
    struct Node {
      void* neighbours[2];
      QueuedEvent<Real> event;
      std::size_t place;
    };
    return heap_.size() * (sizeof(Node) + sizeof(void*)) + handles_.capacity() * sizeof(handles_[0]);
  }

 private:
  struct Later {
    bool operator()(const QueuedEvent<Real>& a, const QueuedEvent<Real>& b) const { return b.before(a); }
  };
  using Heap =
      boost::heap::d_ary_heap<QueuedEvent<Real>, boost::heap::arity<4>, boost::heap::mutable_<true>, boost::heap::compare<Later>>;

  Heap heap_;
  std::vector<typename Heap::handle_type> handles_;
};

}  // namespace carom
