// FNV-1a (Fowler, Noll & Vo): offset basis and prime of 64 bits are those of draft-eastlake-fnv.

#include <carom/state.hpp>

#include <fmt/format.h>

#include <bit>
#include <stdexcept>

namespace carom {
namespace {

class Fnv {
 public:
  void add(double number) {
    auto bits = std::bit_cast<std::uint64_t>(number);
    for (int byte = 0; byte < 8; ++byte, bits >>= 8) value_ = (value_ ^ (bits & 0xff)) * 0x100000001b3U;
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

}  // namespace

std::string state_hash(const State& state) {
  const Eigen::Index disks = state.positions.cols();
  if (state.velocities.cols() != disks || (state.spins.size() != 0 && state.spins.size() != disks))
    throw std::invalid_argument(fmt::format("a state of {} positions has {} velocities and {} spins; give one of each per disk",
                                            disks, state.velocities.cols(), state.spins.size()));
  Fnv hash;
  hash.add(state.time);
  for (Eigen::Index i = 0; i < disks; ++i) {
    for (const double coordinate : state.positions.col(i)) hash.add(coordinate);
    for (const double component : state.velocities.col(i)) hash.add(component);
    if (state.spins.size() > 0) hash.add(state.spins[i]);
  }
  return fmt::format("{:016x}", hash.value());
}

}  // namespace carom
