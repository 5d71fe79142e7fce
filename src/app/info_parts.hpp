#pragma once
// The parts of describe_file: one function per kind of file. Each throws OutputError, whose sentence names the path.

#include <filesystem>
#include <string>
#include <string_view>

namespace carom::detail {

std::string describe_hdf5(const std::filesystem::path& path);
std::string describe_xyz(const std::filesystem::path& path);
std::string describe_csv(const std::filesystem::path& path);
std::string describe_summary(const std::filesystem::path& path);

/// One line of a description.
std::string info_line(std::string_view label, std::string_view text);
/// Returns text such as "5001, from time 0 to 5"
std::string samples_text(std::uintmax_t samples, double first, double last);

}  // namespace carom::detail
