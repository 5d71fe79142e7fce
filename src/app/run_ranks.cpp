#include "app/run_ranks.hpp"

#include "terminal/signals.hpp"

#include <carom/ranks.hpp>

#include <fmt/format.h>

#include <csignal>
#include <memory>
#include <string>
#include <vector>

namespace carom::cli {

namespace {

/// Lets the other processes end, whatever becomes of this one.
class Dismissal {
 public:
  explicit Dismissal(Processes& processes) : processes_(processes) {}
  ~Dismissal() { dismiss_ranks(processes_); }
  Dismissal(const Dismissal&) = delete;
  Dismissal& operator=(const Dismissal&) = delete;

 private:
  Processes& processes_;
};

/// Whoever starts four processes for four runs is to know that they would be one.
void require_one_command(Processes& processes, const std::string& command) {
  const std::vector<std::string> commands = processes.gather(command);
  for (const std::string& other : commands)
    if (other != command)
      throw UsageError(
          fmt::format("MPI connects {} processes, which compute one run together, and they were given different "
                      "commands, as: {}, and: {}; start each run by itself, or all as a sweep",
                      processes.size(), command, other));
}

}  // namespace

ExitCode in_first_process(const Invocation& invocation, const std::function<ExitCode(Processes* processes)>& first) {
  const Launch started = launch();
  std::unique_ptr<Processes> processes;
  try {
    processes = join_processes(started);
  } catch (const UsageError&) {
    if (started.rank > 0) return exit_done;  // the first one says it
    throw;
  }
  if (processes == nullptr) return first(nullptr);
  if (processes->rank() > 0) {
    for (const int number : stopping_signals) std::signal(number, SIG_IGN);  // the first one stops the run
    (void)processes->gather(invocation.command_line);
    serve_ranks(*processes);
    return exit_done;
  }
  const Dismissal dismissal(*processes);
  require_one_command(*processes, invocation.command_line);
  return first(processes.get());
}

}  // namespace carom::cli
