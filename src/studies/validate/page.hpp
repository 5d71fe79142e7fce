#pragma once
// The page of a validation: every check, plots of theory against measurement, the scenes that were run.

#include "studies/validate/validation.hpp"

#include <carom/pages/page.hpp>

#include <string>

namespace carom {

Page validation_page(const Validation& validation, const std::string& command_line);

}  // namespace carom
