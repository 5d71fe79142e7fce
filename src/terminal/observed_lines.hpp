#pragma once
// The results of observables, as lines of the terminal.

#include <carom/observe.hpp>
#include <carom/scene.hpp>

#include <string>
#include <vector>

namespace carom {

/// Returns text such as "1.0970 ± 0.0041"; the value alone where it does not scatter. Requires a value.
[[nodiscard]] std::string number_words(const Scalar& scalar);

/// Returns every number of every observable with its unit, and the sizes of its tables.
[[nodiscard]] std::string observed_lines(const std::vector<Measurement>& observables, const Scene& scene);

}  // namespace carom
