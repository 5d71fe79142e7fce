// Reads the header of an .npy file, a dictionary of Python literals, and then the numbers behind it. Nothing in the file is
// believed before it is checked against the bytes that are there.

#include "scene/npy_file.hpp"

#include "scene/excerpt.hpp"
#include "scene/start_rows.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace carom::detail {
namespace {

constexpr std::string_view magic = "\x93NUMPY";

/// A Python literal as headers hold them; a list and a tuple are the same here.
struct Literal {
  std::variant<std::string, std::uint64_t, bool, std::vector<Literal>> value;

  [[nodiscard]] const std::string* text() const { return std::get_if<std::string>(&value); }
  [[nodiscard]] const std::vector<Literal>* list() const { return std::get_if<std::vector<Literal>>(&value); }
  [[nodiscard]] std::optional<std::uint64_t> number() const {
    const auto* found = std::get_if<std::uint64_t>(&value);
    return found == nullptr ? std::nullopt : std::optional(*found);
  }
};

/// Reads literals; what is none of them is nothing.
class LiteralReader {
 public:
  explicit LiteralReader(std::string_view text) : text_(trimmed(text)) {}

  /// Returns the whole text as a dictionary.
  std::optional<std::map<std::string, Literal>> dictionary() {
    std::map<std::string, Literal> entries;
    if (!take('{')) return std::nullopt;
    while (!take('}')) {
      const std::optional<Literal> key = literal(0);
      if (!key || key->text() == nullptr || !take(':')) return std::nullopt;
      std::optional<Literal> value = literal(0);
      if (!value || (!take(',') && !next_is('}'))) return std::nullopt;
      entries.insert_or_assign(*key->text(), std::move(*value));
    }
    return trimmed(text_).empty() ? std::optional(std::move(entries)) : std::nullopt;
  }

 private:
  [[nodiscard]] bool next_is(char c) {
    text_ = trimmed(text_);
    return text_.starts_with(c);
  }
  bool take(char c) {
    const bool there = next_is(c);
    if (there) text_.remove_prefix(1);
    return there;
  }
  bool take(std::string_view word) {
    const bool there = text_.starts_with(word);
    if (there) text_.remove_prefix(word.size());
    return there;
  }

  std::optional<Literal> literal(int depth) {
    constexpr int deepest = 4;  // ('name', '<f8', (2,)) in a list is three deep
    if (depth > deepest) return std::nullopt;
    if (next_is('(') || next_is('[')) return sequence(depth);
    if (next_is('\'') || next_is('"')) return string();
    if (take("True")) return Literal{true};
    if (take("False")) return Literal{false};
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), number);
    if (error != std::errc()) return std::nullopt;
    text_.remove_prefix(static_cast<std::size_t>(end - text_.data()));
    return Literal{number};
  }

  std::optional<Literal> sequence(int depth) {
    const char close = text_.front() == '(' ? ')' : ']';
    text_.remove_prefix(1);
    std::vector<Literal> entries;
    while (!take(close)) {
      std::optional<Literal> entry = literal(depth + 1);
      if (!entry || (!take(',') && !next_is(close))) return std::nullopt;
      entries.push_back(std::move(*entry));
    }
    return Literal{std::move(entries)};
  }

  std::optional<Literal> string() {
    const std::size_t end = text_.find(text_.front(), 1);
    if (end == std::string_view::npos) return std::nullopt;
    Literal found{std::string(text_.substr(1, end - 1))};
    text_.remove_prefix(end + 1);
    return found;
  }

  std::string_view text_;
};

/// One number of a row: "<f8", ">i4", "|u1".
struct NumberType {
  char kind = 'f';  ///< f, i or u
  std::size_t size = 8;
  bool swapped = false;  ///< its bytes are in the other order than this machine's
};

template <class T>
double number_of(const char* at, bool swapped) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), at, sizeof(T));
  if (swapped) std::reverse(bytes.begin(), bytes.end());
  return static_cast<double>(std::bit_cast<T>(bytes));
}

double number_at(const char* at, const NumberType& type) {
  if (type.kind == 'f') return type.size == 4 ? number_of<float>(at, type.swapped) : number_of<double>(at, type.swapped);
  const bool sign = type.kind == 'i';
  switch (type.size) {
    case 1:
      return sign ? number_of<std::int8_t>(at, false) : number_of<std::uint8_t>(at, false);
    case 2:
      return sign ? number_of<std::int16_t>(at, type.swapped) : number_of<std::uint16_t>(at, type.swapped);
    case 4:
      return sign ? number_of<std::int32_t>(at, type.swapped) : number_of<std::uint32_t>(at, type.swapped);
    default:
      return sign ? number_of<std::int64_t>(at, type.swapped) : number_of<std::uint64_t>(at, type.swapped);
  }
}

