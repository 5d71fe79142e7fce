#include "theory/finite_fluid.hpp"

#include "theory/equation_of_state.hpp"

namespace carom::theory {

bool is_wide(const Box& box, double sigma, double eta) { return box.lengths().minCoeff() >= (eta <= 0.45 ? 6.5 : 10.5) * sigma; }

std::optional<FluidZ> fluid_Z(double eta, std::int64_t disks) {
  if (eta <= densest_finite) return FluidZ{.value = kolafa_rottner_finite(eta, disks)};
  if (eta <= densest_fluid && disks >= many_dense_disks) return FluidZ{.value = kolafa_rottner(eta), .of_so_many = false};
  return {};
}

}  // namespace carom::theory
