#pragma once
// The archive of an engine, for checkpoints (core/archive.hpp): all that decides how it goes on. What the scene says by itself is
// not part of it: an engine is made for the scene first, with any start, and then read into.

#include "engine/event_loop.hpp"

namespace carom {

/// Archives a frame without its pointers, which are those of the engine that reads.
template <class Archive>
void serialize(Archive& archive, PredictionFrame& frame) {
  archive(frame.unit, frame.steps, frame.sigma, frame.half_width, frame.edge_step, frame.scale, frame.expansion, frame.well);
  archive(frame.sliding.displacement, frame.sliding.speed, frame.sliding.inner);
}

template <class Impact, class Layout, class World>
template <class Archive>
void EventLoop<Impact, Layout, World>::serialize(Archive& archive) {
  archive(flight_, frame_, impact_, world_);
  archive(lines_, plans_, ids_, sizes_, lists_, queue_);
  archive(epoch_, now_, epoch_length_, stamp_, stall_, common_motion_, last_collision_, totals_);
  archive(mean_speed_, limits_, boundaries_, tuning_, pacing_);
  if constexpr (Archive::is_loading::value) {
    recorder_.begin_epoch(epoch_);
    if constexpr (!Impact::plain)
      if (impact_.wells().present()) frame_.inside = impact_.wells().table();
    frame_.sliding.heights = flight_.heights();
  }
}

}  // namespace carom
