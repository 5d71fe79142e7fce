#pragma once
// The effects with which a simulation cannot be shared out to several cores.

#include <carom/effects.hpp>

#include <string>

namespace carom::detail {

/// Returns what keeps disks with these effects on one core, in half a sentence; empty where nothing does.
[[nodiscard]] std::string why_not_threads(const Effects& effects);

}  // namespace carom::detail
