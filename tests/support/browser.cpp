// Runs Chromium for a page, with a profile of its own that is gone afterwards.

#include "support/browser.hpp"

#include "support/child_process.hpp"

#include <sstream>
#include <stdexcept>
#include <vector>

namespace carom::test {

namespace fs = std::filesystem;

bool has_browser() { return run_program(fs::temp_directory_path(), {"chromium", "--version"}).exit_code == 0; }

namespace {

Outcome run_browser(const fs::path& page, Screen screen, int seconds, const std::vector<std::string>& more) {
  const TemporaryDirectory profile;
  const std::string colours = screen == Screen::dark ? "0" : "1";  // Chromium's own numbers
  std::vector<std::string> words = {"timeout",
                                    "--kill-after=5",
                                    "120",
                                    "env",
                                    "HOME=" + profile.path().string(),
                                    "chromium",
                                    "--headless=new",
                                    "--no-sandbox",  // which root does not get, and containers seldom
                                    "--disable-gpu",
                                    "--disable-dev-shm-usage",
                                    "--no-first-run",
                                    "--disable-background-networking",
                                    "--host-resolver-rules=MAP * ~NOTFOUND",
                                    "--user-data-dir=" + profile.path().string(),
                                    "--blink-settings=preferredColorScheme=" + colours,
                                    "--virtual-time-budget=" + std::to_string(1000 * seconds)};
  words.insert(words.end(), more.begin(), more.end());
  words.insert(words.end(), {"--dump-dom", "file://" + fs::absolute(page).string()});
  Outcome outcome = run_program(profile.path(), words);
  if (outcome.exit_code != 0) {
    throw std::runtime_error("chromium ended with " + std::to_string(outcome.exit_code) + ":\n" + outcome.err);
  }
  return outcome;
}

/// Of all that the browser says on stderr, what pages said.
std::string console_of(const std::string& log) {
  std::istringstream lines(log);
  std::string found;
  for (std::string line; std::getline(lines, line);)
    if (line.find("CONSOLE") != std::string::npos) found += line + "\n";
  return found;
}

}  // namespace

std::string dump_dom(const fs::path& page, Screen screen, int seconds) { return run_browser(page, screen, seconds, {}).out; }

Visit visit(const fs::path& page, Screen screen, int seconds) {
  const Outcome outcome = run_browser(
      page, screen, seconds,
      {"--enable-logging=stderr", "--window-size=1280,800", "--enable-precise-memory-info", "--js-flags=--expose-gc"});
  return {outcome.out, console_of(outcome.err)};
}

}  // namespace carom::test
