#pragma once
// Random numbers from counter-based streams (Philox 4x32-10 of Random123; Salmon et al., SC'11). A number depends on
// the seed, the stream's name, an index such as a disk's id, and its place in that stream, and on nothing else: what
// one part of the program draws never shifts what another part gets.

#include <Random123/philox.h>

#include <Random123/MicroURNG.hpp>  // after philox.h: it relies on macros of the generators
#include <cstdint>

namespace carom {

/// One name per use. The values are part of what a seed means: never renumber, only append.
enum class Stream : std::uint32_t {
  positions = 1,
  velocities = 2,
  lattice_sites = 3,
  perturbations = 4,
  thermal_walls = 5,
  thermostat = 6,
  sampled_disks = 7,
  radii = 8,
  tumbling = 9,
  brownian = 10
};

/// A uniform random bit generator (32 bits a draw, 2^32 blocks of four) for Boost.Random's distributions.
class RandomStream : public r123::MicroURNG<r123::Philox4x32> {
 public:
  RandomStream(std::uint64_t seed, Stream stream, std::uint64_t index = 0)
      : MicroURNG(
            {{static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(index >> 32), static_cast<std::uint32_t>(stream), 0}},
            {{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}}) {}
};

}  // namespace carom
