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

void since(const double* samples, const double* first, std::size_t rows, double* now) {
  for_rows(rows, [=]<class Number>(std::size_t row, Number) {
    store(load<Number>(samples + row) - load<Number>(first + row), now + row);
  });
}

void block(bool second, std::size_t rows, double* now, double* sum, double* square, double* waiting) {
  for_rows(rows, [=]<class Number>(std::size_t row, Number) {
    const Number x = load<Number>(now + row);
    store(load<Number>(sum + row) + x, sum + row);
    store(load<Number>(square + row) + x * x, square + row);
    second ? store(0.5 * (load<Number>(waiting + row) + x), now + row) : store(x, waiting + row);
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

extern const LagRowsKernel lag_rows_kernel = {&since, &block, &products, &squares};

}  // namespace carom::CAROM_INSTRUCTIONS
