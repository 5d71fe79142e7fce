#pragma once
// The build, the machine and the instructions that a measured speed belongs to.

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace carom::cli {

/// Returns text such as "Intel(R) Xeon(R) Processor, 2048 KiB of second-level cache; carom 0.1.0 (commit ...), avx512
/// instructions."
std::string measured_on();

/// {"carom": {...}, "machine": {...}, "instructions": "avx512"}
nlohmann::ordered_json measured_on_json();

}  // namespace carom::cli
