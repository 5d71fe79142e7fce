#pragma once
// A temporary directory, which is removed at the end.

#include <filesystem>

namespace carom::cli {

/// Made below the system's directory for such things (TMPDIR says where), and removed with all that is in it.
class ScratchDirectory {
 public:
  /// Throws UsageError where it cannot be made.
  ScratchDirectory();
  ~ScratchDirectory();
  ScratchDirectory(const ScratchDirectory&) = delete;
  ScratchDirectory& operator=(const ScratchDirectory&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace carom::cli
