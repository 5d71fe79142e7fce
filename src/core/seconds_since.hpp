#pragma once
// Wall time that has passed.

#include <chrono>

namespace carom {

/// Returns the wall time since `began`, in seconds.
inline double seconds_since(std::chrono::steady_clock::time_point began) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

}  // namespace carom
