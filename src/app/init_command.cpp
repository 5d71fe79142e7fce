// carom init [PRESET]: writes a commented scene to start from.

#include "app/commands.hpp"
#include "scene/presets.hpp"
#include "terminal/output_paths.hpp"
#include "text/numbers.hpp"
#include "text/shell.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <carom/scene.hpp>

#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

namespace carom::cli {

namespace {

void list_presets() {
  std::size_t width = 0;
  for (const std::string& name : preset_names()) width = std::max(width, name.size());
  for (const std::string& name : preset_names()) {
    fmt::print("{:<{}}  {}\n", name, width, parse_scene(preset(name), name).title);
  }
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
  std::error_code error;
  if (!options.force && std::filesystem::exists(std::filesystem::symlink_status(path, error)))
    throw UsageError(fmt::format("{}: exists already; --force replaces it, -o FILE writes elsewhere", path));
  write_whole_file(path, text);
  if (!options.quiet) fmt::print("{} is written. Look into it, then: {} run {}\n", path, invocation.program, shell_quoted(path));
  return exit_done;
}

}  // namespace carom::cli
