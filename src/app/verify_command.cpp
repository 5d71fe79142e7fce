// carom verify RUN_DIR: runs the scene of a finished run again and compares the two to the last bit. And the commands that make
// such a run again, for carom info --reproduce.

#include "app/commands.hpp"
#include "io/finished_run.hpp"
#include "io/hdf5_handle.hpp"
#include "io/output_error.hpp"
#include "io/partial_file.hpp"
#include "io/same_results.hpp"
#include "terminal/output_paths.hpp"
#include "terminal/processes.hpp"
#include "terminal/reading_process.hpp"
#include "text/methods.hpp"
#include "text/shell.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <carom/version.hpp>
#include <nlohmann/json.hpp>

#include <stdlib.h>  // mkdtemp is POSIX, not C++

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>

namespace carom::cli {

namespace fs = std::filesystem;

namespace {

fs::path place_for_temporary_files() {
  std::error_code error;
  const fs::path place = fs::temp_directory_path(error);
  if (!error) return place;
  for (const char* name : {"TMPDIR", "TMP", "TEMP", "TEMPDIR"})  // in the order of the library
    if (const char* value = std::getenv(name))
      throw UsageError(
          fmt::format("{}={}: there is no such directory for temporary files; set {} to one that is there", name, value, name));
  throw UsageError("there is no directory for temporary files; set TMPDIR to one that is there");
}

/// A temporary directory below that of the system (TMPDIR names it), which is removed with all that is in it.
class ScratchDirectory {
 public:
  /// Throws UsageError where it cannot be made.
  ScratchDirectory() {
    std::string name = (place_for_temporary_files() / "carom-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw UsageError(detail::system_error(name, "make this directory", errno).what());
    path_ = name;
  }
  ~ScratchDirectory() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  ScratchDirectory(const ScratchDirectory&) = delete;
  ScratchDirectory& operator=(const ScratchDirectory&) = delete;

  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// The facts of a run's summary that its repetition needs; `engine` is the one to ask for.
struct Recorded {
  std::string resolved_scene, engine, commit;
  std::optional<double> dt = {}, stiffness = {};
  bool interrupted = false;
};

Recorded recorded(const fs::path& directory) {
  const fs::path path = directory / "summary.json";
  std::error_code error;
  if (!fs::exists(path, error))
    throw UsageError(fmt::format(
        "{}: this is no directory of a finished run (no summary.json); name one that carom run has written", directory.string()));
  try {
    const auto json = as_usage_error([&] { return detail::summary_in(directory); });
    if (!json.contains("resolved_scene"))
      throw UsageError(fmt::format(
          "{}: the summary does not hold the scene of the run: an earlier version of carom wrote it; run the scene again",
          path.string()));
    Recorded run{.resolved_scene = json.at("resolved_scene"),
                 .engine = json.value("engine_asked", json.at("engine").get<std::string>()),
                 .commit = json.at("carom").at("commit")};
    if (json.contains("dt")) run.dt = json.at("dt").get<double>();
    if (json.contains("stiffness")) run.stiffness = json.at("stiffness").get<double>();
    run.interrupted = json.at("stopped") == "interrupted";
    return run;
  } catch (const nlohmann::json::exception&) {
    throw UsageError(detail::no_summary(directory).what());
  }
}

ExitCode run_again(const Recorded& run, const fs::path& scratch, const VerifyOptions& options, const Invocation& invocation) {
  const fs::path scene = scratch / "scene.toml";
  PartialFile file(scene);
  file.write(run.resolved_scene);
  file.publish();
  RunOptions again;
  again.scene.path = scene.string();
  again.out = (scratch / "again").string();
  again.quiet = true;
  again.progress = options.quiet ? "never" : options.progress;
  if (run.dt) {
    again.method = run.engine;
    again.dt = run.dt;
    again.stiffness = run.stiffness;
  } else {
    again.scene.engine = run.engine;
  }
  return cli::run(again, invocation);
}

}  // namespace

std::string reproduction(const std::string& directory, const Invocation& invocation) {
  const Recorded run = recorded(directory);
  const std::string again = named_after(directory, "-again").filename().string();
  return fmt::format("cat > {0}.toml <<'END_OF_SCENE'\n{1}END_OF_SCENE\n{2} run {0}.toml {3}\n", shell_quoted(again),
                     run.resolved_scene, invocation.program, method_options(run.engine, run.dt, run.stiffness));
}

ExitCode verify(const VerifyOptions& options, const Invocation& invocation) {
  detail::close_nothing_at_exit();
  const Recorded run = recorded(options.directory);
  if (run.interrupted)
    throw UsageError(
        fmt::format("{}: this run was interrupted, and another one would not end there; verify a run that came to its end",
                    options.directory));
  const ScratchDirectory scratch;
  const bool is_first = launch().rank == 0;  // of the processes that compute the run again together
  if (const ExitCode code = run_again(run, scratch.path(), options, invocation); code != exit_done || !is_first) return code;
  return in_reading_process(options.directory, [&] {
    const ReadingLimit limit(options.directory);
    const SameResults found = as_usage_error([&] { return compare_results(options.directory, scratch.path() / "again"); });
    const std::string commits = run.commit == build_info().commit
                                    ? ""
                                    : fmt::format(" by another commit ({}; this is {})", run.commit, build_info().commit);
    if (options.json) {
      const nlohmann::ordered_json json = {{"run", options.directory}, {"same", found.differences.empty()},
                                           {"files", found.files},     {"differences", found.differences},
                                           {"commit", run.commit},     {"commit_now", build_info().commit}};
      fmt::print("{}\n", json.dump(2));
    }
    if (options.json || options.quiet) return found.differences.empty() ? exit_done : exit_check_failed;
    if (found.differences.empty()) {
      fmt::print("{}: run again, the same to the last bit{}: {}\n", options.directory, commits, fmt::join(found.files, ", "));
      return exit_done;
    }
    fmt::print("{}: run again, not the same{}\n", options.directory, commits);
    for (const std::string& difference : found.differences) fmt::print("  {}\n", difference);
    return exit_check_failed;
  });
}

}  // namespace carom::cli
