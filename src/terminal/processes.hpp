#pragma once
// The processes that mpirun or srun has started together, on one machine or on many. Nothing else sees MPI.

#include <carom/ranks.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace carom::cli {

/// A message from one process to another. Its kind is any number from 0 on.
struct Message {
  int from = 0;
  int kind = 0;
  std::string text = {};
};

/// One thread at a time may call these.
class Processes : public Ranks {
 public:
  virtual void send(int to, int kind, const std::string& text) = 0;
  /// Returns a message of this kind (absent: of any) if one has come.
  [[nodiscard]] virtual std::optional<Message> receive(std::optional<int> kind) = 0;
  /// Has `silence` called again and again, by a thread of its own, with the seconds for which a function of Ranks has waited for
  /// another process. An empty function ends that.
  virtual void watch_silence(std::function<void(double seconds)> silence) = 0;

 protected:
  Processes() = default;
};

/// The number of processes that were started together, and the number of this one, as their starter says in the environment.
struct Launch {
  int size = 1;
  int rank = 0;
};
[[nodiscard]] Launch launch();

/// Connects the processes of this launch. The program carom-mpi sets it before it does anything else; carom has none.
using ProcessJoiner = std::unique_ptr<Processes>();
void set_process_joiner(ProcessJoiner* join);

/// Where this process is one of several, replaces the program carom by carom-mpi, with the same arguments; carom itself does not
/// load MPI. Returns where this process was started alone, and where there is no carom-mpi beside it or installed with it.
void continue_as_carom_mpi(char** arguments);

/// Null where this process was started alone. When the last of these is destroyed, all of its processes have come that far.
/// Processes that this one starts from now on are none of these.
/// Throws UsageError where this program is not carom-mpi, or MPI does not connect the processes.
[[nodiscard]] std::unique_ptr<Processes> join_processes(const Launch& launch);

}  // namespace carom::cli
