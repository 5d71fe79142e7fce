#include "studies/sweep/ranks.hpp"

#include <fmt/format.h>

#include <atomic>
#include <charconv>
#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace carom::cli {

namespace {

using namespace std::chrono_literals;

/// ask -> order, again and again; ended after each run; leaving -> home at the end. stop may come at any time.
enum Kind : int { ask, order, ended, leaving, stop_runs, home };

// MPI would wait for a message with a processor at full speed, and there is a run that needs it.
constexpr auto pause = 1ms;

constexpr char separator = '\0';  // neither a path nor a scene has one

std::string text_of(const RunOrder& one) {
  return fmt::format("{}{}{}{}{}{}{}", one.run, separator, one.directory.string(), separator, one.checkpoint_every, separator,
                     one.scene);
}
std::string text_of(std::size_t run, const RunOutcome& outcome) {
  return fmt::format("{}{}{}{}{}", run, separator, outcome.finished ? 1 : 0, separator, outcome.failure);
}

/// The parts between the separators, and the number in front.
struct Parts {
  std::size_t run = 0;
  std::vector<std::string> texts;
};
Parts parts_of(const std::string& message) {
  Parts parts;
  std::from_chars(message.data(), message.data() + message.size(), parts.run);
  for (std::size_t end = message.find(separator); end != std::string::npos;) {
    const std::size_t begin = end + 1;
    end = message.find(separator, begin);
    parts.texts.push_back(message.substr(begin, end == std::string::npos ? end : end - begin));
  }
  return parts;
}

}  // namespace

void SweepServer::to_all(int kind) {
  for (int rank = 1; rank < ranks_.size(); ++rank) ranks_.send(rank, kind, "");
}

void SweepServer::answer(const Message& message, const RunSource& source) {
  if (message.kind == leaving) {
    --working_;
  } else if (message.kind == ask) {
    const std::optional<RunOrder> next = source.next();
    ranks_.send(message.from, order, next ? text_of(*next) : "");
  } else if (message.kind == ended) {
    const Parts parts = parts_of(message.text);
    source.done({.run = parts.run, .directory = {}, .scene = {}, .checkpoint_every = {}},
                {.finished = parts.texts.at(0) == "1", .failure = parts.texts.at(1)});
  }
}

void SweepServer::serve(const RunSource& source, const std::function<bool()>& done_here, const std::function<bool()>& stop) {
  while (working_ > 0 || !done_here()) {
    if (!stopping_ && stop()) {
      to_all(stop_runs);
      stopping_ = true;
    }
    if (const std::optional<Message> message = ranks_.receive({})) {
      answer(*message, source);
    } else {
      std::this_thread::sleep_for(pause);
    }
  }
}

SweepServer::~SweepServer() {
  const RunSource closed{.next = [] { return std::nullopt; }, .done = [](const RunOrder&, const RunOutcome&) {}};
  serve(
      closed, [] { return true; }, [] { return true; });
  to_all(home);
}

ExitCode work_for_first_rank(Processes& ranks, int threads) {
  const StopRequest stop;
  std::mutex mutex;  // one thread at a time may use MPI
  std::atomic<bool> told_to_stop = false;
  const auto send = [&](int kind, const std::string& text) {
    const std::scoped_lock lock(mutex);
    ranks.send(0, kind, text);
  };
  const auto receive = [&](int kind) {
    const std::scoped_lock lock(mutex);
    return ranks.receive(kind);
  };
  const auto wait_for = [&](int kind) {
    for (;;) {
      if (std::optional<Message> message = receive(kind)) return *std::move(message);
      std::this_thread::sleep_for(pause);
    }
  };
  const auto go_on = [&] {
    if (receive(stop_runs)) told_to_stop = true;
    return !told_to_stop;
  };
  RunSource source;
  source.next = [&]() -> std::optional<RunOrder> {
    if (stop.made() || !go_on()) return {};
    send(ask, "");
    const Message message = wait_for(order);
    if (message.text.empty()) return {};
    const Parts parts = parts_of(message.text);
    return RunOrder{
        .run = parts.run, .directory = parts.texts.at(0), .scene = parts.texts.at(2), .checkpoint_every = parts.texts.at(1)};
  };
  source.done = [&](const RunOrder& done, const RunOutcome& outcome) { send(ended, text_of(done.run, outcome)); };
  run_in_threads(threads, source, [&](const RunOrder& one) { return carry_out(one, stop, go_on); });
  send(leaving, "");
  (void)wait_for(home);
  while (receive(stop_runs)) continue;  // MPI wants every message received
  return exit_done;
}

}  // namespace carom::cli
