#include "terminal/open_page.hpp"

#include "io/child_process.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <string>

namespace carom::cli {

void open_page(const std::filesystem::path& path) {
  const std::string page = std::filesystem::absolute(path).string();
  if (ChildProcess("/usr/bin/env", {"env", "xdg-open", page}, {}).wait() == 0) return;
  fmt::print(stderr, "carom: no browser could be started by xdg-open; open {} in one yourself\n", page);
}

}  // namespace carom::cli
