// Creating, checking and filling the directory of a run.

#include "io/run_directory.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
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

}  // namespace

RunDirectory::RunDirectory(fs::path path, bool force, std::span<const std::string_view> products)
    : path_(std::move(path)), products_(products) {
  if (path_.empty()) throw OutputError("the output directory has an empty name; name one with --out");
  try {
    create();
    check_for_results(force);
    check_writable();
    if (force) {
      for (const std::string_view product : products_) {
        for (const fs::path& old : {final_name(product), partial_name(product)}) {
          std::error_code error;
          fs::remove(old, error);
          if (error) throw detail::system_error(old, "remove what an earlier run wrote", error.value());
        }
      }
    }
  } catch (...) {
    discard_if_empty();
    throw;
  }
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
    if (error) throw detail::system_error(path_, "create the output directory", error.value());
  }
  if (!fs::is_directory(path_, error))
    throw detail::system_error(path_, "create the output directory", error ? error.value() : ENOTDIR);
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
      throw OutputError(fmt::format(
          "{}: the directory already holds {} ({}); replace it with --force, or name another directory with --out",
          path_.string(), whole ? "results" : "what is left of a run that did not end, or still runs", old.filename().string()));
    }
  }
}

void RunDirectory::check_writable() const {
  std::string probe = (path_ / ".carom-XXXXXX").string();
  const int descriptor = ::mkostemp(probe.data(), O_CLOEXEC);
  if (descriptor < 0) throw detail::system_error(path_, "write into the output directory", errno);
  ::close(descriptor);
  ::unlink(probe.c_str());
}

void RunDirectory::publish(std::string_view product) const {
  const fs::path partial = partial_name(product);
  synchronise(partial, O_RDONLY);
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
