#pragma once
// Archives: state written and read back to the last bit, as checkpoints need it. cereal reads; this file adds what cereal lacks:
// Eigen's matrices, and records of numbers, which are stored as they lie in memory. Equal states give equal bytes with
// every compiler: nothing is written of the padding between members.
//
// A class with further state has `template <class Archive> void serialize(Archive& archive)`, which lists its members for both
// directions. Only a program with the same records can read an archive; io/checkpoint.hpp checks that.

#include "core/real.hpp"

#include <Eigen/Core>

#include <cereal/archives/binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/map.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/vector.hpp>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <ostream>
#include <type_traits>

namespace carom {

/// The functions that write carom's own types. They are in a namespace of their own, so that they are not found by overload
/// resolution on behalf of the archive.
namespace saving {

/// Writes what LoadingArchive reads.
class SavingArchive : public cereal::OutputArchive<SavingArchive, cereal::AllowEmptyClassElision> {
 public:
  explicit SavingArchive(std::ostream& out) : OutputArchive(this), out_(out) {}

  void write(const void* data, std::uint64_t size) {
    out_.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
    if (!out_) throw cereal::Exception("cannot write the state down");
  }
  template <class Number>
  void write_number(const Number& number) {
    constexpr bool is_x87 = std::is_same_v<Number, long double> && std::numeric_limits<Number>::digits == 64;
    std::array<char, sizeof(Number)> bytes{};
    std::memcpy(bytes.data(), &number, is_x87 ? 10 : sizeof(Number));
    write(bytes.data(), bytes.size());
  }

 private:
  std::ostream& out_;
};

template <class Number>
requires std::is_arithmetic_v<Number>
void save(SavingArchive& archive, const Number& number) { archive.write_number(number); }
/// Numbers side by side, or bytes.
template <class Pointer>
void save(SavingArchive& archive, const cereal::BinaryData<Pointer>& data) {
  using Number = std::remove_cv_t<std::remove_pointer_t<std::remove_reference_t<Pointer>>>;
  if constexpr (std::is_same_v<Number, long double>) {
    const auto* numbers = static_cast<const Number*>(data.data);
    for (std::uint64_t k = 0; k < data.size / sizeof(Number); ++k) archive.write_number(numbers[k]);
  } else {
    archive.write(data.data, data.size);
  }
}
template <class Size>
void save(SavingArchive& archive, const cereal::SizeTag<Size>& tag) {
  archive(tag.size);
}
template <class Value>
void save(SavingArchive& archive, const cereal::NameValuePair<Value>& pair) {
  archive(pair.value);
}

}  // namespace saving

using saving::SavingArchive;
using LoadingArchive = cereal::BinaryInputArchive;

namespace detail {

template <class T>
inline constexpr bool is_of_cereal = false;
template <class T>
inline constexpr bool is_of_cereal<std::optional<T>> = true;
template <class T, std::size_t n>
inline constexpr bool is_of_cereal<std::array<T, n>> = true;
template <class T>
inline constexpr bool is_of_cereal<cereal::NameValuePair<T>> = true;

}  // namespace detail

/// Archives numbers that are adjacent in memory.
template <class T, class Archive>
concept Record = std::is_class_v<T> && std::is_trivially_destructible_v<T> && !detail::is_of_cereal<T> &&
                 !requires(T & record, Archive& archive) {
  record.serialize(archive);
};

namespace detail {

template <std::size_t n>
constexpr int sum(const std::array<unsigned char, n>& bytes) {
  int sum = 0;
  for (const unsigned char byte : bytes) sum += byte;
  return sum;
}

/// T has a value for each of its bytes. Bytes of padding have none, so that a constant cannot be made of them.
template <class T>
concept WithoutPadding = requires {
  typename std::bool_constant<(sum(std::bit_cast<std::array<unsigned char, sizeof(T)>>(T{})) >= 0)>;
};

}  // namespace detail

template <class Archive, class T>
requires Record<T, Archive>
void serialize(Archive& archive, T& record) {
  static_assert(std::is_empty_v<T> || detail::WithoutPadding<T>,
                "a record with padding or pointers, or without a constant default value, needs a member serialize()");
  if constexpr (!std::is_empty_v<T>) archive(cereal::binary_data(static_cast<void*>(&record), sizeof(T)));
}

namespace detail {
using carom::serialize;  // records of this namespace are looked for here
}

}  // namespace carom

/// Numbers of 113 bits: Boost would write them as text for archives of its own.
namespace boost::multiprecision {

template <class Archive, class Backend, expression_template_option option>
void serialize(Archive& archive, number<Backend, option>& value) {
  static_assert(std::is_trivially_destructible_v<Backend>);
  archive(cereal::binary_data(static_cast<void*>(&value), sizeof(value)));
}

}  // namespace boost::multiprecision

namespace cereal {

template <class Archive, class Backend, boost::multiprecision::expression_template_option option>
struct specialize<Archive, boost::multiprecision::number<Backend, option>, specialization::non_member_serialize> {};

}  // namespace cereal

namespace Eigen {

template <class Archive, class Number, int rows, int columns, int options, int most_rows, int most_columns>
void save(Archive& archive, const Matrix<Number, rows, columns, options, most_rows, most_columns>& matrix) {
  archive(static_cast<std::int64_t>(matrix.rows()), static_cast<std::int64_t>(matrix.cols()));
  archive(cereal::binary_data(matrix.data(), static_cast<std::size_t>(matrix.size()) * sizeof(Number)));
}

template <class Archive, class Number, int rows, int columns, int options, int most_rows, int most_columns>
void load(Archive& archive, Matrix<Number, rows, columns, options, most_rows, most_columns>& matrix) {
  std::int64_t height = 0, width = 0;
  archive(height, width);
  matrix.resize(height, width);
  archive(cereal::binary_data(matrix.data(), static_cast<std::size_t>(matrix.size()) * sizeof(Number)));
}

}  // namespace Eigen
