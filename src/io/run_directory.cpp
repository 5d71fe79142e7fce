// Creating, checking and filling the directory of a run.

#include "io/run_directory.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <chrono>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace carom {

namespace fs = std::filesystem;

namespace {

/// Asks the system to bring a file or directory to the disk. File systems that cannot do that say EINVAL.
void synchronise(const fs::path& path, int flags) {
  const int descriptor = ::open(path.c_str(), flags | O_CLOEXEC);
  if (descriptor < 0) throw detail::system_error(path, "open it", errno);
  const int error = ::fsync(descriptor) == 0 || errno == EINVAL ? 0 : errno;
  ::close(descriptor);
  if (error != 0) throw detail::system_error(path, "bring it to the disk", error);
}

bool is_checkpoint(std::string_view product) { return product == checkpoint_name || product == previous_checkpoint_name; }

constexpr const char* another_place = ", or name another directory with --out";

/// Written row by row while a run lasts.
bool grows(std::string_view product) {
  return product == "trajectory.h5md" || product == "trajectory.xyz" || product == "samples.csv";
}

}  // namespace

RunDirectory::RunDirectory(fs::path path, bool force, std::span<const std::string_view> products, LockHolder holder)
    : path_(std::move(path)), products_(products), otherwise_(another_place) {
  if (path_.empty()) throw OutputError("the output directory has an empty name; name one with --out");
  try {
    take(force, holder);
    if (force) {
      for (const std::string_view product : products_) {
        for (const fs::path& old : {final_name(product), partial_name(product)}) {
          std::error_code error;
          fs::remove(old, error);
          if (error) throw refusal(old, "remove what an earlier run wrote", error.value());
        }
      }
    }
  } catch (...) {
    discard_if_empty();
    throw;
  }
}

void RunDirectory::require_free(const fs::path& path, bool force) {
  std::error_code error;
  if (!fs::exists(path, error)) return;
  RunDirectory directory(path);
  directory.otherwise_ = another_place;
  directory.take(force, LockHolder::process);
}

void RunDirectory::take(bool force, LockHolder holder) {
  create();
  lock(holder);
  check_for_results(force);
  check_writable();
}

RunDirectory RunDirectory::reopen(fs::path path) {
  std::error_code error;
  if (!fs::is_directory(path, error))
    throw OutputError(fmt::format("{}: there is no such directory; name one that carom run has written", path.string()));
  RunDirectory directory(std::move(path));
  directory.lock(LockHolder::process);
  directory.check_writable();
  return directory;
}

/// Locks the directory itself, so that no file is left behind; the system releases the lock when the process ends in any way.
/// File systems without locks have none.
void RunDirectory::lock(LockHolder holder) {
  using namespace std::chrono_literals;
  const bool inherited = holder == LockHolder::process_and_children;
  const int descriptor = ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | (inherited ? 0 : O_CLOEXEC));
  if (descriptor < 0) return;  // the first write reports what is wrong
  lock_ = {nullptr, [descriptor](const void*) { ::close(descriptor); }};
  constexpr auto pause = 20ms;
  for (auto left = inherited ? 2000ms : 0ms; ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK; left -= pause) {
    if (left <= 0ms)
      throw OutputError(
          fmt::format("{}: another process is writing into this directory; wait for its end{}", path_.string(), otherwise_));
    std::this_thread::sleep_for(pause);
  }
}

OutputError RunDirectory::refusal(const fs::path& path, std::string_view action, int error_number) const {
  return OutputError(detail::system_error(path, action, error_number).what() + otherwise_);
}

fs::path RunDirectory::final_name(std::string_view product) const { return path_ / product; }

fs::path RunDirectory::partial_name(std::string_view product) const { return path_ / fmt::format("{}.partial", product); }

void RunDirectory::create() {
  std::error_code error;
  const fs::file_status status = fs::status(path_, error);
  if (fs::is_directory(status)) return;
  if (fs::exists(status))
    throw OutputError(
        fmt::format("{}: this is a file, and the results need a directory; name another one with --out", path_.string()));

  std::vector<fs::path> missing;  // the deepest first
  for (fs::path part = path_; !part.empty() && fs::symlink_status(part, error).type() == fs::file_type::not_found;
       part = part.parent_path()) {
    if (part.has_filename()) missing.push_back(part);  // "a/b/" and "a/b" are the same directory
    if (part == part.parent_path()) break;
  }
  for (auto part = missing.rbegin(); part != missing.rend(); ++part) {
    if (fs::create_directory(*part, error)) created_.push_back(*part);
    if (error) throw refusal(path_, "create the output directory", error.value());
  }
  if (!fs::is_directory(path_, error)) throw refusal(path_, "create the output directory", error ? error.value() : ENOTDIR);
}

void RunDirectory::check_for_results(bool force) const {
  for (const std::string_view product : products_) {
    for (const fs::path& old : {final_name(product), partial_name(product)}) {
      std::error_code error;
      const fs::file_status status = fs::symlink_status(old, error);
      if (!fs::exists(status)) continue;
      if (fs::is_directory(status))
        throw OutputError(
            fmt::format("{}: a directory is where a result belongs; name another output directory with --out", old.string()));
      if (force) continue;
      const bool whole = old == final_name(product);
      if (fs::exists(final_name(checkpoint_name), error) && !fs::exists(final_name(run_products.back()), error))
        throw OutputError(
            fmt::format("{}: the directory holds a run that can go on: carom resume {} does; or replace it with --force, or name "
                        "another directory with --out",
                        path_.string(), path_.string()));
      throw OutputError(fmt::format(
          "{}: the directory already holds {} ({}); replace it with --force, or name another directory with --out",
          path_.string(), whole ? "results" : "what is left of a run that did not end, or still runs", old.filename().string()));
    }
  }
}

void RunDirectory::check_writable() const {
  std::string probe = (path_ / ".carom-XXXXXX").string();
  const int descriptor = ::mkostemp(probe.data(), O_CLOEXEC);
  if (descriptor < 0) throw refusal(path_, "write into the output directory", errno);
  ::close(descriptor);
  ::unlink(probe.c_str());
}

void RunDirectory::take_back() const {
  // The summary first: a run that has one is complete.
  for (auto product = products_.rbegin(); product != products_.rend(); ++product) {
    const fs::path finished = final_name(*product);
    std::error_code error;
    if (!fs::exists(finished, error) || is_checkpoint(*product)) continue;
    if (grows(*product))
      fs::rename(finished, partial_name(*product), error);
    else
      fs::remove(finished, error);
    if (error) throw detail::system_error(finished, "make room for the run to go on", error.value());
  }
}

void RunDirectory::synchronise_partial(std::string_view product) const { synchronise(partial_name(product), O_RDONLY); }

void RunDirectory::publish(std::string_view product) const {
  const fs::path partial = partial_name(product);
  synchronise_partial(product);
  std::error_code error;
  fs::rename(partial, final_name(product), error);
  if (error) throw detail::system_error(partial, fmt::format("rename it to {}", product), error.value());
  synchronise(path_, O_RDONLY | O_DIRECTORY);
}

void RunDirectory::discard_if_empty() const noexcept {
  // rmdir refuses a directory that is not empty, which is the check that is wanted
  for (auto part = created_.rbegin(); part != created_.rend(); ++part) ::rmdir(part->c_str());
}

}  // namespace carom
