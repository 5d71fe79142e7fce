// carom report RUN_DIR: the page of one run.

#include "app/commands.hpp"
#include "pages/report_page.hpp"
#include "studies/horizon/page.hpp"
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
  return in_reading_process(options.directory, [&] {
    const ReportFile file = read_report(options.directory);
    const fs::path path = place_for_page(options.output, fs::path(options.directory) / "report.html", {"report", report_mark});
    write_page(path, file.html);
    fmt::print("{}  {}, {}\n", path.string(), size(static_cast<double>(fs::file_size(path))), file.player);
    return exit_done;
  });
}

}  // namespace carom::cli
