#include "runner/free_processors.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <optional>
#include <string>
#include <thread>

namespace carom {

namespace {

/// Returns how many threads of the whole machine run or want to run at this moment, the caller among them. Linux says so in the
/// fourth number of this file: "0.20 0.18 0.12 3/412 1234".
std::optional<int> running_now() {
  std::ifstream file("/proc/loadavg");
  double minute = 0.0;
  int running = 0;
  if (!(file >> minute >> minute >> minute >> running) || running < 1) return std::nullopt;
  return running;
}

}  // namespace

int processors() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

int free_processors() {
  const int all = processors();
  const long of_machine = sysconf(_SC_NPROCESSORS_ONLN);
  if (all == 1 || of_machine < all) return all;
  std::optional<int> fewest;  // who computes for long is there every time
  for (int look = 0; look < 3; ++look) {
    if (look > 0) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    const std::optional<int> running = running_now();
    if (!running) return all;
    fewest = std::min(fewest.value_or(*running), *running);
  }
  const int others = std::max(0, *fewest - 1);
  return std::clamp(static_cast<int>(of_machine) - others, 1, all);
}

}  // namespace carom
