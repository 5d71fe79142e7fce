#include "terminal/standard_output.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>

namespace carom::cli {

void flush_output() {
  const int error = std::fflush(stdout) == 0 ? 0 : errno;
  if (error == 0 && std::ferror(stdout) == 0) return;
  // An error of an earlier write is remembered, but not its reason.
  throw std::runtime_error(
      fmt::format("cannot write to standard output: {}", error == 0 ? "some of it was lost" : std::strerror(error)));
}

void print_whole(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
  flush_output();
}

}  // namespace carom::cli
