// One engine of this library that runs when it is told to, so that a script can let it take turns with another program
// (bench/against.py). Arguments: disks, packing fraction, pair collisions per disk before the first turn. After "ready" it
// reads a number of pair collisions per line, and answers each with the processor time that they took, in seconds. At the end of
// the input it prints Z = pA/NkT over all turns, and exits with 4 where its answer is wrong.

#include "studies/benchmark/timed_engine.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <exception>
#include <iostream>
#include <string>

int main(int argc, char** argv) try {
  if (argc != 4) {
    fmt::print(stderr, "turns: give the number of disks, the packing fraction and the collisions per disk of the run-up\n");
    return 2;
  }
  const std::int64_t disks = std::stoll(argv[1]);
  const auto run_up = static_cast<std::uint64_t>(std::stod(argv[3]) * static_cast<double>(disks));
  carom::cli::TimedEngine engine(carom::cli::bench_scene(disks, std::stod(argv[2])), "fast", run_up);
  const auto say = [](const std::string& line) { fmt::print("{}\n", line), std::fflush(stdout); };
  say("ready");
  for (std::uint64_t collisions = 0; std::cin >> collisions;) {
    engine.take_turn(collisions);
    say(fmt::format("{:.9f}", static_cast<double>(collisions) / engine.rates().back()));
  }
  if (const std::string fault = engine.fault(); !fault.empty()) {
    fmt::print(stderr, "turns: {}\n", fault);
    return 4;
  }
  say(fmt::format("{:.9f}", engine.compressibility()));
  return 0;
} catch (const std::exception& error) {
  fmt::print(stderr, "turns: {}\n", error.what());
  return 2;
}
