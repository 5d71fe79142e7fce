// SIGINT and SIGTERM as a flag.

#include "cli/signals.hpp"

#include <signal.h>  // sigaction is POSIX, not C++

#include <array>

namespace carom::cli {

namespace {

constexpr std::array stopping = {SIGINT, SIGTERM};

volatile sig_atomic_t requested = 0;
std::array<struct sigaction, stopping.size()> before;

extern "C" void request_stop(int number) { requested = number; }

}  // namespace

StopRequest::StopRequest() {
  requested = 0;
  for (std::size_t i = 0; i < stopping.size(); ++i) {
    struct sigaction action = {};
    action.sa_handler = request_stop;
    // The handler is gone after its first call, and a write that the signal meets goes on.
    action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(stopping[i], nullptr, &before[i]);
    if (before[i].sa_handler != SIG_IGN) sigaction(stopping[i], &action, nullptr);
  }
}

StopRequest::~StopRequest() {
  for (std::size_t i = 0; i < stopping.size(); ++i) sigaction(stopping[i], &before[i], nullptr);
}

bool StopRequest::made() const { return requested != 0; }

int StopRequest::for_children() const {
  const bool interrupt_ignored = before.front().sa_handler == SIG_IGN;
  return requested == SIGTERM && !interrupt_ignored ? SIGINT : SIGTERM;
}

}  // namespace carom::cli
