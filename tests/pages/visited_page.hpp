#pragma once
// What tests of pages in a browser share: scripts that ask a page, and the answers that it leaves as data of its document.

#include "support/browser.hpp"
#include "support/temporary_directory.hpp"

#include <carom/simulation.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace carom::test {

/// A script of tests/pages.
inline std::string script(const std::string& name) {
  return text_of(std::filesystem::path(CAROM_SOURCE_DIR) / "tests/pages" / name);
}

/// data-NAME of the document
inline std::string data(const Visit& visit, const std::string& name) {
  const std::string root = visit.dom.substr(0, visit.dom.find('>', visit.dom.find("<html")));
  const std::string key = "data-" + name + "=\"";
  const std::size_t from = root.find(key);
  if (from == std::string::npos) return "there is no data-" + name;
  return root.substr(from + key.size(), root.find('"', from + key.size()) - from - key.size());
}

/// A page in the browser, after `script` ran behind its own.
inline Visit visit_with(std::string html, const std::string& script, int seconds = 5) {
  const TemporaryDirectory directory;
  html.insert(html.rfind("</body>"), "<script>\n{\n" + script + "}\n</script>\n");
  write_text(directory.path() / "page.html", html);
  return visit(directory.path() / "page.html", Screen::light, seconds);
}

/// What a simulation has at these times, for player_pictures.js.
inline std::string states_at(Simulation simulation, const std::vector<double>& times) {
  nlohmann::json states = nlohmann::json::array();
  for (const double time : times) {
    simulation.run_until(time);
    const State state = simulation.state();
    const Box box = box_of(simulation.scene().box, state);
    nlohmann::json positions = nlohmann::json::array();
    for (Eigen::Index i = 0; i < state.positions.cols(); ++i) positions.push_back({state.positions(0, i), state.positions(1, i)});
    states.push_back({{"time", time},
                      {"positions", positions},
                      {"walls", {box.lower.x(), box.upper.x(), box.lower.y(), box.upper.y()}},
                      {"scale", state.scale}});
  }
  return "const expected = " + states.dump() + ";\n";
}

inline void expect_clean(const Visit& visit) {
  EXPECT_THAT(visit.console, ::testing::IsEmpty());
  EXPECT_EQ(data(visit, "errors"), "");
}

}  // namespace carom::test
