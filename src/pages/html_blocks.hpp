#pragma once
// The HTML of what a section consists of: paragraphs, plots, tables, listings.

#include "pages/page.hpp"

#include <string>

namespace carom::detail {

/// Returns the element of a block. A plot is an empty place for page.js to draw in, with its numbers beside it.
std::string html_block(const Block& block);

}  // namespace carom::detail
