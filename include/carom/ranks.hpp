#pragma once
// Processes that compute one simulation together, on one machine or on many: ranks, as MPI calls them. The library knows no
// message passing of its own; a program that has some says here how ranks talk, and passes it to Simulation::set_threads().

#include <span>
#include <string>
#include <vector>

namespace carom {

/// What one rank has for another.
struct Parcel {
  int rank = 0;            ///< of the other
  std::string bytes = {};  ///< any bytes
};

/// The ranks of one simulation, as one of them sees them. All ranks are processes of the same program on machines of the same
/// kind, and call the same functions in the same order; one thread at a time does. None of the functions may throw: where a
/// message cannot be delivered, the program is to end.
class Ranks {
 public:
  virtual ~Ranks() = default;
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  [[nodiscard]] virtual int rank() const = 0;  ///< number of this rank, from 0; rank 0 leads
  [[nodiscard]] virtual int size() const = 0;  ///< number of ranks
  /// Replaces `bytes` on all other ranks by those that rank 0 gives.
  virtual void broadcast(std::string& bytes) = 0;
  /// Returns what each rank gives, by rank, on rank 0; nothing on the others.
  [[nodiscard]] virtual std::vector<std::string> gather(const std::string& bytes) = 0;
  /// Sends each parcel to its rank, and puts in its place what that rank has sent to this one. Of two ranks each has a parcel for
  /// the other, or neither has.
  virtual void exchange(std::span<Parcel> parcels) = 0;

 protected:
  Ranks() = default;
};

/// Computes on a rank other than 0 what the simulations of rank 0 ask for, until rank 0 calls dismiss_ranks().
void serve_ranks(Ranks& ranks);
/// Lets serve_ranks() return on all other ranks. Rank 0 calls it once, when none of its simulations has these ranks any more.
void dismiss_ranks(Ranks& ranks);

}  // namespace carom
