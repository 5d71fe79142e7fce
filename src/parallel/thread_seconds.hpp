#pragma once
// The processor time of a thread.

#include <ctime>

namespace carom {

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
