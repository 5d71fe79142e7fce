#pragma once
// The threads of one run: they do the same at the same time, each for its own domains, and meet in between.

#include <barrier>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace carom {

class Team {
 public:
  /// Throws where the system refuses so many threads.
  explicit Team(std::size_t threads);
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;
  ~Team();

  [[nodiscard]] std::size_t size() const { return threads_.size() + 1; }

  /// Calls work(thread) on all threads, the calling one is thread 0, and returns when all have returned. What is thrown must have
  /// been caught by then: see Failure.
  void run(const std::function<void(std::size_t)>& work);

  /// Waits until all threads are here, and calls `lead` on one of them before any goes on. Only inside run(); all threads give
  /// equal functions.
  template <class Lead>
  void meet(std::size_t thread, Lead&& lead) {
    if (thread == 0) lead_ = [&lead] { lead(); };
    barrier_.arrive_and_wait();
  }

  /// Keeps the first of the exceptions that are caught on any thread, and throws it later on one.
  class Failure {
   public:
    void keep_current() {
      const std::lock_guard lock(mutex_);
      if (!first_) first_ = std::current_exception();
    }
    [[nodiscard]] bool any() {
      const std::lock_guard lock(mutex_);
      return static_cast<bool>(first_);
    }
    void rethrow() {
      if (first_) std::rethrow_exception(std::exchange(first_, nullptr));
    }
    /// Returns the words of the exception, for another process; empty where there is none.
    [[nodiscard]] std::string words() {
      const std::lock_guard lock(mutex_);
      return first_ ? words_of(first_) : std::string();
    }
    void forget() {
      const std::lock_guard lock(mutex_);
      first_ = nullptr;
    }

   private:
    [[nodiscard]] static std::string words_of(const std::exception_ptr& exception);

    std::mutex mutex_;
    std::exception_ptr first_;
  };

 private:
  struct CallLead {
    Team* team;
    void operator()() noexcept {
      if (const std::function<void()> lead = std::exchange(team->lead_, nullptr)) lead();
    }
  };

  void serve(std::size_t thread);
  void end();

  std::function<void()> lead_;
  std::barrier<CallLead> barrier_;
  const std::function<void(std::size_t)>* work_ = nullptr;
  bool over_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace carom
