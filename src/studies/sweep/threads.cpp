// A thread for every run that is going on. They do nothing but wait for child processes, so that there may be more of them than
// processors.

#include "studies/sweep/threads.hpp"

#include <future>
#include <mutex>
#include <vector>

namespace carom::cli {

void run_in_threads(int threads, const RunDesk& desk, const std::function<RunEnd(const RunOrder&)>& work) {
  std::mutex asking, answering;
  const auto next = [&] {
    const std::scoped_lock lock(asking);
    return desk.next();
  };
  const auto carry_out_all = [&] {
    while (const std::optional<RunOrder> order = next()) {
      const RunEnd end = work(*order);
      const std::scoped_lock lock(answering);
      desk.done(*order, end);
    }
  };
  std::vector<std::future<void>> others;
  for (int k = 1; k < threads; ++k) others.push_back(std::async(std::launch::async, carry_out_all));
  carry_out_all();
  for (std::future<void>& other : others) other.get();
}

}  // namespace carom::cli
