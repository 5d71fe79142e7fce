#pragma once
// What the engine tells of its events: the log, and the notes of collisions for a listener.

#include "engine/engine.hpp"

namespace carom {

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::find_room_for_notes() {
  hand_over_notes();
  if (listener_.room) room_ = listener_.room();
  if (room_.empty()) room_ = notes_;
}

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::read_notes(std::span<const CollisionNote> notes) {
  if (recording_) log(notes);
  if (listener_) listener_.hear(epoch_, notes);  // whose notes they are from then on
}

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::log(std::span<const CollisionNote> notes) {
  for (const CollisionNote& note : notes) {
    const std::int32_t a = id(note.place), b = id(note.partner);
    const bool swapped = b < a;  // the lower id comes first
    const Instant when = instant(note.time);
    const Vec2<double> fallen = world_.g() * note.time;
    const double(&v)[2] = swapped ? note.partner_after : note.after;
    const double(&w)[2] = swapped ? note.after : note.partner_after;
    log_.push_back({when.high, when.low, swapped ? b : a, swapped ? a : b, Vec2<double>(v[0], v[1]) + fallen,
                    Vec2<double>(w[0], w[1]) + fallen});
  }
}

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::log_hit(std::int32_t i, std::int32_t what, const Vec2<double>& v) {
  hand_over_notes();
  const Instant when = now();
  log_.push_back({when.high, when.low, id(i), what, v, {0.0, 0.0}});
}

}  // namespace carom
