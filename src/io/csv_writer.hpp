#pragma once
// samples.csv: one line per disk and sample, time,id,x,y,vx,vy, and spin where disks are rough.

#include "io/text_file.hpp"

#include <carom/state.hpp>

#include <cstddef>
#include <filesystem>

namespace carom {

/// Every number is written with the fewest digits that read back as the same double.
class CsvWriter {
 public:
  explicit CsvWriter(std::filesystem::path path, bool rough = false);

  void sample(const State& state);  ///< positions are written as they are
  void flush() { file_.flush(); }
  void close() { file_.close(); }

  [[nodiscard]] std::size_t buffered_bytes() const { return file_.buffered_bytes(); }

 private:
  detail::TextFile file_;
  bool rough_;
};

}  // namespace carom
