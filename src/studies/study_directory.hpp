#pragma once
// The directory of a study that can be interrupted and resumed.

#include "io/run_directory.hpp"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace carom::cli {

/// Creates the directory, or takes one whose results `force` may replace, or `resume` go on from. Throws UsageError. `products`
/// must live as long as what is returned. `holder` is that of RunDirectory.
[[nodiscard]] RunDirectory open_study(const std::filesystem::path& path, bool force, bool resume,
                                      std::span<const std::string_view> products, LockHolder holder = LockHolder::process);

/// Writes one product as a whole. Throws OutputError.
void write_product(const RunDirectory& directory, std::string_view product, const std::string& text);

}  // namespace carom::cli
