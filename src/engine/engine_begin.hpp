#pragma once
// The start of an engine: the scenes that it can run, the order of disks in memory, first neighbourhoods, lists and predictions.

#include "engine/event_loop.hpp"
#include "engine/order_in_space.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace carom {

namespace detail {

template <class Line>
const PredictionKernel<Line>& kernel_for(const Effects& effects) {
  const bool falling = !effects.acceleration().isZero(0.0);
  if (effects.growth && effects.growth->rate > 0.0) return prediction_kernel<Line>(PredictionKind::growing);
  if (!effects.potential_steps().empty())
    return prediction_kernel<Line>(falling ? PredictionKind::falling_steps : PredictionKind::steps);
  if (effects.shear_rate() != 0.0) return prediction_kernel<Line>(PredictionKind::sheared);
  return prediction_kernel<Line>(falling ? PredictionKind::falling : PredictionKind::hard);
}

}  // namespace detail

template <class Impact, class Layout, class World>
std::string LoopState<Impact, Layout, World>::why_not(const Box& box, const Disks& disks, const Effects& effects) {
  const std::vector<std::string> acting = effects.acting();
  if ((Impact::plain || World::plain) && !acting.empty()) return fmt::format("the scene asks for {}", fmt::join(acting, ", "));
  if (disks.count() == 0) return "";
  const double smallest = *std::min_element(disks.radius.begin(), disks.radius.end());
  const double reach = largest_contact_distance(disks, effects) * largest_scale(box, disks, effects);
  for (int k = 0; k < 2; ++k) {
    const FixedAxis axis = fixed_axis(box, k, disks.count());
    if (axis.periodic && axis.upper - axis.lower < 2.5 * reach)
      return fmt::format(
          "the periodic box is too small: {:.4g} in {}, less than 2.5 times {:.4g}, the farthest at which disks "
          "act on each other",
          axis.upper - axis.lower, k == 0 ? "x" : "y", reach);
    if (axis.unit * 0x1p32 > 1e-3 * smallest)
      return fmt::format("the box is too large for a disk of radius {:.4g}: {:.4g} in {}", smallest, axis.upper - axis.lower,
                         k == 0 ? "x" : "y");
  }
  return Layout::covers(disks) ? "" : "disks differ in radius or mass";
}

template <class Impact, class Layout, class World>
LoopState<Impact, Layout, World>::LoopState(const Box& box, const Disks& disks, State start, const Effects& effects,
                                            std::uint64_t seed)
    : layout_(disks, effects),
      impact_(effects, disks.count()),
      world_(box, effects, start, seed),
      flight_(box, disks.count(), world_),
      boundaries_(box, flight_, world_),
      frame_{{flight_.axis(0).unit, flight_.axis(1).unit},
             {flight_.axis(0).steps, flight_.axis(1).steps},
             disks.count() > 0 ? 2.0 * disks.radius[0] : 0.0,
             0.0,
             0.0},
      kernel_(detail::kernel_for<Line>(effects)),
      lines_(disks.count()),
      plans_(disks.count(), ids_),
      lists_(flight_.axis(0), flight_.axis(1), {}),
      sizes_(box, disks, effects),
      stall_(effects, disks.count()),
      common_motion_(box, effects),
      recorder_(ids_, world_.g()) {
  bool has_potential = false;
  if constexpr (!Impact::plain) has_potential = impact_.potential().present();
  flight_.make_room(start.positions, has_potential);
  for (int k = 0; k < 2; ++k) frame_.unit[k] = flight_.axis(k).unit, frame_.steps[k] = flight_.axis(k).steps;
  detail::OrderInSpace order = detail::order_in_space(flight_.axis(0), flight_.axis(1), start);
  ids_ = std::move(order.ids);
  sizes_.radius = detail::in_order(disks.radius, ids_);
  for (std::int32_t i = 0; i < count(); ++i) {
    Line& a = line(i);
    layout_.store_properties(a, disks, static_cast<std::size_t>(id(i)));
    flight_.begin(i, a, start, id(i), layout_.radius(a) * world_.scale(0.0));
  }

  sizes_.area = order.area;
  if constexpr (!Impact::plain) {
    point_at_potential();
    for (std::int32_t i = 0; i < count() && impact_.spinning(); ++i)
      if (start.spins.size() > id(i)) impact_.spin(i) = start.spins[id(i)];
  }
  if constexpr (requires { layout_.describe(frame_); }) layout_.describe(frame_);
  frame_.scale = world_.scale(0.0);
  frame_.expansion = world_.expansion();
  make_lists();
  if constexpr (!World::plain)
    if (world_.sheared()) update_shear();
  if (World::plain) sizes_.radius = std::vector<double>();  // nothing will ask for them again; {} alone would keep the memory
  start = State{};                                          // makes room for what follows
  double half_width = std::min(sizes_.suitable_half_width(), sizes_.widest_neighbourhood);
  for (rebuild(half_width); lists_.median_count() > 11 && half_width > 0.1 * sizes_.mean_diameter; rebuild(half_width))
    half_width *= 0.7;
  find_steps();
  if (common_motion_.present()) common_motion_.begin(lines_, [this](const Line& a) { return layout_.momentum(a); });
  choose_epoch_length();
}

