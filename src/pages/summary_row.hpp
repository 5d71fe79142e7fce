#pragma once
// One line of what is said of a run, on the terminal and on its page.

#include <string>
#include <vector>

namespace carom {

/// A quantity, its value, and a remark where there is one.
struct SummaryRow {
  std::string quantity;
  std::string value;
  std::string remark = {};
};
using SummaryRows = std::vector<SummaryRow>;

}  // namespace carom
