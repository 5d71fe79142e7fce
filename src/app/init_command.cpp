// carom init [PRESET]: writes a commented scene to start from.

#include "app/commands.hpp"
#include "scene/presets.hpp"
#include "text/numbers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <carom/scene.hpp>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

namespace carom::cli {

namespace {

void list_presets() {
  std::size_t width = 0;
  for (const std::string& name : preset_names()) width = std::max(width, name.size());
  for (const std::string& name : preset_names()) {
    fmt::print("{:<{}}  {}\n", name, width, parse_scene(preset(name), name).title);
  }
}

/// With `force` an existing file is replaced. Without it, exclusive creation never overwrites a file of another process.
void write_file(const std::string& path, const std::string& text, bool force) {
  std::FILE* file = std::fopen(path.c_str(), force ? "w" : "wx");
  if (file == nullptr) {
    if (errno == EEXIST) throw UsageError(fmt::format("{}: exists already; --force replaces it, -o FILE writes elsewhere", path));
    throw UsageError(fmt::format("{}: cannot be written: {}", path, std::strerror(errno)));
  }
  const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  if (std::fclose(file) != 0 || !written)
    throw std::runtime_error(fmt::format("{}: cannot be written: {}", path, std::strerror(errno)));
}

}  // namespace

ExitCode init(const InitOptions& options, const Invocation& invocation) {
  if (options.list) {
    list_presets();
    return exit_done;
  }
  const std::vector<std::string> names = preset_names();
  if (std::find(names.begin(), names.end(), options.preset) == names.end()) {
    throw UsageError(fmt::format("{}: there is no such preset; choose one of: {}", options.preset, fmt::join(names, ", ")));
  }
  const std::string text = preset(options.preset);
  if (options.file == "-") {
    fmt::print("{}", text);
    return exit_done;
  }
  const std::string path = options.file.empty() ? options.preset + ".toml" : options.file;
  write_file(path, text, options.force);
  if (!options.quiet) fmt::print("{} is written. Look into it, then: {} run {}\n", path, invocation.program, shell_quoted(path));
  return exit_done;
}

}  // namespace carom::cli
