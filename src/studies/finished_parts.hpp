#pragma once
// The finished parts of a long study, one JSON object a line, from which an interrupted study goes on. The first line says which
// study it is.

#include "io/output_error.hpp"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace carom::detail {

/// The words for sentences about such a file: its parts are points of a scene, or trials of a seed.
struct PartWords {
  std::string part;  ///< "point"
  std::string of;    ///< "scene"
};

class FinishedParts {
 public:
  /// Begins a new file with the lines of `before`. They may have come from that very file: it is replaced only when all of them
  /// have been written again. Throws OutputError.
  FinishedParts(std::filesystem::path path, PartWords words, const std::string& key, const std::vector<std::string>& before);

  /// Adds a finished part. It has reached the operating system when this returns.
  void add(const std::string& line);

 private:
  std::filesystem::path path_;
  PartWords words_;
};

/// Hands on every part of a file; a last line that was not finished is left out. Throws OutputError where the file cannot be
/// read, belongs to another study than `key`, or `take` throws an exception of JSON.
void read_finished_parts(const std::filesystem::path& path, const PartWords& words, const std::string& key,
                         const std::function<void(const nlohmann::ordered_json& part)>& take);

}  // namespace carom::detail
