// Dense starts without order: the disks are placed at random while they are small, then grown to their size as they move and
// collide (Lubachevsky & Stillinger 1990). Random placement alone ends at a packing fraction of 0.547.

#include "core/random.hpp"
#include "neighbours/disks_at_rest.hpp"
#include "scene/contact_scales.hpp"
#include "scene/fixed_shapes.hpp"
#include "scene/refusal.hpp"
#include "simulation/catalogue.hpp"
#include "simulation/placing_watch.hpp"
#include "simulation/start.hpp"

#include <fmt/format.h>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_real_distribution.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <variant>
#include <vector>

namespace carom {

namespace {

/// Packing fraction of the small disks. At this one try in two succeeds, and a gas is still one.
constexpr double placed_fraction = 0.3;

/// Tries for one disk, and the factor by which all are made smaller still where they fail: among many obstacles.
constexpr int random_tries = 10'000;
constexpr double shrinkage = 0.8;

/// How fast the mean diameter grows up to that packing fraction, in units of the thermal speed. The slower, the denser and the
/// more ordered disks become before they jam. With these 1000 equal disks pass 0.86, equal numbers of disks of radii 1 : 1.4 pass
/// 0.84, after 300 to 500 collisions of pairs per disk; at 0.1 all the way both jam at 0.83.
struct Stage {
  double until;
  double speed;
};
constexpr Stage stages[] = {{0.6, 0.3}, {0.75, 0.05}, {0.8, 0.02}, {1.0, 0.005}};

/// Disks that jam are grown again from the last stage that they passed easily, this much more slowly.
constexpr double slower_again = 8.0;
constexpr double passed_easily = 0.75;

/// P* at which disks count as jammed: the packing fraction then is within 2e-4 of where all motion ends.
constexpr double jammed_pressure = 1e4;

/// So many events, and so many per disk, in which no two disks meet while they grow: nothing but walls and obstacles holds them.
constexpr std::uint64_t wedged_after = 100'000, wedged_after_per_disk = 10'000;

/// Numbers in the stream of velocities that no disk's start uses.
constexpr std::uint64_t stirring = 1ull << 40;

class Growing {
 public:
  Growing(const Scene& scene, const Disks& disks, const PlacingHook& placing)
      : scene_(scene), disks_(disks), final_fraction_(scene.packing_fraction()), watch_(placing, [this] { return done_; }) {
    scene_.effects = Effects{};
    scene_.effects.obstacles = scene.effects.obstacles;
    scene_.effects.circle = scene.effects.circle;
    scene_.effects.non_additivity = scene.effects.non_additivity;
    scales_ = contact_scales<double>(scene.effects, disks);
    disks_.mass.assign(disks.count(), 1.0);  // equal masses share their energy soonest
    double squares = 0.0;
    for (const double radius : disks.radius) squares += 4.0 * radius * radius;
    diameter_ = std::sqrt(squares / static_cast<double>(disks.count()));
  }

  Eigen::Matrix2Xd run() {
    State state = small_disks();
    for (const double slower : {1.0, slower_again}) {
      whole_ = slower * time_to_grow(state.scale);
      if (grow(state, slower)) return state.positions;
    }
    refuse();
  }

 private:
  /// Returns the radii, over those in the end, at which disks of a stage have its packing fraction.
  [[nodiscard]] double scale_at(const Stage& stage) const { return std::sqrt(std::min(stage.until / final_fraction_, 1.0)); }

  /// Returns how long it takes the disks to grow from a scale to the end, where none of them jam.
  [[nodiscard]] double time_to_grow(double scale) const {
    double time = 0.0;
    for (const Stage& stage : stages) {
      time += std::max(scale_at(stage) - scale, 0.0) / stage.speed;
      scale = std::max(scale, scale_at(stage));
    }
    return time * diameter_;
  }

  /// True where all stages are passed. Where not, `state` is the one from which to try again.
  bool grow(State& state, double slower) {
    State now = state;
    for (const Stage& stage : stages) {
      if (now.scale >= scale_at(stage)) continue;
      if (!grow_through(now, stage, slower)) return false;
      if (stage.until <= passed_easily || stage.until >= final_fraction_) state = now;
    }
    return true;
  }

