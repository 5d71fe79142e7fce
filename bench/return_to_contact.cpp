// What does a fixed step cost that goes back to the moment of contact? Each step moves all disks by v dt; a pair that it finds
// overlapping is taken back to the moment at which the two touched, collides there, and flies on to the end of the step, in the
// order of those moments. Measured against the exact engine in the same run, from the same starts.
//
//   return_to_contact SCENE COLLISIONS_PER_DISK [STEP ...]
//
// SCENE: a periodic box, equal disks, rule "specular". Trajectories are compared with one of 113 bits after COLLISIONS_PER_DISK.
// STEP: in mean free times; 0.5 to 0.01 unless named. Eight starts: the scene's seed and the seven after it. A step that is not
// right to rounding has no price of its trajectory, and one whose Z is off by more than three standard errors none of its
// pressure.

#include "core/vec2.hpp"
#include "effects/impact.hpp"
#include "effects/specular.hpp"
#include "stepper/bodies.hpp"
#include "studies/compare/reference.hpp"
#include "studies/horizon/method.hpp"

#include <fmt/format.h>
#include <carom/carom.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace carom;

constexpr std::uint64_t starts = 8;
constexpr double right = 1e-12;              ///< diameters: errors below this are rounding
constexpr double collisions_for_Z = 4000.0;  ///< per disk

/// The fixed-step method that returns to the moment of contact.
class Backtrack {
 public:
  Backtrack(const Box& box, const Disks& disks, const State& start, double dt)
      : bodies_(box, disks, start),
        dt_(dt),
        sigma_squared_(4.0 * disks.radius[0] * disks.radius[0]),
        since_(disks.count()),
        turns_(disks.count()),
        neighbours_(disks.count()) {
    list(fastest() * dt_);
  }

  void step() {
    for (std::size_t i = 0; i < bodies_.count(); ++i) bodies_.move(i, bodies_.v[i], dt_);
    std::fill(since_.begin(), since_.end(), -dt_);
    // Two disks come nearer by at most twice the way of the fastest, and once more by the way that a disk flies anew.
    const double way = fastest() * dt_;
    margin_ -= 2.0 * way;
    if (margin_ < 4.0 * way) list(way);
    for (std::uint32_t i = 0; i < bodies_.count(); ++i)
      for (const std::uint32_t j : neighbours_[i])
        if (i < j) look(i, j);
    while (!meetings_.empty()) {
      const Meeting next = meetings_.front();
      std::pop_heap(meetings_.begin(), meetings_.end(), later);
      meetings_.pop_back();
      if (next.turns_i == turns_[next.i] && next.turns_j == turns_[next.j]) collide_at(next);
    }
  }

  [[nodiscard]] double virial() const { return virial_; }
  [[nodiscard]] State state() const {
    State state;
    const auto disks = static_cast<Eigen::Index>(bodies_.count());
    state.positions.resize(2, disks);
    for (Eigen::Index i = 0; i < disks; ++i) state.positions.col(i) = bodies_.r[static_cast<std::size_t>(i)];
    return state;
  }

 private:
  struct Meeting {
    double time;  ///< from the end of the step, <= 0
    std::uint32_t i, j;
    std::uint32_t turns_i, turns_j;  ///< of the disks when this was found: it is void if one of them has collided since
  };
  static bool later(const Meeting& a, const Meeting& b) { return a.time > b.time; }

  [[nodiscard]] double fastest() const {
    double squared = 0.0;
    for (const Vec2<double>& v : bodies_.v) squared = std::max(squared, v.squaredNorm());
    return std::sqrt(squared);
  }

  /// A pair that overlaps at the end of the step met in it, at the first root of |r + v t| = sigma.
  void look(std::uint32_t i, std::uint32_t j) {
    const double gap = bodies_.squared_distance(bodies_.r[i], bodies_.r[j]) - sigma_squared_;
    if (gap >= 0.0) return;
    const Vec2<double> r = bodies_.separation(bodies_.r[i], bodies_.r[j]), v = bodies_.v[i] - bodies_.v[j];
    const double b = r.dot(v), speed_squared = v.squaredNorm(), root = std::sqrt(b * b - speed_squared * gap);
    double time = b > 0.0 ? -(b + root) / speed_squared : gap / (root - b);
    const double begin = std::max(since_[i], since_[j]);
    if (!(time >= begin)) {
      if (!(b + speed_squared * begin < 0.0)) return;  // they part already
      time = begin;
    }
    meetings_.push_back({time, i, j, turns_[i], turns_[j]});
    std::push_heap(meetings_.begin(), meetings_.end(), later);
  }

