#pragma once
// The machine of a measurement.

#include <cstddef>
#include <optional>
#include <string>

namespace carom::cli {

/// Returns the processor's name, as the system calls it; "unknown" where it does not say.
std::string processor();

/// Bytes of second-level cache that a core has; empty where the system does not say.
std::optional<std::size_t> second_level_cache();

/// Bytes that the program holds of the memory that it has asked for; empty where the C library does not say.
std::optional<std::size_t> memory_held();

}  // namespace carom::cli
