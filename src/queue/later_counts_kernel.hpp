// No include guard: compiled once per instruction set, in the namespace
// CAROM_INSTRUCTIONS.

#include "core/doubles_kernel.hpp"
#include "queue/later_counts.hpp"

#include <limits>

namespace carom::CAROM_INSTRUCTIONS {
namespace {

#if defined(__AVX512F__)

using Times = EightDoubles;

/// The number of times later than one, of those in so many vectors.
template <std::size_t vectors>
CAROM_INLINE int number_later(const Times* all_times, double time) {
  int later = 0;
  for (std::size_t k = 0; k < vectors; ++k)
    later += __builtin_popcount(_mm512_cmp_pd_mask(all_times[k], all_eight(time), _CMP_GT_OQ));
  return later;
}

#else

using Times = Doubles;

template <std::size_t vectors>
CAROM_INLINE int number_later(const Times* all_times, double time) {
  const Doubles it = all(time);
  auto later = all_times[0] > it;  // -1 for true
  for (std::size_t k = 1; k < vectors; ++k) later += all_times[k] > it;
  return -static_cast<int>(later[0] + later[1] + later[2] + later[3]);
}

#endif

constexpr std::size_t lanes = sizeof(Times) / sizeof(double);

/// With so many vectors that hold all times, which stay in registers.
template <std::size_t vectors>
void count_in(const double* times, std::size_t count, std::uint8_t* later) {
  Times all_times[vectors];
  for (std::size_t k = 0; k < vectors; ++k) all_times[k] = *reinterpret_cast<const Times*>(times + lanes * k);
  for (std::size_t n = 0; n < count; ++n) later[n] = static_cast<std::uint8_t>(number_later<vectors>(all_times, times[n]));
}

void count_all(double* times, std::size_t count, std::uint8_t* later) {
  // Three steps: how many vectors are read is guessed wrong less often than a loop of as many as there are.
  const std::size_t read = count <= 16 ? 16 : count <= 32 ? 32 : most_counted;
  for (std::size_t n = count; n < read; ++n) times[n] = -std::numeric_limits<double>::infinity();
  if (read == 16) return count_in<16 / lanes>(times, count, later);
  if (read == 32) return count_in<32 / lanes>(times, count, later);
  count_in<most_counted / lanes>(times, count, later);
}

}  // namespace

extern const CountLater later_counts = &count_all;

}  // namespace carom::CAROM_INSTRUCTIONS
