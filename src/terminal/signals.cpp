#include "terminal/signals.hpp"

#include <time.h>  // clock_gettime is POSIX, not C++

#include <cerrno>

namespace carom::cli {

namespace {

constexpr double patience = 0.5;  // s

volatile sig_atomic_t requested = 0;
volatile sig_atomic_t insisted = 0;  ///< SIGINT or SIGTERM has come, at `first_insisted`
timespec first_insisted;
std::array<struct sigaction, stopping_signals.size()> before;

/// Calls only what a signal handler may. No other stopping signal comes in between: all are blocked while it runs.
extern "C" void request_stop(int number) {
  requested = 1;
  if (number != SIGINT && number != SIGTERM) return;
  const int error = errno;
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  if (insisted == 0) {
    first_insisted = now;
    insisted = 1;
  } else if (static_cast<double>(now.tv_sec - first_insisted.tv_sec) +
                 1e-9 * static_cast<double>(now.tv_nsec - first_insisted.tv_nsec) >=
             patience) {
    signal(number, SIG_DFL);
    raise(number);  // as soon as this handler has returned
  }
  errno = error;
}

}  // namespace

StopRequest::StopRequest() {
  requested = 0;
  insisted = 0;
  struct sigaction action = {};
  action.sa_handler = request_stop;
  action.sa_flags = SA_RESTART;  // a write that the signal meets goes on
  sigemptyset(&action.sa_mask);
  for (const int number : stopping_signals) sigaddset(&action.sa_mask, number);
  for (std::size_t i = 0; i < stopping_signals.size(); ++i) {
    sigaction(stopping_signals[i], nullptr, &before[i]);
    if (before[i].sa_handler != SIG_IGN) sigaction(stopping_signals[i], &action, nullptr);
  }
}

StopRequest::~StopRequest() {
  for (std::size_t i = 0; i < stopping_signals.size(); ++i) sigaction(stopping_signals[i], &before[i], nullptr);
}

bool StopRequest::made() const { return requested != 0; }

}  // namespace carom::cli
