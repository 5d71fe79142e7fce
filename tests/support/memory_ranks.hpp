#pragma once
// Ranks that are threads of one process, and leave their messages in memory: what MPI does between processes, without MPI.

#include <carom/ranks.hpp>

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace carom::test {

/// Boxes of messages, one from each rank to each.
class Mailboxes {
 public:
  void send(int from, int to, std::string message) {
    const std::lock_guard lock(mutex_);
    boxes_[{from, to}].push_back(std::move(message));
    arrived_.notify_all();
  }
  [[nodiscard]] std::string receive(int from, int to) {
    std::unique_lock lock(mutex_);
    std::deque<std::string>& box = boxes_[{from, to}];
    arrived_.wait(lock, [&] { return !box.empty(); });
    std::string message = std::move(box.front());
    box.pop_front();
    return message;
  }

 private:
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::map<std::pair<int, int>, std::deque<std::string>> boxes_;
};

class MemoryRanks final : public carom::Ranks {
 public:
  MemoryRanks(Mailboxes& mailboxes, int rank, int size) : mailboxes_(mailboxes), rank_(rank), size_(size) {}

  [[nodiscard]] int rank() const override { return rank_; }
  [[nodiscard]] int size() const override { return size_; }
  void broadcast(std::string& bytes) override {
    if (rank_ != 0) return void(bytes = mailboxes_.receive(0, rank_));
    for (int to = 1; to < size_; ++to) mailboxes_.send(0, to, on_the_way ? on_the_way(to, bytes) : bytes);
  }
  [[nodiscard]] std::vector<std::string> gather(const std::string& bytes) override {
    if (rank_ != 0) return mailboxes_.send(rank_, 0, bytes), std::vector<std::string>();
    std::vector<std::string> all = {bytes};
    for (int from = 1; from < size_; ++from) all.push_back(mailboxes_.receive(from, 0));
    return all;
  }
  void exchange(std::span<Parcel> parcels) override {
    ++exchanges;
    for (Parcel& parcel : parcels) mailboxes_.send(rank_, parcel.rank, std::move(parcel.bytes));
    for (Parcel& parcel : parcels) parcel.bytes = mailboxes_.receive(parcel.rank, rank_);
  }

  /// Changes what rank 0 sends to another; may be empty.
  std::function<std::string(int to, const std::string& bytes)> on_the_way = {};
  std::uint64_t exchanges = 0;

 private:
  Mailboxes& mailboxes_;
  int rank_, size_;
};

/// Ranks of which this thread has the first, and the others serve it on threads of their own until this is destroyed.
class ServingRanks {
 public:
  explicit ServingRanks(int size) {
    for (int rank = 0; rank < size; ++rank) ranks_.push_back(std::make_unique<MemoryRanks>(mailboxes_, rank, size));
    for (int rank = 1; rank < size; ++rank)
      threads_.emplace_back([this, rank] { serve_ranks(*ranks_[static_cast<std::size_t>(rank)]); });
  }
  ~ServingRanks() {
    dismiss_ranks(*ranks_.front());
    for (std::thread& thread : threads_) thread.join();
  }
  ServingRanks(const ServingRanks&) = delete;
  ServingRanks& operator=(const ServingRanks&) = delete;

  [[nodiscard]] MemoryRanks& first() { return *ranks_.front(); }

 private:
  Mailboxes mailboxes_;
  std::vector<std::unique_ptr<MemoryRanks>> ranks_;
  std::vector<std::thread> threads_;
};

}  // namespace carom::test
