// Reads start files with std::from_chars: no locale, no rounding but the nearest, a million rows in well under a second.

#include "scene/start_file.hpp"

#include "scene/excerpt.hpp"
#include "scene/known_keys.hpp"
#include "scene/text_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <system_error>

namespace carom::detail {
namespace {

enum Column : std::size_t { x, y, vx, vy, radius, mass, column_count };
constexpr std::array<std::string_view, column_count> column_names = {"x", "y", "vx", "vy", "radius", "mass"};

struct Field {
  std::string_view text;
  int column = 1;  ///< where it begins in its line, from 1
};

std::string shown(std::string_view text) { return fmt::format("\"{}\"", excerpt(text, 40)); }

void split(std::string_view line, std::vector<Field>& fields) {
  fields.clear();
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    const std::string_view text = trimmed(line.substr(begin, end - begin));
    fields.push_back({text, static_cast<int>(text.empty() ? begin : static_cast<std::size_t>(text.data() - line.data())) + 1});
    begin = end + 1;
  }
}

/// The finite number that the whole of `text` spells.
std::optional<double> parse_number(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+')
    text.remove_prefix(1);  // from_chars takes no plus sign
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

class Reader {
 public:
  Reader(std::string_view text, const std::string& path) : text_(text) {
    file_.rows.source = path;
    if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);  // the byte order mark that spreadsheets write
  }

  StartFile read() {
    if (!next_line()) {
      line_number_ = 1;
      fail(1, "the file is empty; its first row must name the columns, such as x,y or x,y,vx,vy,radius,mass");
    }
    read_header();
    while (next_line()) read_row();
    return std::move(file_);
  }

 private:
  [[noreturn]] void fail(int column, const std::string& sentence) const {
    throw SceneError({file_.rows.source, line_number_, column}, sentence);
  }

  /// Moves to the next line that counts; its fields are in fields_.
  bool next_line() {
    while (position_ < text_.size()) {
      const std::size_t end = std::min(text_.find('\n', position_), text_.size());
      std::string_view line = text_.substr(position_, end - position_);
      position_ = end + 1;
      ++line_number_;
      if (line.ends_with('\r')) line.remove_suffix(1);
      const std::string_view content = trimmed(line);
      if (content.empty() || content.starts_with('#')) continue;
      split(line, fields_);
      return true;
    }
    return false;
  }

  void read_header() {
    std::array<bool, column_count> has{};
    for (const Field& field : fields_) {
      const auto name = std::find(column_names.begin(), column_names.end(), field.text);
      if (name == column_names.end()) refuse_column(field);
      const auto column = static_cast<Column>(name - column_names.begin());
      if (has[column]) fail(field.column, fmt::format("the column {} is named twice; name it once", field.text));
      has[column] = true;
      columns_.push_back(column);
    }
    for (const Column column : {x, y}) {
      if (!has[column]) fail(1, fmt::format("there is no column {}; the columns x and y are required", column_names[column]));
    }
    if (has[vx] != has[vy]) fail(1, fmt::format("there is no column {}; give both vx and vy, or neither", has[vx] ? "vy" : "vx"));
    file_.has_velocities = has[vx];
    file_.has_radii = has[radius];
    file_.has_masses = has[mass];
  }

  [[noreturn]] void refuse_column(const Field& field) const {
    if (parse_number(field.text)) fail(field.column, "the first row must name the columns, such as x,y,vx,vy; found numbers");
    const std::string_view near = nearest_word(field.text, column_names);
    if (field.text.find_first_of(";\t ") != std::string_view::npos) {
      fail(field.column,
           fmt::format("{} is not a column; separate the columns with commas, such as x,y,vx,vy", shown(field.text)));
    }
    if (!near.empty() && field.text.size() > 1) {
      fail(field.column, fmt::format("there is no column {}; did you mean {}?", shown(field.text), near));
    }
    fail(field.column,
         fmt::format("there is no column {}; the columns are {}", shown(field.text), fmt::join(column_names, ", ")));
  }

  void read_row() {
    if (fields_.size() != columns_.size()) {
      fail(1, fmt::format("this row has {} {}, but the header names {} columns", fields_.size(),
                          fields_.size() == 1 ? "value" : "values", columns_.size()));
    }
    std::array<double, column_count> values{};
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const Column column = columns_[i];
      const std::optional<double> value = parse_number(fields_[i].text);
      if (!value) {
        fail(fields_[i].column,
             fmt::format("{} is {}; it must be a finite number, such as 0.5", column_names[column], shown(fields_[i].text)));
      }
      if ((column == radius || column == mass) && *value <= 0.0) {
        fail(fields_[i].column, fmt::format("{} is {}; it must be above zero", column_names[column], *value));
      }
      values[column] = *value;
    }
    file_.positions.emplace_back(values[x], values[y]);
    if (file_.has_velocities) file_.velocities.emplace_back(values[vx], values[vy]);
    if (file_.has_radii) file_.radii.push_back(values[radius]);
    if (file_.has_masses) file_.masses.push_back(values[mass]);
    file_.rows.places.push_back({line_number_, 1});
  }

  std::string_view text_;
  std::size_t position_ = 0;
  int line_number_ = 0;
  std::vector<Field> fields_;
  std::vector<Column> columns_;
  StartFile file_;
};

}  // namespace

StartFile parse_start_file(std::string_view text, const std::string& path) { return Reader(text, path).read(); }

StartFile read_start_file(const std::string& path) { return parse_start_file(read_text_file(path), path); }

}  // namespace carom::detail
