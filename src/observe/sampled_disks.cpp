#include "observe/sampled_disks.hpp"

#include "core/random.hpp"

#include <boost/random/uniform_int_distribution.hpp>

namespace carom {

std::vector<std::int32_t> sampled_disks(std::span<const std::int32_t> ids, std::size_t count, std::uint64_t seed) {
  // Each is kept with the probability that those still wanted are among those still to come (Fan, Muller & Rezucha 1962; Knuth's
  // algorithm S).
  RandomStream random(seed, Stream::sampled_disks);
  std::vector<std::int32_t> kept;
  for (std::size_t k = 0; k < ids.size() && kept.size() < count; ++k) {
    boost::random::uniform_int_distribution<std::size_t> pick(1, ids.size() - k);
    if (pick(random) <= count - kept.size()) kept.push_back(ids[k]);
  }
  return kept;
}

}  // namespace carom
