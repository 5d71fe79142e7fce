// carom play RUN_DIR: one HTML file that replays a run.

#include "cli/commands.hpp"
#include "cli/reading_process.hpp"
#include "io/info_parts.hpp"
#include "io/partial_file.hpp"
#include "show/player_page.hpp"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace carom::cli {

namespace fs = std::filesystem;

namespace {

bool is_player(const fs::path& path) {
  std::array<char, 512> begin{};
  std::ifstream file(path, std::ios::binary);
  file.read(begin.data(), begin.size());
  return std::string_view(begin.data(), static_cast<std::size_t>(file.gcount())).find(player_mark) != std::string_view::npos;
}

fs::path place_for(const PlayOptions& options) {
  const fs::path path = options.output.empty() ? fs::path(options.directory) / "player.html" : fs::path(options.output);
  if (path.extension() != ".html" && path.extension() != ".htm")
    throw UsageError(
        fmt::format("-o {}: the player is an HTML page and nothing else; give it a name that ends in .html", path.string()));
  std::error_code error;
  if (fs::is_directory(path, error))
    throw UsageError(fmt::format("-o {}: this is a directory; name a file in it", path.string()));
  if (fs::exists(path, error) && !is_player(path))
    throw UsageError(
        fmt::format("{}: this file is there already, and is no player; name another one with -o, or remove it", path.string()));
  return path;
}

PartialFile begin(const fs::path& path) {
  try {
    return PartialFile(path);
  } catch (const OutputError& error) {
    throw UsageError(error.what());
  }
}

PlayerData read(const std::string& directory) {
  const ReadingLimit limit(directory);
  try {
    return player_data(RunReader(directory));
  } catch (const OutputError& error) {
    throw UsageError(error.what());
  }
}

ExitCode write_player(const PlayOptions& options) {
  const PlayerData data = read(options.directory);
  const fs::path path = place_for(options);
  PartialFile file = begin(path);
  file.write(player_page(data));
  file.publish();
  fmt::print("{}  {}, {}\n", path.string(), detail::size_text(fs::file_size(path)),
             data.exact ? "an exact replay, from collision to collision"
                        : fmt::format("interpolated between samples: {}", data.why_not));
  return exit_done;
}

}  // namespace

ExitCode play(const PlayOptions& options) {
  return in_reading_process(options.directory, [&] { return write_player(options); });
}

}  // namespace carom::cli
