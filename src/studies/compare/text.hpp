#pragma once
// A comparison for the person at the terminal.

#include "studies/compare/comparison.hpp"

#include <carom/scene.hpp>

#include <string>

namespace carom::cli {

/// Returns a table with a row per method and step, and the sentences that answer; `brief`: the sentences alone.
std::string compare_text(const Comparison& comparison, const Scene& scene, bool brief);

}  // namespace carom::cli
