#pragma once
// The hash by which tests/golden/hashes.txt knows the end of a run.

#include <carom/simulation.hpp>

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <string>

namespace carom::test {

/// FNV-1a over the bytes of the numbers.
class Hash {
 public:
  template <class T>
  void add(const T& number) {
    unsigned char bytes[sizeof(T)];
    std::memcpy(bytes, &number, sizeof(T));
    for (const unsigned char byte : bytes) value_ = (value_ ^ byte) * 0x100000001b3ull;
  }
  [[nodiscard]] std::string text() const { return fmt::format("{:016x}", value_); }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ull;
};

/// Returns the hash of the final state and the counts of a run of the scene.
inline std::string hash_of_run(Scene scene, const std::string& engine, bool sampling = true, const Threads& threads = {},
                               carom::Ranks* ranks = nullptr) {
  if (!sampling) scene.run.sample_every.reset();
  Simulation simulation = make_simulation(scene, engine);
  ranks == nullptr ? simulation.set_threads(threads) : simulation.set_threads(threads, *ranks);
  run_schedule(simulation);
  const State state = simulation.state();
  Hash hash;
  for (Eigen::Index i = 0; i < state.positions.cols(); ++i) {
    for (int a = 0; a < 2; ++a) {
      hash.add(state.positions(a, i));
      hash.add(state.velocities(a, i));
      hash.add(state.images(a, i));
    }
  }
  for (const double spin : state.spins) hash.add(spin);
  for (const WallState& wall : state.walls) {
    hash.add(wall.position);
    hash.add(wall.velocity);
  }
  hash.add(simulation.totals().pair);
  hash.add(simulation.totals().wall);
  return hash.text();
}

}  // namespace carom::test