  void collide_at(const Meeting& m) {
    for (const std::uint32_t k : {m.i, m.j}) bodies_.move(k, bodies_.v[k], m.time);
    const Vec2<double> r = bodies_.separation(bodies_.r[m.i], bodies_.r[m.j]);
    virial_ += collide<Specular, double>(r, bodies_.mass[m.i], bodies_.v[m.i], bodies_.mass[m.j], bodies_.v[m.j]).virial;
    for (const std::uint32_t k : {m.i, m.j}) {
      bodies_.move(k, bodies_.v[k], -m.time);
      since_[k] = m.time;
      ++turns_[k];
    }
    for (const std::uint32_t k : {m.i, m.j})
      for (const std::uint32_t other : neighbours_[k])
        if (other != m.i && other != m.j) look(k, other);
  }

  /// Lists all pairs nearer than the margin, from cells at least that wide.
  void list(double way) {
    const double sigma = std::sqrt(sigma_squared_);
    margin_ = 0.3 * sigma + 8.0 * way;
    const double reach = sigma + margin_;
    const auto cells = [&](int axis) { return std::max(1, static_cast<int>(bodies_.domain.length[axis] / reach)); };
    const int columns = cells(0), rows = cells(1);
    std::vector<std::vector<std::uint32_t>> cell(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    const auto place = [&](std::uint32_t i, int axis, int count) {
      const double along = (bodies_.r[i][axis] - bodies_.domain.lower[axis]) / bodies_.domain.length[axis];
      return std::min(count - 1, static_cast<int>(along * count));
    };
    const auto at = [&](int column, int row) -> std::vector<std::uint32_t>& {
      return cell[static_cast<std::size_t>((row + rows) % rows) * static_cast<std::size_t>(columns) +
                  static_cast<std::size_t>((column + columns) % columns)];
    };
    for (std::uint32_t i = 0; i < bodies_.count(); ++i) at(place(i, 0, columns), place(i, 1, rows)).push_back(i);
    for (std::uint32_t i = 0; i < bodies_.count(); ++i) {
      neighbours_[i].clear();
      const int column = place(i, 0, columns), row = place(i, 1, rows);
      const int wide = std::min(columns, 3), high = std::min(rows, 3);  // with fewer than three cells each once
      for (int a = 0; a < wide; ++a)
        for (int b = 0; b < high; ++b)
          for (const std::uint32_t j : at(column + a - wide / 2, row + b - high / 2))
            if (j != i && bodies_.squared_distance(bodies_.r[i], bodies_.r[j]) < reach * reach) neighbours_[i].push_back(j);
    }
  }

  Bodies bodies_;
  double dt_;
  double sigma_squared_;
  std::vector<double> since_;         ///< the moment of a disk's last collision in this step, or its begin
  std::vector<std::uint32_t> turns_;  ///< collisions of each disk
  std::vector<std::vector<std::uint32_t>> neighbours_;
  double margin_ = 0.0;            ///< pairs with a gap below this are listed
  std::vector<Meeting> meetings_;  ///< a heap, the earliest first
  double virial_ = 0.0;
};

struct Spread {
  double least, median, most;
};

Spread spread(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {values.front(), 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]), values.back()};
}

/// Mean and standard error over the starts.
std::pair<double, double> mean_of(const std::vector<double>& values) {
  double sum = 0.0, squares = 0.0;
  const auto n = static_cast<double>(values.size());
  for (const double value : values) sum += value;
  for (const double value : values) squares += (value - sum / n) * (value - sum / n);
  return {sum / n, std::sqrt(squares / (n * (n - 1.0)))};
}

/// Least processor time of `run` over turns that take 50 ms together, since what disturbs only adds.
template <class Run>
double least_seconds(Run run) {
  double least = std::numeric_limits<double>::infinity();
  for (double spent = 0.0; spent < 0.05;) {
    const double seconds = run();
    least = std::min(least, seconds);
    spent += seconds;
  }
  return least;
}

/// One of the eight starts, and what the exact engine makes of it.
struct Start {
  State state;
  Reference reference;
  double exact_seconds;
};

