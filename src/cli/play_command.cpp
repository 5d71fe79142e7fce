// carom play RUN_DIR: one HTML file that replays a run.

#include "cli/commands.hpp"
#include "io/info_parts.hpp"
#include "show/player_page.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
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

/// Under its own name only when it is whole.
void write(const fs::path& path, const std::string& text) {
  const fs::path partial = path.string() + ".partial";
  std::ofstream file(partial, std::ios::binary);
  if (!file) throw UsageError(detail::system_error(path, "write", errno).what());
  file << text;
  file.close();
  std::error_code error;
  if (file) fs::rename(partial, path, error);
  if (file && !error) return;
  const int reason = error ? error.value() : errno;
  fs::remove(partial, error);
  throw OutputError(detail::system_error(path, "write", reason));
}

PlayerData read(const std::string& directory) {
  try {
    return player_data(RunReader(directory));
  } catch (const OutputError& error) {
    throw UsageError(error.what());
  }
}

}  // namespace

ExitCode play(const PlayOptions& options) {
  const PlayerData data = read(options.directory);
  const fs::path path = place_for(options);
  write(path, player_page(data));
  fmt::print("{}  {}, {}\n", path.string(), detail::size_text(fs::file_size(path)),
             data.exact ? "an exact replay, from collision to collision"
                        : fmt::format("interpolated between samples: {}", data.why_not));
  return exit_done;
}

}  // namespace carom::cli
