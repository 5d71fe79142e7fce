#pragma once
// A text file that is written from beginning to end through a buffer, and that detects every failure.

#include "io/output_error.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace carom::detail {

class TextFile {
 public:
  /// Creates the file, or empties it. Throws OutputError.
  explicit TextFile(std::filesystem::path path);
  /// Opens a file that is there and goes on after its first `kept` bytes: what comes after them is cut off. Throws OutputError,
  /// also where it has fewer.
  TextFile(std::filesystem::path path, std::uint64_t kept);
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;
  ~TextFile();  ///< writes what is buffered as far as that goes; only close() says whether it went well

  /// Text is appended here; then call end_line() or end_record().
  [[nodiscard]] std::string& buffer() { return buffer_; }
  void end_line();    ///< lets a full buffer go to the file
  void end_record();  ///< ends a line that also ends a record: a file is cut back to whole records if the disk fills up

  /// Hands everything to the operating system. Throws OutputError; after that every call does, for the file has a gap.
  void flush();
  void close();  ///< flush(), and the end

  [[nodiscard]] std::uint64_t written() const { return written_; }  ///< bytes handed to the operating system
  [[nodiscard]] std::size_t buffered_bytes() const { return buffer_.capacity(); }

 private:
  [[noreturn]] void fail(int error_number);
  [[nodiscard]] OutputError failure() const;

  std::filesystem::path path_;
  std::string buffer_;
  int descriptor_ = -1;
  int failed_ = 0;      ///< the error number of a write that failed
  bool whole_ = false;  ///< whether the file was then cut back to whole records
  std::uint64_t written_ = 0;
  std::uint64_t record_end_ = 0;          ///< end of the last record, in bytes from the beginning, buffered text included
  std::uint64_t written_record_end_ = 0;  ///< end of the last record that is in the file for certain
};

}  // namespace carom::detail