template <class Impact, class Layout, class World>
EventLoop<Impact, Layout, World>::EventLoop(const Box& box, const Disks& disks, State start, const Effects& effects,
                                            std::uint64_t seed)
    : Parts(box, disks, std::move(start), effects, seed) {
  predict_all();
  begin_epoch(0.0);
  prefetcher_.suit(this->bytes());
}

template <class Impact, class Layout, class World>
LoopState<Impact, Layout, World>::LoopState(const LoopState& whole, std::size_t slots)
    : layout_(whole.layout_),
      impact_(whole.impact_.with_slots(slots)),
      world_(whole.world_),
      flight_(whole.flight_, slots, world_),
      boundaries_(whole.boundaries_, flight_, world_),
      frame_(whole.frame_),
      kernel_(whole.kernel_),
      lines_(slots),
      ids_(slots, -1),
      plans_(slots, ids_),
      lists_(whole.lists_, slots),
      part_(true),
      epoch_(whole.epoch_),
      now_(whole.now_),
      epoch_length_(whole.epoch_length_),
      stamp_(whole.stamp_),
      mean_speed_(whole.mean_speed_),
      limits_(whole.limits_),
      sizes_(whole.sizes_),
      pacing_(whole.pacing_),
      stall_(whole.stall_),
      common_motion_(whole.common_motion_),
      recorder_(ids_, world_.g()) {}

template <class Impact, class Layout, class World>
std::size_t LoopState<Impact, Layout, World>::bytes() const {
  return lines_.capacity() * sizeof(Line) + plans_.bytes() + ids_.capacity() * sizeof(std::int32_t) + flight_.bytes() +
         lists_.bytes() + queue_.bytes() + impact_.bytes() + world_.bytes() + sizes_.radius.capacity() * sizeof(double);
}

template <class Impact, class Layout, class World>
void LoopState<Impact, Layout, World>::find_steps() {
  if constexpr (!Impact::plain) {
    auto& potential = impact_.potential();
    for (std::int32_t i = 0; i < count() && potential.present(); ++i)
      for (std::uint32_t n = 0; n < lists_.count(i); ++n) {
        const std::int32_t j = lists_.ids(i)[n];
        const Line &a = line(i), &b = line(j);
        const double sigma = layout_.contact_distance(a, b);
        const std::int32_t step = i < j ? potential.step_at(flight_.separation(a, b, now_), sigma) : potential.outside();
        if (step != potential.outside()) potential.move(i, j, step);
      }
  }
}

}  // namespace carom
