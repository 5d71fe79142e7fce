// One thread waits for each child process, so there may be more threads than processors.

#include "studies/sweep/child_runs.hpp"

#include "io/child_process.hpp"
#include "io/output_error.hpp"
#include "io/partial_file.hpp"
#include "io/run_directory.hpp"
#include "studies/sweep/results.hpp"
#include "terminal/command.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <future>
#include <iterator>
#include <mutex>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

namespace carom::cli {

namespace fs = std::filesystem;

namespace {

using Words = std::vector<std::string>;

Words words_to_run(const RunOrder& order) {
  const std::string scene = (order.directory / scene_file).string();
  Words words = {"carom",      "run",   scene,       "--out", order.directory.string(), "--force", "--quiet",
                 "--progress", "never", "--threads", "1"};  // other runs have the other processors
  if (!order.checkpoint_every.empty()) words.insert(words.end(), {"--checkpoint-every", order.checkpoint_every});
  return words;
}

Words words_to_resume(const RunOrder& order) {
  return {"carom", "resume", order.directory.string(), "--quiet", "--progress", "never", "--threads", "1"};
}

/// A run of this very program. It dies with this process, even where that is killed, and writes no more into directories that a
/// later sweep may use.
class Child {
 public:
  explicit Child(Words words)
      : errors_(make_pipe()), process_("/proc/self/exe", std::move(words), {.errors = errors_[1], .dies_with_us = true}) {
    close(std::exchange(errors_[1], -1));
  }
  ~Child() { close(errors_[0]); }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Reads what the child writes to stderr, if it comes within the time. Returns false at its end.
  bool listen(int milliseconds) {
    pollfd wanted{.fd = errors_[0], .events = POLLIN, .revents = 0};
    if (poll(&wanted, 1, milliseconds) <= 0) return true;
    std::array<char, 4096> bytes{};
    const ssize_t count = ::read(errors_[0], bytes.data(), bytes.size());
    if (count > 0) said_.append(bytes.data(), static_cast<std::size_t>(count));
    constexpr std::size_t most = 65536;
    if (said_.size() > most) said_.erase(0, said_.size() - most);
    return count > 0 || (count < 0 && errno == EINTR);
  }
  [[nodiscard]] ChildProcess& process() { return process_; }
  /// Returns the last line, without the program's name.
  [[nodiscard]] std::string last_sentence() const {
    const std::size_t end = said_.find_last_not_of('\n');
    if (end == std::string::npos) return "";
    const std::size_t before = said_.rfind('\n', end);
    const std::size_t begin = before == std::string::npos ? 0 : before + 1;
    const std::string line = said_.substr(begin, end + 1 - begin);
    constexpr std::string_view name = "carom: ";
    return line.starts_with(name) ? line.substr(name.size()) : line;
  }

 private:
  static std::array<int, 2> make_pipe() {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "cannot make a pipe");
    return ends;
  }

  std::array<int, 2> errors_;
  ChildProcess process_;
  std::string said_;
};

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// Puts the scene into the directory. True where there is a checkpoint of this very scene to go on from.
bool prepare(const RunOrder& order) {
  fs::create_directories(order.directory);
  fs::remove(order.directory / failure_file);
  const fs::path checkpoint = order.directory / checkpoint_name, previous = order.directory / previous_checkpoint_name;
  if (text_of(order.directory / scene_file) == order.scene) return fs::exists(checkpoint) || fs::exists(previous);
  fs::remove(checkpoint);  // before the scene: else they would be taken for its own after a kill in between
  fs::remove(previous);
  PartialFile scene(order.directory / scene_file);
  scene.write(order.scene);
  scene.publish();
  return false;
}

std::string failure_of(int status, const Child& child) {
  if (WIFSIGNALED(status)) {
    const int number = WTERMSIG(status);
    return fmt::format("the run was ended by signal {} ({}){}", number, strsignal(number),
                       number == SIGKILL ? "; perhaps there is not enough memory" : "");
  }
  const std::string said = child.last_sentence();
  return said.empty() ? fmt::format("the run ended with exit code {}", WEXITSTATUS(status)) : said;
}

struct ChildOutcome {
  RunOutcome outcome;
  bool refused = false;  ///< whether the child found its command line, its scene or its files wrong, and ran nothing
};

ChildOutcome run_child(const Words& words, const StopRequest& stop, const std::function<bool()>& tick) {
  Child child(words);
  bool stopped = false;
  constexpr int between_ticks = 100;  // ms
  while (child.listen(between_ticks)) {
    const bool go_on = tick();
    if (stopped || (go_on && !stop.made())) continue;
    child.process().send(SIGUSR1);  // which asks to stop, and never ends a run at once, whatever else comes to the child
    stopped = true;
  }
  const int status = child.process().wait();
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  if (code == exit_done) return {{.finished = true}};
  if (stopped || stop.made()) return {};    // Ctrl-C comes to the child too, perhaps sooner
  if (code == exit_interrupted) return {};  // a signal that came to it alone, such as SIGXCPU: it has saved itself
  return {{.failure = failure_of(status, child)}, code == exit_usage};
}

}  // namespace

RunOutcome carry_out(const RunOrder& order, const StopRequest& stop, const std::function<bool()>& tick) {
  RunOutcome outcome;
  try {
    bool to_run = true;
    if (prepare(order)) {
      const ChildOutcome resumed = run_child(words_to_resume(order), stop, tick);
      // A checkpoint of another program, or a damaged one, is no reason to do without the run. Whatever else ends it, such as a
      // full disk or a kill, leaves the checkpoint good.
      to_run = resumed.refused && !stop.made() && tick();
      outcome = resumed.outcome;
    }
    if (to_run) outcome = run_child(words_to_run(order), stop, tick).outcome;
  } catch (const std::exception& error) {
    outcome.failure = error.what();
  }
  if (outcome.failure.empty()) return outcome;
  try {
    PartialFile file(order.directory / failure_file);
    file.write(outcome.failure + "\n");
    file.publish();
  } catch (const OutputError&) {
    // Without the file the run counts as not finished, and the process that started it reports its sentence once.
  }
  return outcome;
}

void run_in_threads(int threads, const RunSource& source, const std::function<RunOutcome(const RunOrder&)>& work) {
  std::mutex asking, answering;
  const auto next = [&] {
    const std::scoped_lock lock(asking);
    return source.next();
  };
  const auto carry_out_all = [&] {
    while (const std::optional<RunOrder> order = next()) {
      const RunOutcome outcome = work(*order);
      const std::scoped_lock lock(answering);
      source.done(*order, outcome);
    }
  };
  std::vector<std::future<void>> others;
  try {
    for (int k = 1; k < threads; ++k) others.push_back(std::async(std::launch::async, carry_out_all));
  } catch (const std::system_error&) {
    // The system gives no more threads: fewer runs go on at a time.
  }
  carry_out_all();
  for (std::future<void>& other : others) other.get();
}

}  // namespace carom::cli
