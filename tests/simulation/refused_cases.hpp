#pragma once
// What the reader of files refuses, every way to make a simulation refuses in the same words: cases of that.

#include <carom/scene.hpp>

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace carom::test {

/// Two species in [-1, 1] x [-1, 1]; the second is listed.
inline std::string base_text(const std::string& boundary) {
  return "[box]\nx = [-1.0, 1.0]\ny = [-1.0, 1.0]\nboundary = \"" + boundary +
         "\"\n[[disks]]\ncount = 8\nradius = 0.05\nmass = 1.0\npositions = \"random\"\nvelocities = { uniform = 1.0 }\n"
         "[[disks]]\nradius = 0.1\nmass = 2.0\npositions = [[0.5, 0.5], [-0.5, -0.5]]\nvelocities = [[1.0, 0.0], [0.0, 1.0]]\n"
         "[collision]\nrule = \"specular\"\n[run]\ntime = 5.0\n";
}

/// A change of a file and the same change of a Scene.
struct RefusedCase {
  std::string name;
  std::string boundary;
  std::vector<std::string> overrides;  ///< of the file
  std::function<void(Scene&)> change;
};

inline void PrintTo(const RefusedCase& one, std::ostream* out) { *out << one.name; }

template <class Kind>
Kind& in(std::optional<Kind>& effect) {
  return effect ? *effect : effect.emplace();
}

inline ObservableRequest observable(const std::string& name) {
  ObservableRequest request;
  request.name = name;
  return request;
}

inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN(),
                        infinite_number = std::numeric_limits<double>::infinity();

/// The tests of each case are in file_and_program_checks_test.cpp.
class FileAndProgramChecks : public testing::TestWithParam<RefusedCase> {};

inline std::string name_of(const testing::TestParamInfo<RefusedCase>& one) { return one.param.name; }

}  // namespace carom::test
