#pragma once
// A directory with a scene, gas.toml, and sweep files beside it.

#include "support/program_test.hpp"
#include "support/refusal.hpp"

#include "studies/sweep/sweep.hpp"

#include <string>

namespace carom::test {

class SweepFiles {
 public:
  SweepFiles() { write_text(directory_.file("gas.toml"), fifty_disks); }

  [[nodiscard]] const TemporaryDirectory& directory() const { return directory_; }
  [[nodiscard]] Sweep load(const std::string& text) const {
    write_text(directory_.file("sweep.toml"), text);
    return load_sweep(directory_.file("sweep.toml"));
  }
  /// What load_sweep says of it, behind the path of the directory; empty where nothing is wrong.
  [[nodiscard]] std::string refusal(const std::string& text) const {
    const std::string said = test::refusal<SceneError>([&] { return load(text); });
    return said.empty() ? said : said.substr(directory_.path().string().size() + 1);
  }

 private:
  TemporaryDirectory directory_;
};

}  // namespace carom::test
