#pragma once

#include <optional>
#include <string>

namespace carom {

/// Returns text such as "fast"; "naive, dt = 0.001" where there is a time step; "soft, dt = 0.001, stiffness = 5000" where one
/// was given.
std::string method_words(const std::string& name, std::optional<double> time_step, std::optional<double> stiffness);

/// Returns the options of the program that choose this engine or method again, to the last bit: "--engine fast",
/// "--method soft --dt 0.001 --stiffness 5000".
std::string method_options(const std::string& name, std::optional<double> time_step, std::optional<double> stiffness);

}  // namespace carom
