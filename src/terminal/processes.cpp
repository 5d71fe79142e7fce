#include "terminal/processes.hpp"

#include "terminal/command.hpp"
#include "text/number_in.hpp"

#include <fmt/format.h>

#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>

namespace carom::cli {

namespace {

// Open MPI; MPICH and Intel MPI; srun. A Slurm batch script by itself is one process, whatever SLURM_NTASKS says.
struct Names {
  const char *size, *rank;
};
constexpr std::array<Names, 3> starters = {
    {{"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"}, {"PMI_SIZE", "PMI_RANK"}, {"SLURM_STEP_NUM_TASKS", "SLURM_PROCID"}}};

std::optional<int> number_in_environment(const char* name) {
  const char* const text = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): before there are threads
  return text == nullptr ? std::nullopt : number_in<int>(text);
}

ProcessJoiner* joiner = nullptr;

}  // namespace

Launch launch() {
  for (const Names& names : starters) {
    const std::optional<int> size = number_in_environment(names.size), rank = number_in_environment(names.rank);
    if (size && rank && *size > 1) return {*size, *rank};
  }
  return {};
}

void set_process_joiner(ProcessJoiner* join) { joiner = join; }

void continue_as_carom_mpi(char** arguments) {
  if (launch().size == 1) return;
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  if (error) return;
  // In a build directory the two programs are beside each other, installed they are below one prefix.
  for (const char* const place : {"carom-mpi", CAROM_MPI_PROGRAM}) execv((folder / place).c_str(), arguments);
}

std::unique_ptr<Processes> join_processes(const Launch& launch) {
  if (launch.size == 1) return nullptr;
  if (joiner == nullptr)
    throw UsageError(
        fmt::format("this is one of {} processes, and this carom is built without MPI and finds no carom-mpi: each would do "
                    "everything; install the package carom-mpi, or build with CAROM_MPI=ON, or start one alone, with --threads",
                    launch.size));
  std::unique_ptr<Processes> ranks = joiner();
  for (const Names& names : starters) unsetenv(names.size);  // NOLINT(concurrency-mt-unsafe): before there are threads
  if (ranks->size() == launch.size) return ranks;
  throw UsageError(
      fmt::format("this is one of {} processes, and MPI connects {} of them: each would do everything; start them with the "
                  "mpirun of the MPI that carom-mpi was built with, or with srun --mpi=pmix",
                  launch.size, ranks->size()));
}

}  // namespace carom::cli
