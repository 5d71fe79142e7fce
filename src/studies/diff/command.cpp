// carom diff RUN_A RUN_B: two runs side by side, in a table and a few sentences. Writes no files.

#include "studies/diff/command.hpp"
#include "studies/diff/text.hpp"
#include "terminal/reading_process.hpp"
#include "terminal/standard_output.hpp"

#include <fmt/format.h>

#include <exception>
#include <new>

namespace carom::cli {

namespace {

constexpr auto exit_equal = exit_done;
constexpr auto exit_different = static_cast<ExitCode>(1);  // as of diff(1)

DiffRun opened(const std::string& path) {
  const ReadingLimit limit(path);
  return open_diff_run(path);
}

ExitCode print_difference(const DiffCommandOptions& options) {
  const RunDifference found = difference_of(opened(options.first), opened(options.second));
  if (options.quiet) return found.same() ? exit_equal : exit_different;
  print_whole(options.json ? diff_json(found) + "\n" : diff_text(found));
  return found.same() ? exit_equal : exit_different;
}

}  // namespace

ExitCode diff(const DiffCommandOptions& options) {
  try {
    return in_reading_process(options.first, [&] { return print_difference(options); });
  } catch (const std::bad_alloc&) {
    throw UsageError(fmt::format("{} and {}: there is not enough memory to compare these runs", options.first, options.second));
  } catch (const std::exception& error) {  // 1 says that the runs differ
    throw UsageError(error.what());
  }
}

}  // namespace carom::cli
