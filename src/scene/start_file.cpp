// Reads start files with std::from_chars: no locale, no rounding but the nearest, a million rows in well under a second.

#include "scene/start_file.hpp"

#include "scene/document.hpp"
#include "scene/excerpt.hpp"
#include "scene/npy_file.hpp"
#include "scene/start_rows.hpp"
#include "text/number_in.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

namespace carom::detail {
namespace {

struct TextField {
  std::string_view text;
  int column = 1;  ///< column of its first character, from 1
};

std::string shown(std::string_view text) { return fmt::format("\"{}\"", excerpt(text, 40)); }

void split(std::string_view line, std::vector<TextField>& fields) {
  fields.clear();
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    const std::string_view text = trimmed(line.substr(begin, end - begin));
    fields.push_back({text, static_cast<int>(text.empty() ? begin : static_cast<std::size_t>(text.data() - line.data())) + 1});
    begin = end + 1;
  }
}

/// Returns the finite number that the whole of `text` spells.
std::optional<double> parse_number(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+')
    text.remove_prefix(1);  // from_chars takes no plus sign
  const std::optional<double> value = number_in<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

bool names_column(const TextField& field) {
  return std::find(start_columns.begin(), start_columns.end(), field.text) != start_columns.end();
}

/// Throws at files of other kinds, in which no line would be worth naming.
void refuse_foreign(std::string_view bytes, const std::string& path) {
  const char* kind = bytes.starts_with("PK\x03\x04")    ? "this is a zip archive, such as numpy.savez writes"
                     : bytes.starts_with("\x89HDF\r\n") ? "this is an HDF5 file"
                                                        : nullptr;
  if (kind == nullptr) return;
  throw SceneError({path, 0, 0}, fmt::format("{}; write the table of disks as CSV, or with numpy.save", kind));
}

class Reader {
 public:
  Reader(std::string_view text, const std::string& path)
      : text_(text),
        path_(path),
        rows_(path, [this](std::size_t column, const std::string& sentence) { fail(fields_[column].column, sentence); }) {
    if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);  // the byte order mark that spreadsheets write
  }

  StartFile read() {
    if (!next_line()) {
      line_number_ = 1;
      fail(1, "the file is empty; its first row must name the columns, such as x,y or x,y,vx,vy,radius,mass");
    }
    if (parse_number(fields_.front().text)) {
      read_header_in_comment();
      read_row();
    } else {
      read_header();
    }
    while (next_line()) read_row();
    return rows_.take();
  }

 private:
  [[noreturn]] void fail(int column, const std::string& sentence) const {
    throw SceneError({path_, line_number_, column}, sentence);
  }

  /// Moves to the next line that counts; its fields are in fields_, and the comment just above it in comment_.
  bool next_line() {
    comment_ = {};
    while (position_ < text_.size()) {
      const std::size_t end = std::min(text_.find('\n', position_), text_.size());
      std::string_view line = text_.substr(position_, end - position_);
      position_ = end + 1;
      ++line_number_;
      if (line.ends_with('\r')) line.remove_suffix(1);
      const std::string_view content = trimmed(line);
      if (content.starts_with('#')) {
        comment_ = line;
        comment_line_ = line_number_;
      } else if (!content.empty()) {
        split(line, fields_);
        return true;
      }
    }
    return false;
  }

  void read_header() {
    std::vector<std::string_view> names;
    for (const TextField& field : fields_) {
      if (!names_column(field) && field.text.find_first_of(";\t ") != std::string_view::npos) {
        fail(field.column, fmt::format("{} is not a column; separate the columns with commas, such as x,y,vx,vy{}",
                                       shown(field.text), field.text.find(' ') != std::string_view::npos ? numpy_delimiter : ""));
      }
      names.push_back(field.text);
    }
    rows_.name_columns(names);
  }

  /// The first row holds numbers, and numpy.savetxt writes its header as a comment: "# x,y,vx,vy" just above the numbers is taken
  /// as it was meant, where it names a column at all.
  void read_header_in_comment() {
    const std::vector<TextField> first_row = fields_;
    const int first_line = line_number_;
    const std::size_t begin = std::min(comment_.find_first_not_of("# \t"), comment_.size());
    split(comment_.substr(begin), fields_);
    for (TextField& field : fields_) field.column += static_cast<int>(begin);
    if (std::none_of(fields_.begin(), fields_.end(), names_column)) {
      fail(first_row.front().column, "the first row must name the columns, such as x,y,vx,vy; found numbers");
    }
    line_number_ = comment_line_;
    read_header();
    line_number_ = first_line;
    fields_ = first_row;
  }

  void read_row() {
    if (fields_.size() != rows_.column_count()) {
      const bool blanks = fields_.size() == 1 && fields_[0].text.find_first_of(" \t") != std::string_view::npos;
      fail(1, fmt::format("this row has {} {}, but the header names {} columns{}", fields_.size(),
                          fields_.size() == 1 ? "value" : "values", rows_.column_count(),
                          blanks ? fmt::format("; separate them with commas{}", numpy_delimiter) : ""));
    }
    values_.clear();
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      const std::optional<double> value = parse_number(fields_[i].text);
      if (!value) {
        fail(fields_[i].column,
             fmt::format("{} is {}; it must be a finite number, such as 0.5", rows_.name(i), shown(fields_[i].text)));
      }
      values_.push_back(*value);
    }
    rows_.add(values_, {line_number_, 1});
  }

  static constexpr const char* numpy_delimiter = " (numpy: delimiter=\",\")";

  std::string_view text_;
  const std::string& path_;
  std::size_t position_ = 0;
  int line_number_ = 0;
  std::vector<TextField> fields_;
  std::vector<double> values_;  ///< of the row at hand
  std::string_view comment_;
  int comment_line_ = 0;
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
