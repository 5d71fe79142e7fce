#pragma once
// Pages that a command opens in the reader's browser once it has written them.

#include <filesystem>

namespace carom::cli {

/// Hands the page to the desktop's browser by xdg-open. Says on stderr what to do where there is none: the page
/// is written all the same.
void open_page(const std::filesystem::path& path);

}  // namespace carom::cli
