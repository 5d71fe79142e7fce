#pragma once
// Two programs that would write into one directory at the same time.

#include <filesystem>

namespace carom::cli {

/// Held from construction to destruction, by this process and by the children that it starts meanwhile: after a kill it is free
/// when the last of them is gone. File systems without locks lock nothing.
class DirectoryLock {
 public:
  /// Locks a directory, which must exist. Waits up to two seconds, in which a process that was killed disappears; then throws
  /// UsageError where another process holds the lock.
  explicit DirectoryLock(const std::filesystem::path& directory);
  ~DirectoryLock();
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace carom::cli
