// Runs Chromium for a page, with a profile of its own that is gone afterwards.

#include "support/browser.hpp"

#include "support/child_process.hpp"

#include <stdexcept>

namespace carom::test {

namespace fs = std::filesystem;

bool has_browser() { return run_program(fs::temp_directory_path(), {"chromium", "--version"}).exit_code == 0; }

std::string dump_dom(const fs::path& page, Screen screen, int seconds) {
  const TemporaryDirectory profile;
  const std::string colours = screen == Screen::dark ? "0" : "1";  // Chromium's own numbers
  const Outcome outcome =
      run_program(profile.path(),
                  {"timeout", "--kill-after=5", "120", "env", "HOME=" + profile.path().string(), "chromium", "--headless=new",
                   "--no-sandbox",  // which root does not get, and containers seldom
                   "--disable-gpu", "--disable-dev-shm-usage", "--no-first-run", "--disable-background-networking",
                   "--host-resolver-rules=MAP * ~NOTFOUND", "--user-data-dir=" + profile.path().string(),
                   "--blink-settings=preferredColorScheme=" + colours, "--virtual-time-budget=" + std::to_string(1000 * seconds),
                   "--dump-dom", "file://" + fs::absolute(page).string()});
  if (outcome.exit_code != 0) {
    throw std::runtime_error("chromium ended with " + std::to_string(outcome.exit_code) + ":\n" + outcome.err);
  }
  return outcome.out;
}

}  // namespace carom::test
