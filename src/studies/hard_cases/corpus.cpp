// The corpus that is compiled in.

#include "studies/hard_cases/hard_case.hpp"
#include "text/embedded_text.hpp"

#include <algorithm>
#include <span>
#include <string>
#include <utility>

namespace carom {

namespace detail {
std::span<const EmbeddedText> hard_case_texts();
}

const std::vector<std::string>& hard_case_families() {
  static const std::vector<std::string> families = {"contact",   "coincidence", "scale", "density",
                                                    "long-time", "many-events", "exact"};
  return families;
}

const std::vector<HardCase>& hard_case_corpus() {
  static const std::vector<HardCase> corpus = [] {
    std::vector<HardCase> cases;
    for (const detail::EmbeddedText& one : detail::hard_case_texts())
      cases.push_back(read_hard_case(std::string(one.text), std::string(one.path)));
    const auto& families = hard_case_families();
    const auto place = [&](const HardCase& one) {
      return std::pair(std::find(families.begin(), families.end(), one.family) - families.begin(), one.name);
    };
    std::sort(cases.begin(), cases.end(), [&](const HardCase& a, const HardCase& b) { return place(a) < place(b); });
    return cases;
  }();
  return corpus;
}

}  // namespace carom
