#pragma once
// The error that is thrown when a file cannot be written or read, and its sentences.

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace carom {

/// A file of a run cannot be written or read. what() is one sentence: the path, the system's reason, what to do.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

namespace detail {

/// Returns the error "PATH: cannot ACTION: REASON; ADVICE", with the system's reason and the advice that belong to
/// `error_number`. `kept` says what can still be read, and stands before the advice where it is not empty.
[[nodiscard]] OutputError system_error(const std::filesystem::path& path, std::string_view action, int error_number,
                                       std::string_view kept = {});

/// Returns the error for a file with which a run cannot go on, because it has fewer bytes than it had.
[[nodiscard]] OutputError cut_short(const std::filesystem::path& path, std::uint64_t bytes, std::uint64_t wanted);

}  // namespace detail

}  // namespace carom
