#include "parallel/team.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <stdexcept>
#include <system_error>

namespace carom {

Team::Team(std::size_t threads) : barrier_(static_cast<std::ptrdiff_t>(std::max<std::size_t>(threads, 1)), CallLead{this}) {
  threads_.reserve(threads);
  try {
    for (std::size_t thread = 1; thread < threads; ++thread) threads_.emplace_back([this, thread] { serve(thread); });
  } catch (const std::system_error&) {
    const std::size_t begun = size();
    for (std::size_t missing = begun; missing < threads; ++missing) barrier_.arrive_and_drop();
    end();
    throw std::runtime_error(fmt::format("the system lets this program have {} threads, not {}; give fewer, such as --threads {}",
                                         begun, threads, begun));
  }
}

Team::~Team() { end(); }

void Team::serve(std::size_t thread) {
  for (;;) {
    barrier_.arrive_and_wait();
    if (over_) return;
    (*work_)(thread);
    barrier_.arrive_and_wait();
  }
}

void Team::end() {
  over_ = true;
  barrier_.arrive_and_wait();
  for (std::thread& thread : threads_) thread.join();
}

void Team::run(const std::function<void(std::size_t)>& work) {
  work_ = &work;
  barrier_.arrive_and_wait();
  work(0);
  barrier_.arrive_and_wait();
}

std::string Team::Failure::words_of(const std::exception_ptr& exception) {
  try {
    std::rethrow_exception(exception);
  } catch (const std::bad_alloc&) {
    return "there is not enough memory";
  } catch (const std::exception& error) {
    return error.what();
  } catch (...) {
    return "an unknown error";
  }
}

}  // namespace carom
