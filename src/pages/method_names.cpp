#include "pages/method_names.hpp"

#include <map>

namespace carom {

int group_of(const std::string& method) {
  static const std::map<std::string, int> groups = {
      {"fast", 0},         {"grid", 1},           {"guarded", 2},  {"naive", 3},
      {"naive-edge", 4},   {"textbook-float", 5}, {"textbook", 6}, {"textbook-long-double", 7},
      {"textbook-quad", 5}};
  const auto found = groups.find(method);
  return found == groups.end() ? 7 : found->second;
}

std::string name_of(const std::string& method) {
  static const std::map<std::string, std::string> names = {
      {"fast", "exact: fast engine"},       {"textbook", "exact: double"},
      {"textbook-float", "exact: float"},   {"textbook-long-double", "exact: long double"},
      {"textbook-quad", "exact: 113 bits"}, {"naive-edge", "naive, walls at the edge"}};
  const auto found = names.find(method);
  return found == names.end() ? method : found->second;
}

}  // namespace carom
