#pragma once
// The refusal of a scene, before the place in a file is added: the reader of files adds it, and a program has no such place.

#include <carom/scene.hpp>

#include <stdexcept>
#include <string>
#include <utility>

namespace carom::detail {

class Refusal : public std::runtime_error {
 public:
  /// `path`: the full name of a key, "walls.left.mass" or "disks.0.positions.3". It may name more than the scene has: what it
  /// lacks is then the fault of the table that lacks it.
  Refusal(std::string path, const std::string& sentence) : std::runtime_error(sentence), path_(std::move(path)) {}

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// The error of a scene in which `path` is wrong, with the place of that key in the text that the scene was read from, where
/// there is one.
[[nodiscard]] SceneError scene_error(const Scene& scene, const std::string& path, const std::string& sentence);

}  // namespace carom::detail
