#pragma once
// The results of observables, as lines of the terminal.

#include <carom/observe.hpp>
#include <carom/scene.hpp>

#include <string>
#include <vector>

namespace carom {

/// "1.0970 ± 0.0041"; the value alone where it does not scatter. Requires a value.
[[nodiscard]] std::string number_words(const Scalar& scalar);

/// Every number of every observable with its unit, and what the rest is in.
[[nodiscard]] std::string observed_lines(const std::vector<Measurement>& observables, const Scene& scene);

}  // namespace carom
