// The words of a scene as lines of the terminal.

#include "app/scene_description.hpp"

#include "pages/scene_words.hpp"

#include <fmt/format.h>
#include <carom/simulation.hpp>

namespace carom::cli {

std::string describe(const Scene& scene) {
  std::string text;
  for (const SummaryRow& row : words_of(scene)) text += fmt::format("  {:<11} {}\n", row.quantity, row.value);
  return text;
}

std::optional<std::uint64_t> expected_samples(const Scene& scene) {
  const Run& run = scene.run;
  if (!run.is_sampled()) return 0;
  if (run.sample_every_collisions ? !run.collisions || run.time : !run.time || run.collisions) return std::nullopt;
  return last_sample(scene.run) + 1;
}

}  // namespace carom::cli
