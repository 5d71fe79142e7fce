#pragma once
// The names of groups in trajectory.h5md.

#include <string>

namespace carom::detail {

inline const std::string parameters = "/parameters";
inline const std::string particles = "/particles/trajectory";

}  // namespace carom::detail
