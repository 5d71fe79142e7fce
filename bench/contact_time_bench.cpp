// The price of one contact time, for pairs as a prediction meets them: most pass, some touch.

#include "core/contact_time.hpp"

#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <vector>

namespace {

using carom::Vec2;

template <class Real>
void time_contact(benchmark::State& state) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::vector<std::pair<Vec2<Real>, Vec2<Real>>> pairs;
  while (pairs.size() < 1024) {
    const Vec2<double> r(normal(random), normal(random));
    if (r.norm() < 1.0 || r.norm() > 2.0) continue;  // a neighbour at packing fraction 0.6
    pairs.emplace_back(r.cast<Real>(), Vec2<double>(normal(random), normal(random)).cast<Real>());
  }
  int hits = 0;
  for (const auto& [r, v] : pairs) {
    const Real t = carom::contact_time<Real>(r, v, Real(1));
    if (t == carom::infinity<Real>) continue;
    ++hits;
    const Vec2<Real> contact = r + v * t;
    using std::sqrt;
    if (std::abs(static_cast<double>(sqrt(contact.squaredNorm())) - 1.0) > 100 * static_cast<double>(carom::epsilon<Real>)) {
      state.SkipWithError("a contact time does not lead to contact");
      return;
    }
  }
  std::size_t k = 0;
  for (auto _ : state) {
    const auto& [r, v] = pairs[k++ % pairs.size()];
    benchmark::DoNotOptimize(carom::contact_time<Real>(r, v, Real(1)));
  }
  state.counters["hits"] = hits / 1024.0;
}

BENCHMARK(time_contact<float>);
BENCHMARK(time_contact<double>);
BENCHMARK(time_contact<long double>);
BENCHMARK(time_contact<carom::Quad>);

}  // namespace
