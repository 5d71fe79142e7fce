// Reads start files with std::from_chars: no locale, no rounding but the nearest, a million rows in well under a second.

#include "scene/start_file.hpp"

#include "scene/csv_table.hpp"
#include "scene/document.hpp"
#include "scene/excerpt.hpp"
#include "scene/npy_file.hpp"
#include "scene/start_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>

namespace carom::detail {
namespace {

std::string shown(std::string_view text) { return fmt::format("\"{}\"", excerpt(text, 40)); }

bool names_column(std::string_view text) {
  return std::find(start_columns.begin(), start_columns.end(), text) != start_columns.end();
}

/// Throws at files of other kinds, in which no line would be worth naming.
void refuse_foreign(std::string_view bytes, const std::string& path) {
  const char* kind = bytes.starts_with("PK\x03\x04")    ? "this is a zip archive, such as numpy.savez writes"
                     : bytes.starts_with("\x89HDF\r\n") ? "this is an HDF5 file"
                     : bytes.starts_with("\x1f\x8b")    ? "this is packed by gzip"
                     : bytes.starts_with("PAR1")        ? "this is a Parquet file"
                     : bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff") ? "this text is in UTF-16"
                                                                                      : nullptr;
  if (kind == nullptr) return;
  throw SceneError({path, 0, 0}, fmt::format("{}; write the table of disks as CSV, or with numpy.save", kind));
}

class Reader {
 public:
  Reader(std::string_view text, const std::string& path)
      : table_(text),
        path_(path),
        rows_(path, [this](std::size_t column, const std::string& sentence) { fail(row_.fields[column].column, sentence); }) {}

  StartFile read() {
    if (std::optional<CsvRow> header = table_.header(names_column)) row_ = std::move(*header);
    if (row_.fields.empty()) {
      fail(1, "the file is empty; its first row must name the columns, such as x,y or x,y,vx,vy,radius,mass");
    }
    if (finite_number_in(row_.fields.front().text)) {
      fail(row_.fields.front().column, "the first row must name the columns, such as x,y,vx,vy; found numbers");
    }
    read_header();
    while (const CsvRow* row = table_.next()) {
      row_ = *row;
      read_row();
    }
    return rows_.take();
  }

 private:
  [[noreturn]] void fail(int column, const std::string& sentence) const {
    throw SceneError({path_, row_.line, column}, sentence);
  }

  void read_header() {
    std::vector<std::string_view> names;
    for (const CsvField& field : row_.fields) {
      if (!names_column(field.text) && field.text.find_first_of(";\t ") != std::string_view::npos) {
        fail(field.column, fmt::format("{} is not a column; separate the columns with commas, such as x,y,vx,vy{}",
                                       shown(field.text), field.text.find(' ') != std::string_view::npos ? numpy_delimiter : ""));
      }
      if (field.text.empty()) {
        fail(
            field.column,
            "a column has no name; leave out a column of row numbers (pandas: index=False; R: row.names=FALSE), and name others");
      }
      names.push_back(field.text);
    }
    rows_.name_columns(names);
  }

  void read_row() {
    const std::vector<CsvField>& fields = row_.fields;
    if (fields.size() != rows_.column_count()) {
      const bool blanks = fields.size() == 1 && fields[0].text.find_first_of(" \t") != std::string_view::npos;
      fail(1, fmt::format("this row has {} {}, but the header names {} columns{}", fields.size(),
                          fields.size() == 1 ? "value" : "values", rows_.column_count(),
                          blanks ? fmt::format("; separate them with commas{}", numpy_delimiter) : ""));
    }
    values_.clear();
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const std::optional<double> value = finite_number_in(fields[i].text);
      if (!value) {
        fail(fields[i].column,
             fmt::format("{} is {}; it must be a finite number, such as 0.5", rows_.name(i), shown(fields[i].text)));
      }
      values_.push_back(*value);
    }
    rows_.add(values_, {row_.line, 1});
  }

  static constexpr const char* numpy_delimiter = " (numpy: delimiter=\",\")";

  CsvTable table_;
  const std::string& path_;
  CsvRow row_;                  ///< at hand
  std::vector<double> values_;  ///< of it
  StartRows rows_;
};

}  // namespace

StartFile parse_start_file(std::string_view text, const std::string& path) {
  if (is_npy(text)) return parse_npy(text, path);
  refuse_foreign(text, path);
  return Reader(text, path).read();
}

StartFile read_start_file(const std::string& path) { return parse_start_file(read_text_file(path), path); }

}  // namespace carom::detail