void study(const Scene& scene, double collisions_per_disk, const std::vector<double>& steps) {
  Simulation gas = make_simulation(scene);
  const Disks& disks = gas.disks();
  const auto count = static_cast<double>(disks.count());
  const bool equal = std::all_of(disks.radius.begin(), disks.radius.end(), [&](double r) { return r == disks.radius[0]; });
  const bool walled = !scene.box.periodic(0) || !scene.box.periodic(1);
  if (names_of(scene.effects, walled) != std::vector<std::string>{"specular"} || !equal)
    throw std::invalid_argument(
        "the scene must have a periodic box, disks of one radius, the rule \"specular\" and no other effect");

  gas.run_until(1e300, {.collisions = static_cast<std::uint64_t>(100.0 * count)});
  const double began = gas.time();
  gas.run_until(1e300, {.collisions = static_cast<std::uint64_t>(600.0 * count)});
  const double free_time = (gas.time() - began) * count / (2.0 * 500.0 * count);
  const double end = collisions_per_disk * free_time, long_end = collisions_for_Z * free_time;

  std::vector<Start> from;
  std::vector<double> exact_virial;
  double exact_long_seconds = 0.0;
  for (std::uint64_t k = 0; k < starts; ++k) {
    Scene seeded = scene;
    seeded.run.seed = scene.run.seed + k;
    Simulation equilibrating = make_simulation(seeded);
    equilibrating.run_until(1e300, {.collisions = static_cast<std::uint64_t>(50.0 * count)});
    equilibrating.run_until(equilibrating.time() + 0.1 * free_time / count);  // clear of contact
    const State state = equilibrating.state();
    from.push_back({state, Reference(scene, state, end, 1, [] { return true; }),
                    seconds_in_loop(scene, state, {"auto", 0.0}, {end}).back()});
    Simulation longer = make_simulation(scene, state);
    const double before = thread_seconds();
    longer.run_until(long_end);
    exact_long_seconds += thread_seconds() - before;
    exact_virial.push_back(longer.totals().virial);
  }
  fmt::print("{}: {} disks, compared after {} collisions per disk; {} starts, engine {}\n", scene.title, disks.count(),
             collisions_per_disk, starts, gas.engine());
  fmt::print("{:>12}  {:>24}  {:>6}  {:>24}  {:>20}  {:>9}\n", "step (mft)", "error (diameters), worst", "right",
             "time / exact (least, most)", "bias of Z - 1 (%)", "time for Z / exact");
  const double sigma = 2.0 * disks.radius[0];
  for (const double step : steps) {
    const auto whole = [&](double until) { return std::ceil(until / (step * free_time)); };
    const double dt = end / whole(end), long_dt = long_end / whole(long_end);
    std::vector<double> errors, prices, biases;
    double long_seconds = 0.0;
    for (std::size_t k = 0; k < from.size(); ++k) {
      double error = 0.0;
      const double seconds = least_seconds([&] {
        Backtrack method(scene.box, disks, from[k].state, dt);
        const double before = thread_seconds();
        for (double n = 0; n < whole(end); ++n) method.step();
        const double took = thread_seconds() - before;
        error = from[k].reference.rms_distance(1, method.state()) / sigma;
        return took;
      });
      errors.push_back(error);
      prices.push_back(seconds / from[k].exact_seconds);
      Backtrack method(scene.box, disks, from[k].state, long_dt);
      const double before = thread_seconds();
      for (double n = 0; n < whole(long_end); ++n) method.step();
      long_seconds += thread_seconds() - before;
      biases.push_back(100.0 * (method.virial() / exact_virial[k] - 1.0));
    }
    const auto good = std::count_if(errors.begin(), errors.end(), [](double error) { return error < right; });
    const Spread price = spread(prices), error = spread(errors);
    const auto [bias, uncertainty] = mean_of(biases);
    const bool all = good == static_cast<std::ptrdiff_t>(errors.size());
    fmt::print("{:>12.3g}  {:>24.1e}  {:>3}/{}  {:>24}  {:>20}  {:>9}\n", step, error.most, good, errors.size(),
               all ? fmt::format("{:.1f} ({:.1f}, {:.1f})", price.median, price.least, price.most) : "not right",
               fmt::format("{:.3f} +- {:.3f}", bias, uncertainty),
               std::abs(bias) < 3.0 * uncertainty ? fmt::format("{:.1f}", long_seconds / exact_long_seconds) : "biased");
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc < 3) throw std::invalid_argument("usage: return_to_contact SCENE COLLISIONS_PER_DISK [STEP ...]");
    std::vector<double> steps;
    for (int k = 3; k < argc; ++k) steps.push_back(std::stod(argv[k]));
    if (steps.empty()) steps = {0.5, 0.2, 0.1, 0.05, 0.02, 0.01};
    study(load_scene(argv[1]), std::stod(argv[2]), steps);
  } catch (const std::exception& error) {
    fmt::print(stderr, "return_to_contact: {}\n", error.what());
    return 2;
  }
  return 0;
}