/// Returns the size in "<f8" and "|V4"; none where it is larger than any number or gap between two has.
std::optional<std::size_t> size_in(std::string_view type) {
  std::size_t size = 0;
  if (type.size() < 3 || type.size() > 5) return std::nullopt;
  const auto [end, error] = std::from_chars(type.data() + 2, type.data() + type.size(), size);
  return error == std::errc() && end == type.data() + type.size() ? std::optional(size) : std::nullopt;
}

std::optional<NumberType> number_type(std::string_view type) {
  const std::optional<std::size_t> size = size_in(type);
  if (!size || std::string_view("<>=|").find(type[0]) == std::string_view::npos) return std::nullopt;
  const bool is_float = type[1] == 'f' && (*size == 4 || *size == 8);
  const bool is_whole = (type[1] == 'i' || type[1] == 'u') && std::has_single_bit(*size) && *size <= 8;
  if (!is_float && !is_whole) return std::nullopt;
  const char other = std::endian::native == std::endian::little ? '>' : '<';
  return NumberType{type[1], *size, type[0] == other};
}

/// The place of a column in the bytes of a row.
struct Field {
  NumberType type;
  std::size_t offset = 0;
};

class NpyReader {
 public:
  NpyReader(std::string_view bytes, const std::string& path)
      : bytes_(bytes), path_(path), rows_(path, [this](std::size_t, const std::string& sentence) { fail_in_row(sentence); }) {}

  StartFile read() {
    std::map<std::string, Literal> header = read_header();
    const Literal& shape = header["shape"];
    const Literal& type = header["descr"];
    const bool* fortran = std::get_if<bool>(&header["fortran_order"].value);
    if (shape.list() == nullptr || fortran == nullptr) fail(no_header);
    if (type.list() != nullptr) {
      read_structured(*type.list(), lengths_of(*shape.list()));
    } else {
      if (type.text() == nullptr) fail(no_header);
      read_plain(*type.text(), lengths_of(*shape.list()), *fortran);
    }
    return rows_.take();
  }

  NpyFrames read_frames() {
    std::map<std::string, Literal> header = read_header();
    const Literal& shape_literal = header["shape"];
    const std::string* type_name = header["descr"].text();
    const bool* fortran = std::get_if<bool>(&header["fortran_order"].value);
    if (shape_literal.list() == nullptr || fortran == nullptr || type_name == nullptr) fail(no_header);
    const std::optional<NumberType> type = number_type(*type_name);
    if (!type) fail(fmt::format("its array is of type \"{}\"; {}", excerpt(*type_name, 40), types));
    const std::vector<std::uint64_t> shape = lengths_of(*shape_literal.list());
    if (shape.size() != 3 || (shape[2] != 2 && shape[2] != 4))
      fail(fmt::format(
          "its array has the shape ({}); it must be (frames, disks, 2) for x, y or (frames, disks, 4) for x, y, vx, vy",
          fmt::join(shape, ", ")));
    const std::uint64_t frames = shape[0], disks = shape[1], columns = shape[2];
    if (disks == 0 || disks > bytes_.size()) fail(fmt::format("its array of {} disks is not in the file", disks));
    check_length(frames, disks * columns * type->size);
    NpyFrames found{frames, disks, columns, {}};
    found.values.reserve(frames * disks * columns);
    for (std::uint64_t k = 0; k < frames; ++k)
      for (std::uint64_t i = 0; i < disks; ++i)
        for (std::uint64_t c = 0; c < columns; ++c) {
          const std::uint64_t at = *fortran ? (c * disks + i) * frames + k : (k * disks + i) * columns + c;
          found.values.push_back(number_at(bytes_.data() + at * type->size, *type));
          if (!std::isfinite(found.values.back())) fail(fmt::format("frame {}, disk {}: a number is not finite", k, i));
        }
    return found;
  }

 private:
  static constexpr const char* no_header = "its header is not one that numpy writes; write the file anew with numpy.save";
  static constexpr const char* shapes =
      "it must have 2 columns (x, y) or 4 (x, y, vx, vy), a row for each disk; others need names, in a structured array or a CSV "
      "file";
  static constexpr const char* types = "it must be float64, float32 or whole numbers";

  [[noreturn]] void fail(const std::string& sentence) const { throw SceneError({path_, 0, 0}, sentence); }
  [[noreturn]] void fail_in_row(const std::string& sentence) const {
    fail(row_ ? fmt::format("row {}, counted from 0: {}", *row_, sentence) : sentence);
  }

  std::string_view take(std::size_t count) {
    if (bytes_.size() < count) fail("the file ends within its header; write it anew with numpy.save");
    const std::string_view taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }

