#include "io/child_process.hpp"

#include <fcntl.h>
#include <signal.h>  // kill is POSIX, not C++
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

namespace carom {

namespace {

/// Becomes the program, in the child, where other threads of the parent may have held any lock: system calls only. Returns the
/// error.
int become(const char* program, char** arguments, const ChildProcess::Options& options, pid_t parent) {
  if (options.own_group) ::setpgid(0, 0);
  if (options.dies_with_us) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) return ESRCH;
  }
  for (const int number : {SIGUSR1, SIGPIPE}) signal(number, SIG_DFL);
  const int nothing = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  const auto connect = [&](int from, int to) { return ::dup2(from < 0 ? nothing : from, to) >= 0; };
  if (connect(options.input, STDIN_FILENO) && connect(nothing, STDOUT_FILENO) && connect(options.errors, STDERR_FILENO))
    ::execv(program, arguments);
  return errno;
}

}  // namespace

ChildProcess::ChildProcess(const std::filesystem::path& program, std::vector<std::string> arguments, const Options& options) {
  std::vector<char*> words;
  for (std::string& argument : arguments) words.push_back(argument.data());
  words.push_back(nullptr);
  // The pipe closes by itself when the program begins; the error comes through it where it does not.
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "cannot make a pipe");
  const pid_t parent = ::getpid();
  id_ = ::fork();
  if (id_ == 0) {
    const int error = become(program.c_str(), words.data(), options, parent);
    (void)!::write(ends[1], &error, sizeof error);
    ::_exit(127);
  }
  int error = id_ < 0 ? errno : 0;
  ::close(ends[1]);
  if (id_ > 0)
    while (::read(ends[0], &error, sizeof error) < 0 && errno == EINTR) {
    }
  ::close(ends[0]);
  if (error == 0) return;
  if (id_ > 0) wait();
  throw std::system_error(error, std::generic_category(), "cannot start a process");
}

ChildProcess::~ChildProcess() {
  if (has_ended()) return;
  send(SIGKILL);
  wait();
}

bool ChildProcess::has_ended() {
  if (!ended_) ended_ = ::waitpid(id_, &status_, WNOHANG) == id_;
  return ended_;
}

int ChildProcess::wait() {
  while (!ended_) ended_ = ::waitpid(id_, &status_, 0) == id_ || errno != EINTR;
  return status_;
}

void ChildProcess::send(int signal) const {
  if (!ended_) ::kill(id_, signal);
}

}  // namespace carom
