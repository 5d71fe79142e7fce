#include "studies/horizon/page.hpp"

#include "studies/horizon/json.hpp"
#include "studies/horizon/report.hpp"

#include <fmt/format.h>

#include <map>
#include <optional>

namespace carom {

TextTable horizon_table(const Horizon& horizon, const std::string& which) {
  TextTable table{
      .title = "Horizon of the trajectory",
      .columns = {"engine", "bits", "right until t (scene units)", "collisions per disk", "relative cost"},
      .caption = fmt::format(
          "A trajectory is right until a disk is {:g} diameters away from its position in the next better precision{}{}. ~: "
          "extrapolated with the Lyapunov exponent. Relative cost: processor time over that of double precision in the same "
          "engine.",
          horizon.tolerance, which.empty() ? "" : ", ", which)};
  for (const HorizonRow& row : horizon.rows) {
    const std::string about = row.estimated ? "~" : "";
    table.rows.push_back({name_of(row.engine), fmt::format("{}", row.bits),
                          row.time ? about + fmt::format("{:.4g}", *row.time) : "to the end",
                          row.collisions_per_disk ? about + fmt::format("{:.3g}", *row.collisions_per_disk) : "–",
                          row.price > 0.0 ? fmt::format("{:.2g}", row.price) : "–"});
  }
  return table;
}

std::vector<Block> horizon_blocks(const RunRecord& record) {
  std::optional<Horizon> horizon = horizon_in(record.report);
  if (!horizon) return {};
  if (record.source) horizon->run_time = record.source->scene.run.time;
  return {Paragraph{sentence_of(*horizon)}, horizon_table(*horizon)};
}

int group_of(const std::string& method) {
  static const std::map<std::string, int> groups = {{"fast", 0},
                                                    {"general", 0},
                                                    {"grid", 1},
                                                    {"guarded", 1},
                                                    {"swept", 2},
                                                    {"naive", 3},
                                                    {"naive-edge", 3},
                                                    {"backtrack", 4},
                                                    {"textbook-float", 5},
                                                    {"textbook", 6},
                                                    {"textbook-long-double", 7},
                                                    {"textbook-quad", 5},
                                                    {"soft", 7}};
  const auto found = groups.find(method);
  return found == groups.end() ? 7 : found->second;
}

std::string name_of(const std::string& method) {
  static const std::map<std::string, std::string> names = {{"fast", "exact: fast engine"},
                                                           {"general", "exact: general engine"},
                                                           {"textbook", "exact: double"},
                                                           {"textbook-float", "exact: float"},
                                                           {"textbook-long-double", "exact: long double"},
                                                           {"textbook-quad", "exact: 113 bits"},
                                                           {"naive-edge", "naive, walls at the edge"},
                                                           {"richardson", "grid, Richardson"}};
  const auto found = names.find(method);
  return found == names.end() ? method : found->second;
}

}  // namespace carom
