// carom report RUN_DIR: the page of one run.

#include "app/commands.hpp"
#include "pages/report_page.hpp"
#include "studies/horizon/page.hpp"
#include "terminal/open_page.hpp"
#include "terminal/output_paths.hpp"
#include "terminal/reading_process.hpp"
#include "text/numbers.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace carom::cli {

namespace fs = std::filesystem;

namespace {

ReportFile read_report(const std::string& directory) {
  const ReadingLimit limit(directory);
  return as_usage_error([&] { return report_of(directory, horizon_blocks); });
}

}  // namespace

ExitCode report(const ReportOptions& options) {
  const fs::path otherwise = fs::path(options.directory) / "report.html";
  const ExitCode code = in_reading_process(options.directory, [&] {
    const ReportFile file = read_report(options.directory);
    const fs::path path = place_for_page(options.output, otherwise, {"report", report_mark});
    write_whole_file(path, file.html);
    if (!options.quiet) fmt::print("{}  {}, {}\n", path.string(), size(static_cast<double>(fs::file_size(path))), file.player);
    return exit_done;
  });
  if (code == exit_done && options.open) open_page(options.output.empty() ? otherwise : fs::path(options.output));
  return code;
}

}  // namespace carom::cli
