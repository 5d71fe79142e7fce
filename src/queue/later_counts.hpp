#pragma once
// Sorting a few dozen times without a branch that could be guessed wrong: how many of them are later than each is its place in
// the order. Like core/prediction.hpp compiled for every machine, for those with AVX2 and for those with AVX-512, with the same
// answers.

#include <cstddef>
#include <cstdint>

namespace carom {

/// The most times that count_later() counts.
inline constexpr std::size_t most_counted = 64;

/// Puts the number of times later than times[n] into later[n], for n < count <= most_counted. `times` is aligned to 64 bytes, and
/// has most_counted numbers: those behind the first `count` are overwritten.
using CountLater = void (*)(double* times, std::size_t count, std::uint8_t* later);

/// Returns the best for this machine.
CountLater count_later();

}  // namespace carom
