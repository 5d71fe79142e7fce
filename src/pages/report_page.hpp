#pragma once
// The page of one run: what was simulated, what happened, how exact it was, what it measured and what theory says of it, and the
// run itself to watch. Made from the files of the run alone.

#include "io/run_record.hpp"
#include "pages/player_data.hpp"
#include "theory/run_theory.hpp"

#include <carom/pages/page.hpp>

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

/// The mark near the beginning of every report, which identifies it.
inline constexpr std::string_view report_mark = "<meta name=\"generator\" content=\"carom report\">";

/// Returns what theory says of a run that was read back; `record` must live as long as that.
[[nodiscard]] RunTheory theory_of(const RunRecord& record);

/// Returns blocks that others add to what the page says of a run's accuracy.
using MoreOnAccuracy = std::function<std::vector<Block>(const RunRecord& record)>;

/// `player` is empty where the run kept no samples.
[[nodiscard]] Page report_page(const RunRecord& record, const std::optional<PlayerData>& player, const MoreOnAccuracy& more = {});

/// The limits of the player in a report: it holds every event, or fewer samples than a player of its own.
inline constexpr PlayerLimits report_limits = {.events = 1'000'000, .sample_bytes = 8'000'000};

struct ReportFile {
  std::string html;
  std::string player;  ///< remark on its replay, half a sentence
};
/// Returns the page of the run in a directory. Throws OutputError: one sentence about a directory that is no finished run, or a
/// file of it that cannot be read.
[[nodiscard]] ReportFile report_of(const std::filesystem::path& directory, const MoreOnAccuracy& more = {});

}  // namespace carom
