#pragma once
// The processes of mpirun or srun, connected by MPI. Only the program carom-mpi has these.

#include "terminal/processes.hpp"

#include <memory>

namespace carom::cli {

/// Initialises MPI and returns its processes; their size is 1 where this MPI does not serve several threads.
[[nodiscard]] std::unique_ptr<Processes> join_by_mpi();

}  // namespace carom::cli
