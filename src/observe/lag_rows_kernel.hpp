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

/// Sums over blocks of 2^level lines, and of those below.
template <class Number, std::size_t level>
struct Tree {
  Number sum, square;
  Tree<Number, level - 1> below;

  CAROM_INLINE Tree(const BlockSums* sums, std::size_t row)
      : sum(load<Number>(sums[level].sum + row)), square(load<Number>(sums[level].square + row)), below(sums, row) {}
  CAROM_INLINE void store_in(const BlockSums* sums, std::size_t row) const {
    store(sum, sums[level].sum + row);
    store(square, sums[level].square + row);
    below.store_in(sums, row);
  }
  /// Takes samples for a block from `next`; returns their mean.
  template <class Next>
  CAROM_INLINE Number add(Next& next) {
    const Number one = below.add(next), mean = 0.5 * (one + below.add(next));
    sum += mean;
    square += mean * mean;
    return mean;
  }
};
template <class Number>
struct Tree<Number, 0> {
  Number sum, square;

  CAROM_INLINE Tree(const BlockSums* sums, std::size_t row)
      : sum(load<Number>(sums[0].sum + row)), square(load<Number>(sums[0].square + row)) {}
  CAROM_INLINE void store_in(const BlockSums* sums, std::size_t row) const {
    store(sum, sums[0].sum + row);
    store(square, sums[0].square + row);
  }
  template <class Next>
  CAROM_INLINE Number add(Next& next) {
    const Number x = next();
    sum += x;
    square += x * x;
    return x;
  }
};

void blocks_of_tree(double* samples, const double* first, const BlockSums* sums) {
  for_rows(sums[0].rows, [=, length = sums[0].length]<class Number>(std::size_t row, Number) {
    const Number origin = load<Number>(first + row);
    const double* from = samples + row;
    const auto next = [&] {
      const Number x = load<Number>(from) - origin;
      from += length;
      return x;
    };
    Tree<Number, LagRowsKernel::tree_levels - 1> tree(sums, row);
    const Number one = tree.add(next);
    store(0.5 * (one + tree.add(next)), samples + row);
    tree.store_in(sums, row);
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

CAROM_INLINE void transpose(Doubles (&of)[4]) {
  const Doubles a = __builtin_shufflevector(of[0], of[1], 0, 4, 2, 6), b = __builtin_shufflevector(of[0], of[1], 1, 5, 3, 7);
  const Doubles c = __builtin_shufflevector(of[2], of[3], 0, 4, 2, 6), d = __builtin_shufflevector(of[2], of[3], 1, 5, 3, 7);
  of[0] = __builtin_shufflevector(a, c, 0, 1, 4, 5);
  of[1] = __builtin_shufflevector(b, d, 0, 1, 4, 5);
  of[2] = __builtin_shufflevector(a, c, 2, 3, 6, 7);
  of[3] = __builtin_shufflevector(b, d, 2, 3, 6, 7);
}

/// A lane for each of four lines, or for one.
void integrals(const double* samples, std::size_t rows, std::size_t lines, double* found) {
  std::size_t line = 0;
  for (; line + 4 <= lines; line += 4, samples += 4 * rows, found += 4 * rows) {
    const auto all_at = [=](std::size_t row) {
      return Doubles{samples[row], samples[rows + row], samples[2 * rows + row], samples[3 * rows + row]};
    };
    Doubles sum = -0.5 * all_at(0);
    std::size_t row = 0;
    for (; row + 4 <= rows; row += 4) {
      Doubles x[4];
      for (std::size_t k = 0; k < 4; ++k) x[k] = load<Doubles>(samples + k * rows + row);
      transpose(x);
      for (Doubles& of_lines : x) of_lines = sum += of_lines;
      transpose(x);
      for (std::size_t k = 0; k < 4; ++k) store(x[k], found + k * rows + row);
    }
    for (; row < rows; ++row) {
      sum += all_at(row);
      for (std::size_t k = 0; k < 4; ++k) found[k * rows + row] = sum[k];
    }
  }
  for (; line < lines; ++line, samples += rows, found += rows) {
    double sum = -0.5 * samples[0];
    for (std::size_t row = 0; row < rows; ++row) found[row] = sum += samples[row];
  }
}

}  // namespace

extern const LagRowsKernel lag_rows_kernel = {&since, &blocks, &blocks_of_tree, &products, &squares, &integrals};

}  // namespace carom::CAROM_INSTRUCTIONS
