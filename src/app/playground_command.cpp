// carom playground [SCENE...]: one HTML file in which scenes run live. The page is built beside the program by ./bootstrap
// playground, or installed with it; this command puts scenes into a copy of it.

#include "app/commands.hpp"
#include "io/json.hpp"
#include "terminal/open_page.hpp"
#include "terminal/output_paths.hpp"
#include "text/numbers.hpp"

#include <fmt/format.h>
#include <carom/scene.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <variant>

namespace carom::cli {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view playground_mark = "<meta name=\"generator\" content=\"carom playground\">";
constexpr std::string_view place_for_scenes = "id=\"ownScenes\">[]<";

/// Returns the built page: beside the build directory of the program, or where the installation has it.
std::string built_page() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path beside = program.parent_path().parent_path();
  for (const fs::path& path : {beside / "playground" / "playground.html", beside / "share" / "carom" / "playground.html"}) {
    std::ifstream file(path, std::ios::binary);
    if (file) return {std::istreambuf_iterator<char>(file), {}};
  }
  throw UsageError(
      "the page of the playground is not built; ./bootstrap playground in a checkout of Carom builds it, which takes some "
      "minutes "
      "once");
}

/// The scene with the disks of its start files in its own text: the page cannot read files.
std::string whole_text(Scene scene) {
  for (Species& species : scene.species) {
    if (auto* file = std::get_if<FilePositions>(&species.positions)) species.positions = ListedPositions{std::move(file->values)};
    if (auto* file = std::get_if<FileVelocities>(&species.velocities))
      species.velocities = ListedVelocities{std::move(file->values)};
  }
  return resolved_toml(scene);
}

/// JSON that may stand in a script element.
std::string in_script(const detail::Json& json) {
  std::string text = json.dump();
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at + 1)) text.replace(at, 1, "\\u003c");
  return text;
}

}  // namespace

ExitCode playground(const PlaygroundOptions& options) {
  detail::Json scenes = detail::Json::array();
  for (const std::string& path : options.scenes) {
    const Scene scene = load_scene(path);
    const std::string title = scene.title.empty() ? fs::path(path).stem().string() : scene.title;
    scenes.push_back({{"title", title}, {"toml", whole_text(scene)}});
  }
  const fs::path output = place_for_page(options.output, "playground.html", {"playground", playground_mark});
  std::string page = built_page();
  const std::size_t place = page.find(place_for_scenes);
  if (place == std::string::npos)
    throw UsageError("the built page of the playground is damaged; ./bootstrap playground builds it anew");
  page.replace(place + place_for_scenes.size() - 3, 2, in_script(scenes));
  write_whole_file(output, page);
  if (!options.quiet)
    fmt::print("{}  {}, {}; open it in a browser, no network is needed\n", output.string(),
               size(static_cast<double>(page.size())),
               options.scenes.empty() ? "with the scenes of the playground"
                                      : counted(options.scenes.size(), "scene") + " of yours first");
  if (options.open) open_page(output);
  return exit_done;
}

}  // namespace carom::cli
