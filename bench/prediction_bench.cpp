// Predictions for a disk among 4, 8 or 16 neighbours, by the kernels of every instruction set that runs here. Before any
// time is taken every answer is held against core/contact_time.hpp, neighbour by neighbour.

#include "core/contact_time.hpp"
#include "core/fixed_axis.hpp"
#include "core/prediction.hpp"

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <string_view>
#include <vector>

namespace {

using namespace carom;

constexpr double now = 0.25;
constexpr std::int32_t centres = 64;  // with all their neighbours they fit the first cache, as those of one region do

struct Avx512 {
  static constexpr auto name = "avx512";
};
struct Avx2 {
  static constexpr auto name = "avx2";
};
struct Portable {
  static constexpr auto name = "portable";
};

/// The kernel of one instruction set, or nullptr where it is not to be had.
template <class Line, class Instructions>
const PredictionKernel<Line>* kernel_of() {
  setenv("CAROM_INSTRUCTIONS", Instructions::name, 1);
  const PredictionKernel<Line>& kernel = prediction_kernel<Line>();
  unsetenv("CAROM_INSTRUCTIONS");
  return std::string_view(kernel.name) == Instructions::name ? &kernel : nullptr;
}

/// Disks 0 to centres - 1, each among `neighbours` others at the distances of packing fraction 0.6.
template <class Line>
class Surrounded {
 public:
  explicit Surrounded(int neighbours) : neighbours_(static_cast<std::uint32_t>(neighbours)) {
    const Box box{{0.0, 0.0}, {100.0, 100.0}, {Boundary::periodic, Boundary::periodic}};
    const FixedAxis axes[2] = {{box, 0, 0.0}, {box, 1, 0.0}};
    frame_ = {{axes[0].unit, axes[1].unit}, {axes[0].steps, axes[1].steps}, 1.0, 0.3};
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> anywhere(0.0, 100.0), beside(-2.0, 2.0);
    const auto add = [&](const Vec2<double>& r) {
      const Vec2<double> v(normal(random), normal(random));
      Line line{};
      for (int k = 0; k < 2; ++k) {
        const double start = r[k] - v[k] * now;
        line.x[k] = axes[k].at(start - 100.0 * std::floor(start / 100.0));
        line.v[k] = v[k];
      }
      if constexpr (sizeof(Line) > 32) line.radius = 0.5;
      lines_.push_back(line);
    };
    std::vector<Vec2<double>> places;
    for (std::int32_t i = 0; i < centres; ++i) {
      const double x = anywhere(random), y = anywhere(random);
      places.emplace_back(x, y);
      add(places.back());
    }
    const std::size_t padded = std::max<std::size_t>((static_cast<std::size_t>(neighbours) + 3) / 4 * 4, 12);
    for (std::int32_t i = 0; i < centres; ++i) {
      std::vector<std::int32_t> list(padded, i);
      for (std::size_t k = 0; k < static_cast<std::size_t>(neighbours);) {
        const double x = beside(random), y = beside(random);
        if (std::hypot(x, y) < 1.0 || std::hypot(x, y) > 2.0) continue;
        list[k] = static_cast<std::int32_t>(lines_.size());
        add(places[static_cast<std::size_t>(i)] + Vec2<double>(x, y));
        ++k;
      }
      lists_.push_back(list);
      centre_.push_back({neighbourhood_centre(lines_[static_cast<std::size_t>(i)], 0),
                         neighbourhood_centre(lines_[static_cast<std::size_t>(i)], 1)});
    }
  }

  [[nodiscard]] Surroundings around(std::int32_t i) const {
    const auto k = static_cast<std::size_t>(i);
    return {{centre_[k][0], centre_[k][1]}, lists_[k].data(), neighbours_};
  }
  [[nodiscard]] Line* lines() { return lines_.data(); }
  [[nodiscard]] const PredictionFrame& frame() const { return frame_; }

  /// Whether contact times one by one agree to 1e-12: the two compute r^2 - sigma^2 in different ways.
  [[nodiscard]] bool confirms(std::int32_t i, const Prediction& ahead) const {
    double first = infinity<double>;
    std::int32_t partner = -1;
    for (const std::int32_t j : lists_[static_cast<std::size_t>(i)]) {
      if (j == i) continue;
      const Line &a = lines_[static_cast<std::size_t>(i)], &b = lines_[static_cast<std::size_t>(j)];
      Vec2<double> r, v;
      for (int k = 0; k < 2; ++k) {
        v[k] = a.v[k] - b.v[k];
        r[k] = static_cast<double>(wrapped_difference(a.x[k], b.x[k])) * frame_.unit[k] + v[k] * now;
      }
      const double time = now + contact_time<double>(r, v, 1.0);
      if (time < first) first = time, partner = j;
    }
    if (partner != ahead.partner || !(ahead.edge_time >= now && ahead.edge_time < infinity<double>)) return false;
    return partner < 0 || std::abs(ahead.pair_time - first) <= 1e-12 * first;
  }

