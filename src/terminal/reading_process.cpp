#include "terminal/reading_process.hpp"

#include "terminal/signals.hpp"
#include "terminal/standard_output.hpp"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <system_error>

namespace carom::cli {

namespace fs = std::filesystem;

namespace {

volatile sig_atomic_t reader = 0;  // the child's id

extern "C" void hand_on(int number) {
  if (reader > 0) kill(static_cast<pid_t>(reader), number);
}

/// Ctrl-Z stops the child too, and it goes on with the parent.
extern "C" void stop_both(int) {
  hand_on(SIGSTOP);
  raise(SIGSTOP);
  hand_on(SIGCONT);
}

/// Passes signals that ask the parent to end on to the child, which has a process group of its own. A signal from a terminal,
/// from `timeout` or from `kill` then reaches it once; a second one is the user's, and ends it at once.
class HandOn {
 public:
  explicit HandOn(pid_t child) {
    reader = child;
    struct sigaction action = {};
    action.sa_handler = hand_on;
    sigemptyset(&action.sa_mask);
    for (std::size_t i = 0; i < before_.size(); ++i) sigaction(stopping_signals[i], &action, &before_[i]);
    action.sa_handler = stop_both;
    sigaction(SIGTSTP, &action, &stop_);
  }
  ~HandOn() {
    for (std::size_t i = 0; i < before_.size(); ++i) sigaction(stopping_signals[i], &before_[i], nullptr);
    sigaction(SIGTSTP, &stop_, nullptr);
    reader = 0;
  }
  HandOn(const HandOn&) = delete;
  HandOn& operator=(const HandOn&) = delete;

 private:
  std::array<struct sigaction, stopping_signals.size()> before_ = {};
  struct sigaction stop_ = {};
};

int status_of(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw std::runtime_error(fmt::format("cannot wait for the process that reads: {}", std::strerror(errno)));
  return status;
}

std::uintmax_t bytes_of(const fs::path& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) {
    const std::uintmax_t bytes = fs::file_size(path, error);
    return error ? 0 : bytes;
  }
  std::uintmax_t bytes = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(path, error))
    if (const std::uintmax_t more = entry.is_regular_file(error) ? entry.file_size(error) : 0; !error) bytes += more;
  return bytes;
}

}  // namespace

ExitCode in_reading_process(const fs::path& file, const std::function<ExitCode()>& command) {
  std::fflush(nullptr);
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child < 0) return command();  // without the net
  if (child == 0) {
    setpgid(0, 0);
    signal(SIGTTOU, SIG_IGN);  // it may write to the terminal of the parent
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) return exit_failed;
    const ExitCode code = command();
    flush_output();
    _exit(code);  // what the caller does next, the parent does
  }
  setpgid(child, child);  // before any signal, in either order of the two processes
  const HandOn hand_on_signals(child);
  const int status = status_of(child);
  if (WIFEXITED(status)) return static_cast<ExitCode>(WEXITSTATUS(status));
  const int number = WTERMSIG(status);
  if (std::ranges::find(stopping_signals, number) != stopping_signals.end()) return exit_interrupted;
  switch (number) {
    case SIGKILL:
      throw std::runtime_error(
          fmt::format("{}: the process that read it was killed; perhaps there is not enough memory", file.string()));
    case SIGPROF:
      throw UsageError(fmt::format("{}: reading it does not end, so it is damaged; run the scene again", file.string()));
    case SIGSEGV:
    case SIGBUS:
    case SIGABRT:
    case SIGFPE:
    case SIGILL:
      throw UsageError(fmt::format("{}: reading it ends in a crash ({}), so it is damaged; run the scene again", file.string(),
                                   strsignal(number)));
    default:  // such as SIGPIPE, where nobody reads what it says: this process ends in the same way
      std::signal(number, SIG_DFL);
      std::raise(number);
      return exit_failed;
  }
}

namespace {

/// Limits the processor time, so that neither a busy machine nor a slow disk counts; no limit where `seconds` is 0.
void end_after(std::uintmax_t seconds) {
  const itimerval timer = {.it_interval = {}, .it_value = {.tv_sec = static_cast<time_t>(seconds), .tv_usec = 0}};
  setitimer(ITIMER_PROF, &timer, nullptr);
}

}  // namespace

ReadingLimit::ReadingLimit(const fs::path& file) {
  constexpr std::uintmax_t base = 20, bytes_per_second = 1'000'000, longest = 1'000'000'000;
  end_after(std::min(base + bytes_of(file) / bytes_per_second, longest));
}

ReadingLimit::~ReadingLimit() { end_after(0); }

}  // namespace carom::cli
