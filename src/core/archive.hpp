#pragma once
// State written down and read back to the last bit: what checkpoints are made of. The archives are cereal's; here is what it
// does not know by itself: Eigen's matrices, and records of numbers, which are kept as they lie in memory.
//
// A class whose state is more than that has `template <class Archive> void serialize(Archive& archive)`, which lists its members
// for both directions. What is kept can be read by a program with the same records only: io/checkpoint.hpp sees to that.

#include "core/real.hpp"

#include <Eigen/Core>

#include <cereal/archives/binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/map.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/vector.hpp>

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace carom {

using SavingArchive = cereal::BinaryOutputArchive;
using LoadingArchive = cereal::BinaryInputArchive;

namespace detail {

template <class T>
inline constexpr bool is_of_cereal = false;
template <class T>
inline constexpr bool is_of_cereal<std::optional<T>> = true;
template <class T, std::size_t n>
inline constexpr bool is_of_cereal<std::array<T, n>> = true;

}  // namespace detail

/// Numbers side by side, some of them perhaps in small matrices. Pointers and references do not belong there: nothing notices
/// them.
template <class T, class Archive>
concept Record = std::is_class_v<T> && std::is_trivially_destructible_v<T> && !detail::is_of_cereal<T> &&
                 !requires(T & record, Archive& archive) {
  record.serialize(archive);
};

template <class Archive, class T>
requires Record<T, Archive>
void serialize(Archive& archive, T& record) { archive(cereal::binary_data(static_cast<void*>(&record), sizeof(T))); }

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
