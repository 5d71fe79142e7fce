#include "studies/sweep/mpi.hpp"

#include "terminal/command.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cstdlib>
#include <string_view>

#if CAROM_HAS_MPI
#define OMPI_SKIP_MPICXX 1
#define MPICH_SKIP_MPICXX 1
#include <mpi.h>
#endif

namespace carom::cli {

namespace {

std::optional<int> number_in_environment(const char* name) {
  const char* const text = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): before there are threads
  if (text == nullptr) return {};
  const std::string_view digits = text;
  int number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return error == std::errc() && end == digits.data() + digits.size() ? std::optional(number) : std::nullopt;
}

}  // namespace

Launch launch() {
  // Open MPI; MPICH and Intel MPI; srun. A Slurm batch script by itself is one process, whatever SLURM_NTASKS says.
  struct Names {
    const char *size, *rank;
  };
  static constexpr std::array<Names, 3> starters = {
      {{"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"}, {"PMI_SIZE", "PMI_RANK"}, {"SLURM_STEP_NUM_TASKS", "SLURM_PROCID"}}};
  for (const Names& names : starters) {
    const std::optional<int> size = number_in_environment(names.size), rank = number_in_environment(names.rank);
    if (size && rank && *size > 1) return {*size, *rank};
  }
  return {};
}

#if CAROM_HAS_MPI

namespace {

/// By default MPI ends all processes where a call fails, with a message of its own.
class MpiRanks final : public Ranks {
 public:
  MpiRanks() {
    int given = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &given);
    serialized_ = given >= MPI_THREAD_SERIALIZED;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
  }
  ~MpiRanks() override { MPI_Finalize(); }
  MpiRanks(const MpiRanks&) = delete;
  MpiRanks& operator=(const MpiRanks&) = delete;

  [[nodiscard]] int rank() const override { return rank_; }
  [[nodiscard]] int size() const override { return size_; }
  [[nodiscard]] bool serialized() const { return serialized_; }
  void send(int to, int kind, const std::string& text) override {
    MPI_Send(text.data(), static_cast<int>(text.size()), MPI_CHAR, to, kind, MPI_COMM_WORLD);
  }
  [[nodiscard]] std::optional<Message> receive(std::optional<int> kind) override {
    int there = 0, length = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, kind.value_or(MPI_ANY_TAG), MPI_COMM_WORLD, &there, &status);
    if (there == 0) return {};
    MPI_Get_count(&status, MPI_CHAR, &length);
    Message message{
        .from = status.MPI_SOURCE, .kind = status.MPI_TAG, .text = std::string(static_cast<std::size_t>(length), '\0')};
    MPI_Recv(message.text.data(), length, MPI_CHAR, message.from, message.kind, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return message;
  }

 private:
  int rank_ = 0, size_ = 1;
  bool serialized_ = false;
};

}  // namespace

std::unique_ptr<Ranks> join_ranks(const Launch& launch) {
  if (launch.size == 1) return nullptr;
  auto ranks = std::make_unique<MpiRanks>();
  if (ranks->size() == launch.size && ranks->serialized()) return ranks;
  throw UsageError(
      fmt::format("this is one of {} processes, and MPI connects {} of them: each would do everything; start them with the "
                  "mpirun of the MPI that "
                  "carom was built with, or with srun --mpi=pmix",
                  launch.size, ranks->size()));
}

#else

std::unique_ptr<Ranks> join_ranks(const Launch& launch) {
  if (launch.size == 1) return nullptr;
  throw UsageError(fmt::format(
      "this is one of {} processes, and this carom was built without MPI: each would do everything; start one alone, with "
      "--threads, or build with CAROM_MPI=ON",
      launch.size));
}

#endif

}  // namespace carom::cli
