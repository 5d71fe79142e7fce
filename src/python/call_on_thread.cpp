// A call that Ctrl-C and other signals reach while it works, wherever it is.

#include "python/parts.hpp"

#include <nanobind/nanobind.h>

#include <chrono>
#include <condition_variable>
#include <csignal>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

namespace carom::python {

namespace nb = nanobind;

namespace {

/// Whether a thread has come to its end.
class Ended {
 public:
  void tell() {
    const std::lock_guard lock(mutex_);
    told_ = true;
    changed_.notify_all();
  }
  /// Waits for a hundredth of a second at most.
  [[nodiscard]] bool wait() {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::milliseconds(10), [this] { return told_; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool told_ = false;
};

/// Does as wait() while other threads of Python run.
bool waited_for(Ended& ended) {
  const nb::gil_scoped_release released;
  return ended.wait();
}

/// Calls `work`, which raises nothing, on a thread of its own, and waits for its end. What handlers of signals raise meanwhile is
/// given to `raised`, which ends the work; a second Ctrl-C is raised at once and leaves the work behind. Handlers run here, and
/// not within code of Python that waits with locks.
void call_on_thread(nb::object work, const nb::object& raised) {
  const auto ended = std::make_shared<Ended>();
  std::thread thread([ended, work = std::move(work)]() mutable {
    {
      const nb::gil_scoped_acquire locked;
      try {
        work();
      } catch (nb::python_error& error) {
        error.discard_as_unraisable("carom.run");
      }
      work.reset();
    }
    ended->tell();
  });
  int interrupts = 0;
  while (!waited_for(*ended)) {
    if (PyErr_CheckSignals() == 0) continue;
    nb::python_error error;
    interrupts += error.matches(PyExc_KeyboardInterrupt) ? 1 : 0;
    if (interrupts > 1) {
      thread.detach();
      // Python must not end while the thread is in it.
      nb::module_::import_("atexit").attr("register")(nb::cpp_function([ended] {
        while (!waited_for(*ended))
          if (PyErr_CheckSignals() != 0) {  // a third Ctrl-C
            std::signal(SIGINT, SIG_DFL);
            std::raise(SIGINT);
          }
      }));
      throw error;
    }
    raised(error.value());
  }
  const nb::gil_scoped_release released;
  thread.join();
}

}  // namespace

void add_call_on_thread(nb::module_& module) {
  module.def("call_on_thread", &call_on_thread, nb::arg("work"), nb::arg("raised"));
}

}  // namespace carom::python
