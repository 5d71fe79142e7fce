// Carom's files from C++: reads a finished run back, sample by sample.

#include <carom/io/run_reader.hpp>

#include <cstdio>
#include <exception>

int main(int argc, char** argv) try {
  const carom::RunReader run(argc > 1 ? argv[1] : "box");
  std::printf("%s: %zu disks, %llu samples to time %g\n", run.title().c_str(), run.disks().count(),
              static_cast<unsigned long long>(run.samples()), run.end());
  for (std::uint64_t k = 0; k < run.samples(); ++k) {
    const carom::State state = run.sample(k);
    std::printf("t = %g: disk 0 is at (%.15g, %.15g)\n", state.time, state.positions(0, 0), state.positions(1, 0));
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
