#pragma once
// The options that say which scene is meant, and what of it is changed on the command line.

#include <carom/scene.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace carom::cli {

class SceneOptions {
 public:
  void add_to(CLI::App& command);

  /// The scene as asked for. Throws SceneError.
  [[nodiscard]] Scene load() const;

  [[nodiscard]] const std::string& path() const { return path_; }

  /// "auto", or one of engine_names(). Throws UsageError where the user named another.
  [[nodiscard]] const std::string& engine() const;

 private:
  std::string path_;
  std::vector<std::string> overrides_;
  std::optional<std::uint64_t> seed_;
  std::string engine_ = "auto";
  bool no_trajectory_ = false;
  bool xyz_ = false;
  bool csv_ = false;
  bool events_ = false;
  bool unwrapped_ = false;
};

}  // namespace carom::cli
