// A thread for every run that is going on. They do nothing but wait for child processes, so that there may be more of them than
// processors, which TBB must be told.

#include "studies/sweep/threads.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

#include <cstddef>
#include <utility>

namespace carom::cli {

void run_in_threads(int threads, const RunDesk& desk, const std::function<RunEnd(const RunOrder&)>& work) {
  using tbb::filter_mode;
  using Ended = std::pair<RunOrder, RunEnd>;
  const auto take = [&](tbb::flow_control& flow) {
    std::optional<RunOrder> order = desk.next();
    if (!order) flow.stop();
    return order ? *std::move(order) : RunOrder();
  };
  const auto carry_out = [&](RunOrder order) {
    RunEnd end = work(order);
    return Ended(std::move(order), std::move(end));
  };
  const auto give_back = [&](const Ended& ended) { desk.done(ended.first, ended.second); };
  const auto at_once = static_cast<std::size_t>(threads);
  const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism, at_once);
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_pipeline(at_once, tbb::make_filter<void, RunOrder>(filter_mode::serial_in_order, take) &
                                        tbb::make_filter<RunOrder, Ended>(filter_mode::parallel, carry_out) &
                                        tbb::make_filter<Ended, void>(filter_mode::serial_out_of_order, give_back));
  });
}

}  // namespace carom::cli