 private:
  /// The centre of a neighbourhood round a disk at `now`.
  [[nodiscard]] std::int32_t neighbourhood_centre(const Line& line, int axis) const {
    const auto way = static_cast<std::int64_t>(line.v[axis] * now / frame_.unit[axis]);
    return static_cast<std::int32_t>((static_cast<std::uint64_t>(line.x[axis]) + static_cast<std::uint64_t>(way)) >> 32);
  }

  std::uint32_t neighbours_;
  PredictionFrame frame_{};
  std::vector<Line> lines_;
  std::vector<std::vector<std::int32_t>> lists_;
  std::vector<std::array<std::int32_t, 2>> centre_;
};

constexpr auto not_here = "this build or this machine has no such instructions";
constexpr auto wrong = "a prediction differs from the contact times one by one";

template <class Line, class Instructions>
void predict(benchmark::State& state) {
  const auto* kernel = kernel_of<Line, Instructions>();
  if (kernel == nullptr) {
    state.SkipWithError(not_here);
    return;
  }
  Surrounded<Line> disks(static_cast<int>(state.range(0)));
  Prediction ahead;
  for (std::int32_t i = 0; i < centres; ++i) {
    kernel->predict(disks.lines(), disks.frame(), i, disks.around(i), now, ahead);
    if (!disks.confirms(i, ahead)) {
      state.SkipWithError(wrong);
      return;
    }
  }
  std::int32_t i = 0;
  for (auto _ : state) {
    kernel->predict(disks.lines(), disks.frame(), i, disks.around(i), now, ahead);
    benchmark::DoNotOptimize(ahead);
    i = (i + 1) % centres;
  }
}

/// Two disks at a time, which go on as they went.
template <class Line, class Instructions>
void turn_and_predict(benchmark::State& state) {
  const auto* kernel = kernel_of<Line, Instructions>();
  if (kernel == nullptr) {
    state.SkipWithError(not_here);
    return;
  }
  Surrounded<Line> disks(static_cast<int>(state.range(0)));
  const auto collide = [&](std::int32_t i, std::int32_t j) {
    CollidedPair pair{{i, j}, {disks.around(i), disks.around(j)}, {}, 0, 0};
    const Line a = disks.lines()[i], b = disks.lines()[j];
    kernel->turn_and_predict(disks.lines(), disks.frame(), pair, now, a.v[0], a.v[1], b.v[0], b.v[1]);
    return pair;
  };
  for (std::int32_t i = 0; i < centres; i += 2) {
    const CollidedPair pair = collide(i, i + 1);
    if (!disks.confirms(i, pair.ahead[0]) || !disks.confirms(i + 1, pair.ahead[1])) {
      state.SkipWithError(wrong);
      return;
    }
  }
  std::int32_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(collide(i, i + 1));
    i = (i + 2) % centres;
  }
}

void lists(benchmark::internal::Benchmark* benchmark) { benchmark->ArgName("neighbours")->Arg(4)->Arg(8)->Arg(16); }

BENCHMARK_TEMPLATE(predict, Flight, Avx512)->Apply(lists);
BENCHMARK_TEMPLATE(predict, Flight, Avx2)->Apply(lists);
BENCHMARK_TEMPLATE(predict, Flight, Portable)->Apply(lists);
BENCHMARK_TEMPLATE(turn_and_predict, Flight, Avx512)->Apply(lists);
BENCHMARK_TEMPLATE(turn_and_predict, Flight, Avx2)->Apply(lists);
BENCHMARK_TEMPLATE(turn_and_predict, Flight, Portable)->Apply(lists);
BENCHMARK_TEMPLATE(turn_and_predict, SizedFlight, Avx512)->Apply(lists);
BENCHMARK_TEMPLATE(turn_and_predict, SizedFlight, Avx2)->Apply(lists);
BENCHMARK_TEMPLATE(turn_and_predict, SizedFlight, Portable)->Apply(lists);

}  // namespace
