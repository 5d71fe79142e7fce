#pragma once
// samples.csv: one line per disk and sample, time,id,x,y,vx,vy, and spin where disks are rough.

#include "io/text_file.hpp"

#include <carom/state.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <utility>

namespace carom {

/// Every number is written with the fewest digits that read back as the same double.
class CsvWriter {
 public:
  explicit CsvWriter(std::filesystem::path path, bool rough = false);
  /// Goes on after the first `kept` bytes of a file that is there.
  CsvWriter(std::filesystem::path path, bool rough, std::uint64_t kept) : file_(std::move(path), kept), rough_(rough) {}

  void sample(const State& state);  ///< positions are written as they are
  void flush() { file_.flush(); }
  void close() { file_.close(); }

  [[nodiscard]] std::uint64_t written() const { return file_.written(); }
  [[nodiscard]] std::size_t buffered_bytes() const { return file_.buffered_bytes(); }

 private:
  detail::TextFile file_;
  bool rough_;
};

}  // namespace carom
