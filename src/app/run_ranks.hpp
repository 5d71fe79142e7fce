#pragma once
// One run in several processes that mpirun or srun has started together: the first one does what the program does alone, and the
// others compute the domains that it gives them.

#include "terminal/command.hpp"
#include "terminal/processes.hpp"

#include <functional>

namespace carom::cli {

/// Calls `first` with the processes started together with this one in the first of them, and with null where there is no other.
/// In the others, serves the first until its call has ended. Throws UsageError where MPI does not connect the processes, or they
/// were given different commands.
ExitCode in_first_process(const Invocation& invocation, const std::function<ExitCode(Processes* processes)>& first);

}  // namespace carom::cli
