#pragma once
// One file of the user's choice that has its own name only when it is whole: until then it is called NAME.partial.

#include "io/output_error.hpp"

#include <filesystem>
#include <string_view>

namespace carom {

class PartialFile {
 public:
  /// Makes NAME.partial, empty. Throws OutputError where that cannot be, and where NAME is there and is no regular file.
  explicit PartialFile(std::filesystem::path path);
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;
  ~PartialFile();  ///< removes NAME.partial, unless it was published

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] const std::filesystem::path& partial_name() const { return partial_; }

  /// All of its bytes. Throws OutputError.
  void write(std::string_view bytes) const;
  /// Gives it its own name, in place of what had that name. Throws OutputError.
  void publish();

 private:
  std::filesystem::path path_, partial_;
  bool published_ = false;
};

}  // namespace carom
