// Runs programs as child processes. Their output goes to files, so that no pipe can fill up.

#include "support/child_process.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

namespace carom::test {

namespace fs = std::filesystem;

Outcome run_carom(const fs::path& directory, const std::vector<std::string>& arguments,
                  const std::function<void(pid_t)>& meanwhile) {
  // Memory that is given back, or not yet written, is full of rubbish.
  std::vector<std::string> words = {"env", "MALLOC_PERTURB_=165", "GLIBC_TUNABLES=glibc.malloc.tcache_count=0", CAROM_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return run_program(directory, std::move(words), meanwhile);
}

Outcome run_program(const fs::path& directory, std::vector<std::string> words, const std::function<void(pid_t)>& meanwhile) {
  const TemporaryDirectory kept;
  const std::string out = kept.file("out");
  const std::string err = kept.file("err");
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  const pid_t child = fork();
  if (child == 0) {
    const bool ready = chdir(directory.c_str()) == 0 && dup2(open("/dev/null", O_RDONLY), STDIN_FILENO) >= 0 &&
                       dup2(creat(out.c_str(), 0600), STDOUT_FILENO) >= 0 && dup2(creat(err.c_str(), 0600), STDERR_FILENO) >= 0;
    if (ready) execvp(argv[0], argv.data());
    _exit(127);
  }
  if (child < 0) throw std::runtime_error("cannot fork");
  if (meanwhile) meanwhile(child);
  int status = 0;
  waitpid(child, &status, 0);
  return {
      .exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), .out = text_of(out), .err = text_of(err)};
}

bool handles(pid_t process, int signal) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("SigCgt:")) return (std::stoull(line.substr(7), nullptr, 16) >> (signal - 1) & 1U) != 0;
  return false;
}

bool wait_until(const std::function<bool()>& condition) {
  for (int i = 0; i < 3000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

Outcome ended_early(const std::function<Outcome()>& run) {
  for (int tries = 1;; ++tries) {
    Outcome outcome = run();
    if (outcome.exit_code != 0 || tries == 10) return outcome;
  }
}

}  // namespace carom::test
