#pragma once
// Manual pages on the terminal and in files.

#include "terminal/command.hpp"

#include <string>
#include <vector>

namespace carom::cli {

/// Shows the page by man(1) where the output is a terminal; prints its source elsewhere, and where there is no man(1).
ExitCode show_manual_page(const std::string& text);

struct ManualPage {
  std::string file;  ///< "carom-run.1"
  std::string text;
};

/// Writes the pages to the directory, which is made where it is missing. Throws UsageError.
ExitCode write_manual_pages(const std::string& directory, const std::vector<ManualPage>& pages);

}  // namespace carom::cli
