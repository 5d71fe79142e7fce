#pragma once
// Four integers at once, as every machine has them; for eight, see the kernels.

#include <cstdint>
#include <cstring>

namespace carom {

using Four = std::int32_t __attribute__((vector_size(16)));

inline Four four_of(const std::int32_t* from) {
  Four four;
  std::memcpy(&four, from, sizeof four);
  return four;
}
inline void store(Four four, std::int32_t* to) { std::memcpy(to, &four, sizeof four); }
inline std::int32_t sum(Four four) { return four[0] + four[1] + four[2] + four[3]; }

}  // namespace carom
