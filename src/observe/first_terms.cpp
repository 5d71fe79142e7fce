#include "observe/first_terms.hpp"

#include "observe/effects_report.hpp"
#include "scene/walls.hpp"

namespace carom {

const State& FirstTerms::operator()(const State& state) {
  const Scene& first = simulation_.whole_scene();
  const Box& now = simulation_.scene().box;
  const double grown = growth_before_changes(first, simulation_.disks());
  const bool settled = have_settled(state, first.box, now);
  if (grown == 1.0 && !settled) return state;
  said_ = state;
  said_.scale *= grown;
  if (settled) said_.walls = walls_at_rest(now);
  return said_;
}

}  // namespace carom
