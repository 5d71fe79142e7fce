#pragma once
// The error that is thrown when a file cannot be written or read, and its sentences.

#include <carom/io/output_error.hpp>

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace carom {

namespace detail {

/// Returns the error "PATH: cannot ACTION: REASON; ADVICE", with the system's reason and the advice that belong to
/// `error_number`. `kept` says what can still be read, and stands before the advice where it is not empty.
[[nodiscard]] OutputError system_error(const std::filesystem::path& path, std::string_view action, int error_number,
                                       std::string_view kept = {});

/// Returns the error for a file with which a run cannot go on, because it has fewer bytes than it had.
[[nodiscard]] OutputError cut_short(const std::filesystem::path& path, std::uint64_t bytes, std::uint64_t wanted);

}  // namespace detail

}  // namespace carom
