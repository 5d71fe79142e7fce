#pragma once
// The processes that mpirun or srun has started together, on one machine or on many. Nothing else sees MPI.

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

class Ranks {
 public:
  virtual ~Ranks() = default;
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  [[nodiscard]] virtual int rank() const = 0;  ///< number of this process, from 0
  [[nodiscard]] virtual int size() const = 0;
  /// One thread at a time may call these.
  virtual void send(int to, int kind, const std::string& text) = 0;
  /// Returns a message of this kind (absent: of any) if one has come.
  [[nodiscard]] virtual std::optional<Message> receive(std::optional<int> kind) = 0;

 protected:
  Ranks() = default;
};

/// The number of processes that were started together, and the number of this one, as their starter says in the environment.
struct Launch {
  int size = 1;
  int rank = 0;
};
[[nodiscard]] Launch launch();

/// Null where this process was started alone. When the last of these is destroyed, all of its processes have come that far.
/// Throws UsageError where MPI is not built in, or does not connect the processes.
[[nodiscard]] std::unique_ptr<Ranks> join_ranks(const Launch& launch);

}  // namespace carom::cli
