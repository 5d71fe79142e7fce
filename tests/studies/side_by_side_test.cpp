// Two flights from one start, against two simulations run for nothing else.

#include "studies/compare/side_by_side.hpp"

#include "core/nearest_image.hpp"
#include "support/comparisons.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace carom::test {
namespace {

constexpr double dt = 0.02;

SideBySideOptions options_of(const std::string& method = "guarded", double until = 3.0) {
  return {.step = {method, dt}, .until = until, .free_time = 0.5};
}

/// Where turns bring a disk: one straight flight after the other from the start.
Eigen::Vector2d flown(const SideBySide& shown, Eigen::Index disk, double time) {
  Eigen::Vector2d place = shown.start.positions.col(disk), velocity = shown.start.velocities.col(disk);
  double since = 0.0;
  for (const Turn& turn : shown.turns) {
    const double when = turn.step * shown.step.dt;
    if (turn.disk != disk || when > time) continue;
    place += (when - since) * velocity;
    velocity = turn.velocity;
    since = when;
  }
  return place + (time - since) * velocity;
}

TEST(SideBySide, TurnsBringEveryDiskWhereTheMethodHasIt) {
  for (const Boundary boundary : {Boundary::periodic, Boundary::walls}) {
    const Scene scene = dozen_scene(boundary);
    const State start = make_simulation(scene).state();
    for (const std::string& method : fixed_step_names()) {
      SCOPED_TRACE(method);
      SideBySideOptions options = options_of(method);
      options.free_time = 1e6;  // to the end, however early they part
      const SideBySide shown = fly_side_by_side(scene, start, options);
      EXPECT_EQ(shown.until, 3.0);
      EXPECT_GT(shown.turns.size(), 20U);
      Simulation simulation = make_simulation(scene, start, FixedStep{method, dt});
      for (const double time : {0.0, 0.013, 0.5, 1.0, 1.237, 2.0, 2.999}) {  // at steps and between them
        // A method that turns or pushes disks within steps has no straight flight between them; the page shows that from step to
        // step.
        if ((method == "backtrack" || method == "swept" || method == "soft") && std::abs(std::remainder(time, dt)) > 1e-9)
          continue;
        simulation.run_until(time);
        const State state = simulation.state();
        for (Eigen::Index i = 0; i < 12; ++i)
          // 150 moves of one and some 100 flights of the other, each rounded at 5: 2e-16 * 5 * 250.
          EXPECT_LT(nearest_image(scene.box, flown(shown, i, time) - state.positions.col(i)).norm(), 3e-13) << i << ", " << time;
      }
    }
  }
}

TEST(SideBySide, TheExactSideIsTheLogOfTheEngine) {
  const Scene scene = dozen_scene(Boundary::walls);
  const State start = make_simulation(scene).state();
  const SideBySide shown = fly_side_by_side(scene, start, options_of("grid"));
  Simulation simulation = make_simulation(scene, start);
  simulation.record_events(true);
  simulation.run_until(shown.until);
  const std::vector<Event> events = simulation.take_events();
  EXPECT_EQ(shown.engine, simulation.engine());
  EXPECT_EQ(shown.start.positions, make_simulation(scene, start).state().positions);
  ASSERT_EQ(shown.events.size(), events.size());
  EXPECT_GT(events.size(), 20U);
  for (std::size_t k = 0; k < events.size(); ++k) {
    EXPECT_EQ(shown.events[k].time, events[k].time);
    EXPECT_EQ(shown.events[k].disk, events[k].disk);
    EXPECT_EQ(shown.events[k].partner, events[k].partner);
    EXPECT_EQ(shown.events[k].velocity, events[k].velocity);
    EXPECT_EQ(shown.events[k].partner_velocity, events[k].partner_velocity);
  }
}

TEST(SideBySide, DistancesAreThoseOfTwoRunsByHand) {
  const Scene scene = dozen_scene();
  const State start = make_simulation(scene).state();
  for (const char* const method : {"guarded", "naive"}) {
    SideBySideOptions options = options_of(method);
    options.sigma = 0.8;
    const SideBySide shown = fly_side_by_side(scene, start, options);
    Simulation exact = make_simulation(scene, start), stepped = make_simulation(scene, start, FixedStep{method, dt});
    ASSERT_GT(shown.times.size(), 10U);
    ASSERT_EQ(shown.distance.size(), shown.times.size());
    for (std::size_t k = 0; k < shown.times.size(); ++k) {
      EXPECT_EQ(shown.times[k], static_cast<double>(k) * dt);
      exact.run_until_sample(k, dt);
      stepped.run_until_sample(k, dt);
      const State a = exact.state(), b = stepped.state();
      double squares = 0.0;
      for (Eigen::Index i = 0; i < 12; ++i) {
        for (Eigen::Index axis = 0; axis < 2; ++axis) {
          double apart = a.positions(axis, i) - b.positions(axis, i);
          while (apart > 2.5) apart -= 5.0;
          while (apart < -2.5) apart += 5.0;
          squares += apart * apart;
        }
      }
      EXPECT_NEAR(shown.distance[k], std::sqrt(squares / 12.0) / 0.8, 2e-15);  // differences at 5 round by 4.4e-16 each
    }
    EXPECT_GT(*std::max_element(shown.distance.begin(), shown.distance.end()), 1e-2);
  }
}

TEST(SideBySide, OverlapsAreThoseOfTheMethodsStates) {
  const Scene scene = dozen_scene();
  const State start = make_simulation(scene).state();
  const SideBySide shown = fly_side_by_side(scene, start, options_of());
  EXPECT_GT(shown.overlaps.size(), 10U);
  Simulation simulation = make_simulation(scene, start, FixedStep{"guarded", dt});
  int seen = 0;
  for (double time = 0.003; time < shown.until; time += 0.007) {
    simulation.run_until(time);
    const State state = simulation.state();
    for (std::int32_t i = 0; i < 12; ++i) {
      for (std::int32_t j = i + 1; j < 12; ++j) {
        const double distance = nearest_image(scene.box, state.positions.col(i) - state.positions.col(j)).norm();
        double deepest = 0.0;
        int found = 0;
        for (const Overlap& one : shown.overlaps) {
          if (one.first != i || one.second != j || time < one.begin || time > one.end) continue;
          ++found;
          deepest = one.depth;
        }
        if (distance < 1.0 - 1e-8) {
          EXPECT_EQ(found, 1) << i << " and " << j << " at " << time;
        }
        if (distance > 1.0) {
          EXPECT_EQ(found, 0) << i << " and " << j << " at " << time;
        }
        if (found == 1) {
          EXPECT_GE(deepest, 1.0 - distance - 1e-12);
        }
        seen += found;
      }
    }
  }
  EXPECT_GT(seen, 10);
}

TEST(SideBySide, EndsAtTheEndOfTheRunAlsoBetweenTwoSteps) {
  const Scene scene = dozen_scene();
  const State start = make_simulation(scene).state();
  const SideBySide shown = fly_side_by_side(scene, start, options_of("guarded", 0.05));
  EXPECT_EQ(shown.because, ShownUntil::end);
  EXPECT_EQ(shown.until, 0.05);
  for (const Overlap& one : shown.overlaps) EXPECT_LE(one.end, 0.05);
  for (const Event& event : shown.events) EXPECT_LE(event.time, 0.05);
}

TEST(SideBySide, EndsWhenTheTwoHaveLostEachOtherForAsLongAgain) {
  const Scene scene = dozen_scene();
  const SideBySide shown = fly_side_by_side(scene, make_simulation(scene).state(), options_of("guarded", 1000.0));
  EXPECT_EQ(shown.because, ShownUntil::parted);
  ASSERT_TRUE(shown.parted_at());
  EXPECT_NEAR(shown.until, std::max(2.0 * *shown.parted_at(), 5.0), 1e-12);  // ten mean free times at the least
  SideBySideOptions patient = options_of("guarded", 1000.0);
  patient.free_time = 3.0;
  EXPECT_NEAR(fly_side_by_side(scene, make_simulation(scene).state(), patient).until, std::max(2.0 * *shown.parted_at(), 30.0),
              1e-12);
}

TEST(SideBySide, EndsWhereNoMoreFitsAndWhereItWouldTakeTooLong) {
  const Scene scene = dozen_scene();
  const State start = make_simulation(scene).state();
  SideBySideOptions options = options_of("guarded", 1000.0);
  options.limits.numbers = 300;
  const SideBySide crowded = fly_side_by_side(scene, start, options);
  EXPECT_EQ(crowded.because, ShownUntil::numbers);
  const std::size_t numbers = 6 * crowded.events.size() + 3 * crowded.turns.size() + 3 * crowded.overlaps.size();
  EXPECT_GT(numbers, 300U);
  EXPECT_LT(numbers, 300U + 2U * 12U * 12U);  // it ends with the step that goes beyond: a few events
  options.limits = {.work = (10'000.0 + 300.0 * 12.0) * 40.0};
  const SideBySide slow = fly_side_by_side(scene, start, options);
  EXPECT_EQ(slow.because, ShownUntil::work);
  EXPECT_NEAR(slow.until, 41 * dt, 1e-12);  // forty steps are not more than the limit
}

TEST(SideBySide, ThePlotHasAThousandPointsAtMostEvenlySpread) {
  const Scene scene = dozen_scene();
  SideBySideOptions options = options_of("guarded", 2.0);
  options.step.dt = 0.0005;
  options.free_time = 1.0;
  const SideBySide shown = fly_side_by_side(scene, make_simulation(scene).state(), options);
  EXPECT_LE(shown.times.size(), 1000U);
  EXPECT_GE(shown.times.size(), 500U);
  for (std::size_t k = 0; k < shown.times.size(); ++k)
    EXPECT_NEAR(shown.times[k], static_cast<double>(k) * shown.times[1], 1e-12);
}

TEST(SideBySide, StopsWhenItIsTold) {
  const Scene scene = dozen_scene();
  SideBySideOptions options = options_of();
  int asked = 0;
  options.proceed = [&](double) { return ++asked < 3; };
  EXPECT_EQ(fly_side_by_side(scene, make_simulation(scene).state(), options).because, ShownUntil::stopped);
  EXPECT_EQ(asked, 3);
}

TEST(SideBySide, TheStepThatShowsIsOneOfTheStudys) {
  State start;
  start.velocities = Eigen::Matrix2Xd::Ones(2, 5);  // v_T = 1
  ComparePlan plan;
  plan.sigma = 2.0;
  plan.mean_free_time = 10.0;
  plan.dts = {0.5, 0.05, 0.005};
  EXPECT_EQ(visible_step(plan, start), 0.05);  // 0.04 would be a fiftieth of a diameter
  plan.mean_free_time = 0.06;
  EXPECT_EQ(visible_step(plan, start), 0.005);  // a tenth of the free time is less
  plan.dts = {7.0};
  EXPECT_EQ(visible_step(plan, start), 7.0);
}

}  // namespace
}  // namespace carom::test
