#pragma once
// A line on stderr that is rewritten in place, where that is a terminal.

#include <unistd.h>

#include <cstdio>
#include <string>

namespace carom::cli {

class StatusLine {
 public:
  StatusLine() = default;
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;
  ~StatusLine() { show(""); }
  void show(const std::string& text) const {
    if (!terminal_) return;
    std::fprintf(stderr, "\r\x1b[K%s", text.c_str());
    std::fflush(stderr);
  }

 private:
  bool terminal_ = isatty(STDERR_FILENO) == 1;
};

}  // namespace carom::cli
