// No include guard: compiled once per instruction set, in the namespace CAROM_INSTRUCTIONS.

#include "core/doubles_kernel.hpp"
#include "observe/lag_rows.hpp"

#include <cstring>

namespace carom::CAROM_INSTRUCTIONS {
namespace {

template <class Number>
CAROM_INLINE Number load(const double* from) {
  Number x;
  std::memcpy(&x, from, sizeof x);
  return x;
}
template <class Number>
CAROM_INLINE void store(Number x, double* to) {
  std::memcpy(to, &x, sizeof x);
}

/// Calls `of(row, number)` for fours of rows, and for each that is left; the number says how many.
template <class Of>
CAROM_INLINE void for_rows(std::size_t rows, Of of) {
  std::size_t row = 0;
  for (; row + 4 <= rows; row += 4) of(row, Doubles{});
  for (; row < rows; ++row) of(row, double{});
}

void since(double* samples, const double* first, std::size_t rows, std::size_t lines) {
  for (; lines > 0; --lines, samples += rows)
    for_rows(rows, [=]<class Number>(std::size_t row, Number) {
      store(load<Number>(samples + row) - load<Number>(first + row), samples + row);
    });
}

void blocks(const double* samples, const BlockSums& sums, bool second, std::size_t lines, double* means) {
  for_rows(sums.rows, [=]<class Number>(std::size_t row, Number) {
    Number sum = load<Number>(sums.sum + row), square = load<Number>(sums.square + row);
    Number waiting = load<Number>(sums.waiting + row);
    const double* from = samples + row;
    double* to = means + row;
    const auto next = [&] {
      const Number x = load<Number>(from);
      from += sums.length;
      sum += x;
      square += x * x;
      return x;
    };
    const auto join = [&](Number a, Number b) {
      store(0.5 * (a + b), to);
      to += sums.length;
    };
    std::size_t line = 0;
    if (second && lines > 0) join(waiting, next()), ++line;
    for (; line + 2 <= lines; line += 2) {
      const Number one = next();
      join(one, next());
    }
    if (line < lines) waiting = next();
    store(sum, sums.sum + row);
    store(square, sums.square + row);
    store(waiting, sums.waiting + row);
  });
}

void products(const double* a, const double* x, const double* y, std::size_t rows, double* found) {
  for_rows(rows, [=]<class Number>(std::size_t row, Number) {
    store(0.5 * (a[0] * load<Number>(x + row) + a[1] * load<Number>(y + row)), found + row);
  });
}

void squares(const double* a, const double* x, const double* y, std::size_t rows, double* found) {
  for_rows(rows, [=]<class Number>(std::size_t row, Number) {
    const Number dx = a[0] - load<Number>(x + row), dy = a[1] - load<Number>(y + row);
    store(0.5 * (dx * dx + dy * dy), found + row);
  });
}

}  // namespace

extern const LagRowsKernel lag_rows_kernel = {&since, &blocks, &products, &squares};

}  // namespace carom::CAROM_INSTRUCTIONS