  std::map<std::string, Literal> read_header() {
    take(magic.size());
    const auto version = static_cast<unsigned char>(take(2)[0]);
    if (version < 1 || version > 3) fail(fmt::format("this is version {} of the .npy format; Carom reads 1 to 3", version));
    std::size_t length = 0;
    const std::string_view digits = take(version == 1 ? 2 : 4);
    for (std::size_t i = digits.size(); i-- > 0;) length = length << 8U | static_cast<unsigned char>(digits[i]);
    auto header = LiteralReader(take(length)).dictionary();
    if (!header) fail(no_header);
    return std::move(*header);
  }

  std::vector<std::uint64_t> lengths_of(const std::vector<Literal>& shape) const {
    std::vector<std::uint64_t> lengths;
    for (const Literal& length : shape) {
      if (!length.number()) fail(no_header);
      lengths.push_back(*length.number());
    }
    return lengths;
  }

  /// Checks that just so many rows follow.
  void check_length(std::uint64_t rows, std::size_t row_bytes) const {
    if (rows > bytes_.size() / row_bytes) {
      fail(fmt::format("the file ends early: {} rows of {} bytes are announced and {} bytes follow; write it anew", rows,
                       row_bytes, bytes_.size()));
    }
    if (rows * row_bytes != bytes_.size()) {
      fail(fmt::format("the file goes on for {} bytes behind its {} rows; save one array alone", bytes_.size() - rows * row_bytes,
                       rows));
    }
  }

  template <class At>  // (row, column) -> where its bytes begin
  void read_rows(std::uint64_t rows, const std::vector<Field>& fields, const At& at) {
    std::vector<double> values(fields.size());
    for (std::uint64_t row = 0; row < rows; ++row) {
      row_ = row;
      for (std::size_t i = 0; i < fields.size(); ++i) values[i] = number_at(bytes_.data() + at(row, i), fields[i].type);
      rows_.add(values, {0, 0});
    }
  }

  void read_plain(const std::string& type_name, const std::vector<std::uint64_t>& shape, bool fortran) {
    const std::optional<NumberType> type = number_type(type_name);
    if (!type) fail(fmt::format("its array is of type \"{}\"; {}", excerpt(type_name, 40), types));
    if (shape.size() != 2 || (shape[1] != 2 && shape[1] != 4)) {
      fail(fmt::format("its array has the shape ({}); {}", fmt::join(shape, ", "), shapes));
    }
    const std::uint64_t rows = shape[0], columns = shape[1];
    rows_.name_columns(std::span(start_columns).first(columns));
    check_length(rows, columns * type->size);
    read_rows(rows, std::vector<Field>(columns, Field{*type}), [&](std::uint64_t row, std::size_t column) {
      return type->size * (fortran ? column * rows + row : row * columns + column);
    });
  }

  void read_structured(const std::vector<Literal>& description, const std::vector<std::uint64_t>& shape) {
    std::vector<std::string_view> names;
    std::vector<Field> fields;
    std::size_t row_bytes = 0;
    for (const Literal& entry : description) {
      const std::vector<Literal>* parts = entry.list();
      if (parts == nullptr || parts->size() < 2 || (*parts)[0].text() == nullptr) fail(no_header);
      const std::string& name = *(*parts)[0].text();
      const std::string* type_name = (*parts)[1].text();
      const bool gap = name.empty() && type_name != nullptr && type_name->starts_with("|V");
      const std::optional<NumberType> type = type_name == nullptr ? std::nullopt : number_type(*type_name);
      const std::optional<std::size_t> size = gap ? size_in(*type_name) : type ? std::optional(type->size) : std::nullopt;
      if (!size || parts->size() > 2) fail(fmt::format("its field \"{}\" is not one number; {}", excerpt(name, 40), types));
      if (!gap) {
        names.push_back(name);
        fields.push_back({*type, row_bytes});
      }
      row_bytes += *size;
    }
    if (shape.size() != 1) {
      fail(fmt::format("its structured array has {} dimensions; it must have one, a row for each disk", shape.size()));
    }
    rows_.name_columns(names);
    check_length(shape[0], row_bytes);
    read_rows(shape[0], fields, [&](std::uint64_t row, std::size_t column) { return row * row_bytes + fields[column].offset; });
  }

  std::string_view bytes_;
  const std::string& path_;
  StartRows rows_;
  std::optional<std::uint64_t> row_;  ///< that is being read
};

}  // namespace

bool is_npy(std::string_view bytes) { return bytes.starts_with(magic); }

StartFile parse_npy(std::string_view bytes, const std::string& path) { return NpyReader(bytes, path).read(); }

NpyFrames parse_npy_frames(std::string_view bytes, const std::string& path) {
  if (!is_npy(bytes)) throw SceneError({path, 0, 0}, "this is no array that numpy.save has written");
  return NpyReader(bytes, path).read_frames();
}

}  // namespace carom::detail
