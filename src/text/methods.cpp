#include "text/methods.hpp"

#include <fmt/format.h>

namespace carom {

std::string method_words(const std::string& name, std::optional<double> time_step, std::optional<double> stiffness) {
  std::string words = name;
  if (time_step) words += fmt::format(", dt = {:g}", *time_step);
  if (stiffness) words += fmt::format(", stiffness = {:g}", *stiffness);
  return words;
}

std::string method_options(const std::string& name, std::optional<double> time_step, std::optional<double> stiffness) {
  if (!time_step) return "--engine " + name;
  const std::string options = fmt::format("--method {} --dt {}", name, *time_step);
  return stiffness ? fmt::format("{} --stiffness {}", options, *stiffness) : options;
}

}  // namespace carom
