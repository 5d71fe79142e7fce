#pragma once
// What the library's sources need of a standard library and of Random123 that Debian's emscripten (clang 14, libc++ 13) lacks. It
// is included before every file.

// Random123 refuses machines that it does not know. Its numbers are right here all the same: integers of 32 and 64 bits.
#define __riscv 1
#include <Random123/philox.h>
#undef __riscv

#include <Random123/MicroURNG.hpp>
#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 15000
namespace std {  // NOLINT: the names that the standard library will have itself

#if !defined(__cpp_lib_bit_cast)
template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
  return __builtin_bit_cast(To, from);
}
#endif

namespace ranges {

template <class Range, class Predicate>
bool any_of(Range&& range, Predicate predicate) {
  return std::any_of(std::begin(range), std::end(range), [&](auto&& value) { return std::invoke(predicate, value); });
}
template <class Range, class Predicate>
bool all_of(Range&& range, Predicate predicate) {
  return std::all_of(std::begin(range), std::end(range), [&](auto&& value) { return std::invoke(predicate, value); });
}
template <class Range, class Predicate>
bool none_of(Range&& range, Predicate predicate) {
  return !ranges::any_of(range, predicate);
}
template <class Range, class Predicate>
auto find_if(Range&& range, Predicate predicate) {
  return std::find_if(std::begin(range), std::end(range), [&](auto&& value) { return std::invoke(predicate, value); });
}
template <class Range, class Value>
auto find(Range&& range, const Value& wanted) {
  return std::find(std::begin(range), std::end(range), wanted);
}
template <class Range, class Value, class Projection>
auto find(Range&& range, const Value& wanted, Projection projection) {
  return std::find_if(std::begin(range), std::end(range), [&](auto&& value) { return std::invoke(projection, value) == wanted; });
}
template <class Range, class Value>
void fill(Range&& range, const Value& value) {
  std::fill(std::begin(range), std::end(range), value);
}
template <class Range, class Value>
void replace(Range&& range, const Value& from, const Value& to) {
  std::replace(std::begin(range), std::end(range), from, to);
}
template <class Range, class Iterator>
void copy(Range&& range, Iterator to) {
  std::copy(std::begin(range), std::end(range), to);
}

}  // namespace ranges

/// Reads the number at the beginning of a text, as the C locale spells it; a page knows no other.
inline from_chars_result from_chars(const char* first, const char* last, double& value, chars_format = chars_format::general) {
  const string_view text(first, static_cast<size_t>(last - first));
  const size_t length =
      min(text.find_first_not_of("+-.0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"), text.size());
  if (length == 0 || text[0] == '+') return {first, errc::invalid_argument};
  const string copy(text.substr(0, length));
  char* end = nullptr;
  const double read = strtod(copy.c_str(), &end);
  if (end == copy.c_str()) return {first, errc::invalid_argument};
  value = read;
  return {first + (end - copy.c_str()), errc()};
}

}  // namespace std
#endif
