// carom play RUN_DIR: one HTML file that replays a run.

#include "app/commands.hpp"
#include "pages/player_page.hpp"
#include "terminal/open_page.hpp"
#include "terminal/output_paths.hpp"
#include "terminal/reading_process.hpp"
#include "text/numbers.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace carom::cli {

namespace fs = std::filesystem;

namespace {

PlayerData read_player(const std::string& directory) {
  const ReadingLimit limit(directory);
  return as_usage_error([&] { return player_data(RunReader(directory)); });
}

fs::path default_place(const PlayOptions& options) { return fs::path(options.directory) / "player.html"; }

ExitCode write_player(const PlayOptions& options) {
  const PlayerData data = read_player(options.directory);
  const fs::path path = place_for_page(options.output, default_place(options), {"player", player_mark});
  write_whole_file(path, player_page(data));
  if (options.quiet) return exit_done;
  fmt::print("{}  {}, {}\n", path.string(), size(static_cast<double>(fs::file_size(path))),
             data.exact ? "an exact replay, from collision to collision"
                        : fmt::format("interpolated between samples: {}", data.why_not));
  return exit_done;
}

}  // namespace

ExitCode play(const PlayOptions& options) {
  const ExitCode code = in_reading_process(options.directory, [&] { return write_player(options); });
  if (code == exit_done && options.open) open_page(options.output.empty() ? default_place(options) : fs::path(options.output));
  return code;
}

}  // namespace carom::cli
