#pragma once
// Wall time and processor time that have passed.

#include <chrono>
#include <ctime>

namespace carom {

/// Returns the wall time since `began`, in seconds.
inline double seconds_since(std::chrono::steady_clock::time_point began) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

/// Returns the processor time, in seconds, that the calling thread has taken so far; 0 where the system does not tell.
inline double thread_seconds() {
#ifdef CLOCK_THREAD_CPUTIME_ID
  timespec time{};
  if (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time) == 0)
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
#endif
  return 0.0;
}

}  // namespace carom
