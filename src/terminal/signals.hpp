#pragma once
// Signals that ask a run or a study to stop: it ends at the next occasion, with its files completed and its state saved.

#include <signal.h>  // SIGHUP and the like are POSIX, not C++

#include <array>

namespace carom::cli {

/// The signals that ask the program to stop.
inline constexpr std::array stopping_signals = {SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGUSR1};

/// While a StopRequest lives, SIGINT (Ctrl-C), SIGTERM, SIGHUP (the terminal is closed), SIGXCPU (the limit of processor time)
/// and SIGUSR1 (the warning of a batch system) only set a flag, however often they come. A SIGINT or SIGTERM ends the program at
/// once where one of the two came half a second or more before: a person who presses Ctrl-C again is obeyed, and GNU timeout,
/// which sends its signal to the process and then to its group, loses nothing. A signal that the program was started to ignore
/// (as by nohup) stays ignored.
class StopRequest {
 public:
  StopRequest();
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;

  [[nodiscard]] bool made() const;
};

}  // namespace carom::cli
