#include "pages/horizon_table.hpp"

#include "pages/method_names.hpp"

#include <fmt/format.h>

namespace carom {

TextTable horizon_table(const Horizon& horizon, const std::string& which) {
  TextTable table{
      .title = "How far the exact trajectory can be trusted",
      .columns = {"engine", "bits", "right until t (scene units)", "collisions per disk", "price"},
      .caption = fmt::format(
          "Until the largest distance of a disk from where the next better precision has it reaches {:g} diameters{}{}. "
          "~: extrapolated with the Lyapunov exponent. Price: processor time over that of double precision "
          "in the same engine.",
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

}  // namespace carom
