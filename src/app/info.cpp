// carom info FILE: determines the kind of a file and has it described, or says how to make a run again.

#include "app/info.hpp"

#include "app/commands.hpp"
#include "app/info_parts.hpp"
#include "io/checkpoint.hpp"
#include "io/run_directory.hpp"
#include "terminal/reading_process.hpp"
#include "text/methods.hpp"
#include "text/numbers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <carom/scene.hpp>

#include <array>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <system_error>
#include <vector>

namespace carom {

namespace fs = std::filesystem;

namespace detail {

std::string info_line(std::string_view label, std::string_view text) { return fmt::format("  {:<11} {}\n", label, text); }

std::string engine_line(const std::string& name, std::optional<double> time_step, std::optional<double> stiffness) {
  return info_line(time_step ? "method" : "engine", method_words(name, time_step, stiffness));
}

std::string samples_text(std::uintmax_t samples, double first, double last) {
  if (samples == 0) return "none";
  if (samples == 1) return fmt::format("1, at time {}", first);
  return fmt::format("{}, from time {} to {}", samples, first, last);
}

}  // namespace detail

namespace {

constexpr std::string_view partial_ending = ".partial";

bool begins_like_hdf5(const fs::path& path) {
  std::array<char, 8> begin{};
  std::ifstream(path, std::ios::binary).read(begin.data(), begin.size());
  return std::string_view(begin.data(), begin.size()) == std::string_view("\x89HDF\r\n\x1a\n", 8);
}

std::string describe_scene(const fs::path& path) {
  const Scene scene = load_scene(path.string());
  std::string text = fmt::format("{}: scene{}{}\n", path.string(), scene.title.empty() ? "" : ", ", scene.title);
  for (const Species& species : scene.species)
    text += detail::info_line("disks", fmt::format("{} {}", species.count, species.name));
  text += detail::info_line("density", fmt::format("packing fraction {:.4g}", scene.packing_fraction()));
  text += detail::info_line("collisions", scene.effects.collision.rule == CollisionRule::reversal ? "reversal" : "specular");
  const std::vector<std::string> effects = names_of(scene.effects, !scene.box.periodic(0) || !scene.box.periodic(1));
  if (effects.size() > 1)
    text += detail::info_line("effects", fmt::format("{}", fmt::join(effects.begin() + 1, effects.end(), ", ")));
  return text + detail::info_line("seed", fmt::format("{}", scene.run.seed));
}

bool begins_like_checkpoint(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string line;
  return std::getline(file, line) && line == "carom checkpoint";
}

std::string describe_checkpoint(const fs::path& path) {
  if (const std::string damage = checkpoint_damage(path); !damage.empty())
    throw OutputError(fmt::format("{}: this checkpoint is damaged: {}", path.string(), damage));
  const CheckpointFacts facts = checkpoint_facts(path);
  std::string text = fmt::format("{}: checkpoint of a run{}\n", path.string(),
                                 facts.finished ? " that has ended" : " that carom resume can continue");
  text += detail::info_line("time", fmt::format("{}", facts.time));
  text += detail::info_line("collisions", fmt::format("{}", facts.collisions));
  text += detail::info_line("engine", facts.provenance.engine);
  text += detail::info_line("scene", facts.scene_source);
  return text + detail::info_line("command", facts.provenance.command_line);
}

std::string describe_directory(const fs::path& path) {
  std::string text, fault;
  const auto describe = [&](const fs::path& file) {
    try {
      text += describe_file(file);
    } catch (const OutputError& error) {
      if (fault.empty()) fault = error.what();
    }
  };
  for (const std::string_view product : detail::sweep_products) {
    std::error_code error;
    if (fs::exists(path / product, error)) describe(path / product);
  }
  if (text.empty() && fault.empty()) text = detail::describe_runs_of_sweep(path);
  for (const std::string_view product : run_products) {
    if (product.starts_with("observe_") || product.ends_with(".html"))
      continue;  // the summary describes them, and a page needs no description
    for (const fs::path& file : {path / product, path / fmt::format("{}{}", product, partial_ending)}) {
      std::error_code error;
      const bool unfinished_checkpoint = file.extension() == partial_ending && product.starts_with("checkpoint");
      if (unfinished_checkpoint || !fs::exists(file, error)) continue;
      const bool of_samples = product.ends_with(".xyz") || product.ends_with(".csv");
      if (of_samples && fs::file_size(file, error) == 0)
        text += fmt::format("{}: no sample was written\n", file.string());
      else
        describe(file);
    }
  }
  if (!fault.empty()) throw PartlyDescribed(fault, text);
  if (text.empty()) {
    throw OutputError(
        fmt::format("{}: this directory holds no results of Carom; name a directory that carom run or "
                    "carom sweep has written, or one of its files",
                    path.string()));
  }
  return text;
}

std::string describe_content(const fs::path& path) {
  if (begins_like_hdf5(path)) return detail::describe_hdf5(path);
  fs::path name = path;
  if (name.extension() == partial_ending) name.replace_extension();
  const std::string ending = name.extension().string();
  if (ending == ".xyz") return detail::describe_xyz(path);
  if (ending == ".csv") return detail::describe_csv(path);
  if (ending == ".json") return detail::describe_summary(path);
  if (ending == ".toml") return describe_scene(path);
  if (begins_like_checkpoint(path)) return describe_checkpoint(path);
  if (ending == ".h5md" || ending == ".h5")
    throw OutputError(fmt::format(
        "{}: this is not an HDF5 file, although its name says so; it may be cut short, or another program's", path.string()));
  throw OutputError(
      fmt::format("{}: Carom does not know this kind of file; it describes directories of runs and sweeps, "
                  ".h5md, .xyz, .csv, summary.json, sweep.h5 and scenes (.toml)",
                  path.string()));
}

}  // namespace

std::string describe_file(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status))
    throw OutputError(fmt::format("{}: cannot read: {}; name a file or directory that carom run has written", path.string(),
                                  error ? error.message() : std::generic_category().message(ENOENT)));
  if (fs::is_directory(status)) return describe_directory(path);
  if (!fs::is_regular_file(status))
    throw OutputError(
        fmt::format("{}: this is neither a file nor a directory; name one that carom run has written", path.string()));
  if (!std::ifstream(path))
    throw OutputError(
        fmt::format("{}: cannot read: {}; ask for permission to read it", path.string(), std::generic_category().message(errno)));

  const std::uintmax_t size = fs::file_size(path);
  if (size == 0)
    throw OutputError(
        fmt::format("{}: this file is empty; the run that should have written it did not get that far", path.string()));
  std::string text = describe_content(path);
  text += detail::info_line("size", carom::size(static_cast<double>(size)));
  if (path.extension() == partial_ending) text += detail::info_line("state", "incomplete: the run has not ended, or was killed");
  return text;
}

}  // namespace carom

namespace carom::cli {

ExitCode info(const InfoOptions& options, const Invocation& invocation) {
  if (options.reproduce) {
    fmt::print("{}", reproduction(options.file, invocation));
    return exit_done;
  }
  return in_reading_process(options.file, [&] {
    const ReadingLimit limit(options.file);
    as_usage_error([&] {
      try {
        fmt::print("{}", describe_file(options.file));
      } catch (const PartlyDescribed& partly) {
        fmt::print("{}", partly.text);
        throw;
      }
    });
    return exit_done;
  });
}

}  // namespace carom::cli
