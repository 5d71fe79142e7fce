#pragma once
// Tables of comma-separated numbers below a row of names, as spreadsheets, pandas, numpy and R write them.

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carom::detail {

struct CsvField {
  std::string_view text;  ///< without blanks and quotation marks around it
  int column = 1;         ///< column of its first character, from 1
};

struct CsvRow {
  std::vector<CsvField> fields;
  int line = 1;  ///< number of its line, from 1
};

/// Returns the finite number that the whole of `text` spells, which may begin with a plus sign.
[[nodiscard]] std::optional<double> finite_number_in(std::string_view text);

/// The rows of a text. Blank lines and lines that begin with # do not count, but for a comment with the names of the columns just
/// above the numbers. Line ends may be CRLF; the byte order mark of UTF-8 may come first.
class CsvTable {
 public:
  /// Keeps `text`, which must outlive it.
  explicit CsvTable(std::string_view text);

  /// Returns the row of names: the first row or, where that begins with a number, the comment just above it if `is_name` takes
  /// one of its fields, as numpy.savetxt writes its header; empty where no row counts.
  std::optional<CsvRow> header(const std::function<bool(std::string_view)>& is_name);

  /// Returns the next row below the header; nullptr after the last.
  const CsvRow* next();

 private:
  bool read_row();

  std::string_view text_;
  int line_number_ = 0;
  CsvRow row_;
  bool is_pending_ = false;   ///< row_ holds numbers that next() has not returned
  std::string_view comment_;  ///< just above the row
  int comment_line_ = 0;
};

}  // namespace carom::detail
