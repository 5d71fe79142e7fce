#pragma once
// A plot as JSON: what the scripts of the page draw it from, and what other programs may read out of the page.

#include <carom/pages/page.hpp>

#include <string>

namespace carom::detail {

/// {"id", "title", "x": {"title", "log"}, "y", "series": [{"name", "group", "style", "visible", "x": [], "y": [], ...}],
/// "marks"}. null stands for a number that is not finite. Nothing in the text can end a script element. Throws
/// std::invalid_argument where the lengths of a series differ or its group is negative.
std::string plot_json(const Plot& plot);

}  // namespace carom::detail
