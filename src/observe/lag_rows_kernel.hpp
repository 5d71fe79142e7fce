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

/// Sums of x and x^2, in registers.
template <class Number>
struct RunningSums {
  Number sum, square;

  CAROM_INLINE RunningSums(const BlockSums& sums, std::size_t row)
      : sum(load<Number>(sums.sum + row)), square(load<Number>(sums.square + row)) {}
  CAROM_INLINE void store_in(const BlockSums& sums, std::size_t row) const {
    store(sum, sums.sum + row);
    store(square, sums.square + row);
  }
  CAROM_INLINE Number add(Number x) {
    sum += x;
    square += x * x;
    return x;
  }
};

void blocks(const double* samples, const BlockSums& sums, bool second, std::size_t lines, double* means) {
  for_rows(sums.rows, [=]<class Number>(std::size_t row, Number) {
    RunningSums<Number> running(sums, row);
    Number waiting = load<Number>(sums.waiting + row);
    const double* from = samples + row;
    double* to = means + row;
    const auto next = [&] {
      const Number x = load<Number>(from);
      from += sums.length;
      return running.add(x);
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
    running.store_in(sums, row);
    store(waiting, sums.waiting + row);
  });
}

/// Mean of the next 2^level samples; means of the shorter blocks that they make up are added to their sums.
template <std::size_t level, class Number, class Next>
CAROM_INLINE Number mean_of_next(RunningSums<Number>* running, Next& next) {
  if constexpr (level == 0) {
    return next();
  } else {
    const Number one = running[level - 1].add(mean_of_next<level - 1>(running, next));
    return 0.5 * (one + running[level - 1].add(mean_of_next<level - 1>(running, next)));
  }
}

void blocks_of_tree(double* samples, const double* first, const BlockSums* sums) {
  for_rows(sums[0].rows, [=, length = sums[0].length]<class Number>(std::size_t row, Number) {
    const Number origin = load<Number>(first + row);
    const double* from = samples + row;
    const auto next = [&] {
      const Number x = load<Number>(from) - origin;
      from += length;
      return x;
    };
    static_assert(LagRowsKernel::tree_levels == 5);
    RunningSums<Number> running[] = {{sums[0], row}, {sums[1], row}, {sums[2], row}, {sums[3], row}, {sums[4], row}};
    store(mean_of_next<LagRowsKernel::tree_levels>(running, next), samples + row);
    for (std::size_t level = 0; level < LagRowsKernel::tree_levels; ++level) running[level].store_in(sums[level], row);
  });
}

void products(const double* x, const double* y, std::size_t rows, std::size_t lines, double* found) {
  for (std::size_t n = lines; n-- > 0; found += rows)
    for_rows(rows, [=]<class Number>(std::size_t row, Number) {
      store(0.5 * (x[n] * load<Number>(x + n + row) + y[n] * load<Number>(y + n + row)), found + row);
    });
}

void squares(const double* x, const double* y, std::size_t rows, std::size_t lines, double* found) {
  for (std::size_t n = lines; n-- > 0; found += rows)
    for_rows(rows, [=]<class Number>(std::size_t row, Number) {
      const Number dx = x[n] - load<Number>(x + n + row), dy = y[n] - load<Number>(y + n + row);
      store(0.5 * (dx * dx + dy * dy), found + row);
    });
}

}  // namespace

extern const LagRowsKernel lag_rows_kernel = {&since, &blocks, &blocks_of_tree, &products, &squares};

}  // namespace carom::CAROM_INSTRUCTIONS
