#include "studies/validate/in_threads.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <future>
#include <system_error>
#include <vector>

namespace carom::validation {

bool in_threads(std::size_t count, unsigned threads, const std::function<bool()>& proceed,
                const std::function<void(std::size_t k, const std::function<bool()>& go_on)>& work) {
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> stopped = false;
  std::exception_ptr error;  // what stopped the work, where that was an exception
  const auto stop_by_exception = [&] {
    if (!stopped.exchange(true)) error = std::current_exception();
  };
  const auto take = [&](const std::function<bool()>& go_on) {
    while (!stopped) {
      const std::size_t k = next++;
      if (k >= count) return;
      try {
        work(k, go_on);
      } catch (...) {
        stop_by_exception();
      }
    }
  };
  const std::function<bool()> beside = [&] { return !stopped; };
  const std::function<bool()> here = [&] {
    if (!stopped && proceed && !proceed()) stopped = true;
    return !stopped;
  };
  {
    std::vector<std::future<void>> others;
    try {
      while (others.size() + 1 < std::min<std::size_t>(threads, count))
        others.push_back(std::async(std::launch::async, take, std::cref(beside)));
    } catch (const std::system_error&) {
      // The system gives no more threads: those that there are do the work.
    }
    take(here);
    using namespace std::chrono_literals;
    for (const std::future<void>& other : others)
      while (other.wait_for(100ms) == std::future_status::timeout) try {
          here();
        } catch (...) {
          stop_by_exception();
        }
  }
  if (error) std::rethrow_exception(error);
  return !stopped;
}

}  // namespace carom::validation
