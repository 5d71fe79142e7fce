#include "app/mpi_processes.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <span>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#define OMPI_SKIP_MPICXX 1
#define MPICH_SKIP_MPICXX 1
#include <mpi.h>

namespace carom::cli {

namespace {

/// By default MPI ends all processes where a call fails, with a message of its own.
class MpiProcesses final : public Processes {
 public:
  MpiProcesses() {
    int given = 0;
    setenv("OMPI_MCA_mpi_yield_when_idle", "0", 0);  // Open MPI yields where processes outnumber processors; see poll()
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &given);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
    if (given < MPI_THREAD_SERIALIZED) size_ = 1;  // each process is then as good as alone
    MPI_Comm_dup(MPI_COMM_WORLD, &of_ranks_);
  }
  ~MpiProcesses() override {
    MPI_Comm_free(&of_ranks_);
    MPI_Finalize();
  }
  MpiProcesses(const MpiProcesses&) = delete;
  MpiProcesses& operator=(const MpiProcesses&) = delete;

  [[nodiscard]] int rank() const override { return rank_; }
  [[nodiscard]] int size() const override { return size_; }
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
  void watch_silence(std::function<void(double seconds)> silence) override {
    watch_ = {};
    if (!silence) return;
    // MPI may wait in its own functions for a process that has died, for ever.
    watch_ = std::jthread([this, silence = std::move(silence)](const std::stop_token& over) {
      while (!over.stop_requested()) {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        if (const std::int64_t since = waiting_since_; since != 0) silence(1e-9 * static_cast<double>(nanoseconds() - since));
      }
    });
  }

  void broadcast(std::string& bytes) override {
    const Waiting waiting(waiting_since_);
    // Most are short, and go with their length.
    std::array<char, 512> head{};
    std::uint64_t size = bytes.size();
    std::memcpy(head.data(), &size, sizeof size);
    std::memcpy(head.data() + sizeof size, bytes.data(), std::min(bytes.size(), room_in_head));
    broadcast(head.data(), static_cast<int>(head.size()));
    std::memcpy(&size, head.data(), sizeof size);
    if (rank_ != 0) {
      bytes.resize(size);
      std::memcpy(bytes.data(), head.data() + sizeof size, std::min<std::size_t>(size, room_in_head));
    }
    for (std::size_t at = room_in_head; at < bytes.size(); at += most)
      broadcast(bytes.data() + at, static_cast<int>(std::min(bytes.size() - at, most)));
  }
  [[nodiscard]] std::vector<std::string> gather(const std::string& bytes) override {
    const Waiting waiting(waiting_since_);
    if (rank_ != 0) {
      std::vector<MPI_Request> sent;
      send_all(0, gathered, bytes, sent);
      wait(sent);
      return {};
    }
    std::vector<std::string> all = {bytes};
    for (int from = 1; from < size_; ++from) all.push_back(receive_all(from, gathered));
    return all;
  }
  void exchange(std::span<Parcel> parcels) override {
    const Waiting waiting(waiting_since_);
    std::vector<MPI_Request> sent;
    std::vector<std::string> received;
    for (const Parcel& parcel : parcels) send_all(parcel.rank, exchanged, parcel.bytes, sent);
    for (const Parcel& parcel : parcels) received.push_back(receive_all(parcel.rank, exchanged));
    wait(sent);
    for (std::size_t k = 0; k < parcels.size(); ++k) parcels[k].bytes = std::move(received[k]);
  }

 private:
  enum Tag : int { gathered, exchanged };
  static constexpr std::size_t most = std::size_t{1} << 30;  ///< bytes of one message: MPI counts in int
  static constexpr std::size_t room_in_head = 512 - sizeof(std::uint64_t);

  static std::int64_t nanoseconds() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }
  /// While it lives, this process may wait for another.
  class Waiting {
   public:
    explicit Waiting(std::atomic<std::int64_t>& since) : since_(since) { since_ = nanoseconds(); }
    ~Waiting() { since_ = 0; }
    Waiting(const Waiting&) = delete;
    Waiting& operator=(const Waiting&) = delete;

   private:
    std::atomic<std::int64_t>& since_;
  };

  /// Calls done() until it says so. MPI would wait with a processor at full speed; soon somebody else may need that, perhaps the
  /// process that is waited for. It sleeps then, and neither it nor MPI yields: a scheduler lets a sleeper that wakes come before
  /// those that have run all the time, and one that yields after them, at every message. Sleeps are short, since a long message
  /// takes several calls on both sides.
  template <class Done>
  void poll(Done&& done) {
    using namespace std::chrono_literals;
    using Clock = std::chrono::steady_clock;
    const Clock::time_point began = Clock::now();
    while (!done()) {
      const Clock::duration waited = Clock::now() - began;
      if (waited > 20us) std::this_thread::sleep_for(waited < 200ms ? 20us : 500us);
    }
  }
  void wait(std::vector<MPI_Request>& requests) {
    poll([&] {
      int done = 0;
      MPI_Testall(static_cast<int>(requests.size()), requests.data(), &done, MPI_STATUSES_IGNORE);
      return done != 0;
    });
  }
  void broadcast(char* bytes, int size) {
    std::vector<MPI_Request> request(1);
    MPI_Ibcast(bytes, size, MPI_CHAR, 0, of_ranks_, request.data());
    wait(request);
  }
  /// Begins to send bytes, which must stay until the requests are done: as one message, or as many with one that is not full at
  /// the end.
  void send_all(int to, Tag tag, const std::string& bytes, std::vector<MPI_Request>& requests) {
    for (std::size_t at = 0; at <= bytes.size(); at += most)
      MPI_Isend(bytes.data() + at, static_cast<int>(std::min(bytes.size() - at, most)), MPI_CHAR, to, tag, of_ranks_,
                &requests.emplace_back());
  }
  [[nodiscard]] std::string receive_all(int from, Tag tag) {
    std::string bytes;
    for (std::size_t part = most; part == most;) {
      MPI_Message message;
      MPI_Status status;
      poll([&] {
        int there = 0;
        MPI_Improbe(from, tag, of_ranks_, &there, &message, &status);
        return there != 0;
      });
      int length = 0;
      MPI_Get_count(&status, MPI_CHAR, &length);
      part = static_cast<std::size_t>(length);
      bytes.resize(bytes.size() + part);
      std::vector<MPI_Request> request(1);
      MPI_Imrecv(bytes.data() + bytes.size() - part, length, MPI_CHAR, &message, request.data());
      wait(request);
    }
    return bytes;
  }

  int rank_ = 0, size_ = 1;
  MPI_Comm of_ranks_ = MPI_COMM_NULL;
  std::atomic<std::int64_t> waiting_since_ = 0;  ///< on the steady clock, ns; 0 where it does not wait
  std::jthread watch_;
};

}  // namespace

std::unique_ptr<Processes> join_by_mpi() { return std::make_unique<MpiProcesses>(); }

}  // namespace carom::cli
