#include "studies/sweep/directory_lock.hpp"

#include "io/output_error.hpp"
#include "terminal/command.hpp"

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <thread>

namespace carom::cli {

DirectoryLock::DirectoryLock(const std::filesystem::path& directory) {
  using namespace std::chrono_literals;
  const std::filesystem::path file = directory / ".lock";
  descriptor_ = open(file.c_str(), O_RDWR | O_CREAT, 0666);  // without O_CLOEXEC: children hold it too
  if (descriptor_ < 0) throw UsageError(detail::system_error(file, "create it", errno).what());
  constexpr auto pause = 20ms;
  for (auto waited = 0ms; flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK; waited += pause) {
    if (waited < 2000ms) {
      std::this_thread::sleep_for(pause);
      continue;
    }
    close(descriptor_);
    throw UsageError(
        fmt::format("{}: another sweep is writing into this directory; wait for its end, or name another one with --out",
                    directory.string()));
  }
}

DirectoryLock::~DirectoryLock() { close(descriptor_); }

}  // namespace carom::cli