  bool grow_through(State& state, const Stage& stage, double slower) {
    const double rate = stage.speed / slower / diameter_;
    scene_.effects.growth = Growth{rate, std::min(stage.until, final_fraction_), jammed_pressure};
    const auto engine = detail::make_engine(detail::choose_engine(scene_, disks_, "auto"), scene_, disks_, state);
    const double to_grow = slower * time_to_grow(state.scale);
    constexpr auto no_limit = std::numeric_limits<std::uint64_t>::max();
    // A disk wedged between obstacles and walls, with no other disk to press on, would fly to and fro ever faster.
    const std::uint64_t stretch = wedged_after + wedged_after_per_disk * disks_.count();
    const auto goes_on = [&] { return !engine->ended() && !engine->is_stalled(); };
    for (std::uint64_t before = 0; goes_on(); before = engine->counts().pair) {
      for (std::uint64_t left = stretch; left > 0 && goes_on();) {  // in pieces by the clock, which must not show
        const std::uint64_t events = std::min(watch_.passes(), left);
        engine->run_until(forever, no_limit, events);
        left -= events;
        done_ = 1.0 - (to_grow - engine->now().high) / whole_;
        watch_.pass(events);
      }
      if (engine->counts().pair == before) break;
    }
    state = engine->state();
    state.time = 0.0;
    state.remainders.resize(2, 0);
    reached_ = std::max(reached_, state.scale * state.scale * final_fraction_);
    return state.scale >= scale_at(stage);
  }

  /// At random, without overlap, in places where they will still be clear of walls and obstacles when they are grown.
  State small_disks() {
    State state;
    state.scale = disks_.count() == 1 ? 1.0 : std::min(1.0, std::sqrt(placed_fraction / final_fraction_));
    std::optional<Eigen::Matrix2Xd> positions;
    for (; !(positions = placed(state.scale)); state.scale *= shrinkage) {
      if (state.scale < 1e-3)
        throw detail::scene_error(scene_, where, "there is no place for the disks among the obstacles; make either smaller");
    }
    state.positions = std::move(*positions);
    const Eigen::Index disks = state.positions.cols();
    state.images = Images::Zero(2, disks);
    state.velocities.resize(2, disks);
    for (Eigen::Index i = 0; i < disks; ++i) {
      RandomStream random(scene_.run.seed, Stream::velocities, stirring + static_cast<std::uint64_t>(i));
      boost::random::normal_distribution<double> component;
      state.velocities(0, i) = component(random);
      state.velocities(1, i) = component(random);
    }
    return state;
  }

  [[nodiscard]] std::optional<Eigen::Matrix2Xd> placed(double scale) {
    std::vector<double> radius = disks_.radius;
    for (double& r : radius) r *= scale;
    std::vector<std::size_t> order(radius.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return radius[i] > radius[j]; });
    DisksAtRest in_place(scene_.box, radius, scales_);
    Eigen::Matrix2Xd positions(2, static_cast<Eigen::Index>(radius.size()));
    for (const std::size_t i : order) {
      const std::optional<Eigen::Vector2d> position = room_for(i, in_place);
      if (!position) return std::nullopt;
      positions.col(static_cast<Eigen::Index>(i)) = *position;
      in_place.insert(static_cast<std::int32_t>(i), *position);
    }
    return positions;
  }

  [[nodiscard]] std::optional<Eigen::Vector2d> room_for(std::size_t i, const DisksAtRest& in_place) {
    RandomStream random(scene_.run.seed, Stream::positions, i);
    for (int tries = 0; tries < random_tries; ++tries) {
      watch_.pass();
      Eigen::Vector2d position;
      for (int a = 0; a < 2; ++a) {
        const double margin = scene_.box.periodic(a) ? 0.0 : disks_.radius[i];
        const double from = scene_.box.lower[a] + margin;
        const double to = scene_.box.upper[a] - margin;
        position[a] = from < to ? boost::random::uniform_real_distribution<double>(from, to)(random) : 0.5 * (from + to);
      }
      if (in_place.overlaps(position, static_cast<std::int32_t>(i))) continue;
      if (!overlapped_shape(scene_.box, scene_.effects, position, disks_.radius[i], 0.0)) return position;
    }
    return std::nullopt;
  }

  [[noreturn]] void refuse() const {
    const auto [least, most] = std::minmax_element(disks_.radius.begin(), disks_.radius.end());
    const bool one_size = *least == *most;  // a lattice takes the largest
    throw detail::scene_error(scene_, where,
                              fmt::format("the disks jam at a packing fraction of {:.4f} on their way to {:.6g}; ask for less{}",
                                          reached_, final_fraction_, one_size ? ", or for positions = \"hexagonal\"" : ""));
  }

  static constexpr const char* where = "disks.0.positions";

  Scene scene_;  ///< nothing but its disks, its box and its obstacles
  Disks disks_;
  ContactScales<double> scales_;
  double final_fraction_;
  double diameter_ = 1.0;  ///< root mean square
  double reached_ = 0.0;
  double whole_ = 0.0;  ///< the time that growing takes, this time
  double done_ = 0.0;   ///< the share of it that has passed
  detail::PlacingWatch watch_;
};

}  // namespace

Eigen::Matrix2Xd grown_positions(const Scene& scene, const Disks& disks, const PlacingHook& placing) {
  return Growing(scene, disks, placing).run();
}

}  // namespace carom
