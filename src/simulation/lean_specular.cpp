#include "effects/specular.hpp"
#include "simulation/make_lean.hpp"

namespace carom::detail {
template std::unique_ptr<AnyEngine> make_lean<Specular>(const Scene& scene, const Disks& disks, State start);
}  // namespace carom::detail
