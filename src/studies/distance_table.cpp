#include "studies/distance_table.hpp"

#include "text/table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace carom {

std::vector<std::size_t> evenly_spaced(std::size_t count, std::size_t most) {
  std::vector<std::size_t> chosen;
  const std::size_t rows = std::min(count, most);
  for (std::size_t k = 0; k < rows; ++k) chosen.push_back(rows == 1 ? 0 : (k * (count - 1) + (rows - 1) / 2) / (rows - 1));
  return chosen;
}

std::string distance_table(const std::vector<DistanceAt>& distances, double diameter) {
  TerminalTable table("rrrl");
  table.add({"t", "rms distance", "largest", "of disk"});
  for (const std::size_t k : evenly_spaced(distances.size(), most_distance_rows)) {
    const DistanceAt& at = distances[k];
    table.add({fmt::format("{:.6g}", at.time), fmt::format("{:.3g}", at.rms / diameter),
               fmt::format("{:.3g}", at.largest / diameter), at.largest > 0.0 ? fmt::format("{}", at.disk) : "-"});
  }
  return table.text();
}

detail::Json distances_json(const std::vector<DistanceAt>& distances, double diameter) {
  detail::Json list = detail::Json::array();
  for (const DistanceAt& at : distances)
    list.push_back({{"time", detail::number(at.time)},
                    {"rms", detail::number(at.rms / diameter)},
                    {"largest", detail::number(at.largest / diameter)},
                    {"disk", at.disk}});
  return list;
}

}  // namespace carom
