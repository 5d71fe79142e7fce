#pragma once
// Finds the plots of a page.

#include <carom/pages/page.hpp>

#include <string>
#include <variant>
#include <vector>

namespace carom::test {

inline std::vector<Plot> plots_of(const Page& page) {
  std::vector<Plot> plots;
  for (const Section& section : page.sections)
    for (const Block& block : section.blocks)
      if (const Plot* const plot = std::get_if<Plot>(&block)) plots.push_back(*plot);
  return plots;
}

inline std::vector<std::string> ids_of(const Page& page) {
  std::vector<std::string> ids;
  for (const Plot& plot : plots_of(page)) ids.push_back(plot.id);
  return ids;
}

}  // namespace carom::test
