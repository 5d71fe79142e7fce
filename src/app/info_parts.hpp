#pragma once
// The parts of describe_file(): one function per kind of file. Each throws OutputError, whose sentence names the path.

#include <hdf5.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace carom::detail {

std::string describe_hdf5(const std::filesystem::path& path);
std::string describe_xyz(const std::filesystem::path& path);
std::string describe_csv(const std::filesystem::path& path);
std::string describe_summary(const std::filesystem::path& path);

/// One line of a description.
std::string info_line(std::string_view label, std::string_view text);
/// Returns the line about the engine, or the fixed-step method with its step.
std::string engine_line(const std::string& name, std::optional<double> time_step, std::optional<double> stiffness);
/// Returns text such as "5001, from time 0 to 5"
std::string samples_text(std::uintmax_t samples, double first, double last);

/// Returns whether an open HDF5 file is the sweep.h5 of a sweep.
bool is_sweep(hid_t file);
/// Returns the lines about the sweep in this file. Throws Hdf5Error.
std::string sweep_lines(hid_t file);

/// Returns whether a table that begins with this line is sweep.csv or runs.csv.
bool is_sweep_table(std::string_view heading);
std::string describe_sweep_table(const std::filesystem::path& path);
/// Returns whether a table that begins with this line is columns.csv.
bool is_columns_of_sweep(std::string_view heading);
std::string describe_columns_of_sweep(const std::filesystem::path& path);

/// The products of a sweep that are about all its runs.
inline constexpr std::string_view sweep_products[] = {"sweep.h5", "sweep.csv", "runs.csv"};
/// A directory with runs and no such product; empty where there are no runs below it.
std::string describe_runs_of_sweep(const std::filesystem::path& path);

}  // namespace carom::detail
