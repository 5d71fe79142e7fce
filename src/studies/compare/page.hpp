#pragma once
// The page of carom compare: error against cost.

#include "studies/compare/comparison.hpp"

#include <carom/pages/page.hpp>
#include <carom/scene.hpp>

#include <string>

namespace carom {

[[nodiscard]] Page compare_page(const Comparison& comparison, const Scene& scene, const std::string& command_line);

}  // namespace carom
