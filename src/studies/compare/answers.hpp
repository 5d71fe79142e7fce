#pragma once
// Conclusions from a comparison's points: prices, the law of the error, where methods cross, and the sentences of the answer.

#include "studies/compare/mistake_law.hpp"
#include "studies/compare/prices.hpp"
#include "studies/compare/time_to_z.hpp"

#include <optional>
#include <string>
#include <vector>

namespace carom {

/// The error for which a fixed step costs as much as the exact engine: above it, the fixed step is cheaper.
struct Crossover {
  std::string method;  ///< the one that is cheaper for the smallest errors
  double error = 0.0;  ///< at the early sample, in mean diameters
  double dt = 0.0;
};

/// The number of collisions after which the exact engine is ahead of a fixed step, set-up included.
struct BreakEven {
  std::string method;
  double exact_setup = 0.0;   ///< seconds of processor time before the first event
  double method_setup = 0.0;  ///< before the first step
  double collisions_per_disk = 0.0;
};

struct Answers {
  std::string exact;                    ///< the engine that runs the scene
  double exact_seconds = 0.0;           ///< processor time until the early sample
  double exact_error = 0.0;             ///< there
  std::optional<Estimate> order;        ///< order of the grid method: error ~ dt^order
  std::optional<Crossover> crossover;   ///< empty where no fixed step is cheaper, or each is
  std::optional<BreakEven> break_even;  ///< for the best fixed step to 1e-6 diameters
  std::optional<MistakeLaw> mistakes;   ///< of backtrack
  std::vector<TimeToZ> time_to_Z;
  std::vector<Price> prices;
  std::vector<std::string> sentences;
};
[[nodiscard]] Answers answers_of(const Comparison& comparison);

}  // namespace carom
