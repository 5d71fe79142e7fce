#pragma once
// Programs that run beside this one.

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace carom {

/// A child process. It is killed where the object ends first.
class ChildProcess {
 public:
  struct Options {
    int input = -1;             ///< descriptor of its standard input; -1: /dev/null
    int errors = -1;            ///< descriptor of its standard error; -1: /dev/null
    bool own_group = false;     ///< whether Ctrl-C at the terminal is for this program alone
    bool dies_with_us = false;  ///< whether the system kills it where this process ends in any way
  };

  /// Starts a program with `arguments`, the first of which is its name. Its standard output is /dev/null; SIGPIPE and SIGUSR1 act
  /// in it as they do by default. Throws std::system_error where it cannot be started.
  ChildProcess(const std::filesystem::path& program, std::vector<std::string> arguments, const Options& options);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess();

  /// Returns whether it has ended, without waiting.
  [[nodiscard]] bool has_ended();
  /// Waits for its end and returns its status, as waitpid gives it.
  int wait();
  /// Sends a signal, unless it has ended.
  void send(int signal) const;

 private:
  pid_t id_ = -1;
  bool ended_ = false;
  int status_ = 0;
};

}  // namespace carom
